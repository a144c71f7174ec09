"""Facts about Polylla meshes (G1): reference values, hand-made defects, what is refused, what is carried over."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm
from terminal_edges import certify, polygons_of

SEED_POLYGONS = [[0, 7, 2, 4], [3, 4, 2, 6], [10, 5, 6, 2, 7], [0, 1, 7], [9, 8, 5, 10, 7, 1]]


def run(mesh):
    polygons, report = hm.polylla(mesh, report=True)
    certify(mesh, polygons, report)
    return polygons, report


def cycles(lists):
    """Polygons as sets of cyclic lists, each from its least vertex."""
    rows = [list(map(int, p)) for p in lists]
    return sorted(p[p.index(min(p)) :] + p[: p.index(min(p))] for p in rows)


# ---------------------------------------------------------------------------------------------------- reference values


def test_seed_triangulation_gives_its_five_polygons():
    polygons, report = run(hm.shapes.seed_triangulation())
    assert cycles(polygons_of(polygons)) == cycles(SEED_POLYGONS)
    assert (report.n_frontier_edges, report.n_tips, report.n_repaired, report.n_added) == (15, 0, 0, 0)


def test_seed_polygons_have_the_areas_of_the_reference():
    areas = hm.geometry.face_areas(hm.polylla(hm.shapes.seed_triangulation()))
    assert sorted(areas.round()) == [6357849, 10357682, 11112528, 32703056, 39468886]


@pytest.mark.parametrize("k", [2, 3, 10, 40])
def test_grid_of_k_by_k_points_gives_quads(k):
    polygons, report = run(hm.shapes.grid(k - 1, triangles=True))
    assert report.n_polygons == (k - 1) ** 2
    assert set(polygons.face_degrees()) == {4}
    assert (report.n_frontier_edges, report.n_tips) == (2 * k * (k - 1), 0)
