"""Triangulation of faces: cut them into triangles by diagonals, without a new vertex.

A face may be any polygon: not convex, with corners on a straight line, with a slit, or around a hole to which a
bridge leads. It is laid on paper along its normal, ears are cut off, and the diagonals are flipped until no triangle
is more of a sliver than the corners ask for. Quadrilaterals, the most common, have a short way of their own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from halfmesh._jit import apart, kernel
from halfmesh.algorithms._diagonals import draw, plan
from halfmesh.algorithms._plane import N_FLOAT_ROWS, N_ROWS
from halfmesh.algorithms._quads import corner_to_cut_at
from halfmesh.core.navigation import face_of, halfedge_of_face, next_of, prev_of
from halfmesh.core.operators.asking import sides_of
from halfmesh.core.operators.splits import connect
from halfmesh.core.pens import link, set_face
from halfmesh.core.slots import is_full, reserve
from halfmesh.core.statuses import OK, REASONS, TOO_LARGE
from halfmesh.core.topology import EDGE_SLOTS, FACE_SLOTS, N_EXTERIOR, NOTES_SIZE, REVISION
from halfmesh.errors import TopologyError
from halfmesh.geometry._passes import points_of
from halfmesh.mesh.elements import Face

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike, NDArray

    from halfmesh.mesh.mesh import Mesh

__all__ = ["triangulate", "triangulate_face", "triangulate_face_status", "triangulated"]


def triangulate(
    mesh: Mesh,
    faces: Face | int | Iterable[Face | int] | ArrayLike | None = None,
    *,
    quality: Literal["delaunay", "any"] = "delaunay",
    allow_parallel: bool = False,
) -> NDArray[np.int32]:
    """Cut faces into triangles by diagonals, in place. No vertex is added.

    Parameters
    ----------
    mesh : Mesh
    faces : Face, int, or several of them, optional
        Which faces; all of the mesh if not given.
    quality : {"delaunay", "any"}
        Which of the many triangulations of a face: the constrained Delaunay triangulation, which of all has the
        largest smallest angle; or the first that turns up, which may have needless slivers and is a little faster.
    allow_parallel : bool
        Also where a face can't be cut without an edge between two vertices that are joined already, or a loop.

    Returns
    -------
    ndarray of int32, shape (n face slots,)
        The face that each face is a part of; those that were there are parts of themselves. -1 for deleted ones.

    Raises
    ------
    TopologyError
        A face can't be cut without a parallel edge or a loop edge, see `allow_parallel`.
    StaleElementError, ElementError
        A face was deleted, or there is none.
    ValueError
        There is no such `quality`.

    See Also
    --------
    triangulated : the same as a new mesh.
    halfmesh.triangulate_face : the same for one face, in your own kernels.

    Notes
    -----
    Each face of k corners gives E + k - 3, F + k - 3; components and boundary loops stay, and so does every index.
    The face itself becomes the triangle at its first side. Faces of three sides or fewer are left as they are.
    Attributes follow: data of a corner go to all corners that it becomes, data of a face to all its parts.

    A face that is flat, in any plane, and doesn't cross itself is covered exactly, by triangles that all have the
    orientation of the face; it may touch itself, in corners and along sides. That is decided without rounding errors,
    in any plane. The Delaunay triangulation has triangles without area only where the corners leave no other choice:
    where two are at the same place, or touch a side. Faces that aren't flat are projected along their normal (of the
    area vector); if the projection crosses itself, as few triangles as possible are turned over, up to 64 corners.

    Two diagonals of one quadrilateral are equally good in a rectangle: there it is the first corner's. If the good
    diagonals of a face would be parallel to another edge, the next best are taken, and again those that cover the
    face; up to 64 corners they are found if there are any.

    O(k) for a convex face, about O(k log k) for others, O(k^2) at worst.

    References
    ----------
    G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82 (1975).
    M. Held, "FIST: fast industrial-strength triangulation of polygons", Algorithmica 30 (2001).
    C. L. Lawson, "Software for C1 surface interpolation", Mathematical Software III (1977).
    J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete &
    Computational Geometry 18 (1997).

    Examples
    --------
    >>> import halfmesh as hm
    >>> arrow = hm.Mesh([[0, 1, 2, 3]], [[0, 0], [2, 1], [0, 2], [1, 1]])
    >>> hm.triangulate(arrow)
    array([0, 0], dtype=int32)
    >>> arrow.triangles().tolist()
    [[0, 1, 3], [3, 1, 2]]
    """
    if quality not in ("delaunay", "any"):
        raise ValueError(f"quality must be 'delaunay' or 'any', not {quality!r}")
    t = mesh.topology
    degrees = mesh.face_degrees()
    chosen = np.flatnonzero(degrees > 3) if faces is None else _resolved(mesh, faces)
    chosen = chosen[degrees[chosen] > 3]
    n_new = int((degrees[chosen] - 3).sum())
    if is_full.plain(t.__views__(), 0, n_new, n_new):
        raise TopologyError(f"can't triangulate: {REASONS[TOO_LARGE].sentence}", reason=REASONS[TOO_LARGE].name)
    n_old = len(degrees)
    parts = np.arange(n_old + n_new, dtype=np.int32)
    parts[:n_old][t.face_halfedge < 0] = -1
    if n_new:
        _act(mesh, chosen, int(degrees[chosen].max()), parts[n_old:], quality == "delaunay", bool(allow_parallel))
    return parts


def triangulated(
    mesh: Mesh,
    faces: Face | int | Iterable[Face | int] | ArrayLike | None = None,
    *,
    quality: Literal["delaunay", "any"] = "delaunay",
    allow_parallel: bool = False,
) -> Mesh:
    """A copy of the mesh with its faces cut into triangles: see :func:`triangulate`.

    Parameters
    ----------
    mesh : Mesh
    faces : Face, int, or several of them, optional
        Which faces; all of the mesh if not given.
    quality : {"delaunay", "any"}
        Which triangulation of each face.
    allow_parallel : bool
        Also where that takes parallel edges or loops.

    Returns
    -------
    Mesh
        With all attributes. The indices of the mesh hold in it too.

    Raises
    ------
    TopologyError, StaleElementError, ElementError, ValueError
        As :func:`triangulate`.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.triangulated(hm.shapes.cube())
    <Mesh: 8 vertices, 18 edges, 12 faces, closed>
    """
    made = mesh.copy()
    own = None if faces is None else _resolved(mesh, faces)
    triangulate(made, own, quality=quality, allow_parallel=allow_parallel)
    return made


def _resolved(mesh: Mesh, faces: Any) -> NDArray[np.int64]:
    """The indices of living faces, ascending, each once."""
    resolve = mesh.faces.resolve
    if isinstance(faces, np.ndarray) and faces.dtype.kind in "iu":
        indices = np.unique(faces)
        marks = mesh.topology.face_halfedge
        if len(indices) and not (indices[0] >= 0 and indices[-1] < len(marks) and (marks[indices] >= 0).all()):
            indices = np.array([resolve(f) for f in indices])  # it raises
        return indices.astype(np.int64)
    if isinstance(faces, Face) or not np.iterable(faces):
        faces = [faces]
    return np.unique(np.array([resolve(f) for f in faces], dtype=np.int64))


def _act(mesh: Mesh, chosen: Any, largest: int, parents: Any, delaunay: bool, parallel: bool) -> None:
    """Cut the chosen faces, or raise and leave the mesh as it was."""
    points, n = points_of(mesh), len(chosen) + len(parents)
    if largest == 4 and _cut_quads.at(n)(mesh, points, chosen, parents, delaunay):
        return  # nothing else had to be compiled
    w, p = np.empty((N_ROWS, largest), np.int64), np.empty((N_FLOAT_ROWS, largest))
    code, f = _cut_all.at(n)(mesh, points, chosen, parents, w, p, delaunay, parallel)
    if code < 0:
        name, sentence = REASONS[-code]
        raise TopologyError(f"can't triangulate face {f}: {sentence}", reason=name)


# -- many faces ----------------------------------------------------------------------------------------------------


@kernel
def _cut_quads(t: Any, points: Any, faces: Any, parents: Any, delaunay: bool) -> bool:
    """Cut faces of four sides, if that is plain for all of them; else nothing is changed."""
    before = _state(t)
    reserve(t, 0, len(parents), len(parents))
    for i in range(len(faces)):
        if not _cut_quad(t, points, halfedge_of_face(t, faces[i]), delaunay):
            _undo(t, before)
            return False
        parents[i] = faces[i]
    return True


@kernel
def _cut_all(
    t: Any, points: Any, faces: Any, parents: Any, w: Any, p: Any, delaunay: bool, parallel: bool
) -> tuple[int, int]:
    """Cut faces of any number of sides: the sum of the new ones, or a negative code, the face, and no change."""
    before, n = _state(t), 0
    reserve(t, 0, len(parents), len(parents))
    for i in range(len(faces)):
        f = faces[i]
        sides = sides_of(t, halfedge_of_face(t, f))
        if sides > 4 or not _cut_quad(t, points, halfedge_of_face(t, f), delaunay):
            status = plan(t, points, f, w, p, delaunay, parallel)
            if status != OK:
                _undo(t, before)
                return -status, f
            draw(t, w, sides)
        for k in range(n, n + sides - 3):
            parents[k] = f
        n += sides - 3
    return n, -1


State = tuple[int, int, int, int, int]


@kernel
def _state(t: Any) -> State:
    counts = t.counts
    return counts[EDGE_SLOTS], counts[FACE_SLOTS], counts[N_EXTERIOR], counts[REVISION], counts[NOTES_SIZE]


@kernel
def _undo(t: Any, before: State) -> None:
    """Take out all edges since then, the last one first: each joins what it had parted, as `connect` had found it."""
    apart()
    for x in range(2 * t.counts[EDGE_SLOTS] - 2, 2 * before[0] - 2, -2):
        y = next_of(t, x)
        while y != x:
            set_face(t, y, face_of(t, x ^ 1))
            y = next_of(t, y)
        p, q = prev_of(t, x), prev_of(t, x ^ 1)
        h, g = next_of(t, x ^ 1), next_of(t, x)
        link(t, p, h)
        link(t, q, g)
    t.counts[EDGE_SLOTS], t.counts[FACE_SLOTS], t.counts[N_EXTERIOR] = before[0], before[1], before[2]
    t.counts[REVISION], t.counts[NOTES_SIZE] = before[3], before[4]


# -- one face ------------------------------------------------------------------------------------------------------


@kernel
def triangulate_face(t: Any, points: Any, f: int, allow_parallel: bool = False) -> int:
    """Cut face `f` into triangles by diagonals; returns how many, or a negative code, and nothing was changed.

    `points` is an (n, 3) array of float64 or the column of them. The triangles are those of :func:`triangulate`: `f`
    keeps its first side, the others are the last faces. It is refused where a parallel edge or a loop would be needed
    (``-WOULD_BE_PARALLEL``, ``-WOULD_BE_LOOP``), unless that is allowed. Cost: some O(k log k) for k sides.
    """
    n = sides_of(t, halfedge_of_face(t, f))
    if n <= 3:
        return 0
    if is_full(t, 0, n - 3, n - 3):
        return -TOO_LARGE
    if n == 4 and _cut_quad(t, points, halfedge_of_face(t, f), True):
        return 1
    w, p = np.empty((N_ROWS, n), np.int64), np.empty((N_FLOAT_ROWS, n))
    status = plan(t, points, f, w, p, True, allow_parallel)
    if status != OK:
        return -status
    draw(t, w, n)
    return n - 3


@kernel
def triangulate_face_status(t: Any, points: Any, f: int) -> int:
    """Whether face `f` may be cut into triangles without a parallel or loop edge: ``OK`` or a code. Costs as much."""
    n = sides_of(t, halfedge_of_face(t, f))
    if n <= 3:
        return OK
    w, p = np.empty((N_ROWS, n), np.int64), np.empty((N_FLOAT_ROWS, n))
    return plan(t, points, f, w, p, False, False)


@kernel
def _cut_quad(t: Any, points: Any, h: int, delaunay: bool) -> bool:
    """Cut a face of four sides, of which `h` is the first and stays in it; whether that was plain."""
    apart()
    corner = corner_to_cut_at(t, points, h, delaunay)
    if corner == 0:
        connect(t, h, next_of(t, next_of(t, h)))
    elif corner == 1:
        connect(t, prev_of(t, h), next_of(t, h))
    return corner >= 0
