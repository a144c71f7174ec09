"""COMPAS: a half-edge mesh of Python dicts. Large meshes are beyond it, and not asked."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from compas.datastructures import Mesh
from compas.datastructures.mesh.operations.collapse import trimesh_collapse_edge
from compas.datastructures.mesh.operations.split import trimesh_split_edge
from compas.datastructures.mesh.operations.swap import trimesh_swap_edge

from benchmarks.compare.peer import (
    Array,
    Peer,
    Surface,
    Way,
    Ways,
    centres_of,
    counted,
    edges_of,
    points_to_add,
    split_of,
    summed,
    triangles,
)
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

    def edits(self, surface: Surface, kind: str) -> Ways:
        """The operators ask themselves whether they may."""
        start = lists(split_of(surface) if kind == "collapse" else surface)
        ends, n = [(u, v) for u, v in edges_of(surface).tolist()], len(surface.points)

        def edges() -> Any:
            return Mesh.from_vertices_and_faces(*start), ends

        def faces_and_points() -> Any:
            mesh = Mesh.from_vertices_and_faces(*start)
            return mesh, list(mesh.faces()), centres_of(surface).tolist()

        def spokes() -> Any:
            corners = triangles(surface)[:, 0].tolist()
            return Mesh.from_vertices_and_faces(*start), [(v, n + f) for f, v in enumerate(corners)]

        run, note, fresh = {
            "flip": (flip, "trimesh_swap_edge", edges),
            "split_edge": (split_edges, "trimesh_split_edge, which finds the middle", edges),
            "split_face": (split_faces, "insert_vertex", faces_and_points),
            "collapse": (collapse, "trimesh_collapse_edge", spokes),
        }[kind]
        return {"by keys": Way(run, note, facts=done, fresh=fresh)}

    def growth(self, surface: Surface, kind: str) -> Ways:
        points, faces = lists(surface)

        def vertices(state: Any) -> tuple[int, Mesh]:
            mesh, points = state
            for x, y, z in points:
                mesh.add_vertex(x=x, y=y, z=z)
            return len(points), mesh

        def add_faces(mesh: Mesh) -> tuple[int, Mesh]:
            for face in faces:
                mesh.add_face(face)
            return len(faces), mesh

        if kind == "add_vertex":
            rows = [point.tolist() for point in points_to_add(surface)]
            return {"add": Way(vertices, facts=done, fresh=lambda: (Mesh(), rows))}
        return {"add": Way(add_faces, facts=done, fresh=lambda: Mesh.from_vertices_and_faces(points, []))}

    def normals(self, surface: Surface) -> Ways:
        mesh = Mesh.from_vertices_and_faces(*lists(surface))
        return {"vertex_normal": Way(lambda: np.array([mesh.vertex_normal(v) for v in mesh.vertices()]))}


def lists(surface: Surface) -> tuple[list[list[float]], list[list[int]]]:
    if surface.n_faces > MOST_FACES:
        raise NotOfferedError(f"not asked to hold more than {MOST_FACES:,} faces")
    return surface.points.tolist(), triangles(surface).tolist()


def done(result: tuple[int, Mesh]) -> dict[str, float]:
    n, mesh = result
    return {"operations": n} | counted(mesh.number_of_vertices(), mesh.number_of_faces())


def flip(state: Any) -> tuple[int, Mesh]:
    mesh, edges = state
    n = 0
    for edge in edges:
        if trimesh_swap_edge(mesh, edge):
            n += 1
    return n, mesh


def split_edges(state: Any) -> tuple[int, Mesh]:
    mesh, edges = state
    for edge in edges:
        trimesh_split_edge(mesh, edge)
    return len(edges), mesh


def split_faces(state: Any) -> tuple[int, Mesh]:
    mesh, faces, points = state
    for f, point in zip(faces, points, strict=True):
        mesh.insert_vertex(f, xyz=point)
    return len(faces), mesh


def collapse(state: Any) -> tuple[int, Mesh]:
    """The first vertex of an edge stays."""
    mesh, edges = state
    n = 0
    for edge in edges:
        if trimesh_collapse_edge(mesh, edge, t=0.0):
            n += 1
    return n, mesh


peer = Compas()
