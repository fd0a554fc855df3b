"""What tracks a body, from the arguments of the API."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Self

from regkit.api.choices import Choice, Choices, load_template, name_of, segmenters_of
from regkit.clouds import spacing, voxel_for
from regkit.interfaces import (
    Method,
    Preprocessor,
    Recording,
    Segmenter,
    Start,
    StartSearch,
    Template,
    Tracker,
)
from regkit.observation import Frame
from regkit.skeleton import Pose, PoseDescription
from regkit.system.errors import RegkitError
from regkit.system.progress import working
from regkit.tracking import Session

POINTS = 900
"""Approximate number of points per frame without a preprocessor."""

ACROSS = 24
"""Number of voxels in the size of a part that is attached to a body, such as a hand's length."""

WIDTH = 0.5
"""Standard deviation of these points, relative to the voxel size."""

Beginning = Choice[StartSearch] | Pose | PoseDescription
"""The search for the first pose, as in an experiment's ``start``; or the pose itself."""


@dataclass(frozen=True)
class Pipeline:
    """What tracks a body through a recording or a stream.

    Attributes:
        template: The body.
        method: The method.
        method_name: Its name in tables.
        tracker: The tracker, which may be the method's own.
        segmentation: Segmenters that take the body out of the scene.
        preprocessor: The preprocessor, or a function that chooses one for the first frame.
        start: The search for the start, or the pose.
    """

    template: Template
    method: Method
    method_name: str
    tracker: Tracker
    segmentation: tuple[Segmenter, ...]
    preprocessor: Preprocessor | Callable[[Frame], Preprocessor]
    start: StartSearch | Pose

    @classmethod
    def of(
        cls,
        template: Choice[Template],
        method: Choice[Method] | None = None,
        segmentation: Choices[Segmenter] | None = None,
        preprocessor: Choice[Preprocessor] | None = None,
        tracker: Choice[Tracker] | None = None,
        start: Beginning | None = None,
        *,
        place: str,
    ) -> Self:
        """Returns the pipeline of the arguments of ``track``.

        Args:
            template: The body.
            method: The method.
            segmentation: The segmenters.
            preprocessor: The preprocessor.
            tracker: The tracker.
            start: The pose in the first frame, or its search.
            place: Name of the calling function in messages.

        Raises:
            RegkitError: If an argument is invalid.
        """
        loaded = load_template(template)
        method = Method.default() if method is None else method
        chosen = Method.parse(method, place=place, field="method")
        follows = chosen.tracker or Tracker.parse(
            Tracker.default() if tracker is None else tracker, place=place, field="tracker"
        )
        if preprocessor is not None:
            preprocessor = Preprocessor.parse(preprocessor, place=place, field="preprocessor")
        return cls(
            template=loaded,
            method=chosen,
            method_name=name_of(method),
            tracker=follows,
            segmentation=segmenters_of(segmentation, place=place),
            preprocessor=preprocessor or partial(preprocessor_for, largest=_voxel_of_parts(loaded)),
            start=_search(start, place),
        )

    def session(self, recording: Recording, sized_in: int = 3) -> Session:
        """Returns the session of a recording.

        Args:
            recording: The recording.
            sized_in: Number of frames that determine an unknown size.
        """
        return Session(
            recording,
            self.template,
            self.preprocessor,
            self.start,
            sized_in=sized_in,
            segmentation=self.segmentation,
        )


def begin(session: Session) -> Start:
    """Returns the start of a session, and shows that it is sought.

    Raises:
        RegkitError: If no start can be found.
    """
    try:
        with working("searching the start"):
            return session.begin()
    except RegkitError as error:
        found = isinstance(session.start, StartSearch) and session.start.searches
        raise error if found else error.at("start") from None


def _search(start: Beginning | None, place: str) -> StartSearch | Pose:
    """Returns the search for the start, or a given pose."""
    if isinstance(start, Pose):
        return start
    if isinstance(start, PoseDescription) and not isinstance(start, StartSearch):
        start = StartSearch.default("pose", **start.model_dump())
    return StartSearch.parse(start or StartSearch.default(), place=place, field="start")


def _voxel_of_parts(template: Template) -> float | None:
    """Returns the voxel size [m] that shows the smallest attached part; None without any."""
    if template.coarse() is None:
        return None
    return min(part.size for part in template.description().parts.values()) / ACROSS


def preprocessor_for(frame: Frame, largest: float | None = None) -> Preprocessor:
    """Returns a preprocessor that downsamples to about ``POINTS``, each half a voxel wide.

    Of several cameras, the one with most points has so many.

    Args:
        frame: A frame.
        largest: Largest voxel size [m], at which there may be more points.
    """
    points = max((view.data.points for view in frame.each_view), key=len)
    voxel = voxel_for(points, POINTS)
    if largest is not None and voxel is not None:
        voxel = min(voxel, largest)
    data = Preprocessor.default(voxel=voxel, sigma=WIDTH * (voxel or spacing(points)))
    return Preprocessor.parse(data, place=frame.place or "frame", field="preprocessor")
