"""Vertices and faces added in bulk: all or none, and what one by one would give."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm
from bulk import columns, held, refused, rows, state
from halfmesh.core.topology import JOURNAL_SIZE, JOURNALING
from halfmesh.testing import assert_valid
from soups import SOUND, meshes_or_not

every_sound_mesh = pytest.mark.parametrize("specimen", SOUND, ids=lambda s: s.name)


# -- faces -------------------------------------------------------------------------------------------------------------


@every_sound_mesh
def test_faces_over_vertices_make_the_mesh(specimen):
    mesh = hm.Mesh([], n_vertices=specimen.figures.n_vertices)
    v = mesh.vertices[0]
    assert mesh.add_faces(specimen.faces).tolist() == list(range(len(specimen.faces)))
    assert_valid(mesh)
    assert columns(mesh) == columns(specimen.mesh())
    specimen.figures.assert_of(mesh)
    assert v.degree == specimen.mesh().vertices[0].degree  # the handle stays
    assert mesh.revision > 0


@every_sound_mesh
def test_faces_are_added_as_one_by_one(specimen):
    half = len(specimen.faces) // 2
    at_once = hm.Mesh(specimen.faces[:half], n_vertices=specimen.figures.n_vertices)
    if not half:
        at_once.add_edge(0, 1)  # or it would be built
    one_by_one, compiled = at_once.copy(), at_once.copy()
    at_once.add_faces(specimen.faces[half:])
    for face in specimen.faces[half:]:
        one_by_one.add_face(face)
    assert_valid(at_once)
    assert state(at_once) == state(one_by_one)
    with hm._jit.compiling_always():
        compiled.add_faces(specimen.faces[half:])
    assert columns(compiled) == columns(at_once)


@given(meshes_or_not(), st.integers(0, 40))
def test_faces_can_be_added_if_the_whole_can_be_held(soup, k):
    """Whatever their order, and at vertices with several fans."""
    faces, n = soup
    mesh, whole = held(faces[:k], n), held(faces, n)
    if mesh is None:
        return
    before = state(mesh)
    try:
        mesh.add_faces(faces[k:])
    except (hm.TopologyError, hm.InvalidMeshError):
        assert whole is None
        assert state(mesh) == before
    else:
        assert whole is not None
        assert_valid(mesh)
        assert rows(mesh) == rows(whole)
        assert np.array_equal(mesh.edge_vertices(), whole.edge_vertices())
        assert np.array_equal(mesh.edge_faces(), whole.edge_faces())


def test_faces_close_an_open_mesh():
    mesh = hm.Mesh([], n_vertices=8)
    cube = hm.shapes.cube()
    faces = cube.face_vertices()[0].reshape(-1, 4)
    for k in range(6):
        assert mesh.add_faces(faces[k : k + 1]).tolist() == [k]
    assert not mesh.has_boundary
    assert columns(mesh) == columns(cube) | {"vertex_halfedge": columns(mesh)["vertex_halfedge"]}


def test_faces_come_in_every_form():
    expected = columns(hm.Mesh([[0, 1, 2], [2, 1, 3]], n_vertices=4))
    flat = np.array([0, 1, 2, 2, 1, 3])
    mesh = hm.Mesh([], n_vertices=4)
    handles = [[mesh.vertices[v] for v in face] for face in ([0, 1, 2], [2, 1, 3])]
    for faces in (flat.reshape(2, 3).astype(np.uint8), [(0, 1, 2), [2, 1, 3]], (flat, np.array([0, 3, 6])), handles):
        made = mesh if faces is handles else hm.Mesh([], n_vertices=4)
        made.add_faces(faces)
        assert columns(made) == expected


def test_wire_and_parallel_edges_are_used():
    mesh = hm.Mesh([], n_vertices=4, edges=[[1, 0], [1, 2]])
    mesh.add_edge(0, 1)
    mesh.add_faces([[0, 1, 2], [1, 0, 3], [0, 1, 3]])
    assert_valid(mesh)
    assert (mesh.n_edges, mesh.n_faces) == (6, 3)


def test_faces_of_many_corners():
    n = 100
    mesh = hm.Mesh([], n_vertices=n)
    mesh.add_edge(0, 1)
    mesh.add_faces([range(n), range(n)[::-1]])
    assert_valid(mesh)
    assert (mesh.n_edges, mesh.has_boundary) == (n, False)


def test_new_faces_have_the_default():
    mesh = hm.Mesh([[0, 1, 2]], n_vertices=4)
    mesh.face_data.add("label", int, default=7)[:] = 1
    mesh.edge_data.add("crease", float, default=0.5)[:] = 0
    mesh.add_faces([[2, 1, 3]])
    assert mesh.face_data["label"].tolist() == [1, 7]
    assert mesh.edge_data["crease"].tolist() == [0, 0, 0, 0.5, 0.5]


def test_no_faces_are_no_change():
    mesh = hm.shapes.cube()
    before = state(mesh)
    assert mesh.add_faces([]).tolist() == []
    assert state(mesh) == before


# -- refusals ----------------------------------------------------------------------------------------------------------


@pytest.fixture(params=["built", "copied", "journaled", "within a transaction"])
def square(request):
    """A square 0 1 2 3 and vertices up to 9, such that faces are added in each of the ways there are."""
    mesh = hm.Mesh([[0, 1, 2, 3]], n_vertices=13)
    if request.param == "built":
        mesh = hm.Mesh([], n_vertices=13)
    if request.param == "journaled":
        mesh.append(hm.shapes.grid(20, 20))
    if request.param == "within a transaction":
        mesh.topology.__arrays__().counts[JOURNALING] = 1
        mesh.add_faces([[10, 11, 12]])
    return mesh


def test_faces_that_can_not_be_held_by_themselves_are_named(square):
    fine = [4, 5, 6]
    for faces, reason, bad in (
        ([fine, [0, 4, 9999], [4, -1, 5]], "index_out_of_range", [1, 2]),
        ([fine, [0, 4], [7, 8]], "small_face", [1, 2]),
        ([fine, [4, 4, 7], [8, 9, 9]], "repeated_vertex", [1, 2]),
        ([fine, [5, 4, 7], [4, 5, 8]], "nonmanifold_edge", [0, 1, 2]),
        ([fine, [4, 5, 7]], "inconsistent_orientation", [0, 1]),
    ):
        error = refused(square, faces, reason, hm.InvalidMeshError)
        assert error.elements["faces"].tolist() == bad


def test_what_is_no_face_list_is_refused(square):
    for faces in ([[0.5, 1, 2]], 3, [[True, False, True]], np.zeros((2, 2, 2), int)):
        refused(square, faces, None, hm.InvalidMeshError)


def test_the_first_face_that_does_not_fit_is_named():
    mesh = hm.Mesh([[0, 1, 2, 3]], n_vertices=10)
    error = refused(mesh, [[4, 5, 6], [1, 0, 7], [0, 1, 8]], "taken_halfedge")
    assert "face 2 of the list, with vertices [0, 1, 8]" in str(error)


def test_a_closed_vertex_takes_no_face():
    mesh = hm.shapes.tetrahedron()
    new = mesh.add_vertices(2)
    refused(mesh, [[0, *new.tolist()]], "closed_vertex")


def test_a_deleted_vertex_takes_no_face(square):
    square.remove_vertex(9)
    error = refused(square, [[4, 5, 6], [7, 8, 9]], None, hm.StaleElementError)
    assert "face 1" in str(error)
    assert "vertex 9" in str(error)
    square.add_faces([[6, 5, 4]])
    with pytest.raises(hm.StaleElementError):
        square.vertices[9]
    assert_valid(square)


def test_handles_of_another_mesh_are_refused():
    mesh, other = hm.Mesh([], n_vertices=3), hm.Mesh([], n_vertices=3)
    refused(mesh, [list(other.vertices)], None, hm.ElementError)


def test_a_journal_goes_on_within_a_transaction():
    mesh = hm.Mesh([], n_vertices=5)
    counts = mesh.topology.__arrays__().counts
    counts[JOURNALING] = 1
    mesh.add_faces([[0, 1, 2]])
    kept = counts[JOURNAL_SIZE]
    assert kept > 0
    refused(mesh, [[2, 1, 3], [0, 1, 4]], "taken_halfedge")
    assert counts[JOURNAL_SIZE] == kept


# -- vertices ----------------------------------------------------------------------------------------------------------


def test_vertices_are_added_with_their_points():
    mesh = hm.shapes.cube()
    mesh.vertex_data.add("label", int, default=3)
    assert mesh.add_vertices([[1, 2], [3, 4]]).tolist() == [8, 9]
    assert_valid(mesh)
    assert mesh.points[8:].tolist() == [[1, 2, 0], [3, 4, 0]]
    assert mesh.vertex_data["label"].tolist() == [3] * 10
    assert mesh.n_isolated_vertices == 2


def test_vertices_are_added_by_their_number():
    mesh = hm.Mesh([])
    assert mesh.add_vertices(1000).tolist() == list(range(1000))
    assert not mesh.has_points
    assert mesh.add_vertices(0).tolist() == []
    assert (mesh.points == 0).all()


def test_points_that_are_not_finite_are_taken_in_bulk_as_by_the_constructor():
    points = np.array([[np.nan, 1.0, 2.0], [np.inf, 0.0, -np.inf]])
    built, assigned, mesh = hm.Mesh([], points), hm.Mesh([], n_vertices=2), hm.Mesh([])
    assigned.points = points
    mesh.add_vertices(points)
    for each in (built, assigned, mesh):
        assert np.array_equal(each.points, points, equal_nan=True)


def test_what_are_no_points_is_refused():
    mesh = hm.shapes.cube()
    before = state(mesh)
    for points in (-1, [[1.0]], [["a", "b", "c"]], True):
        with pytest.raises(hm.InvalidMeshError):
            mesh.add_vertices(points)
    assert state(mesh) == before


# -- one by one --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("form", [list, tuple, np.array, np.float32, lambda p: [np.float64(x) for x in p]])
def test_a_point_may_come_in_any_form(form):
    mesh = hm.Mesh([])
    with hm._jit.compiling_always():
        for _ in range(20):
            assert mesh.add_vertex(form([1.0, 2.0, 3.0])).point.tolist() == [1, 2, 3]
        assert mesh.add_vertex([4, 5]).point.tolist() == [4, 5, 0]
        assert mesh.add_vertex().point.tolist() == [0, 0, 0]
        assert mesh.add_vertex([1e308, 1e308, 1e308]).point.tolist() == [1e308] * 3
    assert_valid(mesh)


@pytest.mark.parametrize("compiled", [False, True])
def test_no_vertex_is_added_without_its_point(compiled):
    mesh = hm.Mesh([])
    if compiled:
        with hm._jit.compiling_always():
            mesh.add_vertex([0.0, 0.0, 0.0])
    n = mesh.n_vertices
    for point in ([1.0, 2.0], "abc", [1.0, 2.0, np.inf], [1.0, np.nan, 2.0], [1.0], [[1.0, 2.0, 3.0]], [1j, 0, 0]):
        if point == [1.0, 2.0]:
            continue
        with pytest.raises(hm.InvalidMeshError):
            mesh.add_vertex(point)
    assert mesh.n_vertices == n


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize("n", [3, 4, 5])
def test_a_wrong_corner_is_named(compiled, n):
    mesh = hm.Mesh([], n_vertices=9)
    gone = mesh.vertices[8]
    mesh.remove_vertex(8)
    if compiled:
        with hm._jit.compiling_always():
            mesh.copy().add_face(list(range(n)))
    before = state(mesh)
    for wrong, error, text in (
        (8, hm.StaleElementError, "vertex 8"),
        (gone, hm.StaleElementError, "vertex 8"),
        (9, hm.ElementError, "vertex 9"),
        (-1, hm.ElementError, "vertex -1"),
        (2**70, hm.ElementError, str(2**70)),
        (1.5, hm.ElementError, "1.5"),
        (hm.shapes.cube().vertices[0], hm.ElementError, "another mesh"),
    ):
        with pytest.raises(error, match=text):
            mesh.add_face([*range(n - 1), wrong])
    assert state(mesh) == before
    assert mesh.add_face(iter(np.arange(n))).degree == n
