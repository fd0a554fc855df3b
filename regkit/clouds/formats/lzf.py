"""LZF decompression, which PCD files use.

Source: Marc Lehmann, LibLZF, https://oldhome.schmorp.de/marc/liblzf.html.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.system.compiled import compiled

MAX_EXPANSION = 100
"""LZF copies at most 264 bytes for three."""

Bytes = NDArray[np.uint8]


@compiled
def decompress(packed: Bytes, size: int) -> Bytes:
    """Returns the unpacked bytes; they are fewer or none if ``packed`` is damaged.

    Args:
        packed: The compressed bytes.
        size: Number of bytes to unpack.
    """
    out = np.empty(size, dtype=np.uint8)
    read, written, end = 0, 0, len(packed)
    while read < end:
        control = int(packed[read])
        read += 1
        if control < 32:
            count = control + 1
            if read + count > end or written + count > size:
                return out[:0]
            for _ in range(count):
                out[written] = packed[read]
                written += 1
                read += 1
            continue
        count = control >> 5
        if count == 7:
            if read >= end:
                return out[:0]
            count += int(packed[read])
            read += 1
        if read >= end:
            return out[:0]
        start = written - ((control & 31) << 8) - int(packed[read]) - 1
        read += 1
        count += 2
        if start < 0 or written + count > size:
            return out[:0]
        for step in range(count):
            out[written] = out[start + step]
            written += 1
    return out[:written]
