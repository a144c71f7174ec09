"""What a transaction costs: memory in proportion to the change, and nothing outside of one."""

from __future__ import annotations

import gc

import pytest

import halfmesh as hm
from halfmesh.testing import assert_valid
from wandering import churn, fail, furnish


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
