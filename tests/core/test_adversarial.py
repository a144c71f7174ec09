"""Inputs made to hurt: everything takes time in proportion to the input, whatever its shape (anchors 4.4 H)."""

from __future__ import annotations

import contextlib
import time

import numpy as np
import pytest

import halfmesh as hm

pytestmark = pytest.mark.large

N = 100_000


def fan(n, hub):
    """Triangles around one vertex, which is the first or the last."""
    rim = np.arange(n + 1) + (hub == 0)
    return np.c_[np.full(n, hub), rim[:-1], rim[1:]]


def wheel(n):
    rim = np.arange(n)
    return np.c_[np.full(n, n), rim, (rim + 1) % n]


def bipyramid(n):
    rim = np.arange(n)
    upper = np.c_[np.full(n, n), rim, (rim + 1) % n]
    return np.concatenate([upper, np.c_[np.full(n, n + 1), (rim + 1) % n, rim]])


def book(n):
    return np.c_[np.zeros(n, int), np.ones(n, int), np.arange(2, n + 2)]


def pinwheel(n):
    """Fans of a single triangle each, all at vertex 0."""
    return np.c_[np.zeros(n, int), 2 * np.arange(n) + 1, 2 * np.arange(n) + 2]


def grid(n):
    side = int((n // 2) ** 0.5)
    a = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    return np.concatenate([np.c_[a, a + 1, a + side + 2], np.c_[a, a + side + 2, a + side + 1]])


HELD = {
    "fan around the first": (fan(N, 0), hm.testing.Figures(N + 2, 2 * N + 1, N, 1)),
    "fan around the last": (fan(N, N + 1), hm.testing.Figures(N + 2, 2 * N + 1, N, 1)),
    "wheel": (wheel(N), hm.testing.Figures(N + 1, 2 * N, N, 1)),
    "bipyramid": (bipyramid(N), hm.testing.Figures(N + 2, 3 * N, 2 * N)),
    "pinwheel": (pinwheel(N), hm.testing.Figures(2 * N + 1, 3 * N, N, 1)),
    "polygon of a million sides": (np.arange(10 * N)[None], hm.testing.Figures(10 * N, 10 * N, 1, 1)),
    "pillow of two polygons of a million sides": (
        np.stack([np.arange(10 * N), np.arange(10 * N)[::-1]]),
        hm.testing.Figures(10 * N, 10 * N, 2),
    ),
    "a million components": (
        np.arange(30 * N).reshape(-1, 3),
        hm.testing.Figures(30 * N, 30 * N, 10 * N, 10 * N, n_connected_components=10 * N),
    ),
    "a comb of slits": (
        np.stack([np.arange(1, N + 1), np.zeros(N, int)], axis=1).ravel()[None],
        hm.testing.Figures(N + 1, N, 1),
    ),
}


@pytest.mark.parametrize(("faces", "figures"), HELD.values(), ids=HELD)
def test_adversarial_mesh_is_held_with_its_true_figures(faces, figures):
    """R7, R8: and obeys every law."""
    mesh = hm.Mesh(faces)
    mesh.check()
    figures.assert_of(mesh)
    assert np.array_equal(mesh.face_vertices()[0], faces.ravel())


def strip_turned(n):
    """A long strip, its faces numbered from the far end, every second one turned."""
    a = np.arange(n)[::-1]
    quads = np.c_[2 * a, 2 * a + 2, 2 * a + 3, 2 * a + 1]
    quads[::2] = quads[::2, ::-1]
    return quads


REFUSED = {
    "book": (book(N), "nonmanifold_edge", {"edges": 1, "faces": N}),
    "all faces identical": (np.tile([0, 1, 2], (N, 1)), "nonmanifold_edge", {"edges": 3, "faces": N}),
    "every face twice": (np.repeat(grid(N), 2, axis=0), "nonmanifold_edge", {}),
    "doubled mesh, not closed": (
        np.concatenate([bipyramid(N)] * 2),
        "nonmanifold_edge",
        {"edges": 3 * N, "faces": 4 * N},
    ),
    "turned strip": (strip_turned(N), "inconsistent_orientation", {"edges": N - 1, "reverse": N // 2}),
    "all turned apart": (
        np.repeat(np.arange(3 * N).reshape(-1, 3), 2, axis=0),
        "inconsistent_orientation",
        {"edges": 3 * N, "reverse": N},
    ),
    "cones on one point": (
        np.concatenate(
            [[[0, a, b], [0, b, c], [0, c, a]] for a, b, c in (np.arange(3) + 1 + 3 * i for i in range(20_000))]
        ),
        "nonmanifold_vertex",
        {"vertices": 1, "faces": 60_000},
    ),
    "every vertex repeated": (np.zeros((N, 3), int), "repeated_vertex", {"corners": 3 * N, "faces": N, "vertices": 1}),
    "every index wrong": (np.full((N, 3), -1), "index_out_of_range", {"corners": 3 * N, "faces": N}),
}


@pytest.mark.parametrize(("faces", "reason", "sizes"), REFUSED.values(), ids=REFUSED)
def test_adversarial_faces_are_refused_with_everything_that_is_wrong(faces, reason, sizes):
    """N1-N3, N5: all offending elements, and a message that stays short."""
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(faces)
    assert caught.value.reason == reason
    assert {kind: len(caught.value.elements[kind]) for kind in sizes} == sizes
    assert len(str(caught.value)) < 500


def seconds(faces):
    best = np.inf
    for _ in range(3):
        begun = time.perf_counter()
        with contextlib.suppress(hm.InvalidMeshError):
            hm.Mesh(faces)
        best = min(best, time.perf_counter() - begun)
    return best


SHAPES = {
    "fan, first": lambda n: fan(n, 0),
    "fan, last": lambda n: fan(n, n + 1),
    "bipyramid": bipyramid,
    "pinwheel": pinwheel,
    "book": book,
    "identical": lambda n: np.tile([0, 1, 2], (n, 1)),
    "polygon": lambda n: np.arange(n)[None],
    "comb": lambda n: np.stack([np.arange(1, n + 1), np.zeros(n, int)], axis=1).ravel()[None],
    "turned strip": strip_turned,
    "turned strip and a polygon along it": lambda n: with_polygon(n),
    "components": lambda n: np.arange(3 * n).reshape(-1, 3),
}


def with_polygon(n):
    """The chain of all faces, and one face that touches them all: bad for a union-find without shortened paths."""
    quads = strip_turned(n)
    side = 2 * np.arange(n + 1)
    offsets = np.r_[np.arange(0, 4 * n + 1, 4), 4 * n + n + 1 + 1]
    return np.r_[quads.ravel(), side, 2 * n + 2], offsets


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
def test_time_grows_with_the_input_and_not_with_its_square(shape):
    """Sixteen times the input: a quadratic step would take 256 times as long."""
    small, large = seconds(shape(10_000)), seconds(shape(160_000))
    assert large < 80 * max(small, 0.002)


def test_lopsided_vertices_are_found_from_the_side_of_the_smaller_degree():
    """Q9: the hub of a wheel of a million spokes is one step away from every rim vertex."""
    mesh = hm.Mesh(wheel(10 * N))
    begun = time.perf_counter()
    for u in range(1000):
        assert mesh.find_halfedge(10 * N, u).target.index == u
    assert time.perf_counter() - begun < 1.0
