"""How sure the markers of a track are, as ellipsoids."""

from __future__ import annotations

import numpy as np
import scipy

from regkit.body import Body
from regkit.geometry.rotation import from_matrix
from regkit.system.arrays import Singles
from regkit.tracking import Track

HOLDS = 0.9
"""Probability that an ellipsoid holds the marker's true position."""


def ellipsoids_of(track: Track, body: Body) -> Singles | None:
    """Returns the ellipsoid of each marker's position in each frame; None if it is unknown.

    Args:
        track: The track.
        body: The body.

    Returns:
        A quaternion (x, y, z, w) of the axes in the camera's frame, and the half axes [m],
        (T, M, 7); NaN in frames without data.
    """
    covariances = track.marker_covariances(body)
    if covariances is None:
        return None
    known = np.asarray(np.isfinite(covariances).all(axis=(2, 3)))
    variances, axes = np.linalg.eigh(np.where(known[..., None, None], covariances, np.eye(3)))
    # A mirrored frame is no rotation.
    axes[..., 0] *= np.sign(np.linalg.det(axes))[..., None]
    reach = float(np.sqrt(scipy.stats.chi2.ppf(HOLDS, df=3)))
    turns = from_matrix(axes.reshape(-1, 3, 3)).reshape(*known.shape, 4)
    found = np.concatenate([turns, reach * np.sqrt(np.maximum(variances, 0.0))], axis=2)
    found[~known] = np.nan
    return np.asarray(found, dtype=np.float32)
