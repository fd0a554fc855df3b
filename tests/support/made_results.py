"""Results as a run would have left them, made up: the report needs no tracking to be looked at."""

from pathlib import Path

import numpy as np

from regkit.metrics import METRICS, JointErrors, Measure
from regkit.primitives import SPHERE
from regkit.report import Record, Run
from regkit.report.frame_drawing import DrawnPrimitives, FrameDrawing

METHODS = {
    "sog": {"kind": "direct", "shape": {"kind": "sog"}, "solver": {"kind": "lbfgs", "memory": 5}},
    "gsog": {"kind": "direct", "shape": {"kind": "gsog"}, "solver": {"kind": "lbfgs", "memory": 5}},
    "icp": {"kind": "direct", "shape": {"kind": "mesh"}, "solver": {"kind": "lbfgs", "memory": 9}},
}
FRAMES, JOINTS = 9, ("head", "hand", "foot")
ENVIRONMENT = {"date": "2020-02-20 20:20", "processor": "abacus", "cores": 2, "libraries": {}}


def form(kind: str, random: np.random.Generator) -> DrawnPrimitives:
    count = 6
    capsules = kind == "capsules"
    return DrawnPrimitives(
        kind=kind,
        centres=0.5 * random.normal(size=(count, 3)),
        axes=np.tile(np.eye(3), (count, 1, 1)),
        scales=0.1 * random.uniform(0.5, 1.5, size=(count, 3)),
        weights=np.ones(count),
        halves=np.full(count if capsules else 0, 0.1),
        radii=np.full((count if capsules else 0, 2), 0.05),
        surfaces=np.tile(0.07 * SPHERE, (count if kind == "solids" else 0, 1, 1)),
    )


def record(
    random: np.random.Generator, error: float, *, kind: str = "gaussians", compared: bool = True
) -> Record:
    """Errors [m] around a mean one, and looks at two frames."""
    raw = error * random.uniform(0.5, 1.5, size=(FRAMES, len(JOINTS)))
    looks = [
        FrameDrawing(
            frame=index,
            why=why,
            points=random.normal(size=(50, 3)),
            primitives=form(kind, random),
            bones=random.normal(size=(4, 2, 3)),
            markers=random.normal(size=(3, 3)),
            reference=random.normal(size=(3 if compared else 0, 3)),
        )
        for index, why in ((0, "first"), (FRAMES - 1, "last, worst"))
    ]
    return Record(
        fps=10.0,
        size=1.7,
        errors=JointErrors(JOINTS, raw, 0.5 * raw) if compared else None,
        surface_distances=np.full(FRAMES, 0.01),
        inlier_shares=np.full(FRAMES, 0.9),
        verdicts=np.full(FRAMES, "found"),
        seconds=np.full(FRAMES, 0.05),
        preprocessing=np.full(FRAMES, 0.01),
        evaluations=np.full(FRAMES, 12.0),
        drawings=tuple(looks),
    )


def measure(record: Record) -> Measure:
    """The figures of a record that a table needs; the others cannot be had."""
    known: dict[str, float | None] = dict.fromkeys(METRICS)
    known |= {"frames": FRAMES, "fps": 20.0, "surface_distance_mm": 10.0, "lost_frames": None}
    if record.errors is not None:
        known["joint_error_raw_cm"] = 100.0 * float(record.errors.raw.mean())
        known["joint_error_adjusted_cm"] = 100.0 * float(record.errors.adjusted.mean())
        known["lost_frames"] = 0
    return Measure(**known)


def made_run(
    recordings: int = 7,
    *,
    methods: dict[str, dict] = METHODS,
    compared: bool = True,
    failures: dict[str, dict[str, str]] | None = None,
    prefix: str = "take",
) -> Run:
    """A run whose methods have errors of 3, 4, 5 ... cm, and less on earlier recordings."""
    random = np.random.default_rng(3)
    kinds = ("gaussians", "gaussians", "points", "capsules")
    records = {
        method: {
            f"{prefix}{index}": record(
                random, 0.01 * (3 + rank + 0.3 * index), kind=kinds[rank % 4], compared=compared
            )
            for index in range(recordings)
        }
        for rank, method in enumerate(methods)
    }
    config = {"name": "made", "dataset": {"kind": "depth", "root": "somewhere"}, "methods": methods}
    return Run(
        config=config,
        text="name: made\n",
        environment=ENVIRONMENT,
        measures={m: {s: measure(one) for s, one in by.items()} for m, by in records.items()},
        failures=failures or {},
        records=records,
    )


def links(folder: Path) -> list[str]:
    """Every file under a folder, from there."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())
