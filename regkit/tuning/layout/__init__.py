"""How many primitives stand for a body, and where: one for each capsule, or any number."""

from regkit.tuning.layout.division import divided, one_per_capsule

__all__ = ["divided", "one_per_capsule"]
