"""Every ``>>>`` in README.md and in the pages of docs/ runs and prints what the page says it prints."""

from __future__ import annotations

import doctest
import io
import re
import runpy
import tomllib
from pathlib import Path

import pytest

import halfmesh as hm

ROOT = Path(__file__).resolve().parent.parent
PAGES = sorted({ROOT / "README.md", ROOT / "ARCHITECTURE.md", *ROOT.glob("docs/**/*.md")})
FENCE = re.compile(r"^```pycon\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FLAGS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS


def examples_of(page: Path) -> doctest.DocTest:
    """The page as one session: everything outside the fences is blanked, so that line numbers stay right."""
    text = page.read_text(encoding="utf-8")
    lines = [""] * (text.count("\n") + 1)
    for fence in FENCE.finditer(text):
        first = text.count("\n", 0, fence.start(1))
        for i, line in enumerate(fence.group(1).splitlines()):
            lines[first + i] = line
    return doctest.DocTestParser().get_doctest("\n".join(lines), {"__name__": "__main__"}, page.name, str(page), 0)


WITH_EXAMPLES = [page for page in PAGES if examples_of(page).examples]


@pytest.mark.parametrize("page", WITH_EXAMPLES, ids=lambda page: str(page.relative_to(ROOT)))
def test_examples_of_the_page_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # pages may write files
    said = io.StringIO()
    result = doctest.DocTestRunner(optionflags=FLAGS).run(examples_of(page), out=said.write)
    assert result.failed == 0, said.getvalue()


def test_every_prompt_stands_in_a_fence_that_runs() -> None:
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        shown = re.findall(r"^\s*>>>", text, re.MULTILINE)
        run = [line for body in FENCE.findall(text) for line in re.findall(r"^\s*>>>", body, re.MULTILINE)]
        assert len(shown) == len(run), f"{page.name}: a `>>>` outside a pycon fence is never run"


def test_code_of_the_readme_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    hm.save(hm.shapes.icosphere(2), "bunny.obj")
    code = re.findall(r"^```python\n(.*?)^```$", (ROOT / "README.md").read_text(encoding="utf-8"), re.M | re.S)
    assert len(code) == 1
    Path("readme.py").write_text(code[0])
    runpy.run_path("readme.py")


def test_every_reason_is_in_the_table_of_errors() -> None:
    sources = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "src").rglob("*.py"))
    reasons = set(re.findall(r'reason="(\w+)"', sources))
    page = (ROOT / "docs/guide/errors.md").read_text(encoding="utf-8")
    assert "nonmanifold_edge" in reasons
    assert {reason for reason in reasons if f"`{reason}`" not in page} == set()


def test_picture_is_what_the_viewer_draws_today() -> None:
    from halfmesh.viewer import FIGURE_FACES, FIGURE_POINTS, structure_diagram

    drawn = structure_diagram(hm.Mesh(FIGURE_FACES, FIGURE_POINTS))
    kept = (ROOT / "docs/images/structure.svg").read_text(encoding="utf-8")
    assert kept == drawn, "write docs/images/structure.svg anew with halfmesh.viewer.save_structure_diagram"


def test_every_picture_of_a_page_is_there_and_small() -> None:
    pictures = [
        page.parent / name
        for page in PAGES
        for name in re.findall(r"!\[[^]]+\]\(([^)]+\.(?:png|svg))\)", page.read_text(encoding="utf-8"))
    ]
    assert len(pictures) >= 6
    assert [picture for picture in pictures if not 0 < picture.stat().st_size < 200_000] == []


def test_page_of_the_command_line_names_every_command_and_option() -> None:
    from halfmesh.cli.app import app

    page = (ROOT / "docs/api/command-line.md").read_text(encoding="utf-8")
    for name, command in app.commands.items():
        assert f"## halfmesh {name}" in page
        for option in command.params:
            assert all(spelling in page for spelling in option.opts if spelling.startswith("--")), option


@pytest.mark.parametrize("example", ["umbrella_smoothing", "boundary_walk", "degree_histogram", "breadth_first"])
def test_loop_in_the_guide_is_the_one_of_the_example(example: str) -> None:
    page = (ROOT / "docs/guide/kernels.md").read_text(encoding="utf-8")
    program = (ROOT / "examples" / f"{example}.py").read_text(encoding="utf-8")
    loops = [
        loop for loop in re.findall(r"```python\n(@hm.kernel\n.*?)```", page, re.DOTALL) if loop.strip() in program
    ]
    assert len(loops) == 1


def test_extra_for_benchmarks_names_what_they_compare_with() -> None:
    from benchmarks.environment import LIBRARIES

    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    compared = {name for peer, library in LIBRARIES.items() if peer != "halfmesh" for name in library.install}
    assert set(project["optional-dependencies"]["bench"]) == compared
