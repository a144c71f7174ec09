"""Building by hand: removing vertices, edges and faces, and adding again what was removed (O6, O7, N4)."""

from __future__ import annotations

import itertools
import random

import pytest

import halfmesh as hm
from halfmesh.core.operators.building import (
    add_edge,
    remove_edge,
    remove_face,
    remove_vertex,
    try_remove_edge,
    try_remove_vertex,
)
from handmade import face, loop, points, polygon, refused, valid


def test_o6_a_cube_is_taken_to_pieces():
    for seed in range(5):
        mesh, rng = hm.shapes.cube(), random.Random(seed)
        for v in rng.sample(range(8), 8):
            assert try_remove_vertex(mesh, v) == 0
            assert valid(mesh)
        assert mesh.n_edges == mesh.n_faces == 0
        refused(mesh, "deleted_element", lambda m=mesh: try_remove_vertex(m, 0))
        refused(mesh, "deleted_element", lambda m=mesh: try_remove_edge(m, 0))
        refused(mesh, "missing_element", lambda m=mesh: try_remove_edge(m, 99))


def test_o6_removing_an_edge_takes_its_faces_and_leaves_wire():
    mesh = hm.shapes.cube()
    remove_edge(mesh, 0)
    assert (mesh.n_faces, mesh.n_edges, mesh.n_vertices) == (4, 11, 8)
    assert valid(mesh)
    remove_face(mesh, int(mesh.topology.face.max()))
    assert mesh.n_edges == 11
    assert valid(mesh)


@pytest.mark.parametrize("n_wires", [0, 1, 2])
def test_o6_loops_are_removed_in_any_order(n_wires):
    for order in itertools.permutations(range(3)):
        mesh = points(1 + n_wires)
        for _ in range(3):
            add_edge(mesh, 0, 0)
        for v in range(n_wires):
            add_edge(mesh, v + 1, 0)
        for e in order:
            remove_edge(mesh, e)
            assert valid(mesh)
        remove_vertex(mesh, 0)
        assert mesh.n_edges == 0
        assert valid(mesh)


def test_o7_what_was_removed_can_be_added_again():
    mesh = hm.shapes.cube()
    sides = loop(mesh, int(hm.halfedge_of_face(mesh, 3)))
    before = mesh.topology.next.tolist()
    remove_face(mesh, 3)
    assert face(mesh, sides) == 6
    assert valid(mesh)
    assert mesh.topology.next.tolist() == before


def test_n4_a_mesh_built_face_by_face_in_any_order_is_the_mesh_from_the_list():
    cube = hm.shapes.cube()
    corners = [[int(hm.origin_of(cube, h)) for h in loop(cube, int(cube.topology.face_halfedge[f]))] for f in range(6)]
    for seed in range(10):
        mesh = points(8)
        for f in random.Random(seed).sample(range(6), 6):
            assert polygon(mesh, *corners[f]) >= 0
            assert valid(mesh)
        assert (mesh.n_edges, mesh.n_faces) == (12, 6)
        assert mesh.topology.__arrays__().counts[6] == 0
