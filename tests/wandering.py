"""What the tests of transactions share: everything that a mesh holds, as bytes; random changes; rollbacks."""

from __future__ import annotations

import contextlib

import numpy as np
import pytest

import halfmesh as hm

COLUMNS = ("next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge")
TABLES = ("vertex_data", "halfedge_data", "edge_data", "face_data")
REFUSALS = (hm.TopologyError, hm.ElementError, hm.StaleElementError, hm.InvalidMeshError)


class RefusedError(Exception):
    """What a block that is rolled back ends with."""


def fail(mesh, change, **options):
    """Change the mesh in a transaction that is rolled back."""

    def block():
        with mesh.transaction(**options):
            change(mesh)
            raise RefusedError

    with pytest.raises(RefusedError):
        block()


def everything(mesh):
    """All that is to be as it was; looked at from outside of a transaction, or it would be handed out."""
    t = mesh.topology
    held = {name: getattr(t, name).tobytes() for name in COLUMNS}
    held["counts"] = (t.__arrays__().counts[:7].tolist(), t.__arrays__().counts[8:].tolist())
    for kind in TABLES:
        table = getattr(mesh, kind)
        held[kind] = [(n, table.peek(n).tobytes(), table.peek(n).dtype, table.peek(n).shape) for n in table]
        held[kind + " policies"] = table.policies
    held["rest"] = (mesh.has_points, repr(mesh._meta))
    return held


def furnish(mesh, seed=0):
    """Attributes of all kinds and several forms, with values that nobody would get by accident."""
    rng = np.random.default_rng(seed)
    for kind in TABLES:
        table = getattr(mesh, kind)
        x = table.add("x", float, default=7.5)
        x[:] = rng.normal(size=x.shape)
        label = table.add("label", np.int16, (2,), default=-3)
        label[:] = rng.integers(0, 99, label.shape)
        table.add("total", float, policy="sum")[:] = 1.0
    mesh.vertex_data.add("name", "U3", default="new")[:] = "old"
    mesh.meta = {"groups": ["a", "b"]}
    return mesh


def wander(mesh, rng, n, *, also=()):
    """Random changes by `n` operators, those that are refused included."""
    for _ in range(n):
        with contextlib.suppress(*REFUSALS):
            rng.choice([*_OPERATORS, *also])(mesh, rng)


def _vertex(mesh, rng):
    return rng.randrange(len(mesh.topology.vertex_halfedge) + 1)


def _halfedge(mesh, rng):
    return rng.randrange(len(mesh.topology.next) + 1)


def _face(mesh, rng):
    return rng.randrange(len(mesh.topology.face_halfedge) + 1)


def _move(mesh, rng):
    mesh.vertices[_vertex(mesh, rng)].point = [rng.random(), 0.0, 1.0]


def _in_a_row(mesh, rng):
    h = mesh.halfedges[_halfedge(mesh, rng)]
    return h, rng.choice([h.next, h.next.next])


def _around(mesh, rng):
    h = mesh.halfedges[_halfedge(mesh, rng)]
    return h, rng.choice([h.ccw, h.ccw.ccw])


_OPERATORS = (
    lambda mesh, rng: mesh.flip(_halfedge(mesh, rng) // 2),
    lambda mesh, rng: mesh.split_edge(_halfedge(mesh, rng) // 2, at=rng.random()),
    lambda mesh, rng: mesh.split_edge(_halfedge(mesh, rng) // 2, [rng.random(), 2.0]),
    lambda mesh, rng: mesh.split_face(_face(mesh, rng)),
    lambda mesh, rng: mesh.join_faces(_halfedge(mesh, rng) // 2),
    lambda mesh, rng: mesh.collapse(_halfedge(mesh, rng), at=rng.random()),
    lambda mesh, rng: mesh.collapse(_halfedge(mesh, rng), [0.0, rng.random()]),
    lambda mesh, rng: mesh.add_vertex([rng.random(), 0.0]),
    lambda mesh, rng: mesh.add_edge(_vertex(mesh, rng), _vertex(mesh, rng)),
    lambda mesh, rng: mesh.add_face([_vertex(mesh, rng) for _ in range(3)]),
    lambda mesh, rng: mesh.remove_face(_face(mesh, rng)),
    lambda mesh, rng: mesh.remove_edge(_halfedge(mesh, rng) // 2),
    lambda mesh, rng: mesh.remove_vertex(_vertex(mesh, rng)),
    lambda mesh, rng: mesh.dissolve_edge(_halfedge(mesh, rng) // 2),
    lambda mesh, rng: mesh.dissolve_vertex(_vertex(mesh, rng)),
    lambda mesh, rng: mesh.make_hole(_face(mesh, rng)),
    lambda mesh, rng: mesh.fill_hole(_halfedge(mesh, rng)),
    lambda mesh, rng: mesh.open_edge(_halfedge(mesh, rng) // 2),
    lambda mesh, rng: mesh.zip_hole(_halfedge(mesh, rng)),
    lambda mesh, rng: mesh.join_vertices(_halfedge(mesh, rng)),
    lambda mesh, rng: mesh.add_vertex_and_face_to_boundary(*_in_a_row(mesh, rng)),
    lambda mesh, rng: mesh.split_vertex(*_around(mesh, rng), [rng.random(), 3.0]),
    lambda mesh, rng: mesh.unweld(*_around(mesh, rng)),
    lambda mesh, rng: mesh.cut(_in_a_row(mesh, rng)),
    lambda mesh, rng: mesh.stitch(*_in_a_row(mesh, rng)),
    lambda mesh, rng: mesh.connect(*_in_a_row(mesh, rng)),
    lambda mesh, rng: mesh.reverse_component(_vertex(mesh, rng)),
    lambda mesh, rng: mesh.reverse(),
    lambda mesh, rng: mesh.remove_component(_vertex(mesh, rng)),
    lambda mesh, rng: mesh.append(furnish(hm.Mesh([[0, 1, 2, 3]], edges=[[3, 4]]), rng.randrange(9))),
    lambda mesh, rng: mesh.add_vertices([[rng.random(), 1.0], [2.0, 3.0]]),
    lambda mesh, rng: mesh.add_faces([[_vertex(mesh, rng) for _ in range(3)] for _ in range(rng.randrange(1, 3))]),
    _move,
)


def _write_points(mesh, rng):
    mesh.points[:] += rng.random()


def _replace(mesh, rng):
    mesh.edge_data["x"] = np.arange(len(mesh.edge_data["x"]))


def _create(mesh, rng):
    with contextlib.suppress(KeyError):
        mesh.face_data.add(f"new {rng.randrange(3)}", np.uint8)


def _drop(mesh, rng):
    with contextlib.suppress(KeyError):
        del mesh.halfedge_data["label"]


def _set_policy(mesh, rng):
    mesh.vertex_data.set_policy("x", rng.choice(["max", "first"]))


ATTRIBUTES = (_write_points, _replace, _create, _drop, _set_policy)
COMPACTION = (lambda mesh, rng: mesh.compact(),)


@hm.kernel
def churn(t, stride):
    """Split all faces, then flip and collapse here and there."""
    for f in range(hm.face_slots(t)):
        if hm.halfedge_of_face(t, f) >= 0:
            hm.split_face(t, f)
    for e in range(0, hm.edge_slots(t), stride):
        if hm.next_of(t, 2 * e) >= 0 and hm.flip_status(t, e) == 0:
            hm.flip(t, e)
    for v in range(0, hm.vertex_slots(t), stride):
        h = hm.halfedge_of_vertex(t, v)
        if h >= 0 and hm.collapse_status(t, h) == 0:
            hm.collapse(t, h)
