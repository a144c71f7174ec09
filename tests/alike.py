"""What tests of operators share: meshes alike but for numbering, Euler's figures, refusals that change nothing."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.core.topology import COLUMNS

__all__ = ["alike", "changed", "columns", "figures", "refused", "shape_of", "some", "square"]


def alike(one, other):
    """Whether one mesh is the other with its elements numbered otherwise."""
    return shape_of(one) == shape_of(other)


def shape_of(mesh):
    """What is left of a mesh when the numbers of its elements are forgotten.

    A component is written down from each of its halfedges, numbering what turns up; the least text stands for it.
    """
    t, seen, shapes = mesh.topology, set(), Counter()
    for h in mesh.halfedges.indices.tolist():
        if h not in seen:
            members = reached(t, h)
            seen.update(members)
            shapes[min(text(t, x) for x in members)] += 1
    shapes[()] = mesh.n_isolated_vertices
    return shapes


def reached(t, h):
    """All halfedges that are reached from one, in a fixed order."""
    order, known = [h], {h}
    for x in order:
        for y in (int(t.next[x]), x ^ 1):
            if y not in known:
                known.add(y)
                order.append(y)
    return order


def text(t, h):
    order = reached(t, h)
    number = {x: i for i, x in enumerate(order)}
    vertex, face, rows = {}, {-1: -1}, []
    for x in order:
        v = vertex.setdefault(int(t.origin[x]), len(vertex))
        f = face.setdefault(int(t.face[x]), len(face) - 1)
        rows.append((number[int(t.next[x])], number[x ^ 1], v, f))
    return tuple(rows)


def figures(mesh):
    """What Euler's formula is about: vertices, edges, faces, components, boundary loops."""
    return mesh.n_vertices, mesh.n_edges, mesh.n_faces, mesh.n_connected_components, mesh.n_boundary_loops


def changed(before, mesh):
    """By how much the figures have changed."""
    return tuple(b - a for a, b in zip(before, figures(mesh), strict=True))


def some(collection, n=10):
    """A few elements, spread over all."""
    indices = collection.indices.tolist()
    return indices[:: max(1, len(indices) // n)]


def refused(reason, operator, *elements, **options):
    """Assert that a method of a mesh refuses these for this reason, and changes nothing."""
    mesh = operator.__self__
    before, revision = columns(mesh), mesh.revision
    with pytest.raises(hm.TopologyError) as error:
        operator(*elements, **options)
    assert error.value.reason == reason
    assert mesh.revision == revision
    for name, column in columns(mesh).items():
        assert np.array_equal(column, before[name]), name


def columns(mesh):
    """Copies of all columns in use; of the counts, those of elements."""
    return {name: getattr(mesh.topology, name).copy() for name in COLUMNS[:-1]}


def square():
    """Two triangles."""
    return hm.Mesh([[0, 1, 2], [0, 2, 3]], points=[[0, 0], [1, 0], [1, 1], [0, 1]])
