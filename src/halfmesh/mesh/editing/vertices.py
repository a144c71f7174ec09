"""Vertices made two and made one: along an edge, or at a gap."""

from __future__ import annotations

from typing import TYPE_CHECKING

from halfmesh.core.operators.vertices import (
    join_vertices_status,
    split_vertex_status,
    try_join_vertices,
    try_split_vertex,
)
from halfmesh.core.operators.welds import (
    try_unweld,
    try_weld,
    try_weld_vertices,
    unweld_status,
    weld_status,
    weld_vertices_status,
)
from halfmesh.mesh.editing.base import Base, as_fraction
from halfmesh.mesh.elements import Element, Halfedge, Vertex
from halfmesh.mesh.positions import as_point

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Vertices"]


class Vertices(Base):
    """Vertices split, joined, welded and unwelded."""

    def can_split_vertex(self, a: Halfedge | int, b: Halfedge | int) -> bool:
        """Whether :meth:`split_vertex` would split a vertex there: whether both leave the same one. O(1)."""
        return self._act(split_vertex_status, self._living(Halfedge, a), self._living(Halfedge, b)) == 0

    def split_vertex(self, a: Halfedge | int, b: Halfedge | int, point: ArrayLike | None = None) -> Halfedge:
        r"""Split a vertex into two that a new edge joins: the dual of :meth:`connect`.

        ::

             \   /                  \   /
              \ / b                  \ / b
               v          -->         w
              / \                     |        the faces of the corners of a and b gain a side
           a /   \                    v
                                   a / \

        Parameters
        ----------
        a, b : Halfedge or int
            Both leave the vertex. What lies counter-clockwise after `a` up to `b` moves to the new vertex; nothing, if
            they are the same: the new vertex is a leaf in the corner of `a`.
        point : (3,) or (2,) array_like of float, optional
            Where the new vertex is to lie; where the old one does if not given.

        Returns
        -------
        Halfedge
            From the old vertex to the new one: of the last edge, and the last vertex.

        Raises
        ------
        TopologyError
            They do not leave the same vertex.
        StaleElementError, ElementError
            One of them was deleted, or there is none.
        InvalidMeshError
            The point is not finite.

        Notes
        -----
        V + 1, E + 1; faces, components and boundary loops stay. :meth:`join_vertices` undoes it. O(degree).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.octahedron()
        >>> a, _, b, _ = mesh.vertices[0].outgoing()
        >>> h = mesh.split_vertex(a, b)
        >>> h.origin.degree, h.target.degree, [f.degree for f in h.edge.faces]
        (3, 3, [4, 4])
        """
        place = None if point is None else as_point(point)
        h, g = self._index(Halfedge, a), self._index(Halfedge, b)
        x = self._act(try_split_vertex, h, g)
        if x < 0:
            self._refuse("split the vertex of", x, ("halfedge", h), ("halfedge", g))
        made = self._made(Halfedge, x)
        self._placed(made.target.index, place)
        return made

    def can_join_vertices(self, halfedge: Halfedge | int, *, allow_parallel: bool = False) -> bool:
        """Whether :meth:`join_vertices` would contract the halfedge. Some O(degree^2)."""
        return self._act(join_vertices_status, self._living(Halfedge, halfedge), allow_parallel) == 0

    def join_vertices(
        self,
        halfedge: Halfedge | int,
        point: ArrayLike | None = None,
        *,
        at: float = 1.0,
        allow_parallel: bool = False,
    ) -> Vertex:
        """Contract an edge and nothing else: the faces beside it lose a side. The dual of :meth:`join_faces`.

        Parameters
        ----------
        halfedge : Halfedge or int
            Its origin goes, its target stays.
        point : (3,) or (2,) array_like of float, optional
            Where the vertex that stays is to lie.
        at : float
            The same as a place along the halfedge, from its origin (0) to its target (1), for all attributes.
        allow_parallel : bool
            Also where edges become loops or parallel, as those of a triangle do; :meth:`collapse` closes such faces.

        Returns
        -------
        Vertex
            The vertex that stays.

        Raises
        ------
        TopologyError
            The edge is a loop; or edges would become loops or parallel.
        StaleElementError, ElementError
            The halfedge was deleted, or there is none.
        InvalidMeshError
            The point is not finite, or `at` is not between 0 and 1.

        Notes
        -----
        V - 1, E - 1; faces and components stay, and boundary loops, except that of an edge all alone.
        :meth:`split_vertex` undoes it. O(degree^2) to ask, O(degree) to act.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> mesh.join_vertices(0).degree, sorted(f.degree for f in mesh.faces)
        (4, [3, 3, 4, 4, 4, 4])
        """
        place = None if point is None else as_point(point)
        h = self._index(Halfedge, halfedge)
        v = self._act(try_join_vertices, h, as_fraction(at), allow_parallel)
        if v < 0:
            self._refuse("join the ends of", v, ("halfedge", h))
        return self._placed(v, place)

    # -- at a gap --------------------------------------------------------------------------------------------------

    def can_weld(self, a: Vertex | Halfedge | int, b: Vertex | Halfedge | int, *, allow_parallel: bool = False) -> bool:
        """Whether :meth:`weld` would weld the two; ints are vertices. Some O(degree^2)."""
        kind = _welded_kind(a, b)
        status = weld_status if kind is Halfedge else weld_vertices_status
        return self._act(status, self._living(kind, a), self._living(kind, b), allow_parallel) == 0

    def weld(
        self,
        a: Vertex | Halfedge | int,
        b: Vertex | Halfedge | int,
        point: ArrayLike | None = None,
        *,
        allow_parallel: bool = False,
    ) -> Vertex:
        """Make one vertex of two that touch gaps; edges and faces stay.

        Parameters
        ----------
        a, b : Vertex or int, or Halfedge
            The first stays. Exterior halfedges say which gaps of their origins are joined, where there are several;
            vertices stand for the gap at their halfedge. They may be isolated.
        point : (3,) or (2,) array_like of float, optional
            Where the vertex is to lie; in the middle of the two if not given.
        allow_parallel : bool
            Also where edges become loops or parallel: before :meth:`close_edge`, for one.

        Returns
        -------
        Vertex
            The vertex that stays.

        Raises
        ------
        TopologyError
            Faces close all around one of them, or they are the same; or edges would become loops or parallel.
        StaleElementError, ElementError
            One of them was deleted, or there is none.
        InvalidMeshError
            The point is not finite.

        Notes
        -----
        V - 1; edges and faces stay. Two pieces become one component, or two boundary loops one, or one loop two.
        Attributes of the vertex follow as of one that is the union of both, each by half.
        :meth:`unweld` undoes it. O(degree^2) to ask, O(degree) to act.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2], [3, 4, 5]])
        >>> mesh.weld(2, 3).degree, mesh.n_vertices, mesh.n_connected_components
        (4, 5, 1)
        """
        place = None if point is None else as_point(point)
        kind = _welded_kind(a, b)
        u, w = self._index(kind, a), self._index(kind, b)
        v = self._act(try_weld if kind is Halfedge else try_weld_vertices, u, w, allow_parallel)
        if v < 0:
            self._refuse("weld", v, (kind.kind, u), (kind.kind, w))
        return self._placed(v, place)

    def can_unweld(self, a: Halfedge | int, b: Halfedge | int) -> bool:
        """Whether :meth:`unweld` would take a vertex apart there. O(1)."""
        return self._act(unweld_status, self._living(Halfedge, a), self._living(Halfedge, b)) == 0

    def unweld(self, a: Halfedge | int, b: Halfedge | int) -> Vertex:
        """Take a vertex apart at two of its gaps.

        Parameters
        ----------
        a, b : Halfedge or int
            Exterior halfedges that leave the vertex. What lies counter-clockwise after `a` up to `b` gets a new one.

        Returns
        -------
        Vertex
            The new vertex, the last one; it lies where the old one does.

        Raises
        ------
        TopologyError
            They do not leave the same vertex, or are the same, or have faces.
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        V + 1; edges and faces stay. :meth:`weld` undoes it. O(degree).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2], [0, 3, 4]])
        >>> a, b = (h for h in mesh.vertices[0].outgoing() if h.is_exterior)
        >>> mesh.unweld(a, b), mesh.n_connected_components
        (Vertex(5), 2)
        """
        h, g = self._index(Halfedge, a), self._index(Halfedge, b)
        w = self._act(try_unweld, h, g)
        if w < 0:
            self._refuse("unweld", w, ("halfedge", h), ("halfedge", g))
        return self._made(Vertex, w)


def _welded_kind(a: object, b: object) -> type[Element]:
    """What two arguments name: gaps, if both are halfedges."""
    return Halfedge if isinstance(a, Halfedge) and isinstance(b, Halfedge) else Vertex
