"""Datasets, which provide recordings.

- ``depth``, ``clouds``: folders of depth images or point clouds.
- ``synthetic``: rendered recordings of moving bodies.
- ``eval``, ``itop``, ``pdt13``, ``smmc10``, ``utd_mhad``: public datasets.
- ``formats``: not plug-ins; file formats that several datasets share.
"""
