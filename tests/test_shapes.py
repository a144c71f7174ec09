"""Ready-made meshes: the counts, sizes and orientation they promise, and what they refuse."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm

s = hm.shapes
g = hm.geometry

COUNTS = {  # vertices, edges, faces, genus, boundary loops
    "tetrahedron": (s.tetrahedron, 4, 6, 4, 0, 0),
    "cube": (s.cube, 8, 12, 6, 0, 0),
    "octahedron": (s.octahedron, 6, 12, 8, 0, 0),
    "dodecahedron": (s.dodecahedron, 20, 30, 12, 0, 0),
    "icosahedron": (s.icosahedron, 12, 30, 20, 0, 0),
    "icosphere 0": (lambda: s.icosphere(0), 12, 30, 20, 0, 0),
    "icosphere 3": (s.icosphere, 642, 1920, 1280, 0, 0),
    "grid": (lambda: s.grid(3, 2), 12, 17, 6, 0, 1),
    "grid of one": (lambda: s.grid(1), 4, 4, 1, 0, 1),
    "grid of triangles": (lambda: s.grid(3, 2, triangles=True), 12, 23, 12, 0, 1),
    "disk": (lambda: s.disk(3, 5), 16, 30, 15, 0, 1),
    "disk of one ring": (lambda: s.disk(1, 5), 6, 10, 5, 0, 1),
    "disk of triangles": (lambda: s.disk(3, 5, triangles=True), 16, 40, 25, 0, 1),
    "cylinder": (lambda: s.cylinder(5, 2), 15, 25, 10, 0, 2),
    "cylinder of triangles": (lambda: s.cylinder(5, 2, triangles=True), 15, 35, 20, 0, 2),
    "can": (lambda: s.cylinder(5, 2, closed=True), 15, 25, 12, 0, 0),
    "can of triangles": (lambda: s.cylinder(5, 2, closed=True, triangles=True), 17, 45, 30, 0, 0),
    "torus": (lambda: s.torus(4, 3), 12, 24, 12, 1, 0),
    "torus of triangles": (lambda: s.torus(4, 3, triangles=True), 12, 36, 24, 1, 0),
    "polygon": (lambda: s.polygon(5), 5, 5, 1, 0, 1),
    "cone fan": (lambda: s.cone_fan(5), 6, 10, 5, 0, 1),
    "seed triangulation": (s.seed_triangulation, 11, 22, 12, 0, 1),
}
ALL = pytest.mark.parametrize("make", [row[0] for row in COUNTS.values()], ids=COUNTS)


@pytest.mark.parametrize(("make", "v", "e", "f", "genus", "loops"), COUNTS.values(), ids=COUNTS)
def test_counts(make, v, e, f, genus, loops):
    """C1-C3; the 11-vertex triangulation is seed 001's."""
    mesh = make()
    assert (mesh.n_vertices, mesh.n_edges, mesh.n_faces, mesh.genus, mesh.n_boundary_loops) == (v, e, f, genus, loops)
    assert mesh.n_connected_components == 1
    assert mesh.n_isolated_vertices == 0


@ALL
def test_every_shape_is_valid(make):
    hm.testing.assert_valid(make())


@ALL
def test_closed_shapes_look_outward_and_flat_ones_up(make):
    mesh = make()
    if not mesh.has_boundary:
        assert g.volume(mesh) > 0
    elif np.ptp(mesh.points[:, 2]) == 0:
        assert np.allclose(g.face_normals(mesh), [0, 0, 1])


@ALL
def test_faces_of_every_shape_are_flat_and_none_is_degenerate(make):
    mesh = make()
    assert g.face_areas(mesh).min() > 0
    t = mesh.topology
    inside = t.face >= 0
    normals, edges = g.face_normals(mesh), g.edge_vectors(mesh)
    slope = (normals[t.face[inside]] * edges[np.flatnonzero(inside) >> 1]).sum(axis=1)
    assert np.abs(slope).max() < 1e-12 * np.abs(mesh.points).max()


@pytest.mark.parametrize("name", ["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"])
def test_solids_are_regular(name):
    mesh = getattr(s, name)()
    for numbers in (
        g.edge_lengths(mesh),
        g.face_areas(mesh),
        np.linalg.norm(mesh.points - mesh.points.mean(0), axis=1),
    ):
        assert np.ptp(numbers) < 1e-14


def test_vertices_of_round_shapes_lie_on_them():
    assert np.allclose(np.linalg.norm(s.icosphere(4).points, axis=1), 1, rtol=1e-15)
    x, y, z = s.torus(7, 5, radius=3, tube_radius=2).points.T
    assert np.allclose((np.hypot(x, y) - 3) ** 2 + z**2, 4)
    x, y, z = s.cylinder(7, 3, radius=2, height=5).points.T
    assert np.allclose(np.hypot(x, y), 2)
    assert sorted(set(z)) == [0, 5 / 3, 10 / 3, 5]


def test_the_outside_of_a_cylinder_is_outside():
    mesh = s.cylinder(9, 2)
    assert ((g.face_centroids(mesh) * [1, 1, 0]) * g.face_normals(mesh)).sum(axis=1).min() > 0.5


