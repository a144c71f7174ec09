"""Representations that are only read: the words of `core.navigation`, and fewer bytes."""

from halfmesh.compact.triangles import TriangleTopology

__all__ = ["TriangleTopology"]
