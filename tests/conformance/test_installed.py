"""Every plug-in that is installed keeps the laws of its group: the built-ins, and all others."""

from pathlib import Path

from regkit.testing import conformance
from regkit.testing.samples import LINKAGE

DATA = Path(__file__).parents[2] / "docs" / "examples" / "data"

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
        "templates.file": {"path": str(LINKAGE)},
        "templates.cloud": {"path": str(DATA / "mannequin" / "model.npz")},
        "kernels.likelihood": [{}, {"outliers": 0.2}],
        "kernels.point_to_point": [{}, {"robust": {"loss": "huber"}}, {"way_back": 0.5}],
        "kernels.point_to_plane": [
            {},
            {"point_share": 0.0, "robust": {"loss": "squares", "scale": 0.1}},
            {"angle_deg": 80.0, "way_back": 0.2, "noise": None},
        ],
        "kernels.sphere_distance": [{}, *({"robust": {"loss": loss}} for loss in LOSSES)],
        "methods.direct": [
            {"shape": "gsog", "kernel": "likelihood", "solver": "gauss_newton"},
            {"shape": "sog", "kernel": "correlation", "solver": "lbfgs"},
            {"shape": "sphere", "kernel": "sphere_distance", "solver": "ipopt"},
            {"shape": "mesh", "kernel": "point_to_plane", "solver": "gauss_newton"},
        ],
        "methods.coarse_to_fine": RIGID,
    }
)
