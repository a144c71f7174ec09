"""Transactions and kernels: what compiled code did is undone like all else, in either gear."""

from __future__ import annotations

import pytest

import halfmesh as hm
from halfmesh.testing import assert_valid
from wandering import churn, everything, fail, furnish


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
