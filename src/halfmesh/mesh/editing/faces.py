"""Faces divided and united: diagonals, and what is dissolved."""

from __future__ import annotations

from halfmesh.core.operators.dissolving import (
    dissolve_edge_status,
    dissolve_vertex_status,
    try_dissolve_edge,
    try_dissolve_vertex,
)
from halfmesh.core.operators.splits import connect_status, join_faces_status, try_connect, try_join_faces
from halfmesh.mesh.editing.base import Base
from halfmesh.mesh.elements import Edge, Face, Halfedge, Vertex

__all__ = ["Faces"]


class Faces(Base):
    """Faces divided and united."""

    def can_connect(self, a: Halfedge | int, b: Halfedge | int, *, allow_parallel: bool = False) -> bool:
        """Whether :meth:`connect` would join the two corners. O(degree)."""
        h, g = self._living(Halfedge, a), self._living(Halfedge, b)
        return self._act(connect_status, h, g, allow_parallel) == 0

    def connect(self, a: Halfedge | int, b: Halfedge | int, *, allow_parallel: bool = False) -> Halfedge:
        r"""Split a face by a diagonal: join the origins of two of its halfedges.

        ::

            . <----- b              . <----- b
            |    f   ^              |  f  /  ^
            v        |     -->      v   /    |
            a -----> .              a -----> .

        Parameters
        ----------
        a, b : Halfedge or int
            Halfedges of one face; each names the corner at its origin.
        allow_parallel : bool
            Also where the new edge is a loop, or joins two vertices that are joined already.

        Returns
        -------
        Halfedge
            The new halfedge from `a`, of the last edge. The new face, the last one, is on its left.

        Raises
        ------
        TopologyError
            They are the same corner, of different faces or of none; or the edge would be a loop or parallel.
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        E + 1, F + 1; vertices, components and boundary loops stay. :meth:`join_faces` undoes it. O(degree).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2, 3]])
        >>> h = mesh.connect(mesh.find_halfedge(0, 1), mesh.find_halfedge(2, 3))
        >>> h.origin, h.target, [v.index for v in h.face.vertices()]
        (Vertex(0), Vertex(2), [0, 2, 3])
        """
        h, g = self._index(Halfedge, a), self._index(Halfedge, b)
        x = self._act(try_connect, h, g, allow_parallel)
        if x < 0:
            self._refuse("connect", x, ("halfedge", h), ("halfedge", g))
        return self._made(Halfedge, x)

    def can_join_faces(self, edge: Edge | Halfedge | int) -> bool:
        """Whether :meth:`join_faces` would unite the faces beside the edge. O(1)."""
        return self._act(join_faces_status, self._living_halfedge(edge)) == 0

    def join_faces(self, edge: Edge | Halfedge | int) -> Face:
        r"""Remove an edge between two faces, which become one.

        Parameters
        ----------
        edge : Edge or int, or Halfedge
            An edge stands for its halfedge, ``2 * edge``. The face on the left of the halfedge stays.

        Returns
        -------
        Face
            The face that stays.

        Raises
        ------
        TopologyError
            A face is missing on one side, or the same one lies on both, or one of them has no other side.
        StaleElementError, ElementError
            The edge was deleted, or there is none.

        Notes
        -----
        E - 1, F - 1; vertices, components and boundary loops stay. :meth:`connect` undoes it. O(degree) of the face
        that goes.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2], [0, 2, 3]])
        >>> f = mesh.join_faces(mesh.find_halfedge(0, 2))
        >>> f.degree, mesh.n_faces, mesh.n_edges
        (4, 1, 4)
        """
        h = self._halfedge_index(edge)
        code = self._act(try_join_faces, h)
        if code < 0:
            self._refuse("join the faces beside", code, ("edge", h >> 1))
        return self._made(Face, code)

    # -- dissolve --------------------------------------------------------------------------------------------------

    def can_dissolve_edge(self, edge: Edge | Halfedge | int) -> bool:
        """Whether :meth:`dissolve_edge` would remove the edge. O(1)."""
        return self._act(dissolve_edge_status, self._living_halfedge(edge)) == 0

    def dissolve_edge(self, edge: Edge | Halfedge | int) -> Face:
        """Unite the faces beside an edge, and remove its ends too where they are left with two edges.

        Parameters
        ----------
        edge : Edge or int, or Halfedge
            An edge stands for its halfedge, ``2 * edge``. The face on the left of the halfedge stays.

        Returns
        -------
        Face
            The face that stays.

        Raises
        ------
        TopologyError
            A face is missing on one side, or the same one lies on both, or one of them has no other side.
        StaleElementError, ElementError
            The edge was deleted, or there is none.

        Notes
        -----
        As :meth:`join_faces`, E - 1 and F - 1; for each end that goes V - 1 and E - 1 besides. An end stays if its two
        edges would become a loop, or parallel to another. O(degree).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> mesh.dissolve_edge(0).degree
        4
        >>> mesh.n_vertices, mesh.n_edges, mesh.n_faces
        (6, 9, 5)
        """
        h = self._halfedge_index(edge)
        f = self._act(try_dissolve_edge, h)
        if f < 0:
            self._refuse("dissolve", f, ("edge", h >> 1))
        return self._made(Face, f)

    def can_dissolve_vertex(self, vertex: Vertex | int) -> bool:
        """Whether :meth:`dissolve_vertex` would remove the vertex. O(sides of the faces around it)."""
        return self._act(dissolve_vertex_status, self._living(Vertex, vertex)) == 0

    def dissolve_vertex(self, vertex: Vertex | int) -> None:
        r"""Remove a vertex: the faces around it become one. Undoes :meth:`split_face`.

        ::

            .-----.            .-----.          .---.---.         .---.---.
            | \ / |            |     |          |  / \  |         |       |
            |  v  |    -->     |     |          | /   \ |   -->   |       |
            | / \ |            |     |          |/     \|         |       |
            .-----.            .-----.          .---v---.         .-------.

        A vertex of two edges goes, and they become one; the faces beside stay. So does a leaf, with its edge. At a
        boundary the two outer edges become one.

        Raises
        ------
        TopologyError
            The vertex is isolated, touches several gaps, or a face passes it twice; or what is left would be no
            polygon, or an edge parallel to another.
        StaleElementError, ElementError
            The vertex was deleted, or there is none.

        Notes
        -----
        V - 1. Of k edges all go if faces close around the vertex, E - k and F - k + 1; at a boundary E - k + 1 and
        F - k + 2; of two edges one, E - 1. Components and boundary loops stay. O(sides of the faces around it).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> mesh.dissolve_vertex(mesh.split_face(0))
        >>> mesh.n_vertices, mesh.n_edges, mesh.n_faces
        (8, 12, 6)
        >>> mesh.dissolve_vertex(0)
        >>> sorted(f.degree for f in mesh.faces)
        [4, 4, 4, 6]
        """
        v = self._index(Vertex, vertex)
        code = self._act(try_dissolve_vertex, v)
        if code < 0:
            self._refuse("dissolve", code, ("vertex", v))
