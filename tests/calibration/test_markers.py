"""Calibration by markers: proportions, places and poses of a person of known ones."""

import numpy as np
import pytest
from marker_files import write_trc

import regkit
from regkit.body.verdict import Verdict
from regkit.calibration import MarkerSet, MarkerSubject
from regkit.calibration.shape import Shape
from regkit.config.document import Document
from regkit.geometry.rigid import rigid
from regkit.interfaces import Dataset, Method, Template
from regkit.observation import Observation
from regkit.system.errors import RegkitError

FRAMES = 10
SEGMENTS = (
    "pelvis", "chest", "left_thigh", "right_thigh", "left_shin", "right_shin",
    "left_upper_arm", "right_upper_arm", "left_forearm", "right_forearm",
)  # fmt: skip


@pytest.fixture(scope="module")
def human():
    return Template.parse("human", place="test", field="template")


@pytest.fixture(scope="module")
def subject(human):
    """A person with long thighs, three markers on each large segment, and poses over time."""
    random = np.random.default_rng(7)
    shape = Shape(human.description().model_copy(update={"shapes": {}, "mesh": None}))
    x = shape.origin(1.78)
    x[1 + shape.groups.names.index("thigh")] = 0.06
    body = shape.body(x)
    places = {
        f"{segment}_{n}": (segment, random.uniform([-0.1, -0.25, -0.1], [0.1, 0.05, 0.1]))
        for segment in SEGMENTS
        for n in range(3)
    }
    bones = body.skeleton
    pose = bones.rest(rigid(np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.0, 3.0])))
    measured = []
    for _ in range(FRAMES):
        pose = bones.limits.projected(bones.retract(pose, 0.3 * random.normal(size=bones.dofs)))
        transforms = body.place(pose).transforms
        carriers = [transforms[bones.names.index(segment)] for segment, _ in places.values()]
        own = [place for _, place in places.values()]
        measured.append([t[:3, :3] @ p + t[:3, 3] for t, p in zip(carriers, own, strict=True)])
    turned = np.array(measured) * [1.0, -1.0, -1.0]
    return body, places, turned + random.normal(scale=0.001, size=turned.shape)


def recording_of(path):
    data = {"kind": "markers", "path": str(path)}
    return Dataset.parse(data, place="test", field="dataset").only()


def test_markers_find_their_places_and_the_length_of_the_thighs(human, subject, tmp_path):
    body, places, measured = subject
    path = write_trc(tmp_path / "walk.trc", tuple(places), measured)
    random = np.random.default_rng(1)
    rough = {
        name: {segment: tuple(float(one) for one in place + 0.015 * random.normal(size=3))}
        for name, (segment, place) in places.items()
    }
    markers, recording = MarkerSet(markers=rough), recording_of(path)
    found = MarkerSubject.of(human, markers, recording, frames=6)
    assert float(np.sqrt((found.errors**2).mean())) < 0.006
    own = found.description.body("subject", found.description.size.value)
    lengths = []
    for one in (body, own, human.body(1.78)):
        names = one.skeleton.names
        transforms = one.place(one.skeleton.rest()).transforms
        ends = [transforms[names.index(f"left_{part}"), :3, 3] for part in ("thigh", "shin")]
        lengths.append(float(np.linalg.norm(ends[1] - ends[0])))
    true, fitted, usual = lengths
    # The prior of people's proportions keeps the rest.
    assert abs(fitted - true) < 0.6 * abs(usual - true)


def test_marker_on_an_unknown_segment_is_told(human, tmp_path):
    path = write_trc(tmp_path / "a.trc", ("a", "b"), np.ones((2, 2, 3)))
    markers = MarkerSet(markers={"a": {"left_tigh": (0, 0, 0)}, "b": {"chest": (0, 0, 0)}})
    with pytest.raises(RegkitError, match=r"'left_tigh'.*left_thigh"):
        MarkerSubject.of(human, markers, recording_of(path))
    (tmp_path / "set.yaml").write_text("markers:\n  b: {chest: [0, 0, 0]}\n  a: {tail: [0, 0, 0]}")
    document = Document.read(tmp_path / "set.yaml")
    with pytest.raises(RegkitError, match=r"set\.yaml:3: markers\.a: 'tail'"):
        document.validated(MarkerSet).check(human.description(), document)
    with pytest.raises(ValueError, match="one segment"):
        MarkerSet(markers={"a": {"chest": (0, 0, 0), "head": (0, 0, 0)}})
    strange = MarkerSet(markers={"c": {"chest": (0, 0, 0)}})
    with pytest.raises(RegkitError, match="no landmark of a marker"):
        MarkerSubject.of(human, strange, recording_of(path))


def test_method_of_landmarks_solves_a_recording_of_markers(human, subject, tmp_path):
    body, _, _ = subject
    names = body.markers.names
    random = np.random.default_rng(3)
    bones = body.skeleton
    pose = bones.rest(rigid(np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.0, 3.0])))
    seen = []
    for _ in range(4):
        pose = bones.limits.projected(bones.retract(pose, 0.06 * random.normal(size=bones.dofs)))
        seen.append(body.markers.place(body.place(pose).transforms) * [1.0, -1.0, -1.0])
    path = write_trc(tmp_path / "joints.trc", names, seen)
    template = {"kind": "human", "height": body.size}
    tracked = regkit.track(
        recording_of(path), template, {"preset": "markers"},
        start="landmarks", preprocessor={"kind": "points", "crop": {"min_points": 3}},
    )  # fmt: skip
    turned = np.array(seen) * [1.0, -1.0, -1.0]
    errors = np.linalg.norm(tracked.markers - turned, axis=2)
    # The template's thighs are shorter than this person's.
    assert np.median(errors) < 0.02
    # Judged as a surface, some dozens of points are always doubtful.
    assert set(tracked.track.verdicts) == {Verdict.FOUND}


def test_method_of_landmarks_needs_some(human):
    method = Method.parse({"preset": "markers"}, place="test", field="method")
    body, points = human.body(1.7), np.random.default_rng(0).normal(size=(50, 3))
    data = Observation(points, np.ones(50), np.ones(50))
    with pytest.raises(RegkitError, match="no landmarks"):
        method.bind(body).register(data, [body.skeleton.rest()])
