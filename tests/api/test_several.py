"""Tracking of all bodies in a recording, each by itself."""

import numpy as np
import pytest
from messages import tells
from places import DATA

import regkit
from regkit.system.errors import ConfigError

START = {"kind": "given", "root": {"position": [-0.05, -0.05, 3.25], "rotation_deg": [180, 0, 0]}}


@pytest.fixture(scope="module")
def walk():
    return regkit.load_recording(DATA / "human_walk", frames=1)


def test_body_alone_is_tracked_as_by_itself(walk):
    human = regkit.load_template("human", height=1.63)
    (one,) = regkit.track_each(walk, human, start="stances")
    alone = regkit.track(walk, human, start="stances")
    assert one.name == alone.name
    np.testing.assert_array_equal(one.markers, alone.markers)


def test_given_start_of_all_bodies_is_refused(walk):
    human = regkit.load_template("human", height=1.63)
    with pytest.raises(ConfigError) as caught:
        regkit.track_each(walk, human, start=START)
    assert tells(str(caught.value), at="start", of=("one body",))
