"""Verdicts of several bodies in the frames of a track, told by their names."""

from dataclasses import replace

import numpy as np
import pytest
from made_tracks import made_track
from pole_and_ball import APART, placed, pole_and_ball, template
from scarecrow import measured

from regkit.body import Body
from regkit.body.each import fits_of_each, shares_of_each, verdicts_of_each
from regkit.body.verdict import Verdict, worst
from regkit.interfaces import RegistrationResult as Result
from regkit.interfaces import Start
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.tracking import TrackRecorder, TrackVerdict
from regkit.tracking.loop import TrackedFrame

F, D, L, N = Verdict.FOUND, Verdict.DOUBTFUL, Verdict.LOST, Verdict.NO_DATA
WRONG = [0.2, 0.5, 2.2]


class Still:
    """What a recorder asks of a registrar."""

    def __init__(self, body: Body) -> None:
        self.body = body


@pytest.fixture(scope="module")
def body(tmp_path_factory) -> Body:
    whole = template(pole_and_ball(tmp_path_factory.mktemp("bodies")))
    return whole.body(whole.candidate_sizes()[0])


@pytest.fixture(scope="module")
def data(body) -> Observation:
    return measured(body, placed(body, *APART), voxel=0.02)


def frame(data: Observation | None, pose: Pose) -> TrackedFrame:
    return TrackedFrame(data, Result(pose, 0.0, 0.9, True, 1, 1, "given"), 0.01, 0.001)


def test_a_recorder_tells_which_body_is_lost(body, data) -> None:
    right, wrong = placed(body, *APART), placed(body, APART[0], WRONG)
    recorder = TrackRecorder(Still(body), 30.0)
    told = [recorder.add(frame(*one)) for one in ((data, right), (data, wrong), (None, wrong))]
    assert [one.bodies for one in told] == [
        {"pole": F, "ball": F},
        {"pole": F, "ball": L},
        {"pole": N, "ball": N},
    ]
    assert [one.verdict for one in told] == [F, L, N]
    track = recorder.track()
    assert track.verdicts == (F, L, N)
    assert track.body_verdicts == ((F, F), (F, L), (N, N))
    judged = TrackVerdict.of(track, Start(body, right))
    assert judged.verdict is L
    assert "'ball' is lost in 1 of 3 frames" in judged.reason
    assert "pole" not in judged.reason
    assert track[1:].body_verdicts == ((F, L), (N, N))


def test_a_lost_body_makes_the_frame_lost_however_well_the_other_fits(body) -> None:
    track = made_track(body, 2)
    good, bad = [0.95, 0.95, 0.2, 1.0], [0.1, 0.1, 3.0, 1.0]
    track = replace(track, body_shares=np.array([[good, good], [good, bad]]))
    assert track.verdicts[0] is F
    assert track.verdicts[1] is L
    assert list(track.named_arrays(body)["body_names"]) == ["pole", "ball"]


def test_a_body_that_is_hidden_is_not_lost(body, data) -> None:
    class Blind:
        def observable(self, points, margins=np.inf):
            return np.zeros(len(points), dtype=bool)

    behind = placed(body, APART[0], [0.0, 0.0, 30.0])
    for sight, expected in ((None, L), (data.sight, L), (Blind(), N)):
        fits = fits_of_each(body, behind, data.points, sight)
        assert verdicts_of_each(shares_of_each(fits))[1] is expected


def test_bodies_without_data_do_not_count() -> None:
    assert worst([F, N]) is F
    assert worst([D, L, F]) is L
    assert worst([]) is N
