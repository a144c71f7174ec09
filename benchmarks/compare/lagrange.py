"""Adobe's Lagrange."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import lagrange
import numpy as np

from benchmarks.compare.peer import Array, Peer, Surface, Way, Ways, counted, summed


class Lagrange(Peer):
    name = "lagrange"
    module = "lagrange"

    def builds(self, surface: Surface) -> Ways:
        make = maker(surface)

        def build() -> lagrange.SurfaceMesh:
            mesh = make()
            mesh.initialize_edges()
            return mesh

        note = "edges, and corners chained around edges and vertices"
        return {"initialize_edges": Way(build, note, facts=lambda mesh: {"edges": mesh.num_edges})}

    def readers(self, path: Path) -> Ways:
        return {
            "load_mesh": Way(
                lambda: lagrange.io.load_mesh(path),
                "arrays only",
                facts=lambda mesh: counted(mesh.num_vertices, mesh.num_facets),
                points=lambda mesh: mesh.vertices,
            )
        }

    def writers(self, surface: Surface, path: Path) -> Ways:
        if path.suffix != ".obj":
            return super().writers(surface, path)
        mesh = maker(surface)()
        return {"save_mesh": Way(lambda: lagrange.io.save_mesh(path, mesh))}

    def rings(self, surface: Surface) -> Ways:
        mesh = maker(surface)()
        mesh.initialize_edges()
        return {"Python loop over edges_around_vertex": Way(lambda: ring_loop(mesh), facts=summed)}

    def steps(self, surface: Surface, n: int) -> Ways:
        mesh = maker(surface)()
        mesh.initialize_edges()

        def ccw() -> None:
            c = 0
            for _ in range(n):
                c = mesh.get_counterclockwise_corner_around_vertex(c)

        def face() -> None:
            for _ in range(n):
                mesh.get_corner_facet(0)

        return {"ccw": Way(ccw, "corner indices"), "face": Way(face, "corner indices")}

    def normals(self, surface: Surface) -> Ways:
        mesh = maker(surface)()

        def normals() -> Array:
            return np.asarray(mesh.attribute(lagrange.compute_vertex_normal(mesh)).data)

        return {"compute_vertex_normal": Way(normals)}


def maker(surface: Surface) -> Any:
    """A function that makes the mesh without its edges."""
    ragged = isinstance(surface.faces, tuple)
    degrees = np.diff(surface.faces[1]).astype(np.uint32) if ragged else None
    indices = np.ascontiguousarray(surface.faces[0] if ragged else surface.faces, np.uint32)

    def make() -> lagrange.SurfaceMesh:
        mesh = lagrange.SurfaceMesh()
        mesh.add_vertices(surface.points)
        if degrees is not None:
            mesh.add_hybrid(degrees, indices)
        elif indices.shape[1] == 3:
            mesh.add_triangles(indices)
        else:
            mesh.add_quads(indices)
        return mesh

    return make


def ring_loop(mesh: lagrange.SurfaceMesh) -> Array:
    points = mesh.vertices
    means: Array = np.empty_like(points)
    for v in range(mesh.num_vertices):
        total, n = np.zeros(3), 0
        for e in mesh.edges_around_vertex(v):
            a, b = mesh.get_edge_vertices(e)
            total += points[b if a == v else a]
            n += 1
        means[v] = total / n
    return means


peer = Lagrange()
