"""Whatever the bytes: a mesh or one of our exceptions, in time and memory proportional to the file (anchors 4.4)."""

from __future__ import annotations

import random
import time
import tracemalloc
from pathlib import Path

import io_manifest as manifest
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from halfmesh import _jit, io
from halfmesh.errors import FormatError, HalfmeshError, InvalidMeshError
from halfmesh.io import obj, off, source

OFF = (
    b"COFF\n# c\n4 2 0\r\n0 0 0 1 0 0 1\n1.5e3 0 0 0 1 0 1\n1 1 -nan 0 0 1 1 # d\n0 .25 0 1 1 1 1\n"
    b"3 0 1 2 255 0 0\n4 0 1 2 3\n"
)
OBJ = (
    b"mtllib a.mtl\no a\nv 0 0 0\nv 1 0 0 .5 .5 .5\nv 1 1e-3 0\r\nv 0 1 0\nvt 0 .5\nvn 0 0 1\ng b c\ns 1\n"
    b"f 1/1/1 2//1 \\\n 3\nusemtl m\nf -4 -2 -1 # e\nl 1 2 3\np 4\n"
)
BINARY = (
    b"OFF BINARY\n" + np.array([3, 1, 0], ">i4").tobytes() + np.arange(9, dtype=">f4").tobytes()
    + np.array([3, 0, 1, 2, 0], ">i4").tobytes()
)  # fmt: skip
NODE = b"# c\n4 2 1 1\n1 0 0 .5 1\n2  1 0 1.5 1 # d\r\n3 1 1 nan 0\n\n4 0 1 -3e-1 -7\n# e\n"
ELE = b"2 3 1\n1 1 2 3 10\n2 1 3 4 20\n"
NEIGH = b"2 3\n1 -1 2 -1\n2 -1 -1 1\n"
POLY = b"4 2 0 0\n0 0 0\n1 3 0\n2 3 3\n3 0 3\n2 1\n0 0 1 5\n1 1 2 6\n1\n0 1.5 1.5\n1\n0 .5 .5 7 .1\n"
SEEDS = {"text.off": OFF, "text.obj": OBJ, "binary.off": BINARY}
SEEDS |= {"pair.node": NODE, "pair.ele": ELE, "pair.neigh": NEIGH, "text.poly": POLY}


def outcome(path: Path, content: bytes) -> io.MeshData | None:
    """Read; None if refused in the one way allowed."""
    if path.name.startswith("pair"):
        for name in ("pair.node", "pair.ele", "pair.neigh"):
            path.with_name(name).write_bytes(SEEDS[name])
    path.write_bytes(content)
    try:
        data = io.read_data(path)
    except FormatError:
        return None
    except (InvalidMeshError, FileNotFoundError):  # triangles whose neighbors can't be told; an outline of no points
        assert path.suffix in {".neigh", ".poly"}
        return None
    assert data.offsets[0] == 0
    assert data.offsets[-1] == len(data.indices)
    assert (np.diff(data.offsets) >= 3).all()
    assert data.points.shape == (data.n_vertices, 3)
    for indices in (data.indices, data.edges):
        assert indices.size == 0 or 0 <= indices.min() <= indices.max() < data.n_vertices
    return data


@pytest.mark.parametrize("name", SEEDS)
def test_the_seeds_are_good(name: str, tmp_path: Path) -> None:
    assert outcome(tmp_path / name, SEEDS[name]) is not None


@pytest.mark.parametrize("name", SEEDS)
def test_cut_off_at_every_byte(name: str, tmp_path: Path) -> None:
    for n in range(len(SEEDS[name])):
        outcome(tmp_path / name, SEEDS[name][:n])


@pytest.mark.parametrize("name", SEEDS)
def test_single_bytes_changed(name: str, tmp_path: Path) -> None:
    rng = random.Random(5)
    for _ in range(400):
        content = bytearray(SEEDS[name])
        content[rng.randrange(len(content))] = rng.choice([0, 9, 10, 13, 32, 35, 43, 45, 46, 47, 48, 57, 92, 101, 255])
        outcome(tmp_path / name, bytes(content))


