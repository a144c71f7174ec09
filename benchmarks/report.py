"""The tables: in the terminal, in `docs/benchmarks.md` and in the README, all from one `results.json`."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

from rich.console import Console
from rich.table import Table as RichTable

from benchmarks.compact import ENCODE, POLYLLA_ON_IT, RULES, random_case
from benchmarks.data import ROOT
from benchmarks.figures import OURS, YARDSTICKS, Figures, Record, fastest, ratio, seconds_per_item
from benchmarks.growing import growth
from benchmarks.operators import QUOTED, QUOTED_TRIANGLES, SPLIT, operations
from benchmarks.polylla import COPIES, LARGE, QUOTED_TIME, case_of
from benchmarks.runner import results_path
from benchmarks.task import Task, size
from benchmarks.tasks import PARTS, TASKS
from benchmarks.verdicts import verdicts

SPEEDS = "Speed in multiples of the fastest other library's, and the best time."


@dataclass
class Table:
    """One table, whatever it is shown in."""

    title: str
    head: list[str]
    rows: list[list[str]]
    caption: str = ""
    remarks: list[str] = field(default_factory=list)

    def markdown(self, level: int = 3) -> str:
        lines = [f"{'#' * level} {self.title}", ""] if self.title else []
        lines += [self.caption, ""] if self.caption else []
        lines += [" | ".join(["", *row, ""]).strip() for row in (self.head, ["---"] * len(self.head), *self.rows)]
        lines += ["", *(f"- {remark}" for remark in self.remarks)] if self.remarks else []
        return "\n".join(lines) + "\n"

    def rich(self) -> RichTable:
        table = RichTable(title=self.title, caption="\n".join([self.caption, *self.remarks]).strip() or None,
                          title_justify="left", caption_justify="left")  # fmt: skip
        for name in self.head:
            table.add_column(name)
        for row in self.rows:
            table.add_row(*row, style="bold" if row[0] == OURS else None)
        return table


# ---- one table per task ----------------------------------------------------------------------------------------------


def task_table(figures: Figures, task: Task) -> Table:
    """Rows are ways, columns are cases, our ways first, then the others by speed."""
    cases = list(dict.fromkeys(record["case"] for record in figures.records if record["task"] == task.name))
    ways = dict.fromkeys((record["peer"], record["way"]) for record in figures.of(task.name))
    cells = {(record["peer"], record["way"], record["case"]): record for record in figures.of(task.name)}

    def order(way: tuple[str, str]) -> tuple[bool, float]:
        records = [cells[*way, case] for case in cases if (*way, case) in cells]
        return way[0] != OURS, min(seconds_per_item(record) for record in records)

    rows = []
    for peer, way in sorted(ways, key=order):
        records = [cells.get((peer, way, case)) for case in cases]
        told = [speed(record, figures.rival(task.name, case)) for record, case in zip(records, cases, strict=True)]
        rows.append([peer, way, *told, notes([record for record in records if record])])
    caption = SPEEDS if any(peer != OURS for peer, _ in ways) else "The best time."
    caption = caption.replace("time.", f"time of one {task.item}.") if task.name in PER_ITEM else caption
    return Table(task.title, ["library", "way", *cases, "notes"], rows, caption, remarks(figures, task))


def handle_table(figures: Figures, task: Task) -> Table:
    """Rows are libraries, columns are the kinds of step."""
    kinds = list(dict.fromkeys(record["way"] for record in figures.of(task.name)))
    peers = dict.fromkeys(record["peer"] for record in figures.of(task.name))
    rows = []
    for peer in sorted(peers, key=lambda peer: peer != OURS):
        cells = [figures.ours(task.name, "", kind) if peer == OURS else figures.rival(task.name, "", peer, kind)
                 for kind in kinds]  # fmt: skip
        told = [
            speed(cell, figures.rival(task.name, "", "openmesh", kind)) for cell, kind in zip(cells, kinds, strict=True)
        ]
        rows.append([peer, *told, notes([cell for cell in cells if cell][:1])])
    caption = "Speed in multiples of openmesh's, and the best time of one step."
    return Table(task.title, ["library", *kinds, "notes"], rows, caption, remarks(figures, task))


def operator_table(figures: Figures, task: Task) -> Table:
    """Ours, with the time of one operation, and what others' C++ was measured at elsewhere."""
    cases = list(dict.fromkeys(record["case"] for record in figures.of(task.name)))
    rows = []
    for way in dict.fromkeys(record["way"] for record in figures.of(task.name)):
        records = [figures.ours(task.name, case, way) for case in cases]
        counted = [operations(record) for record in records if record]
        each = [duration(r["best"] / n) for r, n in zip(filter(None, records), counted, strict=True)]
        told = f"{' and '.join(f'{n:,}' for n in counted)} times, {' and '.join(each)} each"
        rows.append([OURS, way, *(speed(record, None) for record in records), told])
        for peer, seconds in QUOTED[way].items():
            cells = [duration(seconds) if case == f"{QUOTED_TRIANGLES:,} coherent" else "" for case in cases]
            if any(cells):
                rows.append([peer, way, *cells, "C++, quoted"])
    caption = "The best time, asking first included. What is quoted was measured elsewhere, on 2 cores of 2.5 GHz."
    return Table(task.title, ["library", "way", *cases, "notes"], rows, caption, remarks(figures, task))


