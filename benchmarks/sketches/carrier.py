"""What should `t` be inside a kernel, and what does a readable circulator cost?

The same one-ring pass over the same columns: as arrays passed one by one with a hand-written do-while, as a NamedTuple
of arrays, as a structref; and over the structref with the circulator left to Numba as a generator, and written out.
"""

from __future__ import annotations

import time
import types
from collections.abc import Callable
from typing import Any, NamedTuple

import numba
import numpy as np

import halfmesh as hm
from benchmarks.data import load
from halfmesh import outgoing, target_of, vertex_slots
from halfmesh._jit.circulators import _circulate_halfedges
from halfmesh.core.circulation import ring_start
from halfmesh.core.navigation import ccw_of

njit = numba.njit(error_model="numpy", nogil=True)


class Columns(NamedTuple):
    next: Any
    prev: Any
    origin: Any
    face: Any
    vertex_halfedge: Any
    face_halfedge: Any


@njit
def over_arrays(prev: Any, origin: Any, vertex_halfedge: Any, points: Any, out: Any) -> None:
    for v in range(len(vertex_halfedge)):
        x, n = 0.0, 0
        start = vertex_halfedge[v]
        h = start
        while True:
            x += points[origin[h ^ 1], 0]
            n += 1
            h = prev[h] ^ 1
            if h == start:
                break
        out[v] = x / n


def over_carrier(t: Any, points: Any, out: Any) -> None:
    for v in range(len(t.vertex_halfedge)):
        x, n = 0.0, 0
        start = t.vertex_halfedge[v]
        h = start
        while True:
            x += points[t.origin[h ^ 1], 0]
            n += 1
            h = t.prev[h] ^ 1
            if h == start:
                break
        out[v] = x / n


@hm.kernel
def with_circulator(t: Any, points: Any, out: Any) -> None:
    for v in range(vertex_slots(t)):
        x, n = 0.0, 0
        for h in outgoing(t, v):
            x += points[target_of(t, h), 0]
            n += 1
        out[v] = x / n


def _generator() -> Any:
    scope = {"START": ring_start.compiled, "STEP": ccw_of.compiled, "VALUE": None}
    circulate = njit(types.FunctionType(_circulate_halfedges.__code__, {**globals(), **scope}, "circulate"))

    @njit
    def with_generator(t: Any, points: Any, out: Any) -> None:
        for v in range(len(t.vertex_halfedge)):
            x, n = 0.0, 0
            for h in circulate(t, v):
                x += points[t.origin[h ^ 1], 0]
                n += 1
            out[v] = x / n

    return with_generator


def best(function: Callable[..., Any], *arguments: Any, runs: int = 15) -> float:
    function(*arguments)
    times = []
    for _ in range(runs):
        started = time.perf_counter()
        function(*arguments)
        times.append(time.perf_counter() - started)
    return 1e3 * min(times)


def main() -> None:
    for level in (7, 8):
        for order in ("", "-shuffled"):
            faces, points = load(f"sphere-{level}{order}")
            mesh = hm.Mesh(faces, points)
            t, out = mesh.topology, np.empty(mesh.n_vertices)
            columns = Columns(*(np.ascontiguousarray(getattr(t, name)) for name in Columns._fields))
            proxy, compiled = t.__compiled__(), njit(over_carrier)
            rows = {
                "arrays, do-while": best(over_arrays, t.prev, t.origin, t.vertex_halfedge, mesh.points, out),
                "NamedTuple, do-while": best(compiled, columns, mesh.points, out),
                "structref, do-while": best(compiled, proxy, mesh.points, out),
                "structref, generator": best(_generator(), proxy, mesh.points, out),
                "structref, circulator written out": best(with_circulator, mesh, mesh.points, out),
            }
            print(f"{mesh.n_faces:,} triangles{order}")
            for name, milliseconds in rows.items():
                print(f"  {name:<36}{milliseconds:8.2f} ms")


if __name__ == "__main__":
    main()