def test_degrees_of_the_icosphere():
    assert np.bincount(s.icosphere(3).vertex_degrees()).tolist() == [0, 0, 0, 0, 0, 12, 630]


def test_the_icosphere_is_the_one_that_benchmarks_use():
    """Midpoints numbered by sorted edge, faces in four blocks; here written out for one step."""
    coarse, fine = s.icosphere(1), s.icosphere(2)
    faces = coarse.triangles().tolist()
    edges = sorted({tuple(sorted(pair)) for a, b, c in faces for pair in ((a, b), (b, c), (c, a))})
    number = {edge: 42 + i for i, edge in enumerate(edges)}
    ab, bc, ca = ([number[tuple(sorted((f[i], f[i - 2])))] for f in faces] for i in (0, 1, 2))
    a, b, c = zip(*faces, strict=True)
    blocks = [*zip(a, ab, ca, strict=True), *zip(b, bc, ab, strict=True), *zip(c, ca, bc, strict=True),
              *zip(ab, bc, ca, strict=True)]  # fmt: skip
    assert fine.triangles().tolist() == [list(face) for face in blocks]
    assert np.array_equal(fine.points[:42], coarse.points)


def test_vertices_and_cells_of_the_grid_are_numbered_row_by_row():
    mesh = s.grid(3, 2)
    assert mesh.points[4 * 2 + 3].tolist() == [3, 2, 0]
    assert g.face_barycenters(mesh)[3 + 2].tolist() == [2.5, 1.5, 0]


def test_the_grid_has_the_counts_of_the_generator_of_polylla():
    """G2: k x k points, (k-1)^2 cells of two triangles."""
    mesh = s.grid(9, triangles=True)
    assert (mesh.n_vertices, mesh.n_faces, mesh.n_halfedges) == (100, 162, 6 * 81 + 4 * 9)


def test_the_seed_triangulation_fills_its_square():
    mesh = s.seed_triangulation()
    assert g.area(mesh) == pytest.approx(1e8, rel=1e-12)
    assert mesh.triangles()[3].tolist() == [6, 2, 10]


@given(st.integers(3, 30), st.booleans())
def test_moebius_faces_are_refused(n, triangles):
    faces = s.moebius_faces(n, triangles=triangles)
    with pytest.raises(hm.InvalidMeshError) as refused:
        hm.Mesh(faces)
    assert refused.value.reason
    assert refused.value.elements


def test_moebius_faces_are_a_strip_with_one_side_and_one_rim():
    faces = s.moebius_faces(7)
    sides = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    edges, times = np.unique(sides, axis=0, return_counts=True)
    assert 14 - len(edges) + len(faces) == 0
    rim = hm.Mesh([], edges=edges[times == 1], n_vertices=14)
    assert rim.n_connected_components == 1


@given(st.integers(3, 12), st.integers(3, 12), st.booleans())
def test_any_torus_is_a_torus(n, m, triangles):
    mesh = s.torus(n, m, triangles=triangles)
    assert (mesh.n_vertices, mesh.n_faces, mesh.genus, mesh.has_boundary) == (n * m, n * m * (1 + triangles), 1, False)


@given(st.integers(3, 12), st.integers(1, 5), st.booleans(), st.booleans())
def test_any_cylinder_is_a_tube_or_a_can(sectors, rings, closed, triangles):
    mesh = s.cylinder(sectors, rings, closed=closed, triangles=triangles)
    assert mesh.n_boundary_loops == (0 if closed else 2)
    assert mesh.euler_characteristic == (2 if closed else 0)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: s.grid(0), "columns must be an integer, at least 1, not 0"),
        (lambda: s.grid(2, 2.5), r"rows must be an integer, at least 1, not 2\.5"),
        (lambda: s.grid("3"), "columns must be an integer, at least 1, not '3'"),
        (lambda: s.grid(10**6, 10**6), r"1000000\) would have 4,000,000,000,000 face corners"),
        (lambda: s.disk(0), "rings must be an integer, at least 1"),
        (lambda: s.disk(1, 2), "sectors must be an integer, at least 3"),
        (lambda: s.disk(radius=0), "radius must be positive, not 0"),
        (lambda: s.cylinder(2), "sectors must be"),
        (lambda: s.cylinder(height=float("nan")), "height must be a finite number, not nan"),
        (lambda: s.torus(2, 3), "n must be an integer, at least 3, not 2"),
        (lambda: s.torus(radius=1, tube_radius=1), "the torus would meet itself"),
        (lambda: s.polygon(2), "n must be"),
        (lambda: s.cone_fan(-1), "n must be"),
        (lambda: s.cone_fan(height="high"), "height must be a finite number, not 'high'"),
        (lambda: s.icosphere(-1), "level must be an integer, at least 0, not -1"),
        (lambda: s.icosphere(10**9), r"icosphere\(1000000000\) would have"),
        (lambda: s.moebius_faces(2), "n must be"),
    ],
)
def test_what_cannot_be_made_is_refused_with_the_reason(make, message):
    with pytest.raises(ValueError, match=message):
        make()


@pytest.mark.large
def test_a_million_cells_take_no_time():
    mesh = s.grid(1000)
    assert mesh.n_faces == 10**6
    assert g.area(mesh) == 10**6
