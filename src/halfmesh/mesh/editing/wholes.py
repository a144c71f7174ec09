"""Whole components and whole meshes: turned around, removed, appended, taken out."""

from __future__ import annotations

from copy import deepcopy
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from halfmesh.core.compaction import Maps
from halfmesh.core.extraction import extract, spanned_by_faces, spanned_by_vertices
from halfmesh.core.operators.wholes import (
    reverse,
    try_append,
    try_remove_component,
    try_reverse_component,
)
from halfmesh.core.topology import DELETED, Topology
from halfmesh.errors import ElementError, StaleElementError
from halfmesh.mesh.editing.base import TABLES, Base
from halfmesh.mesh.elements import Element, Face, Vertex

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from halfmesh.mesh.mesh import Mesh

__all__ = ["Wholes"]


class Wholes(Base):
    """Operations on components and on meshes as a whole."""

    build_seconds: float
    meta: dict[str, Any]
    _meta: dict[str, Any]

    def reverse_component(self, vertex: Vertex | int) -> None:
        """Turn the orientation of a component around: faces that were counter-clockwise are clockwise.

        Parameters
        ----------
        vertex : Vertex or int
            Any vertex of it.

        Raises
        ------
        StaleElementError, ElementError
            The vertex was deleted, or there is none.

        Notes
        -----
        All counts stay. Halfedges keep their indices and faces, and run the other way; faces begin at the same corner;
        halfedge data stay with their corners. Doing it twice undoes it. O(component).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2], [3, 4, 5]])
        >>> mesh.reverse_component(0)
        >>> mesh.triangles().tolist()
        [[0, 2, 1], [3, 4, 5]]
        """
        v = self._index(Vertex, vertex)
        code = self._run_through(try_reverse_component, v)
        if code < 0:
            self._refuse("turn around the component of", code, ("vertex", v))

    def reverse(self) -> None:
        """Turn the orientation of the whole mesh around; see :meth:`reverse_component`. O(n).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> mesh.reverse()
        >>> round(hm.geometry.volume(mesh), 6)
        -1.0
        """
        self._run_through(reverse)

    def remove_component(self, vertex: Vertex | int) -> None:
        """Remove a component: all its vertices, edges and faces.

        Parameters
        ----------
        vertex : Vertex or int
            Any vertex of it.

        Raises
        ------
        StaleElementError, ElementError
            The vertex was deleted, or there is none.

        Notes
        -----
        Components - 1. O(component).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.Mesh([[0, 1, 2], [3, 4, 5, 6]])
        >>> mesh.remove_component(1)
        >>> mesh
        <Mesh: 4 vertices, 4 edges, 1 face, with boundary>
        """
        v = self._index(Vertex, vertex)
        code = self._run_through(try_remove_component, v)
        if code < 0:
            self._refuse("remove the component of", code, ("vertex", v))

    def append(self, other: Mesh) -> Maps:
        """Put a copy of another mesh behind the elements of this one; nothing is merged.

        Parameters
        ----------
        other : Mesh
            Stays as it is. It may be this mesh.

        Returns
        -------
        Maps
            The new index of each of its elements, by kind: ``vertices``, ``halfedges``, ``edges``, ``faces``; -1 for
            what was deleted there.

        Raises
        ------
        InvalidMeshError
            An attribute has another dtype or shape in the other mesh. Nothing was changed.
        TopologyError
            There would be more elements than int32 can number.

        Notes
        -----
        Attributes are united. One that the other mesh alone has comes with its default and policy, and has the default
        where this mesh was; one that this mesh alone has, has its default where the other is. Where both have it, the
        policy and default of this mesh hold. Of ``meta``, what this mesh has under the same key stays.

        Amortised O(size of the other mesh), and O(size of this one) for each attribute that is new to it.

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> mesh.append(hm.shapes.tetrahedron()).vertices.tolist()
        [8, 9, 10, 11]
        >>> mesh.n_connected_components, mesh.n_faces
        (2, 10)
        """
        if not isinstance(other, Wholes):
            raise TypeError(f"append takes a mesh, not {type(other).__name__}")
        tables = [(getattr(self, name), getattr(other, name)) for name in TABLES]
        for mine, others in tables:
            mine._check_fits(others)
        theirs, firsts = _living(other._topology), _sizes(self._topology)
        rows = [others._columns_in_use() for _, others in tables]  # before: both may be the same mesh
        code = self._run_through(try_append, other)
        if code < 0:
            self._refuse("append", code, ("a", "mesh"))
        for (mine, _), columns in zip(tables, rows, strict=True):
            mine._append(columns)
        self.has_points |= other.has_points
        for key, value in other._meta.items():
            self.meta.setdefault(key, deepcopy(value))
        return Maps(*(_behind(first, of) for first, of in zip(firsts, theirs, strict=True)))

    def submesh(
        self,
        faces: Iterable[Face | int] | NDArray[Any] | None = None,
        *,
        vertices: Iterable[Vertex | int] | NDArray[Any] | None = None,
    ) -> tuple[Self, Maps]:
        """Take a part out as a mesh of its own; this mesh stays as it is.

        Parameters
        ----------
        faces : iterable of Face or int, or array of bool
            The part is these faces, with their edges and vertices. A mask has an entry for each index.
        vertices : iterable of Vertex or int, or array of bool
            In place of faces: the part is what is left without all other vertices. These vertices, the edges that have
            both ends among them, wire too, and the faces that have all corners among them.

        Returns
        -------
        mesh : Mesh
            In the order of the indices here. With all attributes, their defaults and policies.
        maps : Maps
            The index there of each element here, ``-1`` for what was left out.

        Raises
        ------
        StaleElementError, ElementError
            One of them was deleted, or there is none.

        Notes
        -----
        The structure is kept as it is: loops, parallel edges, slits, and the order around each vertex. O(n).

        Examples
        --------
        >>> import halfmesh as hm
        >>> mesh = hm.shapes.cube()
        >>> part, maps = mesh.submesh([0, 2])
        >>> part
        <Mesh: 6 vertices, 7 edges, 2 faces, with boundary>
        >>> maps.faces
        array([ 0, -1,  1, -1, -1, -1], dtype=int32)
        >>> mesh.submesh(vertices=[0, 1])[0]
        <Mesh: 2 vertices, 1 edge, 0 faces, with boundary>
        """
        if (faces is None) == (vertices is None):
            raise TypeError("submesh takes either faces or vertices=")
        t = self._topology
        if faces is not None:
            kept = spanned_by_faces(t, self._mask(Face, faces))
        else:
            kept = spanned_by_vertices(t, self._mask(Vertex, vertices))
        topology, maps = extract(t, *kept)
        made = object.__new__(type(self))
        made._hold(topology)
        made.has_points, made.build_seconds, made.meta = self.has_points, 0.0, deepcopy(self._meta)
        of_kinds = (maps.vertices, maps.halfedges, maps.edges, maps.faces)
        for name, new_of_old in zip(TABLES, of_kinds, strict=True):
            getattr(made, name)._adopt(getattr(self, name)._columns_of(np.flatnonzero(new_of_old >= 0)))
        return made, maps

    # -- what they share -------------------------------------------------------------------------------------------

    def _run_through(self, kernel: Any, *args: Any) -> int:
        """Run what goes over much of the mesh."""
        return self._run(kernel, 10 * len(self._topology.next), *args)

    def _mask(self, kind: type[Element], elements: Any) -> NDArray[np.bool_]:
        """The elements as a mask. What is named must be alive; a mask that was computed may be true of the deleted."""
        marks = getattr(self._topology, kind.column)
        if not isinstance(elements, np.ndarray):
            elements = list(elements)
            if not all(type(x) is int for x in elements):
                resolve = getattr(self, kind.plural).resolve
                elements = [resolve(x) for x in elements]
            try:
                elements = np.array(elements, dtype=np.int64)
            except OverflowError:
                elements = [getattr(self, kind.plural).resolve(x) for x in elements]  # raises for what is no index
        if elements.dtype == bool:
            if elements.shape != marks.shape:
                raise ElementError(f"a mask of {kind.plural} has {len(marks)} entries here; got {elements.shape}")
            mask: NDArray[np.bool_] = elements & (marks != DELETED)
            return mask
        chosen = _as_indices(kind, elements, len(marks))
        dead = chosen[marks[chosen] == DELETED]
        if len(dead):
            raise StaleElementError(f"{kind.kind} {dead[0]} was deleted")
        made = np.zeros(len(marks), dtype=bool)
        made[chosen] = True
        return made

    def _hold(self, topology: Topology) -> None:
        """What `Mesh` does: take the topology for its own."""
        raise NotImplementedError


def _as_indices(kind: type[Element], elements: NDArray[Any], n: int) -> NDArray[np.int64]:
    if elements.size == 0:
        return np.zeros(0, dtype=np.int64)
    if elements.ndim != 1 or elements.dtype.kind not in "iu":
        raise ElementError(f"expected {kind.plural}: indices or a mask; got {elements.dtype} {elements.shape}")
    wild = elements[(elements < 0) | (elements >= n)]
    if len(wild):
        raise ElementError(f"no {kind.kind} {wild[0]}; there are {n} indices, from 0")
    return elements.astype(np.int64)


def _sizes(t: Topology) -> tuple[int, int, int, int]:
    return len(t.vertex_halfedge), len(t.next), len(t.next) // 2, len(t.face_halfedge)


def _living(t: Topology) -> tuple[NDArray[np.bool_], ...]:
    alive = t.next != DELETED
    return t.vertex_halfedge != DELETED, alive, alive[::2], t.face_halfedge != DELETED


def _behind(first: int, alive: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Where elements are that were put behind others, the dead nowhere."""
    return np.where(alive, np.arange(first, first + len(alive)), -1).astype(np.int32)
