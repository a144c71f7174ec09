"""Numbers in files: the bits of ``float()`` in, the text of ``repr`` out, in every gear."""

from __future__ import annotations

import math
import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from halfmesh import io
from halfmesh.errors import FormatError
from halfmesh.io.numbers import DECIMAL, INTEGER, UNDECIDED, number, number_from_text, powers_of_ten
from halfmesh.io.shortest import MOST_BYTES, UNWRITTEN, number_to_text, write_number
from halfmesh.io.source import PADDING
from halfmesh.io.text_writing import Table, row_text

COMPILED, INTERPRETED = number.at(10**9), number._quick  # as small and large files are read
WRITE = write_number.at(10**9)
GEARS = [COMPILED, INTERPRETED]
FLOATS = st.floats(allow_nan=False) | st.integers(0, 2**64 - 1).map(
    lambda i: struct.unpack("<d", struct.pack("<Q", i))[0]
)
MANTISSA = st.from_regex(r"[0-9]{0,25}\.?[0-9]{0,25}", fullmatch=True).filter(lambda s: any(c.isdigit() for c in s))
DECIMALS = st.tuples(st.sampled_from(["", "-", "+"]), MANTISSA, st.just("") | st.integers(-340, 330).map("e{}".format))


def bits(x: float) -> bytes:
    return struct.pack("<d", x)


def parsed(gear: object, text: str) -> tuple[float | None, int]:
    padded = np.frombuffer(text.encode() + b"\n" * PADDING, dtype=np.uint8).copy()
    n = len(padded) - PADDING
    value, end, kind = gear(padded, 0, n, powers_of_ten())  # type: ignore[operator]
    assert end == n
    return (number_from_text(text.encode()) if kind == UNDECIDED else float(value)), int(kind)


@given(FLOATS.filter(lambda x: not math.isnan(x)))
@example(5e-324)
@example(1.7976931348623157e308)
@example(9007199254740993.0)
def test_repr_reads_back_to_the_same_bits(x: float) -> None:
    for gear in GEARS:
        value, _ = parsed(gear, repr(x))
        assert value is not None
        assert bits(value) == bits(x)


@given(DECIMALS)
@example(("", "9007199254740993", ""))  # halfway between two floats
@example(("", "8.5", "e22"))
@example(("-", "0", ""))
@example(("", "0.000000000000000000000000000000000000000000000001", ""))
@example(("", "123456789012345678901234567890", "e-20"))
def test_any_decimal_reads_as_float_reads_it(parts: tuple[str, str, str]) -> None:
    text = "".join(parts)
    for gear in GEARS:
        value, _ = parsed(gear, text)
        assert value is not None
        assert bits(value) == bits(float(text))


@given(st.integers(1, 10**18), st.integers(-40, 40))
def test_both_gears_decide_alike(w: int, e: int) -> None:
    text = f"{w}e{e}"
    assert parsed(COMPILED, text) == parsed(INTERPRETED, text)


@pytest.mark.parametrize("text", ["nan", "NaN", "-inf", "+Infinity", "1e400", "-1e-400"])
def test_words_and_overflow_are_those_of_float(text: str) -> None:
    value, kind = parsed(COMPILED, text)
    assert kind == UNDECIDED
    assert value is not None
    assert value == float(text) or (math.isnan(value) and math.isnan(float(text)))


@pytest.mark.parametrize(
    "text", ["0x1p3", "1_000", "1,5", "1d5", "--1", "+", ".", "e5", "1e", "1e+", "1.2.3", "nan(ind)", "1X", "\u0661"]
)
def test_what_is_no_decimal_number_is_refused(text: str, tmp_path: Path) -> None:
    assert parsed(COMPILED, text) == (None, UNDECIDED)
    (tmp_path / "a.obj").write_bytes(b"v 0 0 " + text.encode() + b"\n")
    with pytest.raises(FormatError, match=r"line 1: expected a number"):
        io.read(tmp_path / "a.obj")


