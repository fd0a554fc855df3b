"""Laws of datasets."""

from __future__ import annotations

import re

import numpy as np
import pytest

from regkit.interfaces import Dataset, Sequence
from regkit.testing.laws import Laws
from regkit.testing.verdict import require, same

FRAMES = 2
"""No more are read of each sequence."""
SEQUENCES = 3
"""The frames of no more are read."""


class DatasetLaws(Laws):
    """Laws of datasets."""

    @pytest.fixture
    def sequences(self, dataset: Dataset) -> list[Sequence]:
        """All sequences, of which a few frames are read."""
        return dataset.model_copy(update={"frames": FRAMES}).chosen()

    def test_dataset_names_its_sequences(self, dataset: Dataset, sequences: list[Sequence]) -> None:
        """There is one; names are unique and fit for folders; speed and length are positive."""
        at = type(dataset).found
        names = [sequence.name for sequence in sequences]
        require(bool(names), dataset, "has no sequence", look_at=at)
        for sequence in sequences:
            require(
                re.fullmatch(r"\w[\w. -]*", sequence.name) is not None, dataset,
                f"calls a sequence {sequence.name!r}, which cannot be a folder's name", look_at=at,
            )  # fmt: skip
            require(
                sequence.fps > 0.0 and sequence.length > 0, dataset,
                f"has a sequence '{sequence.name}' of {sequence.length} frames at "
                f"{sequence.fps} per second", look_at=at,
            )  # fmt: skip
            require(
                sequence.length <= FRAMES, dataset, f"does not keep to `frames`: '{sequence.name}' "
                f"has {sequence.length} of {FRAMES}", look_at=at,
            )  # fmt: skip

    def test_dataset_has_the_sequences_that_are_asked_for(self, dataset: Dataset) -> None:
        """``sequences`` chooses by name."""
        names = [sequence.name for sequence in dataset.chosen()]
        last = dataset.model_copy(update={"sequences": (names[-1],)})
        found = [sequence.name for sequence in last.chosen()]
        require(
            found == [names[-1]], dataset, f"gives {found} for sequences: [{names[-1]}]",
            look_at=type(dataset).found,
        )  # fmt: skip

    def test_dataset_frames_are_finite_and_as_many_as_it_says(
        self, dataset: Dataset, sequences: list[Sequence]
    ) -> None:
        """Points (N, 3) in metres; a depth image of its camera's size."""
        for sequence in sequences[:SEQUENCES]:
            at, frames = type(sequence).frames, list(sequence.frames())
            require(
                len(frames) == sequence.length, dataset, f"says that '{sequence.name}' has "
                f"{sequence.length} frames and gives {len(frames)}", look_at=at,
            )  # fmt: skip
            for frame in frames:
                points = np.asarray(frame.points)
                require(
                    points.ndim == 2 and points.shape[1:] == (3,) and np.isfinite(points).all(),
                    dataset, f"gives points of the shape {points.shape}, or not finite, in "
                    f"'{sequence.name}'", look_at=at,
                )  # fmt: skip
                far = float(np.abs(points).max(initial=0.0))
                require(
                    far < 1000.0, dataset, f"gives a point {far:.3g} m away in '{sequence.name}'; "
                    "points are in metres", look_at=at,
                )  # fmt: skip
                if frame.depth is not None:
                    camera = frame.camera
                    require(
                        camera is not None
                        and frame.depth.shape == (camera.height, camera.width),
                        dataset, f"gives a depth image of the shape {frame.depth.shape} that is "
                        "not its camera's", look_at=at,
                    )  # fmt: skip

    def test_dataset_reads_the_same_twice(
        self, dataset: Dataset, sequences: list[Sequence]
    ) -> None:
        """Frames come from files, not from a state."""
        first = sequences[0]
        require(
            same([frame.points for frame in first.frames()], [f.points for f in first.frames()]),
            dataset, f"gives other frames of '{first.name}' when it is read again",
            look_at=type(first).frames,
        )  # fmt: skip

    def test_dataset_truth_has_a_row_for_each_frame(
        self, dataset: Dataset, sequences: list[Sequence]
    ) -> None:
        """(T, J, 3) positions of J joints with different names; NaN alone is not seen."""
        for sequence in sequences[:SEQUENCES]:
            truth, at = sequence.truth(), type(sequence).truth
            if truth is None:
                continue
            expected = (sequence.length, len(truth.joints), 3)
            require(
                truth.positions.shape == expected and not np.isinf(truth.positions).any(), dataset,
                f"has a truth of the shape {truth.positions.shape} for '{sequence.name}'; it must "
                f"be {expected}, and finite or NaN", look_at=at,
            )  # fmt: skip
            require(
                len(set(truth.joints)) == len(truth.joints), dataset,
                f"has two reference joints of one name in '{sequence.name}'", look_at=at,
            )  # fmt: skip
