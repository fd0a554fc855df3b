"""Foundations without dependencies on other rooms.

- ``errors``: the errors that a user can cause.
- ``arrays``: array types and checks.
- ``files``, ``cache``: atomic files, and the cache folder.
- ``compiled``: functions compiled by Numba on first use.
- ``optional``: libraries imported on first use.
- ``shipped``: the folder of the examples that come with regkit.
- ``renamed``: old names of the Python API, answered with the new ones.
"""
