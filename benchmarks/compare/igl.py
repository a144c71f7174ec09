"""libigl: functions over plain arrays, int64 and float64."""

from __future__ import annotations

from pathlib import Path

import igl
import numpy as np

from benchmarks.compare.peer import Array, Peer, Surface, Way, Ways, counted, summed, triangles


class Igl(Peer):
    name = "libigl"
    module = "igl"

    def builds(self, surface: Surface) -> Ways:
        faces = triangles(surface).astype(np.int64)
        note = "face neighbors and which of their edges"
        return {"triangle_triangle_adjacency": Way(lambda: igl.triangle_triangle_adjacency(faces), note)}

    def readers(self, path: Path) -> Ways:
        return {
            "read_triangle_mesh": Way(
                lambda: igl.read_triangle_mesh(path),
                "arrays only",
                facts=lambda vf: counted(len(vf[0]), len(vf[1])),
                points=lambda vf: vf[0],
            )
        }

    def writers(self, surface: Surface, path: Path) -> Ways:
        faces = triangles(surface).astype(np.int64)
        return {"write_triangle_mesh": Way(lambda: igl.write_triangle_mesh(str(path), surface.points, faces))}

    def rings(self, surface: Surface) -> Ways:
        faces = triangles(surface).astype(np.int64)

        def means() -> Array:
            means = np.empty_like(surface.points)
            for v, ring in enumerate(igl.adjacency_list(faces)):
                means[v] = surface.points[ring].sum(axis=0) / len(ring)
            return means

        return {"Python loop over adjacency_list": Way(means, "makes the lists, nothing is kept", facts=summed)}

    def normals(self, surface: Surface) -> Ways:
        faces = triangles(surface).astype(np.int64)
        return {"per_vertex_normals": Way(lambda: igl.per_vertex_normals(surface.points, faces))}


peer = Igl()
