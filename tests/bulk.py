"""What tests of adding in bulk share: all that is in a mesh, its face list, refusals that change nothing."""

from __future__ import annotations

import itertools

import pytest

import alike
import halfmesh as hm
from halfmesh.core.topology import NEWS

__all__ = ["columns", "held", "refused", "rows", "state"]


def columns(mesh):
    """All columns in use, as lists: to be compared at once."""
    return {name: column.tolist() for name, column in alike.columns(mesh).items()}


def state(mesh):
    """Every column in use, and the counts except the news that Python has read."""
    counts = mesh.topology.__arrays__().counts.copy()
    counts[NEWS] = 0
    return columns(mesh), counts.tolist()


def rows(mesh):
    indices, offsets = mesh.face_vertices()
    return [indices[a:b].tolist() for a, b in itertools.pairwise(offsets)]


def held(faces, n):
    try:
        return hm.Mesh(faces, n_vertices=n)
    except hm.InvalidMeshError:
        return None


def refused(mesh, faces, reason, error=hm.TopologyError):
    before = state(mesh)
    with pytest.raises(error) as refusal:
        mesh.add_faces(faces)
    if reason is not None:
        assert refusal.value.reason == reason
    assert state(mesh) == before
    return refusal.value
