"""The effects of the direct method's terms on a frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from regkit.interfaces import JointEnergy, Scene, Similarity, Term, VisibilityWeights
from regkit.interfaces.term import Effect
from regkit.primitives import Primitives
from regkit.system.arrays import Array
from regkit.system.errors import PluginError


@dataclass(frozen=True)
class Effects:
    """The effects of terms.

    Attributes:
        weights: Weights of the primitives in this frame, (K,).
        terms: The bound terms on primitives, by their places in the YAML.
        joints: The bound terms on joints.
    """

    weights: Array
    terms: dict[str, Similarity]
    joints: tuple[JointEnergy, ...]

    @classmethod
    def of(cls, terms: Sequence[Term], primitives: Primitives, scene: Scene) -> Effects:
        """Binds terms to a frame.

        Args:
            terms: The terms.
            primitives: The primitives with their weights before this frame.
            scene: The frame.

        Raises:
            PluginError: If a term has another effect than its class declares.
        """
        weights = primitives.weights
        energies: dict[str, Similarity] = {}
        joints: list[JointEnergy] = []
        for index, term in enumerate(terms):
            effect = term.bind(scene)
            if isinstance(effect, VisibilityWeights) is not term.weighs:
                raise _undeclared(term, effect)
            if isinstance(effect, VisibilityWeights):
                weights = weights * effect.factors
            elif isinstance(effect, JointEnergy):
                joints.append(effect)
            else:
                energies[f"terms[{index}] ({term.kind})"] = effect
        return cls(weights, energies, tuple(joints))


def _undeclared(term: Term, effect: Effect) -> PluginError:
    """Returns the error of a term whose effect is not the one that its class declares."""
    return PluginError(
        f"term '{term.kind}' returns {type(effect).__name__}, but its class declares "
        f"weighs = {term.weighs}; set it to {not term.weighs}"
    )
