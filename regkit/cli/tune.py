"""``regkit tune``."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from regkit.api.tuning import Tuned, tuned_as
from regkit.api.tuning_choices import TuningChoices, method_name
from regkit.body.template_file import check_replaceable
from regkit.cli.choices import parsed
from regkit.cli.completion import plugin_names
from regkit.cli.console import errors, output
from regkit.cli.options import MethodName, PluginFiles, PreprocessorName, options, run_plugin_files
from regkit.config.changes import Location
from regkit.interfaces import Method
from regkit.tuning.descent import Step
from regkit.tuning.trials import Comparison

MOST_JOBS = 4
"""Number of processes, unless there are fewer processors; each needs some memory."""


def tune(
    template: Annotated[
        str,
        typer.Argument(
            metavar="TEMPLATE",
            autocompletion=plugin_names("template"),
            help="Template to tune: a name such as human or hand, a template's YAML file, or a "
            "mapping such as '{kind: hand, side: left}'.",
            show_default=False,
        ),
    ],
    method: MethodName = None,
    name: Annotated[
        str | None,
        typer.Option(
            metavar="NAME",
            help="Name of the tuned list of primitives, which a method takes as 'shape: {kind: "
            "KIND, tuned: NAME}'. (default: the list that the method takes is replaced)",
            show_default=False,
        ),
    ] = None,
    body: Annotated[
        list[str] | None,
        typer.Option(
            metavar="TEMPLATE",
            autocompletion=plugin_names("template"),
            help="Another template with the same joints that the camera sees too. Repeatable.",
        ),
    ] = None,
    proportions: Annotated[
        float,
        typer.Option(
            min=0.0,
            max=30.0,
            metavar="PERCENT",
            help="Spread of the lengths and girths of further bodies that the camera sees.",
        ),
    ] = 0.0,
    camera: Annotated[
        str,
        typer.Option(
            metavar="CAMERA",
            help="Depth camera: sr4000, kinect_v1, kinect_v1_320x240, realsense_d435, sr305, a "
            "camera.json, or a mapping such as '{width: 320, height: 240, fx: 290}'.",
        ),
    ] = "sr4000",
    noise: Annotated[
        str | None,
        typer.Option(
            metavar="NOISE",
            help="Depth noise: that of a known camera by its name, none, a standard deviation in "
            "metres, or a mapping with its parts. (default: that of a known camera, none of any "
            "other)",
            show_default=False,
        ),
    ] = None,
    preprocessor: PreprocessorName = None,
    primitives: Annotated[
        int | None,
        typer.Option(
            min=1,
            metavar="N",
            help="Number of primitives to begin with, which fill the body. (default: those that "
            "the template lists, or one for each of its capsules)",
            show_default=False,
        ),
    ] = None,
    samples: Annotated[
        int, typer.Option(min=1, metavar="N", help="Number of training samples.")
    ] = 240,
    seed: Annotated[int, typer.Option(min=0, metavar="N", help="Seed of all samples.")] = 0,
    jobs: Annotated[
        int | None,
        typer.Option(
            min=1,
            metavar="N",
            help="Number of processes. (default: one for each processor, at most 4)",
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path, typer.Option(metavar="FILE", help="Template to write; an existing one is replaced.")
    ] = Path("tuned.yaml"),
    plugin: PluginFiles = None,
) -> None:
    """Fit a template's shape to a method, on rendered frames, so that it tracks with less error."""
    run_plugin_files(plugin)
    check_replaceable(out)
    given = {
        "template": parsed(template, "TEMPLATE"),
        "method": None if method is None else parsed(method, "--method"),
        "name": name,
        "bodies": [parsed(one, "--body") for one in body or ()],
        "proportions": proportions / 100.0,
        "camera": parsed(camera, "--camera"),
        "noise": None if noise is None else _number(parsed(noise, "--noise")),
        "preprocessor": None if preprocessor is None else parsed(preprocessor, "--preprocessor"),
        "primitives": primitives,
        "samples": samples,
        "seed": seed,
    }
    places: dict[Location, str] = {
        (): "regkit tune",
        ("template",): f"TEMPLATE {template}",
        ("method",): f"--method {method}",
        ("name",): f"--name {name}",
        ("camera",): f"--camera {camera}",
        ("noise",): f"--noise {noise}",
        ("preprocessor",): f"--preprocessor {preprocessor}",
        ("primitives",): f"--primitives {primitives}",
        **{("bodies", at): f"--body {one}" for at, one in enumerate(body or ())},
    }
    with options(camera="--camera", bodies="--body"):
        chosen = TuningChoices.of(given, places)
        called = method_name(given["method"] or Method.default())
        found = tuned_as(chosen, called, jobs or min(os.cpu_count() or 1, MOST_JOBS), _Steps())
    if found.failures:
        count, reason = len(found.failures), escape(found.failures[-1])
        errors.print(f"{count} samples could not be rendered, others took their place: {reason}")
    output.print(_table(found.comparisons))
    found.check()
    found.write(out)
    _print_use(found, out)


class _Steps:
    """Prints the steps as they are taken."""

    def __init__(self) -> None:
        self._count = 0

    def __call__(self, step: Step) -> None:
        """Prints the costs of a step."""
        what = f"step {self._count}" if self._count else "before"
        errors.print(f"{what}: cost {step.training:.3f}, held out {step.held_out:.3f}")
        self._count += 1


def _number(value: Any) -> Any:
    """Returns a text as a number, if it is one."""
    try:
        return float(value)
    except (TypeError, ValueError):
        return value


def _table(comparisons: Iterable[Comparison]) -> Table:
    """Returns a table of the trials, which fits into 80 columns."""
    table = Table("trial", title="errors before and after tuning", title_justify="left")
    for column in ("frames", "mean \\[cm]", "median", "lost \\[%]", "change \\[cm]"):
        table.add_column(column, justify="right", no_wrap=True)
    for one in comparisons:
        both = (one.before, one.after)
        table.add_row(
            escape(one.name),
            str(one.samples * one.frames),
            " ".join(f"{100.0 * each.mean:.2f}" for each in both),
            " ".join(f"{100.0 * each.median:.2f}" for each in both),
            " ".join(f"{100.0 * each.lost:.1f}" for each in both),
            f"{100.0 * one.change:+.2f} +- {100.0 * one.doubt:.2f}",
        )
    return table


def _print_use(found: Tuned, out: Path) -> None:
    """Prints what was written, and how to use it."""
    output.print(f"written: {out}")
    output.print(f"template: {{kind: file, path: {out}}}")
    if "/" in found.key:
        output.print(f"shape: {found.shape}")
