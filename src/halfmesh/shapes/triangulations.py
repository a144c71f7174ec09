"""Triangulations of points in the plane: Delaunay's, with segments and holes where they are wanted."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from halfmesh._jit import kernel
from halfmesh.core.circulation import face_halfedges
from halfmesh.core.facelist import as_indices
from halfmesh.core.navigation import (
    edge_of,
    face_of,
    face_slots,
    halfedge_of_face,
    halfedge_slots,
    is_exterior,
    next_of,
    opposite_face_of,
    origin_of,
    twin_of,
)
from halfmesh.errors import InvalidMeshError
from halfmesh.mesh.mesh import Mesh
from halfmesh.mesh.positions import as_points
from halfmesh.shapes._engine import Triangles, triangles_of
from halfmesh.shapes._parameters import whole

__all__ = ["delaunay", "random_triangulation"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


def delaunay(points: ArrayLike, *, segments: ArrayLike | None = None, holes: ArrayLike | None = None) -> Mesh:
    """Triangulate points in the plane: no point lies inside the circle through the corners of a triangle.

    Needs the library CDT: ``pip install halfmesh[delaunay]``.

    Parameters
    ----------
    points : (n, 2) or (n, 3) array_like of float
        A third coordinate is carried along, and not looked at.
    segments : (m, 2) array_like of int, optional
        Pairs of points that shall be joined. The triangulation is Delaunay's as far as they allow (constrained), and
        only what they enclose is kept: without segments it is the convex hull of the points.
    holes : (k, 2) array_like of float, optional
        A point in each hole: the triangles around it are left out, as far as the next segments.

    Returns
    -------
    Mesh
        Triangles, counter-clockwise; vertex `i` is ``points[i]``. Isolated vertices (``n_isolated_vertices`` counts
        them) are points that are equal to an earlier one, which is used in their place, and points in holes or
        outside. With segments, ``edge_data["segment"]`` is the segment along each edge, -1 where there is none;
        a segment that passes through points is several edges.

    Raises
    ------
    ImportError
        The library is not installed.
    InvalidMeshError
        A coordinate is not finite; all points lie on a line (``reason == "collinear"``); an index is out of range, a
        segment has no length, two segments cross (``"crossing_segments"``); the segments enclose nothing.

    Notes
    -----
    No Steiner points are added, and no predicate is rounded (Shewchuk's adaptive ones), so points on a grid or a circle
    are as good as random ones. O(n log n): a million points take about two seconds, half a minute for ten million.
    The library is CDT by A. Amirkhanov (https://github.com/artem-ogre/CDT, MPL-2.0).

    References
    ----------
    B. Delaunay, "Sur la sphère vide", Bulletin de l'Académie des Sciences de l'URSS, 1934. M. V. Anglada, "An
    improved incremental algorithm for constructing restricted Delaunay triangulations", Computers & Graphics 21, 1997.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.delaunay([[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]])
    <Mesh: 5 vertices, 8 edges, 4 faces, with boundary>

    A square frame around a square hole:

    >>> corners = [[0, 0], [3, 0], [3, 3], [0, 3], [1, 1], [2, 1], [2, 2], [1, 2]]
    >>> sides = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
    >>> frame = hm.delaunay(corners, segments=sides, holes=[[1.5, 1.5]])
    >>> frame.n_faces, frame.n_boundary_loops, hm.geometry.area(frame)
    (8, 2, 8.0)
    """
    positions = as_points(points)
    xy = np.ascontiguousarray(positions[:, :2])
    _check_finite(xy, "points")
    wanted = _as_segments(segments, len(xy))
    made = triangles_of(xy, wanted)
    if not len(made.faces):
        raise InvalidMeshError(
            f"the {len(xy)} points lie on a line; a triangle needs three that don't", reason="collinear"
        )
    mesh = Mesh(made.faces, positions)
    seeds = _as_hole_points(holes)
    if not len(wanted) and not len(seeds):
        return mesh
    return _trimmed(mesh, made, seeds, open_hull=len(wanted) > 0)


def random_triangulation(n: int = 1000, *, seed: int = 0) -> Mesh:
    """The Delaunay triangulation of random points in the unit square.

    Parameters
    ----------
    n : int
        Number of points, at least 3. About 2 n triangles.
    seed : int
        Of NumPy's generator: the same seed, the same mesh.

    Raises
    ------
    ImportError, ValueError
        As :func:`delaunay`; `n` is too small.

    See Also
    --------
    grid : ``grid(k, triangles=True)`` is its regular counterpart.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.random_triangulation(1000).n_isolated_vertices
    0
    """
    return delaunay(np.random.default_rng(seed).random((whole("n", n, 3), 2)))


def _check_finite(xy: Floats, what: str) -> None:
    bad = np.flatnonzero(~np.isfinite(xy).all(axis=1))
    if len(bad):
        raise InvalidMeshError(
            f"{what} must be finite; row {bad[0]} is {xy[bad[0]].tolist()}",
            reason="not_finite",
            elements={"vertices": bad},
        )


def _as_segments(segments: ArrayLike | None, n: int) -> Ints:
    if segments is None:
        return np.zeros((0, 2), dtype=np.int32)
    pairs = as_indices(segments, "segments", 2)
    foreign = ((pairs < 0) | (pairs >= n)).any(axis=1)
    for bad, what, reason in (
        (foreign, f"refer to points outside 0..{n - 1}", "index_out_of_range"),
        (pairs[:, 0] == pairs[:, 1], "join a point to itself", "loop_edge"),
    ):
        if bad.any():
            raise InvalidMeshError(
                f"segments {what}: {pairs[bad][:3].tolist()}", reason=reason, elements={"edges": pairs[bad]}
            )
    return pairs


def _as_hole_points(holes: ArrayLike | None) -> Floats:
    if holes is None:
        return np.zeros((0, 2))
    xy = np.ascontiguousarray(as_points(holes)[:, :2])
    _check_finite(xy, "holes")
    return xy


def _trimmed(mesh: Mesh, made: Triangles, holes: Floats, open_hull: bool) -> Mesh:
    """The mesh without what lies outside the segments or in holes, its edges marked."""
    t = mesh.topology
    of_edge = _segment_of_edge(mesh, made)
    left_out = np.zeros(mesh.n_faces, dtype=np.uint8)
    run: Any = leave_out.at(mesh.n_faces * (1 + len(holes)))
    n_left = run(t, mesh.points, of_edge, holes, open_hull, left_out, np.empty(mesh.n_faces + 1, dtype=np.int32))
    if n_left == 0:
        raise InvalidMeshError(
            "nothing is left: the segments form no closed loop, or all that they enclose is a hole",
            reason="not_enclosed",
        )
    if n_left < mesh.n_faces:
        mesh = Mesh(made.faces[left_out == 0], mesh.points)
        of_edge = _segment_of_edge(mesh, made)
    mesh.edge_data["segment"] = of_edge
    return mesh


def _segment_of_edge(mesh: Mesh, made: Triangles) -> Ints:
    """The segment along each edge, -1 for none."""
    n = mesh.n_vertices
    ends, pieces = (np.sort(x.astype(np.int64), axis=1) for x in (mesh.edge_vertices(), made.pieces))
    keys = pieces[:, 0] * n + pieces[:, 1]
    order = np.argsort(keys)
    wanted = ends[:, 0] * n + ends[:, 1]
    place = np.searchsorted(keys[order], wanted)
    found = np.full(len(ends), -1, dtype=np.int32)
    inside = place < len(keys)
    row = order[place[inside]]
    found[inside] = np.where(keys[row] == wanted[inside], made.segment[row], -1)
    return found


@kernel
def leave_out(t: Any, points: Any, segment: Any, holes: Any, open_hull: bool, left_out: Any, stack: Any) -> int:
    """Mark the faces that holes and the outside reach without crossing a segment; how many are left."""
    n = face_slots(t)
    top = 0
    if open_hull:
        for h in range(halfedge_slots(t)):
            f = face_of(t, twin_of(t, h))
            if is_exterior(t, h) and segment[edge_of(t, h)] < 0 and not left_out[f]:
                left_out[f] = 1
                stack[top] = f
                top += 1
    for i in range(len(holes)):
        f = face_at(t, points, holes[i, 0], holes[i, 1])
        if f >= 0 and not left_out[f]:
            left_out[f] = 1
            stack[top] = f
            top += 1
    n_left = n
    while top > 0:
        top -= 1
        n_left -= 1
        for h in face_halfedges(t, stack[top]):
            f = opposite_face_of(t, h)
            if f >= 0 and segment[edge_of(t, h)] < 0 and not left_out[f]:
                left_out[f] = 1
                stack[top] = f
                top += 1
    return n_left  # type: ignore[no-any-return]


@kernel
def face_at(t: Any, points: Any, x: float, y: float) -> int:
    """The first triangle that has the place (x, y) inside or on its boundary, -1 for none. O(n)."""
    for f in range(face_slots(t)):
        h = halfedge_of_face(t, f)
        inside = True
        for _ in range(3):
            after = next_of(t, h)
            a, b = origin_of(t, h), origin_of(t, after)
            left = (points[b, 0] - points[a, 0]) * (y - points[a, 1])
            inside = inside and left >= (points[b, 1] - points[a, 1]) * (x - points[a, 0])
            h = after
        if inside:
            return f
    return -1
