"""Adding many faces at once, all or none.

==================================  ==========================================  ===================================
the mesh                            they are                                    undone, if one can't be
==================================  ==========================================  ===================================
has no edges yet                    built as a mesh is                          nothing was begun
has some, where sewing pays         sewn on, see `sewing`                       nothing was begun
has some, not many more than come   added one by one                            from a copy made before
has many                            added one by one, journaled                 from the journal
==================================  ==========================================  ===================================
"""

from __future__ import annotations

import numpy as np

from halfmesh._jit import n_threads
from halfmesh.core.construction import construct
from halfmesh.core.facelist import FaceList
from halfmesh.core.matching import is_scattered
from halfmesh.core.operators.faces import add_faces_or_none, add_faces_while_possible
from halfmesh.core.sewing import sewn
from halfmesh.core.statuses import DELETED_ELEMENT, OK
from halfmesh.core.topology import (
    COLUMNS,
    DELETED,
    EDGE_SLOTS,
    FACE_SLOTS,
    JOURNALING,
    NEWS,
    VERTEX_SLOTS,
    Topology,
)

__all__ = ["Refused", "add_faces"]

_HALFEDGES_COPIED = 30  # in the time that journaling a face takes: 170 ns
_FEWEST_SEWN = 400_000  # on one thread, which takes 1.1 to 1.2 times as long as one by one at 300,000, 0.9 at 655,360
_MOST_THREADS = 2  # for which it was measured that half as many will do: 0.7 times as long at 200,000
_VERTICES_A_FACE = 2  # at most: sewing passes over the vertices of the whole mesh
_SAMPLE = 1000
_STEPS = 12  # of a loop: what adding a face costs when it is interpreted


class Refused(Exception):  # noqa: N818 - never leaves the package, like Defective
    """One of the faces can't be added: the first such row of the list, and the code that says why."""

    def __init__(self, row: int, code: int) -> None:
        self.row, self.code = row, code
        super().__init__(row, code)


def add_faces(t: Topology, faces: FaceList) -> None:
    """Add these faces over the vertices that are there, or none of them.

    Raises
    ------
    Defective
        They can't be held, by themselves.
    Refused
        One of them does not fit to what is there.
    """
    counts = t.__arrays__().counts
    if not counts[EDGE_SLOTS] and not counts[FACE_SLOTS] and not counts[JOURNALING]:
        _build(t, faces)
        return
    if not counts[JOURNALING] and _sewing_pays(t, faces) and sewn(t, faces):
        return
    given = (faces.corners, faces.degree, faces.offsets, faces.n_faces)
    if counts[JOURNALING] or len(t.next) > _HALFEDGES_COPIED * faces.n_faces:
        row, code = add_faces_or_none.at(_STEPS * faces.n_faces)(t, *given)
    else:
        before = t.copy()
        row, code = add_faces_while_possible.at(_STEPS * faces.n_faces)(t, *given)
        if code != OK:
            _restore(t, before)
    if code != OK:
        raise Refused(row, code)


def _sewing_pays(t: Topology, faces: FaceList) -> bool:
    """Whether these faces are probably sewn on sooner than added one by one. It decides about time only.

    Scattered faces miss the cache at each step when they are added one by one, and not when they are sewn. Others are
    sewn in the time of building as long as most of their vertices are new.
    """
    if faces.n_faces * min(n_threads(), _MOST_THREADS) < _FEWEST_SEWN:
        return False
    if t.__arrays__().counts[VERTEX_SLOTS] > _VERTICES_A_FACE * faces.n_faces:
        return False
    return is_scattered(faces) or _meet_along_a_seam(t, faces)


def _meet_along_a_seam(t: Topology, faces: FaceList) -> bool:
    """Whether fewer than half of the corners, by a sample, lie at vertices that have edges already.

    Sewing walks around each of those. Where all of them do, it took 0.7 to 1 times as long as one by one on two
    threads, but 1.6 times on one, which is what is left of two on a busy machine.
    """
    sample = faces.corners[:: faces.n_corners // _SAMPLE + 1]
    there = np.take(t.__arrays__().vertex_halfedge, sample, mode="clip") >= 0  # nobody has checked their range yet
    return bool(2 * np.count_nonzero(there) < len(sample))


def _build(t: Topology, faces: FaceList) -> None:
    deleted = t.vertex_halfedge == DELETED
    built = construct(faces).__arrays__()
    if deleted.any():
        bad = np.flatnonzero(deleted[faces.corners])
        if len(bad):
            raise Refused(int(np.searchsorted(faces.begins(), bad[0], side="right")) - 1, DELETED_ELEMENT)
        built.vertex_halfedge[: len(deleted)][deleted] = DELETED
    t.take_edges_and_faces(built)


def _restore(t: Topology, before: Topology) -> None:
    """Put the columns back, which may have been replaced by larger ones since, and the counts."""
    now, then = t.__arrays__(), before.__arrays__()
    now.counts[:NEWS] = then.counts[:NEWS]
    for name in COLUMNS[:-1]:
        column = getattr(before, name)
        getattr(now, name)[: len(column)] = column
