"""``regkit fit``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Table

from regkit.body import BodyDescription
from regkit.body.template_file import check_replaceable, write_template
from regkit.cli.choices import template_named
from regkit.cli.completion import plugin_names
from regkit.cli.console import output
from regkit.cli.options import PluginFiles, default_of, options, run_plugin_files
from regkit.fitting.bones import read_bone_map
from regkit.fitting.template import FittedTemplate, parameters_of
from regkit.interchange.body_model.smpl import MODES
from regkit.interchange.meshes import read_shaped_mesh
from regkit.system.errors import RegkitError
from regkit.system.progress import working

OPENING = """\
Made by `regkit fit` from the mesh {mesh}. To use it:
template: {{kind: file, path: {file}}}

Lengths are in metres and angles in degrees."""


def fit(
    mesh: Annotated[
        Path,
        typer.Argument(
            metavar="MESH",
            help="Skinned mesh in metres: a rigged .glb or .gltf file, an .npz file, or a body "
            "model in the layout of SMPL (.npz, .pkl).",
            show_default=False,
        ),
    ],
    template: Annotated[
        str | None,
        typer.Option(
            metavar="TEMPLATE",
            autocompletion=plugin_names("template"),
            help="Template that provides the joints: a name such as hand, a YAML file, or a "
            f"mapping such as '{{kind: hand, side: left}}'. (default: {default_of('templates')})",
            show_default=False,
        ),
    ] = None,
    bones: Annotated[
        Path | None,
        typer.Option(
            "--map",
            metavar="FILE",
            help="YAML file that maps each bone to a segment, or to null for its parent's segment. "
            "(default: bones map to segments of the same name)",
            show_default=False,
        ),
    ] = None,
    parents: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="YAML file that maps each bone to its parent, and the root to null; for a glTF "
            "file whose bones form no tree.",
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path, typer.Option(metavar="FILE", help="Template to write; an existing one is replaced.")
    ] = Path("fitted.yaml"),
    vertices: Annotated[
        int, typer.Option(min=50, metavar="N", help="Number of mesh vertices to keep.")
    ] = 1500,
    shape: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KIND",
            help="Also fit this shape model, with one primitive per segment, if the template lists "
            "none of its kind.",
        ),
    ] = None,
    modes: Annotated[
        int, typer.Option(min=0, metavar="N", help="Number of a body model's shape modes to take.")
    ] = MODES,
    plugin: PluginFiles = None,
) -> None:
    """Create a template with the shape of a skinned mesh."""
    run_plugin_files(plugin)
    check_replaceable(out)
    for kind in shape or ():
        try:
            parameters_of(kind)
        except RegkitError as error:
            raise error.at(f"--shape {kind}") from None
    description = template_named(template).description()
    with options(parents="--parents"):
        skinned, shaped = read_shaped_mesh(mesh, parents, modes)
    mapped = {} if bones is None else read_bone_map(bones)
    try:
        with working("fitting the mesh"):
            fitted = FittedTemplate.to(
                skinned, description, mapped, vertices, shape or (), modes=shaped
            )
    except RegkitError as error:
        raise error.at(str(mesh)) from None
    named = _named(fitted.description, mesh.name)
    opening = OPENING.format(mesh=mesh.name, file=out.name)
    write_template(out, named, fitted.skin, opening, modes=fitted.modes)
    _print_summary(fitted)
    output.print(f"written: {out}")
    output.print(f"template: {{kind: file, path: {out}}}")


def _named(description: BodyDescription, mesh: str) -> BodyDescription:
    """Returns the description with a title and source that name the mesh."""
    source = f"Lengths, surface, shapes: fitted to the mesh {mesh}"
    title = f"{description.title}; in the shape of {mesh}"
    return description.model_copy(
        update={"title": title, "sources": (*description.sources, source)}
    )


def _print_summary(fitted: FittedTemplate) -> None:
    """Prints a summary of the fit."""
    description = fitted.description
    keys = list(description.shapes)
    table = Table("segment", "bones")
    for key in keys:
        table.add_column(escape(key), justify="right")
    for name in description.segments:
        own = [label for label, owner in fitted.owners.items() if owner == name]
        counts = [str(len(description.shapes[key].get(name, ()))) for key in keys]
        table.add_row(escape(name), escape(", ".join(own)), *counts)
    output.print(table)
    output.print(
        f"{description.size.name} {description.size.value:.4g} m; "
        f"{len(fitted.skin.vertices)} vertices"
        + ("" if fitted.modes is None else f"; {len(fitted.modes.names)} shape modes"),
    )
