"""What came of all cases: figures for each kind, and the failures by their place."""

from __future__ import annotations

import json
import shutil
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tests.fuzz.case import Case, drawn
from tests.fuzz.trial import FINE, Outcome
from tests.fuzz.workers import Number

KEPT = 3
"""Number of examples of a failure that are kept."""


@dataclass
class Summary:
    """The outcomes so far.

    Attributes:
        seed: Seed of the cases.
        folder: Folder for the inputs that failed.
    """

    seed: int
    folder: Path
    by_kind: dict[str, Counter[str]] = field(default_factory=dict)
    by_group: dict[str, Counter[str]] = field(default_factory=dict)
    failures: dict[tuple[str, str, str], list[tuple[int, Number, Outcome]]] = field(
        default_factory=dict
    )
    slowest: float = 0.0
    largest: int = 0

    def add(self, number: Number, outcome: Outcome) -> None:
        """Count an outcome; the input of a failure is kept."""
        group, index = number
        name = drawn(group, self.seed, index)[1].name
        self.by_kind.setdefault(name, Counter())[outcome.result] += 1
        self.by_group.setdefault(group, Counter())[outcome.result] += 1
        self.slowest = max(self.slowest, outcome.seconds)
        self.largest = max(self.largest, outcome.bytes)
        if not outcome.failed:
            return
        case = Case.of(group, self.seed, index)
        alike = self.failures.setdefault((name, outcome.result, outcome.where), [])
        alike.append((len(case.content), number, outcome))
        alike.sort(key=lambda one: one[0])
        if len(alike) <= KEPT or alike[0][1] == number:
            self._keep(case, outcome)

    def _keep(self, case: Case, outcome: Outcome) -> None:
        name = f"{case.kind.name.replace('/', '-')}-{outcome.result}-{case.group}-{case.number}"
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        case.written(folder)
        text = f"{case.place}: {case.given}: {', '.join(case.mutations)}\n{outcome.reason}\n"
        (folder / "REASON.txt").write_text(text, errors="replace")

    def table(self) -> str:
        """Figures for each kind."""
        results = list(dict.fromkeys((*FINE, *(r for one in self.by_kind.values() for r in one))))
        lines = [f"{'kind':26}" + "".join(f"{result:>10}" for result in ("cases", *results))]
        for name, counts in sorted(self.by_kind.items()):
            figures = (sum(counts.values()), *(counts[result] for result in results))
            lines.append(f"{name:26}" + "".join(f"{figure or '-':>10}" for figure in figures))
        return "\n".join(lines)

    def listed(self) -> str:
        """The failures, the most frequent first, each with its smallest example."""
        lines = []
        for (kind, result, where), alike in sorted(self.failures.items(), key=lambda i: -len(i[1])):
            size, (group, number), outcome = alike[0]
            reason = " | ".join(outcome.reason.strip().splitlines()[-2:])[:300]
            lines.append(f"{len(alike):5} {kind} {result} {where}")
            lines.append(f"      {group} {number} ({size} bytes): {reason}")
        return "\n".join(lines)

    def figures(self) -> dict[str, Any]:
        """All figures in one object."""
        groups = {
            group: {"cases": sum(counts.values()), **counts}
            for group, counts in self.by_group.items()
        }
        return {
            "seed": self.seed,
            **groups,
            "failed": sum(map(len, self.failures.values())),
            "slowest_s": round(self.slowest, 2),
            "largest_mb": self.largest // 10**6,
        }

    def write(self) -> None:
        """Write the failures beside their inputs."""
        rows = [
            {"kind": kind, "result": result, "where": where, "count": len(alike)}
            | {"cases": [number for _, number, _ in alike[:20]], "reason": alike[0][2].reason}
            for (kind, result, where), alike in self.failures.items()
        ]
        self.folder.mkdir(parents=True, exist_ok=True)
        text = json.dumps({**self.figures(), "failures": rows}, indent=1)
        (self.folder / "failures.json").write_text(text + "\n")
