"""Operators as built-in functions in all states that a mesh can be in; and that they count references right."""

from __future__ import annotations

import gc
import sys
import weakref

import numpy as np
import pytest

import halfmesh as hm
from halfmesh import _jit
from halfmesh.core.topology import LIMIT, VERTEX_SLOTS
from halfmesh.testing import assert_valid
from nimble import decorate, frozen, nimble, outcome, plain, same

pytestmark = [
    pytest.mark.large,
    pytest.mark.skipif(not _jit.are_possible(), reason="this Python has no natives"),
]


def test_transactions_are_rolled_back():
    mesh = nimble(hm.shapes.icosphere(1))
    decorate(mesh)
    before = frozen(mesh), mesh.points.copy()
    for _ in range(3):
        with mesh.transaction() as attempt:
            mesh.flip(0), mesh.split_face(1, [1.0, 2.0, 3.0]), mesh.split_edge(2), mesh.try_collapse(9, at=0.5)
            mesh.add_face([mesh.add_vertex([float(i), 1.0, 2.0]) for i in range(3)])
            attempt.rollback()
        assert frozen(mesh) == before[0]
        assert np.array_equal(mesh.points, before[1])
        assert all(mesh.try_flip(e) for e in (0, 0, 0, 0))
        before = frozen(mesh), mesh.points.copy()


@pytest.mark.parametrize("policy", ["copy", "mean", "max", lambda values, weights: values[0]])
def test_points_follow_by_another_policy(policy):
    start = hm.shapes.icosphere(1)
    meshes = nimble(start.copy()), plain(start)
    for mesh in meshes:
        mesh.split_edge(0)
        mesh.vertex_data.set_policy("points", policy)
        mesh.split_edge(1, at=0.25), mesh.split_face(3), mesh.try_collapse(60, at=0.75)
        mesh.vertex_data.set_policy("points", "".join(["le", "rp"]))
        mesh.split_edge(2, at=0.25)
    same(*meshes)


def test_points_that_were_replaced_are_those_that_follow():
    start = hm.shapes.icosphere(1)
    meshes = nimble(start.copy()), plain(start)
    for mesh in meshes:
        held = mesh.points
        mesh.split_edge(0)
        mesh.points = 2 * mesh.points
        mesh.split_edge(1)
        mesh.vertex_data["points"] = mesh.points + 1
        mesh.split_edge(2), mesh.split_face(0)
        mesh.vertex_data["x"] = np.ones(mesh.n_vertices)
        mesh.split_edge(3)
        del mesh.vertex_data["x"]
        mesh.split_edge(4)
        mesh.points[:] += 1.0
        mesh.split_edge(5)
        mesh.vertices[0].point = [9.0, 9.0, 9.0]
        mesh.split_edge(0)
        assert held[0].tolist() == start.points[0].tolist()
    same(*meshes)


@hm.kernel
def grow(t, points, n):
    for _ in range(n):
        v = hm.add_vertex(t)
        points[v, 0] = 5.0


@hm.kernel
def split_some(t, n):
    for f in range(n):
        hm.split_face(t, f)


def test_kernels_grow_the_mesh_in_between():
    start = hm.shapes.icosphere(1)
    meshes = nimble(start.copy()), plain(start)
    for mesh in meshes:
        mesh.split_edge(0)
        grow(mesh, mesh.vertex_data.column("points"), 500)
        mesh.split_edge(1), mesh.add_vertex([1.0, 2.0, 3.0])
        split_some(mesh, 70)
        mesh.split_edge(2), mesh.split_face(5), mesh.add_vertex()
        grow.interpreted(mesh, mesh.vertex_data.column("points"), 2000)
        mesh.split_edge(3), mesh.add_vertex([1.0, 2.0, 3.0])
        mesh.compact()
        mesh.split_edge(4), mesh.try_collapse(10)
        mesh.append(start)
        mesh.split_face(6), mesh.flip(20)
    same(*meshes)


def test_handles_of_before_compaction_are_stale():
    mesh = nimble(hm.shapes.icosphere(1))
    e = mesh.edges[0]
    mesh.remove_face(0)
    mesh.compact()
    for act in (mesh.flip, mesh.try_flip, mesh.can_flip, mesh.split_edge):
        with pytest.raises(hm.StaleElementError, match="compacted"):
            act(e)


