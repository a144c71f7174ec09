"""OFF in all the forms that are met (IO1, IO2, IO3)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from halfmesh import io
from halfmesh.errors import FormatError

TRIANGLE = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"

SEED = """
11  12  22
 0  0  0
 5434.9668391472287  0  0
 1934.3633489238321  4501.0628511691029  0
 0  10000  0
 0  4430.4242110758132  0
 7177.2771157039515  10000  0
 2082.4882032210944  10000  0
 3703.7846356429982  2339.6091203110768  0
 10000  10000  0
 10000  0  0
 6988.9064005448017  4883.8440215972032  0
 3      4     0     2
 3      3     2     6
 3      2     3     4
 3      6     2    10
 3      0     7     2
 3     10     7     1
 3      1     7     0
 3     10     1     9
 3     10     8     5
 3      8    10     9
 3      5     6    10
 3     10     2     7
"""


@pytest.fixture
def parse(tmp_path: Path):  # type: ignore[no-untyped-def]
    def parse(text: str | bytes) -> io.MeshData:
        (tmp_path / "a.off").write_bytes(text if isinstance(text, bytes) else text.encode())
        return io.read_data(tmp_path / "a.off")

    return parse


def refused(parse, text: str | bytes) -> FormatError:  # type: ignore[no-untyped-def]
    with pytest.raises(FormatError) as caught:
        parse(text)
    return caught.value


def assert_triangle(data: io.MeshData) -> None:
    assert data.indices.tolist() == [0, 1, 2]
    assert data.offsets.tolist() == [0, 3]
    assert data.points.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def test_the_example_of_the_seed_without_its_keyword(parse) -> None:  # type: ignore[no-untyped-def]
    data = parse(SEED)
    assert (data.n_vertices, data.n_faces) == (11, 12)
    assert data.points[1, 0] == 5434.9668391472287
    assert data.faces[-1].tolist() == [10, 2, 7]


@pytest.mark.parametrize(
    "head",
    [
        "OFF\n3 1 0\n",
        "OFF 3 1 0\n",
        "OFF3 1 0\n",
        "3 1 0\n",
        "OFF\n3 1\n",
        "OFF\n3\n1\n0\n",
        "\n\n# a\nOFF # b\n\n3 1 3 # c\n",
    ],
)
def test_headers(parse, head: str) -> None:  # type: ignore[no-untyped-def]
    assert_triangle(parse(head + TRIANGLE))


@pytest.mark.parametrize("end", ["\r\n", "\r", "\n\n", "\n \t\n", " # note\n", "#note\r\n", "\v\n", " \f\n"])
def test_line_ends(parse, end: str) -> None:  # type: ignore[no-untyped-def]
    assert_triangle(parse(("OFF\n3 1 0\n" + TRIANGLE).replace("\n", end)))


def test_the_mark_of_utf8_and_a_missing_last_line_end(parse) -> None:  # type: ignore[no-untyped-def]
    assert_triangle(parse(b"\xef\xbb\xbf" + ("OFF\n3 1 0\n" + TRIANGLE).rstrip().encode()))


@pytest.mark.parametrize(
    "body", ["0 0 0 1 0 0 0 1 0 3 0 1 2", "0 0\n0 1 0 0\n0 1 0 3\n0\n1 2\n", "0 0 0\n1 0 0\n0 1 0\n3\n0 1 2\n"]
)
def test_elements_may_share_or_span_lines(parse, body: str) -> None:  # type: ignore[no-untyped-def]
    assert_triangle(parse("OFF 3 1 0\n" + body))


def test_polygons_stay_polygons(parse) -> None:  # type: ignore[no-untyped-def]
    data = parse("OFF\n6 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\n4 0 1 2 3\n3 1 4 5\n")
    assert isinstance(data.faces, tuple)
    assert [a.tolist() for a in data.faces] == [[0, 1, 2, 3, 1, 4, 5], [0, 4, 7]]


def test_a_mesh_without_faces_or_without_anything(parse) -> None:  # type: ignore[no-untyped-def]
    assert parse("OFF\n2 0 0\n0 0 0\n1 0 0\n").points.shape == (2, 3)
    assert parse("OFF\n0 0 0\n").faces.shape == (0, 3)


def columns(data: io.MeshData) -> dict[str, list[object]]:
    return {name: values.tolist() for name, values in data.vertex.items()}


def test_coff_keeps_colours_as_they_are_written(parse) -> None:  # type: ignore[no-untyped-def]
    whole = parse("COFF 1 0 0\n1 2 3 255 0 7 255").vertex["color"]
    assert (whole.dtype, whole.tolist()) == (np.uint8, [[255, 0, 7, 255]])
    assert parse("COFF 1 0 0\n1 2 3 1.0 0 0 1").vertex["color"].dtype == np.float64
    assert parse("COFF 1 0 0\n1 2 3 255 0 7").vertex["color"].shape == (1, 3)


@pytest.mark.parametrize(
    ("keyword", "row", "expected"),
    [
        ("NOFF", "1 2 3 0 0 1", {"normal": [[0, 0, 1]]}),
        ("STOFF", "1 2 3 .5 .25", {"texcoord": [[0.5, 0.25]]}),
        ("4OFF", "1 2 3 4", {"w": [[4]]}),
        ("CNOFF", "1 2 3 0 0 1 9 8 7 6", {"normal": [[0, 0, 1]], "color": [[9, 8, 7, 6]]}),
        ("STCN4OFF", "1 2 3 4 0 0 1 9 8 7 6 .5 .25",
         {"w": [[4]], "normal": [[0, 0, 1]], "color": [[9, 8, 7, 6]], "texcoord": [[0.5, 0.25]]}),
        ("nOFF 5", "1 2 3 4 5", {"more_coordinates": [[4, 5]]}),
        ("4nOFF 3", "1 2 3 4", {"w": [[4]]}),
        ("OFF", "1 2 3 9 9", {"extra": [[9, 9]]}),
    ],
)  # fmt: skip
def test_columns_are_named_by_the_keyword(parse, keyword: str, row: str, expected: dict[str, object]) -> None:  # type: ignore[no-untyped-def]
    data = parse(f"{keyword} 1 0 0\n{row}\n")
    assert data.points.tolist() == [[1, 2, 3]]
    assert {name: np.reshape(values, (1, -1)).tolist() for name, values in data.vertex.items()} == expected


def test_two_dimensions_get_a_third(parse) -> None:  # type: ignore[no-untyped-def]
    assert parse("nOFF\n2\n1 0 0\n5 6\n").points.tolist() == [[5, 6, 0]]


@pytest.mark.parametrize(
    ("behind", "name", "values"),
    [
        ("255 0 0", "color", [[255, 0, 0]]),
        ("0.5 0 0 1", "color", [[0.5, 0, 0, 1]]),
        ("7", "color_index", [7]),
        ("nan 0 1", "color", [[np.nan, 0, 1]]),
    ],
)
def test_face_colours(parse, behind: str, name: str, values: object) -> None:  # type: ignore[no-untyped-def]
    data = parse(f"OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 {behind} # c\n")
    np.testing.assert_array_equal(data.face[name], values)


def test_faces_without_colour_among_coloured_ones_are_nan(parse) -> None:  # type: ignore[no-untyped-def]
    data = parse("OFF 3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 0 0\n3 0 2 1\n")
    np.testing.assert_array_equal(data.face["color"], [[1, 0, 0], [np.nan] * 3])


def words(order: str, colors: bool, tail: bytes = b"") -> bytes:
    header = np.array([4, 2, 0], order + "i4").tobytes()
    points = np.arange(12, dtype=order + "f4").tobytes()
    faces = b""
    for face in ([0, 1, 2], [0, 1, 2, 3]):
        faces += np.array([len(face), *face], order + "i4").tobytes()
        if colors:
            faces += np.array([3], order + "i4").tobytes() + np.array([1, 0.5, 0], order + "f4").tobytes()
    return b"OFF BINARY\n" + header + points + faces + tail


@pytest.mark.parametrize("order", "<>")
@pytest.mark.parametrize("colors", [False, True])
@pytest.mark.parametrize("tail", [b"", b"\n"])
def test_binary_of_either_byte_order_with_or_without_colours(parse, order: str, colors: bool, tail: bytes) -> None:  # type: ignore[no-untyped-def]
    data = parse(words(order, colors, tail))
    assert data.indices.tolist() == [0, 1, 2, 0, 1, 2, 3]
    assert data.offsets.tolist() == [0, 3, 7]
    assert data.points.tolist() == np.arange(12.0).reshape(4, 3).tolist()
    assert ("color" in data.face) == colors


def test_binary_that_fits_no_dialect_names_the_byte(parse) -> None:  # type: ignore[no-untyped-def]
    error = refused(parse, words(">", True)[:-2])
    assert error.offset is not None
    assert "dialect" in error.reason


# ------------------------------------------------------------------------------------------------------- refused


@pytest.mark.parametrize(
    ("text", "line", "reason"),
    [
        ("", None, "empty"),
        ("# nothing\n", None, "empty"),
        ("PLY\n3 1 0\n", 1, "expected 'OFF'"),
        ("OFF\nx 1 0\n", 2, "number of vertices"),
        ("OFF\n-3 1 0\n", 2, "number of vertices"),
        ("OFF\n1e9 1 0\n", 2, "number of vertices"),
        ("OFF\n3 1 x\n" + TRIANGLE, 2, "number of edges"),
        ("OFF\n3 1 0\n0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n", 4, "expected a number, found 'zero'"),
        ("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", 4, "ends too early"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n", 4, "has more than 3 numbers"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", 6, "refers to vertex 3"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", 6, "refers to vertex -1"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99999999999999999999\n", 6, "refers to vertex"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1.0\n", 6, "as integers"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", 6, "at least 3"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", 6, "ends too early"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 2 3 4 5\n", 6, "colour"),
        ("OFF\n3 1 0\n" + TRIANGLE + "3 0 2 1\n", 7, "correct the counts"),
        ("OFF\n3 2 0\n" + TRIANGLE, 7, "file ends inside face 1 of 2"),
        ("OFF\n3 1 0\r\n0 0 0\r1 0 0\n0 x 0\n3 0 1 2\n", 5, "found 'x'"),
        ("CCOFF\n1 0 0\n1 2 3\n", 1, "twice"),
        ("nOFF\n0\n1 0 0\n", 2, "dimensions"),
        ("{ LIST { OFF 3 1 0 } }", 1, "Geomview scene"),
        (b"\xff\xfeO\x00F\x00F\x00", None, "UTF-16"),
        ("OFF\n3 1 0\n0 0 \x000\n1 0 0\n0 1 0\n3 0 1 2\n", 3, "expected a number"),
    ],
)  # fmt: skip
def test_malformed_text_is_refused_with_line_and_reason(parse, text: str, line: int | None, reason: str) -> None:  # type: ignore[no-untyped-def]
    error = refused(parse, text)
    assert reason in error.reason
    assert error.line == line
    assert error.path.endswith("a.off")


@pytest.mark.parametrize("count", [2**31 - 1, 2**31, 2**32 - 1, 2**63 - 1, 2**64, 10**17, 10**400])
def test_huge_counts_are_refused_at_once(parse, count: int) -> None:  # type: ignore[no-untyped-def]
    for header in (f"OFF\n{count} 1 0\n", f"OFF\n3 {count} 0\n"):
        assert refused(parse, header + TRIANGLE).line == 2


def test_a_face_of_huge_degree_is_refused(parse) -> None:  # type: ignore[no-untyped-def]
    assert refused(parse, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2147483647 0 1 2\n").line == 6
