"""Compiles the loops that most tests call, in one process: a frame for each family of kernels."""

from pathlib import Path

import numpy as np

import regkit

DATA = Path(__file__).resolve().parents[2] / "docs" / "examples" / "data"


def main() -> None:
    walk = regkit.load_recording(DATA / "human_walk", frames=2)
    template = regkit.load_template("human", height=1.63)
    start = regkit.track(walk, template, method="best").poses[0]
    for method in ("paper", "spheres", "icp"):
        regkit.track(walk, template, method=method, start=start)
    cloud = np.random.default_rng(0).normal(size=(300, 3))
    regkit.align(cloud, cloud + 0.01)


if __name__ == "__main__":
    main()
