"""Compile everything now: the work behind ``halfmesh warmup``.

A kernel is compiled for the types of its arguments at its first call. So each of the `jobs` does something ordinary
with a tiny mesh, in the gear that always compiles; together they come past every kernel, which a test asserts.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Generator
from pathlib import Path

from halfmesh import _jit
from halfmesh.warmup.census import kernels_of, n_compiled_here, n_from_cache, never_compiled
from halfmesh.warmup.jobs import jobs

__all__ = ["Helper", "help_out", "jobs", "kernels_of", "n_compiled_here", "n_from_cache", "never_compiled", "warm_up"]


def warm_up() -> Generator[tuple[str, int, int], None, None]:
    """Compile all kernels of the library, or read them from the cache.

    Yields
    ------
    (name, i, n) : str, int, int
        Before each of the `n` jobs, and once more with ``i == n`` when all is done.

    Notes
    -----
    Safe to run again: what is in the cache is only read. Where nothing is it takes a minute or so.

    Examples
    --------
    >>> from halfmesh.warmup import jobs, warm_up
    >>> steps = warm_up()
    >>> next(steps) == ("building triangles", 0, len(jobs()))
    True
    >>> steps.close()
    """
    todo = jobs()
    with _jit.compiling_always(), tempfile.TemporaryDirectory() as folder:
        for i, (name, job) in enumerate(todo):
            yield name, i, len(todo)
            job(Path(folder))
    yield "done", len(todo), len(todo)


class Helper:
    """Another process that does the jobs from the last to the first, and leaves what it compiles in the cache.

    Compiling keeps the GIL, so a thread would be no help. Whoever does the jobs from the first on meets the helper in
    the middle, and finds the rest in the cache; then the helper is of no use any more.
    """

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory()
        command = [sys.executable, "-c", "from halfmesh.warmup import help_out; help_out()", self._folder.name]
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)

    def dismiss(self) -> int:
        """Stop it; how many kernels it has compiled."""
        self._process.terminate()
        said = self._process.communicate()[0].split()
        self._folder.cleanup()
        return int(said[-1]) if said else 0


def help_out() -> None:
    """What a `Helper` does: after each job it says how many kernels it has compiled so far."""
    with _jit.compiling_always():
        for _, job in reversed(jobs()):
            job(Path(sys.argv[1]))
            print(n_compiled_here(), flush=True)
