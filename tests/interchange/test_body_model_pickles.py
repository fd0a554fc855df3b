"""Pickles of body models are data: whatever they ask to run is refused, and nothing is run."""

import pickle
import pickletools
import struct
from pathlib import Path

import numpy as np
import pytest
from body_models import body_arrays, python3_pickle, write_npz

from regkit.interchange.body_model.pickles import Recorded, loaded
from regkit.interchange.body_model.recorded_arrays import array_of
from regkit.interchange.body_model.smpl import BodyModel
from regkit.system.errors import DataError


class Run:
    """Pickled, it is a call."""

    def __init__(self, function, *args) -> None:
        self.call = (function, args)

    def __reduce__(self):
        return self.call


def mark(folder: Path) -> Path:
    """A file that exists once a pickle has run."""
    return folder / "mark"


def text(value: str) -> bytes:
    return b"X" + struct.pack("<I", len(value)) + value.encode()


def programs(path: Path) -> dict[str, bytes]:
    """Pickles that make a file, in many ways."""
    import os  # The names of its functions are those of attacks.

    write = f"open({str(path)!r}, 'w')"
    shell = f"touch {path}"
    arrays = body_arrays()
    objects = np.array([Run(os.system, shell)], dtype=object)
    line = text(shell)
    return {
        "system": pickle.dumps(Run(os.system, shell), 2),
        "eval": pickle.dumps(Run(eval, write), 4),
        "exec": pickle.dumps({**arrays, "f": Run(exec, write)}, 0),
        "an item of an array": pickle.dumps({**arrays, "weights": objects}, 4),
        "nested": pickle.dumps({"f": [({"a": (Run(Path, Run(eval, write)),)},)]}, 5),
        "getattr": pickle.dumps(Run(getattr, Run(__import__, "os"), "system"), 4),
        "old names": b"\x80\x02c__builtin__\neval\n" + text(write) + b"\x85R.",
        "posix": b"\x80\x02cposix\nsystem\n" + line + b"\x85R.",
        # The function is in the memo, and called from there.
        "memo": b"\x80\x02cos\nsystem\nq\x000h\x00" + line + b"\x85R.",
        "instance": b"(" + line + b"ios\nsystem\n.",
        "object": b"(cos\nsystem\n" + line + b"o.",
        "a new object": b"\x80\x02csubprocess\nPopen\n" + line + b"\x85\x81.",
        "on the stack": b"\x80\x04" + text("os") + text("system") + b"\x93" + line + b"\x85R.",
        "a dotted name": b"\x80\x04"
        + text("numpy")
        + text("os.system")
        + b"\x93"
        + line
        + b"\x85R.",
        "numpy's own": b"\x80\x02cnumpy.core.multiarray\nload\n" + line + b"\x85R.",
        "a module of scipy": b"\x80\x02cscipy.sparse.csc\nos\n.",
        "through a reconstructor": b"\x80\x02ccopy_reg\n_reconstructor\n(cos\nsystem\n"
        b"c__builtin__\nobject\nNtR.",
        "a default factory": b"\x80\x02ccollections\ndefaultdict\ncos\nsystem\n\x85R.",
    }


NAMES = list(programs(Path("mark")))


def test_the_programs_of_these_tests_would_run(tmp_path):
    for name in ("system", "memo", "instance", "on the stack"):
        pickle.loads(programs(mark(tmp_path))[name])
        mark(tmp_path).unlink()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("suffix", [".pkl", ".npz"])
def test_a_pickle_that_is_a_program_is_refused_and_not_run(tmp_path, name, suffix):
    content = programs(mark(tmp_path))[name]
    path = tmp_path / f"model{suffix}"
    path.write_bytes(content)
    with pytest.raises(DataError) as raised:
        BodyModel.read(path, np.eye(3))
    assert "asks to run" in raised.value.message
    assert raised.value.place == str(path)
    assert not mark(tmp_path).exists()


def test_a_program_in_an_archive_is_refused_and_not_run(tmp_path):
    import os

    objects = np.array([Run(os.system, f"touch {mark(tmp_path)}")], dtype=object)
    for name in ("weights", "joint2num"):
        arrays = {**body_arrays(), name: objects}
        arrays["kintree_table"] = arrays["kintree_table"].astype(np.int64)
        arrays["kintree_table"][0, 23] = 0  # No known model, so names of joints are looked for.
        path = write_npz(tmp_path / "model.npz", arrays)
        with pytest.raises(DataError, match="asks to run"):
            BodyModel.read(path, np.eye(3))
        assert not mark(tmp_path).exists()


