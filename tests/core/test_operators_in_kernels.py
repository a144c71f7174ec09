"""Operators called by index in a user's own kernel, which grows the mesh and its attributes without knowing."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.testing import assert_valid


@hm.kernel
def split_all(t):
    for f in range(hm.face_slots(t)):
        hm.split_face(t, f)


@hm.kernel
def split_all_with_points(t, points):
    for f in range(hm.face_slots(t)):
        x = 0.0
        for h in hm.face_halfedges(t, f):
            x += points.values[hm.origin_of(t, h), 0]
        v = hm.split_face(t, f)
        points[v, 0] = x
        points[v, 1] = -1.0


@hm.kernel
def collapse_from(t, first):
    n = 0
    for v in range(first, hm.vertex_slots(t)):
        h = hm.halfedge_of_vertex(t, v)
        if hm.collapse_status(t, h) == 0:
            hm.collapse(t, h)
            n += 1
    return n


@hm.kernel
def flip_every(t, stride):
    n = 0
    for e in range(0, hm.edge_slots(t), stride):
        if hm.flip_status(t, e) == 0:
            hm.flip(t, e)
            n += 1
    return n


@pytest.fixture(params=["called", "interpreted"])
def run(request):
    return (lambda kernel, *args: kernel(*args)) if request.param == "called" else (
        lambda kernel, *args: kernel.interpreted(*args)
    )  # fmt: skip


def test_kernel_splits_every_face_and_points_follow(run):
    mesh = hm.shapes.icosphere(2)
    centers = hm.geometry.face_centroids(mesh)
    run(split_all, mesh)
    assert_valid(mesh)
    assert mesh.n_vertices == 162 + 320
    assert np.allclose(mesh.points[162:], centers)


def test_column_that_the_kernel_takes_is_the_kernels_and_grows_by_itself(run):
    mesh = hm.shapes.icosphere(1)
    mesh.vertex_data["label"] = np.arange(42)
    mesh.vertex_data.add("y", float, default=3.0)
    run(split_all_with_points, mesh, mesh.vertex_data.column("points"))
    assert_valid(mesh)
    assert (mesh.points[42:, 1] == -1).all()
    assert (mesh.points[42:, 2] == 0).all()  # the default: the kernel did not set it
    assert len(mesh.vertex_data["y"]) == 42 + 80


def test_splitting_and_collapsing_gives_the_mesh_again(run):
    mesh = hm.shapes.icosphere(1)
    faces = {tuple(sorted(face)) for face in mesh.triangles().tolist()}
    run(split_all, mesh)
    assert run(collapse_from, mesh, 42) == 80
    assert_valid(mesh)
    assert {tuple(sorted(face)) for face in mesh.triangles().tolist()} == faces
    assert (mesh.n_vertices, mesh.n_edges, mesh.n_faces) == (42, 120, 80)


def test_flips_in_a_kernel(run):
    mesh = hm.shapes.icosphere(2)
    assert run(flip_every, mesh, 5) > 80
    assert_valid(mesh)


def test_handles_and_views_see_what_a_kernel_added(run):
    mesh = hm.shapes.icosphere(1)
    v = mesh.vertices[0]
    assert v.degree == 5
    run(split_all, mesh)
    assert v.degree == 10
    assert len(mesh.topology.next) == mesh.n_halfedges == 2 * (120 + 240)


def test_topology_may_be_given_for_the_mesh(run):
    mesh = hm.shapes.icosphere(1)
    run(split_all, mesh.topology)
    assert np.allclose(mesh.points[42:], hm.geometry.face_centroids(hm.shapes.icosphere(1)))


def test_both_gears_do_the_same():
    one, other = hm.shapes.icosphere(2), hm.shapes.icosphere(2)
    for kernel, *more in ((flip_every, 3), (split_all,), (collapse_from, 170), (flip_every, 7)):
        kernel(one, *more)
        kernel.interpreted(other, *more)
    for name in ("next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge"):
        assert np.array_equal(getattr(one.topology, name), getattr(other.topology, name))
    assert np.array_equal(one.points, other.points)


# -- refusals that the twin found (tests/rotation): meshes with loop and parallel edges ------------------------------


def edges(n, *pairs):
    mesh = hm.Mesh([], n_vertices=n)
    for u, v in pairs:
        mesh.add_edge(u, v)
    return mesh


def test_stitch_that_doubles_an_edge_at_a_shared_end_is_refused():
    mesh = edges(3, (0, 1), (0, 1), (1, 2), (1, 2))
    assert hm.stitch_status(mesh, 0, 4, False) != 0


def test_stitch_may_double_edges_that_close_next():
    mesh = edges(3, (0, 1), (0, 1), (0, 2), (0, 2))
    assert hm.stitch_status(mesh, 3, 4, False) == 0
    assert mesh.zip_hole(3) == 2
    assert_valid(mesh)


def test_loop_edge_at_the_origin_is_no_reason_against_a_collapse():
    mesh = edges(2, (0, 0), (0, 1))
    assert hm.collapse_status(mesh, 2) == hm.collapse_status(mesh, 3) == 0


def test_collapse_beside_a_loop_edge_may_not_have_a_triangle_pass_a_vertex_twice():
    mesh = hm.Mesh([[1, 0, 0], [0, 2, 1], [0, 1, 2]], twins=[6, -1, 5, -1, 7, 2, 0, 4, -1], n_vertices=3)
    with pytest.raises(hm.TopologyError) as error:
        mesh.collapse(0)
    assert error.value.reason == "would_pinch_face"
