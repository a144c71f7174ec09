"""An environment of its own for the libraries: `.bench/venv`. What can't be installed is reported, and not fatal."""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
import venv
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path

from benchmarks.data import ROOT

VENV = ROOT / ".bench" / "venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
PIP = (sys.executable, "-m", "pip", "--disable-pip-version-check", "--python", str(PYTHON), "install", "--quiet")
PATIENCE = 1800  # seconds for one library, built from source at the worst


@dataclass(frozen=True)
class Library:
    """How to install a library, and the distribution whose version is recorded."""

    install: tuple[str, ...]
    distribution: str
    needs_cmake: bool = False
    variables: dict[str, str] = field(default_factory=dict)


LIBRARIES = {
    "halfmesh": Library(("--editable", str(ROOT)), "halfmesh"),
    # openmesh has no wheels; its CMakeLists.txt is older than what new versions of cmake take
    "openmesh": Library(("openmesh",), "openmesh", needs_cmake=True, variables={"CMAKE_POLICY_VERSION_MINIMUM": "3.5"}),
    "trueform": Library(("trueform",), "trueform"),
    "lagrange": Library(("adobe-lagrange",), "adobe-lagrange"),
    "igl": Library(("libigl",), "libigl"),
    "meshlib": Library(("meshlib",), "meshlib"),
    "trimesh": Library(("trimesh", "scipy", "networkx"), "trimesh"),
    "pymeshlab": Library(("pymeshlab",), "pymeshlab"),
    "compas": Library(("compas",), "compas"),
    "potpourri3d": Library(("potpourri3d",), "potpourri3d"),
    "scipy": Library(("scipy",), "scipy"),
}


@dataclass(frozen=True)
class Outcome:
    """The installed version, or the reason why there is none."""

    version: str = ""
    reason: str = ""


def prepare(names: list[str]) -> dict[str, Outcome]:
    """Install what is missing, each library by a pip call of its own."""
    if not PYTHON.exists():
        venv.create(VENV, with_pip=False)  # our own pip does the work: some systems have none to give
    reasons = {name: install(LIBRARIES[name]) for name in names if LIBRARIES[name].distribution not in versions()}
    now = versions()
    return {name: Outcome(now.get(LIBRARIES[name].distribution, ""), reasons.get(name, "")) for name in names}


def install(library: Library) -> str:
    """Empty, or the reason why pip failed."""
    variables = os.environ | library.variables
    if library.needs_cmake and not shutil.which("cmake"):
        subprocess.run([*PIP, "cmake"], check=False)
        variables["PATH"] = os.pathsep.join([str(PYTHON.parent), variables["PATH"]])
    command = [*PIP, *library.install]
    try:
        done = subprocess.run(command, check=False, env=variables, capture_output=True, text=True, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        return f"not installed within {PATIENCE} s"
    complaints = [line.strip() for line in done.stderr.splitlines() if "error" in line.lower()]
    return "" if done.returncode == 0 else (complaints or ["pip failed"])[-1][:200]


def versions() -> dict[str, str]:
    """What the environment holds."""
    program = (
        "import json; from importlib.metadata import distributions as d;"
        "print(json.dumps({x.metadata['Name'].lower(): x.version for x in d()}))"
    )
    done = subprocess.run([str(PYTHON), "-c", program], check=True, capture_output=True, text=True)
    found: dict[str, str] = json.loads(done.stdout)
    return found


def facts() -> dict[str, object]:
    """The machine and the versions that everything depends on."""
    here = versions()
    return {
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "processor": processor(),
        "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count(),
        "memory": memory(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "numpy": here.get("numpy", ""),
        "numba": here.get("numba", ""),
        "load": os.getloadavg()[0] if hasattr(os, "getloadavg") else None,
    }


def processor() -> str:
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()


def memory() -> str:
    info = Path("/proc/meminfo")
    return f"{int(info.read_text().split()[1]) / 2**20:.0f} GiB" if info.exists() else ""
