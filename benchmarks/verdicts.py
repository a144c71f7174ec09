"""The bars that halfmesh has set itself, and the figures it reached: everything computed from one `results.json`."""

from __future__ import annotations

from dataclasses import dataclass, replace

from benchmarks.figures import OURS, Figures, Record, fastest, ratio
from benchmarks.task import size

WORDS = {True: "yes", False: "no", None: "not measured"}


@dataclass(frozen=True)
class Verdict:
    """One bar: what, what is asked, what was reached; `passed` is None where nothing was measured."""

    what: str
    asked: str
    reached: str
    passed: bool | None


def verdicts(figures: Figures) -> list[Verdict]:
    groups = (building, adversarial, polygons, memory, loops, files, first_use)
    return [row for group in groups for row in group(figures)]


def at_least(what: str, bar: float, figure: float | None, unit: str, more: str = "") -> Verdict:
    return verdict(what, f">= {bar:g} {unit}", figure, unit, None if figure is None else figure >= bar, more)


def at_most(what: str, bar: float, figure: float | None, unit: str, more: str = "") -> Verdict:
    return verdict(what, f"<= {bar:g} {unit}", figure, unit, None if figure is None else figure <= bar, more)


def verdict(what: str, asked: str, figure: float | None, unit: str, passed: bool | None, more: str) -> Verdict:
    reached = "not measured" if figure is None else f"{figure:.3g} {unit}{more}"
    return Verdict(what, asked, reached, passed)


def seconds(record: Record | None, key: str) -> float | None:
    return None if record is None else float(record[key])


def than(record: Record | None) -> str:
    return f" ({record['peer']}, {record['way']})" if record else ""


def building(figures: Figures) -> list[Verdict]:
    large, rows = size(figures.plan.large), []
    for order, bar in (("coherent", 4), ("shuffled", 2.5)):
        case = f"{large} {order}"
        rival = figures.rival("build", case)
        speed = ratio(rival, figures.ours("build", case))
        rows.append(at_least(f"build, {case} triangles, against the fastest peer", bar, speed, "x", than(rival)))
        alike = fastest([r for r in figures.of("build", case) if r["peer"] != OURS and r["note"] == "half-edge mesh"])
        what = f"build, {case} triangles, against the fastest half-edge mesh"
        rows.append(
            replace(
                at_least(what, 0, ratio(alike, figures.ours("build", case)), "x", than(alike)), asked="", passed=None
            )
        )
    return rows


def adversarial(figures: Figures) -> list[Verdict]:
    sphere, rows = figures.ours("worst", "sphere, to compare"), []
    for case in ("fan, vertex 0", "fan, last vertex", "bipyramid", "book"):
        record = figures.ours("worst", case)
        time = f", {record['best'] * 1e3:.1f} ms" if record else ""
        what = f"{case}: cost per triangle, to the coherent sphere's"
        rows.append(at_most(what, 3, ratio(record, sphere), "x", time))
    book = figures.ours("worst", "book")
    refused = None if book is None else bool(book["facts"]["refused"])
    return [*rows, Verdict("book: refused", "yes", WORDS[refused], refused)]


def polygons(figures: Figures) -> list[Verdict]:
    large = figures.ours("polygons", "large sphere")
    rows = [
        at_most(f"{case}: cost per corner, to triangles'", 1.3, ratio(figures.ours("polygons", case), large), "x")
        for case in ("quads", "quads and triangles")
    ]
    per_corner = ratio(figures.ours("polygons", "one polygon"), large)
    per_halfedge = None if per_corner is None else per_corner / 2  # each of its corners makes an exterior one too
    what = f"one polygon with {figures.plan.sides:,} sides: cost per halfedge, to triangles'"
    return [*rows, at_most(what, 1.3, per_halfedge, "x")]


def memory(figures: Figures) -> list[Verdict]:
    record = next(iter(figures.of("memory", f"{size(figures.plan.large)} coherent", OURS)), None)
    peaks = [record["peak"] / record["columns"] for record in figures.of("memory", peer=OURS)]
    columns = record["columns"] / record["items"] if record else None
    return [
        at_most("columns of a closed triangle mesh", 54, columns and round(columns, 3), "bytes per triangle"),
        at_most("peak while building, to the columns, input not counted", 3, max(peaks, default=None), "x"),
    ]


def loops(figures: Figures) -> list[Verdict]:
    case = f"{size(figures.plan.medium)} coherent"
    kernel = figures.ours("rings", case, "hm.kernel with the circulator")
    by_hand = [record for record in figures.of("rings", case, OURS) if "do-while" in record["way"]]
    fastest_by_hand = min(by_hand, key=lambda record: float(record["best"]), default=None)
    loop = figures.rival("rings", case, "openmesh", "Python loop over vv")
    step = figures.ours("handles", "one step", "walk")
    their_step = figures.rival("handles", "one step", "openmesh", "walk")
    return [
        at_most("one-ring loop with the circulator, to a do-while by hand", 1.1, ratio(kernel, fastest_by_hand), "x"),
        at_least("one-ring loop, against openmesh's Python loop", 100, ratio(loop, kernel), "x"),
        at_least("checked handle step in plain Python, against openmesh's", 2, ratio(their_step, step), "x"),
    ]


def files(figures: Figures) -> list[Verdict]:
    rows = []
    for task in ("reading", "writing"):
        for suffix in ("OFF", "OBJ"):
            case = f"{suffix} {size(figures.plan.medium)}"
            ours = figures.ours(task, case)
            for peer in ("", "lagrange"):
                rival = figures.rival(task, case, peer)
                if rival or not peer:
                    whom = "lagrange" if peer else "the fastest peer"
                    what = f"{task} {suffix}, against {whom}"
                    rows.append(at_least(what, 1, ratio(rival, ours), "x", than(rival)))
    return rows


def first_use(figures: Figures) -> list[Verdict]:
    medium = size(figures.plan.medium)
    imported = figures.ours("first_use", "import")
    beyond = imported["best"] - imported["numpy"] if imported else None
    info = figures.ours("first_use", "info on a small file")
    build = figures.ours("first_use", f"first build of {medium}")
    warmup = figures.ours("first_use", "warmup")
    lazy = None if imported is None else not imported["numba"]
    numba = Verdict("numba not imported by import halfmesh", "yes", WORDS[lazy], lazy)
    return [
        at_most("import halfmesh, beyond NumPy's import", 0.08, beyond, "s"),
        numba,
        at_most("halfmesh info on a small file, warm cache", 1, seconds(info, "best"), "s"),
        at_most("halfmesh info on a small file, empty cache", 2, seconds(info, "first"), "s"),
        at_most(f"first build of {medium} triangles, empty cache", 6, seconds(build, "first"), "s"),
        at_most("halfmesh warmup, empty cache", 60, seconds(warmup, "first"), "s"),
    ]
