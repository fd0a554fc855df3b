"""One of several bodies is lost: it is sought anew beside the others, which stay."""

import numpy as np
import pytest
from pole_and_ball import APART, placed, pole_and_ball, template
from scarecrow import measured

from regkit.body import Body
from regkit.interfaces import Method, Past, Registrar, RegistrationResult
from regkit.skeleton import Pose
from regkit.system.optional import one_blas_thread
from regkit_plugins.trackers.constant_velocity import ConstantVelocity
from regkit_plugins.trackers.constant_velocity.lost_bodies import lost_bodies
from regkit_plugins.trackers.constant_velocity.recovery import Recovery
from regkit_plugins.trackers.constant_velocity.reinitialization import Reinitialization

SMALL = Reinitialization(exemplars=1000, looked_up=100, refined=10, finalists=2)


@pytest.fixture(scope="module")
def registrar(tmp_path_factory) -> Registrar:
    whole = template(pole_and_ball(tmp_path_factory.mktemp("bodies")))
    body = whole.body(whole.candidate_sizes()[0])
    return Method.parse({"preset": "best"}, place="test", field="method").bind(body)


def healthy(pose: Pose) -> Past:
    past = Past.start(pose)
    for _ in range(5):
        past = past.followed_by(RegistrationResult(pose, 0.0, 0.95, True, 1, 1, ""))
    return past


def errors(body: Body, found: Pose, truth: Pose) -> dict[str, float]:
    """The mean distance of each body's markers [m]."""
    places = [body.markers.place(body.place(pose).transforms) for pose in (found, truth)]
    apart = np.linalg.norm(places[0] - places[1], axis=1)
    return {one.name: float(apart[one.markers].mean()) for one in body.free_bodies}


@pytest.mark.parametrize(("lost", "before"), [("ball", [0.2, 0.5, 2.2]), ("pole", [0.1, 0.0, 2.2])])
def test_a_lost_body_is_found_beside_the_other(registrar, lost, before) -> None:
    body = registrar.body
    places = {"pole": APART[0], "ball": APART[1]}
    truth = placed(body, places["pole"], places["ball"])
    places[lost] = before
    wrong = placed(body, places["pole"], places["ball"])
    data = measured(body, truth, voxel=0.02)
    found = {}
    for name, sought in (("sought", SMALL), ("not", None)):
        tracker = ConstantVelocity(recovery=Recovery(reinitialization=sought)).bind(registrar)
        with one_blas_thread():
            result = tracker.step(data, healthy(wrong))
        found[name] = errors(body, result.pose, truth)
        assert bool(result.searched) == (sought is not None)
    assert max(found["sought"].values()) < 0.05
    assert found["not"][lost] > 0.1


def test_the_lost_body_is_named_first(registrar) -> None:
    body = registrar.body
    data, truth = measured(body, placed(body, *APART), voxel=0.02), placed(body, *APART)
    names = [one.name for one in body.free_bodies]
    for lost, places in (
        ("ball", (APART[0], [0.2, 0.5, 2.2])),
        ("pole", ([0.1, 0.0, 2.2], APART[1])),
    ):
        wrong = placed(body, *places)
        assert names[lost_bodies(body, wrong, data)[0]] == lost
    assert len(lost_bodies(body, truth, data)) <= 1
