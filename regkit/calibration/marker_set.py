"""Marker sets: where the markers of a motion-capture system are, roughly, on a body."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.config.model import Model, did_you_mean, misplaced
from regkit.skeleton.joints import Position
from regkit.system.errors import ConfigError


class MarkerSet(Model):
    """A YAML file that lists the markers of a motion-capture system by name.

    Each is on one segment, at a place in the segment's frame in the template's own size, within
    some centimetres: ``C7: {chest: [0, 0.28, -0.06]}``.
    """

    markers: dict[str, dict[str, Position]] = Field(min_length=1)
    """Segment and place [m] of each marker."""

    @model_validator(mode="after")
    def _on_one_segment(self) -> Self:
        for name, places in self.markers.items():
            if len(places) != 1:
                raise misplaced(
                    type(self), f"a marker is on one segment, not {len(places)}", "markers", name
                )
        return self

    def check(self, template: BodyDescription, document: Document | None = None) -> None:
        """Checks that all markers are on segments of a template.

        Args:
            template: The template.
            document: Where the markers are written, for the place of a mistake.

        Raises:
            ConfigError: If a marker is on none.
        """
        known = list(template.segments)
        for name, places in self.markers.items():
            for segment in places:
                if segment not in known:
                    at = ("markers", name)
                    raise ConfigError(
                        f"'{segment}' is not a segment (there are: {', '.join(known)})"
                        + did_you_mean(segment, known),
                        place=".".join(at) if document is None else document.place(at),
                    )

    def added_to(self, template: BodyDescription) -> BodyDescription:
        """Returns a template with the markers, which replace its own of the same name.

        Raises:
            ConfigError: If a marker is on no segment of the template.
        """
        self.check(template)
        segments = {
            name: one.model_copy(
                update={"markers": {m: p for m, p in one.markers.items() if m not in self.markers}}
            )
            for name, one in template.segments.items()
        }
        for name, places in self.markers.items():
            for segment, place in places.items():
                segments[segment].markers[name] = place
        return template.model_copy(update={"segments": segments})
