"""Generated parts of pages.

They replace one of these blocks:

    ```{plugins} regkit.kernels    ```{fields} regkit.body:BodyDescription    ```{commands}
    ```                            ```                                        ```

The replacement happens before the page is parsed, so that the text can contain headings.
"""

from __future__ import annotations

import re

from command_pages import commands_text
from field_tables import fields_text
from plugin_pages import plugins_text
from sphinx.application import Sphinx

_PLUGINS = re.compile(r"^```\{plugins\} (\S+)\n```$", flags=re.MULTILINE)
_FIELDS = re.compile(r"^```\{fields\} (\S+)\n```$", flags=re.MULTILINE)
_COMMANDS = re.compile(r"^```\{commands\}\n```$", flags=re.MULTILINE)


def _filled(app: Sphinx, docname: str, source: list[str]) -> None:
    text = _PLUGINS.sub(lambda found: plugins_text(found[1]), source[0])
    text = _FIELDS.sub(lambda found: fields_text(found[1]), text)
    source[0] = _COMMANDS.sub(lambda _: commands_text(), text)


def setup(app: Sphinx) -> dict[str, bool]:
    """Connects the replacement of blocks to the reading of pages."""
    app.connect("source-read", _filled)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
