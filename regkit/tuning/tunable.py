"""What is tuned: a method's primitives on a body."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from regkit.body import Body, ListedShape, ShapeParameters
from regkit.body.freedoms import step_size
from regkit.interfaces import Method, Registrar, Tracker
from regkit.system.arrays import Array
from regkit.tuning.ties import tied_steps


@dataclass(frozen=True)
class Tunable:
    """A method's primitives on a body, and the independent parameters by which they are tuned.

    Attributes:
        method: The method.
        tracker: What leads it from frame to frame.
        body: The body.
        key: Key of the list in the template's ``shapes`` that the method takes.
        listed: The primitives from which tuning starts.
        former: Those that the template had, with which the result is compared.
    """

    method: Method
    tracker: Tracker
    body: Body
    key: str
    listed: ListedShape[ShapeParameters]
    former: ListedShape[ShapeParameters]

    @cached_property
    def steps(self) -> Array:
        """Steps of all free parameters for a unit step in each independent one, (P, F)."""
        return tied_steps(self.body, self.listed)

    def start(self) -> Array:
        """Returns the independent parameters of the primitives before tuning: zeros (F,)."""
        return np.zeros(self.steps.shape[1])

    def primitives(self, parameters: Array) -> ListedShape[ShapeParameters]:
        """Returns the primitives for values (F,) of the independent parameters."""
        ends = np.cumsum([step_size(one.freedoms()) for one in self.listed.parameters])
        each = np.split(self.steps @ parameters, ends[:-1])
        moved = [one.moved(step) for one, step in zip(self.listed.parameters, each, strict=True)]
        return ListedShape(self.listed.segments, tuple(moved))

    def registrar(self, parameters: Array) -> Registrar:
        """Returns the method bound to the body with primitives for values (F,)."""
        return self.bound(self.primitives(parameters))

    def bound(self, primitives: ListedShape[ShapeParameters]) -> Registrar:
        """Returns the method bound to the body with some primitives."""
        shapes = {**self.body.shapes, self.key: primitives}
        return self.method.bind(replace(self.body, shapes=shapes))

    def varied(self, parameters: Array, by: float) -> list[Registrar]:
        """Returns, for each independent parameter, the method with it increased."""
        return [self.registrar(parameters + step) for step in by * np.eye(len(parameters))]
