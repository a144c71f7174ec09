"""What all tests share: the corpus of real files, the two gears, and how hard Hypothesis searches."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

ROOT = Path(__file__).resolve().parent.parent
CORPUS = Path(os.environ.get("HALFMESH_CORPUS", ROOT.parent / "shared" / "corpus"))
INTERPRETED = os.environ.get("NUMBA_DISABLE_JIT", "0") not in {"", "0"}

# A first call may compile for seconds, so time limits per example and health checks of speed say nothing here.
_patient = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("default", _patient, max_examples=20 if INTERPRETED else 60)
settings.register_profile("ci", settings.get_profile("default"), derandomize=True, print_blob=True)
settings.register_profile("fuzz", _patient, max_examples=5000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci" if os.environ.get("CI") else "default"))


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out `fuzz` unless it is asked for by name, and `large` where kernels are interpreted."""
    unwanted = {"large"} if INTERPRETED else set()
    if "fuzz" not in config.option.markexpr:
        unwanted.add("fuzz")
    left_out = [item for item in items if any(item.get_closest_marker(name) for name in unwanted)]
    if left_out:
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if item not in set(left_out)]


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of real mesh files that the project did not write (its MANIFEST.tsv holds their true figures)."""
    if not (CORPUS / "MANIFEST.tsv").is_file():
        pytest.skip("the corpus of real mesh files is not here; set HALFMESH_CORPUS to its folder")
    return CORPUS
