"""XML elements with their line numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

import numpy as np

from regkit.interchange.urdf.xml_text import xml_text
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.notes import note
from regkit.system.plain_numbers import real
from regkit.system.printable import plain_name

XACRO = "write the file out with `xacro FILE > robot.urdf`, and import that"
"""What to do with a file that is not processed yet."""

HUGE = 1e30
"""Larger numbers are no lengths or angles, and their products overflow."""

_JUNK = expat.errors.codes[expat.errors.XML_ERROR_JUNK_AFTER_DOC_ELEMENT]


@dataclass(frozen=True)
class Element:
    """An element of an XML file.

    Attributes:
        tag: Name of the tag.
        attributes: Attributes of the tag, without control characters.
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
            DataError: If the file is not XML, or declares entities.
            OSError: If it is missing or unreadable.
        """
        text = xml_text(path.read_bytes(), path)
        outermost = cls("", {}, str(path))
        around = [outermost]
        parser = expat.ParserCreate()

        def start(tag: str, attributes: dict[str, str]) -> None:
            plain = {name: plain_name(value) for name, value in attributes.items()}
            element = cls(tag, plain, f"{path}:{parser.CurrentLineNumber}")
            around[-1].children.append(element)
            around.append(element)

        def end(tag: str) -> None:
            around.pop()

        def declared(name: str, *_: object) -> None:
            # A few nested entities expand to gigabytes.
            raise DataError(
                f"declares the entity '{name}', which is not expanded; write its text instead",
                place=f"{path}:{parser.CurrentLineNumber}",
            )

        parser.StartElementHandler = start
        parser.EndElementHandler = end
        parser.EntityDeclHandler = declared
        try:
            parser.Parse(text, True)
        except expat.ExpatError as error:
            place = f"{path}:{error.lineno}"
            if error.code == _JUNK and outermost.children:
                note("what follows the document is passed over", place=place)
            else:
                reason = expat.ErrorString(error.code)
                raise DataError(f"not XML: {reason}", place=place) from None
        return outermost.children[0]

    def everything(self) -> Iterator[Element]:
        """Yields the element and all elements within it."""
        ahead = [self]
        while ahead:
            element = ahead.pop()
            yield element
            ahead += element.children

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
        words = _words(self.text(attribute), count)
        if any("$" in word for word in words):
            raise self.wrong(
                f'{attribute}="{self.text(attribute)}" of <{self.tag}> is an expression of xacro; '
                + XACRO
            )
        try:
            values = np.array([real(word) for word in words])
        except ValueError:
            values = np.full(1, np.nan)
        if len(values) > count > 1 and np.isfinite(values).all():
            given = " ".join(words)
            note(
                f'{attribute}="{given}" of <{self.tag}> has {len(values)} numbers; the first '
                f"{count} are used",
                place=self.place,
            )
            values = values[:count]
        if len(values) != count or not (np.abs(values) < HUGE).all():
            wanted = "a number" if count == 1 else f"{count} numbers"
            raise self.wrong(f'{attribute}="{" ".join(words)}" of <{self.tag}> must be {wanted}')
        return values

    def wrong(self, message: str) -> DataError:
        """Returns an error at this element."""
        return DataError(message, place=self.place)


def _words(text: str, count: int) -> list[str]:
    """Returns the numbers in a text as words with a decimal point.

    Numbers are separated by whitespace, or by commas. If whitespace alone separates as many as
    are needed, a comma within a word is a decimal sign.
    """
    words = [word.strip(",") for word in text.split()]
    words = [word for word in words if word]
    if len(words) == count and all(word.count(",") <= 1 for word in words):
        return [word.replace(",", ".") for word in words]
    return text.replace(",", " ").split()
