"""Polylla: a mesh of simple polygons from a triangulation, by joining triangles across their longest edges.

No vertex is added or moved. Every triangle points across its longest edge to the neighbor there; following that, one
comes to a terminal edge, which is the longest of both its triangles or lies on the boundary. All triangles that come to
the same terminal edge make a polygon.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from copy import deepcopy
from typing import Any, Literal, NamedTuple, NoReturn, overload

import numpy as np
from numpy.typing import NDArray

from halfmesh.algorithms._polylla_columns import number, old_halfedges, write
from halfmesh.algorithms._polylla_marks import (
    NO_TRIANGLE,
    OK,
    REPEATED_VERTEX,
    Ints,
    find_seeds,
    mark_longest_edges,
)
from halfmesh.algorithms._polylla_repair import repair
from halfmesh.algorithms._polylla_report import PHASES, PolyllaReport
from halfmesh.algorithms._polylla_travel import travel
from halfmesh.core.navigation import edge_of, edge_slots, face_slots, vertex_slots
from halfmesh.core.topology import Arrays, Topology
from halfmesh.errors import ElementError, PreconditionError
from halfmesh.geometry._passes import Floats, points_of
from halfmesh.mesh import Mesh
from halfmesh.mesh.asking import Asked

__all__ = ["PolyllaReport", "polylla"]

Progress = Callable[[str, float], None]


@overload
def polylla(mesh: Asked, *, report: Literal[False] = ..., progress: Progress | None = ...) -> Mesh: ...


@overload
def polylla(mesh: Asked, *, report: Literal[True], progress: Progress | None = ...) -> tuple[Mesh, PolyllaReport]: ...


def polylla(
    mesh: Asked, *, report: bool = False, progress: Progress | None = None
) -> Mesh | tuple[Mesh, PolyllaReport]:
    """Join the triangles of a mesh into simple polygons: the Polylla mesh of a triangulation.

    Parameters
    ----------
    mesh : Mesh, TriangleMesh or CompactMesh
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
    if not isinstance(mesh, Asked):
        raise ElementError(f"polylla(mesh) takes a mesh, not {type(mesh).__name__}; Mesh(faces, points) makes one")
    if not mesh.has_points:
        raise PreconditionError("polylla compares the lengths of edges, and this mesh has no points; set mesh.points")
    clock = _Clock(progress)
    source, face_map = _compacted(mesh)
    follows = len(source.halfedge_data) + len(source.edge_data) > 0
    partition = partitioned(source, points_of(source), Sizes.of(source.topology), clock.passed, follows=follows)
    made = _with_attributes(source, partition)
    clock.passed("attributes")

    made.build_seconds = sum(clock.seconds.values())
    return (made, _reported(partition, face_map, clock.seconds)) if report else made


class Sizes(NamedTuple):
    """How many slots of each kind there are."""

    n_vertices: int
    n_edges: int
    n_faces: int

    @classmethod
    def of(cls, t: Topology) -> Sizes:
        return cls(int(vertex_slots(t)), int(edge_slots(t)), int(face_slots(t)))


class Partition(NamedTuple):
    """The polygons as columns, and what is to be said about them."""

    arrays: Arrays
    of_triangle: Ints  # the polygon of each triangle
    old_halfedges: NDArray[np.int64] | None  # the halfedge of the triangulation that each one was
    n_wire: int
    n_tips: int
    n_repaired: int
    n_added: int


def partitioned(
    t: Any, points: Floats, sizes: Sizes, passed: Callable[[str], None], *, follows: bool = False
) -> Partition:
    """The phases of the paper.

    `t` is whatever the rules walk on, with nothing deleted; `follows` is whether to say the old halfedges. What is only
    needed in between is free again when this returns, before the attributes take their place.
    """
    marks, code, face = mark_longest_edges(t, points, 2 * sizes.n_edges, sizes.n_faces)
    if code != OK:
        _refuse(code, face)
    passed("label")
    seeds, n_wire = find_seeds(t, marks, sizes.n_edges)
    passed("seeds")
    walks = travel(t, marks, seeds, sizes.n_vertices, sizes.n_faces)
    passed("travel")
    walks = repair(t, marks, seeds, walks, sizes.n_vertices)
    passed("repair")
    numbering = number(t, marks, walks, sizes.n_edges, n_wire)
    old = old_halfedges(marks, walks, numbering) if follows else None
    walks = walks._replace(corners=walks.corners[:0].copy())  # memory for the columns
    arrays = write(t, marks, walks, numbering, *sizes[:2])
    passed("write")
    n_added = len(walks.degrees) - len(seeds)
    return Partition(arrays, walks.of_triangle, old, n_wire, walks.n_tips, len(walks.bad), n_added)


def _refuse(code: int, face: int) -> NoReturn:
    if code == NO_TRIANGLE:
        raise PreconditionError(f"face {face} is not a triangle; hm.triangulated(mesh) cuts faces into triangles")
    if code == REPEATED_VERTEX:
        raise PreconditionError(f"face {face} passes a vertex twice, so no polygon with it can be simple")
    raise PreconditionError(
        f"face {face} has a side of no finite length: a coordinate is infinite or NaN, or they are so large that their "
        "squares overflow"
    )


def _compacted(mesh: Any) -> tuple[Any, Ints | None]:
    """The mesh, or a copy without what was deleted, and the face there of each face here."""
    t = mesh.topology
    if (mesh.n_vertices, mesh.n_edges, mesh.n_faces) == tuple(Sizes.of(t)):
        return mesh, None
    copy = mesh.copy()
    return copy, copy.compact().faces


def _with_attributes(source: Any, partition: Partition) -> Mesh:
    made = object.__new__(type(source) if isinstance(source, Mesh) else Mesh)
    made._hold(Topology(partition.arrays))
    made.has_points, made.meta = True, deepcopy(source.meta)
    made.vertex_data._adopt(source.vertex_data._columns_in_use())
    old = partition.old_halfedges
    if old is not None:
        made.halfedge_data._adopt(source.halfedge_data._columns_of(old))
        made.edge_data._adopt(source.edge_data._columns_of(edge_of(source, old[::2])))
    return made


def _reported(partition: Partition, face_map: Ints | None, seconds: dict[str, float]) -> PolyllaReport:
    _, n_edges, n_polygons = (int(n) for n in partition.arrays.counts[:3])
    of_triangle = partition.of_triangle
    if face_map is not None:
        of_triangle = np.full(len(face_map), -1, dtype=np.int32)
        of_triangle[face_map >= 0] = partition.of_triangle
    return PolyllaReport(
        n_triangles=len(partition.of_triangle),
        n_polygons=n_polygons,
        n_frontier_edges=n_edges - partition.n_wire,
        n_tips=partition.n_tips,
        n_repaired=partition.n_repaired,
        n_added=partition.n_added,
        triangle_polygon=of_triangle,
        seconds=seconds,
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
