"""`python -m benchmarks [--quick] [--only TASK,...] [--peers NAME,...]`, and `python -m benchmarks render`."""

from __future__ import annotations

import argparse
import sys

from rich.console import Console

from benchmarks import environment, report, runner
from benchmarks.data import ROOT
from benchmarks.tasks import TASKS


def main() -> int:
    options = parser().parse_args()
    console = Console()
    if not console.is_terminal:
        console.width = 180
    if options.command == "render":
        return report.render(options.quick, console)
    peers = options.peers.split(",") if options.peers else list(environment.LIBRARIES)
    tasks = options.only.split(",") if options.only else list(TASKS)
    unknown = [*(set(peers) - set(environment.LIBRARIES)), *(set(tasks) - set(TASKS))]
    if unknown:
        console.print(f"unknown: {', '.join(unknown)}")
        console.print(f"tasks: {', '.join(TASKS)}; peers: {', '.join(environment.LIBRARIES)}")
        return 2
    with console.status("installing the libraries (openmesh is compiled: minutes)"):
        outcomes = environment.prepare(peers)
    with console.status("measuring") as status:
        results = runner.run(tasks, peers, options.quick, outcomes, tell=status.update)
    report.show(results, tasks, console)
    console.print(f"saved in {runner.results_path(options.quick).relative_to(ROOT)}")
    everything = not (options.only or options.peers or options.quick)
    return report.render(options.quick, console) if everything else 0


def parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("benchmarks", description="halfmesh beside other mesh libraries")
    parser.add_argument("command", nargs="?", choices=["run", "render"], default="run")
    parser.add_argument("--quick", action="store_true", help="small meshes and few rounds")
    parser.add_argument("--only", default="", metavar="TASK,...", help=", ".join(TASKS))
    parser.add_argument("--peers", default="", metavar="NAME,...", help=", ".join(environment.LIBRARIES))
    return parser


if __name__ == "__main__":
    sys.exit(main())
