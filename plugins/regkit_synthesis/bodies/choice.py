"""The choice of a body and of its motion in YAML: a shipped one by its name, or any by its kind."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, Discriminator, Field, Tag

from regkit_synthesis.bodies.bodies import AnyBody, BodyName, ShippedBody
from regkit_synthesis.bodies.movable import BodyConfig
from regkit_synthesis.hands.config import GesturesConfig
from regkit_synthesis.motion.config import (
    BvhConfig,
    ClipConfig,
    GltfConfig,
    KeyframesConfig,
    MotionConfig,
)
from regkit_synthesis.motion.shipped import CLIPS


def _form(value: Any) -> str:
    """Returns the tag of a body's or motion's form: name or configuration."""
    return "name" if isinstance(value, str) else "config"


Body = Annotated[
    Annotated[BodyName, Tag("name")] | Annotated[AnyBody, Tag("config")], Discriminator(_form)
]
"""A shipped body by its name, or any body by its ``kind``."""


def _clip(name: str) -> str:
    """Validates the name of a shipped clip."""
    CLIPS.check_choice(name, None)
    return name


_AnyMotion = Annotated[
    ClipConfig | BvhConfig | GltfConfig | KeyframesConfig | GesturesConfig,
    Field(discriminator="kind"),
]

Motion = Annotated[
    Annotated[str, AfterValidator(_clip), Tag("name")] | Annotated[_AnyMotion, Tag("config")],
    Discriminator(_form),
]
"""A shipped clip by its name, or any motion by its ``kind``."""


def chosen_body(choice: BodyName | BodyConfig) -> BodyConfig:
    """Returns a shipped body by its name, or the given one."""
    return ShippedBody(name=choice) if isinstance(choice, str) else choice


def chosen_motion(choice: str | MotionConfig | GesturesConfig) -> MotionConfig | GesturesConfig:
    """Returns a shipped clip by its name, or the given motion."""
    return ClipConfig(name=choice) if isinstance(choice, str) else choice
