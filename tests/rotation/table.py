"""Every operator of the library: what it takes, what the twin says of it, and what it promises to Euler's number."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable
from typing import Any, NamedTuple

from halfmesh.core import operators

from . import building, edges, holes, loops, seams, vertices, wholes
from .edges import triangles_beside
from .rings import OUTSIDE

# beyond a size, walks do none of these
GROWING = [
    "add_vertex",
    "add_vertices",
    "add_edge",
    "add_triangle",
    "add_quad",
    "add_face",
    "add_face_of_vertices",
    "add_face_to_boundary",
    "add_vertex_and_face_to_boundary",
    "append",
    "connect",
    "cut",
    "open_edge",
    "split_edge",
    "split_edge_triangular",
    "split_face",
    "split_loop",
    "split_vertex",
    "unweld",
]


class Operator(NamedTuple):
    """``takes`` has a letter for each argument.

    ``v h e f`` an element, ``H V`` lists of halfedges and vertices, ``?`` a flag, ``w`` a weight, ``n`` a number, ``m``
    another mesh, by its name among the starts, ``G`` a halfedge or -1.
    ``promises(m, *args)``, asked before, gives the changes of V, E, F, components and boundary loops; None: not fixed.
    ``ways`` say how arguments are drawn so that the operator has a chance, see `drawing`.
    """

    name: str
    takes: str
    ways: str
    why_not: Callable[..., set[str]]
    act: Callable[..., Any]
    promises: Callable[..., tuple[int | None, ...]]
    keeps_faces: bool = True  # what the faces add up to, the new ones at 0, stays

    @property
    def kernel(self) -> Any:
        """The library's ``try_`` form."""
        return KERNELS["try_" + self.name]

    @property
    def grows(self) -> bool:
        """Whether there may be more elements afterwards."""
        return self.name in GROWING


def always(m, *args):
    return set()


def fixed(*change):
    return lambda m, *args: change


def beside(m, *darts):
    """How many faces lie on the left of any of these darts."""
    return len({m.face[h] for h in darts} - {OUTSIDE})


def is_alone(m, h):
    return m.next(h) == h ^ 1 and m.next(h ^ 1) == h


# -- promises that depend on what is there ---------------------------------------------------------------------------


def split_edge_triangular(m, h, *_):
    k = (not m.is_outside(h)) + (not m.is_outside(h ^ 1))
    return 1, 1 + k, k, 0, 0


def split_face(m, f):
    k = len(m.loop(m.side(f)))
    return 1, k, k - 1, 0, 0


def collapse(m, h, weight):
    k = len(triangles_beside(m, h))
    return -1, -1 - k, -k, 0, -1 if is_alone(m, h) else 0


def join_vertices(m, h, *_):
    return -1, -1, 0, 0, -1 if is_alone(m, h) else 0


def dissolve_vertex(m, v):
    k, closed = len(m.ring[v]), m.is_closed(v)
    if k <= 2:
        return -1, -1, 0, 0, -1 if k == 1 and is_alone(m, m.ring[v][0]) else 0
    return (-1, -k, 1 - k, 0, 0) if closed else (-1, 1 - k, 2 - k, 0, 0)


def add_vertices(m, n):
    return n, 0, 0, n, 0


def add_edge(m, u, v):
    return 0, 1, 0, 0 if v in m.component(u) else -1, None


def remove_edge(m, e):
    return 0, -1, -beside(m, 2 * e, 2 * e + 1), None, None


def remove_vertex(m, v):
    gone = {h >> 1 for h in m.ring[v]}
    return -1, -len(gone), -beside(m, *m.ring[v], *(h ^ 1 for h in m.ring[v])), None, None


def weld_vertices(m, u, v, *_):
    return -1, 0, 0, 0 if v in m.component(u) else -1, None


def weld(m, a, b, *_):
    return weld_vertices(m, m.origin[a], m.origin[b])


def stitch(m, a, b, *_):
    first, second = {m.origin[a], m.target(b)}, {m.target(a), m.origin[b]}
    merged = len(first) + len(second) - 2 if not first & second else len(first | second) - 1
    return -merged, -1, 0, None, None


def join_loop(m, h, *_):
    n = len(m.loop(h))
    return -n, -n, -2, None, 0


def remove_component(m, v):
    part = m.component(v)
    darts = [h for h in m.origin if m.origin[h] in part]
    loops = sum(m.is_outside(h) and h == min(m.loop(h)) for h in darts)
    return -len(part), -len(darts) // 2, -beside(m, *darts), -1, -loops


def append(m, other):
    return (*other.counts(), other.n_components(), other.boundary_loops())


# -- the table -------------------------------------------------------------------------------------------------------

