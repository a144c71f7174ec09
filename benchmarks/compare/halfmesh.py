"""halfmesh itself, asked like everyone else; and its loops beside loops written by hand over the raw columns."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numba
import numpy as np

import halfmesh as hm
from benchmarks.compare.peer import Array, Peer, Surface, Way, Ways, counted, summed
from halfmesh import outgoing, target_of

COLUMNS = ("next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge")


class HalfMesh(Peer):
    name = "halfmesh"
    module = "halfmesh"

    def builds(self, surface: Surface) -> Ways:
        def build() -> hm.Mesh:
            return hm.Mesh(surface.faces, surface.points)

        return {"Mesh": Way(build, "half-edge mesh, full columns", facts=lambda mesh: {"edges": mesh.n_edges})}

    def column_bytes(self, mesh: hm.Mesh) -> int:
        return sum(getattr(mesh.topology, column).nbytes for column in COLUMNS)

    def readers(self, path: Path) -> Ways:
        def arrays(read: Any) -> dict[str, float]:
            faces, points = read
            return counted(len(points), len(faces[1]) - 1 if isinstance(faces, tuple) else len(faces))

        return {
            "io.read": Way(lambda: hm.io.read(path), "arrays only", facts=arrays, points=lambda read: read[1]),
            "load": Way(
                lambda: hm.load(path),
                "builds connectivity",
                facts=lambda mesh: counted(mesh.n_vertices, mesh.n_faces),
                points=lambda mesh: mesh.points,
            ),
        }

    def writers(self, surface: Surface, path: Path) -> Ways:
        mesh = hm.Mesh(surface.faces, surface.points)
        return {"save": Way(lambda: hm.save(mesh, path))}

    def rings(self, surface: Surface) -> Ways:
        mesh = hm.Mesh(surface.faces, surface.points)
        t, points = mesh.topology, surface.points
        columns = t.vertex_halfedge, t.prev, t.origin
        copies = tuple(np.ascontiguousarray(column) for column in columns)

        def kernel() -> Array:
            means = np.empty_like(points)
            means_by_circulator(mesh, points, means)
            return means

        def by_hand(columns: Any) -> Array:
            means = np.empty_like(points)
            means_by_hand(*columns, points, means)  # type: ignore[call-arg]
            return means

        return {
            "hm.kernel with the circulator": Way(kernel, facts=summed),
            "numba do-while by hand, its columns": Way(lambda: by_hand(columns), facts=summed),
            "numba do-while by hand, contiguous copies": Way(lambda: by_hand(copies), facts=summed),
        }

    def steps(self, surface: Surface, n: int) -> Ways:
        mesh = hm.Mesh(surface.faces, surface.points)
        start = mesh.halfedges[0]

        def next_() -> None:
            h = start
            for _ in range(n):
                h = h.next

        def twin() -> None:
            h = start
            for _ in range(n):
                h = h.twin

        def ccw() -> None:
            h = start
            for _ in range(n):
                h = h.ccw

        def face() -> None:
            h = start
            for _ in range(n):
                h.face  # noqa: B018

        def target() -> None:
            h = start
            for _ in range(n):
                h.target  # noqa: B018

        def walk() -> None:
            h = start
            for _ in range(n // 5):
                h = h.next
                h.face  # noqa: B018
                h.target  # noqa: B018
                h = h.twin
                h = h.ccw

        return {"next": Way(next_), "twin": Way(twin), "ccw": Way(ccw), "face": Way(face), "target": Way(target),
                "walk": Way(walk)}  # fmt: skip

    def normals(self, surface: Surface) -> Ways:
        mesh = hm.Mesh(surface.faces, surface.points)
        return {
            "vertex_normals, by area": Way(lambda: hm.geometry.vertex_normals(mesh, weights="area"), "area weighted"),
            "vertex_normals": Way(lambda: hm.geometry.vertex_normals(mesh), "angle weighted"),
        }


@hm.kernel
def means_by_circulator(t, points, means):  # type: ignore[no-untyped-def]
    for v in range(len(means)):
        x = y = z = 0.0
        n = 0
        for h in outgoing(t, v):
            u = target_of(t, h)
            x += points[u, 0]
            y += points[u, 1]
            z += points[u, 2]
            n += 1
        if n > 0:
            means[v, 0] = x / n
            means[v, 1] = y / n
            means[v, 2] = z / n


@numba.njit(error_model="numpy", nogil=True)
def means_by_hand(vertex_halfedge, prev, origin, points, means):  # type: ignore[no-untyped-def]
    for v in range(len(vertex_halfedge)):
        start = vertex_halfedge[v]
        if start < 0:
            continue
        x = y = z = 0.0
        n = 0
        h = start
        while True:
            u = origin[h ^ 1]
            x += points[u, 0]
            y += points[u, 1]
            z += points[u, 2]
            n += 1
            h = prev[h] ^ 1
            if h == start:
                break
        means[v, 0] = x / n
        means[v, 1] = y / n
        means[v, 2] = z / n


peer = HalfMesh()
