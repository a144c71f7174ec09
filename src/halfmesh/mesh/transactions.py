"""Transactions: all of what is done in a block, or nothing of it.

The pens of the topology write a journal (`core.pens`), the attribute tables keep the rows that are about to change
(`mesh.keeping`), the counts are copied, and compaction leaves the old columns standing. So beginning costs nothing to
speak of, and going back costs what was changed. Outside of a transaction the pens and the tables look at one flag each.
"""

from __future__ import annotations

from copy import deepcopy
from typing import TYPE_CHECKING, Any

from halfmesh.core import compaction
from halfmesh.core.pens import rewind
from halfmesh.core.topology import (
    EDGE_SLOTS,
    FACE_SLOTS,
    JOURNAL_SIZE,
    JOURNALING,
    N_DEAD_FACES,
    N_DEAD_VERTICES,
    NEWS,
    NOTES_SIZE,
    REVISION,
    VERTEX_SLOTS,
)
from halfmesh.mesh.editing.base import Base
from halfmesh.mesh.ids import Ids, Numbers
from halfmesh.mesh.keeping import Keeper

if TYPE_CHECKING:
    from types import TracebackType

    from halfmesh.mesh.attributes import AttributeTable
    from halfmesh.mesh.mesh import Mesh

__all__ = ["Transaction", "Undoable"]

_OF_TABLES = ((VERTEX_SLOTS, 1), (EDGE_SLOTS, 2), (EDGE_SLOTS, 1), (FACE_SLOTS, 1))  # rows of each: slots, times


class _Compacted:
    """What a compaction replaced: the columns, the carrier of the handles, the counts and the ids of before."""

    def __init__(self, mesh: Undoable) -> None:
        topology = mesh._topology
        self.arrays, self.views = topology.__arrays__(), topology.__views__()
        self.counts = self.arrays.counts.copy()
        self.ids = mesh._numbering().state(tuple(self.counts[:3]))


class _Savepoint:
    """A state of a mesh to which one can go back. It does not hold the mesh, which holds it."""

    def __init__(self, mesh: Undoable, include_held: bool) -> None:
        mesh._topology.catch_up_late()
        if mesh._desk is not None:
            mesh._desk.close()
        counts = mesh._topology.__arrays__().counts
        tables = mesh._tables()
        keepers = [table._keeper_from_now(1 << place, include_held) for place, table in enumerate(tables)]
        for table, keeper in zip(tables, keepers, strict=True):
            table._keeper = keeper
        self.counts = counts.copy()
        self.keepers: list[Keeper] = keepers
        self.has_points = mesh.has_points
        self.meta: tuple[dict[str, Any], dict[str, Any]] | None = None  # it, and what was in it, once it was handed out
        self.compacted: _Compacted | None = None  # the first compaction since
        counts[JOURNALING] = 1

    def keep_meta(self, meta: dict[str, Any]) -> None:
        if self.meta is None:
            self.meta = (meta, deepcopy(meta))

    def end(self, mesh: Undoable) -> None:
        """Let what was done stay: it is up to the transaction around this one, if there is one."""
        for table in mesh._tables():
            table._end_keeping()
        if mesh._savepoints:
            outer = mesh._savepoints[-1]
            outer.meta = outer.meta or self.meta
            outer.compacted = outer.compacted or self.compacted
        else:
            mesh._topology.end_journal()

    def go_back(self, mesh: Undoable) -> None:
        """Take everything back."""
        topology = mesh._topology
        topology.catch_up_late()
        counts = topology.__arrays__().counts
        now, old = counts.copy(), self.counts
        then = now if self.compacted is None else self.compacted.counts  # when these columns were in use last
        self._go_back_in_columns(mesh, then)
        counts[:REVISION] = old[:REVISION]
        is_changed = (now[:NEWS] != old[:NEWS]).any() or then[JOURNAL_SIZE] > old[JOURNAL_SIZE]
        counts[REVISION] = now[REVISION] + is_changed  # never an earlier one: what was computed since was kept by it
        counts[JOURNALING] = old[JOURNALING]
        for table, (place, times) in zip(mesh._tables(), _OF_TABLES, strict=True):
            table._put_back(times * int(then[place]))
        mesh.has_points = self.has_points
        if self.meta is not None:
            mesh._meta, kept = self.meta
            mesh._meta.clear()
            mesh._meta.update(kept)
        if mesh._numbers is not None:
            mesh._numbers.put_back(None if self.compacted is None else self.compacted.ids, tuple(old[:3]))

    def _go_back_in_columns(self, mesh: Undoable, then: Any) -> None:
        topology, mark, limits = mesh._topology, int(self.counts[JOURNAL_SIZE]), self.counts[: FACE_SLOTS + 1]
        counts = topology.__arrays__().counts
        counts[:] = then
        counts[[NEWS, NOTES_SIZE]] = 0
        before = self.compacted
        if before is not None:
            topology.put_back(before.arrays, before.views, tuple(limits.tolist()))
        elif (then[: FACE_SLOTS + 1] > limits).any():
            topology.put_back(topology.__arrays__(), topology.__views__(), tuple(limits.tolist()))
        size = int(then[JOURNAL_SIZE]) - mark
        if size:
            rewind.at(size)(topology, mark)
        if mesh._t is not topology.__views__():
            mesh._look_again()

    def nbytes(self, mesh: Undoable) -> int:
        """What it takes to go back: 16 bytes for each write of the journal, and what is kept beside it."""
        then = mesh._topology.__arrays__().counts if self.compacted is None else self.compacted.counts
        columns = 0 if self.compacted is None else self.compacted.arrays.nbytes
        return 16 * int(then[JOURNAL_SIZE] - self.counts[JOURNAL_SIZE]) + columns + sum(k.nbytes for k in self.keepers)


