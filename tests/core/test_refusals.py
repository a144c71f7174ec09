"""What can't be held is refused with the reason and *all* the elements that have it (N1-N3, N5, R10)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import halfmesh as hm
from soups import SOUND

MOEBIUS = [[0, 1, 3, 2], [2, 3, 5, 4], [4, 5, 0, 1]]
KLEIN = [[3 * i + j, 3 * i + (j + 1) % 3, *far] for i in range(3) for j in range(3) for far in [
    (3 * (i + 1) + (j + 1) % 3, 3 * (i + 1) + j) if i < 2 else ((-j - 1) % 3, -j % 3)]]  # fmt: skip
TWO_CUBES_AT_A_CORNER = [
    [cube * 7 + v if v else 0 for v in face]
    for cube in (0, 1)
    for face in ([0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7])
]
TETRAHEDRON = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]

CASES = {
    "index beyond the points": (
        [[0, 1, 2], [2, 1, 9], [0, 9, 2]],
        "index_out_of_range",
        {"corners": [5, 7], "faces": [1, 2]},
    ),
    "negative index": ([[0, 1, -1], [2, 1, 3]], "index_out_of_range", {"corners": [2], "faces": [0]}),
    "two corners": ([[0, 1, 2], [0, 1], [2, 3], []], "small_face", {"faces": [1, 2, 3]}),
    "vertex twice in succession": (
        [[0, 1, 1], [2, 3, 4], [3, 5, 6, 3]],
        "repeated_vertex",
        {"corners": [1, 9], "faces": [0, 2], "vertices": [1, 3]},
    ),
    "one vertex only": ([[5, 5, 5]], "repeated_vertex", {"corners": [0, 1, 2], "faces": [0], "vertices": [5]}),
    "three faces at an edge": (
        [[0, 1, 2], [1, 0, 3], [0, 1, 4], [5, 6, 7]],
        "nonmanifold_edge",
        {"edges": [[0, 1]], "faces": [0, 1, 2]},
    ),
    "the same face twice": (
        [[0, 1, 2], [1, 2, 0]],
        "inconsistent_orientation",
        {"edges": [[0, 1], [2, 0], [1, 2]], "faces": [0, 1]},
    ),
    "neighbors of opposite orientation": (
        [[0, 1, 2], [1, 2, 3], [3, 4, 5]],
        "inconsistent_orientation",
        {"edges": [[1, 2]], "faces": [0, 1]},
    ),
    "Moebius strip": (MOEBIUS, "nonorientable", {"edges": [[0, 1]], "faces": [0, 2]}),
    "a face that passes an edge twice the same way": (
        [[0, 1, 2, 0, 1, 3]],
        "nonorientable",
        {"edges": [[0, 1]], "faces": [0]},
    ),
    "two cubes at a corner": (
        TWO_CUBES_AT_A_CORNER,
        "nonmanifold_vertex",
        {"vertices": [0], "faces": [0, 2, 5, 6, 8, 11]},
    ),
    "closed fan and a single face": (
        [*TETRAHEDRON, [3, 4, 5], [6, 0, 7]],
        "nonmanifold_vertex",
        {"vertices": [0, 3], "faces": [0, 1, 2, 3, 4, 5]},
    ),
}


@pytest.mark.parametrize(("faces", "reason", "elements"), CASES.values(), ids=CASES)
def test_refusal_names_the_reason_and_all_elements(faces, reason, elements):
    """N1, N2, N3, N5."""
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(faces, n_vertices=9 if reason == "index_out_of_range" else 16)
    assert caught.value.reason == reason
    assert {kind: caught.value.elements[kind].tolist() for kind in elements} == elements


def test_klein_bottle_is_refused_as_one_sided():
    """N1."""
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(KLEIN)
    assert caught.value.reason == "nonorientable"


def test_message_shows_the_count_the_first_few_and_what_would_help():
    """N3."""
    book = [[0, 1, page] for page in range(2, 12)]
    with pytest.raises(
        hm.InvalidMeshError, match=r"1 edge has more than two faces: 0-1 \(faces 0, 1, 2, .*10 in all.*remove"
    ):
        hm.Mesh(book)


@given(st.sampled_from(SOUND), st.data())
def test_faces_named_for_reversal_make_the_mesh_when_reversed(specimen, data):
    """N5: turn some faces of a sound mesh; what the error says to reverse repairs it."""
    turned = data.draw(st.sets(st.sampled_from(range(len(specimen.faces)))))
    faces = [face[::-1] if f in turned else list(face) for f, face in enumerate(specimen.faces)]
    n = specimen.figures.n_vertices
    try:
        hm.Mesh(faces, n_vertices=n)
    except hm.InvalidMeshError as error:
        for f in error.elements["reverse"]:
            faces[f].reverse()
    assert hm.Mesh(faces, n_vertices=n).n_faces == len(faces)


def test_smaller_side_is_named_for_reversal():
    faces = [list(face) for face in SOUND[1].faces]
    faces[4].reverse()
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(faces)
    assert caught.value.elements["reverse"].tolist() == [4]


def test_one_stray_index_does_not_allocate_gigabytes():
    """Without points the vertex count is never taken from an index far beyond the corners."""
    with pytest.raises(hm.InvalidMeshError, match="n_vertices") as caught:
        hm.Mesh([[0, 1, 2**31 - 5]])
    assert caught.value.elements["corners"].tolist() == [2]
    with pytest.raises(hm.InvalidMeshError, match="n_vertices"):
        hm.Mesh([[0, 1, 2]], edges=[[0, 2**31 - 5]])


@pytest.mark.parametrize(
    ("edges", "reason", "rows"),
    [
        ([[0, 3], [1, 1], [0, 9], [2, -1]], "index_out_of_range", [2, 3]),
        ([[0, 3], [1, 1], [2, 2]], "loop_edge", [1, 2]),
        ([[0, 3], [1, 0], [3, 0], [2, 3]], "parallel_edge", [1, 2]),
    ],
)
def test_wire_that_does_not_fit_is_refused_with_its_rows(edges, reason, rows):
    """N4."""
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh([[0, 1, 2]], n_vertices=5, edges=edges)
    assert (caught.value.reason, caught.value.elements["rows"].tolist()) == (reason, rows)


def test_closed_fan_made_by_twins_is_named():
    """Two closed fans at vertex 0: the same cones, one glued along its own sides, by explicit twins."""
    cones = [[0, 1, 2], [0, 2, 1], [0, 3, 4], [0, 4, 3]]
    twins = [5, -1, 3, 2, -1, 0, 11, -1, 9, 8, -1, 6]
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh(cones, twins=twins)
    assert caught.value.reason == "nonmanifold_vertex"
    assert caught.value.elements["vertices"].tolist() == [0]


def test_refusal_is_a_value_error_and_a_halfmesh_error():
    with pytest.raises(ValueError, match="out of range") as caught:
        hm.Mesh([[0, 1, 7]], n_vertices=3)
    assert isinstance(caught.value, hm.HalfmeshError)


def test_faces_that_repeat_others_are_named_first():
    with pytest.raises(
        hm.InvalidMeshError, match=r"^2 faces have the vertices of an earlier one \(2 like 0, 3 like 1\)"
    ) as caught:
        hm.Mesh([[0, 1, 2], [0, 2, 3], [1, 2, 0], [3, 0, 2]])
    assert caught.value.elements["repeats"].tolist() == [2, 3]


def test_nothing_is_called_a_repetition_that_is_none():
    with pytest.raises(hm.InvalidMeshError) as caught:
        hm.Mesh([[0, 1, 2], [0, 1, 3], [0, 1, 4]])
    assert "repeats" not in caught.value.elements


def test_swapped_arguments_are_told_apart():
    with pytest.raises(hm.InvalidMeshError, match=r"the order is Mesh\(faces, points\)"):
        hm.Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]]))
