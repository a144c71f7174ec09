"""Building: from an array of faces to connectivity, on spheres and real files; then on the adversarial meshes."""

from __future__ import annotations

from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import CORPUS, load
from benchmarks.task import Case, Task, size
from benchmarks.timing import Plan, Way, race

REAL = ("off/pmp__bunny_adaptive.off", "obj/oded__nefertiti-lowres.obj")


def cases(plan: Plan) -> list[Case]:
    spheres = [
        Case(f"{size(level)} {order}", f"sphere-{level}" + ("-shuffled" if order == "shuffled" else ""))
        for level in (plan.small, plan.large)
        for order in ("coherent", "shuffled")
    ]
    return spheres + [Case(path.split("__")[1], f"file:{path}") for path in REAL if (CORPUS / path).exists()]


def adversarial_cases(plan: Plan) -> list[Case]:
    n = plan.adversarial
    return [
        Case("sphere, to compare", f"sphere-{plan.small}"),
        Case("fan, vertex 0", f"fan-first-{n}"),
        Case("fan, last vertex", f"fan-last-{n}"),
        Case("bipyramid", f"bipyramid-{n}"),
        Case("book", f"book-{n}"),
    ]


def polygon_cases(plan: Plan) -> list[Case]:
    corners = 60 * 4**plan.large  # as many as the large sphere has
    return [
        Case("large sphere", f"sphere-{plan.large}", "halfmesh"),
        Case("quads", f"quads-{corners}", "halfmesh"),
        Case("quads and triangles", f"mixed-{corners}", "halfmesh"),
        Case("one polygon", f"polygon-{plan.sides}", "halfmesh"),
    ]


def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
    surface = load(case.mesh)
    ways = peer.builds(surface)
    if case.name == "book":
        ways = {label: refusing(way) for label, way in ways.items()}
    return [timing.as_dict() for timing in race(ways, plan, surface.n_corners)]


def refusing(way: Way) -> Way:
    """The way with its refusal as the result: a mesh that can't be held must be refused as fast as others are built."""

    def run() -> bool:
        try:
            way.run()
        except Exception:
            return True
        return False

    return Way(run, way.note, facts=lambda refused: {"refused": refused})


BUILD = Task("build", "Connectivity from an array of faces", "corner", cases, measure)
WORST = Task("worst", "The same for adversarial meshes", "corner", adversarial_cases, measure, patience=60)
POLYGONS = Task("polygons", "The same for polygons", "corner", polygon_cases, measure)
