"""Defects of the library that are known and not repaired: the twin has them too, so that a walk can find others.

`test_rotation` holds a test of each that is expected to fail; it says when a line here is to go.
"""

KNOWN = {
    "glue what is gone",  # both sides of one edge, of which the first stitch takes the other away
}
