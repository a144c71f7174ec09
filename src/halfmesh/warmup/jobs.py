"""Ordinary things to do with tiny meshes, which together come past every kernel; a test asserts that."""

from __future__ import annotations

import contextlib
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import halfmesh as hm
from halfmesh.core.search import find_halfedge
from halfmesh.shapes._engine import Triangles
from halfmesh.shapes._scattering import DistanceGrid, scattered
from halfmesh.shapes.triangulations import _trimmed
from halfmesh.warmup.editing import change, sew
from halfmesh.warmup.meshes import decorated, polygons

__all__ = ["jobs"]

Job = tuple[str, Callable[[Path], object]]


def jobs() -> list[Job]:
    """Ordinary things to do with tiny meshes, which together come past every kernel."""
    return [
        ("building triangles", lambda _: hm.shapes.icosphere(1)),
        ("building polygons", lambda _: polygons()),
        ("building fans, twins and wire", lambda _: _unusual()),
        ("refusing what can't be held", lambda _: _refused()),
        ("checking the laws", lambda _: polygons().check()),
        ("counting", lambda _: polygons().summary()),
        ("gathering neighbors", lambda _: _gather(polygons())),
        ("measuring polygons", lambda _: _measure(hm.shapes.cube())),
        ("measuring shapes", lambda _: hm.geometry.polygon_quality(_arrow())),
        ("measuring triangles", lambda _: _measure(hm.shapes.tetrahedron())),
        ("measuring in kernels", lambda _: _measure_one(hm.shapes.cube())),
        ("writing and reading OFF", lambda folder: _there_and_back(folder / "mesh.off")),
        ("writing and reading OBJ", lambda folder: _there_and_back(folder / "mesh.obj")),
        ("writing and reading the files of Triangle", _read_tables),
        ("reading OFF in other forms", _read_other_forms),
        ("changing", lambda _: change()),
        ("cutting and sewing", lambda _: sew()),
        ("triangulating", lambda _: _triangulate()),
        ("cutting holes", lambda _: _cut_holes()),
        ("scattering points", lambda _: _scatter()),
        ("joining triangles", lambda _: _join_triangles()),
        ("walking in kernels", lambda _: _walk(hm.shapes.cube(), 0)),
        ("smoothing", lambda _: _smooth()),
        ("holding in little memory", _hold_in_little),
    ]


def _unusual() -> None:
    hm.Mesh([[0, 1, 2], [0, 3, 4]])  # two fans at a vertex
    hm.Mesh([[0, 1, 2], [0, 2, 1]], twins=[5, 4, 3, 2, 1, 0])
    hm.Mesh([[0, 1, 2, 3], [1, 4, 2]], twins=np.array([-1, 6, -1, -1, -1, -1, 1]))
    hm.Mesh([[0, 1, 2]], edges=[[2, 3]], n_vertices=4)


def _refused() -> None:
    crowded, disagreeing = [[0, 1, 2], [1, 0, 3], [0, 1, 4]], [[0, 1, 2], [0, 1, 3]]
    for faces in (crowded, disagreeing, hm.shapes.moebius_faces()):
        with contextlib.suppress(hm.InvalidMeshError):
            hm.Mesh(faces)


def _gather(mesh: hm.Mesh) -> None:
    for question in (mesh.face_vertices, mesh.face_neighbors, mesh.vertex_neighbors, mesh.vertex_faces):
        question()
    find_halfedge(mesh, 0, 1)


def _cut_holes() -> None:
    """What follows on a triangulation of points, for which a library is needed that may not be there."""
    mesh = hm.shapes.grid(3, triangles=True)
    sides = mesh.edge_vertices()
    _trimmed(mesh, Triangles(mesh.triangles(), sides, np.arange(len(sides), dtype=np.int32)), np.ones((1, 2)), True)


def _measure(mesh: hm.Mesh) -> None:
    for name in hm.geometry.__all__:
        measure = getattr(hm.geometry, name)
        if isinstance(measure, types.FunctionType):
            measure(mesh)
    hm.geometry.vertex_normals(mesh, weights="area")


def _scatter() -> None:
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    scattered(DistanceGrid.of([corners]), corners, 0.2, 0.1, np.random.default_rng(0))


