"""Polylla runs unchanged on meshes that are only read, and gives the same polygons (M4, G1)."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm


def polygons_of(mesh):
    """The polygons as the coordinates of their corners, from the least on."""
    vertices, offsets = mesh.face_vertices()
    cycles = [mesh.points[row].tolist() for row in np.split(vertices, offsets[1:-1])]
    return sorted(row[k:] + row[:k] for row in cycles for k in [row.index(min(row))])


def jittered_grid(n, seed):
    mesh = hm.shapes.grid(n, triangles=True)
    mesh.points[:, :2] += np.random.default_rng(seed).uniform(-0.3, 0.3, (mesh.n_vertices, 2)) / n
    return mesh


@pytest.mark.parametrize("form", [hm.TriangleMesh, hm.CompactMesh])
@pytest.mark.parametrize(
    "mesh",
    [hm.shapes.seed_triangulation(), hm.shapes.grid(5, triangles=True), jittered_grid(12, 1), hm.shapes.icosphere(1)],
    ids=["seed", "grid full of ties", "jittered grid", "closed"],
)
def test_the_polygons_are_the_same(form, mesh):
    polygons, report = hm.polylla(mesh, report=True)
    others, other_report = hm.polylla(form(mesh), report=True)
    others.check()
    assert type(others) is hm.Mesh
    assert polygons_of(others) == polygons_of(polygons)
    for figure in ("n_polygons", "n_frontier_edges", "n_tips", "n_repaired", "n_added"):
        assert getattr(other_report, figure) == getattr(report, figure), figure
