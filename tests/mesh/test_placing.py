"""Points that are given: with operators in one compiled call as one after the other; assigned to a vertex."""

from __future__ import annotations

import random

import numpy as np
import pytest

import halfmesh as hm
from alike import square
from halfmesh.testing import assert_valid
from nimble import nimble, plain


def edited(mesh, n):
    """Splits and collapses, with places and without, until far more than `n` calls have been made of each."""
    rng = random.Random(1)
    for k in range(n):
        place = None if k % 3 else [0.5, float(k), -1.0]
        mesh.split_edge(rng.choice(mesh.edges.indices.tolist()), place, at=0.25 if place is None else 0.5)
        mesh.split_face(rng.choice(mesh.faces.indices.tolist()), place)
        e = rng.choice(mesh.edges.indices.tolist())
        if mesh.can_split_edge_triangular(e):
            mesh.split_edge_triangular(e, place, at=0.5)
        for _ in range(3):
            mesh.try_collapse(rng.choice(mesh.halfedges.indices.tolist()), place, at=0.75)
    return mesh


@pytest.mark.large
@pytest.mark.parametrize("others", [False, True])
def test_points_that_follow_in_the_same_call_are_those_that_follow_after_it(others):
    meshes = [hm.shapes.icosphere(1), hm.shapes.icosphere(1)]
    for mesh in meshes if others else []:
        mesh.vertex_data["x"] = mesh.points.copy()
        mesh.halfedge_data["uv"] = np.arange(float(mesh.n_halfedges))
    quick, slow = edited(nimble(meshes[0]), 200), edited(plain(meshes[1]), 200)
    assert_valid(quick)
    assert_valid(slow)
    assert np.array_equal(quick.topology.next, slow.topology.next)
    assert np.allclose(quick.points, slow.points, rtol=1e-14, atol=0)
    if others:
        assert np.array_equal(quick.vertex_data["x"], slow.vertex_data["x"])
        assert np.array_equal(quick.halfedge_data["uv"], slow.halfedge_data["uv"])


def test_point_that_is_none_is_refused_before_anything_is_split():
    for mesh in (square(), edited(hm.shapes.icosphere(1), 30)):
        n = mesh.n_vertices
        for bad in ([0, 0, 0, 0], [0, float("nan"), 0], "abc"):
            with pytest.raises(hm.InvalidMeshError):
                mesh.split_edge(mesh.edges.indices[0].item(), bad)
            with pytest.raises(hm.InvalidMeshError):
                mesh.split_face(mesh.faces.indices[0].item(), bad)
        assert mesh.n_vertices == n


# -- assigned ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("form", [list, tuple, np.array, np.float32, lambda p: [np.float64(x) for x in p]])
def test_point_is_assigned_in_any_form_that_adds_a_vertex(form):
    mesh = hm.shapes.cube()
    for given, expected in (([1.5, 2, 3], [1.5, 2, 3]), ([4.0, 5.0, 6.0], [4, 5, 6]), ([7.0, 8.0], [7, 8, 0])):
        mesh.vertices[0].point = form(given)
        assert mesh.points[0].tolist() == mesh.add_vertex(form(given)).point.tolist() == expected
    mesh.vertices[1].point = mesh.vertices[0].point
    assert mesh.points[1].tolist() == [7, 8, 0]


def test_points_of_the_dead_are_not_assigned():
    mesh = hm.shapes.cube()
    v = mesh.vertices[0]
    mesh.remove_vertex(v)
    with pytest.raises(hm.StaleElementError):
        v.point = [1, 2]