@pytest.mark.parametrize("text", ["1.#IND", "-1.#INF", "1.#QNAN"])
def test_not_a_number_of_windows_is_no_one_with_a_comment(text: str, tmp_path: Path) -> None:
    (tmp_path / "a.off").write_text(f"OFF\n1 0 0\n{text} 0 0\n")
    with pytest.raises(FormatError, match="line 3: expected a number"):
        io.read(tmp_path / "a.off")


def test_a_comment_may_touch_a_number(tmp_path: Path) -> None:
    (tmp_path / "a.off").write_text("OFF\n1 0 0#counts\n1 2 3#first\n")
    assert io.read(tmp_path / "a.off")[1].tolist() == [[1, 2, 3]]


def test_integers_and_decimals_are_told_apart() -> None:
    assert [parsed(COMPILED, text)[1] for text in ("12", "-0", "12.", "1e3")] == [INTEGER, INTEGER, DECIMAL, DECIMAL]


def test_a_number_of_a_megabyte_takes_linear_time() -> None:
    digits = "1" * 1_000_000
    assert parsed(COMPILED, f"0.{digits}")[0] == float(f"0.{digits}")


# ---------------------------------------------------------------------------------------------------------- writing


def written(gear: object, x: float, dotted: bool = False) -> str | None:
    out = np.zeros(MOST_BYTES + 2, dtype=np.uint8)
    end = gear(x, dotted, out, 0, powers_of_ten())  # type: ignore[operator]
    assert end <= MOST_BYTES
    return None if end == UNWRITTEN else bytes(out[:end]).decode()


@given(FLOATS)
@example(0.3)
@example(2.0**-44)
@example(123456789012345680.0)
@example(1e16)
@example(0.0001)
@example(-0.0)
@example(9007199254740992.0)
def test_the_text_is_that_of_repr(x: float) -> None:
    texts = {written(gear, x) for gear in (WRITE, write_number._quick)}
    assert len(texts) == 1
    assert texts <= {None, repr(x).removesuffix(".0")}


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_ordinary_numbers_are_hardly_ever_left_to_python(dtype: type) -> None:
    values = np.random.default_rng(1).normal(size=2000).astype(dtype).astype(np.float64)
    assert sum(written(WRITE, x) is None for x in values.tolist()) <= 10


@given(st.integers(-(10**6), 10**6).map(lambda i: i / 1000))
def test_few_digits_stay_few(x: float) -> None:
    assert written(WRITE, x) == number_to_text(x)


def test_floats_that_are_whole_can_be_marked_as_floats() -> None:
    assert [written(WRITE, 2.0, dotted) for dotted in (False, True)] == ["2", "2.0"]


@given(st.lists(FLOATS | st.sampled_from([math.nan, math.inf, -math.inf]), min_size=3, max_size=60))
def test_any_points_survive_a_file_to_the_bit(tmp_path_factory: pytest.TempPathFactory, values: list[float]) -> None:
    points = np.array(values[: len(values) // 3 * 3]).reshape(-1, 3)
    points[np.isnan(points)] = np.nan  # the payload of a NaN has no text
    for suffix in (".off", ".obj"):
        path = tmp_path_factory.getbasetemp() / f"points{suffix}"
        io.write(path, np.zeros((0, 3), dtype=int), points)
        assert io.read(path)[1].tobytes() == points.tobytes()


def test_rows_of_all_magnitudes_have_the_text_of_repr() -> None:
    rng = np.random.default_rng(4)
    near = 10.0 ** np.arange(-3, 9)
    values = np.concatenate(
        [rng.normal(size=600), np.round(rng.normal(size=300) * 1000, 3), 10.0 ** rng.uniform(-12, 12, 600), near,
         np.nextafter(near, 0), np.nextafter(near, 1e9), np.arange(300) / 64, np.float32(rng.normal(size=300)),
         [1 - 2**-53, 0, -0.0]]
    )  # fmt: skip
    values[::2] *= -1
    text = b"".join(bytes(piece) for piece in row_text(Table(values.reshape(-1, 3)))).decode()
    assert text.split() == [number_to_text(x) for x in values.tolist()]
