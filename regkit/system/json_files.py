"""JSON files, read strictly and written atomically."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NoReturn

from regkit.system.errors import DataError
from regkit.system.files import write_text
from regkit.system.guard import reading
from regkit.system.printable import shortened


def read_json(path: Path) -> dict[str, Any]:
    """Returns the object in a JSON file.

    Raises:
        DataError: If it is missing, is not JSON, holds no object, names a field twice, or has a
            number that is not finite.
    """
    with reading(path, "a JSON file"):
        text = path.read_text(encoding="utf-8-sig")
        try:
            content = json.loads(
                text,
                object_pairs_hook=_once,
                parse_constant=_not_finite,
                parse_float=_finite,
                parse_int=_whole,
            )
        except json.JSONDecodeError as error:
            raise DataError(f"not JSON: {error.msg}", place=f"{path}:{error.lineno}") from None
        if not isinstance(content, dict):
            raise DataError(f"must be a JSON object {{...}}; it is a {type(content).__name__}")
        return content


def write_json(path: Path, data: Any) -> None:
    """Writes ``data`` as indented JSON, atomically; NaN is not allowed and must be None."""
    write_text(path, json.dumps(data, indent=2, allow_nan=False) + "\n")


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise DataError(f"the field '{shortened(twice)}' is given twice")
    return found


def _finite(text: str) -> float:
    value = float(text)
    return value if abs(value) < float("inf") else _not_finite(text)


def _whole(text: str) -> int:
    # A whole number beyond the floats would overflow wherever it is used.
    _finite(text)
    return int(text)


def _not_finite(text: str) -> NoReturn:
    raise DataError(f"{shortened(text)} is not a finite number")
