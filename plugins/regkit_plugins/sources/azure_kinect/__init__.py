"""Recordings of Azure Kinect cameras.

- ``azure_kinect``: the plug-in.
- ``matroska``: elements of the container.
- ``track``: its depth images.
- ``calibration``: the camera in its attached file.
"""

from regkit_plugins.sources.azure_kinect.azure_kinect import AzureKinect

__all__ = ["AzureKinect"]
