"""Compile everything now: the work behind ``halfmesh warmup``.

A kernel is compiled for the types of its arguments at its first call. So each job below does something ordinary with
a tiny mesh, in the gear that always compiles; together the jobs come past every kernel, which a test asserts.
"""

from __future__ import annotations

import contextlib
import importlib
import pkgutil
import subprocess
import sys
import tempfile
import types
from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import halfmesh as hm
from halfmesh import _jit
from halfmesh.core.operators import building
from halfmesh.core.pens import rewind
from halfmesh.core.search import find_halfedge
from halfmesh.core.slots import reserve
from halfmesh.shapes._engine import Triangles
from halfmesh.shapes._scattering import DistanceGrid, scattered
from halfmesh.shapes.triangulations import _trimmed

__all__ = ["Helper", "help_out", "jobs", "kernels_of", "n_compiled_here", "n_from_cache", "never_compiled", "warm_up"]

Job = tuple[str, Callable[[Path], object]]


def warm_up() -> Generator[tuple[str, int, int], None, None]:
    """Compile all kernels of the library, or read them from the cache.

    Yields
    ------
    (name, i, n) : str, int, int
        Before each of the `n` jobs, and once more with ``i == n`` when all is done.

    Notes
    -----
    Safe to run again: what is in the cache is only read. Where nothing is it takes a minute or so.

    Examples
    --------
    >>> from halfmesh.warmup import jobs, warm_up
    >>> steps = warm_up()
    >>> next(steps) == ("building triangles", 0, len(jobs()))
    True
    >>> steps.close()
    """
    todo = jobs()
    with _jit.compiling_always(), tempfile.TemporaryDirectory() as folder:
        for i, (name, job) in enumerate(todo):
            yield name, i, len(todo)
            job(Path(folder))
    yield "done", len(todo), len(todo)


class Helper:
    """Another process that does the jobs from the last to the first, and leaves what it compiles in the cache.

    Compiling keeps the GIL, so a thread would be no help. Whoever does the jobs from the first on meets the helper in
    the middle, and finds the rest in the cache; then the helper is of no use any more.
    """

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory()
        command = [sys.executable, "-c", "from halfmesh.warmup import help_out; help_out()", self._folder.name]
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)

    def dismiss(self) -> int:
        """Stop it; how many kernels it has compiled."""
        self._process.terminate()
        said = self._process.communicate()[0].split()
        self._folder.cleanup()
        return int(said[-1]) if said else 0


def help_out() -> None:
    """What a `Helper` does: after each job it says how many kernels it has compiled so far."""
    with _jit.compiling_always():
        for _, job in reversed(jobs()):
            job(Path(sys.argv[1]))
            print(n_compiled_here(), flush=True)


def jobs() -> list[Job]:
    """Ordinary things to do with tiny meshes, which together come past every kernel."""
    return [
        ("building triangles", lambda _: hm.shapes.icosphere(1)),
        ("building polygons", lambda _: _polygons()),
        ("building fans, twins and wire", lambda _: _unusual()),
        ("refusing what can't be held", lambda _: _refused()),
        ("checking the laws", lambda _: _polygons().check()),
        ("counting", lambda _: _polygons().summary()),
        ("gathering neighbors", lambda _: _gather(_polygons())),
        ("measuring polygons", lambda _: _measure(hm.shapes.cube())),
        ("measuring shapes", lambda _: hm.geometry.polygon_quality(_arrow())),
        ("measuring triangles", lambda _: _measure(hm.shapes.tetrahedron())),
        ("measuring in kernels", lambda _: _measure_one(hm.shapes.cube())),
        ("writing and reading OFF", lambda folder: _there_and_back(folder / "mesh.off")),
        ("writing and reading OBJ", lambda folder: _there_and_back(folder / "mesh.obj")),
        ("writing and reading the files of Triangle", _read_tables),
        ("reading OFF in other forms", _read_other_forms),
        ("changing", lambda _: _change()),
        ("cutting and sewing", lambda _: _sew()),
        ("triangulating", lambda _: _triangulate()),
        ("cutting holes", lambda _: _cut_holes()),
        ("scattering points", lambda _: _scatter()),
        ("joining triangles", lambda _: _join_triangles()),
        ("walking in kernels", lambda _: _walk(hm.shapes.cube(), 0)),
        ("smoothing", lambda _: _smooth()),
        ("holding in little memory", _hold_in_little),
    ]


def _polygons() -> hm.Mesh:
    """A square and a triangle, with a boundary, and an isolated vertex."""
    return hm.Mesh([[0, 1, 2, 3], [1, 4, 2]], np.array([[0, 0], [1, 0], [1, 1], [0, 1], [2, 0.5], [3, 3]]))


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
    for mesh in (hm.shapes.icosphere(4), _polygons(), _decorated()):  # the first is large enough for every short cut
        hm.save(mesh, path)
        hm.load(path)


