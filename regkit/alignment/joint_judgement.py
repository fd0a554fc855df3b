"""Whether many views were aligned: the verdict of a joint alignment, and its reason."""

from __future__ import annotations

from collections.abc import Sequence

from regkit.alignment.judgement import judged
from regkit.alignment.pose_graph import JointAlignment
from regkit.body.verdict import Verdict


def judged_all(found: JointAlignment, names: Sequence[str]) -> tuple[Verdict, str]:
    """Returns whether all views are linked, by alignments that are not doubtful, and why not.

    Args:
        found: The views' alignment.
        names: Names of the views.
    """
    alone = [name for name, linked in zip(names, found.linked, strict=True) if not linked]
    if alone:
        return Verdict.LOST, f"nothing links {', '.join(alone)} to {names[0]}"
    reached, size = {0}, 0
    while len(reached) > size:
        size = len(reached)
        for pair in found.pairs:
            sure = pair.kept and judged(pair.found)[0] is Verdict.FOUND
            if sure and reached & {pair.source, pair.target}:
                reached |= {pair.source, pair.target}
    unsure = [name for index, name in enumerate(names) if index not in reached]
    if unsure:
        return Verdict.DOUBTFUL, f"only doubtful alignments link {', '.join(unsure)} to {names[0]}"
    return Verdict.FOUND, ""
