"""The meshes that everything is measured on: made once from fixed seeds, cached in `.bench/data`.

Names: `sphere-6` and `sphere-6-shuffled` (a bumpy noisy icosphere of level 6, 7 or 8: 81,920, 327,680 or 1,310,720
triangles), the adversarial `fan-first-N fan-last-N bipyramid-N book-N`, the polygons `quads-N mixed-N polygon-N`, the
triangles `grid-N` row by row, the Delaunay triangles `delaunay-N` of N random points as Qhull lists them, and
`delaunay-N-coherent` with points and triangles along a curve that fills the plane, `file:NAME` for a file of the corpus
beside the repository.
"""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
CACHE = ROOT / ".bench" / "data"
CORPUS = ROOT.parent / "shared" / "corpus"
SEED = 20_250_101

Array = np.ndarray[Any, np.dtype[Any]]


class Surface(NamedTuple):
    """Faces as an (n, 3) or (n, 4) int32 array or as ragged (indices, offsets), and points as (n, 3) float64."""

    faces: Array | tuple[Array, Array]
    points: Array

    @property
    def n_faces(self) -> int:
        return len(self.faces[1]) - 1 if isinstance(self.faces, tuple) else len(self.faces)

    @property
    def n_corners(self) -> int:
        return len(self.faces[0]) if isinstance(self.faces, tuple) else int(self.faces.size)


def load(name: str) -> Surface:
    """The mesh of that name, from the cache or made now."""
    path = CACHE / f"{name.replace(':', '-').replace('/', '-')}.npz"
    if not path.exists():
        surface = make(name)
        ragged = isinstance(surface.faces, tuple)
        columns = dict(zip(("indices", "offsets"), surface.faces, strict=True)) if ragged else {"faces": surface.faces}
        path.parent.mkdir(parents=True, exist_ok=True)
        np.savez(path, points=surface.points, **columns)
    with np.load(path) as stored:
        faces = stored["faces"] if "faces" in stored else (stored["indices"], stored["offsets"])
        return Surface(faces, stored["points"])


def make(name: str) -> Surface:
    if name.startswith("file:"):
        return triangulated_file(CORPUS / name.removeprefix("file:"))
    stem, _, rest = name.rpartition("-")
    if rest == "shuffled":
        return shuffled(load(stem))
    if rest == "coherent":
        return coherent(load(stem))
    return MAKERS[stem](int(rest))


# ---- the bumpy sphere ------------------------------------------------------------------------------------------------


def sphere(level: int) -> Surface:
    """An icosahedron, subdivided `level` times, on a bumpy sphere with a little noise."""
    faces, points = icosahedron()
    for _ in range(level):
        faces, points = subdivided(faces, points)
    x, y, z = points.T
    points = points * (1 + 0.15 * np.sin(5 * x) * np.cos(4 * y) + 0.1 * np.sin(9 * z))[:, None]
    noise = np.random.default_rng(SEED).normal(scale=0.00025 * 2.0 ** (7 - level), size=points.shape)
    return Surface(faces.astype(np.int32), points + noise)


def icosahedron() -> tuple[Array, Array]:
    g = (1 + 5**0.5) / 2
    points = np.array([(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
                       (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)])  # fmt: skip
    faces = np.array([(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
                      (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5),
                      (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)], np.int64)  # fmt: skip
    return faces, unit(points)


def subdivided(faces: Array, points: Array) -> tuple[Array, Array]:
    """Every triangle in four; midpoints by sorted edge key, faces as corner 0, corner 1, corner 2, centre in blocks."""
    ends = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2)
    low, high = ends.min(axis=2), ends.max(axis=2)
    keys, middle = np.unique(low * len(points) + high, return_inverse=True)
    u, v = np.divmod(keys, len(points))
    middle = middle.reshape(-1, 3) + len(points)
    (a, b, c), (ab, bc, ca) = faces.T, middle.T
    blocks = [np.stack(block, axis=1) for block in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))]
    return np.concatenate(blocks), np.vstack([points, unit(points[u] + points[v])])


def unit(vectors: Array) -> Array:
    lengths: Array = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / lengths


