"""The given start: a pose in the configuration."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Literal

from regkit.interfaces import Start, StartSearch, Template
from regkit.observation import Observation
from regkit.skeleton import PoseDescription
from regkit.system.errors import ConfigError


class Given(StartSearch, PoseDescription):
    """Starts in a given pose, which requires the template's size."""

    kind: Literal["given"] = "given"
    searches: ClassVar[bool] = False

    def check(self, template: Template) -> None:
        """Checks that the template has a size, and the pose's joints.

        Raises:
            ConfigError: If the size or a joint is unknown.
        """
        self._start(template)

    def find(self, template: Template, observations: Sequence[Observation]) -> Start:
        """Returns the given start.

        Raises:
            ConfigError: If the size or a joint is unknown.
        """
        return self._start(template)

    def _start(self, template: Template) -> Start:
        size = template.given_size()
        if size is None:
            raise ConfigError("a given start needs the template's size")
        body = template.body(size)
        return Start(body, body.skeleton.pose(self))