@pytest.mark.fuzz
@pytest.mark.parametrize("row", manifest.rows("off", "obj", "node_ele"), ids=lambda row: row.path)
def test_real_files_changed_at_random(row: manifest.Row, corpus: Path, tmp_path: Path) -> None:
    content = (corpus / row.path).read_bytes()
    path = tmp_path / f"a{Path(row.path).suffix}"
    if path.suffix == ".ele":
        path.with_suffix(".node").write_bytes((corpus / row.path).with_suffix(".node").read_bytes())
    rng = random.Random(7)
    for _ in range(300):
        changed = bytearray(content[: 20_000 if rng.random() < 0.9 else None])
        for _ in range(rng.choice([1, 1, 1, 2, 8])):
            changed[rng.randrange(len(changed))] = rng.randrange(256)
        if rng.random() < 0.3:
            del changed[rng.randrange(len(changed)) :]
        outcome(path, bytes(changed))


TOKENS = ["OFF", "BINARY", "v", "f", "l", "vt", "vn", "g", "s", "1", "2", "3", "-1", "0", "1e9", "1/2/3", "1//1", "#"]
TOKENS += ["\\", "\n", "\n", "\n", "\r", "\t", "nan", "0x1", "99999999999", "\x00", "\u00e9"]
TOKENS += ["3 0 1 2\n", "v 0 0 0\n", "f 1 2 3\n"]


def seek(tmp_path_factory: pytest.TempPathFactory, suffix: str, tokens: list[str]) -> None:
    stem = "pair" if suffix in {".node", ".ele", ".neigh"} else "tokens"
    outcome(tmp_path_factory.getbasetemp() / f"{stem}{suffix}", " ".join(tokens).encode())


@pytest.mark.parametrize("suffix", [".off", ".obj"])
@given(st.lists(st.sampled_from(TOKENS), max_size=60))
def test_tokens_in_any_order(tmp_path_factory: pytest.TempPathFactory, suffix: str, tokens: list[str]) -> None:
    seek(tmp_path_factory, suffix, tokens)


LINES = ["2 3 1\n", "4 2\n", "2\n", "1\n", "0\n", "0 0 0\n", "1 1 0\n", "2 1 2 3\n", "1 1 2 3 nan\n", "1 -1 2 -1\n"]
line_soup = st.lists(st.sampled_from([*TOKENS, *LINES]), max_size=30)


@pytest.mark.parametrize("suffix", [".node", ".ele", ".neigh", ".poly"])
@given(line_soup)
def test_lines_of_tables_in_any_order(tmp_path_factory: pytest.TempPathFactory, suffix: str, tokens: list[str]) -> None:
    seek(tmp_path_factory, suffix, tokens)


@pytest.mark.fuzz
@pytest.mark.parametrize("suffix", [".node", ".ele", ".neigh", ".poly"])
@given(line_soup, st.binary(max_size=8))
def test_tables_of_anything(
    tmp_path_factory: pytest.TempPathFactory, suffix: str, tokens: list[str], rubbish: bytes
) -> None:
    seek(tmp_path_factory, suffix, [*tokens, rubbish.decode("latin-1")])


@given(st.binary(max_size=300))
def test_any_bytes(tmp_path_factory: pytest.TempPathFactory, content: bytes) -> None:
    for name in ("any.off", "any.obj"):
        outcome(tmp_path_factory.getbasetemp() / name, content)
    outcome(tmp_path_factory.getbasetemp() / "any.off", b"OFF BINARY\n" + content)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("comment.off", b"OFF\n#" + b"x" * 3_000_000 + b"\n1 0 0\n0 0 0\n"),
        ("blanks.off", b"OFF\n1 0 0\n" + b" " * 3_000_000 + b"0 0 0\n"),
        ("lines.obj", b"\n" * 3_000_000 + b"v 0 0 0\n"),
        ("name.obj", b"v 0 0 0\ng " + b"x" * 3_000_000 + b"\n"),
        ("digits.obj", b"v 0 0 " + b"1" * 3_000_000 + b"\n"),
        ("joints.obj", b"v 0 0 0\n" + b"\\\n" * 1_000_000),
        ("unknown.obj", b"v 0 0 0\n" + b"zz 1\n" * 300_000),
        ("words.obj", b"v nan inf 1e400\n" * 100_000),
        ("blank.node", b"1 2\n" + b"\n" * 3_000_000 + b"0 0 0\n"),
        ("words.node", b"100000 3\n" + b"".join(b"%d nan inf 1e400\n" % i for i in range(100_000))),
        ("holes.poly", b"1 2\n0 0 0\n0\n300000\n" + b"".join(b"%d 0 0\n" % i for i in range(300_000))),
    ],
)  # fmt: skip
@pytest.mark.large
def test_three_megabytes_of_anything_take_seconds_at_most(name: str, content: bytes, tmp_path: Path) -> None:
    started = time.perf_counter()
    assert outcome(tmp_path / name, content) is not None
    assert time.perf_counter() - started < 20


