"""Formats of files that several datasets share.

- ``recording_folders``: regkit's own folders of depth images or clouds.
- ``organized_clouds``: binary files of one organized cloud, with markers and joints, per frame.
- ``matlab`` and ``hdf5``: arrays in the files of others.
- ``axes`` and ``subjects``: which way their axes point, and whose recording a name is.
"""
