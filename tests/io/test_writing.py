"""Writing: whole or not at all, and everything that the format can hold."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import numpy as np
import pytest

import halfmesh as hm
from halfmesh import _files, io
from halfmesh.errors import FormatError, InvalidMeshError
from halfmesh.io import formats

CUBE = hm.shapes.cube()
POINTS = np.array([[0, 0, 0], [1, 0, 0.1], [1 / 3, 1e-7, -0.0], [2, 2, 1e22]])
FACES = (np.array([0, 1, 2, 0, 1, 3, 2]), np.array([0, 3, 7]))


def names(folder: Path) -> list[str]:
    return sorted(p.name for p in folder.iterdir())


def test_off_text_is_short_and_plain(tmp_path: Path) -> None:
    io.write(tmp_path / "a.off", FACES, POINTS)
    assert (tmp_path / "a.off").read_text() == (
        "OFF\n4 2 0\n0 0 0\n1 0 0.1\n0.3333333333333333 1e-07 -0\n2 2 1e+22\n3 0 1 2\n4 0 1 3 2\n"
    )


def test_obj_text_is_short_and_plain(tmp_path: Path) -> None:
    io.write(tmp_path / "a.obj", FACES, POINTS[:, :2], edges=[[0, 3]])
    assert (tmp_path / "a.obj").read_text() == (
        "v 0 0 0\nv 1 0 0\nv 0.3333333333333333 1e-07 0\nv 2 2 0\nf 1 2 3\nf 1 2 4 3\nl 1 4\n"
    )


@pytest.mark.parametrize("suffix", [".off", ".OFF", ".obj", ".Obj"])
def test_a_mesh_survives(suffix: str, tmp_path: Path) -> None:
    hm.save(CUBE, tmp_path / f"a{suffix}")
    again = hm.load(str(tmp_path / f"a{suffix}"))
    assert np.array_equal(again.face_vertices()[0], CUBE.face_vertices()[0])
    assert again.points.tobytes() == CUBE.points.tobytes()


ROWS = np.random.default_rng(3).normal(size=(8, 4))
VERTEX_COLUMNS = {
    "normal": ROWS[:, :3],
    "color": np.arange(32, dtype=np.uint8).reshape(8, 4),
    "texcoord": ROWS[:, :2],
    "w": ROWS[:, 0],
}


@pytest.mark.parametrize("chosen", [["normal"], ["color"], ["texcoord"], ["w"], list(VERTEX_COLUMNS)])
def test_off_keeps_the_attributes_that_its_keywords_name(chosen: list[str], tmp_path: Path) -> None:
    vertex = {name: VERTEX_COLUMNS[name] for name in chosen}
    io.write(tmp_path / "a.off", *arrays(), vertex=vertex)
    again = io.read_data(tmp_path / "a.off").vertex
    assert sorted(again) == sorted(vertex)
    for name, values in vertex.items():
        assert again[name].dtype == values.dtype
        np.testing.assert_array_equal(again[name], values)


@pytest.mark.parametrize(
    "colors",
    [
        np.arange(18, dtype=np.uint8).reshape(6, 3),
        np.ones((6, 4)),
        np.where(np.arange(6)[:, None] % 2, ROWS[:6, :3], np.nan),
    ],
)
def test_off_keeps_face_colours_with_their_type_and_gaps(colors: np.ndarray, tmp_path: Path) -> None:
    io.write(tmp_path / "a.off", *arrays(), face={"color": colors})
    again = io.read_data(tmp_path / "a.off").face["color"]
    assert again.dtype == colors.dtype
    np.testing.assert_array_equal(again, colors)


def test_obj_keeps_corners_labels_and_names(tmp_path: Path) -> None:
    n_corners = 24
    halfedge = {"texcoord": np.repeat(ROWS[:6, :2], 4, axis=0), "normal": np.tile(ROWS[:4, :3], (6, 1))}
    halfedge["texcoord"][5] = np.nan
    face = {
        "group": np.int32([-1, 0, 0, 1, 1, 0]),
        "material": np.int32([0] * 6),
        "smoothing": np.int32([1, 1, 0, 0, 2, 2]),
    }
    meta = {"groups": ["a b", "c"], "materials": ["red"], "material_libraries": ["x.mtl"]}
    io.write(tmp_path / "a.obj", *arrays(), halfedge=halfedge, face=face, meta=meta)
    again = io.read_data(tmp_path / "a.obj")
    assert len(again.indices) == n_corners
    for name, values in halfedge.items():
        np.testing.assert_array_equal(again.halfedge[name], values)
    for name, labels in face.items():
        np.testing.assert_array_equal(again.face[name], labels)
    assert {name: again.meta[name] for name in meta} == meta


def test_equal_texture_coordinates_are_written_once(tmp_path: Path) -> None:
    io.write(tmp_path / "a.obj", *arrays(), halfedge={"texcoord": np.tile([[0.5, 0.25]], (24, 1))})
    assert (tmp_path / "a.obj").read_text().count("vt ") == 1


def test_attributes_of_a_mesh_come_back_on_the_mesh(tmp_path: Path) -> None:
    mesh = hm.shapes.cube()
    mesh.vertex_data["color"] = ROWS[:, :3]
    mesh.face_data["group"] = np.arange(6, dtype=np.int32)
    mesh.halfedge_data["texcoord"] = np.arange(48.0).reshape(24, 2)
    hm.save(mesh, tmp_path / "a.obj")
    again = hm.load(tmp_path / "a.obj")
    np.testing.assert_array_equal(again.vertex_data["color"], ROWS[:, :3])
    np.testing.assert_array_equal(again.face_data["group"], np.arange(6))
    np.testing.assert_array_equal(again.halfedge_data["texcoord"], mesh.halfedge_data["texcoord"])


def test_wire_survives_in_obj_and_is_refused_in_off(tmp_path: Path) -> None:
    mesh = hm.Mesh([[0, 1, 2]], np.eye(5)[:, :3], edges=[[3, 4]])
    hm.save(mesh, tmp_path / "a.obj")
    assert hm.load(tmp_path / "a.obj").n_edges == 4
    with pytest.raises(FormatError, match=r"1 edges belong to no face.*\.obj"):
        hm.save(mesh, tmp_path / "a.off")
    assert names(tmp_path) == ["a.obj"]


def arrays() -> tuple[np.ndarray, np.ndarray]:
    return CUBE.face_vertices()[0].reshape(6, 4), CUBE.points


# --------------------------------------------------------------------------------------------------- the file itself


def test_a_failure_leaves_what_was_there_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.off"
    path.write_text("before")

    def pieces(data: object, path: str):  # type: ignore[no-untyped-def]
        yield b"half"
        raise OSError(28, "No space left on device")

    monkeypatch.setitem(formats.FORMATS, ".off", formats.FORMATS[".off"]._replace(write=pieces))
    with pytest.raises(OSError, match="No space left"):
        hm.save(CUBE, path)
    assert path.read_text() == "before"
    assert names(tmp_path) == ["a.off"]


def test_a_failing_replacement_leaves_no_temporary_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(source: str, destination: str) -> None:
        raise PermissionError(13, "no")

    monkeypatch.setattr(_files.os, "replace", refuse)
    with pytest.raises(PermissionError):
        hm.save(CUBE, tmp_path / "a.off")
    assert names(tmp_path) == []


@pytest.mark.skipif(os.name == "nt", reason="permission bits are a matter of POSIX")
def test_permission_bits_of_an_existing_file_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "a.off"
    path.touch()
    path.chmod(0o640)
    hm.save(CUBE, path)
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


@pytest.mark.skipif(os.name == "nt", reason="symbolic links need rights on Windows")
def test_a_symbolic_link_stays_one(tmp_path: Path) -> None:
    (tmp_path / "link.off").symlink_to(tmp_path / "real.off")
    hm.save(CUBE, tmp_path / "link.off")
    assert (tmp_path / "link.off").is_symlink()
    assert (tmp_path / "real.off").is_file()


def test_no_such_folder_is_an_oserror(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        hm.save(CUBE, tmp_path / "no" / "a.off")


def test_no_such_file_is_an_oserror(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        io.read(tmp_path / "a.off")


def test_a_folder_is_an_oserror_both_ways(tmp_path: Path) -> None:
    (tmp_path / "a.off").mkdir()
    with pytest.raises(OSError, match=r"directory|denied"):
        io.read(tmp_path / "a.off")
    with pytest.raises(OSError, match=r"directory|denied"):
        hm.save(CUBE, tmp_path / "a.off")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes here")
def test_a_pipe_is_refused_and_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "a.off")
    with pytest.raises(FormatError, match="regular file"):
        io.read(tmp_path / "a.off")
    with pytest.raises(FormatError, match="regular file"):
        hm.save(CUBE, tmp_path / "a.off")


@pytest.mark.parametrize("name", ["a.xyz", "a", "a.off.gz"])
def test_an_unknown_suffix_names_the_known_ones(name: str, tmp_path: Path) -> None:
    (tmp_path / name).touch()
    for act in (lambda: io.read(tmp_path / name), lambda: hm.save(CUBE, tmp_path / name)):
        with pytest.raises(FormatError, match=r"\.off \(OFF\), \.obj"):
            act()


@pytest.mark.parametrize(
    ("faces", "points", "reason"),
    [
        ([[0, 1, 4]], POINTS, "index_out_of_range"),
        ([[0, 1, 2]], POINTS[:, :1], "bad_shape"),
        ([[0, 1, 2]], [["a", "b", "c"]], "bad_shape"),
        ([[0, 1]], POINTS, "small_face"),
    ],
)
def test_arrays_that_no_file_could_hold_are_refused(faces: object, points: object, reason: str, tmp_path: Path) -> None:
    with pytest.raises(InvalidMeshError) as caught:
        io.write(tmp_path / "a.off", faces, points)  # type: ignore[arg-type]
    assert caught.value.reason == reason
    assert names(tmp_path) == []


def test_save_of_what_is_no_mesh_says_what_to_call(tmp_path):
    with pytest.raises(hm.ElementError, match=r"write\(path, faces, points\)"):
        hm.save(([[0, 1, 2]], [[0, 0, 0]] * 3), tmp_path / "a.off")
