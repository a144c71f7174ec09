"""Transactions and handles: those from before are good as before, those of what was undone are stale for ever."""

from __future__ import annotations

import gc
import weakref

import numpy as np
import pytest

import halfmesh as hm
from wandering import fail


def test_handles_from_before_are_good_as_before():
    mesh = hm.shapes.cube()
    v, h, e, f = mesh.vertices[0], mesh.halfedges[3], mesh.edges[2], mesh.faces[1]
    fail(mesh, lambda mesh: mesh.split_face(0))
    assert (v.degree, h.next.prev, e.halfedge.edge, f.degree) == (3, h, e, 4)
    assert (v, h, e, f) == (mesh.vertices[0], mesh.halfedges[3], mesh.edges[2], mesh.faces[1])
    assert mesh.split_edge(e).degree == 2


def test_handles_of_what_was_made_in_it_are_stale_for_ever():
    mesh = hm.shapes.cube()
    made = []

    def change(mesh):
        v = mesh.split_face(0)
        made.extend([v, v.halfedge, v.halfedge.edge, mesh.faces[6]])

    fail(mesh, change)
    mesh.split_face(1)  # other elements with these indices
    for handle in made:
        assert not handle.is_alive
        with pytest.raises(hm.StaleElementError, match="rolled back"):
            handle.halfedge if not isinstance(handle, hm.Halfedge) else handle.next
        assert handle not in getattr(mesh, handle.plural)
        assert handle != getattr(mesh, handle.plural)[handle.index]
    with pytest.raises(hm.StaleElementError):
        mesh.collapse(made[1])
    with pytest.raises(hm.StaleElementError):
        made[0].point = [0, 0, 0]


def test_handle_from_before_steps_to_what_comes_after():
    mesh = hm.shapes.cube()
    v = mesh.vertices[0]
    fail(mesh, lambda mesh: mesh.split_face(0))
    middle = mesh.split_face(0)
    assert middle in v.neighbors()
    assert middle.degree == 4


@pytest.mark.parametrize("word", ["halfedge", "point", "degree", "is_boundary", "is_alive", "is_isolated"])
def test_every_word_finds_its_way_after_a_rollback(word):
    mesh = hm.shapes.cube()
    v = mesh.vertices[0]
    fail(mesh, lambda mesh: mesh.split_face(0))
    assert np.all(getattr(v, word) == getattr(mesh.vertices[0], word))


def test_handle_lives_through_many_rollbacks_untouched():
    mesh = hm.shapes.cube()
    v = mesh.vertices[0]
    carriers = []
    for _ in range(20):
        carriers.append(weakref.ref(mesh._t))
        fail(mesh, lambda mesh: mesh.split_face(0))
    gc.collect()
    assert sum(carrier() is not None for carrier in carriers) == 1  # the first, which the handle holds
    assert v.degree == 3


def test_inner_rollback_keeps_the_handles_of_the_outer_transaction_until_that_ends():
    mesh = hm.shapes.cube()
    kept = []

    def change(mesh):
        kept.append(mesh.split_face(0))
        fail(mesh, lambda mesh: kept.append(mesh.split_face(1)))
        assert (kept[0].degree, kept[1].is_alive) == (4, False)

    fail(mesh, change)
    assert [v.is_alive for v in kept] == [False, False]


def test_handles_from_before_come_back_with_a_compaction_that_is_rolled_back():
    mesh = hm.shapes.cube()
    mesh.remove_vertex(0)
    v, made, inside = mesh.vertices[5], [], []

    def change(mesh):
        made.append(mesh.add_vertex())
        mesh.compact()
        inside.append(mesh.vertices[5])
        assert not v.is_alive
        mesh.split_face(0)

    fail(mesh, change)
    assert v == mesh.vertices[5]
    assert v.is_alive
    for gone in (made[0], inside[0]):
        with pytest.raises(hm.StaleElementError, match="rolled back"):
            gone.degree  # noqa: B018 - the word is the test


def test_walk_that_is_under_way_notices():
    mesh = hm.shapes.cube()
    walk = mesh.vertices[0].outgoing()
    next(walk)
    fail(mesh, lambda mesh: mesh.split_face(0))
    with pytest.raises(hm.StaleElementError):
        list(walk)
