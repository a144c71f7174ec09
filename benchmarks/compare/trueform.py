"""trueform: adjacency of faces and vertices, in parallel."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import trueform as tf

from benchmarks.compare.peer import Array, Peer, Surface, Way, Ways, counted, summed, triangles


class Trueform(Peer):
    name = "trueform"
    module = "trueform"

    def builds(self, surface: Surface) -> Ways:
        faces: Any = surface.faces
        if isinstance(faces, tuple):
            faces = tf.OffsetBlockedArray(faces[1], faces[0])
        elif faces.shape[1] != 3:
            faces = tf.as_offset_blocked(faces)

        def build() -> tf.Mesh:
            mesh = tf.Mesh(faces, surface.points)
            mesh.build_manifold_edge_link()
            return mesh

        return {"manifold_edge_link": Way(build, "face neighbors and faces of vertices only")}

    def readers(self, path: Path) -> Ways:
        if path.suffix != ".obj":
            return super().readers(path)

        def facts(read: Any) -> dict[str, float]:
            return counted(len(read[1]), len(read[0]))

        name = str(path)
        return {
            "read_obj": Way(
                lambda: tf.read_obj(name, ngon=3, dtype=np.float64),
                "arrays only",
                facts=facts,
                points=lambda read: read[1],
            ),
            "read_obj, float32": Way(
                lambda: tf.read_obj(name, ngon=3), "arrays only", facts=facts, points=lambda read: read[1]
            ),
        }

    def writers(self, surface: Surface, path: Path) -> Ways:
        if path.suffix != ".obj":
            return super().writers(surface, path)
        return {"write_obj": Way(lambda: tf.write_obj((triangles(surface), surface.points), str(path)))}

    def rings(self, surface: Surface) -> Ways:
        mesh = tf.Mesh(triangles(surface), surface.points)
        mesh.build_vertex_link()

        def means() -> Array:
            link = mesh.vertex_link
            totals = np.add.reduceat(mesh.points[link.data], link.offsets[:-1], axis=0)
            means: Array = totals / np.diff(link.offsets)[:, None]
            return means

        return {"NumPy over vertex_link": Way(means, "vectorized by hand", facts=summed)}

    def normals(self, surface: Surface) -> Ways:
        return {"point_normals": Way(lambda: tf.point_normals((triangles(surface), surface.points)), "area weighted")}


peer = Trueform()