def _arrow() -> hm.Mesh:
    """A face that is not convex."""
    return hm.Mesh([[0, 1, 2, 3]], [[0, 0], [2, 1], [0, 2], [1, 1]])


def _measure_one(mesh: hm.Mesh) -> None:
    """The formulas that nothing in the library calls alone: they wait for the user's kernels."""
    block = hm.geometry.kernels
    for formula in (block.edge_length, block.face_area, block.face_centroid, block.corner_angle):
        formula(mesh, mesh.points, 0)


def _there_and_back(path: Path) -> None:
    for mesh in (hm.shapes.icosphere(4), polygons(), decorated()):  # the first is large enough for every short cut
        hm.save(mesh, path)
        hm.load(path)


def _read_tables(folder: Path) -> None:
    mesh = hm.shapes.tetrahedron()
    hm.save(mesh, folder / "mesh.neigh")
    hm.load(folder / "mesh.neigh")
    (folder / "mesh.ele").write_text("1 3\n0 0 1 9\n")
    with contextlib.suppress(hm.FormatError):
        hm.load(folder / "mesh.ele")


def _read_other_forms(folder: Path) -> None:
    square = "0 0 0  1 0 0  1 1 0  0 1 0"
    numbers = [[4, 1, 4], [float(x) for x in square.split()], [4, 0, 1, 2, 3, 0]]
    big = [np.array(row, dtype).tobytes() for row, dtype in zip(numbers, (">i4", ">f4", ">i4"), strict=True)]
    (folder / "stream.off").write_text(f"OFF 4 1 0\n{square} 4 0 1 2 3\n")
    (folder / "binary.off").write_bytes(b"OFF BINARY\n" + b"".join(big))
    for name in ("stream.off", "binary.off"):
        hm.load(folder / name)


def _triangulate() -> None:
    """Quadrilaterals alone, then faces of any degree, each also in kernels."""
    for mesh in (hm.shapes.grid(2, 2), hm.shapes.dodecahedron()):
        for points in (mesh.points, mesh.vertex_data.column("points")):
            hm.triangulate_face_status(mesh, points, 0)
            hm.triangulate_face(mesh, points, 0)
        hm.triangulate(mesh)


def _join_triangles() -> None:
    """A closed surface where all edges are equally long, to be repaired; and wire at a boundary."""
    hm.polylla(hm.shapes.tetrahedron())
    hm.polylla(hm.Mesh([[0, 1, 2]], np.eye(4, 3), edges=[[2, 3]]))


@hm.kernel
def _walk(t: Any, x: int) -> int:
    """Every circulator once: they wait for the user's kernels."""
    n = 0
    for h in hm.outgoing(t, x):
        n += h
    for h in hm.incoming(t, x):
        n += h
    for v in hm.neighbors(t, x):
        n += v
    for e in hm.edges_around(t, x):
        n += e
    for f in hm.faces_around(t, x):
        n += f
    for h in hm.face_halfedges(t, x):
        n += h
    for v in hm.face_vertices(t, x):
        n += v
    for e in hm.face_edges(t, x):
        n += e
    for f in hm.face_neighbors(t, x):
        n += f
    for h in hm.loop(t, x):
        n += h
    return n


def _smooth() -> None:
    from halfmesh.demo import smooth

    mesh = hm.shapes.icosphere(0)
    smooth(mesh, mesh.points, mesh.points.copy())


def _hold_in_little(folder: Path) -> None:
    """Both forms that are only read; the compact one with holes, two components and an isolated vertex."""
    triangles = hm.TriangleMesh(hm.shapes.tetrahedron())
    mesh = hm.shapes.grid(6, 5)
    for f in (8, 16):
        mesh.remove_face(f)
    mesh.append(hm.shapes.cube())
    mesh.add_vertex()
    hm.CompactMesh(mesh, maps=True).save(folder / "mesh.hmc")
    compact = hm.CompactMesh.load(folder / "mesh.hmc")
    compact.to_mesh()
    for handles, words in (
        (compact.halfedges, "next prev twin ccw cw origin target face edge"),
        (compact.edges, "halfedge"),
        (compact.faces, "halfedge"),
        (compact.vertices, "halfedge"),
    ):
        for word in words.split():
            getattr(handles[0], word)
    for small in (triangles, compact):
        small.face_vertices(), small.vertex_neighbors()
