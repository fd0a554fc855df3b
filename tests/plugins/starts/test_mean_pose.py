"""The mean of the poses that explain the data about as well."""

from pathlib import Path

import numpy as np
import pytest
from lamp import LAMP, facing

from regkit.body import Body
from regkit.interfaces import RegistrationResult
from regkit.start import Finalist
from regkit_plugins.starts.exemplars.finalists import mean_pose
from regkit_plugins.templates.file import FileTemplate


@pytest.fixture
def body(tmp_path: Path) -> Body:
    path = tmp_path / "lamp.yaml"
    path.write_text(LAMP)
    return FileTemplate(path=path, size=1.0).body(1.0)


def finalist(body: Body, head: float, cost: float, turn: float = 0.0) -> Finalist:
    pose = facing(body, turn, {"arm": 10.0, "head": head})
    return Finalist(body, RegistrationResult.given(pose), energy=cost, misfit=0.0)


def head_of(body: Body, finalists: list[Finalist]) -> float:
    (hinge,) = body.skeleton.joint_dofs["head"] - body.skeleton.hinge_dofs.start
    return float(np.degrees(mean_pose(finalists).hinges[hinge]))


def test_poses_of_equal_cost_meet_midway(body):
    pair = [finalist(body, -30.0, 1.0), finalist(body, -50.0, 1.0)]
    assert head_of(body, pair) == pytest.approx(-40.0)
    assert head_of(body, pair[::-1]) == pytest.approx(-40.0)


def test_the_better_a_pose_explains_the_data_the_more_it_weighs(body):
    best, costs = finalist(body, -30.0, 1.0), [1.0, 1.02, 1.05, 1.2, 2.0]
    heads = [head_of(body, [best, finalist(body, -50.0, cost)]) for cost in costs]
    assert heads == sorted(heads)
    assert heads[0] < heads[-1] == pytest.approx(-30.0, abs=1e-3)


def test_what_is_elsewhere_is_no_part_of_the_mean(body):
    turned = finalist(body, -30.0, 1.0, turn=np.pi)
    expected = finalist(body, -30.0, 1.0)
    found = mean_pose([expected, turned])
    np.testing.assert_allclose(found.root, expected.pose.root, atol=1e-12)
