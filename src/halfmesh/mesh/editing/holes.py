"""Holes: faces taken out and put in, and faces grown along the boundary."""

from __future__ import annotations

from typing import TYPE_CHECKING

from halfmesh.core.operators.holes import (
    add_face_to_boundary_status,
    add_vertex_and_face_to_boundary_status,
    fill_hole_status,
    try_add_face_to_boundary,
    try_add_vertex_and_face_to_boundary,
    try_fill_hole,
    try_make_hole,
)
from halfmesh.mesh.editing.base import Base
from halfmesh.mesh.elements import Face, Halfedge, Vertex
from halfmesh.mesh.positions import as_point

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Holes"]


class Holes(Base):
    """Holes made, filled, and made smaller from the rim."""

    def can_make_hole(self, face: Face | int) -> bool:
        """Whether :meth:`make_hole` would take the face out: always, if it lives."""
        return self._living(Face, face) >= 0

    def make_hole(self, face: Face | int) -> Halfedge:
        """Take a face out: a hole is in its place. :meth:`fill_hole` undoes it.

        Returns
        -------
        Halfedge
            The halfedge of the face, which runs along the hole now.

        Raises
        ------
        StaleElementError, ElementError
            The face was deleted, or there is none.

        Notes
        -----
        F - 1; boundary loops + 1 inside of the surface. O(degree).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> h = mesh.make_hole(2)
        >>> h.is_exterior, mesh.n_faces, mesh.n_boundary_loops
        (True, 5, 1)
        >>> mesh.fill_hole(h)
        Face(6)
        """
        f = self._index(Face, face)
        h = self._act(try_make_hole, f)
        if h < 0:
            self._refuse("take out", h, ("face", f))
        return self._made(Halfedge, h)

    def can_fill_hole(self, halfedge: Halfedge | int) -> bool:
        """Whether :meth:`fill_hole` would lay a face there: whether the halfedge is exterior. O(1)."""
        return self._act(fill_hole_status, self._living(Halfedge, halfedge)) == 0

    def fill_hole(self, halfedge: Halfedge | int) -> Face:
        """Lay one face along the whole hole that a halfedge runs along.

        Parameters
        ----------
        halfedge : Halfedge or int
            An exterior one.

        Returns
        -------
        Face
            The new face, the last one; the halfedge is its first.

        Raises
        ------
        TopologyError
            There is a face on the left of the halfedge.
        StaleElementError, ElementError
            The halfedge was deleted, or there is none.

        Notes
        -----
        F + 1, boundary loops - 1. Any hole will do; wire that hangs in it becomes a slit. O(degrees of the corners).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cylinder(6)
        >>> for loop in mesh.boundary_loops():
        ...     print(mesh.fill_hole(int(loop[0])).degree)
        6
        6
        >>> mesh.has_boundary
        False
        """
        h = self._index(Halfedge, halfedge)
        f = self._act(try_fill_hole, h)
        if f < 0:
            self._refuse("fill the hole at", f, ("halfedge", h))
        return self._made(Face, f)

    # -- along the boundary ----------------------------------------------------------------------------------------

    def can_add_face_to_boundary(self, a: Halfedge | int, b: Halfedge | int, *, allow_parallel: bool = False) -> bool:
        """Whether :meth:`add_face_to_boundary` would lay a face there. O(sides of the hole)."""
        h, g = self._living(Halfedge, a), self._living(Halfedge, b)
        return self._act(add_face_to_boundary_status, h, g, allow_parallel) == 0

    def add_face_to_boundary(self, a: Halfedge | int, b: Halfedge | int, *, allow_parallel: bool = False) -> Face:
        r"""Lay a face along a hole, closed by a new edge.

        ::

            <----- b                <----- b
                   ^                   /   ^
                   |     -->          /  f |
            -----> a --->           v      |
                                    -----> a --->

        Parameters
        ----------
        a, b : Halfedge or int
            Exterior halfedges along one hole: the face takes the sides from `a` up to before `b`, and the new edge
            runs from the origin of `b` back to that of `a`.
        allow_parallel : bool
            Also where the new edge is a loop, or joins two vertices that are joined already.

        Returns
        -------
        Face
            The new face, the last one.

        Raises
        ------
        TopologyError
            They do not run along the same hole, or are the same, or the edge would be a loop or parallel.
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        E + 1, F + 1; vertices, components and boundary loops stay. O(sides of the hole, and degrees).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2], [0, 2, 3]])
        >>> h = mesh.find_halfedge(1, 0)
        >>> [v.index for v in mesh.add_face_to_boundary(h, h.next.next).vertices()]
        [1, 0, 3]
        """
        h, g = self._index(Halfedge, a), self._index(Halfedge, b)
        f = self._act(try_add_face_to_boundary, h, g, allow_parallel)
        if f < 0:
            self._refuse("add a face from", f, ("halfedge", h), ("halfedge", g))
        return self._made(Face, f)

    def can_add_vertex_and_face_to_boundary(self, a: Halfedge | int, b: Halfedge | int) -> bool:
        """Whether :meth:`add_vertex_and_face_to_boundary` would lay a face there. O(sides of the hole)."""
        h, g = self._living(Halfedge, a), self._living(Halfedge, b)
        return self._act(add_vertex_and_face_to_boundary_status, h, g) == 0

    def add_vertex_and_face_to_boundary(
        self, a: Halfedge | int, b: Halfedge | int, point: ArrayLike | None = None
    ) -> Vertex:
        """Lay a face along a hole, closed by two new edges through a new vertex.

        Parameters
        ----------
        a, b : Halfedge or int
            Exterior halfedges along one hole: the face takes the sides from `a` up to before `b`. With ``b = a.next`` a
            triangle grows on `a`.
        point : (3,) or (2,) array_like of float, optional
            Where the vertex is to lie; zeros if not given.

        Returns
        -------
        Vertex
            The new vertex, the last one. The face is the last one, too.

        Raises
        ------
        TopologyError
            They do not run along the same hole, or are the same.
        StaleElementError, ElementError
            One of them was deleted, or there is none.
        InvalidMeshError
            The point is not finite.

        Notes
        -----
        V + 1, E + 2, F + 1; components and boundary loops stay. O(sides of the hole, and degrees).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2]])
        >>> h = mesh.find_halfedge(1, 0)
        >>> v = mesh.add_vertex_and_face_to_boundary(h, h.next, [1, -1])
        >>> [u.index for u in v.neighbors()], mesh.n_faces
        ([1, 0], 2)
        """
        place = None if point is None else as_point(point)
        h, g = self._index(Halfedge, a), self._index(Halfedge, b)
        v = self._act(try_add_vertex_and_face_to_boundary, h, g)
        if v < 0:
            self._refuse("add a face from", v, ("halfedge", h), ("halfedge", g))
        return self._placed(v, place)