def polylla_table(figures: Figures, task: Task) -> Table:
    """Times, and the quality of what came out."""
    cases = list(dict.fromkeys(record["case"] for record in figures.records if record["task"] == task.name))
    table = task_table(figures, task)
    records = [figures.ours(task.name, case) for case in cases]
    for what, told in (
        ("triangles", [f"{r['items']:,}" if r else "" for r in records]),
        ("polygons", [f"{r['facts']['polygons']:,.0f}" if r else "" for r in records]),
        ("polygons that are not simple", [f"{r['facts']['not simple']:.0f}" if r else "" for r in records]),
        (
            "peak, bytes a triangle, with the result",
            [f"{r['peak'] / r['items']:.0f}" if r else "" for r in records],
        ),
    ):
        table.rows.append([OURS, what, *told, ""])
    cells = [duration(QUOTED_TIME * 1e-9) if case == case_of(LARGE, "Qhull's order") else "" for case in cases]
    if any(cells):
        table.rows.append(["the authors'", "Polylla-Mesh-DCEL", *cells, "C++, quoted; 322,065 polygons of a like mesh"])
    return table


def compact_table(figures: Figures, task: Task) -> Table:
    """What the compact form takes, and how long one of each thing."""
    cases = list(dict.fromkeys(record["case"] for record in figures.of(task.name)))
    records = {way: [figures.ours(task.name, case, way) for case in cases] for way in (ENCODE, "memory", POLYLLA_ON_IT)}
    rows = [
        ["bits per edge", *[f"{r['facts']['bits']:.2f}" if r else "" for r in records[ENCODE]]],
        ["peak while it is made, of the mesh's bytes", *map(peak_share, records["memory"])],
    ]
    for way, what in ((ENCODE, "making it, an edge"), *((rule, f"`{rule}`, random") for rule in RULES),
                      (POLYLLA_ON_IT, "Polylla on it, a triangle")):  # fmt: skip
        told = [figures.ours(task.name, case, way) for case in cases]
        rows.append([what, *map(each, told)])
    caption = (
        "halfmesh alone. The authors' program: 5.51 bits an edge, 0.52 us an edge to make, 72 us a triangle, quoted."
    )
    return Table(task.title, ["what", *cases], rows, caption, remarks(figures, task))


def peak_share(record: Record | None) -> str:
    """The peak beyond the points, in bytes a triangle and as a share of the 54 that a mesh takes."""
    if record is None:
        return ""
    each = (record["facts"]["peak"] - record["facts"]["points"]) / record["items"]
    return f"{each:.1f} B a triangle, {each / 54:.0%}"


def memory_table(figures: Figures, task: Task) -> Table:
    cases = list(dict.fromkeys(record["case"] for record in figures.of(task.name)))
    rows = []
    for peer in sorted({record["peer"] for record in figures.of(task.name)}, key=lambda peer: (peer != OURS, peer)):
        records = {record["case"]: record for record in figures.of(task.name, peer=peer)}
        told = [f"{r['held'] / r['items']:.0f}, peak {r['peak'] / r['items']:.0f}" if (r := records.get(case)) else ""
                for case in cases]  # fmt: skip
        rows.append([peer, *told, next(iter(records.values()))["note"]])
    caption = "Bytes per triangle, by the growth of the process: held after the build, and the peak during it."
    return Table(task.title, ["library", *cases, "notes"], rows, caption, remarks(figures, task))


def first_use_table(figures: Figures, task: Task) -> Table:
    imports = sorted(figures.of(task.name, "import"), key=lambda record: float(record["best"]))
    others = [record for record in figures.of(task.name) if record["case"] != "import"]
    rows = [
        [r["peer"], "import", f"{r['best']:.2f} s", f"{r['best'] - r['numpy']:+.2f} s beyond NumPy's"] for r in imports
    ] + [[r["peer"], r["case"], f"{r['best']:.2f} s", f"{r['first']:.2f} s on an empty cache"] for r in others]
    return Table(task.title, ["library", "what", "best", "more"], rows, "", remarks(figures, task))


