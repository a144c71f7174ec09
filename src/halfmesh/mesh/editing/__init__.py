"""The methods of :class:`halfmesh.Mesh` that change it: each resolves its elements, acts, and explains a no."""

from halfmesh.mesh.editing.building import Building
from halfmesh.mesh.editing.bulk import Bulk
from halfmesh.mesh.editing.faces import Faces
from halfmesh.mesh.editing.holes import Holes
from halfmesh.mesh.editing.local import Local
from halfmesh.mesh.editing.seams import Seams
from halfmesh.mesh.editing.vertices import Vertices
from halfmesh.mesh.editing.wholes import Wholes

__all__ = ["Editable"]


class Editable(Building, Bulk, Local, Faces, Vertices, Holes, Seams, Wholes):
    """All operators of a mesh."""
