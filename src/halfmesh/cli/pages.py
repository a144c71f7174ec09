"""How things look in a terminal: 80 columns at least, no colours and no bars where nobody is watching."""

from __future__ import annotations

import json
import time
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING, Any

import click
from rich.console import Console
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from halfmesh.cli.words import where_kept

if TYPE_CHECKING:
    from rich.progress import Progress, ProgressColumn

    from halfmesh.cli.report import Report

__all__ = ["console", "print_table", "progress_bar", "show_json", "show_report", "show_warmup"]


def console() -> Console:
    """Standard output; plain text in lines of 80 where it is no terminal."""
    return Console(highlight=False, markup=False, emoji=False, soft_wrap=False)


def print_table(
    out: Console,
    rows: Sequence[Sequence[str]],
    *,
    header: Sequence[str] = (),
    figures: Collection[int] = (),
    codes: Collection[int] = (),
) -> None:
    """Print aligned columns, without lines; `figures` are aligned at the right, `codes` have their color."""
    table = Table(box=None, show_header=bool(header), pad_edge=False, padding=(0, 2, 0, 0), header_style="dim")
    for i in range(len(rows[0])):
        right = i in figures
        table.add_column(
            header[i] if header else "",
            justify="right" if right else "left",
            no_wrap=right,
            style="cyan" if i in codes else "",
            overflow="fold",
        )
    for row in rows:
        table.add_row(*map(Text, row))
    _print_trimmed(out, Padding(table, (0, 0, 0, 2)))


def _print_trimmed(out: Console, what: Any) -> None:
    """Without the blanks that fill lines up: files and diffs don't want them."""
    if out.is_terminal:
        out.print(what)
        return
    with out.capture() as printed:
        out.print(what)
    for line in printed.get().splitlines():
        click.echo(line.rstrip())


def show_report(report: Report, *, first: bool = True) -> None:
    """Print what ``halfmesh info`` has to say of one file."""
    out = console()
    if not first:
        out.print()
    out.print(Text(click.format_filename(report.path), style="bold"), soft_wrap=True)  # a path stays in one piece
    print_table(out, report.rows())


def show_json(reports: list[dict[str, Any]]) -> None:
    """Print a list of objects."""
    click.echo(json.dumps(reports, indent=2))


def progress_bar(out: Console, *columns: ProgressColumn) -> Progress:
    """A bar, what else it shall show, and what is being done; gone when all is done, and silent without a terminal."""
    from rich.progress import BarColumn, Progress, TextColumn

    shown = (BarColumn(bar_width=30), *columns, TextColumn("{task.description}"))
    return Progress(*shown, console=out, transient=True, disable=not out.is_terminal)


def show_warmup() -> None:
    """Compile everything, with a bar, and say where it is kept."""
    from rich.progress import MofNCompleteColumn

    from halfmesh.warmup import Helper, n_compiled_here, n_from_cache, warm_up

    out = console()
    started = time.perf_counter()
    helper = Helper()
    try:
        with progress_bar(out, MofNCompleteColumn()) as progress:
            task = progress.add_task("", total=None)
            for name, i, n in warm_up():
                progress.update(task, completed=i, total=n, description=name)
    finally:
        n_by_helper = helper.dismiss()
    took = time.perf_counter() - started
    click.echo(f"{n_compiled_here() + n_by_helper} kernels compiled, {n_from_cache()} were there already: {took:.1f} s")
    click.echo(where_kept())
