"""Why an operator says no: a code for kernels, with the name and the sentence that Python raises it with.

``flip_status(t, e)`` gives ``OK`` or one of these codes, and changes nothing. ``try_flip(t, e)`` acts if it may, and
gives the negative code if it may not: codes are positive, so that a negative result is always a refusal.
"""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["DELETED_ELEMENT", "MISSING_ELEMENT", "OK", "REASONS", "Reason"]


class Reason(NamedTuple):
    """The stable name of a refusal, and what it says: why, and what would help."""

    name: str
    sentence: str


REASONS: dict[int, Reason] = {}


def _reason(name: str, sentence: str) -> int:
    code = len(REASONS) + 1
    REASONS[code] = Reason(name, sentence)
    return code


OK = 0
MISSING_ELEMENT = _reason("missing_element", "there is no such element")
DELETED_ELEMENT = _reason("deleted_element", "the element was deleted")
TOO_LARGE = _reason("too_large", "the mesh would have more elements than int32 can number; work on parts of it")

# flip
BOUNDARY_EDGE = _reason("boundary_edge", "the edge has a face on one side only, or on none; it takes two faces")
SAME_FACE = _reason("same_face", "the same face lies on both sides of the edge")
SMALL_FACE = _reason("small_face", "a face beside the edge has fewer than three sides")
WOULD_BE_LOOP = _reason(
    "would_be_loop", "an edge would join a vertex to itself; allow_parallel=True if that is what you want"
)
WOULD_BE_PARALLEL = _reason(
    "would_be_parallel", "two edges would join the same vertices; allow_parallel=True if that is what you want"
)

# collapse
LOOP_EDGE = _reason("loop_edge", "the edge joins a vertex to itself, and can't be contracted")
WOULD_PINCH = _reason(
    "would_pinch", "both ends touch a gap but the edge does not run along one: the surface would be pinched at a vertex"
)
WOULD_PINCH_FACE = _reason(
    "would_pinch_face", "another face has both ends among its corners and would pass a vertex twice"
)
WOULD_LEAVE_WIRE = _reason(
    "would_leave_wire", "the triangle beside the edge hangs on by nothing else, and would become wire; remove the face"
)
WOULD_CLOSE_HOLE = _reason(
    "would_close_hole", "the hole beside the edge has so few sides that it would close to two edges; fill it first"
)
WOULD_FOLD = _reason("would_fold", "two triangles would come to lie back to back on the same three vertices")
SHARED_APEX = _reason("shared_apex", "the triangles on both sides of the edge share their third corner")

# split and connect
SAME_CORNER = _reason("same_corner", "the two halfedges are the same one")
DIFFERENT_FACES = _reason("different_faces", "the two halfedges are not around the same face")
NO_FACE = _reason("no_face", "the halfedge has no face on its left")

# building
CLOSED_VERTEX = _reason(
    "closed_vertex", "faces close all around the vertex, and no edge fits in; remove a face there to open a gap"
)
NOT_A_CHAIN = _reason("not_a_chain", "a halfedge does not leave the vertex that the one before arrives at")
TAKEN_HALFEDGE = _reason(
    "taken_halfedge",
    "a halfedge has a face on its left already; use its twin (turn the face around), or remove that face",
)
REPEATED_HALFEDGE = _reason("repeated_halfedge", "a halfedge is listed twice; a face runs along each of them once")
NO_GAP = _reason(
    "no_gap",
    "the two halfedges can't follow each other: that would cut the faces and edges between them off from the rest "
    "around their vertex; give one of the parts a vertex of its own",
)
EMPTY_FACE = _reason("empty_face", "a face has one side at least, and the list is empty")
FEW_VERTICES = _reason(
    "few_vertices", "a face takes three vertices at least; faces of one or two sides are added by their halfedges"
)
REPEATED_VERTEX = _reason(
    "repeated_vertex", "a vertex is listed twice in succession; a side along a loop edge is given by its halfedge"
)

# vertices
DIFFERENT_VERTICES = _reason("different_vertices", "the two halfedges do not leave the same vertex")
ISOLATED_VERTEX = _reason("isolated_vertex", "no edge touches the vertex; remove_vertex takes it away")
SEVERAL_GAPS = _reason(
    "several_gaps", "the vertex touches more than one gap, so the faces around it can't become one; unweld it first"
)

# holes
NOT_EXTERIOR = _reason("not_exterior", "a halfedge has a face on its left; it takes one that runs along a hole")
DIFFERENT_LOOPS = _reason("different_loops", "the two halfedges do not run along the same hole")

# seams and loops
NOT_TRIANGLE = _reason("not_triangle", "a face beside the edge is not a triangle of three edges; split_edge takes any")
NOT_TWO_SIDED = _reason("not_two_sided", "the hole does not lie between two edges; fill_hole, or stitch edge by edge")
SAME_VERTEX = _reason("same_vertex", "the two halfedges leave the same vertex already")
SAME_EDGE = _reason("same_edge", "the two halfedges are the sides of one edge already")
NOT_A_CYCLE = _reason(
    "not_a_cycle", "the halfedges do not run around once, through vertices that faces close all around and none twice"
)
DIFFERENT_DEGREES = _reason("different_degrees", "the two faces have not equally many sides; split their edges first")
SHARED_VERTEX = _reason("shared_vertex", "the two faces have a vertex in common, where the surface would be pinched")
