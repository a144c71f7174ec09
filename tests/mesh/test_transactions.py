"""Transactions: after an exception everything is as it was, bit for bit, at a cost proportional to the change."""

from __future__ import annotations

import gc
import pickle
import random
import weakref

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.testing import assert_valid, zoo
from wandering import ATTRIBUTES, COMPACTION, everything, furnish, wander

ZOO = zoo()
SORTS = {"operators": (), "attributes": 3 * ATTRIBUTES, "compaction": COMPACTION, "all": ATTRIBUTES + COMPACTION}


class RefusedError(Exception):
    """What the blocks below end with."""


def fail(mesh, change, **options):
    """Change the mesh in a transaction that is rolled back."""

    def block():
        with mesh.transaction(**options):
            change(mesh)
            raise RefusedError

    with pytest.raises(RefusedError):
        block()


# -- everything is as it was -------------------------------------------------------------------------------------------


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


# -- attributes --------------------------------------------------------------------------------------------------------


def test_arrays_that_were_held_before_are_watched():
    mesh = hm.shapes.cube()
    rows, row, part = mesh.points, mesh.vertices[3].point, mesh.points[:, 1][::2]
    before = rows.tobytes()
    del rows

    def change(mesh):
        row[:] = 9.0
        part[:] = 8.0

    fail(mesh, change)
    assert mesh.points.tobytes() == before
    row[0] = 5.0
    assert mesh.points[3, 0] == 5.0  # and they are still arrays of the mesh


def test_arrays_held_before_are_arrays_of_the_mesh_after_growth_was_rolled_back():
    mesh = hm.shapes.cube()
    points = mesh.points
    fail(mesh, lambda mesh: mesh.split_face(0))
    points[2] = 4.0
    assert mesh.points[2].tolist() == [4.0, 4.0, 4.0]


def test_held_arrays_can_be_left_out():
    mesh = hm.shapes.cube()
    points = mesh.points

    def change(mesh):
        points[0] = 9.0
        mesh.vertices[1].point = [8.0, 8.0, 8.0]

    fail(mesh, change, include_held=False)
    assert mesh.points[:2].max(axis=1).tolist() == [9.0, 1.0]


def test_column_held_before_is_watched():
    mesh = hm.shapes.cube()
    column = mesh.vertex_data.column("points")
    before = everything(mesh)
    fail(mesh, lambda mesh: column.__setitem__((2, 0), 9.0))
    assert everything(mesh) == before


def test_array_from_an_outer_transaction_is_watched_inside():
    mesh = hm.shapes.cube()
    with mesh.transaction():
        points = mesh.points
        points[0] = 2.0
        fail(mesh, lambda mesh: points.__setitem__(0, 3.0))
        assert points[0, 0] == 2.0


def test_attributes_that_come_and_go_in_it():
    mesh = furnish(hm.shapes.cube())
    before = everything(mesh)

    def change(mesh):
        del mesh.vertex_data["label"]
        mesh.face_data["fresh"] = np.zeros(6)
        mesh.vertex_data["x"] = np.arange(8)  # another dtype
        mesh.points = np.ones((8, 3))
        mesh.vertex_data.set_policy("total", "max")

    fail(mesh, change)
    assert everything(mesh) == before


def test_mesh_without_points_has_none_again():
    mesh = hm.Mesh([[0, 1, 2]])
    fail(mesh, lambda mesh: mesh.add_vertex([1, 2, 3]))
    assert not mesh.has_points


def test_meta_is_as_it_was_and_the_same_dict():
    mesh = furnish(hm.shapes.cube())
    meta = mesh.meta

    def change(mesh):
        mesh.meta["groups"].append("c")
        mesh.meta = {"other": 1}

    fail(mesh, change)
    assert mesh.meta == {"groups": ["a", "b"]}
    assert mesh.meta is meta


def test_policy_that_raises_leaves_nothing_behind():
    def refuse(values, weights):
        raise RefusedError

    mesh = furnish(hm.shapes.cube())
    mesh.vertex_data.set_policy("x", refuse)
    before = everything(mesh)
    fail(mesh, lambda mesh: mesh.split_face(0))
    assert everything(mesh) == before
    mesh.vertex_data.set_policy("x", "lerp")
    mesh.split_face(0)
    assert_valid(mesh)


def test_meta_and_arrays_of_an_inner_transaction_go_back_with_the_outer():
    mesh = furnish(hm.shapes.cube())
    before = everything(mesh)

    def change(mesh):
        with mesh.transaction():
            mesh.meta["groups"].append("c")
            mesh.points[:] = 3.0
        mesh.vertices[0].point = [4.0, 4.0, 4.0]

    fail(mesh, change)
    assert everything(mesh) == before


# -- kernels -----------------------------------------------------------------------------------------------------------


@hm.kernel
def churn(t, stride):
    for f in range(hm.face_slots(t)):
        if hm.halfedge_of_face(t, f) >= 0:
            hm.split_face(t, f)
    for e in range(0, hm.edge_slots(t), stride):
        if hm.next_of(t, 2 * e) >= 0 and hm.flip_status(t, e) == 0:
            hm.flip(t, e)
    for v in range(0, hm.vertex_slots(t), stride):
        h = hm.halfedge_of_vertex(t, v)
        if h >= 0 and hm.collapse_status(t, h) == 0:
            hm.collapse(t, h)


