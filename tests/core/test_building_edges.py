"""Building by hand: adding vertices and edges on the fully general mesh, and their order at a vertex (O1-O3)."""

from __future__ import annotations

import itertools
import random

import halfmesh as hm
from halfmesh.core.operators.building import (
    add_edge,
    add_edge_in,
    add_edge_status,
    add_vertex,
    find_free_between,
    find_free_incident,
    make_adjacent_status,
    try_add_edge,
    try_add_vertex,
    try_make_adjacent,
    try_remove_edge,
)
from handmade import NAMED, loop, points, polygon, refused, valid

# -- vertices and edges (O1, O2) -------------------------------------------------------------------------------------


def test_o1_vertices_are_added_isolated_and_the_columns_grow():
    mesh = points(0)
    assert [add_vertex(mesh) for _ in range(40)] == list(range(40))
    assert try_add_vertex(mesh) == 40
    assert mesh.topology.vertex_halfedge.tolist() == [-1] * 41
    assert valid(mesh)


def test_o2_an_edge_between_isolated_vertices():
    mesh = points(2)
    h = try_add_edge(mesh, 1, 0)
    assert (h, hm.origin_of(mesh, h), hm.target_of(mesh, h)) == (0, 1, 0)
    assert loop(mesh, h) == [0, 1]
    assert valid(mesh)


def test_o2_loops_at_an_isolated_vertex_and_at_one_with_edges():
    mesh = points(2)
    h = add_edge(mesh, 0, 0)
    assert (loop(mesh, h), loop(mesh, h ^ 1)) == ([0], [1])
    assert valid(mesh)
    add_edge(mesh, 0, 1)
    add_edge(mesh, 1, 1)
    add_edge(mesh, 0, 0)
    assert valid(mesh)


def test_o2_parallel_edges():
    mesh = points(2)
    for n in range(1, 5):
        add_edge(mesh, 0, 1)
        assert mesh.n_edges == n
        assert valid(mesh)


def test_o2_a_star_grows_and_shrinks():
    mesh = points(30)
    for v in range(1, 30):
        assert try_add_edge(mesh, 0, v) == 2 * (v - 1)
        assert valid(mesh)
    for e in random.Random(1).sample(range(29), 29):
        assert try_remove_edge(mesh, e) == 0
        assert valid(mesh)
    assert mesh.topology.vertex_halfedge.tolist() == [-1] * 30


def test_o2_the_gap_can_be_said():
    mesh = points(6)
    polygon(mesh, 0, 1, 2)
    polygon(mesh, 0, 3, 4)
    gaps = [h for h in range(mesh.n_halfedges) if hm.origin_of(mesh, h) == 0 and hm.face_of(mesh, h) < 0]
    for gap in gaps:
        other = mesh.copy()
        there = add_edge(other, 5, 5)
        h = add_edge_in(other, gap, there)
        assert hm.next_of(other, h ^ 1) == gap
        assert hm.next_of(other, h) == there
        assert valid(other)
        twice = mesh.copy()
        h = add_edge_in(twice, gap, gap)
        assert hm.next_of(twice, h) == gap
        assert valid(twice)


def test_o2_no_edge_at_a_closed_vertex():
    mesh = hm.shapes.cube()
    v = add_vertex(mesh)
    for pair in ((0, v), (v, 0), (0, 0)):
        assert add_edge_status(mesh, *pair) == NAMED["closed_vertex"]
        refused(mesh, "closed_vertex", lambda pair=pair: try_add_edge(mesh, *pair))
    refused(mesh, "missing_element", lambda: try_add_edge(mesh, 0, v + 1))
    refused(mesh, "missing_element", lambda: try_add_edge(mesh, -1, v))


# -- make adjacent (O3) ----------------------------------------------------------------------------------------------


def test_o3_make_adjacent_orders_wire_at_will():
    for order in itertools.permutations(range(1, 5)):
        mesh = points(5)
        arms = [add_edge(mesh, 0, v) for v in range(1, 5)]
        chain = [arms[v - 1] for v in order]
        for a, b in itertools.pairwise(chain):
            assert try_make_adjacent(mesh, a ^ 1, b) == 0
            assert hm.next_of(mesh, a ^ 1) == b
            assert valid(mesh)


def test_o3_refusals():
    mesh = points(5)
    polygon(mesh, 0, 1, 2)
    polygon(mesh, 0, 3, 4)
    inside = int(hm.halfedge_of_face(mesh, 0))
    refused(mesh, "taken_halfedge", lambda: try_make_adjacent(mesh, int(hm.prev_of(mesh, inside)), inside))
    refused(mesh, "not_a_chain", lambda: try_make_adjacent(mesh, inside, inside))
    refused(mesh, "missing_element", lambda: try_make_adjacent(mesh, 99, inside))
    # of each triangle: out of 0 and into 0; the fan can't be closed on itself while the other one is there
    outs = [h for h in range(12) if hm.origin_of(mesh, h) == 0 and hm.face_of(mesh, h) < 0]
    ins = [h for h in range(12) if hm.target_of(mesh, h) == 0 and hm.face_of(mesh, h) < 0]
    found = [make_adjacent_status(mesh, a, b) for a in ins for b in outs]
    assert sorted(found) == [0, 0, NAMED["no_gap"], NAMED["no_gap"]]
    for a in ins:
        for b in outs:
            if make_adjacent_status(mesh, a, b):
                refused(mesh, "no_gap", lambda a=a, b=b: try_make_adjacent(mesh, a, b))


def test_o3_free_halfedges_are_found():
    mesh = points(4)
    assert find_free_incident(mesh, 0) == -1
    a, b = add_edge(mesh, 0, 1), add_edge(mesh, 0, 2)
    assert hm.target_of(mesh, find_free_incident(mesh, 0)) == 0
    assert find_free_between(mesh, 0, a ^ 1, b ^ 1) == a ^ 1
    assert find_free_between(mesh, 0, a ^ 1, a ^ 1) == -1
    assert find_free_incident(hm.shapes.cube(), 0) == -1