def test_full_mesh_is_left_as_it_is():
    mesh = nimble(hm.shapes.icosphere(1))
    mesh.split_edge(0)
    counts = mesh.topology.__arrays__().counts
    n = counts[VERTEX_SLOTS]
    counts[VERTEX_SLOTS] = LIMIT
    for act in (mesh.split_edge, mesh.split_face, lambda x: mesh.add_vertex([0.0, 0.0, float(x)])):
        with pytest.raises(hm.TopologyError):
            act(1)
    counts[VERTEX_SLOTS] = n
    assert_valid(mesh)


def test_policy_that_raises_does_so_from_a_native():
    mesh = nimble(hm.shapes.icosphere(1))
    mesh.vertex_data.add("x", policy=lambda values, weights: 1 / 0)
    n = mesh.n_vertices
    for _ in range(3):
        with pytest.raises(ZeroDivisionError):
            mesh.split_edge(0)
    assert mesh.n_vertices == n + 3
    assert_valid(mesh)


# -- references -------------------------------------------------------------------------------------------------------


def test_no_reference_is_lost_or_kept():
    start = hm.shapes.icosphere(1)
    other, at, numbers = hm.shapes.cube().edges[0], 0.3712, [1.25, 2.5, 3.75]
    row = np.array(numbers)
    watched = [at, numbers, row, *numbers, other, other._t, hm.Vertex, hm.Face]

    def all_of_them():
        mesh = nimble(start.copy())
        e, h = mesh.edges[60], mesh.halfedges[70]
        mesh.try_flip(e), mesh.can_flip(e), mesh.flip(e), mesh.can_collapse(h)
        mesh.split_face(5, numbers), mesh.split_face(mesh.faces[6], point=row)
        mesh.split_edge(e, point=row, at=at), mesh.split_edge_triangular(h, numbers, at=at)
        mesh.add_face([mesh.add_vertex(row), mesh.add_vertex(numbers), mesh.add_vertex()])
        mesh.try_collapse(h, at=at), mesh.collapse(3, row)
        for bad in (other, "a", None):
            outcome(lambda x=bad: mesh.flip(x)), outcome(lambda x=bad: mesh.split_face(0, [at, x, at]))

    for _ in range(3):
        all_of_them()
    gc.collect()
    before, n_none, n_true = [sys.getrefcount(x) for x in watched], sys.getrefcount(None), sys.getrefcount(True)
    for _ in range(50):
        all_of_them()
    gc.collect()
    assert [sys.getrefcount(x) for x in watched] == before
    assert abs(sys.getrefcount(None) - n_none) < 20
    assert abs(sys.getrefcount(True) - n_true) < 20


def test_handles_are_counted_and_collected():
    mesh = nimble(hm.shapes.icosphere(2))
    mesh.add_vertices(3000)
    mesh.add_vertex()
    v, w = mesh.add_vertex(), mesh.vertices[0]
    assert gc.is_tracked(v)
    assert sys.getrefcount(v) == sys.getrefcount(w)
    count = sys.getrefcount(mesh._t)
    many = [mesh.add_vertex() for _ in range(100)]
    more = sys.getrefcount(mesh._t) - count
    assert more == 100
    assert many[3] == mesh.vertices[many[3].index]
    assert type(many[3]) is hm.Vertex
    del many
    more = sys.getrefcount(mesh._t) - count
    assert more == 0
    gc.collect()
    n_blocks = sys.getallocatedblocks()
    for _ in range(1000):
        mesh.add_vertex()
    assert sys.getallocatedblocks() < n_blocks + 100


def test_mesh_with_natives_is_freed_at_once():
    gc.collect()
    gc.disable()
    try:
        mesh = nimble(hm.shapes.icosphere(1))
        mesh.split_face(0)
        native, gone = mesh.flip, weakref.ref(mesh)
        del mesh
        assert gone() is None
    finally:
        gc.enable()
    native(0)  # the columns are there as long as it is
    with pytest.raises(hm.StaleElementError, match="the mesh is gone"):
        native(10**6)
