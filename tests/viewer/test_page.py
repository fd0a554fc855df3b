import base64
import gzip
import json
import re
from html.parser import HTMLParser

from viewer_scenes import scene, walk

from regkit.viewer.page import page

HOSTILE = "</script><script>alert(1)</script> & \"'<b>"


class Parts(HTMLParser):
    """The elements of a page, with their attributes and their text."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.parts: list[tuple[str, dict[str, str | None], str]] = []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.parts.append((tag, dict(attrs), ""))

    def handle_data(self, data):
        if self.parts:
            tag, attributes, text = self.parts[-1]
            self.parts[-1] = (tag, attributes, text + data)

    def all(self, wanted: str) -> list[tuple[dict[str, str | None], str]]:
        return [(attributes, text) for tag, attributes, text in self.parts if tag == wanted]


def modules(text: str) -> dict[str, str]:
    """The modules of a page by their names in its import map."""
    (imports,) = [text for one, text in Parts(text).all("script") if one.get("type") == "importmap"]
    return {
        name: base64.b64decode(address.partition(",")[2]).decode("utf-8")
        for name, address in json.loads(imports)["imports"].items()
    }


def test_scene_is_in_the_page_unchanged():
    document = walk(title=HOSTILE)
    scripts = Parts(page("walk", document)).all("script")
    (embedded,) = [text for one, text in scripts if one.get("id") == "scene"]
    assert gzip.decompress(base64.b64decode(embedded)) == document


def test_page_is_the_same_for_the_same_scene():
    assert page("walk", walk()) == page("walk", walk())


def test_page_without_a_scene_has_none():
    assert not [one for one, _ in Parts(page("live")).all("script") if one.get("id") == "scene"]


def test_title_is_text():
    text = page(HOSTILE, scene(title=HOSTILE))
    assert "alert(1)</script>" not in text
    assert Parts(text).all("title")[0][1].strip() == HOSTILE


def test_every_import_is_in_the_page():
    found = modules(page("walk"))
    wanted: set[str] = set()
    for text in found.values():
        code = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
        wanted.update(re.findall(r"""\bfrom\s*["']([^"'\s]+)["']""", code))
    assert {"three", "page/camera.js", "page/three.core.min.js"} <= wanted
    assert wanted <= set(found)


def test_page_loads_nothing_from_elsewhere():
    parts = Parts(page("walk", walk()))
    policy = next(
        attributes["content"]
        for attributes, _ in parts.all("meta")
        if attributes.get("http-equiv") == "Content-Security-Policy"
    )
    assert policy is not None
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert not re.search(r"https?:|\*", policy)
    links = [attributes.get("src") or attributes.get("href") for _, attributes, _ in parts.parts]
    assert {link for link in links if link} == {"data:,"}
