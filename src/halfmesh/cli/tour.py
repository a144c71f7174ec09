"""The demo as it is printed."""

from __future__ import annotations

import platform
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from rich.text import Text

import halfmesh as hm
from halfmesh import _jit
from halfmesh.cli.pages import console, print_table
from halfmesh.cli.words import complain, complaint_about, where_kept
from halfmesh.demo import Section, draw_structure, explore, make_example
from halfmesh.errors import HalfmeshError
from halfmesh.warmup import n_compiled_here

if TYPE_CHECKING:
    from rich.console import Console

__all__ = ["show_tour"]


def show_tour(files: tuple[Path, ...], folder: Path, size: str) -> bool:
    """Print the demo on these files, or on a mesh that it makes; False if one was refused."""
    out = console()
    started = time.perf_counter()
    versions = f"halfmesh {hm.__version__}, Python {platform.python_version()}, NumPy {np.__version__}"
    out.print(Text(f"{versions}, {_jit.n_threads()} threads", style="dim"))
    with out.status(
        Text("working (a first run compiles for some seconds) ...", style="dim"), spinner="line", refresh_per_second=4
    ):
        refused = _tour(out, files, folder, size)
    _show_end(out, time.perf_counter() - started)
    if not files:
        out.print(Text("now with a mesh of yours: halfmesh demo bunny.obj", style="dim"))
    return refused == 0


def _tour(out: Console, files: tuple[Path, ...], folder: Path, size: str) -> int:
    shown: set[str] = set()
    refused = 0
    if not files:
        path, section = make_example(folder, size)
        _show(out, section)
        files = (path,)
    for path in files:
        try:
            for section in explore(path):
                section.code, code = "" if section.code in shown else section.code, section.code
                shown.add(code)  # the loop of the user is the same for every file: once is enough
                _show(out, section)
        except BrokenPipeError:  # the reader of the output has gone, the file is not to blame
            raise
        except (HalfmeshError, OSError) as error:
            complain(complaint_about(path, error))
            refused += 1
    _show(out, draw_structure(folder))
    return refused


def _show(out: Console, section: Section) -> None:
    out.print()
    out.print(Text(section.title, style="bold"))
    for line in section.text:
        out.print(Text(f"  {line}"))
    if section.code:
        if section.text:
            out.print()
        for line in section.code.splitlines():
            out.print(Text(f"    {line}", style="cyan"))
        out.print()
    if section.rows:
        print_table(out, section.rows, header=section.header, figures=section.figures, codes=section.codes)
    for line in section.remarks:
        out.print(Text(f"  {line}"))


def _show_end(out: Console, seconds: float) -> None:
    n = n_compiled_here()
    compiled = f"{n} kernels were compiled on the way" if n else "no kernel had to be compiled"
    out.print()
    out.print(Text(f"{seconds:.1f} s in all; {compiled}", style="dim"))
    out.print(Text(where_kept(), style="dim"), soft_wrap=True)
