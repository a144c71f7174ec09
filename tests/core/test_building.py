"""Building by hand: adding and removing vertices, edges and faces on the fully general mesh (O1-O7, R, N4)."""

from __future__ import annotations

import itertools
import random

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.core.invariants import check
from halfmesh.core.operators import building
from halfmesh.core.operators.building import (
    add_edge,
    add_edge_in,
    add_edge_status,
    add_vertex,
    find_free_between,
    find_free_incident,
    make_adjacent_status,
    remove_edge,
    remove_face,
    remove_vertex,
    try_add_edge,
    try_add_vertex,
    try_make_adjacent,
    try_remove_edge,
    try_remove_face,
    try_remove_vertex,
)
from halfmesh.core.operators.faces import try_add_face, try_add_face_of_vertices
from halfmesh.core.statuses import REASONS
from halfmesh.core.topology import COLUMNS, JOURNAL_SIZE, JOURNALING, NEWS

NAMED = {reason.name: code for code, reason in REASONS.items()}


def points(n):
    return hm.Mesh([], n_vertices=n)


def face(mesh, halfedges):
    return try_add_face(mesh, np.array(halfedges, dtype=np.int32))


def polygon(mesh, *vertices):
    return try_add_face_of_vertices(mesh, np.array(vertices, dtype=np.int32))


def state(mesh):
    """Every column in use, and the counts except the news that Python has read."""
    t = mesh.topology
    columns = [getattr(t, name).tobytes() for name in COLUMNS[:-1]]
    counts = t.__arrays__().counts.copy()
    counts[NEWS] = 0
    return [*columns, counts.tolist()]


def loop(mesh, h):
    found, x = [h], int(hm.next_of(mesh, h))
    while x != h:
        found.append(x)
        x = int(hm.next_of(mesh, x))
    return found


def refused(mesh, name, act):
    before = state(mesh)
    assert act() == -NAMED[name]
    assert state(mesh) == before


def valid(mesh):
    check(mesh.topology)
    return True


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


# -- faces (O4, O5) --------------------------------------------------------------------------------------------------


def test_o4_a_wire_triangle_becomes_a_face_on_either_side():
    mesh = points(3)
    sides = [add_edge(mesh, v, (v + 1) % 3) for v in range(3)]
    assert face(mesh, sides) == 0
    assert valid(mesh)
    assert mesh.topology.face.tolist() == [0, -1] * 3
    assert face(mesh, [h ^ 1 for h in reversed(sides)]) == 1
    assert valid(mesh)
    refused(mesh, "taken_halfedge", lambda: face(mesh, sides))
    assert try_remove_face(mesh, 0) == 0
    assert valid(mesh)
    refused(mesh, "deleted_element", lambda: try_remove_face(mesh, 0))


def test_o4_two_triangles_at_one_vertex_only():
    mesh = points(5)
    assert [polygon(mesh, 0, 1, 2), polygon(mesh, 0, 3, 4)] == [0, 1]
    assert valid(mesh)
    assert [polygon(mesh, 0, 2, 3), polygon(mesh, 0, 4, 1)] == [2, 3]
    assert valid(mesh)
    assert hm.face_of(mesh, hm.halfedge_of_vertex(mesh, 0)) >= 0  # closed now


def test_o4_faces_of_one_and_two_sides():
    mesh = points(2)
    h = add_edge(mesh, 0, 0)
    assert face(mesh, [h]) == 0
    assert valid(mesh)
    assert face(mesh, [h ^ 1]) == 1
    assert valid(mesh)
    a = add_edge(mesh, 1, 1)
    refused(mesh, "repeated_halfedge", lambda: face(mesh, [a, a]))
    mesh = points(2)
    a, b = add_edge(mesh, 0, 1), add_edge(mesh, 1, 0)
    assert face(mesh, [a, b]) == 0
    assert valid(mesh)
    assert face(mesh, [b ^ 1, a ^ 1]) == 1
    assert valid(mesh)


def test_o4_a_face_passes_a_vertex_twice():
    mesh = points(5)
    first = [add_edge(mesh, 0, 1), add_edge(mesh, 1, 2), add_edge(mesh, 2, 0)]
    second = [add_edge(mesh, 0, 3), add_edge(mesh, 3, 4), add_edge(mesh, 4, 0)]
    assert face(mesh, first + second) == 0
    assert valid(mesh)
    assert loop(mesh, first[0]) == first + second
    other = points(5)
    assert polygon(other, 0, 1, 2, 0, 3, 4) == 0
    assert valid(other)


