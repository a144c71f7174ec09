"""The main job, once around: a file becomes a half-edge mesh that answers, at compiled speed in your own loop too.

This is the work behind ``halfmesh demo``, in sections of text and figures that the command line prints. Every figure
is measured in the run that shows it, and every answer is the value of the expression that stands next to it.
"""

from __future__ import annotations

import inspect
import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

import halfmesh as hm
from halfmesh import _jit
from halfmesh.viewer import FIGURE_FACES, FIGURE_POINTS, save_structure_diagram

__all__ = ["Section", "draw_structure", "explore", "make_example", "smooth"]

R = TypeVar("R")

LEVELS = {"large": 7, "small": 4}  # of the icosphere: 327,680 and 5,120 triangles
MOST_INTERPRETED = 200_000  # vertices for plain Python: half a second or so
PASSES = 10
WIDEST = 27  # characters of an answer


@dataclass
class Section:
    """A piece of the demo: a title, then whichever it has of a text, code, a table and remarks."""

    title: str
    text: list[str] = field(default_factory=list)
    code: str = ""
    header: tuple[str, ...] = ()
    rows: list[tuple[str, ...]] = field(default_factory=list)
    figures: Sequence[int] = ()  # the columns to be aligned at the right
    codes: Sequence[int] = ()  # the columns that hold code
    remarks: list[str] = field(default_factory=list)


# -------------------------------------------------------------------------------------------------------- a user's loop


@hm.kernel
def smooth(t, points, out):  # type: ignore[no-untyped-def]
    """Move every vertex to the mean of its neighbors."""
    for v in range(len(out)):
        x = y = z = 0.0
        n = 0
        for u in hm.neighbors(t, v):
            x += points[u, 0]
            y += points[u, 1]
            z += points[u, 2]
            n += 1
        if n > 0 and not hm.is_boundary_vertex(t, v):
            out[v, 0] = x / n
            out[v, 1] = y / n
            out[v, 2] = z / n


# ------------------------------------------------------------------------------------------------------------- sections


def make_example(folder: Path, size: str = "large") -> tuple[Path, Section]:
    """Write a noisy sphere to ``folder/sphere.off``.

    Parameters
    ----------
    folder : Path
        Made if it isn't there.
    size : {"large", "small"}
        327,680 or 5,120 triangles.

    Returns
    -------
    path : Path
    section : Section
        What there is to say about it.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> path, section = make_example(pathlib.Path(tempfile.mkdtemp()), "small")
    >>> hm.load(path)
    <Mesh: 2562 vertices, 7680 edges, 5120 faces, closed>
    """
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "sphere.off"
    started = time.perf_counter()
    mesh = hm.shapes.icosphere(LEVELS[size])
    noise = 0.2 * mesh.edges[0].length
    mesh.points += np.random.default_rng(0).normal(scale=noise, size=mesh.points.shape)
    made = time.perf_counter()
    hm.save(mesh, path)
    times = f"made in {_time(made - started)}, written in {_time(time.perf_counter() - made)}"
    counts = f"{mesh.n_vertices:,} points, {mesh.n_faces:,} triangles"
    text = [f"{path}: a noisy sphere, {counts}, {path.stat().st_size / 1e6:.3g} MB", f"{times} (first calls)"]
    return path, Section("A mesh in a file", text)


def explore(path: Path) -> Iterator[Section]:
    """Read a mesh file, build and check the mesh, ask it, run a loop on it.

    Raises
    ------
    FormatError, OSError
        The file can't be read.
    InvalidMeshError
        Its faces can't be held.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "cube.off"
    >>> hm.save(hm.shapes.cube(), path)
    >>> [section.title for section in explore(path)]
    ['From cube.off to a mesh that answers', 'Questions', 'A loop of your own']
    """
    mesh, section = _build(path)
    yield section
    yield _ask(mesh)
    yield _loop(mesh)


