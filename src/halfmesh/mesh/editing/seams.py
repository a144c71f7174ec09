"""Seams: edges opened and closed, cuts along paths and the stitches that undo them, and loops that change the genus."""

from __future__ import annotations

from operator import index
from typing import TYPE_CHECKING, Any

import numpy as np

from halfmesh.core.operators.loops import join_loop_status, split_loop_status, try_join_loop, try_split_loop
from halfmesh.core.operators.seams import (
    close_edge_status,
    cut_status,
    open_edge_status,
    stitch_status,
    try_close_edge,
    try_cut,
    try_open_edge,
    try_stitch,
    try_zip_hole,
)
from halfmesh.core.statuses import DELETED_ELEMENT, MISSING_ELEMENT
from halfmesh.core.topology import LIMIT
from halfmesh.mesh.editing.base import Base
from halfmesh.mesh.elements import Edge, Face, Halfedge

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from halfmesh._jit import Kernel

__all__ = ["Seams"]


class Seams(Base):
    """Cutting a surface open and sewing it up."""

    def can_open_edge(self, edge: Edge | Halfedge | int) -> bool:
        """Whether :meth:`open_edge` would open the edge: whether there are faces on both sides. O(1)."""
        return self._act(open_edge_status, self._living_halfedge(edge)) == 0

    def open_edge(self, edge: Edge | Halfedge | int) -> Edge:
        """Make two edges of one, with a hole of two sides between them; the ends stay.

        Parameters
        ----------
        edge : Edge or int, or Halfedge
            An edge stands for its halfedge, ``2 * edge``. The face on the left of the halfedge keeps the edge.

        Returns
        -------
        Edge
            The new edge, the last one, of the other face.

        Raises
        ------
        TopologyError
            A face is missing on one side.
        StaleElementError, ElementError
            The edge was deleted, or there is none.

        Notes
        -----
        E + 1, boundary loops + 1. :meth:`close_edge` undoes it. O(1).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> mesh.open_edge(0), mesh.n_boundary_loops
        (Edge(12), 1)
        """
        h = self._halfedge_index(edge)
        y = self._act(try_open_edge, h)
        if y < 0:
            self._refuse("open", y, ("edge", h >> 1))
        return self._made(Edge, y >> 1)

    def can_close_edge(self, halfedge: Halfedge | int) -> bool:
        """Whether :meth:`close_edge` would close a hole: whether it lies between two edges. O(1)."""
        return self._act(close_edge_status, self._living(Halfedge, halfedge)) == 0

    def close_edge(self, halfedge: Halfedge | int) -> Edge:
        """Close a hole of two sides: its edges become one.

        Parameters
        ----------
        halfedge : Halfedge or int
            An exterior one; its edge stays.

        Returns
        -------
        Edge
            The edge that stays.

        Raises
        ------
        TopologyError
            The halfedge has a face, or does not run along a hole between two edges.
        StaleElementError, ElementError
            The halfedge was deleted, or there is none.

        Notes
        -----
        E - 1, boundary loops - 1. O(degree).
        """
        h = self._index(Halfedge, halfedge)
        code = self._act(try_close_edge, h)
        if code < 0:
            self._refuse("close the hole at", code, ("halfedge", h))
        return self._made(Edge, h >> 1)

    # -- along a path ----------------------------------------------------------------------------------------------

    def can_cut(self, path: Iterable[Halfedge | Edge | int]) -> bool:
        """Whether :meth:`cut` would cut along these. O(their number)."""
        return self._may(cut_status, "cut along", path)

    def cut(self, path: Iterable[Halfedge | Edge | int]) -> NDArray[np.int64]:
        """Cut the surface open along edges: a path, or any others.

        Parameters
        ----------
        path : iterable of Halfedge or int, or Edge
            Edges with faces on both sides, none twice; an edge stands for its first halfedge. The faces on the left
            keep the edges.

        Returns
        -------
        ndarray of int64
            The new edge beside each, of the faces on the right.

        Raises
        ------
        TopologyError
            An edge is at the boundary already, or listed twice.
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        E + 1 for each. Each edge is opened; then what lies at its ends from the new gap counter-clockwise to the next
        gets a vertex of its own. So an inner end of a path stays whole, its inner vertices become two each, and where
        it starts at the boundary that opens. :meth:`stitch` and :meth:`zip_hole` undo it. O(degrees).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.grid(3, 3)
        >>> middle = [mesh.find_halfedge(4, 5), mesh.find_halfedge(5, 6)]
        >>> mesh.cut(middle), mesh.n_vertices, mesh.n_boundary_loops
        (array([24, 25]), 18, 1)
        """
        halfedges = self._halfedges(path)
        first = self._run(try_cut, _STEPS * len(halfedges), halfedges)
        if first < 0:
            self._refuse("cut along", first, ("halfedges", halfedges.tolist()))
        return np.arange(first, first + len(halfedges))

    def can_stitch(self, a: Halfedge | int, b: Halfedge | int, *, allow_parallel: bool = False) -> bool:
        """Whether :meth:`stitch` would make one edge of two. Some O(degree^2)."""
        h, g = self._living(Halfedge, a), self._living(Halfedge, b)
        return self._act(stitch_status, h, g, allow_parallel) == 0

    def stitch(self, a: Halfedge | int, b: Halfedge | int, *, allow_parallel: bool = False) -> Edge:
        """Make two exterior halfedges the two sides of one edge; their ends are welded where they differ.

        Parameters
        ----------
        a, b : Halfedge or int
            They come to run against each other. The edge and the ends of `a` stay.
        allow_parallel : bool
            Also where other edges become loops or parallel. Two that bound the rest of the hole may always.

        Returns
        -------
        Edge
            The edge of `a`.

        Raises
        ------
        TopologyError
            One has a face or is of a loop edge, or both are of one edge; an edge would become a loop or parallel; or at
            an end that they share already, something else would be cut off.
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        E - 1, V - 1 for each end that is welded, and comes to lie in the middle; faces stay.
        O(degree^2) to ask, O(degree) to act.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2], [3, 4, 5]])
        >>> mesh.stitch(mesh.find_halfedge(1, 0), mesh.find_halfedge(4, 3))
        Edge(0)
        >>> mesh.n_vertices, mesh.n_edges, mesh.n_boundary_loops
        (4, 5, 1)
        """
        h, g = self._index(Halfedge, a), self._index(Halfedge, b)
        code = self._act(try_stitch, h, g, allow_parallel)
        if code < 0:
            self._refuse("stitch", code, ("halfedge", h), ("halfedge", g))
        return self._made(Edge, h >> 1)

    def can_zip_hole(self, halfedge: Halfedge | int) -> bool:
        """Whether :meth:`zip_hole` would stitch at least one pair. Some O(degree^2)."""
        h = self._made(Halfedge, self._living(Halfedge, halfedge))
        return self.can_stitch(h, h.next)

    def zip_hole(self, halfedge: Halfedge | int, n: int | None = None) -> int:
        """Zip a hole up from the target of a halfedge: stitch it to its next, the ones around these, and so on.

        Parameters
        ----------
        halfedge : Halfedge or int
            An exterior one; its edge stays, and those before it.
        n : int, optional
            How many pairs at most; as far as it goes if not given. Nothing happens where it is below one.

        Returns
        -------
        int
            The number of pairs that were stitched.

        Raises
        ------
        TopologyError
            The first pair can't be stitched; see :meth:`stitch`.
        StaleElementError, ElementError
            The halfedge was deleted, or there is none.

        Notes
        -----
        O(degrees).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.grid(3, 3)
        >>> mesh.cut([mesh.find_halfedge(4, 5), mesh.find_halfedge(5, 6)]).tolist()
        [24, 25]
        >>> h = next(h for h in mesh.vertices[6].incoming() if h.is_exterior)
        >>> mesh.zip_hole(h, 2), mesh.n_vertices, mesh.n_boundary_loops
        (2, 16, 1)
        """
        h = self._index(Halfedge, halfedge)
        at_most = -1 if n is None else min(index(n), LIMIT)
        if n is not None and at_most < 1:
            self._living(Halfedge, halfedge)
            return 0
        done = self._run(try_zip_hole, 2 * _STEPS, h, at_most)
        if done < 0:
            self._refuse("zip the hole at", done, ("halfedge", h))
        return done

    # -- around a loop ---------------------------------------------------------------------------------------------

    def can_split_loop(self, path: Iterable[Halfedge | int]) -> bool:
        """Whether :meth:`split_loop` would cut and cap the surface along these. O(their number)."""
        return self._may(split_loop_status, "split along", path)

    def split_loop(self, path: Iterable[Halfedge | int]) -> tuple[Face, Face]:
        """Cut the surface along a closed path and cap both ends with a face.

        Parameters
        ----------
        path : iterable of Halfedge or int
            Three at least, each arriving where the next one leaves, once around, through inner vertices, none twice.

        Returns
        -------
        (Face, Face)
            The new faces, the last two: that opposite to the left side of the path, and the other.

        Raises
        ------
        TopologyError
            They are no such path; ``reason`` says how.
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        For n halfedges: V + n, E + n, F + 2: Euler's number + 2. Genus - 1, or components + 1. :meth:`join_loop` undoes
        it. O(degrees).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.torus(8, 4)
        >>> around = [h] = [mesh.halfedges[0]]
        >>> while around[-1].target != h.origin:
        ...     around.append(around[-1].next.twin.next)
        >>> f, g = mesh.split_loop(around)
        >>> f.degree == g.degree == len(around), mesh.genus
        (True, 0)
        """
        halfedges = self._halfedges(path)
        f = self._run(try_split_loop, _STEPS * len(halfedges), halfedges)
        if f < 0:
            self._refuse("split along", f, ("halfedges", halfedges.tolist()))
        return self._made(Face, f), self._made(Face, f + 1)

    def can_join_loop(self, a: Halfedge | int, b: Halfedge | int, *, allow_parallel: bool = False) -> bool:
        """Whether :meth:`join_loop` would glue the faces of two halfedges. The cost of doing it, which is undone."""
        h, g = self._living(Halfedge, a), self._living(Halfedge, b)
        return self._run(join_loop_status, 3 * _STEPS, h, g, allow_parallel) == 0

    def join_loop(self, a: Halfedge | int, b: Halfedge | int, *, allow_parallel: bool = False) -> None:
        """Take two faces out and glue the rims: `a` to `b`, the next of `a` to the prev of `b`, and so on.

        Parameters
        ----------
        a, b : Halfedge or int
            Of two faces with equally many sides and no common vertex. Edges and vertices of the first stay.
        allow_parallel : bool
            Also where other edges become parallel.

        Raises
        ------
        TopologyError
            They are no such faces, or edges would become loops or parallel.
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        For n sides: V - n, E - n, F - 2: Euler's number - 2. Genus + 1, or components - 1. Corners come to lie in
        the middle of the two that they are glued of. O(degrees).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2, 3], [3, 2, 1, 0], [4, 5, 6, 7], [7, 6, 5, 4]])
        >>> mesh.join_loop(mesh.faces[0].halfedge, mesh.faces[2].halfedge, allow_parallel=True)
        >>> mesh.n_vertices, mesh.n_faces, mesh.n_connected_components
        (4, 2, 1)
        """
        h, g = self._index(Halfedge, a), self._index(Halfedge, b)
        code = self._run(try_join_loop, 3 * _STEPS, h, g, allow_parallel)
        if code < 0:
            self._refuse("glue the faces of", code, ("halfedge", h), ("halfedge", g))

    def _may(self, question: Kernel[Any, Any], doing: str, path: Iterable[Any]) -> bool:
        """Ask about a path, whose elements must be there."""
        halfedges = self._halfedges(path)
        status = self._run(question, _STEPS * len(halfedges), halfedges)
        if status in (MISSING_ELEMENT, DELETED_ELEMENT):
            self._refuse(doing, status, ("halfedges", halfedges.tolist()))
        return status == 0


_STEPS = 100  # what a halfedge of a path costs when it is interpreted, counted in steps of a loop
