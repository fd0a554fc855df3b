"""Several templates in one: parts of a body, and bodies that move freely beside each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import Literal, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from regkit.body import Body, BodyDescription
from regkit.body.composition import Composition, Sized
from regkit.body.members import Member, scaled
from regkit.config.model import did_you_mean, misplaced
from regkit.interfaces.template import Template
from regkit.skeleton.description import Name
from regkit.system.errors import ConfigError, RegkitError

BASE = "body"
"""Name of the part that is the base without its parts."""


class Composed(Template):
    """Several templates in one, which compete for the same points.

    A base has parts in place of some of its segments, such as hands with fingers at the ends of its
    arms. Other bodies move freely beside it, or beside each other, such as two hands, or a hand and
    an object that it grasps. The names of a part's segments and markers begin with the part's: the
    palm of ``left`` is ``left_palm``.
    """

    kind: Literal["composed"] = "composed"
    base: Template | None = None
    """The body that has the parts ``at``."""
    at: dict[Name, Template] = Field(default_factory=dict)
    """Parts of the base, by the segment that they replace, where its template has ``sockets``. A
    part without a given size has that of the socket."""
    free: dict[Name, Template] = Field(default_factory=dict)
    """Bodies that move freely beside the base and each other, by name. A body without a given size
    keeps its proportion to the first one without, whose size is that of the whole."""

    @model_validator(mode="after")
    def _compose_early(self) -> Self:
        if self.base is None and not self.free:
            raise ValueError(
                "name a 'base' with parts 'at' its segments, or bodies that are 'free'"
            )
        if self.base is None and self.at:
            raise misplaced(type(self), "parts need a 'base' to which they are attached", "at")
        if self.base is not None and BASE in self.free:
            raise misplaced(type(self), f"the base is called '{BASE}' already", "free", BASE)
        try:
            self._check_sockets()
            self.description()
        except RegkitError as error:
            raise PydanticCustomError("plugin_error", "{error}", {"error": str(error)}) from error
        return self

    def description(self) -> BodyDescription:
        """Returns the description of the whole.

        Raises:
            RegkitError: If two parts have segments of the same name, or a file is invalid.
        """
        return self._composition().description

    def given_size(self) -> float | None:
        """Returns the size of the first body [m], if those of all bodies are given."""
        sizes = [_known_size(template) for template in self._bodies.values()]
        return None if None in sizes else sizes[0]

    def input_files(self) -> Iterable[Path]:
        """Returns the files of all templates."""
        templates = [*self._bodies.values(), *self.at.values()]
        return [path for template in templates for path in template.input_files()]

    def body(self, size: float) -> Body:
        """Returns the whole at a size [m]; bodies and parts with a given size keep it."""
        return self._composition(size).body(self.name())

    def coarse(self) -> Template | None:
        """Returns the base, if it has parts and nothing is beside it."""
        return self._bodies[BASE] if self.at and not self.free else None

    def free_bodies(self) -> Mapping[str, Template]:
        """Returns the templates of the bodies beside each other; of a base, with its parts."""
        if len(self._bodies) < 2:
            return {}
        base = Composed(base=self.base, at=self.at) if self.at else None
        return self._bodies | ({} if base is None else {BASE: base})

    def _composition(self, size: float | None = None) -> Composition:
        """Returns the composition at a size [m], by default at that of its description."""
        descriptions = {name: one.description() for name, one in self._bodies.items()}
        sizes = {name: _known_size(one) for name, one in self._bodies.items()}
        free = [name for name, given in sizes.items() if given is None]
        leading = free[0] if free else next(iter(sizes))
        usual = descriptions[leading].size.value
        members, parts = [], []
        for name, template in self._bodies.items():
            # The leading one has exactly the size that is asked for.
            part = 1.0 if name == leading else descriptions[name].size.value / usual
            own = sizes[name] or part * (usual if size is None else size)
            prefix = "" if name == BASE else f"{name}_"
            member = Member(name, scaled(descriptions[name], own), prefix)
            members.append(Sized(member, partial(template.body, own)))
        for name, template in self.at.items():
            own = template.given_size() or members[0].member.description.sockets[name].size
            member = Member(name, scaled(template.description(), own), f"{name}_", at=name)
            parts.append(Sized(member, partial(template.body, own)))
        return Composition(members, parts, list(sizes).index(leading))

    @property
    def _bodies(self) -> dict[str, Template]:
        """The bodies that move freely, by name; the whole is described with these and no others."""
        bodies = ({} if self.base is None else {BASE: self.base}) | self.free
        return {name: template.plain() for name, template in bodies.items()}

    def _check_sockets(self) -> None:
        """Refuses parts at segments without a socket.

        Raises:
            ConfigError: At the first one.
        """
        sockets = {} if self.base is None else self.base.description().sockets
        for name in self.at:
            if name not in sockets:
                known = ", ".join(sockets) or "none"
                raise ConfigError(
                    f"the base has no socket at '{name}' (there are: {known})"
                    + did_you_mean(name, list(sockets))
                    + "; a template of your own needs 'sockets' in its file"
                )


def _known_size(template: Template) -> float | None:
    """Returns the size of a template that is given, or has no range [m]; None if it has one."""
    sizes = template.candidate_sizes()
    return sizes[0] if len(sizes) == 1 else None
