"""One source, every gear: a rule or a loop says the same compiled, interpreted and vectorised (Q2-Q6)."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

import halfmesh as hm
from halfmesh._jit import Circulator, Rule, kernel
from halfmesh.core import circulation, navigation
from reference import Reference

ZOO = hm.testing.zoo()
RULES = {name: rule for name, rule in vars(navigation).items() if isinstance(rule, Rule)}
CIRCULATORS = {name: found for name, found in vars(circulation).items() if isinstance(found, Circulator)}
every_mesh = pytest.mark.parametrize("specimen", ZOO.values(), ids=ZOO)


def letter(rule):
    """The kind of element that a rule or a circulator takes, by the name of its parameter; none for sizes."""
    return [*inspect.signature(rule.__wrapped__).parameters, ""][1]


def indices(mesh, kind):
    n = {"v": mesh.n_vertices, "h": mesh.n_halfedges, "e": mesh.n_edges, "f": mesh.n_faces}[kind]
    return np.arange(n)


def test_every_rule_and_circulator_is_public():
    assert set(RULES) == set(navigation.__all__)
    assert set(CIRCULATORS) == set(circulation.__all__)
    assert set(RULES) | set(CIRCULATORS) <= set(hm.__all__)


def caller(rule):
    """A kernel that asks a rule about all elements: what compiled code gets when it calls the rule."""
    if not letter(rule):

        @kernel
        def ask(t, n, out):
            out[0] = rule(t)
    else:

        @kernel
        def ask(t, n, out):
            for i in range(n):
                out[i] = rule(t, i)

    return ask


@pytest.mark.parametrize("name", RULES)
def test_rule_says_the_same_in_every_gear(name):
    """D9, Q3-Q6: on every mesh of the zoo. A rule that is added to `navigation` is tested without a word here."""
    rule, kind = RULES[name], letter(RULES[name])
    ask = caller(rule)
    for specimen in ZOO.values():
        mesh = specimen.mesh()
        elements = indices(mesh, kind) if kind else np.arange(1)
        compiled, interpreted = (np.full(len(elements), -99) for _ in range(2))
        ask(mesh, len(elements), compiled)
        ask.interpreted(mesh, len(elements), interpreted)
        by_int = [int(rule(mesh, int(i)) if kind else rule(mesh)) for i in elements]
        vectorised = np.asarray(rule(mesh, elements)).astype(int) if kind else np.array(by_int)
        assert compiled.tolist() == interpreted.tolist() == by_int == vectorised.tolist(), specimen.name


WORDS = {
    "next_of": Reference.next,
    "prev_of": Reference.prev,
    "ccw_of": Reference.ccw,
    "cw_of": Reference.cw,
    "target_of": Reference.target,
    "origin_of": lambda twin, h: twin.origin[h],
    "face_of": lambda twin, h: twin.face_of[h],
    "opposite_face_of": lambda twin, h: twin.face_of[h ^ 1],
    "twin_of": lambda twin, h: h + 1 if h % 2 == 0 else h - 1,
    "edge_of": lambda twin, h: h // 2,
    "is_exterior": lambda twin, h: twin.face_of[h] == -1,
    "halfedge_of_edge": lambda twin, e: 2 * e,
    "halfedge_of_vertex": Reference.vertex_halfedge,
    "halfedge_of_face": lambda twin, f: twin.loop[f][0],
    "is_boundary_edge": lambda twin, e: -1 in (twin.face_of[2 * e], twin.face_of[2 * e + 1]),
    "is_isolated": lambda twin, v: not twin.ring[v],
    "is_boundary_vertex": Reference.touches_gap,
    "vertex_slots": lambda twin: twin.n_vertices,
    "halfedge_slots": lambda twin: twin.n_darts,
    "edge_slots": lambda twin: twin.n_darts // 2,
    "face_slots": lambda twin: len(twin.loop),
    "outgoing": lambda twin, v: twin.ring[v],
    "incoming": lambda twin, v: [h ^ 1 for h in twin.ring[v]],
    "neighbors": Reference.neighbors,
    "edges_around": lambda twin, v: [h // 2 for h in twin.ring[v]],
    "faces_around": Reference.faces_around,
    "loop": lambda twin, h: walked(twin, h),
    "face_halfedges": lambda twin, f: twin.loop[f],
    "face_vertices": lambda twin, f: twin.faces[f],
    "face_edges": lambda twin, f: [h // 2 for h in twin.loop[f]],
    "face_neighbors": Reference.face_neighbors,
}


def walked(twin, h):
    path = [h]
    while twin.next(path[-1]) != h:
        path.append(twin.next(path[-1]))
    return path


@pytest.mark.parametrize(("left", "right"), [(0, -1), (-1, 0), (-1, -1), (0, 0)])
def test_an_edge_is_on_the_boundary_whichever_side_is_open(left, right):
    """Also where 2e is the open side, as operators may leave it."""
    mesh = ZOO["triangle"].mesh()
    mesh.topology.__arrays__().face[:2] = left, right
    assert bool(hm.is_boundary_edge(mesh, 0)) == mesh.edges[0].is_boundary == (-1 in (left, right))


def test_the_slow_twin_knows_every_word():
    assert set(WORDS) == set(RULES) | set(CIRCULATORS)


@every_mesh
def test_rules_agree_with_the_slow_twin(specimen):
    """D9, Q3-Q6, Q10."""
    mesh = specimen.mesh()
    twin = Reference(specimen.faces, specimen.figures.n_vertices, specimen.twins, specimen.edges)
    for name, rule in RULES.items():
        arguments = [[int(i)] for i in indices(mesh, letter(rule))] if letter(rule) else [[]]
        assert [rule(mesh, *a) for a in arguments] == [WORDS[name](twin, *a) for a in arguments], name


@every_mesh
def test_circulators_agree_with_the_slow_twin(specimen):
    """Q1, Q2, Q7, Q8: the order is counter-clockwise, and rings end at the gap."""
    mesh = specimen.mesh()
    twin = Reference(specimen.faces, specimen.figures.n_vertices, specimen.twins, specimen.edges)
    for name, circulator in CIRCULATORS.items():
        for i in indices(mesh, letter(circulator)).tolist():
            assert list(circulator(mesh, i)) == WORDS[name](twin, i), name


def collector(circulator):
    """A kernel that writes down what a circulator yields around all elements, -7 after each."""

    @kernel
    def collect(t, n, out):
        k = 0
        for i in range(n):
            for x in circulator(t, i):
                out[k] = x
                k += 1
            out[k] = -7
            k += 1
        return k

    return collect


@pytest.mark.parametrize("name", CIRCULATORS)
def test_circulator_says_the_same_written_out_and_as_a_generator(name):
    """Q2, Q8: the loop written out and compiled, interpreted, and the plain generator."""
    collect = collector(CIRCULATORS[name])
    for specimen in ZOO.values():
        mesh = specimen.mesh()
        elements = indices(mesh, letter(CIRCULATORS[name]))
        room = sum(len(list(CIRCULATORS[name](mesh, int(i)))) + 1 for i in elements)
        compiled, interpreted = (np.full(room, -99) for _ in range(2))
        assert collect(mesh, len(elements), compiled) == collect.interpreted(mesh, len(elements), interpreted) == room
        expected = [x for i in elements for x in [*CIRCULATORS[name](mesh, int(i)), -7]]
        assert compiled.tolist() == interpreted.tolist() == expected, specimen.name
