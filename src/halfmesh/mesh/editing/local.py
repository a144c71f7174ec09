"""The operators of remeshing: flip, split, collapse."""

from __future__ import annotations

from typing import TYPE_CHECKING

from halfmesh.core.operators.collapses import collapse_status, try_collapse
from halfmesh.core.operators.flips import flip_status, try_flip
from halfmesh.core.operators.splits import (
    split_edge_triangular_status,
    try_split_edge,
    try_split_edge_triangular,
    try_split_face,
)
from halfmesh.core.slots import is_full
from halfmesh.core.statuses import DELETED_ELEMENT
from halfmesh.mesh.desk import ASK, TRIANGULAR, TRY, natively
from halfmesh.mesh.editing import natives
from halfmesh.mesh.editing.base import Base, as_fraction
from halfmesh.mesh.elements import Edge, Face, Halfedge, Vertex

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Local"]


class Local(Base):
    """Flips, splits and collapses."""

    @natively(natives.flip, flip_status, ASK)
    def can_flip(self, edge: Edge | int, *, allow_parallel: bool = False) -> bool:
        """Whether :meth:`flip` would turn the edge. O(degree)."""
        return self._act(flip_status, self._living(Edge, edge), allow_parallel) == 0

    @natively(natives.flip, try_flip)
    def flip(self, edge: Edge | int, *, allow_parallel: bool = False) -> None:
        r"""Turn an edge counter-clockwise inside its two faces: each end moves on to the next corner.

        ::

                 b                    b
               / | \                /   \
              c  |  d      -->     c --- d
               \ | /                \   /
                 a                    a

        Parameters
        ----------
        edge : Edge or int
        allow_parallel : bool
            Also where the edge would join a vertex to itself, or two that are joined already.

        Raises
        ------
        TopologyError
            The edge has no face on one side, the same face on both, or a face of fewer than three sides; or the
            edge would become a loop or parallel to another.
        StaleElementError, ElementError
            The edge was deleted, or there is none.

        Notes
        -----
        Faces may have any degree, and keep it. V, E, F, components and boundary loops stay as they are. The edge,
        its halfedges and the faces keep their indices. O(1), and the smaller degree of the new ends for the test.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2], [1, 0, 3]])
        >>> mesh.flip(mesh.find_halfedge(0, 1).edge)
        >>> mesh.face_vertices()[0].reshape(-1, 3).tolist()
        [[3, 2, 0], [2, 3, 1]]
        """
        e = self._index(Edge, edge)
        code = self._act(try_flip, e, allow_parallel)
        if code < 0:
            self._refuse("flip", code, ("edge", e))

    @natively(natives.flip, try_flip, TRY)
    def try_flip(self, edge: Edge | int, *, allow_parallel: bool = False) -> bool:
        """Turn the edge as :meth:`flip` does, if that may be: whether it was turned.

        The quickest way to flip where one may from Python: asking and acting in one call, without an exception.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2], [1, 0, 3]])
        >>> [mesh.try_flip(e) for e in mesh.edges]
        [True, False, False, False, False]
        """
        e = self._index(Edge, edge)
        code = self._act(try_flip, e, allow_parallel)
        if code < -DELETED_ELEMENT:
            return False
        if code < 0:
            self._refuse("flip", code, ("edge", e))
        return True

    # -- splits ----------------------------------------------------------------------------------------------------

    @natively(natives.split_edge, try_split_edge, makes=natives.OF_SPLIT_EDGE)
    def split_edge(self, edge: Edge | Halfedge | int, point: ArrayLike | None = None, *, at: float = 0.5) -> Vertex:
        r"""Put a vertex into an edge. The faces beside it gain a corner.

        ::

            a ------> b     -->     a ----> v ----> b

        Parameters
        ----------
        edge : Edge or int, or Halfedge
            An edge stands for its halfedge, ``2 * edge``.
        point : (3,) or (2,) array_like of float, optional
            Where the vertex is to lie. If not given it lies on the edge.
        at : float
            How far along the halfedge, from its origin (0) to its target (1): where the vertex lies, and what its
            other attributes are interpolated at.

        Returns
        -------
        Vertex
            The new vertex, the last one. The new edge is the last one too, and runs from it to the old target.

        Raises
        ------
        StaleElementError, ElementError
            The edge was deleted, or there is none.
        InvalidMeshError
            The point is not finite, or `at` is not between 0 and 1.

        Notes
        -----
        V + 1, E + 1; faces, components and boundary loops stay. Any edge will do. :meth:`collapse` undoes it. O(1).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> v = mesh.split_edge(0, at=0.25)
        >>> v.degree, mesh.n_edges, [f.degree for f in v.faces()]
        (2, 13, [5, 5])
        """
        h = self._halfedge_index(edge)
        v = self._act_and_place(try_split_edge, (h, as_fraction(at)), point)
        if v < 0:
            self._refuse("split", v, ("edge", h >> 1))
        return self._made(Vertex, v)

    def can_split_edge(self, edge: Edge | Halfedge | int) -> bool:
        """Whether :meth:`split_edge` would put a vertex into the edge: any that lives, unless the mesh is full."""
        return self._living_halfedge(edge) >= 0 and not is_full.plain(self._t, 1, 1, 0)

    def can_split_edge_triangular(self, edge: Edge | Halfedge | int, *, allow_parallel: bool = False) -> bool:
        """Whether :meth:`split_edge_triangular` would split the edge. O(1)."""
        return self._act(split_edge_triangular_status, self._living_halfedge(edge), allow_parallel) == 0

    @natively(natives.split_edge, try_split_edge_triangular, TRIANGULAR, makes=natives.OF_SPLIT_EDGE)
    def split_edge_triangular(
        self,
        edge: Edge | Halfedge | int,
        point: ArrayLike | None = None,
        *,
        at: float = 0.5,
        allow_parallel: bool = False,
    ) -> Vertex:
        r"""Put a vertex into an edge and join it to the third corners of the triangles beside.

        ::

               c                    c
             /   \                / | \
            a --- b      -->      a--v--b
             \   /                \ | /
               d                    d

        Parameters
        ----------
        edge : Edge or int, or Halfedge
            An edge stands for its halfedge, ``2 * edge``.
        point : (3,) or (2,) array_like of float, optional
            Where the vertex is to lie. If not given it lies on the edge.
        at : float
            How far along the halfedge, from its origin (0) to its target (1).
        allow_parallel : bool
            Also where both triangles have the same third corner.

        Returns
        -------
        Vertex
            The new vertex, the last one. New edges: to the target, left, right; new faces: left, right of the origin's.

        Raises
        ------
        TopologyError
            A face beside the edge is no triangle.
        StaleElementError, ElementError
            The edge was deleted, or there is none.
        InvalidMeshError
            The point is not finite, or `at` is not between 0 and 1.

        Notes
        -----
        For k triangles beside: V + 1, E + 1 + k, F + k; components and boundary loops stay. O(1).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.tetrahedron()
        >>> v = mesh.split_edge_triangular(0)
        >>> v.degree, mesh.n_faces, mesh.is_triangular
        (4, 6, True)
        """
        h = self._halfedge_index(edge)
        v = self._act_and_place(try_split_edge_triangular, (h, as_fraction(at), allow_parallel), point)
        if v < 0:
            self._refuse("split", v, ("edge", h >> 1))
        return self._made(Vertex, v)

    def can_split_face(self, face: Face | int) -> bool:
        """Whether :meth:`split_face` would put a vertex into the face: any that lives, unless the mesh is full."""
        degree = self._made(Face, self._living(Face, face)).degree
        return not is_full.plain(self._t, 1, degree, degree)

    @natively(natives.split_face, try_split_face, makes=natives.OF_SPLIT_FACE)
    def split_face(self, face: Face | int, point: ArrayLike | None = None) -> Vertex:
        r"""Put a vertex into a face and join it to every corner.

        ::

               c                      c
             /   \                  / | \
            /  f  \       -->      /  v  \
           /       \              / /   \ \
          a ------- b            a --------- b

        Parameters
        ----------
        face : Face or int
        point : (3,) or (2,) array_like of float, optional
            Where the vertex is to lie; the mean of the corners if not given.

        Returns
        -------
        Vertex
            The new vertex, the last one. The face keeps its first side.

        Raises
        ------
        StaleElementError, ElementError
            The face was deleted, or there is none.
        InvalidMeshError
            The point is not finite.

        Notes
        -----
        For a face of k corners: V + 1, E + k, F + k - 1; components and boundary loops stay. Any face will do. O(k).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> v = mesh.split_face(0)
        >>> v.degree, mesh.n_faces, v.point.tolist()
        (4, 9, [0.5, 0.5, 0.0])
        """
        f = self._index(Face, face)
        v = self._act_and_place(try_split_face, (f,), point)
        if v < 0:
            self._refuse("split", v, ("face", f))
        return self._made(Vertex, v)

    # -- collapse --------------------------------------------------------------------------------------------------

    @natively(natives.collapse, collapse_status, ASK)
    def can_collapse(self, halfedge: Halfedge | int) -> bool:
        """Whether :meth:`collapse` would contract the halfedge. Some O(degree^2)."""
        return self._act(collapse_status, self._living(Halfedge, halfedge)) == 0

    @natively(natives.collapse, try_collapse)
    def collapse(self, halfedge: Halfedge | int, point: ArrayLike | None = None, *, at: float = 1.0) -> Vertex:
        r"""Contract an edge: the origin of the halfedge goes, its target stays.

        ::

                 c                 c
               / | \               |  \
              .  |   \      -->    .  |   .
               \ a--> b              \ b /

        Parameters
        ----------
        halfedge : Halfedge or int
        point : (3,) or (2,) array_like of float, optional
            Where the vertex that stays is to lie.
        at : float
            The same as a place along the halfedge, from its origin (0) to its target (1), for all attributes.

        Returns
        -------
        Vertex
            The vertex that stays.

        Raises
        ------
        TopologyError
            The link condition does not hold: what the ends have in common is more than the edge has; ``reason``
            says which way the surface would be pinched, folded or doubled.
        StaleElementError, ElementError
            The halfedge was deleted, or there is none.
        InvalidMeshError
            The point is not finite, or `at` is not between 0 and 1.

        Notes
        -----
        V - 1; for each triangle beside the edge E - 2 and F - 1 in place of E - 1: Euler's number, the components and
        the boundary loops stay. Larger faces give up a corner. Faces of any degree, boundary edges and wire.

        References
        ----------
        Dey, Edelsbrunner, Guha, Nekhayev, *Topology preserving edge contraction* (1999), section 3.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.icosphere(1)
        >>> v = mesh.collapse(0, at=0.5)
        >>> mesh.n_vertices, mesh.n_faces, mesh.euler_characteristic
        (41, 78, 2)
        """
        h = self._index(Halfedge, halfedge)
        v = self._act_and_place(try_collapse, (h, as_fraction(at)), point)
        if v < 0:
            self._refuse("collapse", v, ("halfedge", h))
        return self._made(Vertex, v)

    @natively(natives.collapse, try_collapse, TRY)
    def try_collapse(
        self, halfedge: Halfedge | int, point: ArrayLike | None = None, *, at: float = 1.0
    ) -> Vertex | None:
        """Contract an edge as :meth:`collapse` does, if that may be: the vertex that stays, or None.

        The quickest way from Python: asking and acting in one call, without an exception.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.tetrahedron()
        >>> mesh.try_collapse(0) is None
        True
        """
        h = self._index(Halfedge, halfedge)
        v = self._act_and_place(try_collapse, (h, as_fraction(at)), point)
        if v < -DELETED_ELEMENT:
            return None
        if v < 0:
            self._refuse("collapse", v, ("halfedge", h))
        return self._made(Vertex, v)
