"""The report's page in a browser: it sorts, fits a telephone, and needs nothing from elsewhere."""

import html
import json
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from made_results import made_run

from regkit.report import write_report

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
OPTIONS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--hide-scrollbars",
    "--allow-file-access-from-files",
    "--host-resolver-rules=MAP * ~NOTFOUND",
    "--virtual-time-budget=10000",
)
WATCH = """<script>
const complaints = [];
const complain = (event) => complaints.push(event.message || event.target.outerHTML);
addEventListener("error", complain, true);
addEventListener("securitypolicyviolation", (event) => complaints.push(event.blockedURI));
console.error = (...told) => complaints.push(told.join(" "));
</script>"""
TELL = """<script>
addEventListener("load", async () => {{
  const found = await (async () => {{ {body} }})();
  const told = document.createElement("pre");
  told.id = "told";
  told.textContent = JSON.stringify(found);
  document.body.append(told);
}});
</script>"""


@pytest.fixture(scope="module")
def browser(tmp_path_factory) -> list[str]:
    """The command of a browser, with a profile of its own."""
    found = next((path for name in BROWSERS if (path := shutil.which(name))), None)
    if found is None:
        pytest.skip(f"there is no browser (looked for: {', '.join(BROWSERS)})")
    profile = tmp_path_factory.mktemp("profile")
    return [found, *OPTIONS, f"--user-data-dir={profile}"]


@pytest.fixture
def page(folder) -> Path:
    return folder / "report.html"


def told(browser: list[str], page: Path, body: str) -> dict:
    """What a script finds in a page after it was loaded."""
    text = page.read_text(encoding="utf-8")
    assert text.count("<head>") == text.count("</body>") == 1
    text = text.replace("<head>", "<head>" + WATCH)
    text = text.replace("</body>", TELL.format(body=body) + "</body>")
    return dumped(browser, page.with_name("watched.html"), text)


def dumped(browser: list[str], file: Path, text: str) -> dict:
    file.write_text(text, encoding="utf-8")
    done = subprocess.run(
        [*browser, "--dump-dom", file.as_uri()], capture_output=True, timeout=120, check=True
    )
    found = re.search(r'<pre id="told">(.*?)</pre>', done.stdout.decode("utf-8"), re.DOTALL)
    assert found, done.stderr.decode("utf-8", "replace")
    return json.loads(html.unescape(found.group(1)))


def test_page_has_no_error_and_asks_for_nothing(browser, page):
    found = told(
        browser,
        page,
        """
        for (const one of document.querySelectorAll("details")) one.open = true;
        for (const one of document.images) one.loading = "eager";
        const images = Array.from(document.images);
        for (let tries = 0; tries < 100 && !images.every((one) => one.complete); tries += 1)
            await new Promise((done) => setTimeout(done, 20));
        return {
            complaints,
            asked: performance.getEntriesByType("resource").map((one) => one.name)
                .filter((name) => !name.startsWith("data:")),
            images: document.images.length,
            blank: Array.from(document.images).filter((one) => !one.naturalWidth).length,
            unnamed: Array.from(document.images).filter((one) => !one.alt).length,
        };
        """,
    )
    assert found["complaints"] == []
    assert found["asked"] == []
    assert found["images"] == 8 + 12
    assert found["blank"] == found["unnamed"] == 0


SORTED = """
const table = document.querySelector("table.sortable");
const headings = Array.from(table.tHead.rows[0].cells);
const column = headings.findIndex((one) => one.textContent.includes("%s"));
const seen = () => ({
    cells: Array.from(table.tBodies[0].rows).map((row) => row.cells[column].dataset.key),
    sorted: headings.map((one) => one.getAttribute("aria-sort")),
    focused: document.activeElement === headings[column].querySelector("button"),
});
const states = [seen()];
for (let times = 0; times < 2; times += 1) {
    headings[column].querySelector("button").focus();
    headings[column].querySelector("button").click();
    states.push(seen());
}
return {column, states, complaints};
"""


