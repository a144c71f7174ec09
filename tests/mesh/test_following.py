"""Attributes that follow the local operators: points, policies, seams, sums, any dtype."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm
from alike import square
from halfmesh.testing import assert_valid


def test_points_follow_a_split_and_a_collapse():
    mesh = square()
    e = mesh.find_halfedge(0, 1).edge
    assert mesh.split_edge(e, at=0.25).point.tolist() == [0.25, 0, 0]
    assert mesh.split_face(0, [5, 6]).point.tolist() == [5, 6, 0]
    mesh = hm.shapes.icosphere(1)
    h = mesh.halfedges[0]
    middle = (h.origin.point + h.target.point) / 2
    assert np.allclose(mesh.collapse(h, at=0.5).point, middle)


@pytest.mark.parametrize(
    ("policy", "dtype", "new", "merged"),
    [
        ("lerp", float, 2.5, 2.5),
        ("mean", float, 4.0, 4.0),
        ("copy", int, 2, 6),
        ("first", int, 2, 2),
        ("nearest", int, 2, 2),
        ("min", int, 2, 2),
        ("max", int, 6, 6),
        ("sum", int, 0, 8),
        (lambda values, weights: values.max() * 10 + weights[0], float, 60.875, None),
    ],
)
def test_policies_at_a_split_and_a_collapse(policy, dtype, new, merged):
    mesh = hm.Mesh([[0, 1, 2, 3]])
    mesh.vertex_data.add("x", dtype, policy=policy)[:] = [2, 6, 0, 0]
    v = mesh.split_edge(mesh.find_halfedge(0, 1), at=0.125)
    assert mesh.vertex_data["x"][v.index] == new
    if merged is not None:
        mesh = hm.Mesh([[0, 1, 2, 3]])
        mesh.vertex_data.add("x", dtype, policy=policy)[:] = [2, 6, 0, 0]
        v = mesh.collapse(mesh.find_halfedge(0, 1), at=0.125)
        assert mesh.vertex_data["x"][v.index] == merged


def test_normalized_directions_stay_of_length_one():
    mesh = hm.Mesh([[0, 1, 2]])
    mesh.vertex_data.add("n", float, (3,), policy="normalize")[:] = np.eye(3)
    v = mesh.split_edge(mesh.find_halfedge(0, 1))
    assert np.allclose(mesh.vertex_data["n"][v.index], [0.5**0.5, 0.5**0.5, 0])


def test_sums_are_shared_so_that_the_total_stays():
    mesh = hm.shapes.cube()
    mesh.face_data.add("mass", float, policy="sum")[:] = 1.0
    mesh.edge_data.add("length", float, policy="sum")[:] = 1.0
    mesh.split_face(0)
    mesh.split_edge(0, at=0.25)
    h = mesh.connect(mesh.faces[1].halfedge, mesh.faces[1].halfedge.next.next)
    assert np.isclose(mesh.face_data["mass"].sum(), 6.0)
    assert mesh.edge_data["length"][0] == 0.25
    assert np.isclose(mesh.edge_data["length"].sum(), 12.0)
    mesh.join_faces(h)
    assert np.isclose(mesh.face_data["mass"][mesh.faces.indices].sum(), 6.0)


@pytest.mark.parametrize("value", [0, 1, 2, 5, 7])
def test_sums_of_whole_numbers_are_shared_to_the_last(value):
    mesh = hm.shapes.cube()
    tables = (mesh.vertex_data, mesh.edge_data, mesh.face_data)
    for table in tables:
        table.add("count", np.uint8, policy="sum")[:] = value
    mesh.split_face(0)
    mesh.split_edge(0, at=0.3)
    mesh.connect(mesh.faces[1].halfedge, mesh.faces[1].halfedge.next.next)
    a, b, *_ = mesh.vertices[2].outgoing()
    mesh.split_vertex(a, b)
    assert [int(table["count"].sum()) for table in tables] == [8 * value, 12 * value, 6 * value]


def test_labels_of_faces_are_copied():
    mesh = hm.shapes.cube()
    mesh.face_data["label"] = np.arange(6)
    v = mesh.split_face(4)
    assert {int(mesh.face_data["label"][f.index]) for f in v.faces()} == {4}


def test_seam_in_corner_data_stays_a_seam_at_a_split():
    mesh = square()
    left, right = mesh.find_halfedge(0, 2), mesh.find_halfedge(2, 0)
    uv = mesh.halfedge_data.add("uv", float)
    for face, value in ((left.face, 10.0), (right.face, 20.0)):
        for h in face.halfedges():
            uv[h.index] = value
    v = mesh.split_edge(left)
    values = {h.face.index: mesh.halfedge_data["uv"][h.index] for h in v.outgoing()}
    assert values == {left.face.index: 10.0, right.face.index: 20.0}


def test_seam_in_corner_data_stays_a_seam_at_a_collapse():
    """Two sheets of a grid with values of their own, apart by 100; an edge on the seam contracts to its middle."""
    mesh = hm.shapes.grid(4, 4)
    x = mesh.points[:, 0]
    uv = mesh.halfedge_data.add("uv", float)
    middle = np.median(np.unique(x))
    for f in mesh.faces:
        sheet = 100.0 * (np.mean([v.point[0] for v in f.vertices()]) > middle)
        for h in f.halfedges():
            uv[h.index] = sheet + h.origin.point[1]
    on_seam = [
        h for h in mesh.halfedges
        if not h.origin.is_boundary and not h.target.is_boundary and h.origin.point[0] == h.target.point[0] == middle
    ]  # fmt: skip
    h = next(h for h in on_seam if mesh.can_collapse(h))
    y = (h.origin.point[1] + h.target.point[1]) / 2
    v = mesh.collapse(h, at=0.5)
    found = {float(mesh.halfedge_data["uv"][g.index]) for g in v.outgoing()}
    assert found == {y, 100.0 + y}


@pytest.mark.parametrize("dtype", ["f4", "f2", "i8", "u1", "?", "c16", "U5", "M8[s]", "i4,f8"])
def test_any_dtype_follows(dtype):
    mesh = square()
    mesh.vertex_data.add("x", dtype)
    mesh.face_data.add("x", dtype, (2,))
    mesh.split_face(0)
    mesh.split_edge(0)
    assert len(mesh.vertex_data["x"]) == 6
    assert_valid(mesh)


def test_new_elements_that_nothing_precedes_have_the_default():
    mesh = hm.shapes.cube()
    mesh.edge_data.add("weight", float, default=7.0)[:] = 1.0
    mesh.split_face(0)
    assert mesh.edge_data["weight"].tolist() == [1.0] * 12 + [7.0] * 4


@pytest.mark.parametrize(
    ("policy", "dtype"), [("median", float), ("lerp", "U3"), ("sum", "M8[s]"), ("normalize", int), ("min", complex)]
)
def test_policies_that_make_no_sense_are_refused(policy, dtype):
    with pytest.raises(ValueError, match=r"polic|follow"):
        square().vertex_data.add("x", dtype, policy=policy)


def test_policy_can_be_changed_and_is_copied():
    mesh = square()
    mesh.vertex_data["x"] = np.arange(4.0)
    assert mesh.vertex_data.policies == {"points": "lerp", "x": "lerp"}
    mesh.vertex_data.set_policy("x", "max")
    assert mesh.copy().vertex_data.policies["x"] == "max"
    with pytest.raises(KeyError):
        mesh.vertex_data.set_policy("y", "max")