def _build(path: Path) -> tuple[hm.Mesh, Section]:
    section = Section(f"From {path.name} to a mesh that answers", codes=[0], figures=[1, 2, 3])
    section.header = ("", "first call", "again", "a second")

    def step(code: str, call: Callable[[], R], amount: Callable[[R], int], unit: str) -> R:
        result, first, again = _first_and_again(call)
        section.rows.append((code, _time(first), _time(again), _amount(amount(result) / again, unit)))
        return result

    n_bytes, normals = path.stat().st_size, hm.geometry.vertex_normals
    faces, points = step("hm.io.read(path)", lambda: hm.io.read(path), lambda _: n_bytes, "B")
    step("hm.Mesh(faces, points)", lambda: hm.Mesh(faces, points), lambda made: made.n_faces, "faces")
    mesh = step("mesh = hm.load(path)  # both", lambda: hm.load(path), lambda _: n_bytes, "B")
    step("mesh.check()", mesh.check, lambda _: mesh.n_faces, "faces")
    step("mesh.vertex_neighbors()", mesh.vertex_neighbors, lambda _: mesh.n_vertices, "rings")
    step("hm.geometry.vertex_normals(mesh)", lambda: normals(mesh), lambda _: mesh.n_vertices, "normals")
    section.remarks.append("A first call compiles, or reads what an earlier run has compiled.")
    return mesh, section


def _ask(mesh: hm.Mesh) -> Section:
    questions = [
        ("components", "mesh.n_connected_components"),
        ("boundary loops", "mesh.n_boundary_loops"),
        ("V - E + F", "mesh.euler_characteristic"),
        ("genus", "mesh.genus"),
    ]
    linked = np.flatnonzero(mesh.topology.vertex_halfedge >= 0)
    if len(linked):
        v = mesh.vertices[int(linked[0])]
        u = next(v.neighbors())
        questions += [
            ("a vertex", f"v = mesh.vertices[{v.index}]"),
            ("its degree", "v.degree"),
            ("its ring, ccw", "[u.index for u in v.neighbors()]"),
            ("a halfedge", f"h = mesh.find_halfedge({v.index}, {u.index})"),
            ("its twin", "h.twin"),
            ("along its face", "h.next, h.prev"),
            ("left and right", "h.face, h.twin.face"),
        ]
    return Section("Questions", [f"mesh = {mesh!r}"], rows=_answers(mesh, questions), codes=[1])


def _loop(mesh: hm.Mesh) -> Section:
    """A user's kernel, compiled and interpreted."""
    section = Section("A loop of your own", code=_source_of_smooth())
    section.header, section.figures, section.codes = ("", "vertices", "time", "a vertex"), [1, 2, 3], [0]

    def row(call: str, seconds: float, n: int) -> float:
        section.rows.append((call, f"{n:,}", _time(seconds), _time(seconds / n) if n else "-"))
        return seconds / max(n, 1)

    points = mesh.points
    n_plain = min(len(points), MOST_INTERPRETED)
    plain = points[:n_plain].copy()
    seconds = _seconds(lambda: smooth.interpreted(mesh, points, plain))
    slow = row("smooth.interpreted(mesh, points, out)", seconds, n_plain)
    if _jit.gears.interpret_only:
        section.remarks.append("NUMBA_DISABLE_JIT is set: there is nothing to compare with.")
        return section
    compiled = points.copy()
    _, first, again = _first_and_again(lambda: smooth(mesh, points, compiled))
    row("smooth(mesh, points, out)  # first call", first, len(points))
    fast = row("smooth(mesh, points, out)  # again", again, len(points))
    if len(points):
        equal = np.array_equal(compiled[:n_plain], plain, equal_nan=True)
        same = "equal to the last bit" if equal else f"equal within {np.nanmax(np.abs(compiled[:n_plain] - plain)):.1e}"
        section.remarks.append(f"{slow / fast:,.0f} x as fast as plain Python, on one thread, and {same}.")
    if mesh.n_edges and bool(np.isfinite(points).all()):
        section.remarks.append(_smoothed(mesh))
    return section


