"""Meshes of which some or all faces are cut: indices, attributes, kernels, every mesh of the zoo, real files."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm
import polygons
from halfmesh._jit import compiling_always
from polygons import as_mesh, as_mesh_with_shared_vertices, joined_twice, state
from test_corpus_topology import HELD

ZOO = hm.testing.zoo()
REFUSED = {"torus of one vertex", "tube of one quad"}
WITH_POLYGONS = [row for row in HELD if row["degrees"] != f"3:{row['F']}"]
every_mesh = pytest.mark.parametrize("specimen", ZOO.values(), ids=ZOO)


@hm.kernel
def cut_all(t, points):
    n = 0
    for f in range(hm.face_slots(t)):
        n += hm.triangulate_face(t, points, f)
    return n


@hm.kernel
def statuses(t, points, out):
    for f in range(len(out)):
        out[f] = hm.triangulate_face_status(t, points, f)


# ----------------------------------------------------------------------------------------------- the faces of a mesh


def test_face_keeps_its_number_and_its_first_side():
    mesh = hm.shapes.dodecahedron()
    first = [f.halfedge for f in mesh.faces]
    parts = hm.triangulate(mesh)
    assert [mesh.faces[f].halfedge for f in range(12)] == first
    assert parts.dtype == np.int32
    assert parts.tolist() == [*range(12), *np.repeat(range(12), 2)]


def test_parts_make_up_the_face():
    mesh = hm.shapes.cylinder(9, 2, closed=True)
    vectors = hm.geometry.face_vectors(mesh)
    parts = hm.triangulate(mesh)
    for axis in range(3):
        sums = np.bincount(parts, hm.geometry.face_vectors(mesh)[:, axis], minlength=len(vectors))
        assert sums == pytest.approx(vectors[:, axis], abs=1e-14)


def test_deleted_faces_are_part_of_nothing():
    mesh = hm.shapes.cube()
    mesh.remove_face(1)
    assert hm.triangulate(mesh).tolist() == [0, -1, 2, 3, 4, 5, 0, 2, 3, 4, 5]


@pytest.mark.parametrize(
    "choose",
    [
        lambda mesh: [4, 1],
        lambda mesh: np.array([4, 1, 4], np.uint8),
        lambda mesh: (mesh.faces[i] for i in (1, 4)),
        lambda mesh: [mesh.faces[4], np.int32(1)],
    ],
    ids=["list", "array", "handles", "mixed"],
)
def test_only_the_faces_that_are_named_are_cut(choose):
    for mesh in (hm.shapes.cube(), hm.shapes.cube()):
        assert hm.triangulate(mesh, choose(mesh)).tolist() == [*range(6), 1, 4]
        assert mesh.face_degrees().tolist() == [4, 3, 4, 4, 3, 4, 3, 3]


def test_one_face_is_named_by_itself():
    mesh = hm.shapes.cube()
    hm.triangulate(mesh, 0)
    hm.triangulate(mesh, mesh.faces[1])
    hm.triangulate(mesh, [])
    assert mesh.n_faces == 8


def test_triangles_are_left_as_they_are():
    mesh = hm.shapes.icosphere(1)
    before = state(mesh)
    assert hm.triangulate(mesh).tolist() == list(range(80))
    assert state(mesh) == before


def test_faces_of_one_and_two_sides_are_left_as_they_are():
    mesh = hm.Mesh([])
    a, b = mesh.add_vertex(), mesh.add_vertex()
    loop, there, back = mesh.add_edge(a, a), mesh.add_edge(a, b), mesh.add_edge(b, a)
    mesh.add_face(halfedges=[loop.halfedge])
    mesh.add_face(halfedges=[there.halfedge, back.halfedge])
    assert hm.triangulate(mesh).tolist() == [0, 1]
    assert cut_all(mesh, mesh.points) == 0


def test_triangulated_leaves_the_mesh_and_knows_its_handles():
    mesh = hm.shapes.cube()
    before = state(mesh)
    assert hm.triangulated(mesh, mesh.faces[2]).face_degrees().tolist() == [4, 4, 3, 4, 4, 4, 3]
    assert hm.triangulated(mesh, (f for f in mesh.faces)).is_triangular
    assert state(mesh) == before


def test_handles_and_growing_go_on():
    mesh = hm.shapes.cube()
    f = mesh.faces[5]
    hm.triangulate(mesh)
    assert f.degree == 3
    mesh.split_face(f)
    hm.testing.assert_valid(mesh)


# ---------------------------------------------------------------------------------------------- what follows


def test_corner_data_go_along_with_the_corners():
    mesh = as_mesh(polygons.star(30))
    mesh.halfedge_data["vertex"] = mesh.topology.origin.copy()
    hm.triangulate(mesh)
    h = mesh.corner_halfedges()
    assert mesh.halfedge_data["vertex"][h].tolist() == mesh.topology.origin[h].tolist()


def test_a_seam_in_corner_data_stays_where_a_face_passes_a_vertex_twice():
    mesh = as_mesh_with_shared_vertices(polygons.SLIT)
    side = np.zeros(mesh.n_halfedges, int)
    h = mesh.find_halfedge(*(int(np.flatnonzero((mesh.points[:, :2] == p).all(axis=1))[0]) for p in ((0, 2), (2, 2))))
    side[h.index] = 1  # this corner at the mouth of the slit, and not the other one
    mesh.halfedge_data["side"] = side
    hm.triangulate(mesh)
    mouth = [c for c in mesh.corner_halfedges() if mesh.topology.origin[c] == h.origin.index]
    above = [int(np.mean([v.point[1] for v in mesh.halfedges[c].face.vertices()]) > 2) for c in mouth]
    assert mesh.halfedge_data["side"][mouth].tolist() == above


def test_face_data_go_to_all_parts_and_sums_are_shared():
    mesh = hm.shapes.dodecahedron()
    mesh.face_data["label"] = np.arange(12)
    mesh.face_data.add("mass", float, default=6.0, policy="sum")
    parts = hm.triangulate(mesh)
    assert mesh.face_data["label"].tolist() == parts.tolist()
    assert mesh.face_data["mass"].sum() == pytest.approx(72)


# ------------------------------------------------------------------------------------------------------- in kernels


@pytest.mark.parametrize("run", [lambda k, *a: k(*a), lambda k, *a: k.interpreted(*a)], ids=["compiled", "interpreted"])
def test_kernel_cuts_as_the_function_does(run):
    for mesh in (hm.shapes.cylinder(12, 3, closed=True), as_mesh(polygons.star(70)), as_mesh(polygons.SPIKE)):
        expected = hm.triangulated(mesh)
        for points in (mesh.points, mesh.vertex_data.column("points")):
            again = mesh.copy()
            assert run(cut_all, again, points) == expected.n_faces - mesh.n_faces
            assert state(again)[0] == state(expected)[0]


def test_kernel_gives_a_negative_code_and_changes_nothing():
    torus = ZOO["torus of one vertex"].mesh()
    before = state(torus)
    out = np.full(1, -1)
    statuses(torus, torus.points, out)
    assert cut_all(torus, torus.points) == -out[0] < 0
    assert state(torus) == before
    assert hm.triangulate_face(torus, torus.points, 0, True) == 1


def test_status_is_zero_where_the_face_can_be_cut():
    mesh = hm.shapes.dodecahedron()
    out = np.full(12, -1)
    statuses(mesh, mesh.points, out)
    assert out.tolist() == [0] * 12
    assert mesh.n_faces == 12


@pytest.mark.large
@every_mesh
def test_compiled_and_interpreted_give_the_same(specimen):
    one, other = specimen.mesh(), specimen.mesh()
    for mesh in (one, other):
        mesh.points = np.random.default_rng(0).normal(size=mesh.points.shape)
    hm.triangulate(one, allow_parallel=True)
    with compiling_always():
        hm.triangulate(other, allow_parallel=True)
    assert state(one) == state(other)


@pytest.mark.large
@pytest.mark.parametrize("polygon", [polygons.comb(40), polygons.star(200), polygons.tree_of_triangles(90, 1, 3)])
def test_large_polygon_is_cut_alike_compiled_and_interpreted(polygon):
    one, other = as_mesh(polygon), as_mesh(polygon)
    hm.triangulate(one)
    with compiling_always():
        hm.triangulate(other)
    assert state(one) == state(other)


# ---------------------------------------------------------------------------------------------- any mesh


@every_mesh
@pytest.mark.parametrize("quality", ["delaunay", "any"])
def test_every_mesh_of_the_zoo_is_cut_or_refused_unchanged(specimen, quality):
    mesh = specimen.mesh()
    before, figures = state(mesh), (mesh.euler_characteristic, mesh.genus, mesh.n_boundary_loops, mesh.n_vertices)
    doubled = joined_twice(mesh)
    if specimen.name in REFUSED:
        with pytest.raises(hm.TopologyError):
            hm.triangulate(mesh, quality=quality)
        assert state(mesh) == before
        return
    hm.triangulate(mesh, quality=quality)
    hm.testing.assert_valid(mesh)
    assert mesh.is_triangular
    assert (mesh.euler_characteristic, mesh.genus, mesh.n_boundary_loops, mesh.n_vertices) == figures
    assert joined_twice(mesh) == doubled


@pytest.mark.parametrize("row", WITH_POLYGONS, ids=lambda r: r["path"])
def test_faces_of_real_files_are_covered(row, corpus):
    """Area vectors are kept; and no triangle of a flat face is turned over."""
    mesh = hm.load(corpus / row["path"])
    vectors, doubled = hm.geometry.face_vectors(mesh), joined_twice(mesh)
    parts = hm.triangulate(mesh, allow_parallel=True)
    hm.testing.assert_valid(mesh)
    new = hm.geometry.face_vectors(mesh)
    sums = np.stack([np.bincount(parts, column, minlength=len(vectors)) for column in new.T], axis=1)
    scale = np.abs(mesh.points).max() ** 2
    assert np.allclose(sums, vectors, atol=1e-13 * scale)
    assert len(joined_twice(mesh)) <= len(doubled)
