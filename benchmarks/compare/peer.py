"""What a library can be asked. Each answer is a dict of ways; a library that has no answer says why."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from benchmarks.data import Array, Surface
from benchmarks.timing import NotOfferedError, Way

__all__ = [
    "Array",
    "Peer",
    "Surface",
    "Way",
    "Ways",
    "centres_of",
    "counted",
    "edges_of",
    "middles_of",
    "points_to_add",
    "split_of",
    "summed",
    "triangles",
]

Ways = dict[str, Way]


class Peer:
    """A library under measurement. Inputs are cast to the dtypes it works on before the clock starts."""

    name = ""
    module = ""  # what `import` needs

    def builds(self, surface: Surface) -> Ways:
        """Connectivity from an array of faces; the note says what the library's own contains."""
        raise NotOfferedError("builds no connectivity that Python can reach")

    def readers(self, path: Path) -> Ways:
        """From a file to whatever the library calls a mesh."""
        raise NotOfferedError(f"does not read {path.suffix}")

    def writers(self, surface: Surface, path: Path) -> Ways:
        """From the library's mesh to a file."""
        raise NotOfferedError(f"does not write {path.suffix}")

    def rings(self, surface: Surface) -> Ways:
        """The mean of the neighbors of every vertex, (n, 3), by the user's own loop or arrays, from the built mesh."""
        raise NotOfferedError("no rings that Python can reach")

    def steps(self, surface: Surface, n: int) -> Ways:
        """n steps from handle to handle in plain Python, by kind of step."""
        raise NotOfferedError("no handles")

    def operators(self, surface: Surface) -> Ways:
        """Operators over the whole mesh in compiled code of the user's own."""
        raise NotOfferedError("no compiled code of the user's own")

    def edits(self, surface: Surface, kind: str) -> Ways:
        """One operator from plain Python, over handles that are held: a call for each element of a fresh mesh.

        flip
            Every edge, in the order of `edges_of`, where it may be flipped.
        split_edge
            Every edge, by a vertex at `middles_of`, triangles beside it too.
        split_face
            Every face, by a vertex at `centres_of`.
        collapse
            In the mesh of `split_of`, every vertex of three back into a corner, where it may be.
        """
        raise NotOfferedError("no operators")

    def growth(self, surface: Surface, kind: str) -> Ways:
        """`add_vertex` for all `points_to_add`, or `add_face` for every face of a mesh that has the vertices."""
        raise NotOfferedError("does not grow by single elements")

    def bulk(self, surface: Surface) -> Ways:
        """All points and faces added to a mesh that is there, in a call for each."""
        raise NotOfferedError("adds no faces in bulk to a mesh that is there")

    def queries(self, surface: Surface, n: int) -> Ways:
        """n turns of an operator from plain Python, each with all counts asked after it."""
        raise NotOfferedError("no operators with counts after each")

    def normals(self, surface: Surface) -> Ways:
        """Unit normals of the vertices as an (n, 3) array, from the built mesh."""
        raise NotOfferedError("no vertex normals")

    def polylla(self, surface: Surface) -> Ways:
        """The Polylla mesh of triangles, from the built mesh to connectivity of polygons."""
        raise NotOfferedError("no Polylla meshes")

    def compact(self, surface: Surface) -> Ways:
        """A succinct form of a built mesh: making it, asking it."""
        raise NotOfferedError("no succinct form")


def triangles(surface: Surface) -> Array:
    """The (n, 3) array of faces, for a library that takes nothing else."""
    if isinstance(surface.faces, tuple) or surface.faces.shape[1] != 3:
        raise NotOfferedError("triangles only")
    return surface.faces


def edges_of(surface: Surface) -> Array:
    """The ends of every edge, (n, 2), in the order in which faces come to them first: the same for every library."""
    sides = np.stack([triangles(surface), np.roll(triangles(surface), -1, axis=1)], axis=2).reshape(-1, 2)
    keys = sides.min(axis=1).astype(np.int64) * len(surface.points) + sides.max(axis=1)
    first: Array = np.sort(np.unique(keys, return_index=True)[1])
    return sides[first]


def middles_of(surface: Surface) -> Array:
    middles: Array = surface.points[edges_of(surface)].mean(axis=1)
    return middles


def centres_of(surface: Surface) -> Array:
    centres: Array = surface.points[triangles(surface)].mean(axis=1)
    return centres


def points_to_add(surface: Surface) -> list[Array]:
    """As many points as there are faces, one by one."""
    return list(np.resize(surface.points, (surface.n_faces, 3)))


def split_of(surface: Surface) -> Surface:
    """Every face in three around a new vertex: those come last, each joined to the first corner of its face."""
    corners = triangles(surface)
    new = np.arange(len(surface.points), len(surface.points) + len(corners), dtype=np.int32)
    parts = [np.stack([corners[:, k], corners[:, (k + 1) % 3], new], axis=1) for k in range(3)]
    return Surface(np.stack(parts, axis=1).reshape(-1, 3), np.vstack([surface.points, centres_of(surface)]))


def counted(vertices: int, faces: int) -> dict[str, float]:
    """What readers must agree on."""
    return {"vertices": vertices, "faces": faces}


def summed(array: Array) -> dict[str, float]:
    """What makers of arrays must agree on, up to rounding."""
    return {"checksum": float(abs(array.astype(float)).sum())}
