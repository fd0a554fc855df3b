"""Every plug-in that is installed keeps the laws of its group: the built-ins, and all others."""

from importlib.util import find_spec
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from bags import walk_rows, write_bag
from kinect_files import write_kinect
from marker_files import write_trc
from places import DATA
from public_layouts import SMALL, write_itop, write_pdt13, write_records

from regkit.testing import conformance
from regkit.testing.samples import LINKAGE
from regkit_plugins.datasets.formats.organized_clouds.records import RecordLayout

RECORD = RecordLayout(width=SMALL.width, height=SMALL.height)
HELD = TemporaryDirectory(prefix="regkit-layouts-")
PUBLIC = Path(HELD.name)
"""Small files in the layouts of published data sets, until the tests end."""
for folder in ("records", "itop", "pdt13"):
    (PUBLIC / folder).mkdir()
write_records(PUBLIC / "records" / "seq_b_3.bin", RECORD)
for view, split in product(("side", "top"), ("train", "test")):
    write_itop(PUBLIC / "itop", view, split)
write_pdt13(PUBLIC / "pdt13")

KINECT = [np.full((288, 320), 1000 + index, np.uint16) for index in range(4)]
"""Images of an Azure Kinect in one of its modes."""

RECORDED = {}
if find_spec("pyrealsense2") is not None:
    from soft_camera import record_walk

    walk = record_walk(PUBLIC / "realsense.db3", 4)
    RECORDED["sources.realsense_recording"] = {"path": str(walk)}

LOSSES = ("squares", "huber", "tukey", "geman_mcclure")
RIGID = {"shape": "cloud_gsog", "kernel": "local_likelihood", "solver": "gauss_newton"}

TestInstalled = conformance(
    examples={
        "datasets.depth": {"root": str(DATA / "human_walk")},
        "datasets.clouds": {"root": str(DATA / "mannequin")},
        "datasets.utd_mhad": {"root": str(Path(__file__).parent / "data" / "utd_mhad")},
        "datasets.synthetic": {
            "defaults": {"motion": {"kind": "clip", "name": "walk"}, "frames": 2},
            "takes": {"near": {}, "far": {"view": {"distance": 3.5}}},
        },
        "templates.composed": {
            "base": "human",
            "at": {"left_hand": {"kind": "hand", "side": "left"}},
        },
        "datasets.eval": {"root": str(PUBLIC / "records"), "record": RECORD.model_dump()},
        "datasets.smmc10": {"root": str(PUBLIC / "records"), "record": RECORD.model_dump()},
        "datasets.itop": {"root": str(PUBLIC / "itop")},
        "datasets.markers": {
            "path": str(write_trc(PUBLIC / "walk.trc", ("a", "b"), np.ones((3, 2, 3)))),
        },
        "datasets.pdt13": {
            "root": str(PUBLIC / "pdt13"),
            "intrinsics": {"focal_px": 36.0, "centre_px": [19.0, 15.5]},
        },
        "sources.azure_kinect": {"path": str(write_kinect(PUBLIC / "walk.mkv", KINECT))},
        "sources.folder": {"path": str(DATA / "human_walk")},
        "sources.rosbag": {"path": str(write_bag(PUBLIC / "walk", "mcap", walk_rows(4)))},
        **RECORDED,
        "templates.file": {"path": str(LINKAGE)},
        "templates.cloud": {"path": str(DATA / "mannequin" / "model.npz")},
        "kernels.likelihood": [{}, {"outliers": 0.2}],
        "kernels.point_to_point": [{}, {"robust": {"loss": "huber"}}, {"reverse_weight": 0.5}],
        "kernels.point_to_plane": [
            {},
            {"point_share": 0.0, "robust": {"loss": "squares", "scale": 0.1}},
            {"angle_deg": 80.0, "reverse_weight": 0.2, "noise": None},
        ],
        "kernels.sphere_distance": [{}, *({"robust": {"loss": loss}} for loss in LOSSES)],
        "methods.direct": [
            {"shape": "gsog", "kernel": "likelihood", "solver": "gauss_newton"},
            {"shape": "sog", "kernel": "correlation", "solver": "lbfgs"},
            {"shape": "sphere", "kernel": "sphere_distance", "solver": "ipopt"},
            {"shape": "mesh", "kernel": "point_to_plane", "solver": "gauss_newton"},
        ],
        "methods.landmarks": {"terms": ["landmarks"], "shape": "sog"},
        "methods.coarse_to_fine": RIGID,
    }
)
