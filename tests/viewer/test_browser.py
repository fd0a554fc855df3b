import pytest
from browser import WITHOUT_WEBGL, opened


def test_page_opens_from_a_file(shown, walk_page):
    assert shown.page.title() == "demo"
    assert shown.page.inner_text("#readout").startswith("Frame 0")
    assert shown.messages == []
    assert shown.requests == [walk_page.as_uri()]


def test_page_plays_and_pauses(shown):
    shown.page.click("#play")
    shown.wait("Number(data.ready) >= 20")
    shown.page.keyboard.press("Space")
    assert shown.page.get_attribute("#play", "aria-label") == "Play"


@pytest.mark.long
def test_page_plays_at_the_speed_of_the_recording(shown):
    # 40 of 30 frames a second, four times as fast; a busy machine is late, but never early.
    shown.page.evaluate("started = performance.now()")
    shown.go("#frame=0&play=1&speed=4")
    shown.wait("Number(data.ready) >= 40")
    assert shown.page.evaluate("performance.now() - started") > 250


@pytest.mark.long
def test_page_rests_when_nothing_changes(shown):
    draws = []
    while len(draws) < 2 or draws[-1] != draws[-2]:
        assert len(draws) < 20
        draws.append(shown.data("draws"))
        shown.page.wait_for_timeout(250)


def test_keys_move_the_frame(shown):
    moves = {"ArrowRight": 10, "End": 50, "ArrowLeft": 40, "Home": 0, "m": 30}
    for key, number in moves.items():
        shown.page.keyboard.press(key)
        shown.wait_frame(number)
    assert shown.page.get_attribute("#timeline", "aria-valuenow") == "30"
    assert "worst of icp" in shown.page.inner_text("#readout")


def test_clicks_and_drags_on_the_timeline_move_the_frame(shown):
    box = shown.page.locator("#timeline").bounding_box()
    shown.page.mouse.move(box["x"] + box["width"] - 10, box["y"] + 30)
    shown.page.mouse.down()
    shown.wait_frame(50)
    shown.page.mouse.move(box["x"] + 115, box["y"] + 30)
    shown.wait_frame(0)
    shown.page.mouse.up()


def test_address_and_page_agree(shown):
    shown.go("#frame=31&methods=icp&speed=2")
    shown.wait_frame(30)
    assert shown.page.input_value("#speed") == "2"
    boxes = shown.page.locator("#methods input").all()
    assert [box.is_checked() for box in boxes] == [False, True]
    shown.page.keyboard.press("End")
    shown.wait("location.hash === '#recording=walk&frame=50&speed=2&methods=icp'")


def test_switches_change_what_is_drawn(shown):
    both = int(shown.data("triangles"))
    shown.page.click("#methods li:first-child .name")
    shown.wait(f"Number(data.triangles) < {both}")
    one = int(shown.data("triangles"))
    shown.page.uncheck("#show-bones")
    shown.wait(f"Number(data.triangles) < {one}")
    shown.page.select_option("#model", "capsules")
    shown.wait(f"Number(data.triangles) > {one}")
    shown.page.select_option("#model", "own")
    shown.page.check("#show-bones")
    shown.wait(f"Number(data.triangles) === {one}")


@pytest.mark.long
def test_cameras_of_a_recording_are_drawn_with_their_names_until_they_are_switched_off(shown):
    assert not shown.page.is_visible("#show-cameras")
    shown.go("#recording=cloud")
    shown.wait("data.ready === '0'")
    assert shown.page.is_visible("#show-cameras")
    assert "depth cameras" in shown.page.inner_text("#legend")
    with_names = int(shown.data("triangles"))
    shown.page.uncheck("#show-cameras")
    shown.wait(f"Number(data.triangles) === {with_names} - 4")  # A name is two triangles.
    shown.page.check("#show-cameras")


@pytest.mark.parametrize(
    ("frame", "methods", "said"),
    [
        (10, "icp", ""),
        (30, "icp", "Body lost"),
        (30, "best,icp", "Body lost: icp"),
        (40, "icp", "No body in sight"),
    ],
)
def test_banner_tells_a_body_that_is_not_found(shown, frame, methods, said):
    shown.go(f"#frame={frame}&methods={methods}")
    shown.wait_frame(frame)
    assert shown.page.inner_text("#banner") == said
    assert shown.page.is_visible("#banner") == bool(said)


def test_panel_tells_verdict_values_and_segments_with_little_data(shown):
    shown.go("#frame=30")
    shown.wait_frame(30)
    best, icp = shown.page.locator("#methods li").all()
    assert best.locator(".badge").inner_text() == "found"
    assert icp.locator(".badge").inner_text() == "lost"
    assert "Little data: right arm" in best.inner_text()
    assert "87.2 %" in best.inner_text()


@pytest.mark.long
def test_views_are_marked(shown):
    for view in ("front", "side", "top", "sensor", "free"):
        button = shown.page.locator(f"[data-view={view}]")
        button.click()
        assert button.get_attribute("aria-pressed") == "true"
        assert shown.page.is_visible("#border") == (view == "sensor")


@pytest.mark.long
def test_drags_and_the_wheel_turn_and_move_the_view(shown):
    shown.page.click("[data-view=front]")
    fit = shown.page.locator("[data-view=front]")
    box = shown.page.locator("#view").bounding_box()
    for move in ("drag", "wheel"):
        fit.click()
        assert fit.get_attribute("aria-pressed") == "true"
        before = int(shown.data("draws"))
        shown.page.mouse.move(box["x"] + 100, box["y"] + 100)
        if move == "wheel":
            shown.page.mouse.wheel(0, 200)
        else:
            shown.page.mouse.down()
            shown.page.mouse.move(box["x"] + 160, box["y"] + 120)
            shown.page.mouse.up()
        shown.wait(f"Number(data.draws) > {before}")
        assert fit.get_attribute("aria-pressed") == "false"


def test_phone_scrolls_in_no_direction(shown):
    size = "[document.documentElement.scrollWidth, document.documentElement.scrollHeight]"
    shown.page.set_viewport_size({"width": 390, "height": 844})
    assert shown.page.evaluate(size) == [390, 844]
    assert shown.page.is_visible("#methods")
    shown.page.click("#panel summary")
    assert shown.page.evaluate(size) == [390, 844]
    assert shown.page.locator("#view").bounding_box()["height"] > 400
    shown.page.click("#panel summary")


def test_scheme_and_switch_change_the_colours(shown):
    background = "getComputedStyle(document.body).backgroundColor"
    light = shown.page.evaluate(background)
    shown.page.emulate_media(color_scheme="dark")
    dark = shown.page.evaluate(background)
    assert dark != light
    shown.page.click("#theme")
    assert shown.page.evaluate(background) == light
    shown.page.click("#theme")
    assert shown.page.evaluate(background) == dark


def test_recording_of_one_frame_has_no_timeline(shown):
    shown.page.select_option("#recordings", "cloud")
    shown.page.wait_for_selector("#transport", state="hidden")
    assert shown.page.locator("#methods li").count() == 0
    shown.wait("location.hash.includes('recording=cloud')")


def test_page_says_nothing_to_the_console(shown):
    assert shown.messages == []


def test_browser_without_webgl_is_told(browser, walk_page):
    with opened(browser, walk_page, script=WITHOUT_WEBGL) as shown:
        shown.page.wait_for_selector("#message:has-text('WebGL')")
        shown.page.keyboard.press("m")
        assert "Frame 30" in shown.page.inner_text("#readout")
        assert shown.messages == []
