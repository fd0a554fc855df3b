"""Parameters of shape models, as listed in templates."""

from __future__ import annotations

import json
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, Never, Self

import numpy as np

from regkit.body.deformation import Deformation
from regkit.body.freedoms import MIRROR, Freedom, step_parts
from regkit.body.rows import fields_row
from regkit.config.model import Model
from regkit.geometry.capsule_points import capsule_points
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, PluginError

SAMPLES = 2000
"""About the number of points inside a capsule to which a primitive is fitted."""


class ShapeParameters(Model, ABC):
    """Parameters of one primitive in its segment's frame, as a template lists them.

    The fields are the keys that a user writes. A shape model declares its class as
    ``ShapeModel.parameters``.
    """

    @abstractmethod
    def deformed(self, deformation: Deformation) -> Self:
        """Returns the primitive in a scaled, stretched or mirrored segment."""

    @abstractmethod
    def moments(self) -> tuple[Array, Array]:
        """Returns mean (3,) [m] and covariance (3, 3) [m^2] of the solid in its segment's frame."""

    @classmethod
    @abstractmethod
    def fitted(cls, points: Array, like: Self | None = None) -> Self:
        """Returns the primitive that fills evenly spread points inside a mesh.

        Args:
            points: Points in the segment's frame, (N, 3) [m].
            like: Parameters of another template at this place, whose options the result keeps.
        """

    @classmethod
    def of_capsule(cls, ends: Array, radii: Array) -> Self:
        """Returns the primitive that stands for a solid tapered capsule, without rounding.

        By default it is fitted to points inside.

        Args:
            ends: Centres of the two spheres in the segment's frame, (2, 3) [m].
            radii: Their radii, (2,) [m].
        """
        return cls.fitted(capsule_points(ends, radii, SAMPLES))

    def freedoms(self) -> tuple[Freedom, ...]:
        """Returns the free parameters by which a primitive is optimised, in the order of a step.

        By default there are none, and an optimisation leaves the primitive as it is.
        """
        return ()

    def moved(self, step: Array) -> Self:
        """Returns the primitive changed by a step in its free parameters, without rounding.

        A class with ``freedoms`` overrides it.

        Args:
            step: Change of the free parameters, (P,); zero changes nothing.

        Raises:
            PluginError: If the class has free parameters, and no ``moved``.
        """
        if self.freedoms():
            raise PluginError(f"{type(self).__name__} has free parameters, but does not move them")
        return self

    def mirrored_step(self, step: Array, reflection: Array = MIRROR) -> Array:
        """Returns the step (..., P) that the mirror image takes when this primitive takes ``step``.

        ``one.deformed(Mirror()).moved(one.mirrored_step(step))`` is the mirror image of
        ``one.moved(step)``. The map is linear: steps of both sides of a body can be tied by it.

        Args:
            step: Changes of the free parameters, (..., P).
            reflection: Orthogonal matrix of determinant -1 that maps positions in the segment's
                frame to those of the mirror image in its own, (3, 3); by default the reflection in
                the plane x = 0, like ``Mirror``.
        """
        parts = zip(self.freedoms(), step_parts(self.freedoms(), step), strict=True)
        mirrored = [freedom.mirrored(part, reflection) for freedom, part in parts]
        return np.concatenate(mirrored, axis=-1) if mirrored else step

    def yaml(self) -> str:
        """Returns a mapping in one line, with four decimals of lengths [m], one of angles [deg]."""
        return fields_row(self)


class UncheckedParameters(ShapeParameters):
    """Parameters of a shape model that cannot be loaded here, kept unchanged.

    Only the shape model itself can check, deform or fit them.
    """

    key: str
    """Key of the list in ``shapes``: the shape model's kind, and the name of a named list."""
    reason: str
    """Reason why it cannot be loaded."""
    given: Mapping[str, Any]
    """The listed parameters."""

    def deformed(self, deformation: Deformation) -> Self:
        """Refuses, since the shape model is unknown.

        Raises:
            ConfigError: Always.
        """
        self.refuse()

    def moments(self) -> tuple[Array, Array]:
        """Refuses, since the shape model is unknown.

        Raises:
            ConfigError: Always.
        """
        self.refuse()

    @classmethod
    def fitted(cls, points: Array, like: Self | None = None) -> Self:
        """Refuses, since the shape model is unknown.

        Raises:
            ConfigError: Always.
        """
        assert like is not None
        like.refuse()

    def freedoms(self) -> tuple[Freedom, ...]:
        """Refuses, since the shape model is unknown.

        Raises:
            ConfigError: Always.
        """
        self.refuse()

    def yaml(self) -> str:
        """Returns the listed parameters unchanged."""
        return json.dumps(self.given, ensure_ascii=False)

    def refuse(self) -> Never:
        """Raises an error that names the required shape model.

        Raises:
            ConfigError: Always.
        """
        raise ConfigError(
            f"parameters of '{self.key}' cannot be changed or fitted without their shape model "
            f"({self.reason}); install it, or remove them from the template",
            place=f"shapes.{self.key}",
        )