def _decorated() -> hm.Mesh:
    mesh = _polygons()
    mesh.vertex_data["normal"] = np.tile([0.0, 0.0, 1.0], (mesh.n_vertices, 1))
    mesh.vertex_data["color"] = np.full((mesh.n_vertices, 4), 0.5)
    mesh.halfedge_data["texcoord"] = np.zeros((mesh.n_halfedges, 2))
    return mesh


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


def _change() -> None:
    """Every operator, with attributes of all kinds that follow, and of each form that policies are compiled for."""
    mesh = hm.shapes.icosphere(1)
    for table in (mesh.vertex_data, mesh.halfedge_data, mesh.edge_data, mesh.face_data):
        table.add("x", float)
        table.add("label", int)
    for operator in (
        lambda: mesh.flip(0),
        lambda: mesh.split_edge(0),
        lambda: mesh.split_face(0),
        lambda: mesh.join_faces(mesh.connect(mesh.faces[1].halfedge, mesh.faces[1].halfedge.next, allow_parallel=True)),
        lambda: (mesh.can_flip(0), mesh.can_connect(0, 0), mesh.can_join_faces(0)),
        lambda: mesh.collapse(next(h for h in mesh.halfedges if mesh.can_collapse(h))),
    ):
        operator()
    plain = hm.shapes.icosphere(1)
    for i in range(2):  # from the second call on they take the points along
        plain.split_edge(100), plain.split_face(60), plain.try_collapse(9 + i), plain.split_edge_triangular(110)
    _build_by_hand()
    _build_in_bulk()
    _change_wholes()
    with mesh.transaction() as attempt:
        mesh.split_face(next(iter(mesh.faces)))
        attempt.rollback()
    _grow(mesh.vertex_data.column("points"), 100)
    _jit.filled(mesh.points, len(mesh.points) + 1, mesh.points[:1])  # what `_grow` calls, which may come from the cache
    mesh.compact()
    rewind(mesh, 0)
    reserve(mesh, 1, 1, 1)


def _sew() -> None:
    """The operators that `_change` does not come to; each by its question, and by the method that acts."""
    mesh = hm.shapes.grid(4, 4)
    a, b = mesh.vertices[6].outgoing(), mesh.vertices[8].outgoing()
    h: Any = mesh.find_halfedge(6, 7)
    rim = mesh.boundary_loops()[0]
    g = next(x for x in a if x != h)
    for question, *elements in (
        (mesh.can_split_edge_triangular, h),
        (mesh.can_split_vertex, h, g),
        (mesh.can_join_vertices, h),
        (mesh.can_dissolve_vertex, 7),
        (mesh.can_dissolve_edge, h),
        (mesh.can_fill_hole, 0),
        (mesh.can_add_face_to_boundary, int(rim[0]), int(rim[2])),
        (mesh.can_add_vertex_and_face_to_boundary, int(rim[0]), int(rim[2])),
        (mesh.can_open_edge, h),
        (mesh.can_close_edge, 0),
        (mesh.can_weld, mesh.halfedges[int(rim[0])], mesh.halfedges[int(rim[3])]),
        (mesh.can_weld, 0, 12),
        (mesh.can_unweld, int(rim[0]), int(rim[0])),
        (mesh.can_cut, [h]),
        (mesh.can_stitch, int(rim[0]), int(rim[3])),
        (mesh.can_split_loop, [h, h.next, h.next.next, h.prev]),
        (mesh.can_join_loop, h, next(b)),
    ):
        question(*elements)
    mesh.join_vertices(mesh.split_vertex(h, g).twin)
    for act, *arguments in (
        (mesh.try_flip, h.edge),
        (mesh.split_edge_triangular, h.twin),
        (mesh.dissolve_vertex, 7),
        (mesh.dissolve_edge, mesh.faces[10].halfedge),
        (mesh.make_hole, 12),
        (mesh.fill_hole, int(rim[0])),
        (mesh.add_face_to_boundary, int(rim[0]), int(rim[3])),
        (mesh.add_vertex_and_face_to_boundary, int(rim[0]), int(rim[3])),
        (mesh.close_edge, int(rim[0])),
        (mesh.open_edge, h),
        (mesh.weld, mesh.halfedges[int(rim[0])], mesh.halfedges[int(rim[4])]),
        (mesh.weld, 0, 24),
        (mesh.unweld, int(rim[0]), int(rim[4])),
        (mesh.cut, [h]),
        (mesh.stitch, int(rim[0]), int(rim[5])),
        (mesh.zip_hole, int(rim[1])),
        (mesh.split_loop, [h, h.next, h.next.next, h.prev]),
        (mesh.join_loop, h, int(rim[1])),
    ):
        with contextlib.suppress(hm.TopologyError, hm.StaleElementError):
            act(*arguments)


