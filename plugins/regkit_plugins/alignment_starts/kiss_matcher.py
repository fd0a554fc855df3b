"""Matched features by KISS-Matcher."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from regkit.clouds import spacing, voxel_for
from regkit.interfaces import Method
from regkit.interfaces.alignment_start import AlignmentCandidate, AlignmentStart
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.optional import load_library


class KissMatcher(AlignmentStart):
    """KISS-Matcher of Lim et al., 2025: features pruned by graphs, and a robust solver."""

    kind: Literal["kiss_matcher"] = "kiss_matcher"

    points: Annotated[int, Field(ge=100, le=1_000_000)] = 3000
    """Approximate number of points for which features are computed."""
    least: Annotated[int, Field(ge=3, le=100_000)] = 5
    """Least number of correspondences of a motion, below which none is found."""

    def library(self) -> Any:
        """Returns the module ``kiss_matcher``."""
        return load_library("kiss_matcher", install="pip install 'regkit[baselines]'")

    def candidates(self, source: Array, target: Array, method: Method) -> list[AlignmentCandidate]:
        """Returns the motion that KISS-Matcher finds.

        Raises:
            DataError: If too few features match.
            DependencyError: If the library is missing.
        """
        kiss = self.library()
        voxel = max(voxel_for(cloud, self.points) or spacing(cloud) for cloud in (source, target))
        # It refuses small voxels, so the voxel is the unit. It has single precision, in which far
        # coordinates have few digits.
        matcher = kiss.KISSMatcher(kiss.KISSMatcherConfig(1.0))
        here, there = source.mean(axis=0), target.mean(axis=0)
        clouds = [(source - here) / voxel, (target - there) / voxel]
        try:
            found = matcher.estimate(*(list(cloud.astype(np.float32)) for cloud in clouds))
        except RuntimeError as error:
            raise DataError(f"KISS-Matcher failed: {error}", place="start") from error
        count = int(matcher.get_num_final_inliers())
        if not found.valid or count < self.least:
            raise DataError(
                f"KISS-Matcher finds {count} correspondences of one motion, and at least "
                f"{self.least} are needed; choose another start",
                place="start",
            )
        # In double precision, its rotation is one only to seven digits.
        left, _, right = np.linalg.svd(np.asarray(found.rotation, dtype=float))
        transform = np.eye(4)
        transform[:3, :3] = left @ right
        transform[:3, 3] = voxel * np.ravel(found.translation) + there - transform[:3, :3] @ here
        description = f"{count} correspondences, by KISS-Matcher"
        return [AlignmentCandidate(transform, 2.0 * voxel, description)]
