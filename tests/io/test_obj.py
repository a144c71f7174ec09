"""Wavefront OBJ: what belongs to a mesh is kept (IO5)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from halfmesh import io
from halfmesh.errors import FormatError

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


@pytest.fixture
def parse(tmp_path: Path):  # type: ignore[no-untyped-def]
    def parse(text: str | bytes) -> io.MeshData:
        (tmp_path / "a.obj").write_bytes(text if isinstance(text, bytes) else text.encode())
        return io.read_data(tmp_path / "a.obj")

    return parse


def test_polygons_count_from_one(parse) -> None:  # type: ignore[no-untyped-def]
    data = parse(SQUARE + "f 1 2 3 4\n")
    assert data.faces.tolist() == [[0, 1, 2, 3]]


def test_negative_indices_count_backwards_from_their_line(parse) -> None:  # type: ignore[no-untyped-def]
    data = parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -2 -1\n")
    assert data.faces.tolist() == [[0, 1, 2], [0, 2, 3]]


def test_faces_may_come_before_their_vertices(parse) -> None:  # type: ignore[no-untyped-def]
    assert parse("f 1 2 3\n" + SQUARE).faces.tolist() == [[0, 1, 2]]


def test_corners_have_texture_coordinates_and_normals(parse) -> None:  # type: ignore[no-untyped-def]
    data = parse(SQUARE + "vt 0 0\nvt .5 1\nvn 0 0 1\nf 1/1/1 2/2/1 3//1\nf 1/-1 3 4\n")
    nan = np.nan
    np.testing.assert_array_equal(
        data.halfedge["texcoord"], [[0, 0], [0.5, 1], [nan, nan], [0.5, 1], [nan, nan], [nan, nan]]
    )
    np.testing.assert_array_equal(data.halfedge["normal"], [[0, 0, 1]] * 3 + [[nan] * 3] * 3)


def test_references_to_normals_that_no_line_gives_are_left_out(parse) -> None:  # type: ignore[no-untyped-def]
    assert parse(SQUARE + "f 1//1 2//2 3//3\n").halfedge == {}


def test_colours_and_weights_behind_the_coordinates(parse) -> None:  # type: ignore[no-untyped-def]
    assert parse("v 1 2 3 .5 0 1\n").vertex["color"].tolist() == [[0.5, 0, 1]]
    assert parse("v 1 2 3 4\nv 1 2 3\n").vertex["w"].tolist() == [4, 1]
    assert parse("v 1 2 3 255 0 1\n").vertex["color"].dtype == np.uint8


@pytest.mark.parametrize("joint", [" \\\n", " \\\r\n", " \\\r", "\\\n "])
def test_a_backslash_joins_lines(parse, joint: str) -> None:  # type: ignore[no-untyped-def]
    data = parse(SQUARE + f"f 1 2{joint}3{joint}4\n")
    assert data.faces.tolist() == [[0, 1, 2, 3]]


def test_a_comment_ends_with_its_line_backslash_or_not(parse) -> None:  # type: ignore[no-untyped-def]
    assert parse("# C:\\models\\\nv 1 2 3\n").n_vertices == 1


def test_a_backslash_at_the_end_of_the_file_joins_nothing(parse) -> None:  # type: ignore[no-untyped-def]
    assert parse(SQUARE + "f 1 2 3 \\").n_faces == 1


def test_labels_of_faces_with_their_names(parse) -> None:  # type: ignore[no-untyped-def]
    data = parse(
        "mtllib a.mtl\no one\n" + SQUARE + "f 1 2 3\ng left side\nusemtl red\ns 4\nf 1 3 4\no two\ng right\ns off\n"
        "f 2 3 4\ng left side\nf 1 2 4\n"
    )
    assert data.face["object"].tolist() == [0, 0, 1, 1]
    assert data.face["group"].tolist() == [-1, 0, 1, 0]
    assert data.face["material"].tolist() == [-1, 0, 0, 0]
    assert data.face["smoothing"].tolist() == [0, 4, 0, 0]
    assert data.meta["groups"] == ["left side", "right"]
    assert (data.meta["objects"], data.meta["materials"]) == (["one", "two"], ["red"])
    assert data.meta["material_libraries"] == ["a.mtl"]


def test_lines_make_wire_and_points_are_counted(parse) -> None:  # type: ignore[no-untyped-def]
    data = parse(SQUARE + "l 1 2 3\nl 4/1 -4\np 1 2\n")
    assert data.edges.tolist() == [[0, 1], [1, 2], [3, 0]]
    assert data.meta["n_point_elements"] == 2


def test_other_keywords_are_counted(parse) -> None:  # type: ignore[no-untyped-def]
    data = parse(SQUARE + "vp 1 2\ncstype bezier\nvp 3 4\nThis is no comment\n")
    assert data.meta["ignored"] == {"vp": 2, "cstype": 1, "This": 1}


@pytest.mark.parametrize("end", ["\r\n", "\r", " \n", "\t# c\n", "\v\n", "\n\n"])
def test_line_ends(parse, end: str) -> None:  # type: ignore[no-untyped-def]
    data = parse((SQUARE + "f 1 2 3\n").replace("\n", end))
    assert (data.n_vertices, data.faces.tolist()) == (4, [[0, 1, 2]])


@pytest.mark.parametrize(
    ("text", "line", "reason"),
    [
        ("", None, "empty"),
        ("hello world\n", None, "no vertex"),
        ("v 1 2\n", 1, "too few numbers"),
        ("v 1 2 3 4 5\n", 1, "left over"),
        ("v 1 2 3 4 5 6 7 8\n", 1, "left over"),
        ("v 1 2 x\n", 1, "expected a number, found 'x'"),
        (SQUARE + "vn 1 2\n", 5, "too few"),
        (SQUARE + "vt\n", 5, "too few"),
        (SQUARE + "f 1 2 5\n", 5, "'5' refers to a vertex that is not there; the 4 vertices"),
        (SQUARE + "f 1 2 0\n", 5, "not there"),
        (SQUARE + "f 1 2 -5\n", 5, "not there"),
        (SQUARE + "f 1 2 99999999999999999999\n", 5, "not there"),
        (SQUARE + "f 1 2 3.0\n", 5, "in integers"),
        (SQUARE + "f 1/1/1/1 2 3\n", 5, "in integers"),
        (SQUARE + "f 1 2 x\n", 5, "in integers"),
        (SQUARE + "f /1 2 3\n", 5, "in integers"),
        (SQUARE + "vt 0 0\nf 1/2 2/1 3/1\n", 6, "texture coordinate that is not there"),
        (SQUARE + "vn 0 0 1\nf 1//2 2//1 3//1\n", 6, "normal that is not there"),
        (SQUARE + "f 1 2\n", 5, "fewer than 3"),
        (SQUARE + "f\n", 5, "fewer than 3"),
        (SQUARE + "l 1 9\n", 5, "not there"),
        (SQUARE + "p 9\n", 5, "not there"),
        (SQUARE + "s x\n", 5, "smoothing"),
        (SQUARE.replace("\n", "\r\n") + "f 1 \\\r\n 2 x\n", 6, "in integers"),
    ],
)
def test_malformed_text_is_refused_with_line_and_reason(parse, text: str, line: int | None, reason: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(FormatError) as caught:
        parse(text)
    assert reason in caught.value.reason
    assert caught.value.line == line


def test_nothing_beside_the_file_is_opened(parse, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    parse(f"mtllib {tmp_path}\nmtllib ../../no/such.mtl\n" + SQUARE)  # a folder would fail to open
