"""The files of human and hand templates, with what is to be said in them."""

from __future__ import annotations

from typing import Literal

from regkit.body import BodyDescription
from regkit.body.writing import template_text
from regkit_synthesis.templates import hand_limits, human_limits

COMMAND = "python -m regkit_synthesis.templates"
"""What makes the templates that ship with regkit."""

_X_SIDES = {"right": "thumb's", "left": "little finger's"}
"""The side of each hand that its x axis points to."""


def human_text(body: BodyDescription, command: str = COMMAND) -> str:
    """The YAML of a human template that ``command`` makes."""
    opening = human_limits.OPENING.format(command=command)
    return template_text(body, opening, human_limits.COMMENTS)


def hand_text(hand: BodyDescription, side: Literal["right", "left"], command: str = COMMAND) -> str:
    """The YAML of a hand's template that ``command`` makes."""
    opening = hand_limits.OPENING.format(command=command, side=side, thumb=_X_SIDES[side])
    return template_text(hand, opening, hand_limits.COMMENTS)
