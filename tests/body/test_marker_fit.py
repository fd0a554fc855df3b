"""Fits of bodies to markers alone, as a motion-capture system measures them."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.body.marker_fit import NEAR, fit_to_data
from regkit.body.verdict import Verdict, frame_verdict
from regkit.observation import Landmarks, Observation
from regkit_plugins.templates.human import Human

BODY = Human(height=1.7).body(1.7)
POSE = BODY.skeleton.rest()
PLACES = BODY.markers.place(BODY.place(POSE).transforms)


def measured(places, names=BODY.markers.names):
    """The data of a frame in which markers are measured, and nothing else."""
    seen = np.isfinite(places).all(axis=1)
    landmarks = replace(Landmarks.in_space(tuple(names), places), alone=True)
    points = places[seen]
    ones = np.ones(len(points))
    return Observation(points, ones, 1e-4 * ones, landmarks=landmarks)


def judged(data):
    fit, supports = fit_to_data(BODY, POSE, data)
    shares = (fit.inlier_share, fit.coverage, fit.misfit, fit.relief)
    return frame_verdict(len(data.points), *shares), fit, supports


def test_markers_near_their_places_are_found(random):
    noise = random.normal(size=PLACES.shape)
    noise *= 0.01 / np.linalg.norm(noise, axis=1, keepdims=True)
    verdict, fit, supports = judged(measured(PLACES + noise))
    assert verdict is Verdict.FOUND
    assert fit.distance == pytest.approx(0.01)
    assert np.nanmin(supports) == 1.0


@pytest.mark.parametrize(
    ("share", "verdict"),
    [(0.1, Verdict.FOUND), (0.35, Verdict.DOUBTFUL), (0.6, Verdict.LOST)],
)
@pytest.mark.parametrize("missing", [False, True])
def test_verdict_falls_with_markers_that_are_elsewhere_or_unmeasured(share, verdict, missing):
    places = PLACES.copy()
    count = round(share * len(places))
    places[:count] = np.nan if missing else places[:count] + 2.0 * NEAR * BODY.size
    found, _, supports = judged(measured(places))
    assert found is verdict
    assert np.nanmin(supports) < 1.0


def test_sides_that_are_exchanged_are_not_found():
    other = {"left": "right", "right": "left"}
    names = BODY.markers.names
    swapped = [
        names.index("_".join([other.get(part, part) for part in name.split("_")])) for name in names
    ]
    verdict, _, _ = judged(measured(PLACES[swapped]))
    assert verdict is not Verdict.FOUND


def test_markers_that_no_template_has_are_no_body():
    verdict, _, supports = judged(measured(PLACES, [f"m{i}" for i in range(len(PLACES))]))
    assert verdict is Verdict.LOST
    assert np.isnan(supports).all()


def test_segments_without_a_marker_of_the_recording_are_unknown():
    kept = [name for name in BODY.markers.names if "left" not in name]
    rows = [BODY.markers.names.index(name) for name in kept]
    _, _, supports = judged(measured(PLACES[rows], kept))
    lacking = sorted({*BODY.markers.segments} - {*BODY.markers.segments[rows]})
    assert lacking
    assert np.isnan(supports[lacking]).all()
    assert np.isfinite(supports).any()
