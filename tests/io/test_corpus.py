"""Real files: exactly what they hold, and the malformed ones refused (IO1, IO5, N5, E1)."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import io_manifest as manifest
import io_reference as reference
import numpy as np
import pytest

from halfmesh import io
from halfmesh.errors import FormatError

GOOD = [row for row in manifest.rows("off", "obj", "node_ele") if row.n_faces is not None]
MALFORMED = manifest.rows("malformed")
BINARY = "off/pmp__fairing-cross.off"


def named(rows: list[manifest.Row]) -> pytest.MarkDecorator:
    marks = [[pytest.mark.large] if row.n_bytes > 150_000 else [] for row in rows]
    return pytest.mark.parametrize(
        "row", [pytest.param(row, marks=mark, id=row.path) for row, mark in zip(rows, marks, strict=True)]
    )


def test_the_corpus_was_found(corpus: Path) -> None:
    assert len(GOOD) >= 50
    assert len(MALFORMED) >= 13


@named(GOOD)
def test_counts_are_those_of_the_manifest(row: manifest.Row, corpus: Path) -> None:
    data = io.read_data(corpus / row.path)
    degrees, counts = np.unique(np.diff(data.offsets), return_counts=True)
    assert (data.n_vertices, data.n_faces) == (row.n_vertices, row.n_faces)
    assert dict(zip(degrees.tolist(), counts.tolist(), strict=True)) == row.degrees


@named([row for row in GOOD if row.path != BINARY])
def test_faces_and_points_are_those_of_a_second_reader(row: manifest.Row, corpus: Path) -> None:
    data = io.read_data(corpus / row.path)
    points, faces = reference.read(corpus / row.path)
    assert data.points.tobytes() == np.array(points, dtype=np.float64).tobytes()
    assert np.split(data.indices, data.offsets[1:-1])[0].tolist() == faces[0]
    assert data.indices.tolist() == [i for face in faces for i in face]


@named(GOOD)
@pytest.mark.parametrize("suffix", [".off", ".obj"])
def test_what_is_written_reads_back_to_the_bit(row: manifest.Row, suffix: str, corpus: Path, tmp_path: Path) -> None:
    faces, points = io.read(corpus / row.path)
    io.write(tmp_path / f"again{suffix}", faces, points)
    again, same = io.read(tmp_path / f"again{suffix}")
    assert same.tobytes() == points.tobytes()
    for mine, theirs in zip(_columns(again), _columns(faces), strict=True):
        np.testing.assert_array_equal(mine, theirs)


def _columns(faces: io.MeshData | object) -> tuple[object, ...]:
    return faces if isinstance(faces, tuple) else (faces,)


@named([row for row in MALFORMED if row.expect == "MUST_RAISE"])
def test_malformed_files_are_refused_by_path_and_line(row: manifest.Row, corpus: Path) -> None:
    with pytest.raises(FormatError) as caught:
        io.read(corpus / row.path)
    assert caught.value.path.endswith(row.path)
    assert caught.value.line is not None or "empty" in caught.value.reason or "no vertex" in caught.value.reason


@pytest.mark.parametrize("name", ["geomview__cube1.off", "trimesh__whitespace.off"])
def test_a_missing_keyword_and_one_glued_to_the_counts_are_read(name: str, corpus: Path) -> None:
    data = io.read_data(corpus / "malformed" / name)
    assert (data.n_vertices, data.n_faces) == (8, 6)


def test_a_geomview_scene_is_refused_as_one(corpus: Path) -> None:
    with pytest.raises(FormatError, match=r"line 1: .*Geomview scene"):
        io.read(corpus / "malformed" / "polylladcel__points50.1.off")


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("assimp__malformed2.obj", 23),
        ("tinyobj__invalid-face-definition.obj", 15),
        ("trimesh__notenoughindices.obj", 9),
    ],
)
def test_faces_with_fewer_than_three_vertices_are_refused(name: str, line: int, corpus: Path) -> None:
    with pytest.raises(FormatError, match="fewer than 3") as caught:
        io.read(corpus / "malformed" / name)
    assert caught.value.line == line


def test_announced_counts_allocate_nothing(corpus: Path) -> None:
    tracemalloc.start()
    try:
        with pytest.raises(FormatError, match="353535235358 vertices"):
            io.read(corpus / "malformed" / "assimp__OutOfMemory.off")
        assert tracemalloc.get_traced_memory()[1] < 5_000_000
    finally:
        tracemalloc.stop()


def test_a_line_that_names_an_edge_of_a_face_makes_no_second_edge(corpus: Path) -> None:
    mesh = io.load(corpus / "obj" / "assimp__testmixed.obj")
    assert (mesh.n_vertices, mesh.n_edges, mesh.n_faces) == (8, 12, 6)
    assert mesh.edge_data["line"].all()


@named([row for row in GOOD if row.path.startswith(("off/", "node_ele/"))])
def test_a_mesh_has_the_edges_of_the_manifest(row: manifest.Row, corpus: Path) -> None:
    assert io.load(corpus / row.path).n_edges == row.n_edges
