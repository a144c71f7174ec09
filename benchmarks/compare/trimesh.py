"""trimesh."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh

from benchmarks.compare.peer import Array, Peer, Surface, Way, Ways, counted, summed, triangles


class Trimesh(Peer):
    name = "trimesh"
    module = "trimesh"

    def builds(self, surface: Surface) -> Ways:
        faces = triangles(surface).astype(np.int64)

        def build() -> Array:
            adjacency: Array = trimesh.Trimesh(surface.points, faces, process=False).face_adjacency
            return adjacency

        return {"face_adjacency": Way(build, "pairs of faces only")}

    def readers(self, path: Path) -> Ways:
        return {
            "load_mesh": Way(
                lambda: trimesh.load_mesh(str(path), process=False),
                "arrays only",
                facts=lambda mesh: counted(len(mesh.vertices), len(mesh.faces)),
                points=lambda mesh: mesh.vertices,
            )
        }

    def writers(self, surface: Surface, path: Path) -> Ways:
        mesh = trimesh.Trimesh(surface.points, triangles(surface), process=False)
        return {"export": Way(lambda: mesh.export(str(path)))}

    def rings(self, surface: Surface) -> Ways:
        faces = triangles(surface)

        def means() -> Array:
            mesh = trimesh.Trimesh(surface.points, faces, process=False)
            means = np.empty_like(surface.points)
            for v, ring in enumerate(mesh.vertex_neighbors):
                means[v] = surface.points[ring].sum(axis=0) / len(ring)
            return means

        return {"Python loop over vertex_neighbors": Way(means, "makes the lists each time", facts=summed)}

    def normals(self, surface: Surface) -> Ways:
        faces = triangles(surface).astype(np.int64)

        def normals() -> Array:
            return np.asarray(trimesh.Trimesh(surface.points, faces, process=False).vertex_normals)

        return {"vertex_normals": Way(normals, "angle weighted")}


peer = Trimesh()
