"""``halfmesh polylla``: a mesh of triangles in, a mesh of polygons out, and what there is to say about it."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from rich.text import Text

import halfmesh as hm
from halfmesh.cli.pages import console, progress_bar
from halfmesh.geometry import QualitySummary, polygon_quality
from halfmesh.viewer import save_polygons_plot

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Joined", "draw_joined", "join", "show_joined"]

MOST_BELOW = 5_000  # triangles drawn below the polygons; more are only a gray veil


@dataclass(frozen=True)
class Joined:
    """What was made of a file.

    Attributes
    ----------
    source, target : Path
    triangles, polygons : Mesh
    report : PolyllaReport
    quality : QualitySummary or None
        Of the polygons, if it was asked for.
    """

    source: Path
    target: Path
    triangles: hm.Mesh
    polygons: hm.Mesh
    report: hm.PolyllaReport
    quality: QualitySummary | None

    def as_dict(self) -> dict[str, Any]:
        """Plain numbers and texts, for JSON."""
        made = {"file": str(self.source), "out": str(self.target), "report": self.report.as_dict()}
        return made | ({"quality": self.quality.as_dict()} if self.quality else {})


def join(source: Path, target: Path, *, quality: bool) -> Joined:
    """Read triangles, join them, write the polygons; with a bar where somebody is watching."""
    out = console()
    with progress_bar(out) as bar:
        task = bar.add_task("reading", total=3 + quality)

        def done(step: float, following: str) -> None:
            bar.update(task, completed=step, description=following)

        triangles = hm.load(source)
        done(1, "joining triangles")
        polygons, report = hm.polylla(triangles, report=True, progress=_within(done))
        done(2, "writing")
        hm.save(polygons, target)
        done(3, "measuring")
        summary = polygon_quality(polygons).summary() if quality else None
        done(3 + quality, "done")
    return Joined(source, target, triangles, polygons, report, summary)


def _within(done: Callable[[float, str], None]) -> Callable[[str, float], None]:
    """The second step, which tells about itself as it goes."""
    return lambda phase, fraction: done(1 + fraction, f"joining triangles: {phase} done")


def show_joined(made: Joined, *, as_json: bool) -> None:
    """Print it: a line, and the tables if the quality was measured."""
    if as_json:
        click.echo(json.dumps(made.as_dict(), indent=2))
        return
    report = made.report
    name = click.format_filename(made.target)
    click.echo(f"{name}: {report.n_polygons:,} polygons from {report.n_triangles:,} triangles")
    if made.quality is not None:
        for title, table in (("report", str(report)), ("quality", str(made.quality))):
            _show_table(title, table)


def draw_joined(made: Joined, plot: Path) -> None:
    """Write the picture, with the triangles below if they are not too many."""
    below = made.triangles if made.triangles.n_faces <= MOST_BELOW else None
    with console().status(Text("drawing ...", style="dim"), spinner="line", refresh_per_second=4):
        save_polygons_plot(made.polygons, plot, triangulation=below)


def _show_table(title: str, table: str) -> None:
    out = console()
    out.print()
    out.print(Text(title, style="bold"))
    for line in table.splitlines():
        out.print(Text(f"  {line}"))
