"""Make the tutorial's notebook again, from its page, and run it: ``make notebook``.

It holds no times and no paths, so that it changes only with the page and with results.
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import nbformat
from nbclient import NotebookClient
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

from notebook_cells import Cell, cells

from regkit.system.files import write_text

PAGE = Path(__file__).parent / "tutorials" / "notebook.md"
TIMEOUT = 900
"""Time that a cell has [s]; the first one that registers something compiles the loops."""


def notebook_of(page: Path) -> NotebookNode:
    """Returns the notebook of a page, not run."""
    made = [_node(number, cell) for number, cell in enumerate(cells(page))]
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return new_notebook(
        cells=made, metadata={"kernelspec": kernel, "language_info": {"name": "python"}}
    )


def run(notebook: NotebookNode) -> None:
    """Runs a notebook in an empty folder, and keeps what its cells show.

    Raises:
        nbclient.exceptions.CellExecutionError: If a cell fails.
    """
    metadata = notebook.metadata.copy()
    with TemporaryDirectory() as folder:
        client = NotebookClient(
            notebook,
            timeout=TIMEOUT,
            record_timing=False,
            # How a text is split into messages depends on when it is printed.
            coalesce_streams=True,
            resources={"metadata": {"path": folder}},
        )
        client.execute()
    # The kernel's version is no part of the page.
    notebook.metadata = metadata
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs = [one for one in cell.outputs if not _is_empty(one)]


def _node(number: int, cell: Cell) -> NotebookNode:
    options = {"id": f"cell-{number}"}
    if cell.kind == "code":
        return new_code_cell(cell.source, **options)
    if cell.pictures:
        attachments = {name: {"image/png": content} for name, content in cell.pictures.items()}
        return new_markdown_cell(cell.source, attachments=attachments, **options)
    return new_markdown_cell(cell.source, **options)


def _is_empty(output: NotebookNode) -> bool:
    """Whether it is where a bar was that is no longer shown."""
    return output.output_type == "display_data" and not output.data.get("text/html", "shown")


if __name__ == "__main__":
    notebook = notebook_of(PAGE)
    run(notebook)
    write_text(PAGE.with_suffix(".ipynb"), nbformat.writes(notebook) + "\n")
    print("docs/tutorials/notebook.ipynb")
