"""Meshes whose operators are built-in functions from the first call on, and such that have none."""

from __future__ import annotations

import functools
import types

import numpy as np

import halfmesh as hm
from alike import columns
from halfmesh import _jit
from halfmesh.mesh import desk

__all__ = ["NATIVE", "decorate", "frozen", "nimble", "outcome", "plain", "same"]

NATIVE = sorted(name for name in dir(hm.Mesh) if hasattr(getattr(hm.Mesh, name), "native"))


@functools.cache
def _compiled():
    """Every operation that a native stands for, called once."""
    mesh = hm.shapes.icosphere(1)
    with _jit.compiling_always():
        mesh.can_flip(0), mesh.can_collapse(0), mesh.flip(0), mesh.split_face(0), mesh.split_edge(0)
        mesh.split_edge_triangular(40), mesh.add_vertex(), mesh.add_vertex(), mesh.add_vertex()
        mesh.add_face([mesh.n_vertices - 3, mesh.n_vertices - 2, mesh.n_vertices - 1])
        mesh.try_collapse(next(h for h in mesh.halfedges if mesh.can_collapse(h)))


def nimble(mesh):
    """The mesh, with all its natives in place and its desk open."""
    _compiled()
    mesh.topology.__compiled__()
    for name in NATIVE:
        desk.offer(mesh, getattr(hm.Mesh, name))
    assert all(isinstance(vars(mesh)[name], types.BuiltinFunctionType) for name in NATIVE)
    return mesh


class _Plain(hm.Mesh):
    """A subclass that has its own operators gets no natives for them."""


def _own(method):
    return lambda self, *args, **more: method(self, *args, **more)


for _name in NATIVE:
    setattr(_Plain, _name, _own(getattr(hm.Mesh, _name)))


def plain(mesh):
    """A copy that has none."""
    made = mesh.copy()
    made.__class__ = _Plain
    return made


def outcome(act):
    """What came out: a handle by kind and index, an error by type and text."""
    try:
        found = act()
    except Exception as error:
        return type(error), str(error).replace("_Plain", "Mesh")
    return (type(found), found.index) if isinstance(found, hm.Vertex | hm.Face) else found


def frozen(mesh):
    return {name: column.tobytes() for name, column in columns(mesh).items()}


def same(one, other):
    assert frozen(one) == frozen(other)
    for name in ("vertex_data", "halfedge_data", "edge_data", "face_data"):
        mine, theirs = getattr(one, name), getattr(other, name)
        assert list(mine) == list(theirs)
        for key in mine:
            assert np.allclose(mine[key], theirs[key], rtol=1e-14, atol=0, equal_nan=True)
    assert one.has_points == other.has_points


def decorate(mesh):
    mesh.vertex_data["x"] = np.arange(float(mesh.n_vertices))
    mesh.vertex_data["label"] = np.arange(mesh.n_vertices)
    mesh.halfedge_data["uv"] = np.arange(2.0 * mesh.n_halfedges).reshape(-1, 2)
    mesh.face_data["id"] = np.arange(mesh.n_faces)
