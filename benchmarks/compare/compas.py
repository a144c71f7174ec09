"""COMPAS: a half-edge mesh of Python dicts. Large meshes are beyond it, and not asked."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from compas.datastructures import Mesh

from benchmarks.compare.peer import Array, Peer, Surface, Way, Ways, counted, summed, triangles
from benchmarks.timing import NotOfferedError

MOST_FACES = 100_000


class Compas(Peer):
    name = "compas"
    module = "compas.datastructures"

    def builds(self, surface: Surface) -> Ways:
        points, faces = lists(surface)
        return {
            "from_vertices_and_faces": Way(
                lambda: Mesh.from_vertices_and_faces(points, faces),
                "half-edge mesh of dicts",
                facts=lambda mesh: {"edges": mesh.number_of_edges()},
            )
        }

    def readers(self, path: Path) -> Ways:
        read = {".off": Mesh.from_off, ".obj": Mesh.from_obj}[path.suffix]
        if path.stat().st_size > 10_000_000:
            raise NotOfferedError("not asked to read files above 10 MB: minutes")
        return {
            read.__name__: Way(
                lambda: read(str(path)),
                facts=lambda mesh: counted(mesh.number_of_vertices(), mesh.number_of_faces()),
                points=lambda mesh: np.array(mesh.to_vertices_and_faces()[0]),
            )
        }

    def rings(self, surface: Surface) -> Ways:
        mesh = Mesh.from_vertices_and_faces(*lists(surface))

        def means() -> Array:
            points = surface.points
            means = np.empty_like(points)
            for v in mesh.vertices():
                ring = mesh.vertex_neighbors(v)
                means[v] = points[ring].sum(axis=0) / len(ring)
            return means

        return {"Python loop over vertex_neighbors": Way(means, facts=summed)}

    def steps(self, surface: Surface, n: int) -> Ways:
        mesh = Mesh.from_vertices_and_faces(*lists(surface))
        u = 0
        start = (u, mesh.vertex_neighbors(u)[0])

        def next_() -> None:
            edge = start
            for _ in range(n):
                edge = mesh.halfedge_after(edge)

        def face() -> None:
            for _ in range(n):
                mesh.halfedge_face(start)

        return {"next": Way(next_), "face": Way(face)}

    def normals(self, surface: Surface) -> Ways:
        mesh = Mesh.from_vertices_and_faces(*lists(surface))
        return {"vertex_normal": Way(lambda: np.array([mesh.vertex_normal(v) for v in mesh.vertices()]))}


def lists(surface: Surface) -> tuple[list[list[float]], list[list[int]]]:
    if surface.n_faces > MOST_FACES:
        raise NotOfferedError(f"not asked to hold more than {MOST_FACES:,} faces")
    return surface.points.tolist(), triangles(surface).tolist()


peer = Compas()
