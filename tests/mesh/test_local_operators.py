"""Local operators through the mesh: Euler's numbers, inverses, random walks."""

from __future__ import annotations

import itertools
import random

import numpy as np
import pytest

import halfmesh as hm
from alike import columns, figures
from halfmesh.testing import assert_valid, zoo

ZOO = zoo()


def faces_of(mesh):
    """The living faces as a set of vertex cycles, each from where it reads lowest."""
    indices, offsets = mesh.face_vertices()
    rows = [indices[a:b].tolist() for a, b in itertools.pairwise(offsets) if a < b]
    return sorted(min(row[k:] + row[:k] for k in range(len(row))) for row in rows)


def change(before, after):
    return tuple(b - a for a, b in zip(before, after, strict=True))


# ------------------------------------------------------------------------------------------------ Euler's numbers, laws


@pytest.mark.parametrize("name", ZOO)
def test_every_edge_of_the_zoo_can_be_split_and_collapsed_back(name):
    mesh = ZOO[name].mesh()
    old, faces, is_simple = figures(mesh), faces_of(mesh), simple(mesh)
    for e in mesh.edges.indices.tolist():
        v = mesh.split_edge(e)
        assert_valid(mesh)
        assert change(old, figures(mesh)) == (1, 1, 0, 0, 0)
        back = next(h for h in v.outgoing() if h.edge.index == e)  # to where the edge came from
        if mesh.can_collapse(back.twin.next):
            mesh.collapse(back.twin.next)
            assert_valid(mesh)
            assert (figures(mesh), faces_of(mesh)) == (old, faces)
        else:
            assert not is_simple  # putting a vertex into a loop or a parallel edge undoes that: no way back
            return


def simple(mesh):
    """Whether no edge is a loop or parallel, and no face passes a vertex twice: where a split can be undone."""
    indices, offsets = mesh.face_vertices()
    rows = [indices[a:b].tolist() for a, b in itertools.pairwise(offsets)]
    ends = [tuple(sorted(pair)) for pair in mesh.edge_vertices()[mesh.edges.indices].tolist()]
    return len(set(ends)) == len(ends) and all(len(set(row)) == len(row) for row in rows)


@pytest.mark.parametrize("name", ZOO)
def test_every_face_of_the_zoo_can_be_split_at_a_point_and_joined_again(name):
    mesh = ZOO[name].mesh()
    for f in mesh.faces.indices.tolist():
        old, faces, degree = figures(mesh), faces_of(mesh), mesh.faces[f].degree
        v = mesh.split_face(f)
        assert_valid(mesh)
        assert change(old, figures(mesh)) == (1, degree, degree - 1, 0, 0)
        while v.degree > 1:  # the spokes go one by one; the last is a slit, which a collapse takes away
            h = next(h for h in v.outgoing() if mesh.can_join_faces(h))
            mesh.join_faces(h)
        mesh.collapse(v.halfedge)
        assert_valid(mesh)
        assert (figures(mesh), faces_of(mesh)) == (old, faces)


@pytest.mark.parametrize("name", ZOO)
def test_every_diagonal_of_the_zoo_can_be_put_in_and_taken_out(name):
    mesh = ZOO[name].mesh()
    for f in mesh.faces.indices.tolist()[:20]:
        corners = list(mesh.faces[f].halfedges())
        for a, b in zip(corners, corners[2:], strict=False):
            if mesh.can_connect(a, b):
                old, faces = figures(mesh), faces_of(mesh)
                h = mesh.connect(a, b)
                assert_valid(mesh)
                assert change(old, figures(mesh)) == (0, 1, 1, 0, 0)
                assert (h.origin, h.target) == (a.origin, b.origin)
                mesh.join_faces(h.twin)
                assert_valid(mesh)
                assert (figures(mesh), faces_of(mesh)) == (old, faces)


@pytest.mark.parametrize("name", ZOO)
def test_two_flips_turn_an_edge_of_triangles_round(name):
    mesh = ZOO[name].mesh()
    for e in mesh.edges.indices.tolist():
        if all(f is not None and f.degree == 3 for f in mesh.edges[e].faces) and mesh.can_flip(e):
            old, faces = figures(mesh), faces_of(mesh)
            a, b = mesh.edges[e].vertices
            mesh.flip(e)
            assert_valid(mesh)
            assert figures(mesh) == old
            mesh.flip(e, allow_parallel=True)
            assert mesh.edges[e].vertices == (b, a)
            assert faces_of(mesh) == faces


@pytest.mark.parametrize("name", ZOO)
def test_every_legal_collapse_of_the_zoo_keeps_the_surface(name):
    for h in ZOO[name].mesh().halfedges.indices.tolist():
        mesh = ZOO[name].mesh()
        if not mesh.can_collapse(h):
            continue
        old, genus = figures(mesh), mesh.genus
        triangles = sum(side.face is not None and side.face.degree == 3 and side.twin not in (side.next, side.prev)
                        for side in (mesh.halfedges[h], mesh.halfedges[h].twin))  # fmt: skip
        was_wire = mesh.halfedges[h].origin.degree == mesh.halfedges[h].target.degree == 1
        target = mesh.halfedges[h].target
        assert mesh.collapse(h) == target
        assert_valid(mesh)
        assert change(old, figures(mesh)) == (-1, -1 - triangles, -triangles, 0, -1 if was_wire else 0)
        assert mesh.genus == genus


# ------------------------------------------------------------------------------------------------------- random walks


OPERATORS = ["flip", "split_edge", "split_face", "connect", "join_faces", "join_faces", "collapse", "collapse"]


def step(mesh, rng):
    """One operator at random, legal or not."""
    operator, h = rng.choice(OPERATORS), mesh.halfedges[rng.choice(mesh.halfedges.indices.tolist())]
    loose = rng.random() < 0.3
    if operator == "flip":
        mesh.flip(h.edge, allow_parallel=loose)
    elif operator == "split_edge":
        mesh.split_edge(h, at=rng.random())
    elif operator == "split_face" and mesh.n_faces:
        mesh.split_face(rng.choice(mesh.faces.indices.tolist()))
    elif operator == "connect":
        loop = [h]
        while loop[-1].next != h:
            loop.append(loop[-1].next)
        mesh.connect(h, rng.choice(loop), allow_parallel=loose)
    elif operator == "join_faces":
        mesh.join_faces(h)
    elif operator == "collapse":
        mesh.collapse(h, at=rng.choice([0.0, 0.5, 1.0]))


def walk(mesh, rng, steps):
    for _ in range(steps):
        if not mesh.n_edges:
            return
        before, revision, euler = columns(mesh), mesh.revision, mesh.euler_characteristic
        points = mesh.points.copy()
        try:
            step(mesh, rng)
        except hm.TopologyError:
            for name, column in columns(mesh).items():
                assert np.array_equal(column, before[name]), name
            assert (mesh.revision, mesh.points.tolist()) == (revision, points.tolist())
        assert_valid(mesh)
        assert mesh.euler_characteristic == euler


@pytest.mark.parametrize("name", ZOO)
def test_random_walk_keeps_all_laws_and_refusals_change_nothing(name):
    mesh = ZOO[name].mesh()
    mesh.halfedge_data.add("uv", float, (2,))
    walk(mesh, random.Random(name), 60)


@pytest.mark.fuzz
@pytest.mark.parametrize("seed", range(200))
def test_long_random_walk(seed):
    for name, specimen in ZOO.items():
        walk(specimen.mesh(), random.Random(f"{seed} {name}"), 100)
