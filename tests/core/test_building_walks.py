"""Building by hand: long random walks, in both gears and in kernels (R1 R2 R4 R6 R8 R10)."""

from __future__ import annotations

import random

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.core.operators import building
from halfmesh.core.operators.building import (
    add_edge,
    add_vertex,
    try_add_edge,
    try_add_vertex,
    try_make_adjacent,
    try_remove_edge,
    try_remove_face,
    try_remove_vertex,
)
from halfmesh.core.operators.faces import try_add_face, try_add_face_of_vertices
from handmade import loop, points, state, valid


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
