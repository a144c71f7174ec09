"""Stable ids: they stay with their elements through compaction, copies and rollbacks, and are never given twice."""

from __future__ import annotations

import copy
import pickle
import random

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.testing import zoo
from wandering import COMPACTION, wander

ZOO = zoo()
KINDS = ("vertices", "halfedges", "edges", "faces")


def mark(mesh):
    """Write ids beside the elements, where they follow compaction by the library's other means."""
    for kind, table in zip(KINDS, (mesh.vertex_data, mesh.halfedge_data, mesh.edge_data, mesh.face_data), strict=True):
        table["id"] = getattr(mesh.ids, kind)


def found(mesh, kind, id):
    finders = {
        "vertices": mesh.ids.find_vertex,
        "halfedges": mesh.ids.find_halfedge,
        "edges": mesh.ids.find_edge,
        "faces": mesh.ids.find_face,
    }
    return finders[kind](id)


def assert_round(mesh):
    """From every living element to its id and back."""
    for kind in KINDS:
        for element in getattr(mesh, kind):
            assert found(mesh, kind, mesh.ids.of(element)) == element


def test_ids_are_indices_at_first():
    mesh = hm.shapes.cube()
    for kind in KINDS:
        assert np.array_equal(getattr(mesh.ids, kind), np.arange(len(getattr(mesh, kind))))


@pytest.mark.parametrize("name", ZOO)
def test_ids_stay_with_elements_through_compaction(name):
    mesh, rng = ZOO[name].mesh(), random.Random(name)
    assert len(mesh.ids.vertices) == mesh.n_vertices
    for _ in range(4):
        wander(mesh, rng, 8)
        mark(mesh)
        mesh.compact()
        assert np.array_equal(mesh.ids.vertices, mesh.vertex_data["id"])
        assert np.array_equal(mesh.ids.halfedges, mesh.halfedge_data["id"])
        assert np.array_equal(mesh.ids.edges, mesh.edge_data["id"])
        assert np.array_equal(mesh.ids.faces, mesh.face_data["id"])
        assert_round(mesh)


@pytest.mark.parametrize("name", ZOO)
def test_ids_ascend(name):
    mesh, rng = ZOO[name].mesh(), random.Random(name)
    for _ in range(4):
        wander(mesh, rng, 8, also=COMPACTION)
        for kind in KINDS:
            assert (np.diff(getattr(mesh.ids, kind)) > 0).all()


def test_deleted_element_is_not_found():
    mesh = hm.shapes.cube()
    id = mesh.ids.of(mesh.faces[2])
    mesh.remove_face(2)
    assert mesh.ids.find_face(id) is None
    mesh.compact()
    assert mesh.ids.find_face(id) is None
    assert mesh.ids.find_face(3).index == 2


def test_ids_are_not_given_again():
    mesh = hm.shapes.cube()
    last = mesh.ids.of(mesh.faces[5])
    mesh.remove_face(5)
    mesh.compact()
    mesh.split_face(0)
    assert mesh.ids.faces.tolist()[5:] == [last + 1, last + 2, last + 3]


@pytest.mark.parametrize("id", [-1, 8, 10**6])
def test_what_never_was_is_not_found(id):
    assert hm.shapes.cube().ids.find_vertex(id) is None


def test_halfedge_ids_follow_from_edge_ids():
    mesh = hm.shapes.cube()
    mesh.remove_edge(0)
    h = mesh.halfedges[7]
    id = mesh.ids.of(h)
    mesh.compact()
    assert mesh.ids.find_halfedge(id).index == 5
    assert id == 2 * mesh.ids.of(mesh.ids.find_halfedge(id).edge) + 1


def test_nothing_is_kept_for_who_does_not_ask():
    mesh = hm.shapes.cube()
    mesh.remove_vertex(0)
    mesh.compact()
    assert mesh._numbers is None


def test_stale_and_foreign_handles_have_no_id():
    mesh = hm.shapes.cube()
    f = mesh.faces[0]
    mesh.remove_face(f)
    with pytest.raises(hm.StaleElementError):
        mesh.ids.of(f)
    with pytest.raises(hm.ElementError):
        mesh.ids.of(hm.shapes.cube().faces[1])
    with pytest.raises(TypeError, match="handle"):
        mesh.ids.of(3)


@pytest.mark.parametrize("twin", [hm.Mesh.copy, copy.deepcopy, lambda mesh: pickle.loads(pickle.dumps(mesh))])
def test_copies_have_the_same_ids_and_go_their_own_way(twin):
    mesh = hm.shapes.cube()
    mesh.ids.of(mesh.vertices[0])
    mesh.remove_vertex(2)
    mesh.compact()
    other = twin(mesh)
    assert np.array_equal(other.ids.vertices, mesh.ids.vertices)
    other.add_vertex()
    assert other.ids.vertices[-1] == 8
    assert len(mesh.ids.vertices) == 7


def test_array_that_was_handed_out_does_not_change():
    mesh = hm.shapes.cube()
    ids = mesh.ids.vertices
    with mesh.transaction() as attempt:
        mesh.add_vertex()
        inside = mesh.ids.vertices
        attempt.rollback()
        mesh.add_vertex()
        assert mesh.ids.vertices[-1] == 9
    mesh.remove_vertex(0)
    mesh.compact()
    assert ids.tolist() == list(range(8))
    assert inside.tolist() == list(range(9))
    with pytest.raises(ValueError, match="read-only"):
        ids[0] = 3


# -- and transactions --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ZOO)
def test_ids_are_as_they_were_after_a_rollback(name):
    mesh, rng = ZOO[name].mesh(), random.Random(name)
    for also in ((), COMPACTION):
        wander(mesh, rng, 5, also=also)
        before = {kind: getattr(mesh.ids, kind).tolist() for kind in KINDS}
        with mesh.transaction() as attempt:
            wander(mesh, rng, 20, also=also)
            assert len(mesh.ids.vertices) == len(mesh.topology.vertex_halfedge)
            attempt.rollback()
        assert {kind: getattr(mesh.ids, kind).tolist() for kind in KINDS} == before
        assert_round(mesh)


def test_id_from_a_transaction_that_was_rolled_back_is_not_given_again():
    mesh = hm.shapes.cube()
    with mesh.transaction() as attempt:
        id = mesh.ids.of(mesh.split_face(0))
        attempt.rollback()
    assert mesh.ids.of(mesh.split_face(0)) != id
    assert mesh.ids.find_vertex(id) is None


def test_ids_first_asked_for_after_a_compaction_in_a_transaction_hold_after_it():
    mesh = hm.shapes.cube()
    with mesh.transaction() as attempt:
        mesh.remove_vertex(0)
        mesh.compact()
        id = mesh.ids.of(mesh.vertices[4])  # which was the sixth
        attempt.rollback()
    assert mesh.ids.find_vertex(id).index == 5


def test_ids_hold_through_a_transaction_inside_another():
    mesh = hm.shapes.cube()
    id = mesh.ids.of(mesh.vertices[7])
    with mesh.transaction() as outer:
        mesh.remove_vertex(0)
        with mesh.transaction():
            mesh.compact()
            mesh.remove_vertex(0)
            mesh.compact()
        assert mesh.ids.find_vertex(id).index == 5
        outer.rollback()
    assert mesh.ids.find_vertex(id).index == 7
