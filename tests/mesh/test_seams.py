"""Edges opened, vertices welded, surfaces cut, stitched and zipped, loops split and joined: numbers and inverses."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import halfmesh as hm
from alike import alike, changed, figures, refused, some
from halfmesh.testing import assert_valid, zoo

ZOO = zoo()
each_of_the_zoo = pytest.mark.parametrize("name", ZOO)


def gaps(vertex):
    return [h for h in vertex.outgoing() if h.is_exterior]


def path(mesh, *vertices):
    return [mesh.find_halfedge(u, v) for u, v in itertools.pairwise(vertices)]


# --------------------------------------------------------------------------------------------------------------- edges


@each_of_the_zoo
def test_opened_edge_is_closed_again(name):
    model = ZOO[name].mesh()
    for e in some(model.edges):
        mesh = model.copy()
        if None in mesh.edges[e].faces:
            refused("boundary_edge", mesh.open_edge, e)
            continue
        f, g = mesh.edges[e].faces
        new = mesh.open_edge(e)
        assert_valid(mesh)
        assert changed(figures(model), mesh) == (0, 1, 0, 0, 1)
        assert (mesh.edges[e].faces, new.faces) == ((f, None), (g, None))
        assert mesh.close_edge(mesh.edges[e].halfedge.twin).index == e
        assert_valid(mesh)
        assert alike(mesh, model)


@each_of_the_zoo
def test_only_a_hole_of_two_sides_is_closed(name):
    model = ZOO[name].mesh()
    for loop in model.boundary_loops():
        mesh, h = model.copy(), int(loop[0])
        if len(loop) == 2 and loop[0] >> 1 != loop[1] >> 1:
            mesh.close_edge(h)
            assert_valid(mesh)
        else:
            refused("not_two_sided", mesh.close_edge, h)


# ------------------------------------------------------------------------------------------------------------ vertices


@each_of_the_zoo
def test_any_two_vertices_at_gaps_are_welded_and_taken_apart(name):
    model = ZOO[name].mesh()
    exterior = [h for h in model.halfedges.indices.tolist() if model.halfedges[h].is_exterior]
    for a, b in itertools.product(exterior[::3], exterior[::4]):
        mesh = model.copy()
        u, v = mesh.halfedges[a].origin, mesh.halfedges[b].origin
        if u == v:
            continue
        degrees = u.degree, v.degree
        mesh.weld(mesh.halfedges[a], mesh.halfedges[b], allow_parallel=True)
        assert_valid(mesh)
        assert changed(figures(model), mesh)[:3] == (-1, 0, 0)
        assert (u.degree, v.is_alive) == (sum(degrees), False)
        w = mesh.unweld(a, b)
        assert_valid(mesh)
        assert (u.degree, w.degree, w) == (*degrees, mesh.halfedges[b].origin)
        assert alike(mesh, model)


@each_of_the_zoo
def test_vertex_of_several_gaps_comes_apart_into_its_fans(name):
    mesh = ZOO[name].mesh()
    for v in mesh.vertices.indices.tolist():
        n = len(gaps(mesh.vertices[v])) if not mesh.vertices[v].is_isolated else 0
        while n > 1:
            a, b = gaps(mesh.vertices[v])[:2]
            mesh.unweld(a, b)
            assert_valid(mesh)
            n -= 1
    assert all(v.is_isolated or len(gaps(v)) <= 1 for v in mesh.vertices)


def test_welding_says_what_is_wrong():
    mesh = hm.Mesh([[0, 1, 2], [2, 1, 3]], n_vertices=5)
    refused("would_be_loop", mesh.weld, 0, 1)
    refused("would_be_parallel", mesh.weld, 0, 3)
    refused("same_vertex", mesh.weld, 0, 0)
    cube = hm.shapes.cube()
    refused("closed_vertex", cube.weld, 0, 6)
    refused("same_corner", mesh.unweld, mesh.find_halfedge(1, 0), mesh.find_halfedge(1, 0))
    refused("different_vertices", mesh.unweld, mesh.find_halfedge(1, 0), mesh.find_halfedge(0, 2))
    refused("not_exterior", mesh.unweld, 0, 0)


def test_isolated_vertices_are_welded_to_anything_with_a_gap():
    mesh = hm.Mesh([[0, 1, 2]], points=[[0, 0], [2, 0], [0, 2], [8, 8], [4, 4]])
    mesh.weld(0, 3)
    assert mesh.points[0].tolist() == [4, 4, 0]  # in the middle of both
    mesh.weld(4, 0, [1, 1])
    assert_valid(mesh)
    assert (mesh.n_vertices, mesh.n_isolated_vertices, [v.index for v in mesh.faces[0].vertices()]) == (3, 0, [4, 1, 2])
    assert mesh.points[4].tolist() == [1, 1, 0]


# ----------------------------------------------------------------------------------------------------------------- cut


def test_cut_inside_leaves_both_ends_whole():
    mesh = hm.shapes.grid(4, 4)
    before = figures(mesh)
    mesh.cut(path(mesh, 6, 7, 8))
    assert_valid(mesh)
    assert changed(before, mesh) == (1, 2, 0, 0, 1)


def test_cut_from_the_boundary_opens_it_and_one_across_parts_the_mesh():
    mesh = hm.shapes.grid(2, 2)
    mesh.cut(path(mesh, 3, 4))
    assert_valid(mesh)
    assert (mesh.n_vertices, mesh.n_boundary_loops) == (10, 1)
    mesh = hm.shapes.grid(2, 2)
    mesh.cut(path(mesh, 3, 4, 5))
    assert_valid(mesh)
    assert (mesh.n_vertices, mesh.n_boundary_loops, mesh.n_connected_components) == (12, 2, 2)


def test_cut_that_branches_gives_each_part_a_vertex():
    mesh = hm.shapes.grid(2, 2)
    before = figures(mesh)
    mesh.cut(list(mesh.vertices[4].outgoing())[:3])
    assert_valid(mesh)
    assert changed(before, mesh) == (5, 3, 0, 2, 2)


def test_cut_tells_the_new_edge_beside_each_and_keeps_the_left():
    mesh = hm.shapes.grid(4, 4)
    along = path(mesh, 6, 7, 8)
    left, right = [h.face for h in along], [h.twin.face for h in along]
    new = mesh.cut(along)
    assert [h.face for h in along] == left
    assert [mesh.edges[int(e)].halfedge.face for e in new] == right


@each_of_the_zoo
def test_every_inner_edge_cut_alone_is_stitched_again(name):
    model = ZOO[name].mesh()
    for e in some(model.edges):
        mesh = model.copy()
        if None in mesh.edges[e].faces:
            refused("boundary_edge", mesh.cut, [mesh.edges[e]])
            continue
        if mesh.edges[e].vertices[0] == mesh.edges[e].vertices[1] or any(v.is_boundary for v in mesh.edges[e].vertices):
            continue  # a loop edge can't be stitched; and what was pinched at an end is not pinched again
        new = int(mesh.cut([mesh.edges[e]])[0])
        assert_valid(mesh)
        a, b = mesh.edges[e].halfedge.twin, mesh.edges[new].halfedge.twin
        mesh.stitch(a, b, allow_parallel=True)
        assert_valid(mesh)
        assert alike(mesh, model)


def test_cutting_all_edges_leaves_faces_by_themselves_and_stitching_undoes_it():
    model = hm.shapes.icosphere(1)
    mesh = model.copy()
    new = mesh.cut(mesh.edges)
    assert_valid(mesh)
    assert (mesh.n_vertices, mesh.n_edges, mesh.n_connected_components) == (240, 240, 80)
    for e, other in enumerate(new.tolist()):
        mesh.stitch(2 * e + 1, 2 * other + 1, allow_parallel=True)
    assert_valid(mesh)
    assert alike(mesh, model)


def test_cut_refuses_an_edge_twice_and_one_that_is_open():
    mesh = hm.shapes.grid(2, 2)
    h = mesh.find_halfedge(3, 4)
    refused("repeated_halfedge", mesh.cut, [h, h.twin])
    refused("boundary_edge", mesh.cut, [h, mesh.find_halfedge(0, 1)])
    assert mesh.cut([]).tolist() == []


# -------------------------------------------------------------------------------------------------------------- stitch


def test_stitching_two_triangles_makes_a_quad_of_two():
    mesh = hm.Mesh([[0, 1, 2], [3, 4, 5]])
    mesh.stitch(mesh.find_halfedge(1, 0), mesh.find_halfedge(4, 3))
    assert_valid(mesh)
    assert alike(mesh, hm.Mesh([[0, 1, 2], [1, 0, 3]]))


def test_ends_of_a_strip_are_stitched_to_a_tube():
    mesh = hm.shapes.grid(4, 1)
    mesh.stitch(mesh.find_halfedge(0, 5), mesh.find_halfedge(9, 4))
    assert_valid(mesh)
    assert (mesh.n_vertices, mesh.n_boundary_loops, mesh.euler_characteristic) == (8, 2, 0)


def test_stitching_says_what_is_wrong():
    mesh = hm.Mesh([[0, 1, 2], [3, 4, 5]])
    a, b = mesh.find_halfedge(1, 0), mesh.find_halfedge(4, 3)
    refused("not_exterior", mesh.stitch, a.twin, b)
    refused("same_edge", mesh.stitch, a, a)
    refused("would_be_loop", mesh.stitch, a, a.next)
    strip = hm.Mesh([[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    refused("would_be_loop", strip.stitch, strip.find_halfedge(1, 0), strip.find_halfedge(2, 1))


def test_stitch_that_would_cut_something_off_is_refused():
    mesh = hm.Mesh([[0, 1, 2, 3], [0, 4, 5], [0, 6, 7, 8]])  # three fans at vertex 0
    refused("no_gap", mesh.stitch, mesh.find_halfedge(1, 0), mesh.find_halfedge(0, 3), allow_parallel=True)


def test_zipping_a_cut_gives_the_surface_again():
    model = hm.shapes.grid(4, 4)
    mesh = model.copy()
    mesh.cut(path(mesh, 6, 7, 8, 13))
    end = next(h for h in mesh.vertices[13].incoming() if h.is_exterior)
    before = end.prev
    assert mesh.zip_hole(end, 1) == 1
    assert_valid(mesh)
    assert mesh.n_boundary_loops == 2
    assert mesh.zip_hole(before) == 2
    assert_valid(mesh)
    assert alike(mesh, model)
    assert mesh.zip_hole(0, 0) == 0


@each_of_the_zoo
def test_zipping_any_hole_keeps_all_laws(name):
    model = ZOO[name].mesh()
    for loop in model.boundary_loops():
        mesh = model.copy()
        if mesh.can_zip_hole(int(loop[0])):
            n = mesh.zip_hole(int(loop[0]))
            assert_valid(mesh)
            assert n <= len(loop) // 2
            assert mesh.n_edges == model.n_edges - n


# --------------------------------------------------------------------------------------------------------------- loops


def around(mesh, start, n):
    """Straight on through vertices of four edges."""
    loop = [mesh.halfedges[start]]
    while len(loop) < n:
        loop.append(loop[-1].next.twin.next)
    return loop


def test_torus_is_cut_to_a_sphere_and_glued_again():
    model = hm.shapes.torus(5, 4)
    starts = [h for h in range(8) if around(model, h, 5)[-1].target == model.halfedges[h].origin]
    n = 5 if starts else 4
    mesh = model.copy()
    loop = around(mesh, starts[0] if starts else 0, n)
    f, g = mesh.split_loop(loop)
    assert_valid(mesh)
    assert changed(figures(model), mesh) == (n, n, 2, 0, 0)
    assert (f.degree, g.degree, mesh.genus) == (n, n, 0)
    mesh.join_loop(loop[0].twin, next(h for h in g.halfedges() if h.twin.face is not None), allow_parallel=True)
    assert_valid(mesh)
    assert mesh.genus == 1


def test_splitting_and_joining_a_loop_are_inverse():
    model = hm.shapes.icosphere(2)
    h = model.halfedges[0]
    loop = [h, h.next, h.next.next]
    mesh = model.copy()
    f, g = mesh.split_loop([mesh.halfedges[x.index] for x in loop])
    assert_valid(mesh)
    assert (mesh.n_connected_components, mesh.n_faces) == (2, 322)
    inner = mesh.halfedges[h.index ^ 1]
    outer = next(x for x in g.halfedges() if x.twin.face is not None and x.twin.index == 2 * (model.n_edges))
    assert (inner.face, outer.face) == (f, g)
    mesh.join_loop(inner, outer)
    assert_valid(mesh)
    assert alike(mesh, model)


def test_handle_is_made_between_two_faces():
    mesh = hm.shapes.icosphere(2)
    far = max(mesh.faces, key=lambda f: np.linalg.norm(f.halfedge.origin.point - mesh.faces[0].halfedge.origin.point))
    before = figures(mesh)
    mesh.join_loop(mesh.faces[0].halfedge, far.halfedge)
    assert_valid(mesh)
    assert changed(before, mesh) == (-3, -3, -2, 0, 0)
    assert mesh.genus == 1


def test_paths_that_are_no_cycles_are_refused():
    mesh = hm.shapes.grid(4, 4)
    square = path(mesh, 6, 7, 12, 11, 6)
    refused("not_a_chain", mesh.split_loop, square[:3])
    refused("small_face", mesh.split_loop, square[:2])
    refused("boundary_edge", mesh.split_loop, path(mesh, 0, 1, 6, 5, 0))
    refused("not_a_cycle", mesh.split_loop, path(mesh, 1, 6, 7, 2, 7, 6, 1))
    refused("not_a_cycle", mesh.split_loop, square + square)


def test_faces_that_touch_or_differ_are_not_glued():
    mesh = hm.shapes.icosphere(1)
    f = mesh.faces[0]
    refused("shared_vertex", mesh.join_loop, f.halfedge, mesh.halfedges[f.halfedge.index ^ 1])
    refused("same_face", mesh.join_loop, f.halfedge, f.halfedge.next)
    prism = hm.Mesh([[0, 2, 1], [3, 4, 5, 6]], n_vertices=7)
    refused("different_degrees", prism.join_loop, 0, prism.faces[1].halfedge)
    refused("no_face", prism.join_loop, 1, prism.faces[1].halfedge)


def test_glue_that_would_double_edges_leaves_everything_as_it_was():
    mesh = hm.shapes.grid(1, 3)  # three quads in a row: the first and the last are one apart
    first, last = mesh.faces[0].halfedge, mesh.faces[2].halfedge
    assert not all(mesh.can_join_loop(a, b) for a in first.face.halfedges() for b in last.face.halfedges())
    for a, b in itertools.product(first.face.halfedges(), last.face.halfedges()):
        if not mesh.can_join_loop(a, b):
            with pytest.raises(hm.TopologyError) as error:
                mesh.join_loop(a, b)
            assert error.value.reason in {"would_be_loop", "would_be_parallel", "no_gap"}
    assert (mesh.n_vertices, mesh.n_edges, mesh.n_faces) == (8, 10, 3)
    assert_valid(mesh)


# ---------------------------------------------------------------------------------------------------------- attributes


def test_values_follow_a_cut_and_a_stitch():
    mesh = hm.shapes.grid(2, 2)
    mesh.vertex_data["label"] = np.arange(9)
    mesh.edge_data["crease"] = np.arange(12.0)
    mesh.halfedge_data["uv"] = np.arange(24.0)
    before = mesh.halfedge_data["uv"].copy()
    h, face = mesh.find_halfedge(3, 4), mesh.find_halfedge(4, 3).face
    corner = mesh.find_halfedge(4, 3).index
    (new,) = mesh.cut([h])
    assert mesh.edge_data["crease"][new] == mesh.edge_data["crease"][h.edge.index]
    assert mesh.vertex_data["label"][9:].tolist() == [3]
    moved = mesh.edges[int(new)].halfedge
    assert (moved.face, mesh.halfedge_data["uv"][moved.index]) == (face, before[corner])
    mesh.stitch(h.twin, moved.twin)
    assert mesh.halfedge_data["uv"][h.twin.index] == before[corner]
    assert mesh.vertex_data["label"][mesh.vertices.indices].tolist()[:3] == [0, 1, 2]


def test_sums_of_an_edge_are_shared_when_it_is_opened_and_united_when_it_is_closed():
    mesh = hm.shapes.grid(3, 3)
    length = mesh.edge_data.add("length", float, policy="sum")
    length[:] = 1.0
    mesh.edge_data["label"] = np.arange(len(length))
    h = mesh.find_halfedge(4, 5)
    new = mesh.open_edge(h)
    assert mesh.edge_data["length"][[h.edge.index, new.index]].tolist() == [0.5, 0.5]
    assert mesh.edge_data["label"][new.index] == h.edge.index
    mesh.close_edge(h.twin)
    assert mesh.edge_data["length"][mesh.edges.indices].tolist() == [1.0] * len(length)


@pytest.mark.parametrize("allow_parallel", [False, True])
@each_of_the_zoo
def test_asking_for_a_weld_of_vertices_tells_what_comes(name, allow_parallel):
    model = ZOO[name].mesh()
    vertices = some(model.vertices, 6)
    for u, v in itertools.product(vertices, vertices):
        mesh = model.copy()
        answer = mesh.can_weld(u, v, allow_parallel=allow_parallel)
        assert answer == mesh.can_weld(mesh.vertices[u], v, allow_parallel=allow_parallel)
        try:
            mesh.weld(u, v, allow_parallel=allow_parallel)
        except hm.TopologyError:
            assert not answer
        else:
            assert answer


def test_welded_vertices_meet_in_the_middle():
    mesh = hm.Mesh([[0, 1, 2], [3, 4, 5]], np.arange(12.0).reshape(6, 2))
    assert mesh.weld(2, 3).point.tolist() == [5, 6, 0]
    assert mesh.weld(0, 4, [1, 2, 3], allow_parallel=True).point.tolist() == [1, 2, 3]
