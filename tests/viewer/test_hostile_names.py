import json

from browser import WITHOUT_WEBGL, opened
from viewer_scenes import walk

from regkit.viewer.page import page

HOSTILE = "<img src=x onerror=alert(1)> & \"'</script>"


def test_hostile_names_are_text(browser, tmp_path):
    document = json.loads(walk(title=HOSTILE, note=HOSTILE))
    made = document["recordings"][0]
    made["name"] = made["methods"][1]["name"] = made["marked"][0]["why"] = HOSTILE
    made["methods"][1]["curves"][0]["name"] = HOSTILE
    made["methods"][0]["segments"][2] = HOSTILE
    file = tmp_path / "hostile.html"
    file.write_text(page(HOSTILE, json.dumps(document).encode()), "utf-8")
    with opened(browser, file, hash="#frame=30", script=WITHOUT_WEBGL) as shown:
        shown.page.wait_for_selector("#readout:has-text('Frame 30')")
        assert shown.page.locator("img, b").count() == 0
        for place in ("#title", "#note", "#banner", "#readout", "#methods"):
            assert HOSTILE in shown.page.inner_text(place)
        shown.wait(f"decodeURIComponent(location.hash).includes({json.dumps(HOSTILE)})")
        assert shown.messages == []
