"""Splitting and joining vertices, dissolving, making and filling holes: Euler's numbers and inverses on the zoo."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm
from alike import alike, changed, figures, refused, some
from halfmesh.testing import assert_valid, zoo

ZOO = zoo()
each_of_the_zoo = pytest.mark.parametrize("name", ZOO)


# ----------------------------------------------------------------------------------------------------------- vertices


@each_of_the_zoo
def test_every_vertex_of_the_zoo_can_be_split_at_any_two_corners_and_joined_again(name):
    model = ZOO[name].mesh()
    for v in some(model.vertices):
        ring = [h.index for h in model.vertices[v].outgoing()] if not model.vertices[v].is_isolated else []
        for a in ring[:3]:
            for b in ring:
                mesh = model.copy()
                h = mesh.split_vertex(a, b)
                assert_valid(mesh)
                assert changed(figures(model), mesh) == (1, 1, 0, 0, 0)
                moved = (ring.index(b) - ring.index(a)) % len(ring)
                assert h.target.degree == moved + 1
                mesh.join_vertices(h.twin, allow_parallel=True)
                assert_valid(mesh)
                assert alike(mesh, model)


def test_split_vertex_puts_the_new_one_where_it_is_told_and_says_which_halfedges_move():
    mesh = hm.shapes.octahedron()
    a, b, c, _ = mesh.vertices[0].outgoing()
    h = mesh.split_vertex(a, c, [1, 2, 3])
    assert h.target.point.tolist() == [1, 2, 3]
    assert (a.origin.index, b.origin, c.origin) == (0, h.target, h.target)
    assert (h.face, h.twin.face) == (c.face, a.face)


def test_split_vertex_with_one_corner_grows_a_leaf_into_the_face():
    mesh = hm.Mesh([[0, 1, 2]])
    h = mesh.split_vertex(0, 0)
    assert (h.face, h.twin.face, h.target.degree, mesh.faces[0].degree) == (mesh.faces[0], mesh.faces[0], 1, 5)


def test_halfedges_of_two_vertices_name_no_vertex_to_split():
    mesh = hm.Mesh([[0, 1, 2]])
    refused("different_vertices", mesh.split_vertex, 0, 2)


@each_of_the_zoo
def test_joining_the_ends_of_an_edge_leaves_the_faces(name):
    model = ZOO[name].mesh()
    for h in some(model.halfedges):
        mesh = model.copy()
        loose = mesh.can_join_vertices(h, allow_parallel=True)
        assert loose or model.halfedges[h].origin == model.halfedges[h].target
        if mesh.can_join_vertices(h):
            alone = model.halfedges[h].next.next.index == h and model.halfedges[h].next.index == h ^ 1
            mesh.join_vertices(h)
            assert_valid(mesh)
            assert changed(figures(model), mesh) == (-1, -1, 0, 0, -alone)
        elif loose:
            mesh.join_vertices(h, allow_parallel=True)
            assert_valid(mesh)


def test_joining_the_ends_of_a_triangles_edge_would_double_the_others():
    mesh = hm.Mesh([[0, 1, 2], [1, 0, 3]])
    refused("would_be_parallel", mesh.join_vertices, 0)
    mesh.join_vertices(0, allow_parallel=True)
    assert sorted(f.degree for f in mesh.faces) == [2, 2]
    refused("would_be_loop", mesh.join_vertices, mesh.faces[0].halfedge)


def test_edge_that_is_all_of_a_closed_face_stays():
    mesh = hm.Mesh([], n_vertices=2, edges=[[0, 1]])
    mesh.fill_hole(0)
    refused("small_face", mesh.join_vertices, 0, allow_parallel=True)
    refused("small_face", mesh.dissolve_vertex, 0)


# ----------------------------------------------------------------------------------------------------------- triangles


@each_of_the_zoo
def test_triangular_split_keeps_triangles(name):
    model = ZOO[name].mesh()
    for h in some(model.halfedges):
        sides = [model.halfedges[x].face for x in (h, h ^ 1)]
        mesh = model.copy()
        if mesh.can_split_edge_triangular(mesh.halfedges[h]):
            k = sum(f is not None for f in sides)
            v = mesh.split_edge_triangular(mesh.halfedges[h], at=0.25)
            assert_valid(mesh)
            assert changed(figures(model), mesh) == (1, 1 + k, k, 0, 0)
            assert v.degree == 2 + k
            assert all(f.degree == 3 for f in v.faces())
            assert mesh.is_triangular == model.is_triangular
            back = next(g for g in v.outgoing() if g.edge.index == h >> 1)
            if mesh.can_collapse(back):  # not where an edge joins the ends of the one that was split once more
                mesh.collapse(back)
                assert alike(mesh, model)
        else:
            assert any(f is not None and f.degree != 3 for f in sides) or name in {"pillow"} or "triangle" in name


def test_triangular_split_of_a_pillow_would_double_an_edge():
    mesh = hm.Mesh([[0, 1, 2], [0, 2, 1]])
    refused("would_be_parallel", mesh.split_edge_triangular, 0)
    assert mesh.split_edge_triangular(0, allow_parallel=True).degree == 4


def test_triangular_split_of_a_square_is_refused():
    mesh = hm.Mesh([[0, 1, 2, 3]])
    refused("not_triangle", mesh.split_edge_triangular, 0)


# ------------------------------------------------------------------------------------------------------------ dissolve


@each_of_the_zoo
def test_dissolving_undoes_a_split_of_a_face(name):
    model = ZOO[name].mesh()
    for f in some(model.faces):
        mesh = model.copy()
        v = mesh.split_face(f)
        if not mesh.can_dissolve_vertex(v):
            assert len({u.index for u in model.faces[f].vertices()}) < model.faces[f].degree  # a corner meets itself
            continue
        mesh.dissolve_vertex(v)
        assert_valid(mesh)
        assert alike(mesh, model)


@each_of_the_zoo
def test_dissolving_a_vertex_unites_the_faces_around_it(name):
    model = ZOO[name].mesh()
    for v in some(model.vertices):
        mesh = model.copy()
        if mesh.can_dissolve_vertex(v):
            k, closed = model.vertices[v].degree, not model.vertices[v].is_boundary
            mesh.dissolve_vertex(v)
            assert_valid(mesh)
            gone = (1, 0) if k <= 2 else (k, k - 1) if closed else (k - 1, k - 2)
            alone = k == 1 and model.vertices[v].halfedge.target.degree == 1
            assert changed(figures(model), mesh) == (-1, -gone[0], -gone[1], 0, -alone)


@pytest.mark.parametrize(
    ("mesh", "vertex", "reason"),
    [
        (hm.Mesh([[0, 1, 2]], n_vertices=4), 3, "isolated_vertex"),
        (hm.Mesh([[0, 1, 2]]), 0, "would_be_parallel"),
        (hm.Mesh([[0, 1, 2], [0, 3, 4]]), 0, "several_gaps"),
        (ZOO["torus of one vertex"].mesh(), 0, "loop_edge"),
        (ZOO["square in a square"].mesh(), 0, "same_face"),
    ],
)
def test_vertex_that_would_leave_no_polygon_stays(mesh, vertex, reason):
    mesh = mesh.copy()
    refused(reason, mesh.dissolve_vertex, vertex)


def test_dissolving_an_edge_takes_ends_along_that_are_left_with_two_edges():
    mesh = hm.shapes.grid(2, 1)
    middle = next(e for e in mesh.edges if None not in e.faces)
    face = mesh.dissolve_edge(middle)
    assert (face.degree, mesh.n_vertices, mesh.n_edges, mesh.n_faces) == (4, 4, 4, 1)
    assert_valid(mesh)


@each_of_the_zoo
def test_dissolving_any_edge_keeps_the_surface(name):
    model = ZOO[name].mesh()
    for e in some(model.edges):
        mesh = model.copy()
        if mesh.can_dissolve_edge(e):
            mesh.dissolve_edge(e)
            assert_valid(mesh)
            assert (mesh.euler_characteristic, mesh.n_boundary_loops) == (
                model.euler_characteristic,
                model.n_boundary_loops,
            )


# --------------------------------------------------------------------------------------------------------------- holes


@each_of_the_zoo
def test_hole_made_of_a_face_is_filled_again(name):
    model = ZOO[name].mesh()
    for f in some(model.faces):
        mesh = model.copy()
        h = mesh.make_hole(f)
        assert_valid(mesh)
        assert changed(figures(model), mesh)[:3] == (0, 0, -1)
        assert mesh.fill_hole(h).halfedge == h
        assert_valid(mesh)
        assert alike(mesh, model)


@each_of_the_zoo
def test_all_holes_of_the_zoo_can_be_filled(name):
    mesh = ZOO[name].mesh()
    loops = mesh.boundary_loops()
    for loop in loops:
        face = mesh.fill_hole(int(loop[-1]))
        assert face.degree == len(loop)
    assert_valid(mesh)
    assert not mesh.has_boundary
    assert mesh.n_faces == ZOO[name].figures.n_faces + len(loops)


def test_face_along_a_halfedge_that_has_one_is_refused():
    mesh = hm.Mesh([[0, 1, 2]])
    refused("not_exterior", mesh.fill_hole, 0)


@each_of_the_zoo
def test_faces_grow_along_every_boundary(name):
    model = ZOO[name].mesh()
    for loop in model.boundary_loops():
        a, others = int(loop[0]), loop[1:].tolist()
        for b in others:
            mesh = model.copy()
            w = mesh.add_vertex_and_face_to_boundary(a, b, [7, 8, 9])
            assert_valid(mesh)
            assert changed(figures(model), mesh) == (1, 2, 1, 0, 0)
            assert (w.degree, w.point.tolist()) == (2, [7, 8, 9])
            assert mesh.halfedges[a].face.index == mesh.n_faces - 1
            mesh = model.copy()
            if mesh.can_add_face_to_boundary(a, b, allow_parallel=True):
                f = mesh.add_face_to_boundary(a, b, allow_parallel=True)
                assert_valid(mesh)
                assert changed(figures(model), mesh) == (0, 1, 1, 0, 0)
                assert f.degree == others.index(b) + 2
                mesh.remove_face(f)
                mesh.remove_edge(mesh.n_edges - 1)
                assert alike(mesh, model)


def test_face_between_holes_or_at_one_corner_or_beside_an_edge_is_refused():
    mesh = hm.shapes.cylinder(6)
    (a, *_), (b, *_) = mesh.boundary_loops()
    refused("different_loops", mesh.add_face_to_boundary, int(a), int(b))
    refused("same_corner", mesh.add_vertex_and_face_to_boundary, int(a), int(a))
    refused("not_exterior", mesh.add_face_to_boundary, int(a) ^ 1, int(a))
    refused("would_be_parallel", mesh.add_face_to_boundary, int(a), mesh.halfedges[int(a)].next)


# ----------------------------------------------------------------------------------------------------------- attributes


def test_values_are_shared_when_a_vertex_is_split_and_united_when_it_is_joined():
    mesh = hm.shapes.octahedron()
    mass = mesh.vertex_data.add("mass", float, default=0.0, policy="sum")
    mass[:] = 2.0
    mesh.vertex_data["label"] = np.arange(6)
    a, _, b, _ = mesh.vertices[0].outgoing()
    h = mesh.split_vertex(a, b)
    assert mesh.vertex_data["mass"][[0, h.target.index]].tolist() == [1.0, 1.0]
    assert mesh.vertex_data["label"][h.target.index] == 0
    mesh.join_vertices(h.twin)
    assert mesh.vertex_data["mass"][mesh.vertices.indices].tolist() == [2.0] * 6


def test_corners_keep_their_values_when_a_vertex_is_split():
    mesh = hm.shapes.octahedron()
    mesh.halfedge_data["side"] = mesh.topology.face.copy()
    a, _, b, _ = mesh.vertices[0].outgoing()
    mesh.split_vertex(a, b)
    assert np.array_equal(mesh.halfedge_data["side"], mesh.topology.face)


def test_triangular_split_interpolates_along_the_edge():
    mesh = hm.Mesh([[0, 1, 2], [1, 0, 3]], points=[[0, 0], [4, 0], [2, 2], [2, -2]])
    assert mesh.split_edge_triangular(mesh.find_halfedge(1, 0), at=0.25).point.tolist() == [3, 0, 0]
    assert mesh.split_edge_triangular(mesh.find_halfedge(0, 2), [0, 9]).point.tolist() == [0, 9, 0]


def test_values_of_two_edges_are_united_when_the_vertex_between_is_dissolved():
    mesh = hm.shapes.grid(2, 2)
    mesh.edge_data.add("length", float, policy="sum")[:] = 1.0
    mesh.edge_data.add("sharpness", float, policy="max")[:] = 2.0
    n = mesh.n_edges
    v = mesh.split_edge(0, at=0.25)
    mesh.edge_data["sharpness"][-1] = 3.0
    mesh.dissolve_vertex(v)
    living = mesh.edges.indices
    assert mesh.edge_data["length"][living].tolist() == [1.0] * n
    assert sorted(mesh.edge_data["sharpness"][living].tolist())[-2:] == [2.0, 3.0]
