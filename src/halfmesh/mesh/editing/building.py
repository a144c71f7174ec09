"""Building by hand: vertices, edges and faces are added one by one, and removed, in any order."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from halfmesh.core.operators.building import (
    add_edge_in_status,
    make_adjacent_status,
    try_add_edge,
    try_add_edge_in,
    try_add_vertex,
    try_make_adjacent,
    try_remove_edge,
    try_remove_face,
    try_remove_vertex,
)
from halfmesh.core.operators.faces import (
    add_face_of_vertices_status,
    add_face_status,
    try_add_face,
    try_add_face_of_vertices,
    try_add_quad,
    try_add_triangle,
)
from halfmesh.core.search import find_halfedge
from halfmesh.core.statuses import LOOP_EDGE, MISSING_ELEMENT
from halfmesh.mesh.desk import natively
from halfmesh.mesh.editing import natives
from halfmesh.mesh.editing.base import Base
from halfmesh.mesh.elements import Edge, Element, Face, Halfedge, Vertex

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike

__all__ = ["Building"]


class Building(Base):
    """The operations of a general half-edge mesh: wire, loops, parallel edges and faces, as they come."""

    @natively(natives.add_vertex, try_add_vertex, makes=natives.OF_ADD_VERTEX)
    def add_vertex(self, point: ArrayLike | None = None) -> Vertex:
        """Add an isolated vertex.

        Parameters
        ----------
        point : (3,) or (2,) array_like of float, optional
            Its position; zeros if not given.

        Returns
        -------
        Vertex
            The last one.

        Raises
        ------
        InvalidMeshError
            The point is not finite.

        Notes
        -----
        V + 1, components + 1. Amortised O(1).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([])
        >>> mesh.add_vertex([1, 2, 3]).point.tolist()
        [1.0, 2.0, 3.0]
        """
        v = self._act_and_place(try_add_vertex, (), point)
        if v < 0:
            self._refuse("add", v, ("a", "vertex"))
        return self._made(Vertex, v)

    def add_edge(
        self,
        u: Vertex | Halfedge | int,
        v: Vertex | Halfedge | int,
        *,
        allow_loop: bool = True,
        allow_parallel: bool = True,
    ) -> Edge:
        """Add an edge without faces between two vertices that touch a gap, or are isolated.

        Parameters
        ----------
        u, v : Vertex or int, or Halfedge
            May be the same: a loop edge. Where a vertex has several gaps, an exterior halfedge that leaves it says
            which: that before it. A vertex stands for its halfedge.
        allow_loop : bool
            If False, a loop edge is refused.
        allow_parallel : bool
            If False, an edge that joins them already is returned in place of a new one.

        Returns
        -------
        Edge
            Its halfedge runs from `u` to `v`, if it is new.

        Raises
        ------
        TopologyError
            Faces close all around an end, or a halfedge has a face, or it is a loop that is not allowed.
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        E + 1. Amortised O(1), and the smaller degree where `allow_parallel` is False.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([], n_vertices=3)
        >>> e = mesh.add_edge(0, 1)
        >>> e.vertices, e.faces
        ((Vertex(0), Vertex(1)), (None, None))
        >>> mesh.add_edge(1, 0, allow_parallel=False) == e
        True
        """
        (a, gap_a), (b, gap_b) = self._end(u), self._end(v)
        if not allow_loop and a == b:
            self._refuse("join", LOOP_EDGE, ("vertex", a), ("vertex", b))
        if not allow_parallel:
            found = self._act(find_halfedge, self._living(Vertex, a), self._living(Vertex, b))
            if found >= 0:
                return self._made(Edge, found >> 1)
        gap_is_said = gap_a >= 0 or gap_b >= 0
        h = self._act(try_add_edge_in, a, gap_a, b, gap_b) if gap_is_said else self._act(try_add_edge, a, b)
        if h < 0:
            self._refuse("join", h, ("vertex", a), ("vertex", b))
        return self._made(Edge, h >> 1)

    def can_add_edge(
        self,
        u: Vertex | Halfedge | int,
        v: Vertex | Halfedge | int,
        *,
        allow_loop: bool = True,
        allow_parallel: bool = True,
    ) -> bool:
        """Whether :meth:`add_edge` would give an edge, be it one that is there already. O(1), or the smaller degree."""
        (a, gap_a), (b, gap_b) = self._end(u), self._end(v)
        self._living(Vertex, a), self._living(Vertex, b)
        if a == b and not allow_loop:
            return False
        if not allow_parallel and self._act(find_halfedge, a, b) >= 0:
            return True
        return self._act(add_edge_in_status, a, gap_a, b, gap_b) == 0

    def _end(self, end: Any) -> tuple[int, int]:
        """The vertex of an edge to be, and the halfedge before which it is to be hung; -1 if that is not said."""
        if isinstance(end, Halfedge):
            return end.origin.index, self._index(Halfedge, end)
        return self._index(Vertex, end), -1

    def can_add_face(
        self, vertices: Iterable[Vertex | int] | None = None, *, halfedges: Iterable[Halfedge | int] | None = None
    ) -> bool:
        """Whether :meth:`add_face` would add a face. The cost of doing it, which is undone."""
        if (vertices is None) == (halfedges is None):
            raise TypeError("can_add_face takes either vertices or halfedges=")
        kind: type[Element] = Vertex if halfedges is None else Halfedge
        elements = halfedges if vertices is None else vertices
        assert elements is not None
        indices = np.array([self._living(kind, x) for x in elements], dtype=np.int64)
        return self._act(add_face_of_vertices_status if kind is Vertex else add_face_status, indices) == 0

    def can_make_adjacent(self, arriving: Halfedge | int, leaving: Halfedge | int) -> bool:
        """Whether :meth:`make_adjacent` could bring the two together. O(degree)."""
        h, g = self._living(Halfedge, arriving), self._living(Halfedge, leaving)
        return self._act(make_adjacent_status, h, g) == 0

    @natively(natives.add_face, try_add_triangle, makes=natives.OF_ADD_FACE)
    def add_face(
        self, vertices: Iterable[Vertex | int] | None = None, *, halfedges: Iterable[Halfedge | int] | None = None
    ) -> Face:
        """Add a face, by its vertices or by its halfedges, counter-clockwise.

        Parameters
        ----------
        vertices : iterable of Vertex or int, optional
            At least three. Edges that are missing are made.
        halfedges : iterable of Halfedge or int, optional
            At least one, each arriving where the next one leaves, all without a face.

        Returns
        -------
        Face
            The last one; its halfedge is the first of those given.

        Raises
        ------
        TopologyError
            A side has a face already, or the parts around a vertex can't be brought into the order that the face
            needs; ``reason`` says which. Nothing was changed.
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        F + 1. O(sum of the degrees of its vertices).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([], n_vertices=4)
        >>> f = mesh.add_face([0, 1, 2])
        >>> g = mesh.add_face([2, 1, 3])
        >>> mesh.n_edges, [h.index for h in g.neighbors()]
        (5, [0])
        """
        if vertices is None or halfedges is not None:
            return self._add_face_along(vertices, halfedges)
        corners = vertices if type(vertices) is list or type(vertices) is tuple else list(vertices)
        try:
            indices = [self._index(Vertex, v) for v in corners]
            if len(indices) == 3:
                f = self._act(try_add_triangle, *indices)
            elif len(indices) == 4:
                f = self._act(try_add_quad, *indices)
            else:
                f = self._act(try_add_face_of_vertices, np.array(indices, dtype=np.int64))
        except (OverflowError, ValueError):  # no index is so large: no int64, or no item of a memoryview
            f = -MISSING_ELEMENT
        if f < 0:
            self._refuse_face(Vertex, corners, f)
        return self._made(Face, f)

    def _add_face_along(self, vertices: Any, halfedges: Iterable[Halfedge | int] | None) -> Face:
        if vertices is not None or halfedges is None:
            raise TypeError("add_face takes either vertices or halfedges=")
        sides = list(halfedges)
        try:
            f = self._act(try_add_face, np.array([self._index(Halfedge, h) for h in sides], dtype=np.int64))
        except (OverflowError, ValueError):
            f = -MISSING_ELEMENT
        if f < 0:
            self._refuse_face(Halfedge, sides, f)
        return self._made(Face, f)

    def _refuse_face(self, kind: type[Element], elements: list[Any] | tuple[Any, ...], code: int) -> NoReturn:
        """Raise for the element that is missing or deleted, or for what the code says of them together."""
        indices = [getattr(self, kind.plural).resolve(x) for x in elements]
        self._refuse("add a face with", code, (kind.plural, indices))

    def make_adjacent(self, arriving: Halfedge | int, leaving: Halfedge | int) -> None:
        """Reorder what hangs around a vertex so that ``arriving.next == leaving``.

        Parameters
        ----------
        arriving, leaving : Halfedge or int
            Both without a face; the one arrives at the vertex that the other leaves.

        Raises
        ------
        TopologyError
            They do not meet, have a face, or there is no other gap to move what is between them to.
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        O(degree). Boundary loops are joined and split; everything else stays.
        """
        h, g = self._index(Halfedge, arriving), self._index(Halfedge, leaving)
        code = self._act(try_make_adjacent, h, g)
        if code < 0:
            self._refuse("make adjacent", code, ("halfedge", h), ("halfedge", g))

    def remove_face(self, face: Face | int) -> None:
        """Remove a face and leave its edges: a gap is in its place.

        Raises
        ------
        StaleElementError, ElementError
            The face was deleted, or there is none.

        Notes
        -----
        F - 1; edges and vertices stay, as wire if need be. O(degree).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> mesh.remove_face(0)
        >>> mesh.n_faces, mesh.n_edges, mesh.n_boundary_loops
        (5, 12, 1)
        """
        f = self._index(Face, face)
        code = self._act(try_remove_face, f)
        if code < 0:
            self._refuse("remove", code, ("face", f))

    def remove_edge(self, edge: Edge | int) -> None:
        """Remove an edge and the faces on both sides of it; its ends stay.

        See :meth:`join_faces` for uniting the faces.

        Raises
        ------
        StaleElementError, ElementError
            The edge was deleted, or there is none.

        Notes
        -----
        E - 1, F - 1 or - 2 for the faces beside it. O(degree).
        """
        e = self._index(Edge, edge)
        code = self._act(try_remove_edge, e)
        if code < 0:
            self._refuse("remove", code, ("edge", e))

    def remove_vertex(self, vertex: Vertex | int) -> None:
        """Remove a vertex with its edges and the faces around it.

        Raises
        ------
        StaleElementError, ElementError
            The vertex was deleted, or there is none.

        Notes
        -----
        V - 1, E - its edges, F - the faces around it. O(sum of the degrees around it).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> mesh.remove_vertex(0)
        >>> mesh.n_vertices, mesh.n_edges, mesh.n_faces
        (7, 9, 3)
        """
        v = self._index(Vertex, vertex)
        code = self._act(try_remove_vertex, v)
        if code < 0:
            self._refuse("remove", code, ("vertex", v))
