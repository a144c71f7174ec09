"""Very many faces that are sewn onto a mesh: what one by one would give, to the last bit, and when it is done."""

from __future__ import annotations

import contextlib
import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm
from bulk import columns, state
from halfmesh.core import adding
from halfmesh.core.facelist import as_face_list
from halfmesh.core.sewing import sewn
from halfmesh.testing import assert_valid
from soups import meshes_or_not

DONE = (hm.TopologyError, hm.InvalidMeshError, hm.StaleElementError)


@contextlib.contextmanager
def sewing_always():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(adding, "_sewing_pays", lambda t, faces: True)
        yield


@st.composite
def unfinished(draw):
    """A mesh with some of the faces of another, added by hand, with wire, gaps and deleted slots; and the rest."""
    faces, n = draw(meshes_or_not())
    k = draw(st.integers(0, len(faces)))
    mesh = hm.Mesh([], n_vertices=n)
    for face in faces[:k]:
        with contextlib.suppress(*DONE, hm.ElementError):
            mesh.add_face(face)
    for u, v in draw(st.lists(st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)), max_size=2)) if n else []:
        with contextlib.suppress(*DONE):
            mesh.add_edge(u, v)
    for f in draw(st.lists(st.integers(0, 40), max_size=2)):
        with contextlib.suppress(*DONE, hm.ElementError):
            mesh.remove_face(f)
    return mesh, faces[k:]


@given(unfinished())
def test_faces_that_are_sewn_are_added_as_one_by_one(given):
    """In every column, the order of several fans and the halfedges of the vertices included; or none is, as before."""
    mesh, faces = given
    at_once, one_by_one, before = mesh, mesh.copy(), state(mesh)
    expected = None
    try:
        for face in faces:
            one_by_one.add_face(face)
    except (*DONE, hm.ElementError) as refusal:
        expected = refusal
    if not before[0]["next"]:
        return  # would be built
    with sewing_always():
        try:
            at_once.add_faces(faces)
        except (*DONE, hm.ElementError):
            assert expected is not None
            assert state(at_once) == before
        else:
            assert expected is None
            assert state(at_once) == state(one_by_one)
            assert_valid(at_once)


