"""``halfmesh demo``: it runs, shows what it promises, and what it shows is true."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

import halfmesh as hm
from halfmesh.cli.app import app
from halfmesh.demo import explore, make_example, smooth


def run(*arguments: object) -> Result:
    return CliRunner().invoke(app, ["demo", *map(str, arguments)])


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> tuple[Result, Path]:
    folder = tmp_path_factory.mktemp("tour") / "demo"
    return run("--size", "small", "--out", folder), folder


def test_demo_makes_its_mesh_its_picture_and_ends_well(small: tuple[Result, Path]) -> None:
    result, folder = small
    assert result.exit_code == 0, result.output
    assert sorted(path.name for path in folder.iterdir()) == ["patch.off", "sphere.off", "structure.svg"]
    assert (folder / "structure.svg").read_text().startswith("<svg")
    assert hm.load(folder / "sphere.off").n_faces == 5120


def test_demo_shows_every_step_of_the_main_job(small: tuple[Result, Path]) -> None:
    said = small[0].stdout
    steps = ("hm.io.read(path)", "hm.Mesh(faces, points)", "hm.load(path)", "mesh.check()", "v.neighbors()", "h.twin")
    for step in (
        *steps,
        "find_halfedge",
        "boundary_loops",
        "genus",
        "@hm.kernel",
        "smooth.interpreted(",
        "structure.svg",
    ):
        assert step in said


def test_demo_fits_80_columns_without_colors(small: tuple[Result, Path]) -> None:
    result, folder = small
    lines = [line for line in result.stdout.splitlines() if str(folder)[:20] not in line]
    assert max(len(line) for line in lines if not line.startswith("kept in ")) <= 80
    assert "\x1b" not in result.stdout


def test_demo_takes_files_and_shows_the_loop_once(tmp_path: Path) -> None:
    for name, mesh in (("cube.off", hm.shapes.cube()), ("disk.obj", hm.shapes.disk())):
        hm.save(mesh, tmp_path / name)
    result = run(tmp_path / "cube.off", tmp_path / "disk.obj", "--out", tmp_path / "out")
    assert result.exit_code == 0
    assert "From cube.off" in result.stdout
    assert "From disk.obj" in result.stdout
    assert result.stdout.count("@hm.kernel") == 1
    assert not (tmp_path / "out" / "sphere.off").exists()


def test_demo_of_a_bad_file_goes_on_and_fails(tmp_path: Path) -> None:
    hm.save(hm.shapes.cube(), tmp_path / "cube.off")
    result = run(tmp_path / "missing.off", tmp_path / "cube.off", "--out", tmp_path)
    assert result.exit_code == 1
    assert result.stderr == f"halfmesh: {tmp_path / 'missing.off'}: No such file or directory\n"
    assert "From cube.off" in result.stdout


@pytest.mark.parametrize(
    "text",
    ["OFF 0 0 0\n", "OFF 2 0 0  0 0 0  1 1 1\n", "OFF 4 1 0  0 0 0  nan 0 0  0 1 0  9 9 9  3 0 1 2\n"],
    ids=["empty", "isolated", "nan"],
)
def test_demo_holds_with_degenerate_meshes(text: str, tmp_path: Path) -> None:
    (tmp_path / "odd.off").write_text(text)
    result = run(tmp_path / "odd.off", "--out", tmp_path)
    assert result.exit_code == 0, result.output


def test_demo_says_so_if_the_folder_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    result = run("--size", "small", "--out", tmp_path / "file")
    assert result.exit_code == 1
    assert result.stderr == f"halfmesh: {tmp_path / 'file'}: File exists\n"


def test_answers_are_those_of_the_mesh(tmp_path: Path) -> None:
    path, _ = make_example(tmp_path, "small")
    mesh = hm.load(path)
    questions = next(section for section in explore(path) if section.title == "Questions")
    answers = {expression: answer for _, expression, answer in questions.rows}
    assert answers["mesh.euler_characteristic"] == "2"
    assert answers["[u.index for u in v.neighbors()]"] == str([u.index for u in mesh.vertices[0].neighbors()])
    assert answers["h.twin"] == f"Halfedge({int(answers[next(e for e in answers if 'find' in e)][9:-1]) ^ 1})"


def test_loop_of_the_demo_is_the_mean_of_the_neighbors_in_both_gears() -> None:
    mesh = hm.shapes.grid(3, 3)
    mesh.points[:] = np.random.default_rng(0).normal(size=mesh.points.shape)
    compiled, interpreted = mesh.points.copy(), mesh.points.copy()
    smooth(mesh, mesh.points, compiled)
    smooth.interpreted(mesh, mesh.points, interpreted)
    assert np.array_equal(compiled, interpreted)
    for v in mesh.vertices:
        ring = [u.index for u in v.neighbors()]
        expected = v.point if v.is_boundary else mesh.points[ring].mean(axis=0)
        assert np.allclose(compiled[v.index], expected)
