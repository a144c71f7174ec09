"""The ``halfmesh`` command: what it prints, where, and its exit codes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import halfmesh as hm
from halfmesh.cli.app import app
from halfmesh.io.formats import FORMATS

MAIN = "from halfmesh.cli import main; main()"
BOOK = "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n"


def run(*arguments: object) -> Result:
    return CliRunner().invoke(app, [str(a) for a in arguments])


def python(code: str, *arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", code, *map(str, arguments)]
    env = os.environ | environment
    return subprocess.run(command, capture_output=True, check=False, text=True, env=env, timeout=300)


def process(*arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
    """The command as the shell runs it."""
    return python(MAIN, *arguments, **environment)


@pytest.fixture
def cube(tmp_path: Path) -> Path:
    path = tmp_path / "cube.off"
    hm.save(hm.shapes.cube(), path)
    return path


@pytest.fixture
def book(tmp_path: Path) -> Path:
    """Three faces at one edge: readable, and no mesh that can be held."""
    path = tmp_path / "book.off"
    path.write_text(BOOK)
    return path


# ----------------------------------------------------------------------------------------------------------------- info


def test_info_prints_counts_topology_orientation_memory_and_times(cube: Path) -> None:
    result = run("info", cube)
    assert result.exit_code == 0
    lines = {" ".join(line.split()[:-1]): line.split()[-1] for line in result.stdout.splitlines()}
    assert (lines["vertices"], lines["edges"], lines["faces"], lines["genus"]) == ("8", "12", "6", "0")
    assert lines["by degree quads"] == "6"
    for label in ("orientation", "memory", "read in", "built in", "connected components", "boundary loops"):
        assert f"  {label}" in result.stdout


def test_info_tells_outside_from_inside(cube: Path, tmp_path: Path) -> None:
    faces, points = hm.io.read(cube)
    hm.io.write(tmp_path / "turned.off", faces[:, ::-1], points)
    first, second = json.loads(run("info", "--json", cube, tmp_path / "turned.off").stdout)
    assert "outward" in first["orientation"]
    assert "inward" in second["orientation"]
    assert first["volume"] == -second["volume"] > 0


def test_info_as_json_is_a_list_with_one_object_for_each_file(cube: Path, book: Path) -> None:
    first, second = json.loads(run("info", "--json", cube, book).stdout)
    assert (first["file"], first["vertices"], first["face_degrees"]) == (str(cube), 8, {"4": 6})
    assert first["error"] is None
    assert second["error"]["reason"] == "nonmanifold_edge"


def test_info_reports_the_plain_counts_of_what_cannot_be_held(book: Path) -> None:
    result = run("info", book)
    assert result.exit_code == 1
    assert result.stdout.split()[-4:] == ["be", "held:", "nonmanifold", "edge"]
    assert "points       5" in result.stdout
    assert result.stderr.startswith(f"halfmesh: {book}: 1 edge has more than two faces: 0-1")


def test_info_of_a_bad_file_fails_and_the_others_are_reported(cube: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.off"
    bad.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 zero\n3 0 1 2\n")
    result = run("info", bad, tmp_path / "missing.off", cube)
    assert result.exit_code == 1
    assert result.stdout.startswith(str(cube))
    complaints = result.stderr.splitlines()
    assert len(complaints) == 2
    assert complaints[0].startswith(f"halfmesh: {bad}, line 5: expected a number")
    assert complaints[1] == f"halfmesh: {tmp_path / 'missing.off'}: No such file or directory"


def test_info_of_an_empty_mesh_and_of_nan_points(tmp_path: Path) -> None:
    (tmp_path / "empty.off").write_text("OFF\n0 0 0\n")
    (tmp_path / "nan.off").write_text("OFF 4 4 0  0 0 0  1 nan 0  0 1 0  0 0 1  3 0 2 1  3 0 1 3  3 0 3 2  3 1 2 3\n")
    result = run("info", "--json", tmp_path / "empty.off", tmp_path / "nan.off")
    assert result.exit_code == 0
    assert [mesh["volume"] for mesh in json.loads(result.stdout)] == [None, None]


def test_info_of_a_small_file_does_not_import_numba(cube: Path) -> None:
    code = "import sys\nfrom halfmesh.cli import main\ntry: main()\nfinally: print('numba' in sys.modules)"
    assert python(code, "info", cube).stdout.endswith("\nFalse\n")


# ---------------------------------------------------------------------------------------------------------------- check


def test_check_says_valid_in_one_line(cube: Path) -> None:
    result = run("check", cube)
    assert result.exit_code == 0
    assert result.stdout == f"{cube}: valid, 8 vertices, 12 edges, 6 faces, closed\n"


def test_check_of_what_cannot_be_held_fails_with_the_reason(book: Path, cube: Path) -> None:
    result = run("check", book, cube)
    assert result.exit_code == 1
    assert "more than two faces" in result.stderr
    assert f"{cube}: valid" in result.stdout


def test_check_tests_the_laws(cube: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(mesh: hm.Mesh) -> None:
        raise hm.InvalidMeshError("law 'broken' is broken by 1 faces: 0")

    monkeypatch.setattr(hm.Mesh, "check", broken)
    assert run("check", cube).exit_code == 1
    assert run("info", cube).exit_code == 0


# -------------------------------------------------------------------------------------------------------------- convert


def test_convert_keeps_polygons_and_points(cube: Path, tmp_path: Path) -> None:
    assert run("convert", cube, tmp_path / "cube.obj").exit_code == 0
    (faces, points), (faces_before, points_before) = hm.io.read(tmp_path / "cube.obj"), hm.io.read(cube)
    assert faces.tolist() == faces_before.tolist()
    assert points.tolist() == points_before.tolist()


def test_convert_keeps_attributes(tmp_path: Path) -> None:
    (tmp_path / "in.off").write_text("COFF 3 1 0\n0 0 0 1 0 0 1\n1 0 0 0 1 0 1\n0 1 0 0 0 1 1\n3 0 1 2 0.5 0.5 0.5\n")
    assert run("convert", tmp_path / "in.off", tmp_path / "out.off").exit_code == 0
    before, after = (hm.io.read_data(tmp_path / name) for name in ("in.off", "out.off"))
    assert after.vertex["color"].tolist() == before.vertex["color"].tolist()
    assert after.face["color"].tolist() == before.face["color"].tolist()


def test_convert_writes_what_cannot_be_held(book: Path, tmp_path: Path) -> None:
    assert run("convert", book, tmp_path / "book.obj").exit_code == 0
    assert hm.io.read(tmp_path / "book.obj")[0].tolist() == [[0, 1, 2], [0, 1, 3], [0, 1, 4]]


def test_convert_to_an_unknown_suffix_is_one_line_on_stderr(cube: Path, tmp_path: Path) -> None:
    result = run("convert", cube, tmp_path / "cube.xyz")
    assert result.exit_code == 1
    assert result.stderr.count("\n") == 1
    assert "unknown suffix '.xyz'" in result.stderr


def test_convert_that_the_system_refuses_is_one_line_on_stderr(cube: Path, tmp_path: Path) -> None:
    result = run("convert", cube, tmp_path / "no" / "such" / "folder.off")
    assert result.exit_code == 1
    assert result.stderr.startswith("halfmesh: ")
    assert "Errno" not in result.stderr


# -------------------------------------------------------------------------------------------------------------- polylla


@pytest.fixture
def triangles(tmp_path: Path) -> Path:
    path = tmp_path / "triangles.off"
    hm.save(hm.shapes.seed_triangulation(), path)
    return path


@pytest.mark.parametrize("suffix", [suffix for suffix in (".off", ".obj", ".ale") if suffix in FORMATS])
def test_polylla_writes_every_format_that_holds_polygons(triangles: Path, tmp_path: Path, suffix: str) -> None:
    result = run("polylla", triangles, tmp_path / f"polygons{suffix}")
    assert result.exit_code == 0, result.output
    assert result.stdout == f"{tmp_path / f'polygons{suffix}'}: 5 polygons from 12 triangles\n"
    assert (tmp_path / f"polygons{suffix}").stat().st_size > 0


def test_polylla_writes_what_the_function_returns(triangles: Path, tmp_path: Path) -> None:
    run("polylla", triangles, tmp_path / "polygons.off")
    expected, found = hm.polylla(hm.load(triangles)), hm.load(tmp_path / "polygons.off")
    assert [a.tolist() for a in found.face_vertices()] == [a.tolist() for a in expected.face_vertices()]
    assert found.points.tolist() == expected.points.tolist()


def test_polylla_reports_counts_times_and_quality(triangles: Path, tmp_path: Path) -> None:
    said = run("polylla", triangles, tmp_path / "polygons.off", "--report").stdout
    lines = [" ".join(line.split()) for line in said.splitlines()]
    for line in ("triangles 12", "polygons 5", "convex 4 (80.0%)", "star-shaped 5 (100.0%)", "sides 3 4.40 6"):
        assert line in lines
    assert any(line.startswith("total ") and line.endswith(" ms") for line in lines)


def test_polylla_reports_as_json(triangles: Path, tmp_path: Path) -> None:
    said = json.loads(run("polylla", triangles, tmp_path / "polygons.off", "--json").stdout)
    assert (said["file"], said["out"]) == (str(triangles), str(tmp_path / "polygons.off"))
    assert (said["report"]["n_triangles"], said["quality"]["n_polygons"]) == (12, 5)


def test_polylla_draws_the_polygons(triangles: Path, tmp_path: Path) -> None:
    result = run("polylla", triangles, tmp_path / "polygons.off", "--plot", tmp_path / "polygons.png")
    assert result.exit_code == 0, result.output
    assert (tmp_path / "polygons.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("source", "rest", "words"),
    [
        ("cube.off", ["out.off"], "cube.off: face 0 is not a triangle"),
        ("book.off", ["out.off"], "book.off: 1 edge has more than two faces"),
        ("missing.off", ["out.off"], "missing.off: No such file or directory"),
        ("triangles.off", ["out.xyz"], "out.xyz: unknown suffix '.xyz'"),
        ("triangles.off", ["no/folder.off"], "No such file or directory"),
        (
            "triangles.off",
            ["out.off", "--plot", "out.bmp3"],
            "out.bmp3: unknown suffix '.bmp3'; pictures are written as",
        ),
    ],
)
@pytest.mark.usefixtures("cube", "book", "triangles")
def test_polylla_refuses_in_one_line(
    source: str, rest: list[str], words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = run("polylla", source, *rest)
    assert result.exit_code == 1
    assert result.stdout == ""
    assert result.stderr.count("\n") == 1
    assert result.stderr.startswith("halfmesh: ")
    assert words in result.stderr


@pytest.mark.parametrize("obstacle", ["no such folder", "too many faces"])
def test_polylla_that_cannot_draw_has_written_and_reported(
    triangles: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, obstacle: str
) -> None:
    if obstacle == "too many faces":
        monkeypatch.setattr("halfmesh.viewer.plotting.MOST_FACES", 4)
    result = run("polylla", triangles, tmp_path / "out.off", "--plot", tmp_path / "no" / "out.png")
    assert result.exit_code == 1
    assert "5 polygons" in result.stdout
    assert result.stderr.count("\n") == 1
    assert (tmp_path / "out.off").exists()


def test_polylla_says_how_to_get_pictures(triangles: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    result = run("polylla", triangles, tmp_path / "out.off", "--plot", tmp_path / "out.png")
    assert result.exit_code == 1
    assert result.stderr == "halfmesh: pictures need matplotlib: pip install halfmesh[plot]\n"
    assert not (tmp_path / "out.off").exists()


def test_polylla_shows_a_bar_where_somebody_is_watching(
    triangles: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from rich.console import Console

    watched = Console(force_terminal=True, width=80)
    monkeypatch.setattr("halfmesh.cli.polylla.console", lambda: watched)
    with watched.capture() as shown:
        run("polylla", triangles, tmp_path / "out.off")
    assert "reading" in shown.get()


# --------------------------------------------------------------------------------------------------------------- warmup

CENSUS = """
import halfmesh
from halfmesh.warmup import kernels_of, never_compiled, warm_up
before = never_compiled(halfmesh)
for _ in warm_up(): pass
print(len(before), len(kernels_of(halfmesh)), never_compiled(halfmesh))
"""


@pytest.mark.large
def test_warmup_forgets_no_kernel() -> None:
    done = python(CENSUS)
    assert done.returncode == 0, done.stderr
    before, kernels, forgotten = done.stdout.split(maxsplit=2)
    assert int(kernels) > int(before) > 30  # so the census sees what has not been compiled
    assert forgotten.strip() == "[]", "give each of these a job in halfmesh.warmup.jobs"


@pytest.mark.large
def test_warmup_leaves_nothing_to_compile(tmp_path: Path) -> None:
    """A large mesh of polygons and one of triangles, from file to normals, after a warm-up."""
    code = """
