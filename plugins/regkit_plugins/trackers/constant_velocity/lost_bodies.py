"""Which of several bodies are lost in a frame."""

from __future__ import annotations

import numpy as np

from regkit.body import Body
from regkit.body.each import fits_of_each, shares_of_each, verdicts_of_each
from regkit.body.verdict import Verdict
from regkit.observation import Observation
from regkit.skeleton import Pose


def lost_bodies(body: Body, pose: Pose, observation: Observation) -> list[int]:
    """Returns the indices of those of several bodies that are not surely found, the worst first.

    If all are, the outliers are one's that fits hardly worse, so that it is the worst.

    Args:
        body: The bodies as one.
        pose: Its pose.
        observation: The frame.
    """
    fits = fits_of_each(body, pose, observation.points, observation.sight)
    misfits = np.nan_to_num([one.misfit for one in fits], nan=np.inf)
    # Exemplars are made of capsules.
    order = [at for at in np.argsort(-misfits).tolist() if len(body.free_bodies[at].body.capsules)]
    verdicts = verdicts_of_each(shares_of_each(fits))
    return [at for at in order if verdicts[at] is not Verdict.FOUND] or order[:1]
