"""Damage within an archive of arrays: types, shapes, values, names, headers that lie."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable
from random import Random

import numpy as np

from tests.fuzz.mutations.unsuitable import UnsuitableError

Arrays = dict[str, np.ndarray]

VALUES = (float("nan"), float("inf"), -1.0, 0.0, 1e300, 1e9, 65535.0, -0.0, 0.5)
TYPES = ("f2", "f4", ">f8", "i1", "i8", "u8", "c16", "?", "U20", "S20", "O", "M8[s]")
SHAPES = ((10**12, 3), (10**9, 10**9), (2**62,), (-1, 3), (0, 3), (3,), ())


def _loaded(content: bytes) -> Arrays:
    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as archive:
            return {name: archive[name] for name in archive.files}
    except Exception:  # Whatever a reader raises on what is damaged already.
        raise UnsuitableError from None


def _packed(arrays: Arrays) -> bytes:
    stream = io.BytesIO()
    np.savez_compressed(stream, allow_pickle=True, **arrays)
    return stream.getvalue()


def _on_array(
    change: Callable[[Random, np.ndarray], np.ndarray],
) -> Callable[[Random, bytes], bytes]:
    def mutation(random: Random, content: bytes) -> bytes:
        arrays = _loaded(content)
        if not arrays:
            raise UnsuitableError
        name = random.choice(sorted(arrays))
        try:
            with np.errstate(all="ignore"):
                arrays[name] = change(random, arrays[name])
        except (ValueError, TypeError, IndexError, OverflowError):
            raise UnsuitableError from None
        return _packed(arrays)

    return mutation


def value(random: Random, array: np.ndarray) -> np.ndarray:
    changed = np.array(array)
    chosen = [random.randrange(changed.size) for _ in range(random.choice((1, 1, 3, 20)))]
    changed.flat[chosen] = random.choice(VALUES)
    return changed


def all_values(random: Random, array: np.ndarray) -> np.ndarray:
    return np.full_like(array, random.choice(VALUES))


def scaled(random: Random, array: np.ndarray) -> np.ndarray:
    return array * random.choice((1000.0, 1e-6, -1.0, 1e20))


def kind(random: Random, array: np.ndarray) -> np.ndarray:
    return array.astype(random.choice(TYPES))


def shape(random: Random, array: np.ndarray) -> np.ndarray:
    changes = (
        np.ravel,
        np.transpose,
        np.atleast_3d,
        lambda a: a[:0],
        lambda a: a[:-1],
        lambda a: a[None],
    )
    return random.choice((*changes, lambda a: a[..., :-1], lambda a: np.asarray(a.flat[0])))(array)


def longer(random: Random, array: np.ndarray) -> np.ndarray:
    return np.concatenate([array] * random.choice((2, 3)))


def order(random: Random, array: np.ndarray) -> np.ndarray:
    """Other rows first, or the same rows in Fortran's order."""
    return array[::-1] if random.random() < 0.5 else np.asfortranarray(array)


def exchange(random: Random, content: bytes) -> bytes:
    arrays = _loaded(content)
    if len(arrays) < 2:
        raise UnsuitableError
    one, other = random.sample(sorted(arrays), 2)
    arrays[one], arrays[other] = arrays[other], arrays[one]
    return _packed(arrays)


def rename(random: Random, content: bytes) -> bytes:
    arrays = _loaded(content)
    if not arrays:
        raise UnsuitableError
    name = random.choice(sorted(arrays))
    array = arrays.pop(name)
    if random.random() < 0.6:
        arrays[random.choice((f"{name}s", "arr_0", "../x", name.upper()))] = array
    return _packed(arrays)


def lying_header(random: Random, content: bytes) -> bytes:
    """An array whose header asks for other, or much more, numbers than follow."""
    arrays = _loaded(content)
    if not arrays:
        raise UnsuitableError
    chosen = random.choice(sorted(arrays))
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            inner = io.BytesIO()
            np.lib.format.write_array(inner, array)
            data = inner.getvalue()
            if name == chosen:
                form = random.choice(("<f8", "|O", "<f4", "|V10", "<i8,<f8", "bad", "<U1000000"))
                head = {"descr": form, "fortran_order": False, "shape": random.choice(SHAPES)}
                inner = io.BytesIO()
                np.lib.format.write_array_header_1_0(inner, head)
                data = inner.getvalue() + array.tobytes()[:500]
            archive.writestr(f"{name}.npy", data)
    return stream.getvalue()


def large(random: Random, content: bytes) -> bytes:
    """An array of zeros that is small in the file only."""
    arrays = _loaded(content)
    if not arrays:
        raise UnsuitableError
    name = random.choice(sorted(arrays))
    arrays[name] = np.zeros(
        (random.choice((10**5, 3 * 10**6)), *arrays[name].shape[1:]), dtype="f4"
    )
    return _packed(arrays)


ARCHIVES = {
    **{
        f"array.{one.__name__}": _on_array(one)
        for one in (value, all_values, scaled, kind, shape, longer, order)
    },
    **{f"array.{one.__name__}": one for one in (exchange, rename, lying_header, large)},
}
