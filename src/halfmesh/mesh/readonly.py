"""Meshes that are only read, and held in fewer bytes than those that can be edited."""

from __future__ import annotations

import weakref
from copy import deepcopy
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from halfmesh.compact.carrier import Computed
from halfmesh.core.topology import EDGE_SLOTS, FACE_SLOTS, VERTEX_SLOTS, Topology
from halfmesh.errors import ElementError
from halfmesh.mesh.asking import Asked
from halfmesh.mesh.attributes import AttributeTable
from halfmesh.mesh.bound import BOUND
from halfmesh.mesh.editing.base import TABLES
from halfmesh.mesh.mesh import Mesh

__all__ = ["ReadOnlyMesh", "refuse_others"]

Floats = NDArray[np.float64]


class ReadOnlyMesh(Asked):
    """What meshes that are only read have in common: all that is asked, nothing that changes."""

    _family = BOUND
    has_points: bool
    build_seconds: float

    def _hold(self, topology: Computed, points: Floats, has_points: bool) -> None:
        self._topology: Any = topology
        self._t = topology.__views__()
        self._cache: dict[str, tuple[int, Any]] = {}
        self.meta: dict[str, Any] = {}
        counts = self._t.counts
        self.vertex_data = AttributeTable("vertex", lambda: counts[VERTEX_SLOTS], ("points",))
        self.halfedge_data = AttributeTable("halfedge", lambda: 2 * counts[EDGE_SLOTS])
        self.edge_data = AttributeTable("edge", lambda: counts[EDGE_SLOTS])
        self.face_data = AttributeTable("face", lambda: counts[FACE_SLOTS])
        self._t.mesh, self._t.vertex_data = weakref.ref(self), self.vertex_data
        self.vertex_data._keep("points", points)
        self.has_points = has_points

    @property
    def points(self) -> Floats:
        """Positions of the vertices, shape (n, 3), float64: a view, writing into it moves vertices."""
        return self.vertex_data["points"]

    @property
    def topology_nbytes(self) -> int:
        """Bytes of the connectivity."""
        return self._topology.nbytes  # type: ignore[no-any-return]

    @property
    def nbytes(self) -> int:
        """Bytes of the connectivity and of all attributes, the points among them."""
        return self.topology_nbytes + sum(int(getattr(self, name).nbytes) for name in TABLES)

    def check(self) -> None:
        """Check every law of a valid mesh, on the ordinary mesh that it stands for. O(n), with the memory of that.

        Raises
        ------
        InvalidMeshError
            Naming the law and the elements that break it.
        """
        self.to_mesh().check()

    def copy(self) -> Self:
        """A copy with points and attributes of its own; the connectivity, which can't change, is shared."""
        made = object.__new__(type(self))
        made.__dict__.update(self.__dict__)
        made._hold(self._topology.shared(), self.points.copy(), self.has_points)
        for name in TABLES:
            getattr(made, name)._adopt(getattr(self, name)._columns_in_use())
        made.meta = deepcopy(self.meta)
        return made

    __copy__ = copy

    def to_mesh(self) -> Mesh:
        """An ordinary mesh, with the same vertices, edges and faces by number. O(n)."""
        made: Mesh = object.__new__(Mesh)
        made._hold(self._expanded())
        made.has_points, made.build_seconds, made.meta = self.has_points, 0.0, {}
        made.vertex_data._keep("points", self.points.copy())
        return made

    def _expanded(self) -> Topology:
        return self._topology.expanded()  # type: ignore[no-any-return]

    def __getstate__(self) -> dict[str, Any]:
        state: dict[str, Any] = {name: getattr(self, name)._columns_in_use() for name in TABLES}
        remarks = {"has_points": self.has_points, "seconds": self.build_seconds, "meta": self.meta}
        return state | {"topology": self._topology} | remarks

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._hold(state["topology"], state["vertex_data"]["points"].values, state["has_points"])
        for name in TABLES:
            getattr(self, name)._adopt(state[name])
        self.build_seconds, self.meta = state["seconds"], state["meta"]


def refuse_others(mesh: Any, kind: str) -> None:
    """Raise unless it is an ordinary mesh, from which alone the others are made."""
    if not isinstance(mesh, Mesh):
        remedy = "mesh.to_mesh() gives one" if isinstance(mesh, Asked) else "Mesh(faces, points) makes one"
        raise ElementError(f"{kind}(mesh) takes a Mesh, not {type(mesh).__name__}; {remedy}")
