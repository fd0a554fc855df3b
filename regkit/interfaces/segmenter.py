"""Segmenters: taking the body out of a scene, before preprocessing."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from regkit.config.plugin import Plugin
from regkit.interfaces.dataset import Recording
from regkit.interfaces.expected import Expected
from regkit.interfaces.template import Template
from regkit.observation import Frame, Truth
from regkit.system.errors import ConfigError


class BoundSegmenter(ABC):
    """A segmenter bound to a recording; its memory does not grow with the number of frames."""

    @abstractmethod
    def segmented(self, frame: Frame, expected: Expected | None) -> Frame:
        """Returns the frame with the points that may be the body's.

        Removed pixels are free space, or unknown where something may hide the body; see
        ``Frame.only``.

        Args:
            frame: A frame of the recording.
            expected: What is known of the body in the last frame; None before the start.
        """


class Segmenter(Plugin, ABC):
    """A way to take the body out of a scene."""

    group = "regkit.segmenters"

    @abstractmethod
    def bind(self, recording: Recording, template: Template) -> BoundSegmenter:
        """Binds the segmenter to a recording, of which it may read a few frames.

        Args:
            recording: The recording, after the segmenters before this one.
            template: Template of the body.

        Raises:
            RegkitError: If a frame cannot be read, or the recording does not suit the segmenter.
        """

    def each(self, recording: Recording, template: Template) -> tuple[Segmenter, ...]:
        """Returns a segmenter for each body in the recording's first frame.

        By default it is this one: it cannot tell bodies apart.

        Args:
            recording: The recording, after the segmenters before this one.
            template: Template of the bodies.
        """
        return (self,)


def each_body(
    segmenters: Sequence[Segmenter], recording: Recording, template: Template
) -> tuple[tuple[Segmenter, ...], ...]:
    """Returns the segmentation of each body in the recording's first frame.

    Args:
        segmenters: Segmenters, the first of which that tells bodies apart is replaced.
        recording: The recording.
        template: Template of the bodies.

    Raises:
        RegkitError: If a frame cannot be read, or the recording does not suit a segmenter.
    """
    if recording.cameras():
        raise ConfigError(
            "several bodies are told apart in the frames of one camera only; track the folder of a "
            "camera, or one body",
            place=recording.name,
        )
    for at, segmenter in enumerate(segmenters):
        before = Chain.of(segmenters[:at], recording, template)
        left = SegmentedRecording.of(recording, before) if at else recording
        found = segmenter.each(left, template)
        if found != (segmenter,):
            return tuple((*segmenters[:at], one, *segmenters[at + 1 :]) for one in found)
    return (tuple(segmenters),)


@dataclass(frozen=True)
class Chain(BoundSegmenter):
    """Bound segmenters that are applied in order.

    Attributes:
        steps: The segmenters.
        names: Their kinds.
    """

    steps: tuple[BoundSegmenter, ...] = ()
    names: tuple[str, ...] = ()

    @classmethod
    def of(cls, segmenters: Sequence[Segmenter], recording: Recording, template: Template) -> Chain:
        """Binds segmenters to a recording, each to what those before it leave.

        Of several cameras, each has a chain of its own.

        Raises:
            RegkitError: If a frame cannot be read, or the recording does not suit a segmenter.
        """
        cameras = recording.cameras()
        if cameras and segmenters:
            each = {name: cls.of(segmenters, one, template) for name, one in cameras.items()}
            return cls((ViewSegmenter(each),), ("each camera",))
        chain = cls()
        for segmenter in segmenters:
            left = SegmentedRecording.of(recording, chain) if chain.steps else recording
            steps = (*chain.steps, segmenter.bind(left, template))
            chain = cls(steps, (*chain.names, segmenter.kind))
        return chain

    def named_steps(self) -> Iterator[tuple[str, BoundSegmenter]]:
        """Yields the names and segmenters of all steps, with those of chains within the chain."""
        for name, step in zip(self.names, self.steps, strict=True):
            if isinstance(step, Chain):
                yield from step.named_steps()
            elif isinstance(step, ViewSegmenter) and step.steps:
                yield from step.steps
            else:
                yield name, step

    def segmented(self, frame: Frame, expected: Expected | None) -> Frame:
        """Returns the frame after all steps."""
        for step in self.steps:
            frame = step.segmented(frame, expected)
        return frame


@dataclass(frozen=True)
class ViewSegmenter(BoundSegmenter):
    """Segments the view of each camera by what is bound to that camera's own recording.

    A camera of which nothing is left is left out of the frame.

    Attributes:
        cameras: What is bound to each camera, by its name.
    """

    cameras: Mapping[str, Chain]

    @property
    def steps(self) -> list[tuple[str, ViewSegmenter]]:
        """Names and segmenters of the steps; none if the cameras have different ones."""
        each = {name: list(chain.named_steps()) for name, chain in self.cameras.items()}
        names = [[step for step, _ in steps] for steps in each.values()]
        if any(one != names[0] for one in names):
            return []
        return [
            (step, ViewSegmenter({
                name: Chain((steps[at][1],), (step,)) for name, steps in each.items()
            }))
            for at, step in enumerate(names[0])
        ]  # fmt: skip

    def segmented(self, frame: Frame, expected: Expected | None) -> Frame:
        """Returns the frame with the points of each view that may be the body's."""
        views = []
        for view in frame.views:
            seen = None if expected is None else expected.seen_from(view.to_camera)
            left = self.cameras[view.name].segmented(view.data, seen)
            if len(left.points):
                views.append(replace(view, data=left))
        return Frame.of_views(views, place=frame.place, landmarks=frame.landmarks)


@dataclass(frozen=True)
class SegmentedRecording(Recording):
    """A recording whose frames are segmented without knowledge of the body.

    Attributes:
        whole: The recording.
        segmenter: The segmenter.
    """

    whole: Recording
    segmenter: BoundSegmenter

    @classmethod
    def of(cls, whole: Recording, segmenter: BoundSegmenter) -> SegmentedRecording:
        """Returns the segmented frames of a recording."""
        return cls(whole.name, whole.fps, whole.length, whole, segmenter, subject=whole.subject)

    def frames(self) -> Iterator[Frame]:
        """Yields all frames, segmented."""
        for frame in self.whole.frames():
            yield self.segmenter.segmented(frame, None)

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields selected frames with their indices, segmented."""
        for index, frame in self.whole.some(indices):
            yield index, self.segmenter.segmented(frame, None)

    def truth(self) -> Truth | None:
        """Returns the reference joints of the recording."""
        return self.whole.truth()
