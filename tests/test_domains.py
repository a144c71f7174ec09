"""Lakes and gears: domains with holes, triangulated."""

from __future__ import annotations

import math

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.shapes._outlines import lake_domain, resampled
from halfmesh.shapes._scattering import DistanceGrid

pytest.importorskip("pythoncdt", reason="pip install halfmesh[delaunay]")

DOMAINS = {
    "lake": lambda: hm.shapes.lake(400, islands=2),
    "lake without islands": lambda: hm.shapes.lake(300, islands=0),
    "gear": lambda: hm.shapes.gear(500, teeth=8, spokes=3),
}


@pytest.mark.parametrize("make", DOMAINS.values(), ids=DOMAINS)
def test_a_domain_is_one_piece_of_good_triangles_the_same_every_time(make):
    mesh = make()
    mesh.check()
    assert mesh.is_triangular
    assert (mesh.n_connected_components, mesh.n_isolated_vertices) == (1, 0)
    assert (hm.geometry.face_vectors(mesh)[:, 2] > 0).all()
    assert np.degrees(hm.geometry.polygon_quality(mesh).min_angle.mean()) > 38
    assert np.array_equal(mesh.points, make().points)


def test_every_hole_is_a_boundary_loop():
    assert [hm.shapes.lake(400, islands=k).n_boundary_loops for k in (0, 3)] == [1, 4]
    assert hm.shapes.gear(500, teeth=6, spokes=4).n_boundary_loops == 6


@pytest.mark.parametrize("make", [hm.shapes.lake, hm.shapes.gear])
def test_there_are_about_as_many_vertices_as_asked_for(make):
    assert 800 < make(1000).n_vertices < 1200


def test_seeds_make_different_lakes():
    assert hm.shapes.lake(200, seed=1).n_vertices != hm.shapes.lake(200, seed=2).n_vertices


@pytest.mark.parametrize("seed", range(8))
def test_islands_touch_neither_the_shore_nor_each_other(seed):
    domain = lake_domain(12, np.random.default_rng(seed))
    curves = [resampled(pieces, 0.02) for pieces in domain.curves]
    for i, a in enumerate(curves):
        for b in curves[:i]:
            assert np.hypot(*(a[:, None] - b).transpose(2, 0, 1)).min() > 0.001


def test_triangles_are_small_at_the_shore_and_large_on_open_water():
    mesh = hm.shapes.lake(800)
    lengths = hm.geometry.edge_lengths(mesh)
    at_shore = (mesh.edge_faces() < 0).any(axis=1)
    assert lengths[~at_shore].max() > 2.5 * lengths[at_shore].mean()


def test_distances_are_positive_inside_and_negative_outside():
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    hole = 0.5 + 0.25 * (square - 0.5)
    grid = DistanceGrid.of([square, hole])
    places = np.array([[0.2, 0.5], [0.5, 0.5], [0.3, 0.3], [0.99, 0.5]])
    expected = [0.175, -0.125, math.hypot(0.075, 0.075), 0.01]
    assert grid.at(places) == pytest.approx(expected, abs=0.01)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: hm.shapes.lake(10), "n must be an integer, at least 100"),
        (lambda: hm.shapes.lake(islands=-1), "islands"),
        (lambda: hm.shapes.gear(teeth=4), "teeth must be an integer, at least 5"),
        (lambda: hm.shapes.gear(spokes=2), "spokes"),
    ],
)
def test_numbers_that_are_too_small_are_refused(call, says):
    with pytest.raises(ValueError, match=says):
        call()