def test_garbage_of_a_megabyte_is_refused_in_little_memory(tmp_path: Path) -> None:
    (tmp_path / "a.off").write_bytes(b"OFF\n1 0 0\n" + b"x" * 1_000_000)
    tracemalloc.start()
    try:
        with pytest.raises(FormatError) as caught:
            io.read(tmp_path / "a.off")
        assert tracemalloc.get_traced_memory()[1] < 30_000_000
    finally:
        tracemalloc.stop()
    assert len(str(caught.value)) < 500


@pytest.mark.parametrize("head", [b"2000000000 2 0 0\n", b"1 2 2000000000 0\n", b"2000000000 2 2000000000 1\n"])
def test_announced_rows_and_columns_allocate_nothing(head: bytes, tmp_path: Path) -> None:
    (tmp_path / "a.node").write_bytes(head + b"0 0 0\n" * 100)
    tracemalloc.start()
    try:
        with pytest.raises(FormatError):
            io.read(tmp_path / "a.node")
        assert tracemalloc.get_traced_memory()[1] < 5_000_000
    finally:
        tracemalloc.stop()


# ------------------------------------------------------------------------------------------------------ gears, parts


def everything(data: io.MeshData) -> list[bytes]:
    tables = (data.vertex, data.halfedge, data.face)
    named = [
        name.encode() + a.dtype.str.encode() + a.tobytes() for table in tables for name, a in sorted(table.items())
    ]
    return [data.indices.tobytes(), data.offsets.tobytes(), data.points.tobytes(), data.edges.tobytes(), *named]


def small_files() -> list[manifest.Row]:
    rows = [row for row in manifest.rows("off", "obj", "node_ele", "malformed") if "empty" not in row.path]
    return [row for row in rows if (manifest.CORPUS / row.path).stat().st_size < 40_000]


@pytest.mark.large
@pytest.mark.parametrize("row", small_files(), ids=lambda row: row.path)
def test_interpreted_and_compiled_reading_agree(
    row: manifest.Row, corpus: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = []
    for gear in (_jit.Kernel._quick, _jit.Kernel._compiled_call):
        monkeypatch.setattr(_jit.Kernel, "at", lambda kernel, n, gear=gear: gear.__get__(kernel))
        try:
            found.append(everything(io.read_data(corpus / row.path)))
        except HalfmeshError as error:
            found.append([str(error).encode()])
    assert found[0] == found[1]


@pytest.mark.parametrize("row", small_files(), ids=lambda row: row.path)
def test_parts_make_no_difference(row: manifest.Row, corpus: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = []
    for parts in (1, 2, 7):
        monkeypatch.setattr(source, "n_parts", lambda n_bytes, parts=parts: parts)
        try:
            found.append(everything(io.read_data(corpus / row.path)))
        except HalfmeshError as error:
            found.append([str(error).encode()])
    assert found[0] == found[1] == found[2]


@pytest.mark.parametrize(("module", "name"), [(off, "a.off"), (obj, "a.obj")])
def test_more_undecided_numbers_than_the_list_holds(
    module: object, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "_MOST_OPEN", 8)
    rows = [f"{i}e-300 nan {i}" for i in range(50)]
    text = "OFF\n50 0 0\n" + "\n".join(rows) if name == "a.off" else "\n".join("v " + row for row in rows)
    (tmp_path / name).write_text(text)
    points = io.read(tmp_path / name)[1]
    np.testing.assert_array_equal(points, [[float(x) for x in row.split()] for row in rows])
