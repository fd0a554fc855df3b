"""A frame is registered alike by compiled functions and by the readable forms."""

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.interfaces import Method
from regkit.observation import Observation
from regkit.registration import Plan
from regkit_plugins.methods.direct import Direct
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human

CAMERA = Camera(176, 144, 180.0, 180.0, 88.0, 72.0)
TERMS = ["visibility", "intersection", "continuity", "free_space", "limits", "clamp"]
VOLUMES = TERMS[:-1]


def seen_from_the_camera(body, pose, random):
    """Points on the front of the body's capsules, and their depth image."""
    axes = body.capsules.axis_points(0.02 * body.size)
    places = axes.place(body.place(pose).transforms)
    chosen = random.integers(len(places), size=500)
    points = places[chosen] - [0.0, 0.0, 1.0] * axes.radii[chosen, None]
    points = points + 0.004 * random.normal(size=points.shape)
    depth = np.zeros((CAMERA.height, CAMERA.width))
    for x, y, z in points:
        column = round(CAMERA.fx * x / z + CAMERA.cx)
        row = round(CAMERA.fy * y / z + CAMERA.cy)
        if 0 <= row < CAMERA.height and 0 <= column < CAMERA.width:
            depth[row, column] = z
    return Observation(points, np.ones(500), np.full(500, 1e-4), CAMERA, depth)


def facing(body, distance):
    """The rest pose before the camera, upright and turned a little."""
    turned = np.array([[0.9, 0.0, -0.4359], [0.0, -1.0, 0.0], [-0.4359, 0.0, -0.9]])
    root = np.eye(4)
    root[:3, :3], root[:3, 3] = turned, (0.05, 0.1, distance)
    return body.skeleton.rest(root)


@pytest.mark.parametrize("template", ["human", "hand"])
@pytest.mark.parametrize(
    ("shape", "kernel", "terms"),
    [
        ({"kind": "gsog", "surface": "visible"}, "likelihood", TERMS),
        ({"kind": "gsog"}, {"kind": "correlation", "covariance": "frozen"}, TERMS),
        ("sog", "likelihood", ["continuity"]),
        ("sphere", "sphere_distance", VOLUMES),
    ],
)
def test_compiled_registration_ends_where_the_readable_one_does(template, shape, kernel, terms):
    random = np.random.default_rng(5)
    body = Human(height=1.7).body(1.7) if template == "human" else Hand(length=0.19).body(0.19)
    bones = body.skeleton
    truth = facing(body, 1.5 * body.size)
    data = seen_from_the_camera(body, truth, random)
    step = 0.06 * random.normal(size=bones.dofs)
    step[:3] *= body.size
    start = bones.limits.projected(bones.retract(truth, step))
    config = {"kind": "direct", "shape": shape, "kernel": kernel, "terms": terms,
              "solver": {"kind": "gauss_newton", "max_iterations": 5}}  # fmt: skip
    found = {}
    for compiled in (True, False):
        method = Method.parse({**config, "compiled": compiled}, place="test", field="method")
        registrar = method.bind(body)
        assert isinstance(registrar.plan, Plan) is compiled
        found[compiled] = registrar.register(data, [truth, start])
        assert registrar.evaluate(data, found[compiled].pose).energy == pytest.approx(
            found[compiled].energy, rel=0.05, abs=0.05
        )
    fast, plain = found[True], found[False]
    assert np.abs(bones.difference(plain.pose, fast.pose)).max() < 1e-4
    assert fast.energy == pytest.approx(plain.energy, rel=1e-5, abs=1e-5)
    assert fast.inlier_share == pytest.approx(plain.inlier_share, abs=0.005)
    assert (fast.iterations, fast.message) == (plain.iterations, plain.message)


def test_solver_without_compiled_form_runs_the_readable_one():
    body = Human(height=1.7).body(1.7)
    method = Direct(shape="sog", kernel="correlation", solver="lbfgs")
    assert method.bind(body).plan is None


def test_data_of_different_variances_run_the_readable_form():
    random = np.random.default_rng(0)
    body = Human(height=1.7).body(1.7)
    truth = facing(body, 2.5)
    data = seen_from_the_camera(body, truth, random)
    mixed = Observation(data.points, data.weights, random.choice([1e-4, 4e-4], size=500))
    assert mixed.arrays is None
    method = Direct(shape="gsog", kernel="likelihood", solver="gauss_newton")
    plain = Direct(shape="gsog", kernel="likelihood", solver="gauss_newton", compiled=False)
    one, two = (each.bind(body).register(mixed, [truth]) for each in (method, plain))
    assert one.energy == two.energy
