"""Lists of primitives in a file of their own, which a template takes in."""

from __future__ import annotations

import json
from pathlib import Path

from regkit.body.description import BodyDescription
from regkit.body.reading import validated_in
from regkit.body.shapes import Shapes
from regkit.body.writing import comment_lines, shape_lines
from regkit.config.model import Model


class TunedLists(Model):
    """Further lists of primitives of a template, such as tuned ones, at the template's size."""

    sources: tuple[str, ...]
    """Origin of the lists."""
    shapes: Shapes
    """The lists by ``KIND/NAME``, each by segment."""

    def added_to(self, description: BodyDescription) -> BodyDescription:
        """Returns a template that has these lists too, and their sources."""
        return description.model_copy(
            update={
                "sources": (*description.sources, *self.sources),
                "shapes": {**description.shapes, **self.shapes},
            }
        )

    def text(self, opening: str) -> str:
        """Returns the YAML, with a comment at the top."""
        lines = [*comment_lines(opening), "", "sources:"]
        lines += [f"  - {json.dumps(source)}" for source in self.sources]
        return "\n".join([*lines, "", *shape_lines(self.shapes)]) + "\n"


def tuned_lists_in(path: Path) -> TunedLists:
    """Returns the lists in a YAML file; see ``validated_in``."""
    return validated_in(path, TunedLists)
