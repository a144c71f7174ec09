"""The object you hold: :class:`Mesh`, its handles and its attributes."""

from halfmesh.mesh.attributes import AttributeTable, Column
from halfmesh.mesh.collections import Collection
from halfmesh.mesh.elements import Edge, Element, Face, Halfedge, Vertex
from halfmesh.mesh.ids import Ids
from halfmesh.mesh.mesh import Mesh
from halfmesh.mesh.summary import Summary
from halfmesh.mesh.transactions import Transaction

__all__ = [
    "AttributeTable",
    "Collection",
    "Column",
    "Edge",
    "Element",
    "Face",
    "Halfedge",
    "Ids",
    "Mesh",
    "Summary",
    "Transaction",
    "Vertex",
]
