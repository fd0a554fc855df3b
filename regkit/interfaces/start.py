"""Starts: the pose and size of a body in the first frame of a recording."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from regkit.body import Body
from regkit.body.verdict import Verdict
from regkit.config.plugin import Plugin
from regkit.interfaces.template import Template
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Start(Brief):
    """The pose and size in the first frame of a recording.

    Attributes:
        body: The body at its size.
        pose: Its pose in the first frame.
        verdict: Whether the body was found.
        reason: Why it is not surely found; empty if it is.
        margin: Cost of the best rival that is turned or mirrored, less that of the pose,
            dimensionless; NaN if there was no rival.
        rivals: Other poses that were registered, the best first; what else is known of the scene
            may decide for one of them.
        extended: Whether the body is that of the extended template (``Template.chosen``).
    """

    body: Body
    pose: Pose
    verdict: Verdict = Verdict.FOUND
    reason: str = ""
    margin: float = float("nan")
    rivals: tuple[Pose, ...] = ()
    extended: bool = False

    @property
    def summary(self) -> str:
        """The verdict in words, which the reason completes."""
        if self.verdict is Verdict.FOUND:
            return "the start is found"
        missed = self.verdict is Verdict.LOST
        return "the start is not found" if missed else "the start is doubtful"


class StartSearch(Plugin, ABC):
    """A way to the pose and size in the first frame, the same for all methods."""

    group = "regkit.starts"

    searches: ClassVar[bool] = True
    """Whether the start is estimated from the data; a given one is not."""

    def check(self, template: Template) -> None:
        """Checks that a template can be started so, before any data are read.

        Raises:
            ConfigError: If it cannot.
        """

    @abstractmethod
    def find(self, template: Template, observations: Sequence[Observation]) -> Start:
        """Returns the pose in the first observation, and the size.

        Args:
            template: The template, possibly of unknown size.
            observations: The first frame, at least; of a template of unknown size, more frames that
                may show the size better.

        Raises:
            RegkitError: If the template does not support this search.
        """