@pytest.mark.parametrize("heading", ["raw", "method"])
def test_table_is_sorted_by_a_heading_one_way_and_the_other(browser, page, heading):
    found = told(browser, page, SORTED % heading)
    before, rising, falling = found["states"]
    read = float if heading == "raw" else str
    values = [read(cell) for cell in before["cells"]]
    assert [read(cell) for cell in rising["cells"]] == sorted(values)
    assert [read(cell) for cell in falling["cells"]] == sorted(values, reverse=True)
    assert rising["sorted"][found["column"]] == "ascending"
    assert falling["sorted"][found["column"]] == "descending"
    assert [one for one in falling["sorted"] if one] == ["descending"]
    assert rising["focused"]
    assert found["complaints"] == []


def test_what_is_unknown_stands_last_whichever_way_a_table_is_sorted(browser, tmp_path):
    run = made_run(2)
    unknown = {
        recording: replace(measure, joint_error_raw_cm=None)
        for recording, measure in run.measures["sog"].items()
    }
    run = replace(run, measures=dict(run.measures) | {"sog": unknown})
    write_report(run, tmp_path, figures=False)
    found = told(browser, tmp_path / "report.html", SORTED % "raw")
    assert [one["cells"][-1] for one in found["states"][1:]] == ["", ""]
    assert found["states"][0]["cells"][0] == ""


@pytest.mark.parametrize("width", [375, 768, 1280])
def test_only_tables_scroll_sideways(browser, page, width):
    """A window cannot be as narrow as a telephone, but a frame can."""
    frame = page.with_name("frame.html")
    text = f"""<!DOCTYPE html><html><head></head><body>
        <iframe src="{page.name}" width="{width}" height="800"></iframe>""" + TELL.format(
        body="""
        const page = document.querySelector("iframe").contentDocument;
        for (const one of page.querySelectorAll("details")) one.open = true;
        const inner = document.querySelector("iframe").contentWindow.innerWidth;
        const outside = Array.from(page.body.querySelectorAll("*")).filter((one) =>
            !one.closest(".scroll") && one.getBoundingClientRect().right > inner + 0.5);
        return {
            inner, width: page.documentElement.scrollWidth,
            outside: outside.map((one) => one.tagName + "." + one.className),
            boxes: Array.from(page.querySelectorAll(".scroll")).map((one) =>
                [one.tabIndex, one.getBoundingClientRect().width]),
        };
        """
    )
    found = dumped(browser, frame, text + "</body></html>")
    assert found["inner"] == width
    assert found["width"] <= width
    assert found["outside"] == []
    assert len(found["boxes"]) == 4
    assert all(focus == 0 and box <= width for focus, box in found["boxes"])


def test_page_looks_otherwise_in_the_dark(browser, page, tmp_path):
    """Of each figure the picture for the dark is taken, and the paper is dark."""
    body = """
        return {
            paper: getComputedStyle(document.body).backgroundColor,
            figure: document.querySelector("picture img").currentSrc ===
                document.querySelector("picture source").srcset,
        };
        """
    light = told([*browser, "--blink-settings=preferredColorScheme=1"], page, body)
    dark = told([*browser, "--blink-settings=preferredColorScheme=0"], page, body)
    assert light == {"paper": "rgb(255, 255, 255)", "figure": False}
    assert dark == {"paper": "rgb(27, 29, 32)", "figure": True}


def test_page_can_be_pictured(browser, page, tmp_path):
    picture = tmp_path / "page.png"
    subprocess.run(
        [*browser, f"--screenshot={picture}", "--window-size=1200,1500", page.as_uri()],
        capture_output=True, timeout=120, check=True,
    )  # fmt: skip
    from PIL import Image

    with Image.open(picture) as image:
        assert image.size == (1200, 1500)
        assert len(image.convert("L").getcolors()) > 50
