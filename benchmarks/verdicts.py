"""The bars that halfmesh has set itself, and the figures it reached: everything computed from one `results.json`."""

from __future__ import annotations

from dataclasses import dataclass, replace

from benchmarks import edits
from benchmarks.compact import ENCODE, POLYLLA_ON_IT
from benchmarks.figures import OURS, Figures, Record, fastest, ratio, seconds_per_item
from benchmarks.growing import growth
from benchmarks.operators import FLIP, QUOTED, QUOTED_TRIANGLES, SPLIT
from benchmarks.operators import operations as operations_of
from benchmarks.polylla import COPIES, LARGE, ORDERS, QUOTED_TIME, case_of
from benchmarks.queries import SMALLEST
from benchmarks.task import size
from benchmarks.throughput import BUILD, FILES

WORDS = {True: "yes", False: "no", None: "not measured"}


@dataclass(frozen=True)
class Verdict:
    """One bar: what, what is asked, what was reached; `passed` is None where nothing was measured."""

    what: str
    asked: str
    reached: str
    passed: bool | None


def verdicts(figures: Figures, part: str) -> list[Verdict]:
    """The bars of one part of the benchmarks, "asking", "changing" or "meshing"; see `tasks.PARTS`."""
    groups = {
        "asking": (building, adversarial, polygons, memory, loops, files, first_use),
        "changing": (operators, editing, growing),
        "meshing": (polylla, compact, throughput),
    }
    return [row for group in groups[part] for row in group(figures)]


def at_least(what: str, bar: float, figure: float | None, unit: str, more: str = "") -> Verdict:
    return verdict(what, f">= {bar:g} {unit}", figure, unit, None if figure is None else figure >= bar, more)


def at_most(what: str, bar: float, figure: float | None, unit: str, more: str = "") -> Verdict:
    return verdict(what, f"<= {bar:g} {unit}", figure, unit, None if figure is None else figure <= bar, more)


def told(what: str, figure: float | None, unit: str, more: str = "") -> Verdict:
    """A figure that belongs beside the others, and has no bar."""
    return replace(at_least(what, 0, figure, unit, more), asked="", passed=None)


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
        rows.append(told(what, ratio(alike, figures.ours("build", case)), "x", than(alike)))
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


def operators(figures: Figures) -> list[Verdict]:
    n, rows = 20 * 4**figures.plan.medium, []
    for way, bar in ((SPLIT, 400), (FLIP, 25)):
        record = figures.ours("operators", f"{n:,} coherent", way)
        quoted = " and ".join(f"{seconds * 1e3:.0f} ({peer})" for peer, seconds in QUOTED[way].items())
        count = f", {operations_of(record):,} times" if record else ""
        count += f"; C++ quoted: {quoted}" if n == QUOTED_TRIANGLES else ""
        time = None if record is None else float(record["best"]) * 1e3
        rows.append(at_most(f"in a kernel, {n:,} triangles: {way}", bar * n / QUOTED_TRIANGLES, time, "ms", count))
    return rows


def editing(figures: Figures) -> list[Verdict]:
    """From plain Python; and what is asked between operators, which must cost the same in any mesh."""
    rows = []
    for kind in edits.KINDS:
        rival = figures.rival("edits", kind)
        speed = ratio(rival, figures.ours("edits", kind))
        rows.append(at_least(f"{kind} from plain Python, against the faster of the others", 2, speed, "x", than(rival)))
    small, large = size(SMALLEST), size(figures.plan.large)
    for way in ("flip, ask", "split an edge, ask"):
        grown = ratio(figures.ours("queries", large, way), figures.ours("queries", small, way))
        rows.append(at_most(f"{way} for all counts: in {large} triangles, to {small}", 1.5, grown, "x"))
    return rows


