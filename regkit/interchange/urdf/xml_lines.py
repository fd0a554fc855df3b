"""XML elements with their line numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError


@dataclass(frozen=True)
class Element:
    """An element of an XML file.

    Attributes:
        tag: Name of the tag.
        attributes: Attributes of the tag.
        place: ``file:line``.
        children: Child elements.
    """

    tag: str
    attributes: Mapping[str, str]
    place: str
    children: list[Element] = field(default_factory=list)

    @classmethod
    def read(cls, path: Path) -> Element:
        """Returns the root element of a file; trailing null bytes are ignored.

        Raises:
            DataError: If the file is missing, unreadable or not XML.
        """
        try:
            content = path.read_bytes()
        except FileNotFoundError:
            raise DataError("the file is missing", place=str(path)) from None
        except OSError as error:
            raise DataError(f"cannot be read: {error.strerror}", place=str(path)) from None
        outermost = cls("", {}, str(path))
        around = [outermost]
        parser = expat.ParserCreate()

        def start(tag: str, attributes: dict[str, str]) -> None:
            element = cls(tag, attributes, f"{path}:{parser.CurrentLineNumber}")
            around[-1].children.append(element)
            around.append(element)

        def end(tag: str) -> None:
            around.pop()

        parser.StartElementHandler = start
        parser.EndElementHandler = end
        try:
            parser.Parse(content.rstrip(b"\0 \t\r\n"), True)
        except expat.ExpatError as error:
            reason = expat.ErrorString(error.code)
            raise DataError(f"not XML: {reason}", place=f"{path}:{error.lineno}") from None
        return outermost.children[0]

    def all(self, tag: str) -> Iterator[Element]:
        """Returns the children with a tag."""
        return (child for child in self.children if child.tag == tag)

    def find(self, tag: str) -> Element | None:
        """Returns the first child with a tag, or None."""
        return next(self.all(tag), None)

    def need(self, tag: str) -> Element:
        """Returns the first child with a tag.

        Raises:
            DataError: If there is none.
        """
        found = self.find(tag)
        if found is None:
            raise self.wrong(f"<{self.tag}> needs a <{tag}>")
        return found

    def text(self, attribute: str) -> str:
        """Returns the text of an attribute.

        Raises:
            DataError: If the attribute is missing.
        """
        if attribute not in self.attributes:
            raise self.wrong(f"<{self.tag}> needs the attribute {attribute}")
        return self.attributes[attribute].strip()

    def number(self, attribute: str, default: float | None = None) -> float:
        """Returns the number in an attribute.

        Raises:
            DataError: If it is not a number, or is missing without a default.
        """
        given = None if default is None else np.array([default])
        return float(self.numbers(attribute, 1, given)[0])

    def numbers(self, attribute: str, count: int, default: Array | None = None) -> Array:
        """Returns the numbers (count,) in an attribute.

        Raises:
            DataError: If they are not ``count`` finite numbers, or missing without a default.
        """
        if attribute not in self.attributes and default is not None:
            return default
        words = self.text(attribute).split()
        try:
            values = np.array([float(word) for word in words])
        except ValueError:
            values = np.full(1, np.nan)
        if len(values) != count or not np.isfinite(values).all():
            wanted = "a number" if count == 1 else f"{count} numbers"
            raise self.wrong(f'{attribute}="{" ".join(words)}" of <{self.tag}> must be {wanted}')
        return values

    def wrong(self, message: str) -> DataError:
        """Returns an error at this element."""
        return DataError(message, place=self.place)