def remarks(figures: Figures, task: Task) -> list[str]:
    """What is missing from the table, and where the libraries disagree."""
    silent: dict[tuple[str, tuple[str, ...]], list[str]] = {}
    for record in figures.silent(task.name):
        reason = str(record.get("error") or record["skipped"])
        cases = tuple(r["case"] for r in figures.silent(task.name, record["peer"], reason))
        who = silent.setdefault((reason, cases), [])
        if record["peer"] not in who:
            who.append(record["peer"])
    told = []
    for (reason, cases), peers in silent.items():
        everywhere = not any(figures.of(task.name, peer=peer) for peer in peers)
        told.append(f"{', '.join(peers)}: {reason}" + ("" if everywhere else f" ({', '.join(cases)})"))
    return told + figures.disagreements(task.name)


def notes(records: list[Record]) -> str:
    """What is to be known of a way; by case where the cases differ."""
    by_note: dict[str, list[str]] = {}
    for record in records:
        if record["note"]:
            by_note.setdefault(record["note"], []).append(record["case"].split()[0])
    if len(by_note) == 1:
        return next(iter(by_note))
    return "; ".join(f"{', '.join(cases)}: {note}" for note, cases in by_note.items())


def speed(record: Record | None, rival: Record | None) -> str:
    """`4.1 x, 85 ms`."""
    if record is None:
        return ""
    per_item = record["items"] if record["task"] in PER_ITEM else 1
    times = ratio(rival, record)
    return (f"{factor(times)}, " if times is not None else "") + duration(record["best"] / per_item)


def factor(times: float) -> str:
    """Two digits that count: `4.1 x`, `0.08 x`, `230 x`."""
    return f"{times:.0f} x" if times >= 100 else f"{times:.2g} x"


def duration(seconds: float) -> str:
    unit, scale = next(pair for pair in UNITS if seconds >= pair[1] or pair[1] == 1e-9)
    digits = f"{seconds / scale:.3g}"
    return f"{float(digits):,.0f} {unit}" if "e" in digits else f"{digits} {unit}"


