"""For tests of programs that use meshes: a thorough check, and a zoo of small named meshes.

>>> import halfmesh as hm
>>> for specimen in hm.testing.zoo().values():
...     hm.testing.assert_valid(specimen.mesh())
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh.core import counting, tables
from halfmesh.errors import InvalidMeshError
from halfmesh.mesh import Mesh

__all__ = ["Figures", "Specimen", "assert_valid", "zoo"]

Faces = list[list[int]]
Points = list[tuple[float, ...]]


def assert_valid(mesh: Mesh) -> None:
    """Check everything that should hold of any mesh at any time.

    The laws of :meth:`halfmesh.Mesh.check`; that kept counts agree with counting afresh, that the tables agree with
    the columns, and that every attribute has a row for each element.

    Parameters
    ----------
    mesh : Mesh

    Raises
    ------
    AssertionError
        Saying what does not hold.

    Notes
    -----
    O(n), many times the cost of a pass.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.testing.assert_valid(hm.Mesh([[0, 1, 2], [2, 1, 3]]))
    """
    try:
        mesh.check()
    except InvalidMeshError as error:
        raise AssertionError(str(error)) from error
    _assert_counts(mesh)
    _assert_tables(mesh)
    for table, collection in (
        (mesh.vertex_data, mesh.vertices),
        (mesh.halfedge_data, mesh.halfedges),
        (mesh.edge_data, mesh.edges),
        (mesh.face_data, mesh.faces),
    ):
        slots = int(collection.indices[-1]) + 1 if len(collection) else 0
        for name, values in table.items():
            assert len(values) >= slots, f"attribute {name!r} has {len(values)} rows for {slots} elements"
    assert mesh.points.dtype == np.float64 and mesh.points.shape[1:] == (3,), "points are not (n, 3) float64"


def _assert_counts(mesh: Mesh) -> None:
    t = mesh.topology
    fresh = counting.components(t)
    degrees = tables.face_degrees(t)[mesh.faces.indices]
    for what, kept, counted in (
        ("vertices", mesh.n_vertices, len(mesh.vertices.indices)),
        ("halfedges", mesh.n_halfedges, len(mesh.halfedges.indices)),
        ("edges", mesh.n_edges, len(mesh.edges.indices)),
        ("faces", mesh.n_faces, len(mesh.faces.indices)),
        ("interior halfedges", mesh.n_interior_halfedges, int(degrees.sum())),
        ("boundary loops", mesh.n_boundary_loops, len(counting.boundary_loops(t)[1]) - 1),
        ("components", mesh.n_connected_components, len(fresh)),
        ("genus", mesh.genus, int(fresh.genus.sum())),
        ("Euler characteristic", mesh.euler_characteristic, int(fresh.euler_characteristic.sum())),
        (
            "vertices by kind",
            (mesh.n_interior_vertices, mesh.n_boundary_vertices, mesh.n_isolated_vertices),
            counting.vertex_kinds(t),
        ),
        ("only triangles", mesh.is_triangular, bool((degrees == 3).all())),
        ("boundary", mesh.has_boundary, mesh.n_boundary_loops > 0),
    ):
        assert kept == counted, f"{what}: the mesh says {kept}, counting gives {counted}"


def _assert_tables(mesh: Mesh) -> None:
    t = mesh.topology
    corners, offsets = mesh.face_vertices()
    halfedges = mesh.corner_halfedges()
    assert len(offsets) == len(t.face_halfedge) + 1, "face_vertices() has not one row for each face"
    _assert_same("face_vertices()", corners, t.origin[halfedges])
    _assert_same("corner_halfedges()", t.face[halfedges], np.repeat(np.arange(len(offsets) - 1), np.diff(offsets)))
    for name, rows, total in (
        ("vertex_neighbors()", mesh.vertex_neighbors(), mesh.n_halfedges),
        ("vertex_faces()", mesh.vertex_faces(), mesh.n_interior_halfedges),
        ("face_neighbors()", mesh.face_neighbors(), int((mesh.edge_faces() >= 0).all(axis=1).sum()) * 2),
    ):
        assert len(rows[0]) == rows[1][-1] == total, f"{name} has {len(rows[0])} entries, expected {total}"
    _assert_same("vertex_degrees()", np.diff(mesh.vertex_neighbors()[1]), mesh.vertex_degrees())


def _assert_same(what: str, found: NDArray[Any], expected: NDArray[Any]) -> None:
    assert np.array_equal(found, expected), f"{what} disagrees with the columns"


# -------------------------------------------------------------------------------------------------------------- the zoo


@dataclass(frozen=True)
class Figures:
    """What is known of a specimen, by the names of the properties of :class:`halfmesh.Mesh`."""

    n_vertices: int
    n_edges: int
    n_faces: int
    n_boundary_loops: int = 0
    n_connected_components: int = 1
    genus: int = 0
    n_isolated_vertices: int = 0

    def assert_of(self, mesh: Mesh) -> None:
        """Raise AssertionError unless the mesh has these figures."""
        for name in (f.name for f in fields(self)):
            found, expected = getattr(mesh, name), getattr(self, name)
            assert found == expected, f"{name} is {found}, expected {expected}"


@dataclass(frozen=True)
class Specimen:
    """A named mesh of the zoo, as the arguments that make it."""

    name: str
    figures: Figures
    faces: Faces
    points: Points | None = None
    edges: list[tuple[int, int]] = field(default_factory=list)
    twins: list[int] | None = None

    def mesh(self) -> Mesh:
        """Build it, anew each time."""
        return Mesh(
            self.faces,
            self.points,
            n_vertices=self.figures.n_vertices,
            twins=self.twins,
            edges=self.edges if self.edges else None,
        )


def zoo() -> dict[str, Specimen]:
    """Small meshes that differ in every way meshes differ, by name.

    Returns
    -------
    dict of str to Specimen
        ``specimen.mesh()`` builds it, ``specimen.figures`` are its true figures, found without this library.

    Examples
    --------
    >>> import halfmesh as hm
    >>> bow_tie = hm.testing.zoo()["bow tie"].mesh()
    >>> bow_tie.vertices[0].degree, bow_tie.n_boundary_loops
    (4, 1)
    """
    kinds = (_closed, _with_boundary, _with_several_fans, _with_slits, _with_wire, _with_loop_and_parallel_edges)
    return {specimen.name: specimen for kind in kinds for specimen in kind()}


TETRAHEDRON: Faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
TETRAHEDRON_POINTS: Points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
CUBE: Faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
CUBE_POINTS: Points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def _closed() -> list[Specimen]:
    icosahedron = _antiprism_capped(5)
    n = 4  # of the two tori that are joined where each lost its face 0
    cut = _torus(n, n)[0]
    swap = dict(zip(cut, [cut[0], cut[3], cut[2], cut[1]], strict=True))
    other = [[swap[v] if v in swap else v + n * n for v in face] for face in _torus(n, n)[1:]]
    double_torus, used = _renumbered(_torus(n, n)[1:] + other)
    return [
        Specimen("tetrahedron", Figures(4, 6, 4), TETRAHEDRON, TETRAHEDRON_POINTS),
        Specimen("cube", Figures(8, 12, 6), CUBE, CUBE_POINTS),
        Specimen("icosahedron", Figures(12, 30, 20), icosahedron),
        Specimen(
            "pyramid over a pentagon", Figures(6, 10, 6), [[4, 3, 2, 1, 0], *_fan(5, 5)], [*_circle(5), (0, 0, 1)]
        ),
        Specimen("pillow", Figures(3, 3, 2), [[0, 1, 2], [0, 2, 1]]),
        Specimen("torus", Figures(12, 24, 12, genus=1), _torus(3, 4), _torus_points(3, 4)),
        Specimen("double torus", Figures(used, 60, 30, genus=2), double_torus),
        Specimen("two tetrahedra", Figures(8, 12, 8, n_connected_components=2), TETRAHEDRON + _shifted(TETRAHEDRON, 4)),
        Specimen(
            "shared vertex numbers from the end", Figures(4, 6, 4), [[3 - v for v in f[::-1]] for f in TETRAHEDRON]
        ),
    ]


def _with_boundary() -> list[Specimen]:
    grid = [[4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4] for j in range(2) for i in range(3)]
    grid_points: Points = [(i, j) for j in range(3) for i in range(4)]
    annulus = [[i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i] for i in range(6)]
    islands = [[0, 1, 2], [4, 5, 6, 7, 8]]
    return [
        Specimen("nothing", Figures(0, 0, 0, n_connected_components=0), []),
        Specimen("isolated vertices", Figures(3, 0, 0, n_connected_components=3, n_isolated_vertices=3), []),
        Specimen("triangle", Figures(3, 3, 1, 1), [[0, 1, 2]], [(0, 0), (1, 0), (0, 1)]),
        Specimen("heptagon", Figures(7, 7, 1, 1), [list(range(7))], _circle(7)),
        Specimen("quads", Figures(12, 17, 6, 1), grid, grid_points),
        Specimen("wheel", Figures(7, 12, 6, 1), _fan(6, 6), [*_circle(6), (0, 0, 0)]),
        Specimen("open fan", Figures(6, 9, 4, 1), [[0, i, i + 1] for i in range(1, 5)]),
        Specimen("mixed degrees", Figures(7, 9, 3, 1), [[0, 1, 2], [2, 1, 3, 4], [4, 3, 5, 6, 2]]),
        Specimen("annulus", Figures(12, 18, 6, 2), annulus, _circle(6, 2.0) + _circle(6)),
        Specimen("torus with two holes", Figures(12, 24, 10, 2, genus=1), [*_torus(3, 4)[1:6], *_torus(3, 4)[7:]]),
        Specimen("open cube", Figures(8, 12, 5, 1), CUBE[1:], CUBE_POINTS),
        Specimen(
            "islands",
            Figures(11, 8, 2, 2, n_connected_components=5, n_isolated_vertices=3),
            islands,
        ),
    ]


def _with_several_fans() -> list[Specimen]:
    propeller = [[0, 3, 4], [0, 1, 2], [5, 6, 0]]
    checkers = [[0, 1, 4, 3], [4, 5, 8, 7]]
    pinched = [[0, 1, 2, 3], [0, 4, 5], [0, 5, 6], [7, 8, 0, 9]]
    return [
        Specimen("bow tie", Figures(5, 6, 2, 1), [[0, 1, 2], [0, 3, 4]], [(0, 0), (1, -1), (1, 1), (-1, 1), (-1, -1)]),
        Specimen("propeller", Figures(7, 9, 3, 1), propeller),
        Specimen(
            "checkers",
            Figures(9, 8, 2, 1, 3, n_isolated_vertices=2),
            checkers,
            [(i, j) for j in range(3) for i in range(3)],
        ),
        Specimen("fans of several sizes", Figures(10, 13, 4, 1), pinched),
        Specimen("ring pinched at two vertices", Figures(6, 8, 2, 2), [[0, 1, 2, 3], [0, 4, 2, 5]]),
    ]


def _with_slits() -> list[Specimen]:
    return [
        Specimen("slit", Figures(5, 5, 1, 1), [[0, 1, 2, 3, 4, 3]]),
        Specimen("needle", Figures(3, 2, 1), [[0, 1, 2, 1]]),
        Specimen("square in a square", Figures(8, 9, 2, 1), [[0, 1, 2, 3, 0, 4, 7, 6, 5, 4], [4, 5, 6, 7]]),
        Specimen("face through a vertex twice", Figures(5, 6, 1, 2), [[0, 1, 2, 0, 3, 4]]),
    ]


def _with_wire() -> list[Specimen]:
    path = [(0, 1), (1, 2), (2, 3)]
    return [
        Specimen("isolated edge", Figures(2, 1, 0, 1), [], edges=[(0, 1)]),
        Specimen("path", Figures(4, 3, 0, 1), [], [(0, 0), (1, 0), (1, 1), (2, 1)], path),
        Specimen("cycle of wire", Figures(4, 4, 0, 2), [], edges=[*path, (3, 0)]),
        Specimen("star of wire", Figures(5, 4, 0, 1), [], edges=[(0, 1), (2, 0), (0, 3), (4, 0)]),
        Specimen("complete graph of five", Figures(5, 10, 0, 3, genus=2), [], edges=_pairs(5)),
        Specimen("kite", Figures(6, 6, 1, 1), [[0, 1, 2, 3]], edges=[(2, 4), (4, 5)]),
        Specimen("faces joined by wire", Figures(6, 7, 2, 1), [[0, 1, 2], [3, 4, 5]], edges=[(2, 3)]),
        Specimen("bow tie with wire", Figures(7, 8, 2, 1), [[0, 1, 2], [0, 3, 4]], edges=[(5, 0), (0, 6)]),
    ]


def _with_loop_and_parallel_edges() -> list[Specimen]:
    return [
        Specimen("torus of one vertex", Figures(1, 2, 1, genus=1), [[0, 0, 0, 0]], twins=[2, 3, 0, 1]),
        Specimen("torus of two triangles", Figures(1, 3, 2, genus=1), [[0, 0, 0], [0, 0, 0]], twins=[3, 4, 5, 0, 1, 2]),
        Specimen("tube of one quad", Figures(2, 3, 1, 2), [[0, 0, 1, 1]], twins=[-1, 3, -1, 1]),
        Specimen("cone of one triangle", Figures(2, 2, 1, 1), [[0, 0, 1]], twins=[-1, 2, 1]),
        Specimen("parallel edges", Figures(4, 6, 2, 2), [[0, 1, 2], [1, 0, 3]], twins=[-1] * 6),
        Specimen("twins of a plain mesh", Figures(4, 5, 2, 1), [[0, 1, 2], [2, 1, 3]], twins=[-1, 3, -1, 1, -1, -1]),
    ]


def _shifted(faces: Faces, by: int) -> Faces:
    return [[v + by for v in face] for face in faces]


def _renumbered(faces: Faces) -> tuple[Faces, int]:
    """The same faces over the vertices that they use, and how many these are."""
    number: dict[int, int] = {}
    return [[number.setdefault(v, len(number)) for v in face] for face in faces], len(number)


def _pairs(n: int) -> list[tuple[int, int]]:
    return [(a, b) for a in range(n) for b in range(a + 1, n)]


def _fan(n: int, hub: int) -> Faces:
    """Triangles from each side of the polygon 0 ... n - 1 to the hub."""
    return [[i, (i + 1) % n, hub] for i in range(n)]


def _antiprism_capped(n: int) -> Faces:
    """Two polygons, turned against each other, joined by triangles and capped by fans."""
    sides = [[i, (i + 1) % n, n + i] for i in range(n)] + [[n + i, (i + 1) % n, n + (i + 1) % n] for i in range(n)]
    top = [[n + i, n + (i + 1) % n, 2 * n + 1] for i in range(n)]
    return [face[::-1] for face in _fan(n, 2 * n)] + sides + top


def _torus(m: int, n: int) -> Faces:
    def vertex(i: int, j: int) -> int:
        return n * (i % m) + j % n

    return [
        [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)] for i in range(m) for j in range(n)
    ]


def _torus_points(m: int, n: int) -> Points:
    around = [2 * math.pi * i / m for i in range(m)]
    through = [2 * math.pi * j / n for j in range(n)]
    return [
        ((2 + math.cos(b)) * math.cos(a), (2 + math.cos(b)) * math.sin(a), math.sin(b)) for a in around for b in through
    ]


def _circle(n: int, radius: float = 1.0) -> Points:
    return [(radius * math.cos(2 * math.pi * i / n), radius * math.sin(2 * math.pi * i / n), 0.0) for i in range(n)]