import halfmesh as hm, pathlib, sys
from halfmesh.warmup import n_compiled_here, warm_up
for _ in warm_up(): pass
n = n_compiled_here()
for mesh in (hm.shapes.grid(70, 70), hm.shapes.icosphere(5)):
    for suffix in (".off", ".obj"):
        path = pathlib.Path(sys.argv[1]) / ("mesh" + suffix)
        hm.save(mesh, path)
        again = hm.load(path)
        again.check(), again.summary(), again.vertex_neighbors(), again.face_neighbors(), again.vertex_faces()
        hm.geometry.vertex_normals(again), hm.geometry.face_centroids(again), hm.geometry.edge_lengths(again)
late = [k for k in hm.warmup.kernels_of(hm) if "compiled" in vars(k) and k.compiled.stats.cache_misses]
print(n_compiled_here() - n, late if n_compiled_here() != n else "")
"""
    done = python(code, tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split()[0] == "0", done.stdout


@pytest.mark.large
def test_warmup_says_where_the_kernels_are_kept(tmp_path: Path) -> None:
    first = process("warmup")
    assert first.returncode == 0, first.stderr
    again = process("warmup")
    assert again.stdout.startswith("0 kernels compiled, ")
    assert Path(again.stdout.split("kept in ")[1].strip()).is_dir()


# ------------------------------------------------------------------------------------------------------------ the whole


def test_version_is_that_of_the_package() -> None:
    assert run("--version").stdout == f"halfmesh {hm.__version__}\n"


def test_help_names_every_command() -> None:
    said = run("--help").stdout
    assert all(f"  {name} " in said for name in ("info", "check", "convert", "polylla", "warmup", "demo"))


@pytest.mark.parametrize("arguments", [["info"], ["convert", "one.off"], ["no-such-command"], ["info", "--no-such"]])
def test_what_is_not_understood_has_exit_code_2(arguments: list[str]) -> None:
    assert run(*arguments).exit_code == 2


def test_output_into_a_pipe_has_no_colors_and_no_line_beyond_80(cube: Path) -> None:
    said = process("info", cube, TERM="xterm-256color")
    assert said.returncode == 0
    assert "\x1b" not in said.stdout
    assert max(map(len, said.stdout.splitlines()[1:])) <= 80  # the first has the path
    assert all(line == line.rstrip() for line in said.stdout.splitlines())


def test_name_that_the_terminal_cannot_show_is_escaped(tmp_path: Path) -> None:
    path = tmp_path / "w\N{LATIN SMALL LETTER U WITH DIAERESIS}rfel.off"
    hm.save(hm.shapes.cube(), path)
    said = process("info", path, PYTHONIOENCODING="ascii")
    assert said.returncode == 0, said.stderr
    assert said.stdout.splitlines()[0].endswith("w\\xfcrfel.off")


@pytest.mark.skipif(os.name != "posix", reason="signals are sent differently elsewhere")
def test_reader_of_the_output_may_leave_early(cube: Path) -> None:
    command = [sys.executable, "-c", MAIN, "info", *[str(cube)] * 300]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        child.stdout.readline()
        child.stdout.close()
        assert child.stderr.read() == ""


@pytest.mark.skipif(os.name != "posix", reason="signals are sent differently elsewhere")
def test_interrupt_ends_without_a_traceback(tmp_path: Path) -> None:
    command = [sys.executable, "-c", MAIN, "demo", "--out", str(tmp_path)]
    nothing_compiled = os.environ | {"HALFMESH_CACHE_DIR": str(tmp_path / "cache")}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, env=nothing_compiled, **pipes) as child:
        assert child.stdout is not None
        child.stdout.readline()  # it has begun, and has seconds of work before it
        child.send_signal(signal.SIGINT)
        _, complaint = child.communicate(timeout=60)
    assert complaint.strip() == "interrupted"
    assert child.returncode == 130
