"""File formats that several datasets share.

- ``folder_recording``: recordings in regkit's own folder format.
- ``truth_file``: reference joints beside them.
- ``organized_clouds``: binary files of one organized cloud, with markers and joints, per frame.
- ``matlab`` and ``hdf5``: arrays in MATLAB and HDF5 files.
- ``axes`` and ``subjects``: axes of the data, and subjects in recordings' names.
"""