@pytest.mark.parametrize(
    "content",
    [
        b"\x80\x02cnumpy\nndarray\n)\x81(dq\x00h\x00b.",  # Its state is itself.
        b"\x80\x02cchumpy\nCh\n)\x81q\x00}X\x01\x00\x00\x00xh\x00sb.",  # A chain without an end.
        b"\x80\x02cnumpy\nndarray\n(K\x01K\x02dtb.",
        b"\x80\x02cnumpy\ndtype\n}X\x0b\x00\x00\x00__setstate__K\x01sb.",  # The state of a class.
        b"\x80\x02cnumpy\ndtype\nN}X\x06\x00\x00\x00originK\x01s\x86b.",
        b"\x80\x02cnumpy\ndtype\n)R)R.",  # What was built is called.
        b"\x80\x02P0\n.",
        b"\x80\x02\x82\x01.",
        b"\x80\x05\x96" + struct.pack("<Q", 2**60) + b"a.",
        b"\x80\x04\x8d" + struct.pack("<Q", 2**62) + b"a.",
        b"\x80\x04N" + b"r\xff\xff\xff\xff" + b".",
        b"\x80\x02" + b"(" * 100_000 + b".",
        b"\x80\x02" + b"]" + b"]a" * 0 + b"\x85" * 100_000 + b".",
        b"\x80\x02N.",
        b"\x80\x02](e.",
        b"\x80\x63.",
        b"",
        b".",
    ],
)
def test_a_damaged_pickle_is_refused(tmp_path, content):
    path = tmp_path / "model.pkl"
    path.write_bytes(content)
    with pytest.raises(DataError) as raised:
        BodyModel.read(path, np.eye(3))
    assert raised.value.place == str(path)


def array(shape=(2,), dtype="f8", state=None, data=bytes(16)) -> Recorded:
    """A recorded array; each argument may be wrong."""
    kind = loaded(b"\x80\x02cnumpy\ndtype\n.")(dtype, 0, 1)
    kind.__setstate__((3, "<", None, None, None, -1, -1, 0))
    made = loaded(b"\x80\x02cnumpy.core.multiarray\n_reconstruct\n.")()
    made.__setstate__((1, shape, kind, False, data) if state is None else state)
    return made


@pytest.mark.parametrize(
    ("value", "complaint"),
    [
        (array(shape=(3,)), "need 24 bytes; the file holds 16"),
        (array(shape=(10**9, 10**9)), "the file holds 16"),
        (array(shape=(-2,)), "no shape"),
        (array(shape="ab"), "no shape"),
        (array(dtype="O"), "type 'O'"),
        (array(dtype="V8"), "type 'V8'"),
        (array(dtype="f8, f8"), "needs numbers"),
        (array(dtype=7), "has no type"),
        (array(state=(1, 2)), "damaged"),
        (array(state={}), "damaged"),
        (array(data=[1.0, 2.0]), "Python objects"),
        (array(data=None), "Python objects"),
        ([1.0, 2.0], "of the type list"),
        (None, "of the type NoneType"),
    ],
)
def test_an_array_that_is_not_what_it_says_is_refused(value, complaint):
    with pytest.raises(DataError, match=complaint):
        array_of(value)


def test_an_array_is_read_in_its_order_of_bytes():
    np.testing.assert_array_equal(array_of(array(data=np.array([1.5, -2.0]).tobytes())), [1.5, -2])
    big = loaded(pickle.dumps(np.array([1.5, -2.0], dtype=">f8"), 2))
    np.testing.assert_array_equal(array_of(big), [1.5, -2.0])


@pytest.mark.parametrize(
    "state",
    [
        {"indices": np.array([9]), "indptr": np.array([0, 1, 1])},
        {"indices": np.array([-1]), "indptr": np.array([0, 1, 1])},
        {"indices": np.array([0]), "indptr": np.array([0, 7, 1])},
        {"indices": np.array([0]), "indptr": np.array([0, 1])},
        {"_shape": (10**6, 10**6)},
        {"_shape": (2,)},
        {"data": np.array([1.0, 2.0])},
        {"indptr": None},
    ],
)
def test_a_damaged_sparse_matrix_is_refused(tmp_path, state):
    sound = {
        "_shape": (2, 2),
        "data": np.array([1.0]),
        "indices": np.array([0]),
        "indptr": np.array([0, 1, 1]),
    }
    made = loaded(b"\x80\x02cscipy.sparse.csc\ncsc_matrix\n.")()
    made.__setstate__(sound)
    np.testing.assert_array_equal(array_of(made), [[1.0, 0.0], [0.0, 0.0]])
    made.__setstate__(sound | state)
    with pytest.raises((DataError, ValueError)):
        array_of(made)


def test_reading_imports_nothing(tmp_path):
    content = python3_pickle(body_arrays(), 2, as_chumpy="shapedirs")
    asked = {arg for _, arg, _ in pickletools.genops(content) if isinstance(arg, str)}
    assert "chumpy.ch Ch" in asked
    import sys

    before = set(sys.modules)
    path = tmp_path / "model.pkl"
    path.write_bytes(content)
    BodyModel.read(path, np.eye(3))
    assert not {name for name in set(sys.modules) - before if "chumpy" in name}
