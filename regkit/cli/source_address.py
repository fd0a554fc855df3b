"""Sources named by an address and ``--set`` options."""

from __future__ import annotations

from collections.abc import Iterable

from regkit.config.document import Document
from regkit.interfaces import Source


def source_at(address: str, settings: Iterable[str]) -> Source:
    """Returns the source of an address, with fields of ``--set field=value``.

    Raises:
        RegkitError: If there is no such source, or a field is invalid.
    """
    fields = Document({}, {}).overridden(settings, called="--set")
    data = {**Source.described(address, fields.data.get("kind")), **fields.data}
    places = {("source", *location): place for location, place in fields.places.items()}
    return Source.of(Document({"source": data}, {(): address, **places}), "source")
