"""A compact mesh in its file: mapped, and checked so that what is damaged is refused and never followed."""

from __future__ import annotations

import numpy as np
import pytest

import halfmesh as hm
from halfmesh.compact import files
from halfmesh.compact.encoding import compacted
from halfmesh.compact.topology import FIELDS, STORED, CompactTopology
from halfmesh.core import navigation
from halfmesh.core.navigation import next_of

ZOO = {name: s for name, s in hm.testing.zoo().items() if s.figures.genus == 0}


@pytest.fixture
def compact():
    """With holes, two components and an isolated vertex."""
    mesh = hm.shapes.grid(6, 5)
    for f in (3, 8, 14, 16, 27):
        mesh.remove_face(f)
    mesh.append(hm.shapes.cube())
    mesh.add_vertex()
    return compacted(mesh.topology).topology


@pytest.fixture
def path(compact, tmp_path):
    place = tmp_path / "mesh.hmc"
    compact.save(place)
    return place


@pytest.mark.parametrize("specimen", ZOO.values(), ids=ZOO)
def test_there_and_back(specimen, tmp_path):
    compact = compacted(specimen.mesh().topology).topology
    compact.save(tmp_path / "mesh.hmc")
    again = CompactTopology.load(tmp_path / "mesh.hmc")
    for name in FIELDS:
        assert np.array_equal(getattr(again.__arrays__(), name), getattr(compact.__arrays__(), name)), name
    assert [next_of(again, h) for h in range(again.n_halfedges)] == [
        next_of(compact, h) for h in range(2 * compact.n_edges)
    ]


def test_arrays_are_mapped_and_begin_with_a_cache_line(path):
    a = CompactTopology.load(path).__arrays__()
    for name in STORED:
        array = getattr(a, name)
        assert not array.flags.owndata
        assert not array.flags.writeable
        assert array.ctypes.data % 64 == 0


def test_other_arrays_travel_along(compact, tmp_path):
    points, names = np.random.default_rng(0).random((7, 3)), np.arange(5, dtype=np.uint8)
    files.write(tmp_path / "mesh.hmc", compact, {"points": points, "label": names, "none": names[:0]})
    _, others = files.read(tmp_path / "mesh.hmc")
    assert list(others) == ["points", "label", "none"]
    assert np.array_equal(others["points"], points)
    assert np.array_equal(others["label"], names)


@pytest.mark.parametrize("array", [np.array(["text"]), np.zeros((2, 2, 2)), np.zeros(3, complex)])
def test_what_is_not_a_table_of_numbers_is_not_written(compact, tmp_path, array):
    with pytest.raises(TypeError, match="arrays of numbers"):
        files.write(tmp_path / "mesh.hmc", compact, {"x": array})
    assert not list(tmp_path.iterdir())


def test_a_name_that_is_too_long_is_not_written(compact, tmp_path):
    with pytest.raises(ValueError, match="longer than 23 bytes"):
        files.write(tmp_path / "mesh.hmc", compact, {"x" * 24: np.zeros(1)})


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(FileNotFoundError):
        CompactTopology.load(tmp_path / "mesh.hmc")


def test_every_file_cut_short_is_refused(path):
    whole = path.read_bytes()
    for n in [*range(0, 400, 7), *range(400, len(whole), 61)]:
        path.write_bytes(whole[:n])
        with pytest.raises(hm.FormatError):
            CompactTopology.load(path)


@pytest.mark.parametrize("other", [b"", b"OFF\n3 1 0\n", b"\x89HMC\r\n\x1a\n", b"\x89HMC\n\x1a\n" + bytes(200)])
def test_other_files_are_refused(tmp_path, other):
    (tmp_path / "mesh.hmc").write_bytes(other)
    with pytest.raises(hm.FormatError):
        CompactTopology.load(tmp_path / "mesh.hmc")


def test_every_byte_that_is_turned_is_found_or_means_a_valid_mesh(path):
    """What is loaded answers all questions, within its numbers, and its tours come back: nothing hangs or breaks."""
    whole, rng = path.read_bytes(), np.random.default_rng(0)
    n_refused = 0
    for at in range(0, len(whole), 3):
        damaged = bytearray(whole)
        damaged[at] ^= 1 << int(rng.integers(8))
        path.write_bytes(damaged)
        try:
            t, _ = files.read(path)
        except hm.FormatError:
            n_refused += 1
        else:
            assert_sound(t)
    assert n_refused > len(whole) / 6


def assert_sound(t):
    n, h = t.n_halfedges, np.arange(t.n_halfedges)
    assert np.array_equal(np.sort(navigation.next_of(t, h)), h)
    assert np.array_equal(navigation.twin_of(t, navigation.twin_of(t, h)), h)
    for rule, low, high in (("origin_of", 0, t.n_vertices), ("face_of", -1, t.n_faces), ("edge_of", 0, n // 2)):
        x = getattr(navigation, rule)(t, h)
        assert x.min() >= low
        assert x.max() < high


@pytest.mark.parametrize("name", STORED)
def test_numbers_gone_wild_are_refused(compact, tmp_path, name):
    a = compact.__arrays__()
    good = getattr(a, name)
    if len(good):
        for value in (-1, 2**31 - 1, -(2**31)):
            wild = good.copy()
            wild[len(wild) // 2] = value
            setattr(a, name, wild)
            files.write(tmp_path / "mesh.hmc", compact)
            with pytest.raises(hm.FormatError):
                CompactTopology.load(tmp_path / "mesh.hmc")


def test_an_array_less_is_refused(compact, tmp_path, monkeypatch):
    monkeypatch.setattr(files, "STORED", STORED[1:])
    compact.save(tmp_path / "mesh.hmc")
    monkeypatch.undo()
    with pytest.raises(hm.FormatError, match="bits are missing"):
        CompactTopology.load(tmp_path / "mesh.hmc")
