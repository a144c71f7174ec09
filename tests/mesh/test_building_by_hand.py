"""Adding and removing through the mesh: the operations of the general half-edge mesh, with its points."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.testing import assert_valid, zoo

ZOO = zoo()


@pytest.mark.parametrize("name", ZOO)
def test_mesh_is_taken_down_face_by_face_edge_by_edge_vertex_by_vertex(name):
    mesh = ZOO[name].mesh()
    for kind, remove in (("faces", mesh.remove_face), ("edges", mesh.remove_edge), ("vertices", mesh.remove_vertex)):
        for element in list(getattr(mesh, kind)):
            remove(element)
            assert_valid(mesh)
        assert len(getattr(mesh, kind)) == 0


@pytest.mark.parametrize("name", ZOO)
def test_vertices_are_removed_with_all_that_hangs_on_them(name):
    mesh = ZOO[name].mesh()
    for v in mesh.vertices:
        mesh.remove_vertex(v)
        assert_valid(mesh)
    assert (mesh.n_vertices, mesh.n_edges, mesh.n_faces) == (0, 0, 0)


def test_cube_built_by_hand_is_the_cube():
    cube, mesh = hm.shapes.cube(), hm.Mesh([])
    for point in cube.points:
        mesh.add_vertex(point)
    for face in cube.faces:
        mesh.add_face([v.index for v in face.vertices()])
        assert_valid(mesh)
    assert np.array_equal(mesh.face_vertices()[0], cube.face_vertices()[0])
    assert np.array_equal(mesh.points, cube.points)
    assert mesh.has_points
    assert (mesh.genus, mesh.has_boundary) == (0, False)


def test_wire_becomes_a_face():
    mesh = hm.Mesh([], n_vertices=3)
    edges = [mesh.add_edge(i, (i + 1) % 3) for i in range(3)]
    f = mesh.add_face(halfedges=[e.halfedge for e in edges])
    assert_valid(mesh)
    assert (mesh.n_faces, f.degree, mesh.n_boundary_loops) == (1, 3, 1)


def test_loops_and_parallels_by_policy():
    mesh = hm.Mesh([], n_vertices=2)
    e = mesh.add_edge(0, 1)
    assert mesh.add_edge(1, 0, allow_parallel=False) == e
    assert mesh.add_edge(0, 1) != e
    with pytest.raises(hm.TopologyError) as refused:
        mesh.add_edge(0, 0, allow_loop=False)
    assert refused.value.reason == "loop_edge"
    mesh.add_edge(0, 0)
    assert_valid(mesh)
    assert mesh.vertices[0].degree == 4


def test_refused_faces_change_nothing():
    mesh = hm.Mesh([[0, 1, 2]], n_vertices=4)
    before = [column.copy() for column in (mesh.topology.next, mesh.topology.face, mesh.topology.vertex_halfedge)]
    for vertices, reason in (([0, 1, 3], "taken_halfedge"), ([0, 1], "few_vertices")):
        with pytest.raises(hm.TopologyError) as refused:
            mesh.add_face(vertices)
        assert refused.value.reason == reason
    for wrong in ([0, 1, 9], [0, -1, 2], [0, 1, True]):
        with pytest.raises(hm.ElementError):
            mesh.add_face(wrong)
    with pytest.raises(TypeError):
        mesh.add_face()
    after = [mesh.topology.next, mesh.topology.face, mesh.topology.vertex_halfedge]
    assert all(np.array_equal(a, b) for a, b in zip(before, after, strict=True))


def test_edge_at_a_closed_vertex_is_refused():
    mesh = hm.shapes.cube()
    with pytest.raises(hm.TopologyError) as refused:
        mesh.add_edge(0, 6)
    assert refused.value.reason == "closed_vertex"


def test_adding_is_amortised():
    mesh = hm.Mesh([])
    capacities = set()
    for _ in range(1000):
        mesh.add_vertex()
        capacities.add(mesh.topology.capacity_nbytes)
    assert mesh.n_vertices == 1000
    assert len(capacities) < 15


def test_edge_goes_into_the_gap_that_is_said():
    for n in range(2):
        mesh = hm.Mesh([[0, 1, 2], [0, 3, 4]], n_vertices=6)
        gaps = [h for h in mesh.vertices[0].outgoing() if h.is_exterior]
        e = mesh.add_edge(gaps[n], 5)
        assert_valid(mesh)
        assert (e.vertices, e.halfedge.twin.next) == ((mesh.vertices[0], mesh.vertices[5]), gaps[n])
        loop = mesh.add_edge(gaps[n], gaps[1 - n])
        assert_valid(mesh)
        assert loop.halfedge.twin.next == gaps[n]


def test_halfedge_with_a_face_names_no_gap():
    mesh = hm.Mesh([[0, 1, 2]], n_vertices=4)
    with pytest.raises(hm.TopologyError) as error:
        mesh.add_edge(mesh.find_halfedge(0, 1), 3)
    assert error.value.reason == "not_exterior"
    assert mesh.n_edges == 3


def test_questions_say_what_the_acts_do_and_change_nothing():
    mesh = hm.Mesh([[0, 1, 2], [2, 1, 3]], n_vertices=6)
    mesh.add_edge(4, 5)
    before = [getattr(mesh.topology, name).copy() for name in ("next", "prev", "origin", "face", "vertex_halfedge")]
    counts = mesh.n_edges, mesh.n_faces, mesh.revision
    vertices = range(6)
    for corners in itertools.permutations(vertices, 3):
        can, other = mesh.can_add_face(corners), mesh.copy()
        assert can == does(lambda other=other, corners=corners: other.add_face(corners))
    for u, v in itertools.product(vertices, vertices):
        for options in ({}, {"allow_loop": False}, {"allow_parallel": False}):
            can, other = mesh.can_add_edge(u, v, **options), mesh.copy()
            assert can == does(lambda other=other, u=u, v=v, options=options: other.add_edge(u, v, **options))
    for h, g in itertools.product(range(mesh.n_halfedges), repeat=2):
        other = mesh.copy()
        assert mesh.can_make_adjacent(h, g) == does(lambda other=other, h=h, g=g: other.make_adjacent(h, g))
    rim = [int(h) for h in mesh.boundary_loops()[0]]
    assert mesh.can_add_face(halfedges=rim)
    assert not mesh.can_add_face(halfedges=rim[::-1])
    assert (mesh.n_edges, mesh.n_faces, mesh.revision) == counts
    for name, column in zip(("next", "prev", "origin", "face", "vertex_halfedge"), before, strict=True):
        assert np.array_equal(getattr(mesh.topology, name), column)


def does(act):
    try:
        act()
    except hm.TopologyError:
        return False
    return True
