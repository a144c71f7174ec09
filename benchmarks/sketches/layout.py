"""One record of four ints per halfedge, or four columns? One-ring passes and edge flips over both."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numba
import numpy as np

import halfmesh as hm
from benchmarks.data import load

njit = numba.njit(error_model="numpy", nogil=True)


@njit
def ring_over_columns(prev: Any, origin: Any, vertex_halfedge: Any, points: Any, out: Any) -> None:
    for v in range(len(vertex_halfedge)):
        x = 0.0
        start = vertex_halfedge[v]
        h = start
        while True:
            x += points[origin[h ^ 1], 0]
            h = prev[h] ^ 1
            if h == start:
                break
        out[v] = x


@njit
def ring_over_records(records: Any, vertex_halfedge: Any, points: Any, out: Any) -> None:
    for v in range(len(vertex_halfedge)):
        x = 0.0
        start = vertex_halfedge[v]
        h = start
        while True:
            x += points[records[4 * (h ^ 1) + 2], 0]
            h = records[4 * h + 1] ^ 1
            if h == start:
                break
        out[v] = x


@njit
def flip_columns(next: Any, prev: Any, origin: Any, face: Any) -> None:
    for e in range(0, len(next) // 2, 5):
        a, b = 2 * e, 2 * e + 1
        a1, b1 = next[a], next[b]
        a2, b2 = next[a1], next[b1]
        origin[a], origin[b] = origin[b2], origin[a2]
        f, g = face[a], face[b]
        next[a], next[a2], next[b1] = a2, b1, a
        prev[a2], prev[b1], prev[a] = a, a2, b1
        next[b], next[b2], next[a1] = b2, a1, b
        prev[b2], prev[a1], prev[b] = b, b2, a1
        face[b1], face[a1] = f, g


@njit
def flip_records(r: Any) -> None:
    for e in range(0, len(r) // 8, 5):
        a, b = 8 * e, 8 * e + 4
        a1, b1 = 4 * r[a], 4 * r[b]
        a2, b2 = 4 * r[a1], 4 * r[b1]
        r[a + 2], r[b + 2] = r[b2 + 2], r[a2 + 2]
        f, g = r[a + 3], r[b + 3]
        r[a], r[a2], r[b1] = a2 // 4, b1 // 4, a // 4
        r[a2 + 1], r[b1 + 1], r[a + 1] = a // 4, a2 // 4, b1 // 4
        r[b], r[b2], r[a1] = b2 // 4, a1 // 4, b // 4
        r[b2 + 1], r[a1 + 1], r[b + 1] = b // 4, b2 // 4, a1 // 4
        r[b1 + 3], r[a1 + 3] = f, g


def best(function: Callable[..., Any], make: Callable[[], tuple[Any, ...]], runs: int = 9) -> float:
    function(*make())
    times = []
    for _ in range(runs):
        arguments = make()
        started = time.perf_counter()
        function(*arguments)
        times.append(time.perf_counter() - started)
    return 1e3 * min(times)


def main() -> None:
    for level in (7, 8):
        for order in ("", "-shuffled"):
            faces, points = load(f"sphere-{level}{order}")
            compare(hm.Mesh(faces, points), order)


def compare(mesh: hm.Mesh, order: str) -> None:
    t, out = mesh.topology, np.empty(mesh.n_vertices)
    columns = (t.next, t.prev, t.origin, t.face)
    records = np.stack(columns, axis=1).ravel()
    fixed = (t.vertex_halfedge, mesh.points, out)
    print(f"{mesh.n_faces:,} triangles{order}, milliseconds: columns | records")
    ring = (
        best(ring_over_columns, lambda: (t.prev, t.origin, *fixed)),
        best(ring_over_records, lambda: (records, *fixed)),
    )
    flips = (
        best(flip_columns, lambda: tuple(c.copy() for c in columns)),
        best(flip_records, lambda: (records.copy(),)),
    )
    print(f"  one-ring pass     {ring[0]:8.2f} | {ring[1]:8.2f}")
    print(f"  unchecked flips   {flips[0]:8.2f} | {flips[1]:8.2f}")


if __name__ == "__main__":
    main()
