"""Joint limits of bodies: constraints of their poses, and solvers that never leave them."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from pydantic import ValidationError

from regkit.body import Body
from regkit.interfaces import Method, Multipliers, ShapeModel, Solver, Template
from regkit.observation import Observation
from regkit.registration import COORDINATES, RegistrationProblem
from regkit.skeleton import Pose

SIZES = {"human": 1.75, "hand": 0.186}


@pytest.mark.parametrize("name", list(COORDINATES))
def test_derivatives_of_constraints_are_exact(linkage, random, name):
    bones = linkage.skeleton
    start = bones.retract(bones.rest(), 0.5 * random.normal(size=bones.dofs))
    coordinates = COORDINATES[name](bones, start)
    rows = coordinates.constraints()
    multipliers = random.normal(size=len(rows.names))
    step = 1e-6
    for _ in range(3):
        x = coordinates.origin() + 0.3 * random.normal(size=len(coordinates.origin()))
        ends = [(x + step * e, x - step * e) for e in np.eye(len(x))]
        slopes = [(rows.values(a) - rows.values(b)) / (2 * step) for a, b in ends]
        np.testing.assert_allclose(rows.jacobian(x), np.transpose(slopes), atol=1e-7)
        bends = [multipliers @ (rows.jacobian(a) - rows.jacobian(b)) / (2 * step) for a, b in ends]
        np.testing.assert_allclose(rows.curvature(x, multipliers), bends, atol=1e-6)


def beyond_limits(body: Body, random: np.random.Generator) -> tuple[Observation, Pose]:
    """Data of a pose that may be beyond the limits, and a start within them."""
    bones, gaussians = body.skeleton, ShapeModel.load("gsog")().bind(body)
    joints = np.arange(bones.dofs) >= bones.ball_dofs.start
    step = random.uniform(0.2, 1.0) * joints * random.normal(size=bones.dofs)
    target = bones.retract(bones.rest(), step)
    placed = gaussians.place(body.place(target).transforms)
    chosen = random.integers(len(gaussians), size=200)
    spread = gaussians.scales[chosen] * random.normal(size=(200, 3))
    points = placed.centres[chosen] + np.einsum("nij,nj->ni", placed.axes[chosen], spread)
    data = Observation(points, np.ones(200), np.full(200, (0.005 * body.size) ** 2))
    disturbed = bones.retract(target, 0.1 * joints * random.normal(size=bones.dofs))
    return data, bones.limits.projected(disturbed)


@pytest.mark.parametrize("coordinates", list(COORDINATES))
@pytest.mark.parametrize("kind", list(SIZES))
@pytest.mark.parametrize("solver", [k for k in Solver.available() if Solver.load(k).limits.hard])
def test_hard_limits_are_kept(kind, solver, coordinates, random):
    body = Template.load(kind)().body(SIZES[kind])
    method = Method.load("direct")(
        shape="gsog", kernel="likelihood", solver=solver, coordinates=coordinates, hard_limits=True
    )
    registrar = method.bind(body)
    # Hinges are bounds to it, too.
    free = method.model_copy(update={"solver": Solver.load("lbfgs")(), "hard_limits": False})
    free, pressed = free.bind(body), 0
    for _ in range(5):
        data, start = beyond_limits(body, random)
        found = registrar.register(data, [start])
        assert body.skeleton.limits.violation(found.pose).max() <= 1e-6
        gained = (
            registrar.evaluate(data, start).energy - registrar.evaluate(data, found.pose).energy
        )
        assert gained > 0.01
        # Without limits the data would pull the pose beyond them; else nothing was tested.
        pulled = free.register(data, [start]).pose
        pressed += body.skeleton.limits.violation(pulled).max() > 0.01
    assert pressed >= 2 or kind == "hand"


def test_solvers_agree_where_no_limit_holds(linkage, random):
    """From the same start near the truth: the same minimum, to a millionth of its energy."""
    bones = linkage.skeleton
    shape = Method.load("direct")(shape="gsog", kernel="likelihood", solver="lbfgs").shape
    gaussians = shape.bind(linkage)
    truth = bones.retract(bones.rest(), 0.1 * random.normal(size=bones.dofs))
    placed = gaussians.place(linkage.place(truth).transforms)
    chosen = random.integers(len(gaussians), size=400)
    spread = gaussians.scales[chosen] * random.normal(size=(400, 3))
    points = placed.centres[chosen] + np.einsum("nij,nj->ni", placed.axes[chosen], spread)
    data = Observation(points, np.ones(400), np.full(400, 0.01**2))
    start = bones.retract(truth, 0.05 * random.normal(size=bones.dofs))
    energies = {}
    for solver in (
        {"kind": "ipopt", "max_iterations": 500, "value_tolerance": 0.0},
        {"kind": "gauss_newton", "max_iterations": 2000, "value_tolerance": 1e-13, "resting": 0.0},
        {"kind": "lbfgs", "max_iterations": 5000, "value_tolerance": 1e-15,
         "gradient_tolerance": 1e-10},
    ):  # fmt: skip
        method = Method.load("direct")(shape="gsog", kernel="likelihood", solver=solver)
        energies[solver["kind"]] = method.bind(linkage).register(data, [start]).energy
    np.testing.assert_allclose(list(energies.values()), energies["ipopt"], rtol=1e-6)


def test_multipliers_pass_from_frame_to_frame(random):
    body = Template.load("human")().body(SIZES["human"])
    given: list[Multipliers | None] = []

    class Watching(type(Solver.load("ipopt")())):
        """IPOPT that tells with which multipliers it begins."""

        def minimize(self, problem):
            given.append(problem.multipliers)
            return super().minimize(problem)

    method = Method.load("direct")(shape="gsog", kernel="likelihood", solver=Watching())
    registrar = method.bind(body)
    data, start = beyond_limits(body, random)
    first = registrar.register(data, [start])
    second = registrar.register(data, [first.pose], warm_start=first)
    assert given == [None, first.multipliers]
    assert second.energy <= first.energy + 1e-3


@pytest.mark.parametrize("solver", [k for k in Solver.available() if Solver.load(k).limits.hard])
def test_start_beyond_the_limits_is_brought_within(solver, random):
    body = Template.load("hand")().body(SIZES["hand"])
    data, start = beyond_limits(body, random)
    beyond = Pose(start.root, start.balls, start.hinges + 0.4)
    method = Method.load("direct")(
        shape="gsog", kernel="likelihood", solver=solver, hard_limits=True
    )
    found = method.bind(body).register(data, [beyond])
    assert body.skeleton.limits.violation(found.pose).max() <= 1e-6


def test_quaternions_lead_ipopt_as_far_as_steps_do(random):
    body = Template.load("human")().body(SIZES["human"])
    gains = {}
    for name in COORDINATES:
        method = Method.load("direct")(
            shape="gsog", kernel="likelihood", solver="ipopt", coordinates=name
        )
        registrar, problems = method.bind(body), np.random.default_rng(3)
        gains[name] = []
        for _ in range(6):
            data, start = beyond_limits(body, problems)
            found = registrar.register(data, [start])
            gains[name].append(
                registrar.evaluate(data, start).energy - registrar.evaluate(data, found.pose).energy
            )
    # They may end in different minima, but one chart does not stop where the other begins.
    assert min(gains["quaternion"]) > 0.01
    assert np.median(gains["quaternion"]) > 0.8 * np.median(gains["tangent"])


def test_threads_do_not_disturb_each_other(random):
    bones = Template.load("human")().body(SIZES["human"]).skeleton
    poses = [bones.retract(bones.rest(), 0.3 * random.normal(size=bones.dofs)) for _ in range(8)]
    charts = [COORDINATES["tangent"](bones, pose) for pose in poses]

    def jacobians(chart) -> list:
        return [chart.constraints().jacobian(0.01 * k * np.ones(bones.dofs)) for k in range(300)]

    expected = [jacobians(chart) for chart in charts]
    with ThreadPoolExecutor(4) as threads:
        for found, alone in zip(threads.map(jacobians, charts), expected, strict=True):
            np.testing.assert_array_equal(found, alone)


def test_hard_limits_refuse_a_solver_that_cannot_keep_them():
    with pytest.raises(ValidationError, match="'lbfgs' does not keep the limits of ball joints"):
        Method.load("direct")(shape="gsog", kernel="likelihood", solver="lbfgs", hard_limits=True)


def test_body_without_ball_limits_has_no_constraints(linkage):
    body = Template.load("hand")().body(0.186)
    coordinates = COORDINATES["tangent"](body.skeleton, body.skeleton.rest())
    gaussians = ShapeModel.load("gsog")().bind(body)
    assert RegistrationProblem(coordinates, gaussians, {}).constraints() is None
