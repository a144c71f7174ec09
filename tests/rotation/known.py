"""Defects of the library that are known and not repaired: the twin has them too, so that a walk can find others.

`test_rotation` holds a test of each that is expected to fail; it says when a line here is to go.
"""

KNOWN = {
    "what a stitch would close next",  # is a reason, where it is parallel to both sides
    "glue what is gone",  # both sides of one edge, of which the first stitch takes the other away
    "apex of a collapse is its target",  # a triangle comes to pass a vertex twice unnoticed
}
