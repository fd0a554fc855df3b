"""Binary files of organized clouds, one record for each frame, as EVAL stores them."""

from regkit_plugins.datasets.formats.organized_clouds.dataset import OrganizedClouds
from regkit_plugins.datasets.formats.organized_clouds.records import RecordLayout

__all__ = ["OrganizedClouds", "RecordLayout"]