def shuffled(surface: Surface) -> Surface:
    """The same mesh with its vertices and its faces in random order."""
    assert not isinstance(surface.faces, tuple)
    random = np.random.default_rng(SEED + 1)
    new_id = random.permutation(len(surface.points)).astype(np.int32)
    points = np.empty_like(surface.points)
    points[new_id] = surface.points
    return Surface(random.permutation(new_id[surface.faces]), points)


# ---- random Delaunay triangles ---------------------------------------------------------------------------------------


QHULL = """
import sys, numpy as np, scipy.spatial
points = np.load(sys.argv[1])
faces = scipy.spatial.Delaunay(points).simplices.astype(np.int32)
u, v = (points[faces[:, k]] - points[faces[:, 0]] for k in (1, 2))
clockwise = u[:, 0] * v[:, 1] < u[:, 1] * v[:, 0]
faces[clockwise] = faces[clockwise][:, [0, 2, 1]]
np.save(sys.argv[1], faces)
"""


def delaunay(n: int) -> Surface:
    """Of random points in a square, by the SciPy of the libraries that are compared."""
    from benchmarks.environment import PYTHON

    points = random_points(n)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "points.npy"
        np.save(path, points[:, :2])
        if subprocess.run([str(PYTHON), "-c", QHULL, str(path)], check=False).returncode:
            raise SystemExit(
                "random Delaunay triangles need SciPy: have it among the libraries, --peers halfmesh,scipy"
            )
        return Surface(np.load(path), points)


def random_points(n: int) -> Array:
    return np.c_[np.random.default_rng(SEED).random((n, 2)), np.zeros(n)]


def coherent(surface: Surface) -> Surface:
    """The same mesh with its vertices, and its faces by their middles, along Morton's curve."""
    assert not isinstance(surface.faces, tuple)
    order = np.argsort(morton(surface.points), kind="stable")
    new_id = np.empty(len(order), np.int32)
    new_id[order] = np.arange(len(order), dtype=np.int32)
    points, faces = surface.points[order], new_id[surface.faces]
    return Surface(faces[np.argsort(morton(points[faces].mean(axis=1)), kind="stable")], points)


def morton(points: Array) -> Array:
    """Where points in the unit square are on the curve: the bits of x and y by turns."""
    bits = (points[:, :2] * 65535).astype(np.uint64)
    for shift, mask in ((8, 0x00FF00FF), (4, 0x0F0F0F0F), (2, 0x33333333), (1, 0x55555555)):
        bits = (bits | (bits << np.uint64(shift))) & np.uint64(mask)
    places: Array = bits[:, 0] | (bits[:, 1] << np.uint64(1))
    return places


# ---- adversarial meshes and polygons ---------------------------------------------------------------------------------


def circle(n: int) -> Array:
    angle = np.linspace(0, 2 * np.pi, n, endpoint=False)
    return np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)


def fan_first(n: int) -> Surface:
    """A closed fan of n triangles around vertex 0."""
    rim = np.arange(1, n + 1, dtype=np.int32)
    return Surface(np.stack([np.zeros_like(rim), rim, np.roll(rim, -1)], axis=1), np.vstack([np.zeros(3), circle(n)]))


def fan_last(n: int) -> Surface:
    """The same fan around the last vertex."""
    rim = np.arange(n, dtype=np.int32)
    return Surface(np.stack([np.full_like(rim, n), rim, np.roll(rim, -1)], axis=1), np.vstack([circle(n), np.zeros(3)]))


def bipyramid(n: int) -> Surface:
    """Two apexes over a circle of n points: 2 n triangles."""
    rim = np.arange(n, dtype=np.int32)
    up = np.stack([rim, np.roll(rim, -1), np.full_like(rim, n)], axis=1)
    down = np.stack([np.roll(rim, -1), rim, np.full_like(rim, n + 1)], axis=1)
    return Surface(np.vstack([up, down]), np.vstack([circle(n), [[0, 0, 1], [0, 0, -1]]]))


def book(n: int) -> Surface:
    """n triangles on the one edge 0-1: not a mesh that halfedges can hold."""
    page = np.arange(2, n + 2, dtype=np.int32)
    faces = np.stack([np.zeros_like(page), np.ones_like(page), page], axis=1)
    return Surface(faces, np.vstack([[[0, 0, -1], [0, 0, 1]], circle(n)]))


