"""Foundations without dependencies on other rooms.

- ``errors``: the errors that a user can cause.
- ``guard``, ``plugin_code``: the boundaries to the bytes and the code of others.
- ``notes``: what a reader passed over, assumed or repaired.
- ``arrays``, ``archives``: array types and checks, and ``.npz`` files.
- ``printable``, ``names``, ``csv_table``, ``brief``: texts for terminals, paths, tables, notebooks.
- ``files``, ``json_files``, ``cache``: atomic files, and the cache folder.
- ``digests``, ``links``: what a file or folder holds, and where it leads.
- ``progress``: the progress of long work.
- ``compiled``: functions compiled by Numba on first use.
- ``optional``: libraries imported on first use.
- ``shipped``: the folder of the examples that come with regkit.
- ``renamed``: old names of the Python API, answered with the new ones.
"""
