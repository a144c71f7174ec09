"""Whether a compact mesh is the mesh that it was made from: every rule on every element, through the maps."""

from __future__ import annotations

import numpy as np

from halfmesh.compact.encoding import compacted, maps_of
from halfmesh.core import navigation
from halfmesh.core.topology import DELETED

FROM_TO = {
    "twin_of": "hh", "next_of": "hh", "prev_of": "hh", "ccw_of": "hh", "cw_of": "hh", "edge_of": "he",
    "origin_of": "hv", "target_of": "hv", "face_of": "hf", "opposite_face_of": "hf",
}  # fmt: skip
QUESTIONS = {"is_exterior": "h", "is_boundary_edge": "e", "is_isolated": "v", "is_boundary_vertex": "v"}
REPRESENTATIVES = {"halfedge_of_vertex": "origin_of", "halfedge_of_face": "face_of", "halfedge_of_edge": "edge_of"}
SLOTS = {"v": "vertex_slots", "h": "halfedge_slots", "e": "edge_slots", "f": "face_slots"}


def encoded(t):
    """Its compact form, after it was compared with the mesh in all that can be asked."""
    made = compacted(t)
    assert_alike(t, made)
    return made.topology


def assert_alike(t, made):
    compact, found = made.topology, maps_of(t, made)
    maps = {"v": found.vertices, "h": found.halfedges, "e": found.edges, "f": found.faces}
    alive = {
        "v": np.flatnonzero(t.vertex_halfedge != DELETED), "h": np.flatnonzero(t.next != DELETED),
        "e": np.flatnonzero(t.next[::2] != DELETED), "f": np.flatnonzero(t.face_halfedge != DELETED),
    }  # fmt: skip
    for kind, old in alive.items():
        assert np.array_equal(np.sort(maps[kind][old]), np.arange(len(old))), f"not one to one: {kind}"
        assert (np.delete(maps[kind], old) == -1).all()
        assert getattr(navigation, SLOTS[kind])(compact) == len(old)
    for name, (kind, to) in FROM_TO.items():
        wanted = asked(name, t, alive[kind])
        wanted = np.append(maps[to], -1)[wanted]  # -1 stays what it is
        assert np.array_equal(asked(name, compact, maps[kind][alive[kind]]), wanted), name
    for name, kind in QUESTIONS.items():
        assert np.array_equal(asked(name, compact, maps[kind][alive[kind]]), asked(name, t, alive[kind])), name
    for name, back in REPRESENTATIVES.items():
        x = np.arange(len(alive[name[len("halfedge_of_")]]))
        h = asked(name, compact, x)
        x, h = x[h >= 0], h[h >= 0]
        assert np.array_equal(asked(back, compact, h), x), name
    v = np.arange(len(alive["v"]))
    h = asked("halfedge_of_vertex", compact, v)
    assert np.array_equal(h < 0, asked("is_isolated", compact, v))
    assert np.array_equal(asked("is_exterior", compact, h[h >= 0]), asked("is_boundary_vertex", compact, v[h >= 0]))
    assert np.array_equal(maps["v"][made.vertices], v)


def asked(name, t, x):
    answer = getattr(navigation, name)(t, x)
    return np.broadcast_to(answer, x.shape)
