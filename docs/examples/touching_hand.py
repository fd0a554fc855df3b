"""A hand that touches a table: a custom constraint with regkit's CasADi functions.

    python touching_hand.py

The index finger touches the plane y = 0, but is not visible. See docs/how-to/limits.md.
"""

import casadi
import numpy as np

from regkit.casadi import configuration, correlation, joint_limits, marker_positions, retract
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import ShapeModel, Template
from regkit.skeleton import PoseDescription


def main() -> dict[str, float]:
    """Registers the hand with and without the table, and returns the tip's distances to it [m]."""
    random = np.random.default_rng(0)
    hand = Template.load("hand")(side="right", length=0.19).body(0.19)
    bones, gaussians = hand.skeleton, ShapeModel.load("gsog")().bind(hand)
    tip = hand.markers.names.index("index_tip")

    # Ground truth: the index finger points at the table, the others are bent.
    bent = {f"{finger}_{part}": 60.0 for finger in ("middle", "ring", "little") for part in (2, 3)}
    truth = bones.pose(PoseDescription(joints={**bent, "index_1": (0.0, 20.0), "index_2": 15.0}))
    down = rigid(vector_to_matrix(np.array([np.pi, 0.0, 0.0])), np.zeros(3))
    height = float(hand.markers.place(hand.place(truth).transforms)[tip, 1])
    down[1, 3] = height
    truth = type(truth)(down, truth.balls, truth.hinges)

    # Data: points on all segments except those of the index finger.
    placed = gaussians.place(hand.place(truth).transforms)
    index = [bones.names.index(f"index_{part}") for part in (1, 2, 3)]
    seen = np.flatnonzero(~np.isin(gaussians.segments, index))
    chosen = random.choice(seen, 150)
    spread = gaussians.scales[chosen] * random.normal(size=(150, 3))
    points = placed.centres[chosen] + np.einsum("nij,nj->ni", placed.axes[chosen], spread)

    # Nonlinear program: a step from a perturbed pose to the data, within the joint limits.
    start = bones.limits.projected(
        bones.retract(truth, 0.1 * random.normal(size=bones.dofs) * (np.arange(bones.dofs) > 5))
    )
    step = casadi.MX.sym("step", bones.dofs)
    pose = retract(bones)(configuration(bones, start), step)
    energy = correlation(bones, gaussians, 150)(pose, points.T, np.ones(150), np.full(150, 1e-5))
    limits = joint_limits(bones)
    tip_height = marker_positions(bones, hand.markers)(pose)[1, tip]

    distances = {}
    for name, table in (("free", (-np.inf, np.inf)), ("touching", (0.0, 0.0))):
        solver = casadi.nlpsol(
            "hand", "ipopt",
            {"x": step, "f": energy, "g": casadi.vertcat(limits.function(pose), tip_height)},
            {"print_time": False, "ipopt": {"print_level": 0, "sb": "yes", "max_iter": 300}},
        )  # fmt: skip
        found = solver(
            x0=np.zeros(bones.dofs), lbx=-1.0, ubx=1.0,
            lbg=np.append(limits.lower, table[0]), ubg=np.append(limits.upper, table[1]),
        )  # fmt: skip
        distances[name] = float(found["g"][-1])
        print(
            f"{name:9s} {solver.stats()['return_status']}: "
            f"the tip is {1000 * distances[name]:.3f} mm from the table, "
            f"the energy {float(found['f']):.4f}"
        )
    return distances


if __name__ == "__main__":
    main()
