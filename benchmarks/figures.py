"""Questions to the records of a run: who took how long at what."""

from __future__ import annotations

from typing import Any

from benchmarks.timing import QUICK, Plan

Record = dict[str, Any]
OURS = "halfmesh"
YARDSTICKS = {"scipy"}  # shown, but no mesh library: not counted as "the fastest other"


class Figures:
    """The records of one `results.json`; `plan` tells which sizes it was made with."""

    def __init__(self, results: Record) -> None:
        self.results = results
        self.records: list[Record] = results["records"]
        self.plan = QUICK if results.get("quick") else Plan()

    def of(self, task: str, case: str = "", peer: str = "") -> list[Record]:
        """The records with a figure; an empty word asks for all."""
        return [
            record
            for record in self.records
            if record["task"] == task
            and case in ("", record["case"])
            and peer in ("", record["peer"])
            and "way" in record
        ]

    def silent(self, task: str, peer: str = "", reason: str = "") -> list[Record]:
        """The records without a figure: failures, and what a library does not offer."""
        return [
            record
            for record in self.records
            if record["task"] == task
            and "way" not in record
            and peer in ("", record["peer"])
            and reason in ("", record.get("error"), record.get("skipped"))
        ]

    def ours(self, task: str, case: str, way: str = "") -> Record | None:
        """Our record of that way, or the fastest of our ways."""
        return fastest([record for record in self.of(task, case, OURS) if way in ("", record["way"])])

    def rival(self, task: str, case: str, peer: str = "", way: str = "") -> Record | None:
        """The fastest record of the others, or of one of them; of equal ways where `way` names one."""
        others = [record for record in self.of(task, case, peer) if peer or record["peer"] not in {OURS, *YARDSTICKS}]
        return fastest([record for record in others if way in ("", record["way"])])

    def disagreements(self, task: str) -> list[str]:
        """Cases in which the libraries did not come to the same figures."""
        complaints = []
        for case in dict.fromkeys(record["case"] for record in self.of(task)):
            facts: dict[str, dict[float, list[str]]] = {}
            for record in self.of(task, case):
                for key, value in record.get("facts", {}).items():
                    facts.setdefault(key, {}).setdefault(float(f"{value:.6g}"), []).append(record["peer"])
            for key, values in facts.items():
                if len(values) > 1:
                    told = "; ".join(f"{value:g}: {', '.join(sorted(set(who)))}" for value, who in values.items())
                    complaints.append(f"{case}: {key} differ: {told}")
        return complaints


def fastest(records: list[Record]) -> Record | None:
    return min(records, key=lambda record: seconds_per_item(record), default=None)


def seconds_per_item(record: Record) -> float:
    return float(record["best"]) / int(record["items"])


def ratio(slower: Record | None, faster: Record | None) -> float | None:
    """How many times as long, item by item."""
    if slower is None or faster is None:
        return None
    return seconds_per_item(slower) / seconds_per_item(faster)