def _build_by_hand() -> None:
    mesh = hm.Mesh([])
    for _ in range(6):
        mesh.add_vertex()
    edges = [mesh.add_edge(0, 1), mesh.add_edge(1, 2), mesh.add_edge(2, 0)]
    mesh.remove_edge(mesh.add_edge(edges[0].halfedge, 5))
    mesh.can_add_face([3, 4, 5]), mesh.can_add_face(halfedges=[0, 2, 4]), mesh.can_make_adjacent(0, 2)
    mesh.add_face(halfedges=[e.halfedge for e in edges])
    mesh.add_face([3, 4, 5])
    mesh.make_adjacent(mesh.halfedges[1], mesh.halfedges[1].next)
    mesh.remove_face(0)
    mesh.remove_edge(0)
    mesh.remove_vertex(3)
    for kernel, *arguments in (
        (building.add_edge_status, 0, 1),
        (building.make_adjacent_status, 2, 2),
        (building.find_free_incident, 1),
        (building.find_free_between, 1, 2, 2),
        (building.add_edge_in, 2, 2),
    ):
        kernel(mesh, *arguments)


def _build_in_bulk() -> None:
    mesh = hm.Mesh([])
    mesh.add_vertices(np.zeros((24, 3)))
    mesh.add_vertex([1.0, 2.0, 3.0])
    mesh.add_faces([[0, 1, 2]])
    mesh.add_faces([[2, 1, 3], [3, 1, 4]])
    mesh.add_face([2, 3, 4, 5])
    mesh.add_face([6, 7, 8, 9, 10])
    mesh.add_face([11, 12, 13, 12])
    hm.try_add_faces(mesh, np.array([11, 14, 15], np.int32), np.array([0, 3], np.int32))


def _change_wholes() -> None:
    mesh = _decorated()
    mesh.append(mesh)
    mesh.reverse()
    mesh.reverse_component(0)
    mesh.submesh([0])
    mesh.remove_component(0)


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
def _grow(points: Any, n: int) -> None:
    points[n, 0] = points[0, 0]


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


# ----------------------------------------------------------------------------------------------- what has been compiled


def n_compiled_here() -> int:
    """How many kernels this process has compiled itself; those that it read from the cache are not counted."""
    return sum(bool(k.compiled.stats.cache_misses) for k in _touched())


def n_from_cache() -> int:
    """How many kernels this process has read from the cache and not compiled."""
    return sum(bool(k.compiled.stats.cache_hits and not k.compiled.stats.cache_misses) for k in _touched())


def _touched() -> list[_jit.Kernel[Any, Any]]:
    return [k for k in _jit.all_kernels if "compiled" in vars(k)]


def kernels_of(package: types.ModuleType) -> list[_jit.Kernel[Any, Any]]:
    """All kernels of a package, which is imported whole for it."""
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        importlib.import_module(module.name)
    inside = (package.__name__, f"{package.__name__}.")
    known = [k for k in _jit.all_kernels if k.__module__ == inside[0] or k.__module__.startswith(inside[1])]
    return [k for k in known if getattr(sys.modules.get(k.__module__), k.py_func.__name__, None) is k]


def never_compiled(package: types.ModuleType) -> list[_jit.Kernel[Any, Any]]:
    """Kernels that this process has neither compiled nor read from the cache, nor any kernel that calls them.

    Navigation rules are left out: they cost nothing to compile, and the circulators need most of them.
    """
    ours = kernels_of(package)
    reached: set[int] = set()
    for k in ours:
        if "compiled" in vars(k) and k.compiled.signatures:
            _reach(k, reached)
    return [k for k in ours if id(k) not in reached and not isinstance(k, _jit.Rule)]


def _reach(value: Any, reached: set[int]) -> None:
    """Mark a kernel or circulator, and everything that it calls."""
    if id(value) in reached:
        return
    if isinstance(value, _jit.Circulator):
        reached.add(id(value))
        for part in (value.start, value.step, value.value):
            _reach(part, reached)
    elif isinstance(value, _jit.Kernel):
        reached.add(id(value))
        scope = value.py_func.__globals__
        names = list(_names(value.py_func.__code__))
        modules = [scope[name] for name in names if isinstance(scope.get(name), types.ModuleType)]
        for name in names:
            _reach(scope.get(name), reached)
            for module in modules:  # `hm.neighbors` in a kernel
                _reach(getattr(module, name, None), reached)


def _names(code: types.CodeType) -> Iterator[str]:
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _names(constant)
