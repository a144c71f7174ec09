"""Local operators through the mesh: what they refuse, and that refusals change nothing."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm
from alike import columns, square


@pytest.mark.parametrize(
    ("act", "reason"),
    [
        (lambda mesh: mesh.flip(mesh.find_halfedge(0, 1).edge), "boundary_edge"),
        (lambda mesh: mesh.join_faces(mesh.find_halfedge(0, 1)), "boundary_edge"),
        (lambda mesh: mesh.connect(0, 0), "same_corner"),
        (lambda mesh: mesh.connect(mesh.find_halfedge(0, 1), mesh.find_halfedge(2, 3)), "different_faces"),
        (lambda mesh: mesh.connect(mesh.find_halfedge(0, 1), mesh.find_halfedge(1, 2)), "would_be_parallel"),
        (lambda mesh: mesh.connect(mesh.find_halfedge(1, 0), mesh.find_halfedge(0, 3)), "no_face"),
        (lambda mesh: mesh.collapse(mesh.find_halfedge(0, 2)), "would_leave_wire"),
    ],
)
def test_refusal_says_why_and_changes_nothing(act, reason):
    mesh = square()
    before = columns(mesh)
    with pytest.raises(hm.TopologyError) as refused:
        act(mesh)
    assert refused.value.reason == reason
    assert all(np.array_equal(column, before[name]) for name, column in columns(mesh).items())


def test_collapse_that_would_fold_or_pinch_is_refused():
    tetrahedron = hm.shapes.tetrahedron()
    with pytest.raises(hm.TopologyError) as refused:
        tetrahedron.collapse(0)
    assert refused.value.reason == "would_fold"
    quads = hm.Mesh([[0, 1, 2, 3], [1, 4, 5, 2]])
    with pytest.raises(hm.TopologyError) as refused:
        quads.collapse(quads.find_halfedge(1, 2))
    assert refused.value.reason == "would_pinch"
    triangle = hm.Mesh([[0, 1, 2]])
    with pytest.raises(hm.TopologyError) as refused:
        triangle.collapse(0)
    assert refused.value.reason in {"would_leave_wire", "would_close_hole"}


@pytest.mark.parametrize("wrong", [-1, 10**6, 1.5, True, "0", None])
def test_wrong_elements_are_no_elements(wrong):
    mesh = square()
    before = columns(mesh)
    for act in (mesh.flip, mesh.split_edge, mesh.split_face, mesh.collapse, mesh.join_faces):
        with pytest.raises(hm.ElementError):
            act(wrong)
    assert all(np.array_equal(column, before[name]) for name, column in columns(mesh).items())


def test_elements_of_another_mesh_and_of_the_wrong_kind_are_refused():
    mesh, other = square(), square()
    for act, element in (
        (mesh.flip, other.edges[0]),
        (mesh.flip, mesh.faces[0]),
        (mesh.split_face, mesh.edges[0]),
        (mesh.collapse, mesh.vertices[0]),
    ):
        with pytest.raises(hm.ElementError):
            act(element)


def test_deleted_elements_are_stale():
    mesh = square()
    h = mesh.find_halfedge(0, 2)
    f, kept = h.twin.face, h.face
    mesh.join_faces(h)
    for stale in (lambda: h.next, lambda: f.degree, lambda: mesh.flip(h.edge), lambda: mesh.split_face(f)):
        with pytest.raises(hm.StaleElementError):
            stale()
    assert not h.is_alive
    assert f not in mesh.faces
    assert list(mesh.faces) == [kept]


@pytest.mark.parametrize("point", [[0, 0, np.nan], [np.inf, 0, 0], [1], [1, 2, 3, 4], "abc", [[0, 0, 0]]])
def test_bad_points_are_refused_before_anything_changes(point):
    mesh = square()
    before = columns(mesh)
    for act, element in ((mesh.split_edge, 0), (mesh.split_face, 0), (mesh.collapse, 0)):
        with pytest.raises(hm.InvalidMeshError):
            act(element, point)
    assert all(np.array_equal(column, before[name]) for name, column in columns(mesh).items())


@pytest.mark.parametrize("at", [-0.1, 1.1, float("nan")])
def test_places_off_the_edge_are_refused(at):
    with pytest.raises(hm.InvalidMeshError):
        square().split_edge(0, at=at)