@pytest.mark.parametrize("level", [2, pytest.param(6, marks=pytest.mark.large)])  # the second for threads
@pytest.mark.parametrize("order", ["as they are", "shuffled"])
@pytest.mark.parametrize("part", [0.1, 0.5, 0.9])
def test_many_faces_are_sewn(level, order, part):
    """The last of them leave a boundary, and pinched vertices where they are shuffled."""
    mesh = hm.shapes.icosphere(level)
    faces = mesh.triangles()
    if order == "shuffled":
        faces = np.random.default_rng(0).permutation(faces)
    k, rest = int(part * len(faces)), faces[: len(faces) * 19 // 20]
    at_once = hm.Mesh(rest[:k], n_vertices=mesh.n_vertices)
    one_by_one = at_once.copy()
    assert sewn(at_once.topology, as_face_list(rest[k:], mesh.n_vertices))
    for face in rest[k:].tolist():
        one_by_one.add_face(face)
    assert_valid(at_once)
    assert state(at_once) == state(one_by_one)


@pytest.mark.parametrize(
    "faces",
    [
        [[0, 1, 4], [0, 1, 5]],  # a halfedge twice
        [[4, 5, 9]],  # a vertex that was deleted
        [[0, 1, 2]],  # halfedges that have a face
        [[4, 5, 6, 4, 7, 8]],  # a vertex twice
        [[10, 11, 5]],  # beside parallel edges
    ],
)
def test_what_can_not_be_sewn_is_left_as_it_was(faces):
    mesh = hm.Mesh([[0, 1, 2, 3]], n_vertices=12)
    mesh.add_edge(10, 11), mesh.add_edge(10, 11)
    mesh.remove_vertex(9)
    before = state(mesh)
    assert not sewn(mesh.topology, as_face_list(faces, 12))
    assert state(mesh) == before


@pytest.mark.parametrize("other", ["a fan", "wire"])
def test_one_of_several_fans_can_not_be_closed(other):
    mesh = hm.Mesh([[0, 1, 2], [0, 2, 3]], n_vertices=6)
    mesh.add_face([0, 4, 5]) if other == "a fan" else mesh.add_edge(0, 4)
    before = state(mesh)
    assert not sewn(mesh.topology, as_face_list([[0, 3, 1]], 6))
    assert state(mesh) == before


def test_faces_between_many_parallel_edges_are_left_to_be_added_one_by_one():
    mesh = hm.Mesh([], n_vertices=4)
    edges = [mesh.add_edge(0, 1).halfedge for _ in range(50)]
    for a, b in itertools.pairwise(edges):
        mesh.add_face(halfedges=[a, b.twin])
    before = state(mesh)
    assert not sewn(mesh.topology, as_face_list([[1, 0, 2]], 4))
    assert state(mesh) == before


def test_attributes_and_handles_follow_what_is_sewn():
    grid = hm.shapes.grid(10, 10)
    faces = grid.face_vertices()[0].reshape(-1, 4)
    mesh = hm.Mesh(faces[:50], grid.points)
    mesh.face_data.add("label", int, default=7)[:] = 1
    mesh.edge_data.add("crease", float, default=0.5)[:] = 0
    face, n_edges = mesh.faces[0], mesh.n_edges
    with sewing_always():
        mesh.add_faces(faces[50:])
    assert mesh.face_data["label"].tolist() == [1] * 50 + [7] * 50
    assert mesh.edge_data["crease"].tolist() == [0] * n_edges + [0.5] * (mesh.n_edges - n_edges)
    assert [v.index for v in face.vertices()] == faces[0].tolist()
    assert_valid(mesh)


def test_what_was_sewn_in_a_transaction_is_taken_back():
    grid = hm.shapes.grid(40, 40)
    faces = grid.face_vertices()[0].reshape(-1, 4)
    mesh = hm.Mesh(faces[:200], n_vertices=grid.n_vertices)
    before = columns(mesh)
    with mesh.transaction() as attempt:
        mesh.add_faces(faces[200:])
        attempt.rollback()
    assert columns(mesh) == before


@contextlib.contextmanager
def roads_taken(fewest, vertices_a_face, threads=1):
    """Whether sewing was tried, each time; from so many faces on."""
    tried = []

    def trying(t, faces):
        tried.append(True)
        return sewn(t, faces)

    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HALFMESH_NUM_THREADS", str(threads))
        patch.setattr(adding, "_FEWEST_SEWN", fewest)
        patch.setattr(adding, "_VERTICES_A_FACE", vertices_a_face)
        patch.setattr(adding, "sewn", trying)
        yield tried


GRID = hm.shapes.grid(20, 20).face_vertices()[0].reshape(-1, 4)
ROWS = np.arange(400) < 200
SCATTER = np.random.default_rng(0).permutation(40_000)


@pytest.mark.parametrize(
    ("faces", "first", "pays"),
    [
        (GRID, ROWS, True),  # two halves, which meet along a seam
        (GRID, np.arange(400) % 2 == 0, False),  # every vertex has old and new faces
        (SCATTER[GRID], np.arange(400) % 2 == 0, True),  # the same, but far apart
        (SCATTER[GRID], ROWS, True),
    ],
)
def test_faces_are_sewn_if_they_are_scattered_or_meet_what_is_there_along_a_seam(faces, first, pays):
    mesh = hm.Mesh(faces[first], n_vertices=40_000)
    with roads_taken(fewest=200, vertices_a_face=200) as tried:
        mesh.add_faces(faces[~first])
    assert tried == [True] * pays
    assert_valid(mesh)


@pytest.mark.parametrize(
    ("fewest", "n_vertices", "threads", "pays"),
    [
        (200, 600, 1, True),
        (201, 600, 1, False),  # too few faces
        (400, 600, 2, True),  # half as many will do
        (200, 601, 1, False),  # too many vertices
    ],
)
def test_few_faces_are_not_sewn_nor_are_they_over_many_vertices(fewest, n_vertices, threads, pays):
    mesh = hm.Mesh(GRID[ROWS], n_vertices=n_vertices)
    with roads_taken(fewest, vertices_a_face=3, threads=threads) as tried:
        mesh.add_faces(GRID[~ROWS])
    assert tried == [True] * pays


def test_nothing_is_sewn_in_a_transaction():
    mesh = hm.Mesh(GRID[ROWS], n_vertices=441)
    with roads_taken(fewest=200, vertices_a_face=3) as tried, mesh.transaction():
        mesh.add_faces(GRID[~ROWS])
    assert tried == []


def test_corners_out_of_range_are_refused_where_sewing_was_tried():
    mesh = hm.Mesh(GRID[ROWS], n_vertices=441)
    before = state(mesh)
    with roads_taken(fewest=200, vertices_a_face=3) as tried, pytest.raises(hm.InvalidMeshError):
        mesh.add_faces(np.where(GRID[~ROWS] == 440, 441, GRID[~ROWS]))
    assert tried == [True]
    assert state(mesh) == before
