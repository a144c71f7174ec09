"""Transactions: after an exception everything is as it was, bit for bit."""

from __future__ import annotations

import pickle
import random

import pytest

import halfmesh as hm
from halfmesh.testing import assert_valid, zoo
from wandering import ATTRIBUTES, COMPACTION, everything, fail, furnish, wander

ZOO = zoo()
SORTS = {"operators": (), "attributes": 3 * ATTRIBUTES, "compaction": COMPACTION, "all": ATTRIBUTES + COMPACTION}


@pytest.mark.parametrize("sort", SORTS)
@pytest.mark.parametrize("name", ZOO)
def test_rolled_back_mesh_holds_what_it_held(name, sort):
    mesh, rng = furnish(ZOO[name].mesh()), random.Random(name + sort)
    wander(mesh, rng, 5)
    for _ in range(3):
        before = everything(mesh)
        fail(mesh, lambda mesh: wander(mesh, rng, 25, also=SORTS[sort]))
        assert everything(mesh) == before
        assert_valid(mesh)


@pytest.mark.parametrize("name", ZOO)
def test_rolled_back_mesh_goes_on_like_one_where_nothing_happened(name):
    mesh, twin = furnish(ZOO[name].mesh()), furnish(ZOO[name].mesh())
    for seed in range(3):
        fail(mesh, lambda mesh: wander(mesh, random.Random(name), 25, also=ATTRIBUTES + COMPACTION))
        wander(mesh, random.Random(seed), 10)
        wander(twin, random.Random(seed), 10)
        assert everything(mesh) == everything(twin)


def nest(mesh, rng, depth=0):
    """Transactions inside each other, of which some are rolled back, with arrays in hand or without."""
    before = everything(mesh)
    held = [mesh.points] if rng.random() < 0.3 else []
    with mesh.transaction() as attempt:
        for _ in range(rng.randrange(1, 4)):
            wander(mesh, rng, rng.randrange(10), also=ATTRIBUTES + COMPACTION)
            for points in held:
                points[:] = rng.random()
            if depth < 3 and rng.random() < 0.6:
                nest(mesh, rng, depth + 1)
        is_rolled_back = rng.random() < 0.6
        if is_rolled_back:
            attempt.rollback()
    assert not is_rolled_back or everything(mesh) == before
    assert_valid(mesh)


@pytest.mark.parametrize("name", ZOO)
def test_transactions_inside_each_other(name):
    mesh, rng = furnish(ZOO[name].mesh()), random.Random(name)
    for _ in range(4):
        nest(mesh, rng)


@pytest.mark.parametrize("name", ZOO)
def test_what_is_not_rolled_back_stays(name):
    mesh, twin = furnish(ZOO[name].mesh()), furnish(ZOO[name].mesh())
    with mesh.transaction():
        wander(mesh, random.Random(name), 25, also=ATTRIBUTES + COMPACTION)
    wander(twin, random.Random(name), 25, also=ATTRIBUTES + COMPACTION)
    assert everything(mesh) == everything(twin)


def test_rows_of_what_was_made_between_are_not_put_back_by_the_outermost():
    mesh = furnish(hm.shapes.cube())
    before = everything(mesh)

    def change(mesh):
        mesh.split_face(0)
        with mesh.transaction():
            v = mesh.split_face(1)
            with mesh.transaction():
                v.point = [3.0, 3.0, 3.0]
                mesh.vertices[0].point = v.point

    fail(mesh, change)
    assert everything(mesh) == before


def test_rollback_begins_anew_and_the_block_goes_on():
    mesh = hm.shapes.cube()
    with mesh.transaction() as attempt:
        mesh.split_face(0)
        attempt.rollback()
        assert mesh.n_vertices == 8
        mesh.split_edge(0)
        attempt.rollback()
        mesh.remove_face(1)
        assert attempt.is_open
    assert (mesh.n_vertices, mesh.n_faces) == (8, 5)
    assert not attempt.is_open


def test_outer_rollback_ends_what_is_open_inside():
    mesh = furnish(hm.shapes.cube())
    before = everything(mesh)
    with mesh.transaction() as outer:
        mesh.split_face(0)
        with mesh.transaction() as inner:
            mesh.points[:] = 3.0
            mesh.split_face(1)
            outer.rollback()
            assert not inner.is_open
    assert everything(mesh) == before


def test_transaction_that_is_not_open_says_so():
    mesh = hm.shapes.cube()
    attempt = mesh.transaction()
    with pytest.raises(RuntimeError, match="not open"):
        attempt.rollback()
    with attempt, pytest.raises(RuntimeError, match="open already"):
        attempt.__enter__()


def test_interrupt_rolls_back_too():
    mesh = hm.shapes.cube()

    def interrupted():
        with mesh.transaction():
            mesh.split_face(0)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert mesh.n_vertices == 8


def test_revision_goes_on_so_that_nothing_kept_is_believed():
    mesh = hm.shapes.cube()
    revision = mesh.revision
    with mesh.transaction() as attempt:
        mesh.remove_face(0)
        assert mesh.n_boundary_loops == 1
        attempt.rollback()
        assert mesh.n_boundary_loops == 0
    assert mesh.revision > revision
    revision = mesh.revision
    fail(mesh, lambda mesh: None)
    assert mesh.revision == revision


def test_copies_made_inside_are_in_no_transaction():
    mesh = hm.shapes.cube()
    with mesh.transaction():
        mesh.split_face(0)
        for twin in (mesh.copy(), pickle.loads(pickle.dumps(mesh))):
            twin.split_face(1)
            fail(twin, lambda twin: twin.split_face(2))
            assert (twin.n_vertices, mesh.n_vertices) == (10, 9)
