"""What a report says, and that it needs no more than the files of a run."""

import csv
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from made_results import FRAMES, METHODS, form, links, made_run, record

from regkit.metrics import JointErrors
from regkit.report import Record, write_report, write_summary
from regkit.report.brief import brief, flow
from regkit.report.figures import plots
from regkit.report.figures.density import projected
from regkit.report.labels import wrapped
from regkit.report.outlines import outlines
from regkit.report.overlay import overlay
from regkit.report.plot import DARK, LIGHT
from regkit.report.style import PALETTE, styles
from regkit.report.tables import main_table, p_text


def cells(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def test_every_figure_is_a_picture_with_its_numbers_beside_it(folder):
    names = {path.stem for path in (folder / "figures").glob("*.png")}
    assert names == {"methods", "shapes", "recordings", "thresholds", "joints", "over_time",
                     "densities", "timing"}  # fmt: skip
    for name in names:
        assert (folder / "figures" / f"{name}.png").read_bytes().startswith(b"\x89PNG")
        rows = cells(folder / "figures" / f"{name}.csv")
        assert rows
        assert not {"nan", "inf", "None"} & {value for row in rows for value in row.values()}
    assert not [path for path in links(folder) if Path(path).name.startswith(".")]


def test_numbers_of_the_bars_are_those_of_the_metrics(folder):
    metrics = json.loads((folder / "metrics.json").read_text())["methods"]
    for row in cells(folder / "figures" / "recordings.csv"):
        for method in METHODS:
            expected = metrics[method]["recordings"][row["recording"]]["joint_error_raw_cm"]
            assert float(row[f"{method} [cm]"]) == pytest.approx(expected, rel=1e-5)


def test_metrics_say_what_recordings_say_together(folder):
    methods = json.loads((folder / "metrics.json").read_text())["methods"]
    for figures in methods.values():
        values = [one["joint_error_raw_cm"] for one in figures["recordings"].values()
                  if "error" not in one]  # fmt: skip
        assert figures["mean"]["joint_error_raw_cm"] == pytest.approx(np.mean(values))
        assert figures["median"]["joint_error_raw_cm"] == pytest.approx(np.median(values))
        low, high = figures["interval"]["joint_error_raw_cm"]
        assert low < np.mean(values) < high
        assert figures["interval"]["pck_percent"] is None
        joints = [one["raw_cm"] for one in figures["joints"].values()]
        assert np.mean(joints) == pytest.approx(np.mean(values))
    assert methods["icp"]["recordings"]["lost_take"]["error"].startswith("a |")


def test_tables_hold_all_recordings_and_pairs(folder):
    rows = cells(folder / "tables" / "recordings.csv")
    assert len(rows) == 3 * 7 + 1
    (failed,) = [row for row in rows if row["error"]]
    assert failed["joint_error_raw_cm"] == ""
    pairs = cells(folder / "tables" / "pairs.csv")
    of_raw = [row for row in pairs if row["metric"] == "joint_error_raw_cm"]
    assert [(row["method"], row["other"]) for row in of_raw] == [
        ("sog", "gsog"), ("sog", "icp")
    ]  # fmt: skip
    assert all(float(row["p (Wilcoxon)"]) == pytest.approx(2.0 / 2**7) for row in of_raw)


def test_markdown_shows_what_the_page_shows(folder):
    text = (folder / "report.md").read_text()
    for target in re.findall(r"\]\(([^)]+)\)", text):
        assert (folder / target).is_file(), target
    assert r"a \| in \<b>the\</b> reason" in text
    assert "| sog | 7 | **3." in text
    page = (folder / "report.html").read_text()
    for heading in re.findall(r"^### (.+)$", text, re.MULTILINE):
        assert f"<h3>{heading}</h3>" in page


def test_page_has_nothing_that_is_not_in_it(folder):
    page = (folder / "report.html").read_text()
    sources = re.findall(r"""(?:src|srcset|poster|data)=["']([^"']+)""", page)
    assert sources
    assert all(source.startswith("data:image/png;base64,") for source in sources)
    assert set(re.findall(r"<link[^>]*href=[\"']([^\"']*)", page)) == {"data:,"}
    assert "@import" not in page
    assert not re.search(r"url\(\s*[\"']?(?!data:)", page)
    assert not re.search(r"https?://", page)


def test_every_picture_has_words(folder):
    images = re.findall(r"<img[^>]*>", (folder / "report.html").read_text())
    assert len(images) == 8 + 12
    for image in images:
        assert len(re.search(r'alt="([^"]*)"', image).group(1)) > 30


def test_overlays_of_the_worst_recordings_are_shown_and_the_others_linked(folder):
    page = (folder / "report.html").read_text()
    shown = re.findall(r"<figcaption>(\w+) on (\w+)</figcaption>", page)
    assert sorted(shown) == sorted(
        (method, f"take{index}") for method in METHODS for index in (3, 4, 5, 6)
    )
    others = re.findall(r'<a href="(\w+/\w+/overlay.png)"', page)
    assert len(others) == 21 - 12
    assert all((folder / link).is_file() for link in others)


def test_names_are_taken_for_what_they_are_and_not_for_markup(tmp_path):
    evil = '<img src=x onerror="alert(1)">'
    run = made_run(1, methods={evil: METHODS["sog"], "b|c": METHODS["icp"]}, prefix="a&b")
    for records in run.records.values():
        for one in records:
            assert one == "a&b0"
    write_report(run, tmp_path, figures=False)
    page = (tmp_path / "report.html").read_text()
    assert evil not in page
    assert "&lt;img src=x onerror=&#34;alert(1)&#34;&gt;" in page
    assert "a&amp;b0" in page
    assert r"b\|c" in (tmp_path / "report.md").read_text()


@pytest.mark.long
def test_report_without_references_is_of_the_surface(tmp_path):
    write_report(made_run(2, compared=False), tmp_path)
    names = {path.stem for path in (tmp_path / "figures").glob("*.png")}
    assert names == {"methods", "shapes", "recordings", "over_time", "densities", "timing"}
    page = (tmp_path / "report.html").read_text()
    assert "median distance of the data to the surface" in page
    assert "raw [cm]" not in page


def test_references_without_a_joint_are_none():
    """Of fewer frames than there are, and nowhere known: the report is of the surface."""
    run = made_run(2)
    errors = JointErrors(("head",), np.full((4, 1), np.nan), np.full((4, 1), np.nan))
    unknown = {"joint_error_raw_cm": None, "joint_error_adjusted_cm": None}
    run = replace(
        run,
        records={m: {s: replace(one, errors=errors) for s, one in by.items()}
                 for m, by in run.records.items()},
        measures={m: {s: replace(one, **unknown) for s, one in by.items()}
                  for m, by in run.measures.items()},
    )  # fmt: skip
    (over_time,) = (plot for plot in plots(run) if plot.name == "over_time")
    assert len(over_time.rows) == 2 * len(METHODS) * FRAMES
    assert {row[over_time.columns.index("lost")] for row in over_time.rows} == {0}
    for plot in plots(run):
        plot.draw(LIGHT)


def test_long_names_leave_room_for_what_is_drawn():
    names = ["voxel=0.02,sigma=0.01," * 4 + end for end in ("/sog", "/gsog")]
    methods = dict.fromkeys(names, METHODS["sog"])
    for plot in plots(made_run(3, methods=methods, prefix="costs $5, and ${ " + "very " * 20)):
        plot.png(LIGHT)  # Matplotlib warns where axes have no room.


def test_report_of_nothing_but_failures_says_so(tmp_path):
    run = made_run(0, failures={"sog": {"first": "it is dark"}, "icp": {"first": "it is dark"}})
    write_report(run, tmp_path)
    assert (
        "2 of 2 tracks (a method on a recording) failed" in (tmp_path / "report.html").read_text()
    )
    assert "- **sog** on first: it is dark" in (tmp_path / "report.md").read_text()


def test_summary_draws_nothing(tmp_path):
    write_summary(made_run(2), tmp_path)
    assert links(tmp_path) == ["metrics.json", "report.md"]


@pytest.mark.long
def test_large_run_stays_a_page_that_can_be_read(tmp_path):
    """Of 28 recordings and five methods."""
    methods = METHODS | {"a": METHODS["sog"], "b": METHODS["icp"]}
    run = made_run(28, methods=methods)
    for method, records in run.records.items():
        for recording in records:
            overlay = tmp_path / method / recording / "overlay.png"
            overlay.parent.mkdir(parents=True)
            overlay.write_bytes(b"\x89PNG" + bytes(250_000))
    write_report(run, tmp_path)
    page = tmp_path / "report.html"
    assert page.stat().st_size < 8e6
    assert page.read_text().count('class="card"') == 10


@pytest.mark.long
def test_figures_of_very_many_can_be_read_and_their_numbers_are_all_there():
    """Of forty methods on seventy recordings: a picture has the best ones and the worst ones."""
    methods = {f"m{index}": METHODS["sog"] for index in range(40)}
    run = made_run(70, methods=methods)
    by_name = {plot.name: plot for plot in plots(run)}
    for name in ("thresholds", "over_time", "joints", "recordings"):
        assert "Of 40 methods the 12 best are drawn." in by_name[name].caption
        assert by_name[name].draw(LIGHT).get_figheight() < 90.0
    curves = by_name["thresholds"].draw(LIGHT).axes[0].get_legend_handles_labels()[1]
    assert curves == [f"m{index}" for index in range(12)]
    axes = by_name["recordings"].draw(LIGHT).axes[0]
    largest = {s: max(run.value(method, s) for method in curves) for s in run.recordings}
    least = sorted(largest.values())[-60]
    assert [label.get_text() for label in axes.get_yticklabels()] == [
        recording for recording in run.recordings if largest[recording] >= least
    ]
    assert len(by_name["recordings"].rows) == 70
    assert len(by_name["thresholds"].columns) == 1 + 2 * 40


def test_page_of_very_many_methods_has_few_pictures(tmp_path):
    run = made_run(2, methods={f"m{index}": METHODS["sog"] for index in range(20)})
    for method, records in run.records.items():
        for recording in records:
            overlay = tmp_path / method / recording / "overlay.png"
            overlay.parent.mkdir(parents=True)
            overlay.write_bytes(b"\x89PNG")
    write_report(run, tmp_path, figures=False)
    page = (tmp_path / "report.html").read_text()
    assert page.count('class="card"') == 12
    assert "28 other pictures" in page


def test_brackets_in_a_name_do_not_end_a_link(tmp_path):
    run = made_run(1, prefix="walk [2] ")
    overlay = tmp_path / "sog" / "walk [2] 0" / "overlay.png"
    overlay.parent.mkdir(parents=True)
    overlay.write_bytes(b"\x89PNG")
    write_summary(run, tmp_path)
    assert r"![sog on walk \[2\] 0](sog/walk" in (tmp_path / "report.md").read_text()


@pytest.mark.parametrize("compared", [True, False])
@pytest.mark.parametrize("kind", ["gaussians", "capsules", "solids", "points"])
def test_record_is_read_as_it_was_written(random, kind, compared, tmp_path):
    made = record(random, 0.03, kind=kind, compared=compared)
    np.savez_compressed(tmp_path / "record.npz", **made.arrays())
    with np.load(tmp_path / "record.npz", allow_pickle=False) as arrays:
        read = Record.from_arrays(dict(arrays))
    assert read.fps == made.fps
    assert (read.errors is None) == (made.errors is None)
    if made.errors is not None:
        np.testing.assert_array_equal(read.errors.raw, made.errors.raw)
        assert read.errors.joints == made.errors.joints
    assert len(read.drawings) == len(made.drawings)
    for one, other in zip(read.drawings, made.drawings, strict=True):
        assert (one.frame, one.why, one.primitives.kind) == (other.frame, other.why, kind)
        np.testing.assert_allclose(one.points, other.points, rtol=1e-6)
        np.testing.assert_allclose(one.primitives.centres, other.primitives.centres, rtol=1e-6)
        np.testing.assert_allclose(one.primitives.radii, other.primitives.radii, rtol=1e-6)
        assert one.reference.shape == other.reference.shape


def test_projected_density_is_the_integral_along_the_line_of_sight(random):
    """Against a sum over many planes."""
    made = form("gaussians", random)
    across, down = np.linspace(-0.4, 0.4, 5), np.linspace(-0.3, 0.3, 4)
    depths = np.linspace(-3.0, 3.0, 4001)
    grid = np.stack(np.meshgrid(across, down, depths), axis=-1)
    total = np.zeros(grid.shape[:3])
    for weight, centre, covariance in zip(
        made.weights, made.centres, made.covariances(), strict=True
    ):
        away = grid - centre
        total += weight * np.exp(
            -0.5 * np.einsum("...i,ij,...j->...", away, np.linalg.inv(covariance), away)
        )
    expected = np.trapezoid(total, depths, axis=2)
    np.testing.assert_allclose(projected(made, across, down), expected, rtol=1e-6, atol=1e-12)


def test_outline_of_a_capsule_is_as_far_from_its_axis_as_its_radius(random):
    made = form("capsules", random)
    for line, centre in zip(outlines(made, (0, 1)), made.centres, strict=True):
        beside = np.abs(line[0] - centre[0]).max()
        along = np.abs(line[1] - centre[1]).max()
        assert (beside, along) == pytest.approx((0.05, 0.1 + 0.05), rel=1e-3)


def test_outline_of_a_solid_is_the_hull_of_its_surface(random):
    made = form("solids", random)
    lines = list(outlines(made, (2, 1)))
    assert len(lines) == len(made.centres)
    for line, centre in zip(lines, made.centres, strict=True):
        reached = np.abs(line - centre[[2, 1], None]).max(axis=1)
        np.testing.assert_allclose(reached, 0.07, rtol=0.01)


def test_colours_tell_shape_models_and_shades_their_methods():
    found = styles({"a": "sog", "b": "gsog", "c": "gsog", "d": "mesh"})
    assert found["a"].colour.upper() == PALETTE[0]
    assert found["b"].colour.upper() == PALETTE[1]
    assert len({style.colour for style in found.values()}) == 4
    assert found["c"].hatch != found["b"].hatch
    assert found["c"].dash != found["b"].dash


@pytest.mark.long
def test_methods_of_a_sweep_share_the_colours_of_their_shape_models(tmp_path):
    """The methods of which settings are made are not drawn, and take no colour from those."""
    methods = {f"voxel={v}/{name}": METHODS[name] for v in (1, 2, 3) for name in ("sog", "gsog")}
    run = made_run(1, methods=methods)
    run = replace(run, config=run.config | {"methods": {m: METHODS[m] for m in ("sog", "gsog")}})
    assert [run.style(f"voxel=1/{name}").colour.upper() for name in ("sog", "gsog")] == [
        *PALETTE[:2]
    ]
    assert len({style.colour for style in run.styles.values()}) == len(methods)
    write_report(run, tmp_path, figures=False)
    assert 'class="swatch"' not in (tmp_path / "report.html").read_text()


def test_methods_of_one_shape_model_have_colours_of_their_own():
    found = styles(dict.fromkeys("abcdefghij", "gsog"))
    assert len({style.colour for style in found.values()}) == len(PALETTE)
    looks = {(style.colour, style.hatch, style.dash) for style in found.values()}
    assert len(looks) == 10


def test_who_was_hardly_lost_is_not_called_better_than_who_never_was():
    """Of the methods that were lost, the one with the shortest time need not be a good one."""
    measures = made_run(1).measures
    times = {"sog": None, "gsog": 0.1, "icp": 3.0}
    measures = {
        method: {s: replace(one, recovery_s=times[method]) for s, one in by.items()}
        for method, by in measures.items()
    }
    table = main_table(measures)
    column = table.headings.index("lost for [s]")
    assert not any(row[column].best for row in table.rows)


def test_figures_are_drawn_on_either_paper():
    plot = next(plot for plot in plots(made_run(1)) if plot.name == "timing")
    assert plot.png(LIGHT) != plot.png(DARK)


def axes_height(plot) -> float:
    """The height of a figure's first axes when it is laid out, in inches."""
    figure = plot.draw(LIGHT)
    figure.draw_without_rendering()
    return figure.axes[0].get_position().height * figure.get_figheight()


@pytest.mark.parametrize("name", ["methods", "recordings", "thresholds", "joints", "over_time"])
def test_figures_have_room_for_a_sweep_beside_its_names(name):
    parts = "outliers=0.05,max_iterations"
    sweep = {f"voxel=0.03/best,{parts}={n}": METHODS["sog"] for n in range(10)}
    few, many = (
        next(plot for plot in plots(made_run(1, methods=methods)) if plot.name == name)
        for methods in ({"a": METHODS["sog"], "b": METHODS["sog"]}, sweep)
    )
    assert axes_height(many) > 0.9 * axes_height(few)


def test_long_name_is_broken_where_a_sweep_joined_it():
    long = "icp_of_the_textbook_and_no_other_whatsoeverinallthesedays"
    lines = wrapped(long, 10).split("\n")
    assert "".join(lines) == long
    assert max(map(len, lines)) <= 10
    assert lines[0] == "icp_of_"
    name = "voxel=0.03/best,outliers=0.05,steps=3"
    assert wrapped(name, 16).split("\n") == ["voxel=0.03/best,", "outliers=0.05,", "steps=3"]
    assert wrapped(name, 80) == name


def test_method_is_told_by_its_kinds_and_by_what_others_have_otherwise():
    found = brief(METHODS)
    assert found["sog"] == "{kind: direct, shape: sog, solver: {kind: lbfgs, memory: 5}}"
    assert found["icp"] == "{kind: direct, shape: mesh, solver: {kind: lbfgs, memory: 9}}"
    alike = brief({"a": METHODS["sog"], "b": METHODS["gsog"]})
    assert alike["a"] == "{kind: direct, shape: sog, solver: lbfgs}"


def test_flow_leaves_out_what_is_empty():
    value = {
        "kind": "depth",
        "frames": None,
        "joints": {},
        "used": True,
        "sigma": 0.01,
        "two": [1, 2],
    }
    assert flow(value) == "{kind: depth, used: true, sigma: 0.01, two: [1, 2]}"


def test_best_figure_of_a_column_is_marked_and_only_where_there_is_one():
    table = main_table(made_run(7).measures)
    best = {table.headings[index]: row[0].text for row in table.rows
            for index, cell in enumerate(row) if cell.best}  # fmt: skip
    assert best["raw [cm]"] == "sog"
    assert "speed [fps]" not in best


@pytest.mark.parametrize(
    ("p", "text"), [(None, "-"), (0.0004, "< 0.001"), (0.0123, "0.012"), (0.5, "0.50")]
)
def test_p_values_have_sensible_digits(p, text):
    assert p_text(p) == text


def test_record_tells_when_the_body_was_lost(random):
    made = record(random, 0.5)
    assert made.losses.lost.sum() == FRAMES
    assert not record(random, 0.5, compared=False).losses.lost.any()


def test_methods_of_different_settings_are_no_pair_of_shape_models():
    """A sweep calls its methods ``SETTING/METHOD``, and names them once."""
    run = made_run(1)
    one, other = run.measures["sog"], run.measures["gsog"]
    swept = replace(run, measures={f"{s}/{m}": of for s in "ab" for m, of in
                                   (("sog", one), ("gsog", other))})  # fmt: skip
    assert swept.shape_pairs == [("a/sog", "a/gsog"), ("b/sog", "b/gsog")]
    assert swept.style("a/sog").shape == "sog"


def test_overlay_tells_where_the_body_was_not_found(random):
    made = record(random, 0.02)
    verdicts = np.where(np.arange(len(made.verdicts)) > 0, "lost", "found")
    titles = [
        one.get_title()
        for one in overlay("m on r", replace(made, verdicts=verdicts), "#000000").axes
    ]
    assert [title.endswith("body lost") for title in titles] == [False, True, False, True]
