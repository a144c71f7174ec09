"""Representations that are only read: the words of `core.navigation`, and fewer bytes.

::

    triangles . triangle_rules        26 bytes a triangle: origin and twin, the rest is arithmetic

    encoding                          4.6 bits an edge: two trees as balanced parentheses
       |
    decoding . files . checking
       |
    navigation . directory
       |
    parentheses . words . topology

    carrier                           what both are: a carrier that binds the rules anew
"""

from halfmesh.compact import navigation as navigation  # binds the rules: a pickled compact mesh imports this alone
from halfmesh.compact.triangles import TriangleTopology

__all__ = ["TriangleTopology"]