class Transaction:
    """A block of which everything is done, or nothing: see :meth:`halfmesh.Mesh.transaction`."""

    def __init__(self, mesh: Mesh, include_held: bool) -> None:
        self._mesh = mesh
        self._include_held = include_held
        self._savepoint: _Savepoint | None = None

    @property
    def is_open(self) -> bool:
        """Whether it was begun and has not ended."""
        return self._savepoint is not None and self._savepoint in self._mesh._savepoints

    @property
    def nbytes(self) -> int:
        """Bytes that are kept so far for going back; what inner transactions keep is counted when they end."""
        return self._opened().nbytes(self._mesh)

    def rollback(self) -> None:
        """Take back what was done since the beginning; the block goes on, and so does the transaction.

        Transactions inside of this one that are open still are over.

        Raises
        ------
        RuntimeError
            The transaction is not open.
        """
        self._go_back()
        self._begin()

    def __enter__(self) -> Transaction:
        if self.is_open:
            raise RuntimeError("the transaction is open already; mesh.transaction() makes another one inside of it")
        self._begin()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if not self.is_open:  # a transaction around it has ended first
            return
        if kind is not None:
            self._go_back()
        else:
            self._end_inner()
            self._mesh._savepoints.pop().end(self._mesh)

    def _begin(self) -> None:
        self._savepoint = _Savepoint(self._mesh, self._include_held)
        self._mesh._savepoints.append(self._savepoint)

    def _go_back(self) -> None:
        self._end_inner()
        self._mesh._savepoints.pop().go_back(self._mesh)

    def _end_inner(self) -> None:
        """Transactions inside of this one leave to it what they have kept."""
        mine, open_ones = self._opened(), self._mesh._savepoints
        while open_ones[-1] is not mine:
            open_ones.pop().end(self._mesh)

    def _opened(self) -> _Savepoint:
        if self._savepoint is None or not self.is_open:
            raise RuntimeError("the transaction is not open: it begins with the block of `with`, and ends with it")
        return self._savepoint

    def __repr__(self) -> str:
        return f"<transaction of {self._mesh!r}, {'open' if self.is_open else 'not open'}>"


