"""How many of what: the counts of a mesh and what follows from them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from halfmesh.core import counting, tables
from halfmesh.core.topology import (
    EDGE_SLOTS,
    FACE_SLOTS,
    N_DEAD_EDGES,
    N_DEAD_FACES,
    N_DEAD_VERTICES,
    N_EXTERIOR,
    REVISION,
    VERTEX_SLOTS,
    Topology,
)

__all__ = ["Counted"]

R = TypeVar("R")


class Counted:
    """The part of a mesh that counts: living elements in O(1), the rest in O(n) after a change and then kept."""

    _topology: Topology
    _t: Any  # the same, as the interpreted carrier
    _cache: dict[str, tuple[int, Any]]

    @property
    def revision(self) -> int:
        """Increases with every change of the connectivity; writing into `points` is not one."""
        return self._t.counts[REVISION]  # type: ignore[no-any-return]

    def _count(self, slots: int, dead: int) -> int:
        counts = self._t.counts
        return counts[slots] - counts[dead]  # type: ignore[no-any-return]

    @property
    def n_vertices(self) -> int:
        """Number of vertices. O(1)."""
        return self._count(VERTEX_SLOTS, N_DEAD_VERTICES)

    @property
    def n_edges(self) -> int:
        """Number of edges. O(1)."""
        return self._count(EDGE_SLOTS, N_DEAD_EDGES)

    @property
    def n_faces(self) -> int:
        """Number of faces. O(1)."""
        return self._count(FACE_SLOTS, N_DEAD_FACES)

    @property
    def n_halfedges(self) -> int:
        """Number of halfedges, exterior ones included: twice the edges. O(1)."""
        return 2 * self.n_edges

    @property
    def n_exterior_halfedges(self) -> int:
        """Number of halfedges without a face. O(1)."""
        return self._t.counts[N_EXTERIOR]  # type: ignore[no-any-return]

    @property
    def n_interior_halfedges(self) -> int:
        """Number of halfedges with a face: the sum of the face degrees. O(1)."""
        return self.n_halfedges - self.n_exterior_halfedges

    @property
    def n_interior_vertices(self) -> int:
        """Number of vertices that faces close all around. O(n) after a change, then kept."""
        return self._kept("kinds", counting.vertex_kinds)[0]

    @property
    def n_boundary_vertices(self) -> int:
        """Number of vertices that touch a gap, those on wire included. O(n) after a change, then kept."""
        return self._kept("kinds", counting.vertex_kinds)[1]

    @property
    def n_isolated_vertices(self) -> int:
        """Number of vertices without an edge. O(n) after a change, then kept."""
        return self._kept("kinds", counting.vertex_kinds)[2]

    @property
    def n_boundary_loops(self) -> int:
        """Number of boundary loops. O(n) after a change, then kept."""
        return len(self._kept("loops", counting.boundary_loops)[1]) - 1

    @property
    def n_connected_components(self) -> int:
        """Number of connected components, isolated vertices among them. O(n) after a change, then kept."""
        return len(self.components())

    @property
    def has_boundary(self) -> bool:
        """Whether any halfedge is exterior. O(1)."""
        return self.n_exterior_halfedges > 0

    @property
    def euler_characteristic(self) -> int:
        """V - E + F. O(1). The sum over the components: see `components` for each."""
        return self.n_vertices - self.n_edges + self.n_faces

    @property
    def genus(self) -> int:
        """Handles, summed over the components with their holes capped. O(n) after a change, then kept."""
        return int(self.components().genus.sum())

    @property
    def is_triangular(self) -> bool:
        """Whether all faces are triangles. O(n) after a change, then kept."""
        return bool(self._kept("triangular", lambda t: bool((tables.face_degrees(t)[t.face_halfedge >= 0] == 3).all())))

    def components(self) -> counting.Components:
        """The connected components: counts, Euler characteristic, genus and boundary loops of each.

        Returns
        -------
        Components
            With the component of each vertex. O(n) after a change, then kept.

        Examples
        --------
        >>> import halfmesh as hm
        >>> both = hm.Mesh([[0, 1, 2], [3, 4, 5, 6]], n_vertices=8)
        >>> both.components().n_faces
        array([1, 1, 0])
        """
        return self._kept("components", counting.components)

    def _kept(self, name: str, compute: Callable[[Topology], R]) -> R:
        """A result that is computed again only after the connectivity has changed."""
        revision, value = self._cache.get(name, (-1, None))
        if revision != self.revision:
            value = compute(self._topology)
            self._cache[name] = (self.revision, value)
        return value  # type: ignore[no-any-return]