@hm.kernel
def lift(t, points):
    for f in range(hm.face_slots(t)):
        v = hm.split_face(t, f)
        points[v, 2] = 1.0
        points[0, 0] += 1.0


@hm.kernel
def split_and_raise(t, points):
    for f in range(hm.face_slots(t)):
        v = hm.split_face(t, f)
        points[v, 2] = 1.0
        points[0, 0] += 1.0
    raise ValueError("in the middle")


GEARS = {
    "compiled": lambda kernel, *args: kernel(*args),
    "interpreted": lambda kernel, *args: kernel.interpreted(*args),
}


@pytest.fixture(params=GEARS)
def run(request):
    return GEARS[request.param]


def test_kernel_inside_is_rolled_back(run):
    mesh = furnish(hm.shapes.icosphere(1))
    before = everything(mesh)
    for _ in range(2):
        fail(mesh, lambda mesh: run(churn, mesh, 3))
        assert everything(mesh) == before
    assert_valid(mesh)


def test_column_that_a_kernel_takes_is_rolled_back(run):
    mesh = furnish(hm.shapes.icosphere(1))
    before = everything(mesh)
    fail(mesh, lambda mesh: run(lift, mesh, mesh.vertex_data.column("points")))
    assert everything(mesh) == before


def test_kernel_that_raises_is_rolled_back(run):
    mesh = furnish(hm.shapes.icosphere(1))
    before = everything(mesh)
    with pytest.raises(ValueError, match="in the middle"), mesh.transaction():
        run(split_and_raise, mesh, mesh.vertex_data.column("points"))
    assert everything(mesh) == before
    mesh.split_face(0)
    assert_valid(mesh)


def test_column_goes_on_in_kernels_after_a_rollback(run):
    mesh, twin = furnish(hm.shapes.icosphere(1)), furnish(hm.shapes.icosphere(1))
    points = mesh.points
    fail(mesh, lambda mesh: run(lift, mesh, mesh.vertex_data.column("points")))
    points[1] = twin.points[1] = 5.0
    for each in (mesh, twin):
        run(lift, each, each.vertex_data.column("points"))
    assert everything(mesh) == everything(twin)


def test_gears_may_change_within_a_transaction():
    mesh = furnish(hm.shapes.icosphere(1))
    before = everything(mesh)

    def change(mesh):
        churn(mesh, 3)
        churn.interpreted(mesh, 5)
        mesh.split_edge(next(iter(mesh.edges)))
        mesh.compact()
        churn(mesh, 7)

    fail(mesh, change)
    assert everything(mesh) == before


# -- handles -----------------------------------------------------------------------------------------------------------


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


# -- what it costs -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("level", [2, 4])
def test_what_is_kept_does_not_depend_on_the_size_of_the_mesh(level):
    mesh = furnish(hm.shapes.icosphere(level))
    gc.collect()
    with mesh.transaction() as attempt:
        assert attempt.nbytes == 0
        mesh.flip(7)
        mesh.collapse(mesh.split_edge(5).halfedge)
        mesh.vertices[3].point = [0.0, 0.0, 0.0]
        assert 0 < attempt.nbytes < 6000
        assert mesh.edges[3].length > 0
        mesh.split_face(0, [1, 1, 1])
        assert attempt.nbytes < 8000
        mesh.points[0] = 1.0
        assert attempt.nbytes > mesh.points.nbytes - 100


def test_column_is_copied_once():
    mesh = hm.shapes.icosphere(3)
    with mesh.transaction() as attempt:
        for _ in range(3):
            mesh.points[:] += 1.0
        assert attempt.nbytes == mesh.points.nbytes


def test_transaction_inside_another_copies_nothing_again():
    mesh = hm.shapes.icosphere(2)
    with mesh.transaction() as outer:
        with mesh.transaction() as inner:
            assert inner.nbytes == 0
            mesh.points[:] = 1.0
        assert outer.nbytes == mesh.points.nbytes
        mesh.points[:] = 2.0
        assert outer.nbytes == mesh.points.nbytes


def test_attempts_after_attempts_need_no_new_room():
    mesh = hm.shapes.icosphere(2)
    fail(mesh, lambda mesh: mesh.split_face(0))
    values = mesh.vertex_data.column("points").values
    size, address = len(values), values.ctypes.data
    del values
    fail(mesh, lambda mesh: mesh.split_face(0))
    values = mesh.vertex_data.column("points").values
    assert (len(values), values.ctypes.data) == (size, address)
    assert size > 162


def test_nothing_is_journaled_outside():
    mesh = hm.shapes.cube()
    with mesh.transaction():
        mesh.split_face(0)
    size = len(mesh.topology.__arrays__().journal)
    for f in range(100):
        mesh.split_face(f)
    assert len(mesh.topology.__arrays__().journal) == size
    assert all(table._keeper is None for table in mesh._tables())


def test_large_journal_is_let_go():
    mesh = hm.shapes.icosphere(3)
    with mesh.transaction():
        for _ in range(3):
            churn(mesh, 10)
        assert len(mesh.topology.__arrays__().journal) > 2**17
    assert len(mesh.topology.__arrays__().journal) < 100
    churn(mesh, 10)
    assert_valid(mesh)