def test_o4_a_face_along_both_sides_of_an_edge():
    mesh = points(3)
    a, b = add_edge(mesh, 0, 1), add_edge(mesh, 1, 2)
    assert face(mesh, [a, b, b ^ 1, a ^ 1]) == 0
    assert valid(mesh)
    assert np.all(hm.halfedge_of_vertex(mesh, np.arange(3)) >= 0)


def test_o5_refusals_of_faces_leave_all_as_it_was():
    mesh = points(8)
    sides = [add_edge(mesh, v, (v + 1) % 4) for v in range(4)]
    refused(mesh, "empty_face", lambda: face(mesh, []))
    refused(mesh, "empty_face", lambda: polygon(mesh))
    refused(mesh, "not_a_chain", lambda: face(mesh, sides[:3]))
    refused(mesh, "missing_element", lambda: face(mesh, [0, 2, 77]))
    refused(mesh, "repeated_halfedge", lambda: face(mesh, sides + sides))
    refused(mesh, "few_vertices", lambda: polygon(mesh, 0, 1))
    refused(mesh, "repeated_vertex", lambda: polygon(mesh, 0, 1, 1))
    refused(mesh, "missing_element", lambda: polygon(mesh, 0, 1, 8))
    assert face(mesh, sides) == 0
    refused(mesh, "taken_halfedge", lambda: polygon(mesh, 7, 6, 0, 1))  # after two edges were made
    assert mesh.n_edges == 4
    assert polygon(mesh, 7, 6, 0, 3) == 1
    assert valid(mesh)


def test_o5_a_late_refusal_takes_new_edges_back():
    mesh = hm.shapes.cube()
    for _ in range(4):
        add_vertex(mesh)
    refused(mesh, "closed_vertex", lambda: polygon(mesh, 8, 9, 10, 11, 0))
    mesh = points(7)
    for v in (1, 3, 5):
        polygon(mesh, 0, v, v + 1)
    # closing the ring with two fans leaves out the third, and is found only when faces are laid
    assert polygon(mesh, 0, 2, 3) == 3
    refused(mesh, "no_gap", lambda: polygon(mesh, 0, 4, 1))
    assert polygon(mesh, 0, 4, 5) == 4
    assert polygon(mesh, 0, 6, 1) == 5
    assert valid(mesh)


def test_o5_within_a_transaction_the_journal_goes_on():
    mesh = points(7)
    for v in (1, 3, 5):
        polygon(mesh, 0, v, v + 1)
    counts = mesh.topology.__arrays__().counts
    counts[JOURNALING] = 1
    polygon(mesh, 0, 2, 3)
    counts = mesh.topology.__arrays__().counts
    kept = int(counts[JOURNAL_SIZE])
    assert kept > 0
    assert counts[JOURNALING] == 1
    refused(mesh, "no_gap", lambda: polygon(mesh, 0, 4, 1))
    counts = mesh.topology.__arrays__().counts
    assert counts[JOURNAL_SIZE] == kept
    assert counts[JOURNALING] == 1
    counts[JOURNALING] = counts[JOURNAL_SIZE] = 0


def fans(n_faces_fan, n_wires):
    """A vertex 0 with triangles that touch there only, and wires; exterior halfedges into 0 and out of it, by fan."""
    mesh = points(1 + 2 * n_faces_fan + n_wires)
    for i in range(n_faces_fan):
        assert polygon(mesh, 0, 1 + 2 * i, 2 + 2 * i) == i
    for i in range(n_wires):
        add_edge(mesh, 0, 1 + 2 * n_faces_fan + i)
    t = mesh.topology
    outs = [h for h in range(len(t.next)) if t.origin[h] == 0 and t.face[h] < 0]
    ends = []
    for h in outs:  # clockwise from the start of the fan to its free end
        x = h ^ 1
        while t.face[x] >= 0:
            x = int(t.next[x]) ^ 1
        ends.append(x)
    return mesh, outs, ends