UNITS = (("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9))
PER_ITEM = {"handles", "edits", "growing", "queries", "polylla"}  # one of them is what a reader wants to know of
TABLES = {
    "handles": handle_table,
    "operators": operator_table,
    "memory": memory_table,
    "first_use": first_use_table,
    "polylla": polylla_table,
    "compact": compact_table,
}


def tables(figures: Figures, tasks: list[str]) -> list[Table]:
    return [TABLES.get(name, task_table)(figures, TASKS[name]) for name in tasks if figures.of(name)]


# ---- the verdict and the short table ---------------------------------------------------------------------------------


def verdict_table(figures: Figures, part: str) -> Table:
    words = {True: "yes", False: "**no**", None: "-"}
    rows = [[row.what, row.asked, row.reached, words[row.passed]] for row in verdicts(figures, part)]
    return Table("What is asked, what is reached", ["what", "asked", "reached", "passed"], rows)


def short_table(figures: Figures, part: str) -> Table:
    """The README's: the main tasks of a part, ours beside the fastest other library and openmesh."""
    if part == "meshing":
        return beside_the_authors(figures)
    large, medium = size(figures.plan.large), size(figures.plan.medium)
    asked = [
        (f"build the mesh, {large} triangles", "build", f"{large} coherent", ""),
        ("the same, shuffled", "build", f"{large} shuffled", ""),
        (f"read OFF, {medium} triangles", "reading", f"OFF {medium}", ""),
        ("read OBJ", "reading", f"OBJ {medium}", ""),
        ("write OBJ", "writing", f"OBJ {medium}", ""),
        ("a loop over all one-rings in your code", "rings", f"{medium} coherent", "hm.kernel with the circulator"),
        ("one step through handles", "handles", "one step", "walk"),
        ("vertex normals", "normals", f"{medium} coherent", ""),
        ("flip an edge where it may be, from Python", "edits", "flip", ""),
        ("split an edge, from Python", "edits", "split_edge", ""),
        ("collapse an edge where it may be, from Python", "edits", "collapse", ""),
        ("add a face, from Python", "growing", growth("add_face", max(figures.plan.growing)), ""),
    ]
    rows = [[what, *compared(figures, task, case, way)] for what, task, case, way in asked if task in PARTS[part]]
    if part == "changing":
        kernel = beside_quoted(figures, f"{medium} coherent")
        rows.insert(0, ["split every face and collapse it back in your code", *kernel])
    return Table("", ["", OURS, "fastest other", "openmesh", "ratio"], rows)


def beside_the_authors(figures: Figures) -> Table:
    """Polylla and the compact mesh, beside what is known of the program of their authors."""
    largest = max(figures.plan.points)
    qhull, coherent = (figures.ours("polylla", case_of(largest, order)) for order in ("Qhull's order", "coherent"))
    case = random_case(COPIES * largest)
    encode, on_it = (figures.ours("compact", case, way) for way in (ENCODE, POLYLLA_ON_IT))
    bits = f"{encode['facts']['bits']:.2f}" if encode else ""
    rows = [
        ["Polylla, a triangle, as Qhull lists them", each(qhull), f"{QUOTED_TIME} ns, compiled on a machine like this"],
        ["the same in coherent order", each(coherent), ""],
        [f"compact mesh of {COPIES * largest:,} vertices, bits an edge", bits, "5.51"],
        ["making it, an edge", each(encode), "520 ns"],
        ["Polylla on it, a triangle", each(on_it), "72 us"],
    ]
    return Table("", ["", OURS, "the authors' C++, quoted"], rows)


def each(record: Record | None) -> str:
    """The time of one item."""
    return duration(seconds_per_item(record)) if record else ""


def compared(figures: Figures, task: str, case: str, way: str) -> list[str]:
    """Ours, the fastest other library's doing the same kind of thing, openmesh's, and ours against the fastest."""
    ours = figures.ours(task, case, way)
    theirs = {"rings": "Python loop over vv", "handles": "walk"}.get(task, "")
    rivals = [r for r in figures.of(task, case) if r["peer"] not in {OURS, *YARDSTICKS}]
    if task == "rings":
        rivals = [r for r in rivals if "loop" in r["way"]]  # arrays and matrices are not a loop of one's own
    elif task == "handles":
        rivals = [r for r in rivals if r["way"] == way]
    rival, openmesh = fastest(rivals), figures.rival(task, case, "openmesh", theirs)
    who, times = f" ({rival['peer']})" if rival else "", ratio(rival, ours)
    told = "" if times is None else factor(times)
    return [speed(ours, None), speed(rival, None) + who, speed(openmesh, None), told]


def beside_quoted(figures: Figures, case: str) -> list[str]:
    """The same cells for operators in a kernel, where the others' are C++ and quoted."""
    ours = figures.ours("operators", case, SPLIT)
    if case != f"{QUOTED_TRIANGLES:,} coherent":
        return [speed(ours, None), "", "", ""]
    pmp, openmesh = (QUOTED[SPLIT][peer] for peer in ("pmp", "OpenMesh"))
    told = factor(pmp / ours["best"]) if ours else ""
    return [speed(ours, None), f"{duration(pmp)} (pmp, C++)", f"{duration(openmesh)} (C++)", told]


def machine_line(figures: Figures) -> str:
    m = figures.results["machine"]
    libraries = figures.results["libraries"]
    versions = [f"{name} {told['version']}" for name, told in libraries.items() if told["version"]]
    missing = [f"{name} ({told['reason']})" for name, told in libraries.items() if not told["version"]]
    line = (
        f"{m['processor']}, {m['cores']} cores, {m['memory']}, {m['system']}, Python {m['python']}, "
        f"NumPy {m['numpy']}, Numba {m['numba']}, {m['date'][:10]}. {', '.join(versions)}."
    )
    return line + (f" Not installed: {'; '.join(missing)}." if missing else "")


# ---- where they go ---------------------------------------------------------------------------------------------------


def show(results: Record, tasks: list[str], console: Console) -> None:
    figures = Figures(results)
    for table in tables(figures, tasks):
        console.print(table.rich())
    for part in PARTS:
        if is_measured(figures, part):
            console.print(verdict_table(figures, part).rich())
    console.print(machine_line(figures))


def is_measured(figures: Figures, part: str) -> bool:
    return any(figures.of(task, peer=OURS) for task in PARTS[part])


def render(quick: bool, console: Console) -> int:
    """Write the tables of what was measured between the marks of `docs/benchmarks.md` and `README.md`."""
    figures = Figures(json.loads(results_path(quick).read_text()))
    missing = 0
    for part in PARTS:
        if not is_measured(figures, part):
            continue
        long = [verdict_table(figures, part), *tables(figures, PARTS[part])]
        pages = {
            ROOT / "docs" / "benchmarks.md": "\n".join([machine_line(figures), "", *(t.markdown() for t in long)]),
            ROOT / "README.md": short_table(figures, part).markdown(),
        }
        for path, text in pages.items():
            if not replace_block(path, part, text):
                console.print(f"{path.relative_to(ROOT)}: no marks of bench:{part}")
                missing += 1
    return 1 if missing else 0


def replace_block(path: Path, part: str, text: str) -> bool:
    """Put the text between the marks of a part; False if the file has none."""
    begin, end = f"<!-- bench:{part}:begin -->", f"<!-- bench:{part}:end -->"
    page = path.read_text() if path.exists() else ""
    if begin not in page or end not in page.split(begin, 1)[1]:
        return False
    before, rest = page.split(begin, 1)
    path.write_text(f"{before}{begin}\n\n{text}\n{end}{rest.split(end, 1)[1]}")
    return True
