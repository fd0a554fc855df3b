"""Binary files of organized clouds, with one record for each frame, as in EVAL."""

from regkit_plugins.datasets.formats.organized_clouds.dataset import OrganizedClouds
from regkit_plugins.datasets.formats.organized_clouds.records import RecordLayout

__all__ = ["OrganizedClouds", "RecordLayout"]
