"""The loops that a user of halfmesh would write for the tasks: in kernels, and in plain Python through handles."""

from __future__ import annotations

from typing import Any

import numba

import halfmesh as hm
from benchmarks.compact import RULES
from benchmarks.compare.peer import counted
from halfmesh import outgoing, target_of


def asking(rule):  # type: ignore[no-untyped-def]
    """A kernel that asks a rule about many elements."""

    @hm.kernel
    def ask(t, elements):  # type: ignore[no-untyped-def]
        total = 0
        for i in range(len(elements)):
            total += rule(t, elements[i])
        return total

    return ask


ASKING = {rule: asking(getattr(hm, rule)) for rule in RULES}


@hm.kernel
def means_by_circulator(t, points, means):  # type: ignore[no-untyped-def]
    for v in range(len(means)):
        x = y = z = 0.0
        n = 0
        for h in outgoing(t, v):
            u = target_of(t, h)
            x += points[u, 0]
            y += points[u, 1]
            z += points[u, 2]
            n += 1
        if n > 0:
            means[v, 0] = x / n
            means[v, 1] = y / n
            means[v, 2] = z / n


@numba.njit(error_model="numpy", nogil=True)
def means_by_hand(vertex_halfedge, prev, origin, points, means):  # type: ignore[no-untyped-def]
    for v in range(len(vertex_halfedge)):
        start = vertex_halfedge[v]
        if start < 0:
            continue
        x = y = z = 0.0
        n = 0
        h = start
        while True:
            u = origin[h ^ 1]
            x += points[u, 0]
            y += points[u, 1]
            z += points[u, 2]
            n += 1
            h = prev[h] ^ 1
            if h == start:
                break
        means[v, 0] = x / n
        means[v, 1] = y / n
        means[v, 2] = z / n


# ---- changing the mesh -----------------------------------------------------------------------------------------------


def done(result: tuple[int, hm.Mesh]) -> dict[str, float]:
    """How many elements were treated, and what is left of the mesh: what all libraries must agree on."""
    n, mesh = result
    return {"operations": n} | counted(mesh.n_vertices, mesh.n_faces)


@hm.kernel
def split_all_collapse_back(t, points):  # type: ignore[no-untyped-def]
    n_before = hm.vertex_slots(t)
    for f in range(hm.face_slots(t)):
        x = y = z = 0.0
        for u in hm.face_vertices(t, f):
            x += points[u, 0]
            y += points[u, 1]
            z += points[u, 2]
        v = hm.split_face(t, f)
        points[v, 0] = x / 3
        points[v, 1] = y / 3
        points[v, 2] = z / 3
    n = 0
    for v in range(n_before, hm.vertex_slots(t)):
        h = hm.halfedge_of_vertex(t, v)
        if hm.collapse_status(t, h) == 0:
            hm.collapse(t, h)
            n += 1
    return n


@hm.kernel
def flip_every_fifth(t):  # type: ignore[no-untyped-def]
    n = 0
    for e in range(0, hm.edge_slots(t), 5):
        if hm.flip_status(t, e) == 0:
            hm.flip(t, e)
            n += 1
    return n


def ask_and_flip(state: Any) -> tuple[int, hm.Mesh]:
    mesh, edges = state
    n = 0
    for e in edges:
        if mesh.can_flip(e):
            mesh.flip(e)
            n += 1
    return n, mesh


def try_to_flip(state: Any) -> tuple[int, hm.Mesh]:
    mesh, edges = state
    n = 0
    for e in edges:
        if mesh.try_flip(e):
            n += 1
    return n, mesh


def split_edges(state: Any) -> tuple[int, hm.Mesh]:
    mesh, edges, points = state
    for e, point in zip(edges, points, strict=True):
        mesh.split_edge_triangular(e, point)
    return len(edges), mesh


def split_faces(state: Any) -> tuple[int, hm.Mesh]:
    mesh, faces, points = state
    for f, point in zip(faces, points, strict=True):
        mesh.split_face(f, point)
    return len(faces), mesh


def ask_and_collapse(state: Any) -> tuple[int, hm.Mesh]:
    mesh, halfedges = state
    n = 0
    for h in halfedges:
        if mesh.can_collapse(h):
            mesh.collapse(h)
            n += 1
    return n, mesh


def try_to_collapse(state: Any) -> tuple[int, hm.Mesh]:
    mesh, halfedges = state
    n = 0
    for h in halfedges:
        if mesh.try_collapse(h) is not None:
            n += 1
    return n, mesh


def ask(mesh: hm.Mesh, v: hm.Vertex) -> None:
    mesh.n_vertices  # noqa: B018
    mesh.n_edges  # noqa: B018
    mesh.n_faces  # noqa: B018
    mesh.has_boundary  # noqa: B018
    mesh.euler_characteristic  # noqa: B018
    v.is_boundary  # noqa: B018