def growing(figures: Figures) -> list[Verdict]:
    least, most = min(figures.plan.growing), max(figures.plan.growing)
    rows = []
    for kind in ("add_vertex", "add_face"):
        few, many = growth(kind, least), growth(kind, most)
        ours = figures.ours("growing", many)
        grown = ratio(ours, figures.ours("growing", few))
        rows.append(at_most(f"{kind}: a call of {most:,}, to one of {least:,}", 1.5, grown, "x"))
        rival = figures.rival("growing", many, "openmesh")
        rows.append(told(f"{kind}, {most:,} calls, against openmesh's", ratio(rival, ours), "x"))
    case = f"{size(figures.plan.large)} coherent"
    build = figures.ours("bulk", case, "Mesh")
    added = figures.ours("bulk", case, "add_vertices, add_faces")
    half = figures.ours("bulk", case, "add_faces, the second half")
    rival = figures.rival("bulk", case, "openmesh")
    return [
        *rows,
        at_most(f"add_faces, {case} triangles to an empty mesh: time, to building", 1.3, ratio(added, build), "x"),
        told("add_faces, the second half to a mesh of the first: time per face, to building", ratio(half, build), "x"),
        told("add_faces, against openmesh's", ratio(rival, added), "x"),
    ]


def polylla(figures: Figures) -> list[Verdict]:
    """Time, how it grows, and that every polygon is simple, which sorting all their corners tells."""
    largest, rows = max(figures.plan.points), []
    for order, bar in zip(ORDERS, (170, 300), strict=True):
        record = figures.ours("polylla", case_of(largest, order))
        time = None if record is None else 1e9 * float(record["best"]) / int(record["items"])
        quoted = f"; the authors' C++, quoted: {QUOTED_TIME}" if order != "coherent" and largest == LARGE else ""
        rows.append(at_most(f"Polylla, {case_of(largest, order)}: time of a triangle", bar, time, "ns", quoted))
    small, large = (figures.ours("polylla", case_of(n, "coherent")) for n in (largest, COPIES * largest))
    rows.append(at_most(f"Polylla, {COPIES} x as many triangles: time of a triangle", 1.5, ratio(large, small), "x"))
    memory = None
    if small is not None and large is not None:
        memory = (large["peak"] / large["items"]) / (small["peak"] / small["items"])
    rows.append(at_most(f"Polylla, {COPIES} x as many triangles: peak memory of a triangle", 1.2, memory, "x"))
    failed = [record["facts"]["not simple"] for record in figures.of("polylla", peer=OURS)]
    return [*rows, at_most("Polylla, polygons that are not simple", 0, sum(failed) if failed else None, "polygons")]


def compact(figures: Figures) -> list[Verdict]:
    """Size, time to make it, time of a question, and Polylla on it with as many polygons."""
    rows = []
    for case in dict.fromkeys(record["case"] for record in figures.of("compact")):
        encode = figures.ours("compact", case, ENCODE)
        bits = None if encode is None else float(encode["facts"]["bits"])
        rows.append(at_most(f"compact, {case}: bits per edge", 5.0, bits, "bits"))
        for way, what, bar, unit, scale in (
            (ENCODE, "making it, an edge", 0.2, "us", 1e6),
            ("twin_of", "twin in a kernel", 0.5, "us", 1e6),
            ("next_of", "next in a kernel", 0.5, "us", 1e6),
            ("origin_of", "origin in a kernel", 0.8, "us", 1e6),
            ("face_of", "face in a kernel", 0.8, "us", 1e6),
            (POLYLLA_ON_IT, "Polylla on it, a triangle", 8, "us", 1e6),
        ):
            record = figures.ours("compact", case, way)
            figure = None if record is None else scale * seconds_per_item(record)
            rows.append(at_most(f"compact, {case}: {what}", bar, figure, unit))
        told = figures.ours("compact", case, POLYLLA_ON_IT)
        others = None if told is None else abs(told["facts"]["polygons"] - told["facts"]["on a mesh"])
        rows.append(at_most(f"compact, {case}: polygons that a mesh has and it has not", 0, others, "polygons"))
    return rows


def throughput(figures: Figures) -> list[Verdict]:
    """Bytes read and triangles built in a second."""
    rows = []
    for case, what, bar, unit in (
        *((name, f"reading {name}", 150, "MB/s") for name in FILES),
        (BUILD, "columns from arrays, coherent order", 10, "million triangles/s"),
    ):
        record = figures.ours("throughput", case)
        rows.append(at_least(what, bar, None if record is None else 1e-6 / seconds_per_item(record), unit))
    return rows


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