def quads(n_corners: int) -> Surface:
    """A square grid of quads with about that many corners."""
    side = round((n_corners / 4) ** 0.5)
    corner = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    faces = np.stack([corner, corner + 1, corner + side + 2, corner + side + 1], axis=1).astype(np.int32)
    y, x = np.divmod(np.arange((side + 1) ** 2), side + 1)
    return Surface(faces, np.stack([x, y, 0 * x], axis=1).astype(float))


def mixed(n_corners: int) -> Surface:
    """The grid with every other quad cut into two triangles, ragged."""
    grid = quads(round(n_corners * 0.8))
    assert not isinstance(grid.faces, tuple)
    pairs = grid.faces[: len(grid.faces) // 2 * 2].reshape(-1, 8)
    indices = pairs[:, [0, 1, 2, 3, 4, 5, 6, 4, 6, 7]].ravel()
    degrees = np.tile([4, 3, 3], len(pairs))
    return Surface((indices, np.concatenate([[0], np.cumsum(degrees)]).astype(np.int32)), grid.points)


def grid(n: int) -> Surface:
    """The first n triangles of a square grid, row by row: every one hangs on those before it."""
    halves = quads(4 * (n // 2 + 2 * round((n / 2) ** 0.5) + 1))
    assert not isinstance(halves.faces, tuple)
    faces = np.ascontiguousarray(halves.faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)[:n])
    return Surface(faces, halves.points[: faces.max() + 1])


def polygon(n: int) -> Surface:
    """One face with n sides."""
    return Surface((np.arange(n, dtype=np.int32), np.array([0, n], np.int32)), circle(n))


MAKERS: dict[str, Callable[[int], Surface]] = {
    "sphere": sphere, "fan-first": fan_first, "fan-last": fan_last, "bipyramid": bipyramid, "book": book,
    "quads": quads, "mixed": mixed, "grid": grid, "polygon": polygon, "delaunay": delaunay,
}  # fmt: skip


# ---- text files ------------------------------------------------------------------------------------------------------


def text_file(name: str, suffix: str) -> Path:
    """The mesh of that name as a plain OFF or OBJ file, every coordinate with all its digits."""
    path = CACHE / f"{name}{suffix}"
    if not path.exists():
        surface = load(name)
        assert not isinstance(surface.faces, tuple)
        n, m = len(surface.points), len(surface.faces)
        off = suffix == ".off"
        vertex, face = ("{!r} {!r} {!r}\n", "3 {} {} {}\n") if off else ("v {!r} {!r} {!r}\n", "f {} {} {}\n")
        unfinished = path.with_suffix(".part")
        with unfinished.open("w") as file:
            file.write(f"OFF\n{n} {m} 0\n" if off else "")
            file.writelines(vertex.format(*row) for row in surface.points.tolist())
            file.writelines(face.format(*row) for row in (surface.faces + (0 if off else 1)).tolist())
        unfinished.replace(path)
    return path


def read_points(path: Path) -> Array:
    """The vertices of a plain OFF or OBJ file, to see what a writer kept of them."""
    lines = path.read_text().splitlines()
    if path.suffix == ".obj":
        rows = [line.split()[1:4] for line in lines if line.startswith("v ")]
    else:
        told = [words for line in lines if (words := line.split("#")[0].split())]
        rows = [words[:3] for words in told[2 : 2 + int(told[1][0])]]
    return np.array(rows, dtype=float)


def kept(points: Array, written: Array) -> str:
    """What a reader or writer made of the coordinates."""
    lost = abs(points - written).max()
    return "exact" if lost == 0 else f"coordinates off by up to {lost:.0e}"


def triangulated_file(path: Path) -> Surface:
    """A plain OFF or OBJ file with its polygons cut into fans, so that every library can take it."""
    words = [line.split() for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")]
    if path.suffix == ".obj":
        lists = [[int(word.split("/")[0]) - 1 for word in row[1:]] for row in words if row[0] == "f"]
    else:
        first = 2 + int(words[1][0])
        lists = [[int(word) for word in row[1 : int(row[0]) + 1]] for row in words[first : first + int(words[1][1])]]
    triangles = [(face[0], face[k], face[k + 1]) for face in lists for k in range(1, len(face) - 1)]
    return Surface(np.array(triangles, np.int32), read_points(path))
