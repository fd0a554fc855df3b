"""The search for the source of an address."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from regkit.config.model import did_you_mean, path_in
from regkit.config.preset import YAML
from regkit.interfaces.source import Source
from regkit.system.errors import ConfigError, DataError, PluginError, RegkitError
from regkit.system.guard import reading

SCHEME = re.compile("([a-z][a-z0-9_+-]+):", re.IGNORECASE)
"""Begin of an address that is no path; a single letter is a drive of Windows."""


def described(address: str, kind: Any) -> dict[str, Any]:
    """Returns the kind of the source of an address, and the fields in the address.

    Args:
        address: A camera, or the path of a file or folder.
        kind: Name of the plug-in, as a user gives it; None if it is not known.

    Raises:
        ConfigError: If no plug-in has the scheme, or several accept the file.
        DataError: If there is no such file, or no plug-in reads it.
        PluginError: If there is no plug-in ``kind``.
    """
    found = None if kind is None else Source.load(str(kind))
    scheme = SCHEME.match(address)
    path = _path(address)
    if scheme is not None and not path.exists():
        found = found or _with_scheme(scheme[1].lower(), address)
        rest = address[scheme.end() :] if found.scheme == scheme[1].lower() else address
        return {"kind": _kind(found), **found.fields_of(rest)}
    if not path.exists():
        raise DataError(
            "there is no such file or folder; a source is a recording's file or folder"
            + _cameras(" or a camera, "),
            place=address,
        )
    if found is None and path.suffix.lower() in YAML:
        return Source.named(address)
    found = found or _accepting(path, address)
    return {"kind": _kind(found), **found.fields_of(address)}


def _path(address: str) -> Path:
    try:
        return path_in(Path.cwd(), address)
    except ValueError as error:
        raise ConfigError(str(error), place=address) from None


def _kind(source: type[Source]) -> str:
    return str(source.model_fields["kind"].default)


def _loaded() -> Iterator[type[Source]]:
    """Yields the plug-ins that can be loaded; a broken one matters to those who name it."""
    for kind in Source.available():
        try:
            yield Source.load(kind)
        except PluginError:
            continue


def _with_scheme(scheme: str, address: str) -> type[Source]:
    known = {source.scheme: source for source in _loaded() if source.scheme}
    if scheme not in known:
        schemes = ", ".join(f"{name}:" for name in sorted(known)) or "none"
        raise ConfigError(
            f"no source has the scheme '{scheme}:' (there are: {schemes}), and there is no such "
            "file" + did_you_mean(scheme, list(known)),
            place=address.rstrip(":"),
        )
    return known[scheme]


def _cameras(before: str) -> str:
    schemes = [f"'{source.scheme}:'" for source in _loaded() if source.scheme]
    return before + " or ".join(schemes) if schemes else ""


def _accepting(path: Path, address: str) -> type[Source]:
    """Returns the only plug-in that accepts a file or folder."""
    sources = list(_loaded())
    suffix = path.suffix.lower()
    near = [
        source
        for source in sources
        if (path.is_dir() and not source.scheme) or suffix in source.suffixes
    ]
    if not near:
        ends = f"ends with '{suffix}'" if suffix else "has no suffix"
        known = sorted({suffix for source in sources for suffix in source.suffixes})
        raise DataError(
            f"no source reads a file that {ends}; what is read are folders of recordings and files "
            f"{' '.join(known)}",
            place=address,
        )
    found, refusals = [], []
    for source in near:
        try:
            with reading(path, "a recording"):
                found += [source] if source.accepts(path) else []
        except RegkitError as error:
            refusals.append(error)
    if refusals and not found:
        raise refusals[0]
    if not found:
        what = "folder" if path.is_dir() else "file"
        raise DataError(f"no source reads this {what}: it is none of {_kinds(near)}", place=address)
    if len(found) > 1:
        raise ConfigError(
            f"several sources read it, {_kinds(found)}; name one by the field 'kind'",
            place=address,
        )
    return found[0]


def _kinds(sources: Iterable[type[Source]]) -> str:
    return ", ".join(map(_kind, sources))
