"""Why faces can't be held: all offending elements, the reason, and what would help.

Construction only notices *that* something is wrong, at full speed. What is wrong is found here, once it matters, by
sorting: O(n log n) whatever the input, all elements of each kind of defect and not just the first.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.core.facelist import FaceList
from halfmesh.core.listing import SHOWN, listed
from halfmesh.errors import InvalidMeshError

__all__ = ["explain", "explain_crowded", "explain_twins"]

Ints = NDArray[np.integer]


def explain(faces: FaceList) -> InvalidMeshError:
    """The error for faces that construction refused."""
    corners, begins = faces.corners, faces.begins()
    degrees = np.diff(begins)
    face_of = np.repeat(np.arange(faces.n_faces), degrees)
    for question in (_out_of_range, _too_small):
        error = question(faces, corners, begins, face_of)
        if error is not None:
            return error
    following = _following(begins)
    error = _repeated(faces, corners, following, face_of)
    if error is not None:
        return error
    origin, target = corners.astype(np.int64), corners[following].astype(np.int64)
    error = _crowded_edges(faces, origin, target, face_of)
    if error is None:
        return _crowded_vertices(faces, origin, target, following)
    return _with_repeats(error, faces, begins)


def _with_repeats(error: InvalidMeshError, faces: FaceList, begins: Ints) -> InvalidMeshError:
    """The same error; if faces are there twice, which is the commonest cause, that is said first."""
    later, earlier = _repeats(faces.corners, begins)
    if not len(later):
        return error
    shown = [f"{f} like {g}" for f, g in zip(later[:SHOWN], earlier, strict=False)] + [""] * (len(later) - SHOWN)
    return InvalidMeshError(
        f"{_plural(len(later), 'face has', 'faces have')} the vertices of an earlier one ({listed(shown)}): "
        f"drop them first, see error.elements['repeats']. Besides: {error}",
        reason=error.reason,
        elements=error.elements | {"repeats": later},
    )


def _repeats(corners: Ints, begins: Ints) -> tuple[Ints, Ints]:
    """Faces with the vertices of an earlier face, in any order; and for each the one before it that has them."""
    mixed = (corners.astype(np.uint64) + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    mixed = (mixed ^ (mixed >> np.uint64(29))) * np.uint64(0xBF58476D1CE4E5B9)
    key = np.add.reduceat(mixed ^ (mixed >> np.uint64(32)), begins[:-1])  # a sum: the same for any order
    in_order = np.sort(key)
    if not (in_order[1:] == in_order[:-1]).any():
        return begins[:0], begins[:0]
    order = np.argsort(key, kind="stable")
    same = np.flatnonzero(key[order][1:] == key[order][:-1])
    by_number = np.argsort(order[same + 1])
    return order[same + 1][by_number], order[same][by_number]


def _following(begins: Ints) -> Ints:
    """The corner after each corner, around its face."""
    following = np.arange(1, begins[-1] + 1)
    full = begins[1:] > begins[:-1]
    following[begins[1:][full] - 1] = begins[:-1][full]
    return following


def _distinct(indices: Ints, n: int) -> Ints:
    """The distinct ones of many indices below n, ascending; np.unique hashes, eight times as slow on equal ones."""
    flags = np.zeros(n, dtype=bool)
    flags[indices] = True
    return np.flatnonzero(flags)


def _plural(n: int, one: str, many: str | None = None) -> str:
    return f"{n} {one if n == 1 else many or one + 's'}"


# ----------------------------------------------------------------------------------------------------- single corners


def _out_of_range(faces: FaceList, corners: Ints, begins: Ints, face_of: Ints) -> InvalidMeshError | None:
    bad = np.flatnonzero((corners < 0) | (corners >= faces.n_vertices))
    if not len(bad):
        return None
    where = [f"face {face_of[c]} (corner {c - begins[face_of[c]]})" for c in bad[:SHOWN]] + [""] * (len(bad) - SHOWN)
    return InvalidMeshError(
        f"{_plural(len(bad), 'index', 'indices')} out of range 0..{faces.n_vertices - 1}: {listed(where)}; "
        "indices count from 0, and every index needs a point",
        reason="index_out_of_range",
        elements={"corners": bad, "faces": _distinct(face_of[bad], faces.n_faces)},
    )


def _too_small(faces: FaceList, corners: Ints, begins: Ints, face_of: Ints) -> InvalidMeshError | None:
    degrees = np.diff(begins)
    bad = np.flatnonzero(degrees < 3)
    if not len(bad):
        return None
    return InvalidMeshError(
        f"{_plural(len(bad), 'face has', 'faces have')} fewer than 3 corners: {listed(bad, 'face ')}; "
        "drop them, or pass the edges among them as edges=",
        reason="small_face",
        elements={"faces": bad},
    )


def _repeated(faces: FaceList, corners: Ints, following: Ints, face_of: Ints) -> InvalidMeshError | None:
    bad = np.flatnonzero(corners == corners[following])
    if not len(bad):
        return None
    where = [f"face {face_of[c]} (vertex {corners[c]})" for c in bad[:SHOWN]] + [""] * (len(bad) - SHOWN)
    return InvalidMeshError(
        f"{_plural(len(bad), 'corner repeats', 'corners repeat')} a vertex in succession: {listed(where)}; "
        "remove the repetition, and the face if fewer than 3 corners are left",
        reason="repeated_vertex",
        elements={
            "corners": bad,
            "faces": _distinct(face_of[bad], faces.n_faces),
            "vertices": _distinct(corners[bad], faces.n_vertices),
        },
    )


# -------------------------------------------------------------------------------------------------------------- edges


def _crowded_edges(faces: FaceList, origin: Ints, target: Ints, face_of: Ints) -> InvalidMeshError | None:
    """Edges with more than two faces; else edges that two faces run along in the same direction."""
    n = max(faces.n_vertices, 1)
    edge = np.minimum(origin, target) * n + np.maximum(origin, target)
    few = _keys_of_crowded(edge)
    if 0 < len(few) <= SHOWN:  # found one by one: in a third of the time that it takes to sort all places
        found = [np.flatnonzero(edge == key) for key in few]
        lengths = np.array([len(places) for places in found])
        return _too_many_faces(few, n, np.concatenate(found), np.cumsum(lengths) - lengths, lengths, face_of)
    order = np.argsort(edge, kind="stable")
    in_order = edge[order]
    starts = np.flatnonzero(np.r_[True, in_order[1:] != in_order[:-1]])
    uses = np.diff(np.r_[starts, len(order)])
    crowded = uses > 2
    if crowded.any():
        return _too_many_faces(in_order[starts[crowded]], n, order, starts[crowded], uses[crowded], face_of)
    first = order[starts[uses == 2]]
    second = order[starts[uses == 2] + 1]
    same = origin[first] == origin[second]
    if not same.any():
        return None
    pairs = np.stack([origin[first[same]], target[first[same]]], axis=1)
    return _disoriented(faces.n_faces, pairs, face_of[first], face_of[second], same)


def _keys_of_crowded(edge: Ints) -> Ints:
    """The edges that are there more than twice, ascending."""
    in_order = np.sort(edge)
    keys: Ints = in_order[2:][in_order[2:] == in_order[:-2]]
    return keys[np.diff(keys, prepend=-1) > 0]


def _too_many_faces(keys: Ints, n: int, order: Ints, starts: Ints, uses: Ints, face_of: Ints) -> InvalidMeshError:
    edges = np.stack([keys // n, keys % n], axis=1)
    of_edge = [face_of[order[s : s + k]] for s, k in zip(starts[:SHOWN], uses[:SHOWN], strict=True)]
    shown = [f"{a}-{b} ({listed(f, 'faces ')})" for (a, b), f in zip(edges[:SHOWN], of_edge, strict=True)]
    all_uses = np.repeat(starts, uses) + _ramp(uses)
    return InvalidMeshError(
        f"{_plural(len(edges), 'edge has', 'edges have')} more than two faces: "
        f"{listed(shown + [''] * (len(edges) - SHOWN))}; "
        "a half-edge mesh holds two faces an edge: remove faces, or give the sheets vertices of their own",
        reason="nonmanifold_edge",
        elements={"edges": edges, "faces": _distinct(face_of[order[all_uses]], int(face_of[-1]) + 1)},
    )


def _ramp(lengths: Ints) -> Ints:
    """0, 1, ..., lengths[0] - 1, 0, 1, ..."""
    ends = np.cumsum(lengths)
    return np.arange(ends[-1]) - np.repeat(ends - lengths, lengths)


def _disoriented(n_faces: int, pairs: Ints, first: Ints, second: Ints, same: Ints) -> InvalidMeshError:
    parent = np.arange(n_faces, dtype=np.int32)
    turned = np.zeros(n_faces, dtype=np.uint8)
    jobs = (first.astype(np.int32), second.astype(np.int32), same.astype(np.uint8))
    conflicts = _orient.at(n_faces)(*jobs, parent, turned)
    shown = [
        f"{a}->{b} (faces {f}, {g})" for (a, b), f, g in zip(pairs[:SHOWN], first[same], second[same], strict=False)
    ]
    text = f"{_plural(len(pairs), 'edge is', 'edges are')} passed twice in the same direction: "
    text += listed(shown + [""] * (len(pairs) - SHOWN))
    elements = {"edges": pairs, "faces": _distinct(np.r_[first[same], second[same]], n_faces)}
    if conflicts:
        return InvalidMeshError(
            f"{text}; no choice of orientations agrees (the surface is one-sided, like a Moebius strip): "
            "cut it along a path, or keep the arrays",
            reason="nonorientable",
            elements=elements,
        )
    elements["reverse"] = _to_reverse(parent, turned)
    return InvalidMeshError(
        f"{text}; the faces are not oriented alike: reversing {_plural(len(elements['reverse']), 'face')} "
        f"({listed(elements['reverse'])}) would do, they are in error.elements['reverse']",
        reason="inconsistent_orientation",
        elements=elements,
    )


@kernel
def _orient(first: Any, second: Any, same: Any, parent: Any, turned: Any) -> int:
    """Union-find with parity: ``turned[f]`` says whether `f` runs against its root. Returns the contradictions."""
    conflicts = 0
    for i in range(len(first)):
        f, tf = _root(parent, turned, first[i])
        g, tg = _root(parent, turned, second[i])
        if f != g:
            parent[g] = f
            turned[g] = tf ^ tg ^ same[i]
        elif tf ^ tg != same[i]:
            conflicts += 1
    for f in range(len(parent)):
        g, t = parent[f], turned[f]
        while parent[g] != g:
            t ^= turned[g]
            g = parent[g]
        parent[f], turned[f] = g, t
    return conflicts


@kernel
def _root(parent: Any, turned: Any, f: int) -> tuple[int, int]:
    """The root of `f`, and whether `f` runs against it; on the way, every second face is hung one higher."""
    against = 0
    while parent[f] != f:
        g = parent[f]
        if parent[g] != g:
            turned[f] ^= turned[g]
            parent[f] = parent[g]
        against ^= turned[f]
        f = parent[f]
    return f, against


def _to_reverse(parent: Ints, turned: Ints) -> Ints:
    """The smaller side of each component."""
    n = np.bincount(parent, minlength=len(parent))
    against = np.bincount(parent, weights=turned, minlength=len(parent))
    return np.flatnonzero((2 * against[parent] > n[parent]) != turned.astype(bool))


# ----------------------------------------------------------------------------------------------------------- vertices


def _crowded_vertices(faces: FaceList, origin: Ints, target: Ints, following: Ints) -> InvalidMeshError:
    """Vertices where a closed fan meets anything else."""
    n = len(origin)
    before = np.empty(n, dtype=np.int64)
    before[following] = np.arange(n)
    key = origin * max(faces.n_vertices, 1) + target
    order = np.argsort(key, kind="stable")
    twin_key = origin * max(faces.n_vertices, 1) + origin[before]  # ccw: the corner that goes on to the vertex before
    place = np.minimum(np.searchsorted(key[order], twin_key), n - 1)
    ccw = np.where(key[order[place]] == twin_key, order[place], -1)
    fan, is_open = _fans(ccw)
    roots = np.flatnonzero(fan == np.arange(n))
    n_fans = np.bincount(origin[roots], minlength=faces.n_vertices)
    n_closed = np.bincount(origin[roots[~is_open[roots]]], minlength=faces.n_vertices)
    bad = np.flatnonzero((n_fans > 1) & (n_closed > 0))
    shown = [f"{v} ({n_fans[v]} fans, {n_closed[v]} closed)" for v in bad[:SHOWN]]
    return _crowded(bad, shown, faces, np.repeat(np.arange(faces.n_faces), np.diff(faces.begins())))


def _crowded(bad: Ints, shown: list[str], faces: FaceList, face_of: Ints) -> InvalidMeshError:
    return InvalidMeshError(
        f"{_plural(len(bad), 'vertex joins', 'vertices join')} a closed fan of faces to something else: "
        f"{listed(shown + [''] * (len(bad) - SHOWN))}; give each fan a vertex of its own",
        reason="nonmanifold_vertex",
        elements={"vertices": bad, "faces": np.unique(face_of[np.isin(faces.corners, bad)])},
    )


def _fans(ccw: Ints) -> tuple[Ints, NDArray[np.bool_]]:
    """Name each fan by its lowest corner, by doubling the steps: O(n log n)."""
    n = len(ccw)
    lowest, ahead = np.arange(n), np.where(ccw < 0, np.arange(n), ccw)
    is_open = ccw < 0
    behind = np.arange(n)
    behind[ccw[ccw >= 0]] = np.flatnonzero(ccw >= 0)
    for _ in range(max(1, int(n).bit_length())):
        lowest = np.minimum(lowest, np.minimum(lowest[ahead], lowest[behind]))
        is_open = is_open | is_open[ahead] | is_open[behind]
        ahead, behind = ahead[ahead], behind[behind]
    return lowest, is_open


# -------------------------------------------------------------------------------------------------------------- twins


def explain_twins(faces: FaceList, twins: Ints) -> InvalidMeshError:
    """The error for a face list whose explicit twins construction refused."""
    corners, begins = faces.corners, faces.begins()
    face_of = np.repeat(np.arange(faces.n_faces), np.diff(begins))
    for question in (_out_of_range, _too_small):
        error = question(faces, corners, begins, face_of)
        if error is not None:
            return error
    n = len(corners)
    wild = (twins < -1) | (twins >= n) | (twins == np.arange(n))
    partner = np.where(wild | (twins < 0), 0, twins)
    apart = (twins >= 0) & ~wild & (twins[partner] != np.arange(n))
    following = _following(begins)
    crossed = (twins >= 0) & ~wild & ~apart
    crossed &= (corners[partner] != corners[following]) | (corners[following[partner]] != corners)
    for bad, what in (
        (wild, "no corner, or the corner itself"),
        (apart, "a corner whose twin is another one"),
        (crossed, "a corner whose halfedge runs between other vertices"),
    ):
        if bad.any():
            at = np.flatnonzero(bad)
            return InvalidMeshError(
                f"twins: {_plural(len(at), 'corner names', 'corners name')} as twin {what}: {listed(at, 'corner ')}; "
                "twins[c] is the corner whose halfedge runs along the same edge the other way, -1 at a boundary",
                reason="bad_twins",
                elements={"corners": at, "faces": _distinct(face_of[at], faces.n_faces)},
            )
    raise AssertionError("construction refused twins that have no defect")


def explain_crowded(faces: FaceList, vertices: Ints) -> InvalidMeshError:
    """The error for explicit twins that leave a closed fan and something else at these vertices."""
    face_of = np.repeat(np.arange(faces.n_faces), np.diff(faces.begins()))
    return _crowded(vertices, [str(v) for v in vertices[:SHOWN]], faces, face_of)