OPERATORS = [
    Operator("add_vertex", "", "", always, building.add_vertex, fixed(1, 0, 0, 1, 0)),
    Operator("add_vertices", "n", "N", always, building.add_vertices, add_vertices),
    Operator("add_edge", "vv", "vv gg", building.why_not_add_edge, building.add_edge, add_edge),
    Operator(
        "add_edge_in", "vGvG", "gpgp", building.why_not_add_edge_in, building.add_edge_in,
        lambda m, u, a, v, b: add_edge(m, u, v),
    ),
    Operator(
        "make_adjacent", "hh", "ia hh", building.why_not_make_adjacent, building.make_adjacent,
        fixed(0, 0, 0, None, None),
    ),
    Operator("add_face", "H", "L H", building.why_not_add_face, building.add_face, fixed(0, 0, 1, 0, None)),
    Operator(
        "add_face_of_vertices", "V", "V W", building.why_not_add_face_of_vertices, building.add_face_of_vertices,
        fixed(0, None, 1, None, None),
    ),
    Operator(
        "add_triangle", "vvv", "guu vvv", building.why_not_add_polygon, building.add_polygon,
        fixed(0, None, 1, None, None),
    ),
    Operator(
        "add_quad", "vvvv", "guuu ggvv", building.why_not_add_polygon, building.add_polygon,
        fixed(0, None, 1, None, None),
    ),
    Operator("remove_face", "f", "f", always, building.remove_face, fixed(0, 0, -1, 0, None), False),
    Operator("remove_edge", "e", "e", always, building.remove_edge, remove_edge, False),
    Operator("remove_vertex", "v", "v", always, building.remove_vertex, remove_vertex, False),
    Operator("flip", "e?", "e?", edges.why_not_flip, edges.flip, fixed(0, 0, 0, 0, 0)),
    Operator("split_edge", "hw", "hw", lambda m, h, w: set(), edges.split_edge, fixed(1, 1, 0, 0, 0)),
    Operator(
        "split_edge_triangular", "hw?", "hw?", edges.why_not_split_edge_triangular, edges.split_edge_triangular,
        split_edge_triangular,
    ),
    Operator("split_face", "f", "f", always, edges.split_face, split_face),
    Operator("connect", "hh?", "tl? hh?", edges.why_not_connect, edges.connect, fixed(0, 1, 1, 0, 0)),
    Operator("join_faces", "h", "t", edges.why_not_join_faces, edges.join_faces, fixed(0, -1, -1, 0, 0)),
    Operator("collapse", "hw", "hw", edges.why_not_collapse, edges.collapse, collapse, False),
    Operator("split_vertex", "hh", "hr hh", vertices.why_not_split_vertex, vertices.split_vertex, fixed(1, 1, 0, 0, 0)),
    Operator(
        "join_vertices", "hw?", "hw?", vertices.why_not_join_vertices, vertices.join_vertices, join_vertices
    ),
    Operator(
        "dissolve_vertex", "v", "v", vertices.why_not_dissolve_vertex, vertices.dissolve_vertex, dissolve_vertex
    ),
    Operator(
        "dissolve_edge", "h", "t", vertices.why_not_dissolve_edge, vertices.dissolve_edge, fixed(None, None, -1, 0, 0)
    ),
    Operator("make_hole", "f", "f", always, holes.make_hole, fixed(0, 0, -1, 0, None), False),
    Operator("fill_hole", "h", "x", holes.why_not_fill_hole, holes.fill_hole, fixed(0, 0, 1, 0, -1)),
    Operator(
        "add_face_to_boundary", "hh?", "xl? xx?", holes.why_not_add_face_to_boundary, holes.add_face_to_boundary,
        fixed(0, 1, 1, 0, 0),
    ),
    Operator(
        "add_vertex_and_face_to_boundary", "hh", "xl xx", holes.why_not_add_vertex_and_face_to_boundary,
        holes.add_vertex_and_face_to_boundary, fixed(1, 2, 1, 0, 0),
    ),
    Operator("weld", "hh?", "xx? xl?", vertices.why_not_weld, vertices.weld, weld),
    Operator("weld_vertices", "vv?", "vv? gg?", vertices.why_not_weld_vertices, vertices.weld_vertices, weld_vertices),
    Operator("unweld", "hh", "xz xl", vertices.why_not_unweld, vertices.unweld, fixed(1, 0, 0, None, None)),
    Operator("open_edge", "h", "t", seams.why_not_open_edge, seams.open_edge, fixed(0, 1, 0, 0, 1)),
    Operator("close_edge", "h", "x c", seams.why_not_close_edge, seams.close_edge, fixed(0, -1, 0, 0, -1)),
    Operator("cut", "H", "P H", seams.why_not_cut, seams.cut, lambda m, path: (None, len(path), 0, None, None)),
    Operator("stitch", "hh?", "xx? xl? xn?", seams.why_not_stitch, seams.stitch, stitch),
    Operator("zip_hole", "hn", "xk", seams.why_not_zip_hole, seams.zip_hole, fixed(None, None, 0, None, None)),
    Operator(
        "split_loop", "H", "C P", loops.why_not_split_loop, loops.split_loop,
        lambda m, path: (len(path), len(path), 2, None, 0),
    ),
    Operator("join_loop", "hh?", "tt? tj?", loops.why_not_join_loop, loops.join_loop, join_loop, False),
    Operator("reverse_component", "v", "v", always, wholes.reverse_component, fixed(0, 0, 0, 0, 0)),
    Operator("remove_component", "v", "v", always, wholes.remove_component, remove_component, False),
    Operator("append", "m", "m", always, wholes.append, append),
]  # fmt: skip
BY_NAME = {operator.name: operator for operator in OPERATORS}


def _kernels():
    """All that the library offers, by name, so that an operator without a twin is noticed."""
    modules = [
        importlib.import_module(m.name) for m in pkgutil.iter_modules(operators.__path__, operators.__name__ + ".")
    ]
    return {name: kernel for module in modules for name, kernel in vars(module).items() if name.startswith("try_")}


KERNELS = _kernels()
