"""Polylla: a mesh of simple polygons from a triangulation, by joining triangles across their longest edges.

No vertex is added or moved. Every triangle points across its longest edge to the neighbor there; following that, one
comes to a terminal edge, which is the longest of both its triangles or lies on the boundary. All triangles that come to
the same terminal edge make a polygon.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from copy import deepcopy
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, NoReturn, overload

import numpy as np

from halfmesh.algorithms._polylla_columns import Numbering, number, old_halfedges, write
from halfmesh.algorithms._polylla_marks import (
    NO_TRIANGLE,
    OK,
    REPEATED_VERTEX,
    Bytes,
    Ints,
    find_seeds,
    mark_longest_edges,
)
from halfmesh.algorithms._polylla_repair import repair
from halfmesh.algorithms._polylla_report import PHASES, PolyllaReport
from halfmesh.algorithms._polylla_travel import Walks, travel
from halfmesh.core.navigation import edge_of
from halfmesh.core.topology import Arrays, Topology
from halfmesh.errors import PreconditionError
from halfmesh.geometry._passes import Floats, points_of

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

__all__ = ["PolyllaReport", "polylla"]

Progress = Callable[[str, float], None]


@overload
def polylla(mesh: Mesh, *, report: Literal[False] = ..., progress: Progress | None = ...) -> Mesh: ...


@overload
def polylla(mesh: Mesh, *, report: Literal[True], progress: Progress | None = ...) -> tuple[Mesh, PolyllaReport]: ...


def polylla(mesh: Mesh, *, report: bool = False, progress: Progress | None = None) -> Mesh | tuple[Mesh, PolyllaReport]:
    """Join the triangles of a mesh into simple polygons: the Polylla mesh of a triangulation.

    Parameters
    ----------
    mesh : Mesh
        Triangles with points, in the plane or on any surface; with boundaries, holes, several components, or closed.
        It stays as it is.
    report : bool
        Also return what was done.
    progress : callable, optional
        Called as ``progress(phase, fraction)`` at the end of each phase; the last fraction is 1.

    Returns
    -------
    polygons : Mesh
        The same vertices at the same points, and polygons that are simple: each passes a vertex once, has at least
        three sides, and other polygons or a boundary across all of them. Polygon ``i`` belongs to the ``i``-th terminal
        edge, in the order of the edges of `mesh`; those that a repair has cut off come behind. Within a mesh without
        wire whose vertices have one gap at most, it equals ``Mesh(polygons.face_vertices(), polygons.points)`` in all
        columns. Wire and isolated vertices are kept; if something was deleted, the vertices are those of the compacted
        mesh.
    report : PolyllaReport
        Counts, times, and the polygon of every triangle; only if asked for.

    Raises
    ------
    PreconditionError
        A face is not a triangle (see :func:`triangulated`) or passes a vertex twice; there are no points; the points
        of a triangle are not finite, or so far apart that squared lengths are not.

    Notes
    -----
    Of edges that are equally long, to the last bit of the squared length, the one counts as longer that comes first by
    the coordinates of its ends, x before y before z and the lower end first; indices decide where even those are the
    same. So the polygons don't depend on the order of vertices, faces and corners, nor on the number of threads.

    The authors' repair looks for barrier-edge tips. Here every vertex that a region passes twice is repaired, in the
    same manner: the triangles between the two visits are parted at the middle one of the edges that join them, and
    the shortest ways around are cut first, which are the tips. At the worst a region falls apart into its triangles,
    so there is a result for every input, a sphere or torus that is a single region too.

    V stays, E and F fall by one for each pair of triangles that is joined: the Euler characteristic stays, and so do
    area, components and boundary loops. Vertex data, and the edge and halfedge data of what remains, are carried over
    with their policies; face data are not, see ``report.triangle_polygon`` for gathering them by your own formula.

    O(n), on all threads; a repair costs up to the square of the region's size where it passes many vertices twice.

    References
    ----------
    S. Salinas-Fernández, N. Hitschfeld-Kahler, A. Ortiz-Bernardin, H. Si, "POLYLLA: polygonal meshing algorithm based
    on terminal-edge regions", Engineering with Computers 38 (2022).

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.polylla(hm.shapes.seed_triangulation())
    <Mesh: 11 vertices, 15 edges, 5 faces, with boundary>
    >>> polygons, report = hm.polylla(hm.shapes.grid(20, triangles=True), report=True)
    >>> report.n_triangles, report.n_polygons, set(polygons.face_degrees().tolist())
    (800, 400, {4})
    """
    clock = _Clock(progress)
    if not mesh.has_points:
        raise PreconditionError("polylla compares the lengths of edges, and this mesh has no points; set mesh.points")
    source, face_map = _compacted(mesh)
    points, sizes = points_of(source), Sizes.of(source.topology)

    regions = _partition(source, points, sizes, clock)
    numbering = number(source, regions.marks, regions.walks, sizes.n_edges, regions.n_wire)
    arrays = write(source, regions.marks, regions.walks, numbering, sizes.n_vertices)
    clock.passed("write")
    made = _with_attributes(source, arrays, regions, numbering)
    clock.passed("attributes")

    made.build_seconds = sum(clock.seconds.values())
    return (made, _reported(regions, numbering, face_map, clock)) if report else made


class Sizes(NamedTuple):
    """How many slots of each kind there are."""

    n_vertices: int
    n_edges: int
    n_faces: int

    @classmethod
    def of(cls, t: Topology) -> Sizes:
        return cls(len(t.vertex_halfedge), len(t.next) // 2, len(t.face_halfedge))


class _Regions(NamedTuple):
    marks: Bytes
    walks: Walks
    n_wire: int
    n_added: int


def _partition(t: Any, points: Floats, sizes: Sizes, clock: _Clock) -> _Regions:
    """The phases of the paper; `t` is whatever the rules walk on."""
    marks, code, face = mark_longest_edges(t, points, 2 * sizes.n_edges, sizes.n_faces)
    if code != OK:
        _refuse(code, face)
    clock.passed("label")
    seeds, n_wire = find_seeds(t, marks, sizes.n_edges)
    clock.passed("seeds")
    walks = travel(t, marks, seeds, sizes.n_vertices, sizes.n_faces)
    clock.passed("travel")
    walks = repair(t, marks, seeds, walks, sizes.n_vertices)
    clock.passed("repair")
    return _Regions(marks, walks, n_wire, len(walks.degrees) - len(seeds))


def _refuse(code: int, face: int) -> NoReturn:
    if code == NO_TRIANGLE:
        raise PreconditionError(f"face {face} is not a triangle; hm.triangulated(mesh) cuts faces into triangles")
    if code == REPEATED_VERTEX:
        raise PreconditionError(f"face {face} passes a vertex twice, so no polygon with it can be simple")
    raise PreconditionError(
        f"face {face} has a side of no finite length: a coordinate is infinite or NaN, or they are so large that their "
        "squares overflow"
    )


def _compacted(mesh: Mesh) -> tuple[Mesh, Ints | None]:
    """The mesh, or a copy without what was deleted, and the face there of each face here."""
    t = mesh.topology
    if (mesh.n_vertices, mesh.n_edges, mesh.n_faces) == tuple(Sizes.of(t)):
        return mesh, None
    copy = mesh.copy()
    return copy, copy.compact().faces


def _with_attributes(source: Mesh, arrays: Arrays, regions: _Regions, numbering: Numbering) -> Mesh:
    made = object.__new__(type(source))
    made._hold(Topology(arrays))
    made.has_points, made.meta = True, deepcopy(source._meta)
    made.vertex_data._adopt(source.vertex_data._columns_in_use())
    if len(source.halfedge_data) or len(source.edge_data):
        old = old_halfedges(regions.marks, regions.walks, numbering)
        made.halfedge_data._adopt(source.halfedge_data._columns_of(old))
        made.edge_data._adopt(source.edge_data._columns_of(edge_of(source, old[::2])))
    return made


def _reported(regions: _Regions, numbering: Numbering, face_map: Ints | None, clock: _Clock) -> PolyllaReport:
    walks = regions.walks
    of_triangle = walks.of_triangle
    n_triangles = len(of_triangle)
    if face_map is not None:
        of_slot = np.full(len(face_map), -1, dtype=np.int32)
        of_slot[face_map >= 0] = of_triangle
        of_triangle = of_slot
    return PolyllaReport(
        n_triangles=n_triangles,
        n_polygons=len(walks.degrees),
        n_frontier_edges=numbering.n_edges - regions.n_wire,
        n_tips=walks.n_tips,
        n_repaired=len(walks.bad),
        n_added=regions.n_added,
        triangle_polygon=of_triangle,
        seconds=clock.seconds,
    )


class _Clock:
    """Times the phases, and tells about them."""

    def __init__(self, progress: Progress | None) -> None:
        self.progress, self.last = progress, time.perf_counter()
        self.seconds: dict[str, float] = {}

    def passed(self, phase: str) -> None:
        """The phase that has just ended."""
        now = time.perf_counter()
        self.seconds[phase], self.last = now - self.last, now
        if self.progress is not None:
            self.progress(phase, (PHASES.index(phase) + 1) / len(PHASES))
