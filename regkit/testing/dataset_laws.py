"""Laws of datasets."""

from __future__ import annotations

import re

import numpy as np
import pytest

from regkit.interfaces import Dataset, Recording
from regkit.testing.laws import Laws
from regkit.testing.opened import opened_files
from regkit.testing.verdict import require, same

FRAMES = 2
"""Maximum number of frames to read of each recording."""
RECORDINGS = 3
"""Maximum number of recordings to read frames of."""


class DatasetLaws(Laws):
    """Laws of datasets."""

    @pytest.fixture
    def recordings(self, dataset: Dataset) -> list[Recording]:
        """Returns all recordings, limited to a few frames each."""
        return dataset.model_copy(update={"frames": FRAMES}).chosen()

    def test_dataset_names_its_recordings(
        self, dataset: Dataset, recordings: list[Recording]
    ) -> None:
        """Names are unique and valid as folders; frame rates and lengths are positive."""
        at = type(dataset).found
        names = [recording.name for recording in recordings]
        require(bool(names), dataset, "has no recording", look_at=at)
        for recording in recordings:
            require(
                re.fullmatch(r"\w[\w. -]*", recording.name) is not None,
                dataset,
                f"calls a recording {recording.name!r}, which cannot be a folder's name",
                look_at=at,
            )
            require(
                recording.fps > 0.0 and recording.length > 0, dataset,
                f"has a recording '{recording.name}' of {recording.length} frames at "
                f"{recording.fps} per second", look_at=at,
            )  # fmt: skip
            require(
                recording.length <= FRAMES,
                dataset,
                f"does not keep to `frames`: '{recording.name}' has {recording.length} of {FRAMES}",
                look_at=at,
            )

    def test_dataset_has_the_recordings_that_are_asked_for(self, dataset: Dataset) -> None:
        """``recordings`` selects by name."""
        names = [recording.name for recording in dataset.chosen()]
        last = dataset.model_copy(update={"recordings": (names[-1],)})
        found = [recording.name for recording in last.chosen()]
        require(
            found == [names[-1]], dataset, f"gives {found} for recordings: [{names[-1]}]",
            look_at=type(dataset).found,
        )  # fmt: skip

    def test_dataset_frames_are_finite_and_as_many_as_it_says(
        self, dataset: Dataset, recordings: list[Recording]
    ) -> None:
        """Points are (N, 3) in metres; a depth image has the size of its camera's."""
        for recording in recordings[:RECORDINGS]:
            at, frames = type(recording).frames, list(recording.frames())
            require(
                len(frames) == recording.length, dataset, f"states that '{recording.name}' has "
                f"{recording.length} frames but yields {len(frames)}", look_at=at,
            )  # fmt: skip
            for frame in frames:
                points = np.asarray(frame.points)
                require(
                    points.ndim == 2 and points.shape[1:] == (3,) and np.isfinite(points).all(),
                    dataset, f"yields points of shape {points.shape}, or not finite, in "
                    f"'{recording.name}'", look_at=at,
                )  # fmt: skip
                far = float(np.abs(points).max(initial=0.0))
                require(
                    far < 1000.0, dataset, f"yields a point {far:.3g} m away in "
                    f"'{recording.name}'; points must be in metres", look_at=at,
                )  # fmt: skip
                if frame.depth is not None:
                    camera = frame.camera
                    require(
                        camera is not None
                        and frame.depth.shape == (camera.height, camera.width),
                        dataset, f"yields a depth image of shape {frame.depth.shape}, unlike "
                        "its camera's", look_at=at,
                    )  # fmt: skip

    def test_dataset_reads_the_same_twice(
        self, dataset: Dataset, recordings: list[Recording]
    ) -> None:
        """Frames come from files, not from a state."""
        first = recordings[0]
        require(
            same([frame.points for frame in first.frames()], [f.points for f in first.frames()]),
            dataset, f"yields other frames of '{first.name}' when it is read again",
            look_at=type(first).frames,
        )  # fmt: skip

    def test_dataset_lists_the_files_that_it_reads(
        self, dataset: Dataset, recordings: list[Recording]
    ) -> None:
        """Results are bound to them: a file that is not listed could change unseen."""
        named = [path.absolute() for path in dataset.input_files()]
        for recording in recordings[:RECORDINGS]:
            at = type(recording).input_files
            with opened_files() as opened:
                list(recording.frames())
                recording.truth()
            given = recording.input_files()
            listed = named if given is None else [path.absolute() for path in given]
            for path in listed:
                require(
                    path.exists(), dataset, f"lists a file of '{recording.name}' that is not "
                    f"there: {path}", look_at=at,
                )  # fmt: skip
            own = [path for path in opened if any(path.is_relative_to(one) for one in named)]
            missed = [path for path in own if not any(path.is_relative_to(one) for one in listed)]
            require(
                not missed, dataset, f"does not list a file that '{recording.name}' reads: "
                f"{missed[:1]}", look_at=at,
            )  # fmt: skip
            require(
                recording.fingerprint() == recording.fingerprint(), dataset,
                f"gives another fingerprint of '{recording.name}' when it is asked again",
                look_at=type(recording).fingerprint,
            )  # fmt: skip

    def test_dataset_reads_some_frames_as_it_reads_all(
        self, dataset: Dataset, recordings: list[Recording]
    ) -> None:
        """A frame that is read by its number is the one that the whole recording has there."""
        recording = recordings[0]
        last = recording.length - 1
        frames = list(recording.frames())
        some = dict(recording.some([last, 0]))
        require(
            list(some) == sorted({0, last})
            and all(same(frame.points, frames[index].points) for index, frame in some.items()),
            dataset, f"gives other frames of '{recording.name}' by their numbers than in turn",
            look_at=type(recording).some,
        )  # fmt: skip

    def test_dataset_truth_has_a_row_for_each_frame(
        self, dataset: Dataset, recordings: list[Recording]
    ) -> None:
        """Positions are (T, J, 3) for J joints with different names; NaN marks unseen ones."""
        for recording in recordings[:RECORDINGS]:
            truth, at = recording.truth(), type(recording).truth
            if truth is None:
                continue
            expected = (recording.length, len(truth.joints), 3)
            require(
                truth.positions.shape == expected and not np.isinf(truth.positions).any(), dataset,
                f"has a truth of shape {truth.positions.shape} for '{recording.name}'; it must "
                f"be {expected}, and finite or NaN", look_at=at,
            )  # fmt: skip
            require(
                len(set(truth.joints)) == len(truth.joints), dataset,
                f"has two reference joints with the same name in '{recording.name}'", look_at=at,
            )  # fmt: skip
