"""The commands, their options and exit codes."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from halfmesh.cli.words import complain, complaint_about, reason_of
from halfmesh.errors import HalfmeshError, InvalidMeshError, PreconditionError

__all__ = ["app"]


class Refusal(click.ClickException):
    """One line on stderr, exit code 1."""

    def show(self, file: Any = None) -> None:
        """Print it."""
        complain(self.message)


class App(click.Group):
    """Commands whose expected failures are one line and an exit code, never a traceback."""

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command."""
        try:
            return super().invoke(ctx)
        except BrokenPipeError:
            raise  # the reader has gone (`halfmesh info ... | head`): Click leaves quietly
        except (HalfmeshError, OSError) as error:
            raise Refusal(reason_of(error)) from None
        except KeyboardInterrupt:
            click.echo("interrupted", err=True)
            ctx.exit(130)


def _print_version(ctx: click.Context, parameter: click.Parameter, value: bool) -> None:
    if value:
        from halfmesh import __version__

        click.echo(f"halfmesh {__version__}")
        ctx.exit()


_FILES = click.argument("files", metavar="FILE...", nargs=-1, required=True, type=click.Path(path_type=Path))


@click.group(cls=App, context_settings={"help_option_names": ["-h", "--help"]})
@click.option("--version", is_flag=True, is_eager=True, expose_value=False, callback=_print_version, help="Say which.")
def app() -> None:
    """Half-edge meshes of any polygons: look at files, convert and check them."""


@app.command()
@_FILES
@click.option("--json", "as_json", is_flag=True, help="A list with one object for each file, for machines.")
def info(files: tuple[Path, ...], as_json: bool) -> None:
    """Counts, topology, orientation, degrees, memory and times of mesh files.

    A file that can't be read, or whose faces no half-edge mesh can hold, is reported as far as it goes; the exit code
    is then 1.
    """
    from halfmesh.cli import pages
    from halfmesh.cli.report import Report

    reports: list[Report] = []
    for path in files:
        report = Report.of(path)
        if not as_json and report.rows():
            pages.show_report(report, first=not any(before.rows() for before in reports))
        if report.error is not None:
            sys.stdout.flush()
            complain(report.complaint)
        reports.append(report)
    if as_json:
        pages.show_json([report.as_dict() for report in reports])
    _exit_if(any(report.error is not None for report in reports))


@app.command()
@_FILES
def check(files: tuple[Path, ...]) -> None:
    """Read mesh files, build them, and test every law of a valid mesh.

    One line for each file; exit code 1 if one can't be read, can't be held, or breaks a law.
    """
    from halfmesh.cli.report import Report

    failed = False
    for path in files:
        report = Report.of(path, check=True)
        if report.error is not None:
            complain(report.complaint)
            failed = True
        else:
            click.echo(f"{click.format_filename(path)}: valid, {report.headline}")
    _exit_if(failed)


@app.command()
@click.argument("source", metavar="IN", type=click.Path(path_type=Path))
@click.argument("target", metavar="OUT", type=click.Path(path_type=Path))
def convert(source: Path, target: Path) -> None:
    """Read IN and write OUT, in the formats of their suffixes.

    Polygons stay polygons; nothing is merged, dropped or reordered, and the faces need not make a mesh. OUT is replaced
    only once it is written whole.
    """
    import halfmesh as hm
    from halfmesh.io.formats import format_of

    format_of(target)  # an unknown suffix is refused before anything is read
    data = hm.io.read_data(source)
    hm.io.write(
        target, data.faces, data.points, edges=data.edges,
        vertex=data.vertex, halfedge=data.halfedge, edge=data.edge, face=data.face, meta=data.meta,
    )  # fmt: skip
    click.echo(f"{click.format_filename(target)}: {data.n_vertices:,} vertices, {data.n_faces:,} faces")


@app.command()
@click.argument("source", metavar="IN", type=click.Path(path_type=Path))
@click.argument("target", metavar="OUT", type=click.Path(path_type=Path))
@click.option("--plot", metavar="PICTURE", type=click.Path(path_type=Path), help="Draw the polygons: png, svg, pdf ...")
@click.option("--report", "with_report", is_flag=True, help="Counts, times, and the quality of the polygons.")
@click.option("--json", "as_json", is_flag=True, help="The report as one object, for machines.")
def polylla(source: Path, target: Path, plot: Path | None, with_report: bool, as_json: bool) -> None:
    """Read the triangles of IN, join them into simple polygons, and write those to OUT.

    Triangles that share their longest edge, or lead to the same one, become one polygon. No point is added or moved.
    Any format is read and written, by the suffixes.
    """
    from halfmesh.cli.polylla import draw_joined, join, show_joined
    from halfmesh.io.formats import format_of
    from halfmesh.viewer.polygons import check_picture

    format_of(target)  # an unknown suffix is refused before anything is read
    try:
        if plot is not None:
            check_picture(plot)
        made = join(source, target, quality=with_report or as_json)
        show_joined(made, as_json=as_json)
        if plot is not None:
            draw_joined(made, plot)
    except ImportError as error:
        raise Refusal(str(error)) from None
    except (InvalidMeshError, PreconditionError) as error:
        raise Refusal(complaint_about(source, error)) from None


@app.command()
def warmup() -> None:
    """Compile all kernels of the library now, so that nothing has to wait for it later."""
    from halfmesh._jit import gears
    from halfmesh.cli import pages

    if gears.interpret_only:
        raise Refusal("NUMBA_DISABLE_JIT is set: there is nothing to compile")
    pages.show_warmup()


@app.command()
@click.argument("files", metavar="[FILE...]", nargs=-1, type=click.Path(path_type=Path))
@click.option("--out", default="demo", type=click.Path(path_type=Path), help="Folder for what it writes; default: demo")
@click.option("--size", default="large", type=click.Choice(["small", "large"]), help="Of the mesh that it makes.")
def demo(files: tuple[Path, ...], out: Path, size: str) -> None:
    """Build, check and query a mesh, run a loop of your own on it, draw the structure.

    It makes a mesh of 327,680 triangles (5,120 with --size small), or takes the files given.
    """
    from halfmesh.cli.tour import show_tour

    _exit_if(not show_tour(files, out, size))


def _exit_if(failed: bool) -> None:
    if failed:
        raise click.exceptions.Exit(1)
