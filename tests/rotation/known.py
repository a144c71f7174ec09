"""Defects of the library that are known and not repaired: the twin has them too, so that a walk can find others.

`test_rotation` holds a test of each that is expected to fail; it says when a line here is to go.
"""

KNOWN = {
    "stitch at a shared end",  # edges beside both become parallel unnoticed
    "loop edge at the origin of a collapse",  # is taken for a parallel edge
    "apex of a collapse is its target",  # a triangle comes to pass a vertex twice unnoticed
}