@pytest.mark.parametrize(("n_fans", "n_wires"), [(2, 0), (3, 0), (2, 1), (0, 3), (1, 2), (4, 0)])
def test_o5_a_face_is_refused_only_where_no_order_of_the_fans_allows_it(n_fans, n_wires):
    """Errata 6, by brute force: the face passes 0 several times and asks that fan j follows fan i."""
    base, outs, ends = fans(n_fans, n_wires)
    n = len(outs)
    pairs = [(i, j) for i in range(n) for j in range(n)]
    for wanted in itertools.chain(itertools.permutations(pairs, 1), itertools.permutations(pairs, 2)):
        if len({i for i, _ in wanted}) < len(wanted) or len({j for _, j in wanted}) < len(wanted):
            continue
        possible = any(
            all(order[(order.index(i) + 1) % n] == j for i, j in wanted) for order in itertools.permutations(range(n))
        )
        mesh, halfedges = base.copy(), []
        for k, (_, j) in enumerate(wanted):  # from the tip of fan j to the tip of the next i by a new edge
            i = wanted[(k + 1) % len(wanted)][0]
            tip, tip_in = int(hm.target_of(mesh, outs[j])), int(hm.origin_of(mesh, ends[i]))
            halfedges += [outs[j], add_edge(mesh, tip, tip_in), ends[i]]
        assert valid(mesh)
        before = state(mesh)
        f = face(mesh, halfedges)
        assert (f >= 0) == possible, wanted
        if possible:
            assert valid(mesh)
            assert loop(mesh, halfedges[0]) == halfedges
        else:
            assert f == -NAMED["no_gap"]
            assert state(mesh) == before


# -- taking away (O6, O7) --------------------------------------------------------------------------------------------


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


# -- robustness (R1 R2 R4 R6 R8 R10): long walks ---------------------------------------------------------------------


def step(rng, run, mesh):
    """One random operation; returns what it gave. `run(kernel)` is the form of the kernel to be called."""
    t = mesh.topology
    nv, nh, nf = len(t.vertex_halfedge), len(t.next), len(t.face_halfedge)
    what = rng.random()
    if what < 0.06:
        return run(try_add_vertex)(mesh)
    if what < 0.36:
        return run(try_add_edge)(mesh, rng.randrange(nv + 1), rng.randrange(nv))
    if what < 0.50 and nh:
        h = rng.randrange(nh)
        out = [x for x in range(nh) if t.origin[x] == t.origin[h ^ 1]] or [0]
        return run(try_make_adjacent)(mesh, h, rng.choice(out))
    if what < 0.66 and nh:  # a chain through the links as they are, or one that has to be made
        h = rng.randrange(nh)
        if t.next[h] >= 0 and rng.random() < 0.5:
            return run(try_add_face)(mesh, np.array(loop(mesh, h), dtype=np.int32))
        chain = [h]
        while len(chain) < 7 and (t.origin[chain[-1] ^ 1] != t.origin[h] or rng.random() < 0.4):
            out = [x for x in range(nh) if t.origin[x] == t.origin[chain[-1] ^ 1] and t.face[x] == -1]
            if not out:
                break
            chain.append(rng.choice(out))
        return run(try_add_face)(mesh, np.array(chain, dtype=np.int64))
    if what < 0.84:
        corners = [rng.randrange(nv) for _ in range(rng.randrange(2, 6))]
        return run(try_add_face_of_vertices)(mesh, np.array(corners, dtype=np.int32))
    if what < 0.90:
        return run(try_remove_face)(mesh, rng.randrange(nf + 1))
    if what < 0.97:
        return run(try_remove_edge)(mesh, rng.randrange(nh // 2 + 1))
    return run(try_remove_vertex)(mesh, rng.randrange(nv))


@pytest.mark.parametrize("seed", range(12))
def test_r_random_walks_stay_valid_and_refusals_change_nothing(seed):
    """R1, R2, R4: on meshes with loops, parallels, wire and vertices in several pieces."""
    rng, mesh, seen = random.Random(seed), points(5), set()
    for _ in range(150):
        before = state(mesh)
        result = step(rng, lambda kernel: kernel, mesh)
        seen.add(min(result, 0))
        if result < 0:
            assert state(mesh) == before
        else:
            assert valid(mesh)
    assert len(seen) > 3


@pytest.mark.parametrize("seed", range(3))
def test_r6_both_gears_build_the_same(seed):
    one, two = points(5), points(5)
    a, b = random.Random(seed), random.Random(seed)
    for _ in range(60):
        compiled = step(a, lambda kernel: kernel, one)
        assert compiled == step(b, lambda kernel: kernel.interpreted, two)
        assert state(one) == state(two)


def test_r8_growth_in_one_kernel_that_adds():
    @hm.kernel
    def grid_of_wire(t, n):
        last = -1
        for _ in range(n):
            v = add_vertex(t)
            if last >= 0:
                add_edge(t, last, v)
            last = v

    mesh = points(0)
    grid_of_wire(mesh, 500)
    assert (mesh.n_vertices, mesh.n_edges) == (500, 499)
    assert valid(mesh)


def test_r10_every_act_has_a_form_that_asks():
    acts = {"add_vertex", "add_edge", "make_adjacent", "remove_face", "remove_edge", "remove_vertex"}
    assert acts | {f"try_{name}" for name in acts} <= set(building.__all__)
    assert all(getattr(building, name).__doc__ for name in building.__all__)
