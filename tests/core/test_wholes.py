"""Whole components by index: both gears agree, attempts are undone, refusals change nothing, kernels may call them."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.core.attempts import begin_attempt, end_attempt
from halfmesh.core.operators.wholes import (
    append,
    component_of,
    remove_component,
    reverse,
    reverse_component,
    try_append,
    try_remove_component,
    try_reverse_component,
)
from halfmesh.core.statuses import REASONS
from halfmesh.core.topology import COLUMNS, NEWS, VERTEX_SLOTS
from halfmesh.testing import assert_valid, zoo

NAMED = {reason.name: code for code, reason in REASONS.items()}
ZOO = zoo()
every_mesh = pytest.mark.parametrize("name", ZOO)


def state(mesh):
    """Every column in use, and the counts except the news that Python has read."""
    counts = mesh.topology.__arrays__().counts.copy()
    counts[NEWS] = 0
    return [*(getattr(mesh.topology, name).tolist() for name in COLUMNS[:-1]), counts.tolist()]


@every_mesh
@pytest.mark.parametrize("kernel", [reverse_component, remove_component, reverse, append], ids=lambda k: k.__name__)
def test_both_gears_do_the_same(kernel, name):
    if kernel is not reverse and not ZOO[name].figures.n_vertices:
        return
    one, two = ZOO[name].mesh(), ZOO[name].mesh()
    more = {append: (hm.shapes.cube(),), reverse: ()}.get(kernel, (0,))
    assert kernel(one, *more) == kernel.interpreted(two, *more)
    assert state(one) == state(two)
    assert_valid(one)


@every_mesh
@pytest.mark.parametrize("kernel", [reverse_component, remove_component, append], ids=lambda k: k.__name__)
def test_an_attempt_is_undone_bit_for_bit(kernel, name):
    mesh = ZOO[name].mesh()
    if not mesh.n_vertices:
        return
    before = state(mesh)
    attempt = begin_attempt(mesh)
    kernel(mesh, mesh if kernel is append else 0)
    end_attempt(mesh, attempt, False)
    assert state(mesh) == before


@every_mesh
def test_a_component_is_its_vertices_and_edges(name):
    mesh = ZOO[name].mesh()
    before, of = state(mesh), mesh.components().vertex_component
    for v in np.flatnonzero(mesh.topology.vertex_halfedge >= 0).tolist():
        vertices, edges = component_of(mesh, v)
        assert sorted(mesh.topology.origin[vertices].tolist()) == np.flatnonzero(of == of[v]).tolist()
        assert sorted(edges.tolist()) == (2 * np.flatnonzero(of[mesh.topology.origin[::2]] == of[v])).tolist()
    assert state(mesh) == before  # the marks are gone


def test_refusals_change_nothing():
    mesh = hm.Mesh([[0, 1, 2]], n_vertices=4)
    mesh.remove_vertex(3)
    before = state(mesh)
    for act in (try_reverse_component, try_remove_component):
        assert act(mesh, 3) == -NAMED["deleted_element"]
        assert act(mesh, 4) == act(mesh, -1) == -NAMED["missing_element"]
    other = hm.shapes.cube()
    other.topology.__arrays__().counts[VERTEX_SLOTS] = 2**31 - 2
    assert try_append(mesh, other) == -NAMED["too_large"]
    assert state(mesh) == before


def test_many_meshes_are_appended_in_a_kernel():
    @hm.kernel
    def repeat(t, s, n):
        for _ in range(n):
            reverse_component(t, append(t, s))

    mesh, cube = hm.Mesh([]), hm.shapes.cube()
    repeat(mesh, cube, 50)
    assert_valid(mesh)
    assert (mesh.n_connected_components, mesh.n_vertices, mesh.n_faces) == (50, 400, 300)
    cube.reverse()
    assert np.array_equal(mesh.face_vertices()[0][-24:] - 392, cube.face_vertices()[0])


def test_a_component_of_any_shape_is_walked():
    path = hm.Mesh([], edges=[[i, i + 1] for i in range(5000)])
    reverse_component(path, 2500)
    assert path.topology.origin[:2].tolist() == [1, 0]
    remove_component(path, 0)
    assert (path.n_vertices, path.n_edges) == (0, 0)
