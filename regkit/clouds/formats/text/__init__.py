"""Clouds in text files.

- ``lines``: the lines of a file in any common encoding.
- ``delimiter``: what separates the cells, found once for the whole file.
- ``columns``: names of columns: which are x, y and z, and in which unit.
- ``header``: the line that names the columns.
- ``numpy_rows``, ``numbers``: the rows as numbers: plain ones at once, others one by one.
- ``ambiguity``: files that can be read in two ways.
- ``reading``: a whole file.
"""

from regkit.clouds.formats.text.reading import read_text

__all__ = ["read_text"]
