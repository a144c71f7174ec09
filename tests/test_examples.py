"""Every example runs to its asserts, compiled and interpreted."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

EXAMPLES = sorted((Path(__file__).resolve().parent.parent / "examples").glob("*.py"))


@pytest.mark.parametrize("gear", ["compiled", "interpreted"])
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_runs(
    path: Path, gear: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    if gear == "interpreted":
        monkeypatch.setattr("halfmesh._jit.gears.interpret_only", True)
    try:
        runpy.run_path(str(path), run_name="__main__")
    except ImportError as error:
        if "pip install halfmesh[" not in str(error):
            raise
        pytest.skip(str(error))
    assert capsys.readouterr().out, "an example tells what it found"
