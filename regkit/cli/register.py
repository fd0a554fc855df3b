"""``regkit register``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from regkit.api import fit_shape, load_frame
from regkit.api import register as register_frame
from regkit.cli.choices import Choices
from regkit.cli.options import (
    MethodName,
    Out,
    PluginFiles,
    PreprocessorName,
    Segmentation,
    Settings,
    Strict,
    TemplateName,
    run_plugin_files,
)
from regkit.cli.out_folder import check_out
from regkit.cli.outcome import finish
from regkit.clouds.mesh_writing import check_mesh_writable
from regkit.interfaces import Template
from regkit.observation import Frame
from regkit.system.errors import ConfigError, DataError


def register(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Cloud or mesh, 16-bit PNG depth image with its camera.json, or folder of a "
            "recording.",
            show_default=False,
        ),
    ],
    target: Annotated[Path | None, typer.Argument(hidden=True)] = None,
    template: TemplateName = None,
    method: MethodName = None,
    segmentation: Segmentation = None,
    preprocessor: PreprocessorName = None,
    frame: Annotated[
        int, typer.Option(min=0, metavar="N", help="Frame of a recording's folder, from 0.")
    ] = 0,
    depth_scale: Annotated[
        float,
        typer.Option(help="Units per metre of a depth image outside a recording."),
    ] = 1000.0,
    shape: Annotated[
        bool | None,
        typer.Option(
            "--shape/--no-shape",
            help="Fit the template's shape modes too. (default: for a cloud or mesh without a "
            "camera, if the template has modes)",
            show_default=False,
        ),
    ] = None,
    mesh: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Write the shaped and posed mesh, with the template's vertices: .ply, .obj, .glb "
            "or .stl.",
            show_default=False,
        ),
    ] = None,
    settings: Settings = None,
    out: Out = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
    strict: Strict = False,
    plugin: PluginFiles = None,
) -> None:
    """Register a template to one frame: size or shape, pose, and quality of the fit."""
    if target is not None:
        raise ConfigError(
            "'register SOURCE TARGET' is now called 'align SOURCE TARGET'; 'register FILE' "
            "registers a template to one frame",
            place=f"register {file} {target}",
        )
    if not file.exists():
        raise DataError(
            "there is no such file or folder; name a cloud or mesh, a depth image, or a "
            "recording's folder",
            place=str(file),
        )
    run_plugin_files(plugin)
    if out is not None:
        check_out(out, whole=False)
    if mesh is not None:
        if shape is False:
            raise ConfigError(
                "the mesh is that of the shape, and --no-shape is given", place="--mesh"
            )
        check_mesh_writable(mesh, place=f"--mesh {mesh}")
    named = {"template": template, "method": method, "preprocessor": preprocessor}
    choices, name = Choices.of({**named, "segmentation": segmentation}, settings or ())
    seen = load_frame(file, index=frame, depth_scale=depth_scale)
    if shape is None:
        shape = mesh is not None or (_is_scan(seen) and _has_modes(choices.template))
    if not shape:
        found = register_frame(
            seen,
            choices.template,
            choices.method,
            segmentation=choices.segmentation,
            preprocessor=choices.preprocessor,
            start=choices.start,
        )
        tracking = replace(found.tracking, name=file.stem, method=name)
        finish(tracking, choices.template, out, as_json=as_json, strict=strict)
        return
    shaped = fit_shape(
        seen,
        choices.template,
        choices.method,
        segmentation=choices.segmentation,
        preprocessor=choices.preprocessor,
        start=choices.start,
    )
    tracking = replace(shaped.registration.tracking, name=file.stem, method=name)
    if mesh is not None:
        shaped.save_mesh(mesh)
    if out is not None:
        out.mkdir(parents=True, exist_ok=True)
        shaped.save_mesh(out / "shape.ply")
        shaped.save_template(out / "shape.yaml")
    finish(
        tracking,
        choices.template,
        out,
        as_json=as_json,
        strict=strict,
        more={"shape": shaped.figures()},
        rows=shaped.shape_rows(),
    )


def _is_scan(frame: Frame) -> bool:
    """Returns whether a frame is a cloud that no known camera saw."""
    return frame.camera is None and not frame.views


def _has_modes(template: Template) -> bool:
    return template.description().modes is not None
