"""The methods of :class:`halfmesh.Mesh` that change it: each resolves its elements, acts, and explains a no."""

from halfmesh.mesh.editing.building import Building
from halfmesh.mesh.editing.local import Local

__all__ = ["Editable"]


class Editable(Building, Local):
    """All operators of a mesh."""