def _smoothed(mesh: hm.Mesh) -> str:
    """What some passes do: by how much the vertices come closer to the mean of their neighbors."""
    before, after = mesh.points.copy(), mesh.points.copy()
    distances = []
    for _ in range(PASSES + 1):
        smooth(mesh, before, after)
        distances.append(math.sqrt(float(np.square(after - before).sum(axis=1).mean())))
        before, after = after, before
    if distances[-1] == 0.0:
        return "The points lie there already."
    closer = distances[0] / distances[-1]
    return f"{PASSES} passes later, the vertices are {closer:,.3g} x closer to that mean (rms)."


def draw_structure(folder: Path) -> Section:
    """Draw the structure of a small mesh of polygons to ``folder/structure.svg``, and ask that mesh.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> draw_structure(pathlib.Path(tempfile.mkdtemp())).rows[0]
    ('a halfedge', 'h = mesh.find_halfedge(0, 1)', 'Halfedge(0)')
    """
    folder.mkdir(parents=True, exist_ok=True)
    mesh_path, picture = folder / "patch.off", folder / "structure.svg"
    hm.save(hm.Mesh(FIGURE_FACES, FIGURE_POINTS), mesh_path)
    mesh = hm.load(mesh_path)
    questions = [
        ("a halfedge", "h = mesh.find_halfedge(0, 1)"),
        ("from, to", "h.origin, h.target"),
        ("its twin", "h.twin"),
        ("along its face", "h.next, h.prev"),
        ("about origin", "h.ccw, h.cw"),
        ("left and right", "h.face, h.twin.face"),
        ("the left face", "f = h.face"),
        ("its corners", "[v.index for v in f.vertices()]"),
        ("face degrees", "[f.degree for f in mesh.faces]"),
        ("boundary loop", "mesh.boundary_loops()[0].tolist()"),
    ]
    rows = _answers(mesh, questions)
    save_structure_diagram(mesh, picture, highlight=0)
    text = [f"{picture} shows a small mesh, with the numbers of these answers:"]
    return Section("The structure in a picture", text, rows=rows, codes=[1])


# -------------------------------------------------------------------------------------------------------------- helpers


def _answers(mesh: hm.Mesh, questions: list[tuple[str, str]]) -> list[tuple[str, ...]]:
    """Each question with the value of its expression; ``x = ...`` gives x for the questions that follow."""
    known: dict[str, Any] = {"mesh": mesh}
    rows: list[tuple[str, ...]] = []
    for words, expression in questions:
        name, assigned, right = expression.partition(" = ")
        value = eval(right or expression, known)
        if assigned:
            known[name] = value
        rows.append((words, expression, _shown(value)))
    return rows


def _shown(value: Any) -> str:
    if isinstance(value, int):
        return f"{value:,}"
    if isinstance(value, tuple):
        return ", ".join(map(str, value))
    if isinstance(value, list) and len(str(value)) > WIDEST:
        n = next(n for n in range(len(value), -1, -1) if len(str(value[:n])) + 5 <= WIDEST)
        return f"{str(value[:n])[:-1]}, ...]" if n else f"{len(value):,} items"
    return str(value)


def _source_of_smooth() -> str:
    """The loop as it stands above, without what is there for type checkers."""
    lines = inspect.getsource(smooth.py_func).rstrip().splitlines()
    return "\n".join(line.partition("  # type:")[0] for line in lines)


def _first_and_again(call: Callable[[], R]) -> tuple[R, float, float]:
    """The result, the seconds of the first call, and the least of the three that follow."""
    started = time.perf_counter()
    result = call()
    first = time.perf_counter() - started
    return result, first, min(_seconds(call) for _ in range(3))


def _seconds(call: Callable[[], object]) -> float:
    started = time.perf_counter()
    call()
    return time.perf_counter() - started


def _amount(n: float, unit: str) -> str:
    """``15.2 M faces``, ``265 MB``: three figures."""
    prefix, size = next((pair for pair in (("G", 1e9), ("M", 1e6), ("k", 1e3)) if n >= pair[1]), ("", 1.0))
    gap = " " if prefix and unit != "B" else ""
    return f"{n / size:.3g} {prefix}{gap}{unit}"


def _time(seconds: float) -> str:
    """``1.52 s``, ``61 ms``, ``2.9 us``: two or three figures."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.0f} ns"
