"""Recordings in the layouts of published data sets."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from public_layouts import SMALL, write_itop, write_pdt13, write_records
from scipy.io import savemat

from regkit.interfaces import Dataset
from regkit_plugins.datasets.formats.organized_clouds.records import RecordLayout
from tests.fuzz.kind import Damaged, Files, Kind
from tests.fuzz.seeds.recordings import everything, nonsense

RECORD = {"width": SMALL.width, "height": SMALL.height, "marker_slots": 2, "joint_slots": 1}

INTRINSICS = {"focal_px": SMALL.fx, "centre_px": [SMALL.cx, SMALL.cy]}


def write_mhad(root: Path) -> None:
    for folder, name, values in (
        ("Depth", "depth", np.full((240, 320, 2), 2000)),
        ("Skeleton", "skel", np.ones((20, 3, 2))),
    ):
        (root / folder).mkdir(parents=True)
        file = "depth" if name == "depth" else "skeleton"
        path = root / folder / f"a1_s1_t1_{file}.mat"
        savemat(path, {f"d_{name}": values}, do_compression=True)


def _written(write: Callable[[Path], None]) -> Callable[[], list[Files]]:
    def seeds() -> list[Files]:
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            write(root)
            files = sorted(path for path in root.rglob("*") if path.is_file())
            return [{path.relative_to(root).as_posix(): path.read_bytes() for path in files}]

    return seeds


def _kind(
    name: str, files: tuple[str, ...], write: Callable[[Path], None], weight: float, **options: Any
) -> Kind:
    kind = name.partition("-")[0]

    def read(folder: Path) -> Any:
        data = {"kind": kind, "root": str(folder), **options}
        dataset = Dataset.parse(data, place="fuzz", field="dataset")
        return [everything(recording) for recording in dataset.chosen()]

    def check(value: Any, file: Damaged) -> Iterator[str]:
        for one in value:
            yield from nonsense(one, file)

    forms = dict.fromkeys(files, "binary")
    return Kind(f"datasets/{name}", _written(write), forms, read, check, whole=True, weight=weight)


OTHERS = (
    _kind(
        "smmc10",
        ("seq_a.bin",),
        lambda root: write_records(root / "seq_a.bin", RecordLayout(**RECORD)),
        0.7,
        record=RECORD,
    ),
    _kind(
        "pdt13",
        ("M2_D1_depth.mat", "M2_D1_joints.mat"),
        write_pdt13,
        0.7,
        intrinsics=INTRINSICS,
    ),
    _kind(
        "pdt13-hdf5",
        ("M2_D1_depth.mat", "M2_D1_joints.mat"),
        lambda root: write_pdt13(root, hdf5=True),
        0.7,
        intrinsics=INTRINSICS,
    ),
    _kind("itop", ("ITOP_side_test_labels.h5",), write_itop, 0.3),
    _kind(
        "utd_mhad",
        ("Depth/a1_s1_t1_depth.mat", "Skeleton/a1_s1_t1_skeleton.mat"),
        write_mhad,
        0.5,
    ),
)
