"""What the tests of building by hand share: acts on bare points, refusals that change nothing, all that is held."""

from __future__ import annotations

import numpy as np

import halfmesh as hm
from halfmesh.core.invariants import check
from halfmesh.core.operators.faces import try_add_face, try_add_face_of_vertices
from halfmesh.core.statuses import REASONS
from halfmesh.core.topology import COLUMNS, NEWS

__all__ = ["NAMED", "face", "loop", "points", "polygon", "refused", "state", "valid"]

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