class Undoable(Base):
    """The part of a mesh that can go back, and give other indices to its elements."""

    has_points: bool
    _savepoints: list[_Savepoint]
    _numbers: Numbers | None
    _meta: dict[str, Any]

    def transaction(self, *, include_held: bool = True) -> Transaction:
        """All of what is done in a block, or nothing of it.

        Parameters
        ----------
        include_held : bool
            Whether to watch the attributes of which you hold an array, a row such as ``v.point``, or a column when the
            block begins. Each is copied then, since who writes into an array is not seen. False saves these copies,
            and what is written into such arrays stays.

        Returns
        -------
        Transaction
            For ``with``. Its ``rollback()`` goes back to the beginning and lets the block go on; ``nbytes`` says what
            is kept.

        Notes
        -----
        When an exception leaves the block, connectivity, attributes, points, ``has_points`` and ``meta`` are as they
        were, bit for bit, whatever was done by methods, in kernels, or through arrays; ``revision`` goes on. Handles
        of elements that are there again are good as before, those of elements that are not raise StaleElementError.

        The cost, of going on and of going back, is proportional to the change. Two things cost a copy of a whole
        attribute, once in a transaction: being handed an array of it, or a column, and holding one when the
        transaction begins. ``v.point`` and the operators do with single rows. And :meth:`compact` leaves the old
        columns in memory until the end.

        Transactions may stand inside each other. The arrays of ``mesh.topology``, and of attributes that have grown in
        the block, are to be taken afresh after it.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> try:
        ...     with mesh.transaction():
        ...         v = mesh.split_face(0)
        ...         mesh.points[:] = 0.0
        ...         mesh.flip(999)
        ... except hm.ElementError:
        ...     mesh
        <Mesh: 8 vertices, 12 edges, 6 faces, closed>
        >>> float(mesh.points.max()), v.is_alive
        (1.0, False)
        """
        return Transaction(self, include_held)  # type: ignore[arg-type]

    def compact(self) -> compaction.Maps:
        """Remove what was deleted for good: the living move together, in their order, and so do their attributes.

        Returns
        -------
        Maps
            The new index of every old one: ``vertices``, ``halfedges``, ``edges``, ``faces``; -1 for the deleted.

        Notes
        -----
        O(n). The only operation that changes indices: handles taken before it raise StaleElementError, arrays and
        columns taken before it are the old ones. Nothing happens where nothing was deleted. :attr:`ids` stay.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2], [0, 2, 3]])
        >>> f = mesh.join_faces(mesh.find_halfedge(2, 0))
        >>> mesh.compact().faces
        array([ 0, -1], dtype=int32)
        >>> len(mesh.topology.face_halfedge)
        1
        """
        self._topology.catch_up_late()
        is_worn = self._topology.__arrays__().counts[N_DEAD_VERTICES : N_DEAD_FACES + 1].any()
        before = _Compacted(self) if is_worn and self._savepoints else None
        maps = compaction.compact(self._topology)
        if before is not None and self._savepoints[-1].compacted is None:
            self._savepoints[-1].compacted = before
        if is_worn:
            of_kinds = (maps.vertices, maps.halfedges, maps.edges, maps.faces)
            for table, new_of_old in zip(self._tables(), of_kinds, strict=True):
                table._permute(new_of_old)
            if self._numbers is not None:
                self._numbers.compacted(maps)
            self._look_again()
        return maps

    @property
    def ids(self) -> Ids:
        """Numbers of the elements that stay when the mesh is compacted: see :class:`~halfmesh.mesh.Ids`."""
        return Ids(self)  # type: ignore[arg-type]

    def _numbering(self) -> Numbers:
        if self._numbers is None:
            self._numbers = Numbers()
        return self._numbers

    @property
    def meta(self) -> dict[str, Any]:
        """Notes that belong to no element, such as the names of an OBJ file's groups; kept by `copy` and `save`."""
        if self._savepoints:
            self._savepoints[-1].keep_meta(self._meta)
        return self._meta

    @meta.setter
    def meta(self, meta: dict[str, Any]) -> None:
        if self._savepoints:
            self._savepoints[-1].keep_meta(self._meta)
        self._meta = meta

    def _tables(self) -> tuple[AttributeTable, ...]:
        return (self.vertex_data, self.halfedge_data, self.edge_data, self.face_data)

    def _look_again(self) -> None:
        """Take the carrier that handles hold: at the beginning, and after elements have changed their indices."""
        self._t = self._topology.__views__()
        self._t.mesh = self._topology.owner
        self._t.vertex_data = self.vertex_data
