"""halfmesh itself, asked like everyone else; and its loops beside loops written by hand over the raw columns."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import halfmesh as hm
from benchmarks.compact import ENCODE, POLYLLA_ON_IT, RULES, random_elements
from benchmarks.compare.halfmesh_loops import (
    ASKING,
    ask,
    ask_and_collapse,
    ask_and_flip,
    done,
    flip_every_fifth,
    means_by_circulator,
    means_by_hand,
    split_all_collapse_back,
    split_edges,
    split_faces,
    try_to_collapse,
    try_to_flip,
)
from benchmarks.compare.peer import (
    Array,
    Peer,
    Surface,
    Way,
    Ways,
    centres_of,
    counted,
    edges_of,
    middles_of,
    points_to_add,
    split_of,
    summed,
    triangles,
)
from benchmarks.operators import FLIP, SPLIT
from benchmarks.polylla import n_not_simple
from benchmarks.timing import NotOfferedError

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

    def operators(self, surface: Surface) -> Ways:
        built = hm.Mesh(surface.faces, surface.points)

        def split_and_collapse(mesh: hm.Mesh) -> dict[str, float]:
            n_collapses = split_all_collapse_back(mesh, mesh.vertex_data.column("points"))
            mesh.compact()
            return {"collapses": n_collapses} | counted(mesh.n_vertices, mesh.n_faces)

        def flip(mesh: hm.Mesh) -> dict[str, float]:
            return {"flips": flip_every_fifth(mesh)}

        return {
            SPLIT: Way(split_and_collapse, "new points by the kernel", facts=dict, fresh=built.copy),
            FLIP: Way(flip, facts=dict, fresh=built.copy),
        }

    def edits(self, surface: Surface, kind: str) -> Ways:
        built = hm.Mesh(*(split_of(surface) if kind == "collapse" else surface))
        n = len(surface.points)
        numbers = [h.index >> 1 for u, v in edges_of(surface).tolist() if (h := built.find_halfedge(u, v))]

        def edges() -> Any:
            mesh = built.copy()
            return mesh, [mesh.edges[e] for e in numbers]

        def edges_and_points() -> Any:
            return *edges(), list(middles_of(surface))

        def faces_and_points() -> Any:
            mesh = built.copy()
            return mesh, list(mesh.faces), list(centres_of(surface))

        def spokes() -> Any:
            mesh, corners = built.copy(), triangles(surface)[:, 0].tolist()
            return mesh, [mesh.find_halfedge(n + f, v) for f, v in enumerate(corners)]

        def way(run: Any, note: str, fresh: Any) -> Way:
            return Way(run, note, facts=done, fresh=fresh)

        return {
            "flip": {
                "ask, then act": way(ask_and_flip, "", edges),
                "in one call": way(try_to_flip, "try_flip", edges),
            },
            "split_edge": {"in one call": way(split_edges, "split_edge_triangular", edges_and_points)},
            "split_face": {"in one call": way(split_faces, "", faces_and_points)},
            "collapse": {
                "ask, then act": way(ask_and_collapse, "", spokes),
                "in one call": way(try_to_collapse, "try_collapse", spokes),
            },
        }[kind]

    def growth(self, surface: Surface, kind: str) -> Ways:
        faces = triangles(surface).tolist()

        def vertices(state: Any) -> tuple[int, hm.Mesh]:
            mesh, points = state
            for point in points:
                mesh.add_vertex(point)
            return len(points), mesh

        def add_faces(state: Any) -> tuple[int, hm.Mesh]:
            mesh, rows = state
            for row in rows:
                mesh.add_face(row)
            return len(rows), mesh

        def handles() -> Any:
            mesh = hm.Mesh([], surface.points)
            v = list(mesh.vertices)
            return mesh, [(v[a], v[b], v[c]) for a, b, c in faces]

        if kind == "add_vertex":
            return {"add": Way(vertices, facts=done, fresh=lambda: (hm.Mesh([]), points_to_add(surface)))}
        return {
            "add": Way(add_faces, "through handles", facts=done, fresh=handles),
            "add, by indices": Way(add_faces, facts=done, fresh=lambda: (hm.Mesh([], surface.points), faces)),
        }

    def bulk(self, surface: Surface) -> Ways:
        if not hasattr(hm.Mesh, "add_faces"):
            raise NotOfferedError("adds no faces in bulk to a mesh that is there")
        half = surface.n_faces // 2

        def add_all(mesh: Any) -> tuple[int, hm.Mesh]:
            mesh.add_vertices(surface.points)
            mesh.add_faces(surface.faces)
            return surface.n_faces, mesh

        def add_second_half(mesh: Any) -> tuple[int, hm.Mesh]:
            mesh.add_faces(surface.faces[half:])
            return surface.n_faces - half, mesh

        return {
            "add_vertices, add_faces": Way(add_all, "to an empty mesh", facts=done, fresh=lambda: hm.Mesh([])),
            "add_faces, the second half": Way(
                add_second_half,
                "to a mesh of the first",
                items=surface.n_faces - half,
                fresh=lambda: hm.Mesh(surface.faces[:half], surface.points),
            ),
            "Mesh": Way(lambda: (surface.n_faces, hm.Mesh(surface.faces, surface.points)), "built", facts=done),
        }

    def queries(self, surface: Surface, n: int) -> Ways:
        built = hm.Mesh(surface.faces, surface.points)

        def handles() -> Any:
            """With room for new elements: that columns grow, once for many, is another matter."""
            mesh = built.copy()
            mesh.split_edge(mesh.n_edges - 1)
            return mesh, [mesh.edges[e] for e in range(n)], mesh.vertices[0]

        def flips(state: Any) -> None:
            mesh, edges, v = state
            for e in edges:
                mesh.try_flip(e)
                ask(mesh, v)

        def splits(state: Any) -> None:
            mesh, edges, v = state
            for e in edges:
                mesh.split_edge(e)
                ask(mesh, v)

        def only(state: Any) -> None:
            mesh, edges, v = state
            for _ in edges:
                ask(mesh, v)

        return {
            "flip, ask": Way(flips, fresh=handles),
            "split an edge, ask": Way(splits, fresh=handles),
            "ask": Way(only, "no change between", fresh=handles),
        }

    def normals(self, surface: Surface) -> Ways:
        mesh = hm.Mesh(surface.faces, surface.points)
        return {
            "vertex_normals, by area": Way(lambda: hm.geometry.vertex_normals(mesh, weights="area"), "area weighted"),
            "vertex_normals": Way(lambda: hm.geometry.vertex_normals(mesh), "angle weighted"),
        }

    def polylla(self, surface: Surface) -> Ways:
        mesh = hm.Mesh(surface.faces, surface.points)

        def quality(polygons: hm.Mesh) -> dict[str, float]:
            return {"polygons": polygons.n_faces, "not simple": n_not_simple(*polygons.face_vertices())}

        return {
            "polylla": Way(
                lambda: hm.polylla(mesh), "to the half-edge mesh of polygons, points included", facts=quality
            )
        }

    def compact(self, surface: Surface) -> Ways:
        mesh = hm.Mesh(surface.faces, surface.points)
        small = hm.CompactMesh(mesh)
        halfedges = random_elements(small.n_halfedges)
        ways = {
            ENCODE: Way(
                lambda: hm.CompactMesh(mesh), "from the built mesh, points included", mesh.n_edges,
                lambda made: {"bits": made.bits_per_edge},
            ),
            POLYLLA_ON_IT: Way(
                lambda: hm.polylla(small), "by the kernels that run on a mesh", mesh.n_faces,
                lambda polygons: {"polygons": polygons.n_faces, "on a mesh": hm.polylla(mesh).n_faces},
            ),
        }  # fmt: skip
        return ways | {
            rule: Way(lambda ask=ASKING[rule]: ask(small, halfedges), "random halfedges", len(halfedges))
            for rule in RULES
        }


peer = HalfMesh()
