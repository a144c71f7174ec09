"""Circulators in the loops of users: written out, as generators, and interpreted, they say the same."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm
from halfmesh import (
    edges_around,
    face_edges,
    face_halfedges,
    face_neighbors,
    face_vertices,
    faces_around,
    incoming,
    loop,
    neighbors,
    outgoing,
)
from halfmesh._jit import Circulator, kernel
from halfmesh.core import circulation

ZOO = hm.testing.zoo()
CIRCULATORS = {name: found for name, found in vars(circulation).items() if isinstance(found, Circulator)}


@kernel
def with_break(t, out):
    for v in range(hm.vertex_slots(t)):
        for h in outgoing(t, v):
            if t.face[h] < 0:
                break
            out[v] += h
        else:
            out[v] -= 1000


@kernel
def with_continue(t, out):
    for v in range(hm.vertex_slots(t)):
        for u in neighbors(t, v):
            if u % 2:
                continue
            out[v] += u + 1


@kernel
def nested(t, out):
    for v in range(hm.vertex_slots(t)):
        for h in outgoing(t, v):
            for g in loop(t, h):
                if g == h ^ 1:
                    break
                for f in faces_around(t, t.origin[g]):
                    if f == t.face[g]:
                        continue
                    out[v] += 10 * f + g


@kernel
def by_attribute(t, out):
    for v in range(hm.vertex_slots(t)):
        for e in hm.edges_around(t, v):
            out[v] += hm.is_boundary_edge(t, e) + 2 * hm.halfedge_of_edge(t, e)


@kernel
def two_in_a_row(t, out):
    for v in range(hm.vertex_slots(t)):
        for h in incoming(t, v):
            out[v] += h
        for h in outgoing(t, v):
            out[v] -= 2 * h
        out[v] += h if hm.halfedge_of_vertex(t, v) >= 0 else 0


@kernel
def inside_a_while(t, out):
    for v in range(hm.vertex_slots(t)):
        n = 0
        while n < 3:
            for f in faces_around(t, v):
                n += 1
                if f > 1:
                    break
                for e in face_edges(t, f):
                    out[v] += e
                for u in face_vertices(t, f):
                    out[v] += u
            n += 1


@kernel
def with_an_early_return(t, out):
    for v in range(hm.vertex_slots(t)):
        for h in outgoing(t, v):
            if h == 7:
                return
            out[v] += 1


@kernel
def with_expressions_as_arguments(t, out):
    for f in range(hm.face_slots(t)):
        first = t.face_halfedge[f]
        for h in outgoing(t, hm.target_of(t, hm.next_of(t, first))):
            out[f % len(out)] += h
        for g in face_neighbors(t, max(f - 1, 0)):
            out[f % len(out)] += g
        for g in face_halfedges(t, f):
            out[f % len(out)] += g


@kernel
def with_a_shadowed_name(t, out):
    for v in range(hm.vertex_slots(t)):
        loop = range  # from here on it is no circulator
        for i in loop(1, 3):
            out[v] += i


def _closing_over(circulator, weight):
    @kernel
    def closing(t, out):
        for v in range(hm.vertex_slots(t)):
            for x in circulator(t, v):
                out[v] += weight * x

    return closing


def _helper_in_a_closure():
    @kernel
    def weight(t, h):
        total = 0
        for g in loop(t, h):
            total += g
        return total

    @kernel
    def sums(t, out):
        for v in range(hm.vertex_slots(t)):
            for h in outgoing(t, v):
                out[v] += weight(t, h)

    return sums


USERS = [
    with_break,
    with_continue,
    nested,
    by_attribute,
    two_in_a_row,
    inside_a_while,
    with_an_early_return,
    with_expressions_as_arguments,
    with_a_shadowed_name,
    _closing_over(neighbors, 3),
    _closing_over(edges_around, -1),
    _helper_in_a_closure(),
]


@pytest.mark.parametrize("user", USERS, ids=lambda user: user.__name__)
def test_user_loop_gives_the_same_compiled_and_interpreted(user):
    """Break, continue, else, nesting, attributes, closures, early return: on every mesh of the zoo."""
    for specimen in ZOO.values():
        mesh = specimen.mesh()
        compiled, interpreted = (np.zeros(max(mesh.n_vertices, 1), dtype=np.int64) for _ in range(2))
        user(mesh, compiled)
        user.interpreted(mesh, interpreted)
        assert compiled.tolist() == interpreted.tolist(), specimen.name


def test_user_loops_do_something():
    """The comparison above would pass for loops that never run."""
    mesh = ZOO["mixed degrees"].mesh()
    for user in USERS:
        out = np.zeros(mesh.n_vertices, dtype=np.int64)
        user(mesh, out)
        assert out.any(), user.__name__


@pytest.mark.large
@pytest.mark.parametrize("user", [u for u in USERS if u is not with_a_shadowed_name], ids=lambda user: user.__name__)
def test_every_loop_over_a_circulator_is_written_out(user):
    """No generator is left in the compiled code: that is where its speed comes from."""
    used = {*user.compiled.py_func.__code__.co_names, *user.compiled.py_func.__code__.co_freevars}
    assert not used & {*CIRCULATORS, "circulator"}
    assert any(name.startswith("_loop0") for name in user.compiled.py_func.__code__.co_varnames)


def test_kernel_without_source_text_still_runs():
    """Typed at a prompt: the loops can't be written out, so Numba's generators serve."""
    scope = {"kernel": kernel, "outgoing": outgoing, "faces_around": faces_around, "hm": hm}
    exec(
        "@kernel\n"
        "def typed(t, out):\n"
        "    for v in range(hm.vertex_slots(t)):\n"
        "        for h in outgoing(t, v):\n"
        "            out[v] += h\n"
        "        for f in faces_around(t, v):\n"
        "            out[v] += 100 * f\n",
        scope,
    )
    for name in ("mixed degrees", "isolated vertices", "bow tie", "kite"):
        mesh = ZOO[name].mesh()
        compiled, interpreted = (np.zeros(mesh.n_vertices, dtype=np.int64) for _ in range(2))
        scope["typed"](mesh, compiled)
        scope["typed"].interpreted(mesh, interpreted)
        assert compiled.tolist() == interpreted.tolist(), name


def test_the_step_is_taken_before_the_body_runs():
    """So that a body may relink what it stands on, and both gears agree: here it cuts the ring short."""

    @kernel
    def cutting(t, out):
        k = 0
        for h in outgoing(t, 0):
            t.prev[h] = h ^ 1  # ccw(h) is h from now on
            out[k] = h
            k += 1  # noqa: SIM113 - kernels know no enumerate

    ring = [h.index for h in ZOO["wheel"].mesh().vertices[0].outgoing()]
    for run in (cutting, cutting.interpreted):
        mesh = ZOO["wheel"].mesh()
        out = np.full(len(ring), -1)
        run(mesh, out)
        assert out.tolist() == ring
