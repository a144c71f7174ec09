"""What every representation has to prove that binds the rules anew: the same words, in every gear."""

from __future__ import annotations

import inspect

import numpy as np

from halfmesh._jit import Circulator, Rule, kernel
from halfmesh.core import circulation, navigation

RULES = {name: rule for name, rule in vars(navigation).items() if isinstance(rule, Rule)}
CIRCULATORS = {name: found for name, found in vars(circulation).items() if isinstance(found, Circulator)}
FREE = {"halfedge_of_vertex", "halfedge_of_face", "halfedge_of_edge"}  # which one of several is another choice
GIVES = {
    "twin": "h", "next": "h", "prev": "h", "ccw": "h", "cw": "h", "origin": "v", "target": "v", "face": "f",
    "opposite_face": "f", "edge": "e",
}  # fmt: skip
YIELDS = {
    "outgoing": "h", "incoming": "h", "neighbors": "v", "edges_around": "e", "faces_around": "f", "loop": "h",
    "face_halfedges": "h", "face_vertices": "v", "face_edges": "e", "face_neighbors": "f",
}  # fmt: skip


def taken(function):
    """The kind of element that a rule takes, by the name of its parameter; none for sizes."""
    return [*inspect.signature(function.__wrapped__).parameters, ""][1]


def caller(rule):
    @kernel
    def ask(t, elements, out):
        for i in range(len(elements)):
            out[i] = rule(t, elements[i])

    return ask


def walker(circulator):
    @kernel
    def walk(t, x, out):
        n = 0
        for y in circulator(t, x):
            out[n] = y
            n += 1
        return n

    return walk


CALLERS = {name: caller(rule) for name, rule in RULES.items() if taken(rule)}
WALKERS = {name: walker(circulator) for name, circulator in CIRCULATORS.items()}


def answers(name, other, elements):
    """What a rule says about these elements, which is the same in every gear."""
    ask, rule = CALLERS[name], RULES[name]
    compiled, interpreted = (np.full(len(elements), -99) for _ in range(2))
    ask(other, elements, compiled)
    ask.interpreted(other, elements, interpreted)
    by_int = [int(rule(other, int(i))) for i in elements]
    by_array = np.asarray(rule(other, elements)).astype(int)
    assert compiled.tolist() == interpreted.tolist() == by_int == by_array.tolist(), name
    return compiled


def assert_same_words(mesh, other, maps):
    """Every rule and every circulator says of the other mesh what it says of the first; maps lead to the other."""
    sizes = {"v": mesh.n_vertices, "h": mesh.n_halfedges, "e": mesh.n_edges, "f": mesh.n_faces}
    for kind, n in sizes.items():
        assert sorted(maps[kind]) == list(range(n)), "a map gives every element a number of its own"
    for name in CALLERS:
        kind = taken(RULES[name])
        found = answers(name, other, maps[kind])
        said = np.asarray(RULES[name](mesh, np.arange(sizes[kind]))).astype(int)
        word = name.removesuffix("_of")
        if name in FREE:
            assert_free_choice(name, mesh, other, maps, found, said)
        elif word in GIVES:
            assert found.tolist() == np.where(said < 0, said, np.append(maps[GIVES[word]], -1)[said]).tolist(), name
        else:
            assert found.tolist() == said.tolist(), name
    for name in CIRCULATORS:
        assert_same_walks(name, mesh, other, maps, sizes)


def assert_free_choice(name, mesh, other, maps, found, said):
    """The halfedge of something belongs to it, and is exterior where the mesh's own is."""
    back = {
        "halfedge_of_vertex": navigation.origin_of, "halfedge_of_face": navigation.face_of,
        "halfedge_of_edge": navigation.edge_of,
    }[name]  # fmt: skip
    own = maps[taken(RULES[name])]
    assert (found < 0).tolist() == (said < 0).tolist(), name
    for x, h, g in zip(own, found, said, strict=True):
        if h >= 0:
            assert back(other, int(h)) == x, name
            if name == "halfedge_of_vertex":
                assert navigation.is_exterior(other, int(h)) == navigation.is_exterior(mesh, int(g)), name


def assert_same_walks(name, mesh, other, maps, sizes):
    """The same elements in the same cyclic order; a ring starts after the exterior halfedge where there is one."""
    walk, kind = WALKERS[name], taken(CIRCULATORS[name])
    out, again = np.zeros(max(sizes["h"], 1), np.int64), np.zeros(max(sizes["h"], 1), np.int64)
    for x in range(sizes[kind]):
        n = walk(mesh, x, out)
        expected = maps[YIELDS[name]][out[:n]].tolist()
        n = walk(other, int(maps[kind][x]), out)
        walk.interpreted(other, int(maps[kind][x]), again)
        found = out[:n].tolist()
        assert found == again[:n].tolist() == list(CIRCULATORS[name](other, int(maps[kind][x]))), name
        assert turned(found) == turned(expected), f"{name} of {x}: {found}, expected {expected}"


def turned(cycle):
    """The cycle from where it reads least."""
    return min((cycle[i:] + cycle[:i] for i in range(len(cycle))), default=[])
