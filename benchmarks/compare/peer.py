"""What a library can be asked. Each answer is a dict of ways; a library that has no answer says why."""

from __future__ import annotations

from pathlib import Path

from benchmarks.data import Array, Surface
from benchmarks.timing import NotOfferedError, Way

__all__ = ["Array", "Peer", "Surface", "Way", "Ways", "counted", "summed", "triangles"]

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

    def normals(self, surface: Surface) -> Ways:
        """Unit normals of the vertices as an (n, 3) array, from the built mesh."""
        raise NotOfferedError("no vertex normals")


def triangles(surface: Surface) -> Array:
    """The (n, 3) array of faces, for a library that takes nothing else."""
    if isinstance(surface.faces, tuple) or surface.faces.shape[1] != 3:
        raise NotOfferedError("triangles only")
    return surface.faces


def counted(vertices: int, faces: int) -> dict[str, float]:
    """What readers must agree on."""
    return {"vertices": vertices, "faces": faces}


def summed(array: Array) -> dict[str, float]:
    """What makers of arrays must agree on, up to rounding."""
    return {"checksum": float(abs(array.astype(float)).sum())}
