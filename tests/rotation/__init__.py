"""The slow obvious twin that changes: a rotation system with every operator of the library in its own language.

=============  =================================================================================================
``rings``      the mesh: cyclic lists of darts, its words, the few edits that operators are made of, the comparison
``building``   fans as beads on a string: edges, faces, and what is taken away
``edges``      flip, split, connect, join, collapse
``vertices``   split, join, weld, dissolve
``holes``      made, filled, grown into
``seams``      edges opened and closed, cuts and stitches
``loops``      what changes the genus
``wholes``     components and whole meshes
``table``      every operator: what it takes, refuses, does and promises
``drawing``    arguments from a stream of ints
``walking``    a mesh and its twin changed together, everything compared
=============  =================================================================================================

It is written from what the operators promise, not from how they are done.
"""

from .drawing import arguments, faces_to_add
from .rings import Rotation
from .table import BY_NAME, KERNELS, OPERATORS
from .walking import Walk

__all__ = ["BY_NAME", "KERNELS", "OPERATORS", "Rotation", "Walk", "arguments", "faces_to_add"]
