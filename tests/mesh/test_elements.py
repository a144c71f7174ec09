"""Handles: every word of the API against the slow twin, and what a handle is (D5, D6, D8, Q1-Q8, Q10)."""

from __future__ import annotations

import copy
import gc
import pickle
import weakref

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.core.topology import DELETED, N_DEAD_EDGES, N_DEAD_FACES, N_DEAD_VERTICES, N_EXTERIOR
from reference import Reference

ZOO = hm.testing.zoo()
every_mesh = pytest.mark.parametrize("specimen", ZOO.values(), ids=ZOO)


def pair(specimen):
    return specimen.mesh(), Reference(specimen.faces, specimen.figures.n_vertices, specimen.twins, specimen.edges)


def ids(handles):
    return [None if x is None else x.index for x in handles]


def none_if_missing(index):
    return None if index == -1 else index


@pytest.fixture
def mesh():
    return ZOO["mixed degrees"].mesh()


# ---------------------------------------------------------------------------------------------------------- every word


@every_mesh
def test_words_of_a_halfedge(specimen):
    """D5, D6, D9, Q3-Q5."""
    mesh, twin = pair(specimen)
    for h in mesh.halfedges:
        i = h.index
        steps = (h.twin, h.next, h.prev, h.ccw, h.cw, h.origin, h.target, h.edge, h.face)
        expected = [i ^ 1, twin.next(i), twin.prev(i), twin.ccw(i), twin.cw(i), twin.origin[i], twin.target(i), i // 2]
        assert ids(steps) == [*expected, none_if_missing(twin.face_of[i])]
        assert h.is_exterior == (twin.face_of[i] == -1)
        assert h.is_boundary == (-1 in (twin.face_of[i], twin.face_of[i ^ 1]))


@every_mesh
def test_words_of_a_vertex(specimen):
    """Q1, Q7, Q8, Q10."""
    mesh, twin = pair(specimen)
    for v in mesh.vertices:
        ring = twin.ring[v.index]
        assert ids([v.halfedge]) == [ring[-1] if ring else None]
        assert v.degree == len(ring)
        assert ids(v.outgoing()) == ring
        assert ids(v.incoming()) == [h ^ 1 for h in ring]
        assert ids(v.neighbors()) == twin.neighbors(v.index)
        assert ids(v.edges()) == [h // 2 for h in ring]
        assert ids(v.faces()) == twin.faces_around(v.index)
        assert v.is_isolated == (not ring)
        assert v.is_boundary == twin.touches_gap(v.index)


@every_mesh
def test_words_of_an_edge(specimen):
    """Q7: left and right faces, two endpoints."""
    mesh, twin = pair(specimen)
    for e in mesh.edges:
        h = 2 * e.index
        sides = [none_if_missing(twin.face_of[h]), none_if_missing(twin.face_of[h + 1])]
        assert e.halfedge.index == h
        assert ids(e.vertices) == [twin.origin[h], twin.origin[h + 1]]
        assert ids(e.faces) == sides
        assert e.is_boundary == (None in sides)


@every_mesh
def test_words_of_a_face(specimen):
    """Q1, Q7, Q8, I9."""
    mesh, twin = pair(specimen)
    for f in mesh.faces:
        loop = twin.loop[f.index]
        assert f.halfedge.index == loop[0]
        assert f.degree == len(loop)
        assert ids(f.vertices()) == twin.faces[f.index]
        assert ids(f.halfedges()) == loop
        assert ids(f.edges()) == [h // 2 for h in loop]
        assert ids(f.neighbors()) == twin.face_neighbors(f.index)


@every_mesh
def test_halfedge_between_two_vertices_is_found_if_there_is_one(specimen):
    """Q9 findSomeHalf; of parallel edges, any."""
    mesh, twin = pair(specimen)
    for u in range(twin.n_vertices):
        for v in range(twin.n_vertices):
            found = mesh.find_halfedge(u, v)
            there = [h for h in twin.ring[u] if twin.target(h) == v]
            assert (found is None) if not there else (found.index in there)


def test_words_of_length_and_place():
    mesh = hm.Mesh([[0, 1, 2]], [(0, 0), (3, 0), (0, 4)])
    assert [e.length for e in mesh.edges] == [3, 5, 4]
    assert [h.length for h in mesh.halfedges] == [3, 3, 5, 5, 4, 4]
    assert mesh.vertices[1].point.tolist() == [3, 0, 0]
    mesh.vertices[1].point[:] = (6, 8, 0)
    assert mesh.edges[0].length == 10


# ------------------------------------------------------------------------------------------------- what a handle is


def test_handles_of_one_element_are_equal_and_hash_alike(mesh):
    """D8."""
    h = mesh.halfedges[3]
    assert h == mesh.halfedges[3] == h.twin.twin
    assert len({h, mesh.halfedges[3], h.next.prev}) == 1
    assert h != mesh.halfedges[2]


def test_handles_of_different_kinds_or_meshes_are_different(mesh):
    assert mesh.vertices[0] != mesh.faces[0]
    assert mesh.vertices[0] != mesh.copy().vertices[0]
    assert mesh.vertices[0] != 0


def test_handles_of_a_kind_are_ordered_by_index(mesh):
    assert ids(sorted(mesh.vertices, reverse=True)) == [6, 5, 4, 3, 2, 1, 0]
    a, b = mesh.edges[1], mesh.edges[2]
    assert a < b
    assert a <= b
    assert b > a
    assert b >= a
    assert a <= mesh.edges[1] <= a
    assert not a > b


@pytest.mark.parametrize("other", [lambda m: m.edges[0], lambda m: m.copy().vertices[0], lambda m: 0])
def test_handles_that_do_not_compare_are_not_ordered(mesh, other):
    with pytest.raises(TypeError):
        mesh.vertices[1] < other(mesh)  # noqa: B015 - it raises
    with pytest.raises(TypeError):
        mesh.vertices[1] >= other(mesh)  # noqa: B015


def test_handle_is_an_index_of_arrays(mesh):
    assert np.arange(10)[mesh.vertices[4]] == 4
    assert [*"abcdefg"][mesh.vertices[2]] == "c"


def test_handle_knows_its_mesh_and_its_name(mesh):
    v = mesh.vertices[2]
    assert v.mesh is mesh
    assert (repr(v), str(mesh.halfedges[5])) == ("Vertex(2)", "Halfedge(5)")


def test_handle_can_be_made_from_mesh_and_index(mesh):
    assert hm.Vertex(mesh, 2) == mesh.vertices[2]
    for wrong in (-1, 7, 2.0, True, mesh.faces[0]):
        with pytest.raises(hm.ElementError):
            hm.Vertex(mesh, wrong)


def test_dropping_a_handle_leaves_the_element(mesh):
    """D8."""
    h = mesh.halfedges[0]
    del h
    assert mesh.halfedges[0].is_alive


def test_handle_can_not_be_pickled_without_its_mesh(mesh):
    with pytest.raises(TypeError, match="pickle the mesh"):
        pickle.dumps(mesh.vertices[0])


def test_mesh_is_freed_when_its_last_name_goes():
    """No cycle keeps the columns of large meshes until the collector comes round."""
    mesh = ZOO["cube"].mesh()
    list(mesh.vertices)
    mesh.summary()
    gone = weakref.ref(mesh)
    gc.disable()
    try:
        del mesh
        assert gone() is None
    finally:
        gc.enable()


def test_handle_without_its_mesh_still_walks_and_says_so_when_asked_for_the_mesh():
    v = hm.Mesh([[0, 1, 2]], [(0, 0), (3, 0), (0, 4)]).vertices[1]
    assert ids(v.neighbors()) == [2, 0]
    assert v.point.tolist() == [3, 0, 0]
    with pytest.raises(hm.StaleElementError, match="gone"):
        v.mesh  # noqa: B018 - it raises


# ------------------------------------------------------------------------------------------------------- which element


WRONG = {
    "negative": -1,
    "beyond": 7,
    "far beyond": 10**30,
    "bool": True,
    "numpy bool": np.True_,
    "float": 1.0,
    "text": "1",
    "None": None,
    "slice": slice(2),
    "tuple": (0,),
    "array": np.array([1, 2]),
}


@pytest.mark.parametrize("index", WRONG.values(), ids=WRONG)
def test_what_is_no_vertex_is_refused_everywhere(mesh, index):
    with pytest.raises(hm.ElementError):
        mesh.vertices[index]
    with pytest.raises(IndexError):
        mesh.find_halfedge(index, 0)
    with pytest.raises(hm.HalfmeshError):
        mesh.find_halfedge(0, index)
    assert index not in mesh.vertices


@pytest.mark.parametrize("kind", ["vertices", "halfedges", "edges", "faces"])
def test_indices_run_from_zero_to_the_number_of_slots(mesh, kind):
    collection = getattr(mesh, kind)
    n = len(collection)
    assert ids(collection) == list(range(n)) == collection.indices.tolist()
    assert collection[n - 1].index == n - 1
    assert (0 in collection, n - 1 in collection, n in collection, -1 in collection) == (True, True, False, False)
    with pytest.raises(hm.ElementError, match=str(n - 1)):
        collection[n]
    assert f"<{n} " in repr(collection)


@pytest.mark.parametrize("dtype", [np.int8, np.int32, np.uint64, np.intp])
def test_numpy_integers_are_indices(mesh, dtype):
    assert mesh.vertices[dtype(3)] == mesh.vertices[3]
    assert type(mesh.vertices[dtype(3)].index) is int


def test_handle_of_the_wrong_kind_is_refused(mesh):
    with pytest.raises(hm.ElementError, match="vertex"):
        mesh.vertices[mesh.halfedges[0]]
    assert mesh.edges[0] not in mesh.faces


def test_handle_of_another_mesh_is_refused(mesh):
    """Also of a copy: what looks alike is another element."""
    stranger = mesh.copy().vertices[0]
    with pytest.raises(hm.ElementError, match="another mesh"):
        mesh.vertices[stranger]
    with pytest.raises(hm.ElementError):
        mesh.find_halfedge(0, stranger)
    assert stranger not in mesh.vertices


def test_handles_and_ints_are_accepted_alike(mesh):
    assert mesh.find_halfedge(mesh.vertices[1], np.int64(2)) == mesh.find_halfedge(1, 2)
    assert mesh.vertices[mesh.vertices[3]] == mesh.vertices[3]


def test_there_are_no_elements_in_an_empty_mesh():
    mesh = hm.Mesh([])
    for collection in (mesh.vertices, mesh.halfedges, mesh.edges, mesh.faces):
        assert list(collection) == []
        assert 0 not in collection
        with pytest.raises(hm.ElementError, match="there are no"):
            collection[0]


# ---------------------------------------------------------------------------------------------------- stale elements


def without_first_island():
    """The triangle of "islands" deleted by hand, as operators will do it: marks in all columns, counts kept."""
    mesh = ZOO["islands"].mesh()
    handles = mesh.vertices[0], mesh.halfedges[0], mesh.halfedges[3], mesh.edges[1], mesh.faces[0]
    arrays = mesh.topology.__arrays__()
    for column in (arrays.next, arrays.prev, arrays.origin, arrays.face):
        column[:6] = DELETED
    arrays.vertex_halfedge[:3] = DELETED
    arrays.face_halfedge[0] = DELETED
    arrays.counts[[N_DEAD_VERTICES, N_DEAD_EDGES, N_DEAD_FACES]] = 3, 3, 1
    arrays.counts[N_EXTERIOR] -= 3
    mesh.check()
    return mesh, handles


VERTEX_WORDS = [
    "halfedge",
    "point",
    "degree",
    "is_boundary",
    "is_isolated",
    "outgoing",
    "incoming",
    "neighbors",
    "edges",
    "faces",
]
HALFEDGE_WORDS = [
    *("twin", "next", "prev", "ccw", "cw", "origin", "target", "edge", "face"),
    *("is_exterior", "is_boundary", "length"),
]
EDGE_WORDS = ["halfedge", "vertices", "faces", "is_boundary", "length"]
FACE_WORDS = ["halfedge", "degree", "vertices", "halfedges", "edges", "neighbors"]
STALE = [
    (i, word)
    for i, words in enumerate([VERTEX_WORDS, HALFEDGE_WORDS, HALFEDGE_WORDS, EDGE_WORDS, FACE_WORDS])
    for word in words
]


@pytest.mark.parametrize(("which", "word"), STALE)
def test_every_word_of_a_deleted_element_raises(which, word):
    """Q10, rule 9: StaleElementError, never another element."""
    mesh, handles = without_first_island()
    with pytest.raises(hm.StaleElementError, match="deleted"):
        asked(handles[which], word)
    assert mesh.n_faces == 1


def asked(handle, word):
    answer = getattr(handle, word)
    return list(answer())


def test_the_lists_of_words_are_complete():
    """A word that is added to a handle is tried on a deleted element too."""
    for kind, words in (
        (hm.Vertex, VERTEX_WORDS),
        (hm.Halfedge, HALFEDGE_WORDS),
        (hm.Edge, EDGE_WORDS),
        (hm.Face, FACE_WORDS),
    ):
        public = {name for name in dir(kind) if not name.startswith("_")}
        assert public - {"index", "kind", "plural", "column", "mesh", "is_alive"} == set(words)


def test_deleted_elements_are_not_found_again():
    mesh, (v, h, *_) = without_first_island()
    assert not v.is_alive
    assert (v in mesh.vertices, h in mesh.halfedges, 0 in mesh.faces, 1 in mesh.faces) == (False, False, False, True)
    with pytest.raises(hm.StaleElementError):
        mesh.vertices[0]
    with pytest.raises(hm.StaleElementError):
        mesh.find_halfedge(v, 5)


def test_counts_are_of_the_living_and_indices_of_slots():
    mesh, _ = without_first_island()
    hm.testing.assert_valid(mesh)
    hm.testing.Figures(8, 5, 1, 1, 4, 0, 3).assert_of(mesh)
    assert mesh.vertices.indices.tolist() == list(range(3, 11))
    assert ids(mesh.halfedges) == list(range(6, 16))
    assert ids(mesh.faces) == [1]
    assert len(mesh.points) == 11


def test_tables_have_empty_rows_for_the_deleted():
    mesh, _ = without_first_island()
    assert mesh.face_vertices()[1].tolist() == [0, 0, 5]
    assert mesh.vertex_neighbors()[1].tolist() == [0, 0, 0, 0, 0, 2, 4, 6, 8, 10, 10, 10]
    assert mesh.edge_vertices()[:4].tolist() == [[-1, -1], [-1, -1], [-1, -1], [4, 5]]
    assert mesh.edge_faces()[2:4].tolist() == [[-1, -1], [1, -1]]
    assert len(mesh.boundary_loops()) == 1
    assert mesh.components().vertex_component.tolist() == [-1, -1, -1, 0, 1, 1, 1, 1, 1, 2, 3]
    assert (mesh.vertex_degrees()[:3].tolist(), mesh.face_degrees().tolist()) == ([0, 0, 0], [0, 5])


def test_copies_keep_the_deleted_deleted():
    mesh, _ = without_first_island()
    for again in (mesh.copy(), copy.deepcopy(mesh), pickle.loads(pickle.dumps(mesh))):
        hm.testing.assert_valid(again)
        assert 0 not in again.vertices


def test_point_of_a_vertex_can_be_assigned_and_added_to():
    mesh = hm.shapes.cube()
    v = mesh.vertices[0]
    v.point = (1, 2, 3)
    v.point += 1
    assert mesh.points[0].tolist() == [2, 3, 4]
