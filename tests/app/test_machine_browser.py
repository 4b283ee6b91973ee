"""The pages Machine and Two models in a real browser: by keys, by mouse and by touch; on a desk and
on a telephone, light and dark.
"""

import json
import re
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from tests.app.served import Served, serving
from tests.report.barriers import barriers
from tests.report.conftest import heard

pytestmark = pytest.mark.full
SLOW = 240_000  # milliseconds that an answer may take on a machine with other work
OVERFLOW = "document.documentElement.scrollWidth - document.documentElement.clientWidth"


@pytest.fixture(scope="module")
def own(tmp_path_factory) -> Iterator[Served]:
    pytest.importorskip("starlette", reason="the extra app is not installed")
    with serving(tmp_path_factory.mktemp("bench") / "project") as served:
        yield served


@pytest.fixture
def visit(browser, own):
    """Open a page of the app; in the meantime nothing on the console but answers that refuse a
    request, and no request but its own. What was saved last is a machine that no test writes, so
    that nobody takes its answers for those of what is written.
    """
    saved = {"text": "1~2-#; F1; S2", "places": {}}
    assert own.call("save", {"page": "machine", "content": saved})[0] == 200

    @contextmanager
    def go(page: str, width: int = 1280, scheme: str = "light", **more):
        context = browser.new_context(
            viewport={"width": width, "height": 844},
            color_scheme=scheme,
            reduced_motion="reduce",
            **more,
        )
        tab = context.new_page()
        tab.set_default_timeout(SLOW)
        with heard(tab) as (troubles, requests):
            tab.goto(own.first_address)
            tab.goto(f"{own.base}/#{page}")
            yield tab
        assert [t for t in troubles if "status of 422" not in t] == []
        assert all(url.startswith((own.base + "/", "data:", "blob:")) for url in requests)
        context.close()

    return go


def write(tab, text: str) -> None:
    """Type a machine and wait for its answers."""
    tab.locator("#determined .verdict").wait_for()
    tab.fill("#machine-text", text)
    tab.locator("#determined", has=tab.locator(f"[data-of={json.dumps(text)}]")).wait_for()


def wait_text(tab, text: str) -> None:
    """Wait for the text; the policy of the page forbids functions that wait in it."""
    for _ in range(600):
        if tab.input_value("#machine-text") == text:
            return
        tab.wait_for_timeout(100)
    assert tab.input_value("#machine-text") == text


def wait_change(tab, selector: str, name: str, before: str) -> None:
    """Wait until an attribute has another value: what a key changes is drawn in the next frame."""
    for _ in range(600):
        if tab.locator(selector).first.get_attribute(name) != before:
            return
        tab.wait_for_timeout(100)
    raise AssertionError(f"{name} of {selector} is still {before}")


def hold(tab, name: str) -> list:
    """Keep the calls of a name waiting; those that came."""
    held = []
    tab.route(f"**/api/{name}", lambda route: held.append(route))
    return held


def release(tab, name: str, held: list) -> None:
    """Let them go to the engine."""
    for route in held:
        route.continue_()
    tab.unroute(f"**/api/{name}")


def test_a_machine_by_keys(own, visit):
    with visit("machine") as tab:
        write(tab, "1=2=3; F1; S3")
        tab.locator("#determined", has_text="only 6 determinable").wait_for()
        assert tab.locator(".bench .mass").count() == 3
        tab.focus("#add-mass")
        tab.keyboard.press("Enter")
        tab.locator("#machine-trouble", has_text="mass 4 is joined with nothing").wait_for()
        assert tab.evaluate("document.activeElement.dataset.node") == "4"
        tab.focus("input[name=tool][value=both]")
        tab.keyboard.press("ArrowRight")
        assert tab.is_checked("input[name=tool][value=spring]")
        for node in ("3", "4"):
            tab.focus(f".bench [data-node='{node}']")
            tab.keyboard.press("Enter")
        wait_text(tab, "1=2=3~4; F1; S3")
        tab.focus(".bench [data-node='4']")
        tab.keyboard.press("s")
        wait_text(tab, "1=2=3~4; F1; S3 S4")
        tab.focus(".bench [data-node='3']")
        tab.keyboard.press("s")
        wait_text(tab, "1=2=3~4; F1; S4")
        assert tab.evaluate("document.activeElement.dataset.node") == "3"
        before = tab.get_attribute(".bench [data-node='3'] rect", "x")
        tab.keyboard.press("ArrowDown")
        tab.keyboard.press("ArrowLeft")
        wait_change(tab, ".bench [data-node='3'] rect", "x", before)
        for node in ("2", "0"):
            tab.focus(f".bench [data-node='{node}']")
            tab.keyboard.press("Enter")
        wait_text(tab, "1=2=3~4, 2~#; F1; S4")
        tab.focus(".bench [data-node='4']")
        tab.keyboard.press("Delete")
        tab.locator("#machine-trouble", has_text="there is no sensor").wait_for()
        assert json.loads((own.folder / "machine.json").read_text())["text"].endswith("S4")


def test_a_machine_by_mouse(visit):
    with visit("machine") as tab:
        write(tab, "1=2; F1; S1")
        tab.select_option("#machine-gallery", label="Belt axis")
        tab.locator("#determined", has_text="8 parameters").wait_for()
        assert tab.locator(".bench .mass").count() == 3
        box = tab.locator(".bench [data-node='2'] rect").bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        tab.mouse.move(x, y)
        tab.mouse.down()
        tab.mouse.move(x + 20, y + 70, steps=5)
        tab.mouse.up()
        moved = tab.locator(".bench [data-node='2'] rect").bounding_box()
        assert abs(moved["y"] - box["y"] - 70) < 3
        tab.click("label:has(input[value=damper])")
        tab.click(".bench [data-node='1'] rect")
        tab.click(".bench .ground rect")
        wait_text(tab, "1=2=3-#, 1-#; F1; S1")
        tab.click("label:has(input[value=remove])")
        tab.locator(".bench [data-joint='1'] .grip").click(force=True)
        wait_text(tab, "1=2, 3-#, 1-#; F1; S1")
        tab.click("label:has(input[value=spring])")
        tab.drag_and_drop(".bench [data-node='2'] rect", ".bench [data-node='3'] rect")
        wait_text(tab, "1=2, 3-#, 1-#, 2~3; F1; S1")
        tab.click("label:has(input[value=sensor])")
        tab.click(".bench [data-node='3'] rect")
        wait_text(tab, "1=2, 3-#, 1-#, 2~3; F1; S1 S3")
        tab.click("#parts-list summary")
        tab.fill("[aria-label='Gear ratio of mass 1 and mass 2']", "i")
        tab.keyboard.press("Tab")
        wait_text(tab, "1=2*i, 1-#, 2~3-#; F1; S1 S3")
        tab.click("[aria-label='Remove sensor 2']")
        wait_text(tab, "1=2*i, 1-#, 2~3-#; F1; S1")


def test_masses_of_another_machine_cover_no_other_and_no_more_is_said_than_is_known(visit):
    with visit("machine") as tab:
        write(tab, "1=2; F1; S1")
        write(tab, "1=3, 2=3*i; F1; S3 S2")
        places = [
            tuple(round(float(r.get_attribute(x)) / 10) for x in "xy")
            for r in tab.locator(".bench .mass rect").all()
        ]
        assert len({*places}) == 3
        tab.locator("#next", has_text="No catalogue lists this model").wait_for()
        write(tab, "R1-R2-R3-C1-C2-C3")
        tab.locator("#next", has_text="Not every parameter has one value").wait_for()


def test_a_machine_by_touch(visit):
    with visit("machine", 390, has_touch=True) as tab:
        write(tab, "1=2; F1; S1")
        tab.tap("#add-mass")
        tab.tap("label:has(input[value=both])")
        tab.locator(".bench [data-node='2'] rect").tap()
        tab.locator(".bench [data-node='3'] rect").tap()
        wait_text(tab, "1=2=3; F1; S1")


def test_a_gear_by_mouse_by_keys_and_by_touch(visit):
    with visit("machine", has_touch=True) as tab:
        write(tab, "1=2=3; F1; S1")
        tab.click("label:has(input[value=gear])")
        for node in "12":
            tab.locator(f".bench [data-node='{node}'] rect").click()
        wait_text(tab, "1=2*i=3; F1; S1")
        assert tab.locator(".bench .gear").count() == 1
        for node in "23":
            tab.locator(f".bench [data-node='{node}'] rect").tap()
        wait_text(tab, "1=2*i=3*i2; F1; S1")
        for node in "21":
            tab.focus(f".bench [data-node='{node}']")
            tab.keyboard.press("Enter")
        wait_text(tab, "1=2=3*i2; F1; S1")
        ends = [tab.locator(f".bench [data-node='{i}'] rect").bounding_box() for i in (2, 3)]
        tab.mouse.click(*((ends[0][x] + ends[1][x]) / 2 + 20 for x in "xy"))
        wait_text(tab, "1=2=3; F1; S1")
        for node in "10":  # a gear has no end at the ground: mass 1 stays chosen
            tab.focus(f".bench [data-node='{node}']")
            tab.keyboard.press("Enter")
        assert tab.get_attribute(".bench [data-node='1']", "aria-pressed") == "true"
        held = hold(tab, "machine")
        tab.fill("#machine-text", "1=2=3; F1; S1")  # the machine that is there
        while not held:
            tab.wait_for_timeout(50)
        with tab.expect_response("**/api/machine"):
            release(tab, "machine", held)
        tab.locator(".answers:not(.stale)").wait_for()
        assert tab.get_attribute(".bench [data-node='1']", "aria-pressed") == "true"


def test_what_looks_the_same_leads_to_both(visit):
    with visit("machine") as tab:
        write(tab, "1=2; F1; S1")
        row = tab.locator("#alike li", has_text="2:3")
        row.locator("table").wait_for()
        assert "405/2" in row.inner_text()
        tab.locator("#next", has_text="a sensor at any further mass").wait_for()
        tab.click("text=Values of this model")
        tab.fill("#value-m1", "4")
        tab.keyboard.press("Tab")
        row.locator("td", has_text="4").first.wait_for()
        with tab.expect_download() as saved:
            row.locator("text=Evidence (JSON)").click()
        assert json.loads(saved.value.path().read_text())["relation"] == "indistinguishable"
        row.locator("text=Compare both").click()
        tab.locator("#relation", has_text="indistinguishable").wait_for()
        assert tab.input_value("#compare-right") == "2:3"


def test_a_slow_answer_shows_what_is_known_and_its_seconds(visit):
    with visit("machine") as tab:
        write(tab, "1=2; F1; S1")
        held = hold(tab, "determine")
        tab.fill("#machine-text", "1=2=3; F1; S3")
        tab.locator("#determined .count", has_text="7 parameters, only 6 determinable").wait_for()
        tab.locator(
            "#determined .waiting", has_text=re.compile(r"one value … [1-9]\d* s")
        ).wait_for()
        tab.locator("#alike h3").first.wait_for()  # which waits for nothing else
        release(tab, "determine", held)
        tab.locator("#determined .verdict", has_text="only 6 determinable").wait_for()
        assert tab.get_attribute("#determined", "aria-busy") == "false"


def test_what_nobody_needs_any_more_is_given_up(visit):
    with visit("machine") as tab:
        write(tab, "1=2; F1; S1")
        left = []
        tab.on(
            "requestfailed", lambda request: left.append((request.post_data_json or {}).get("text"))
        )
        held = hold(tab, "determine")
        tab.fill("#machine-text", "1=2=3; F1; S3")
        tab.locator("#determined .waiting").wait_for()
        tab.unroute("**/api/determine")
        tab.fill("#machine-text", "1=2=3; F1; S2")
        tab.locator("#determined [data-of='1=2=3; F1; S2']").wait_for()
        assert len(held) == 1
        assert "1=2=3; F1; S3" in left
        hold(tab, "determine")
        tab.fill("#machine-text", "1=2; F1; S2")
        tab.locator("#determined .waiting").wait_for()
        tab.fill("#machine-text", "no machine")
        tab.locator("#machine-trouble", has_text="write").wait_for()
        assert tab.locator(".waiting").count() == 0


def test_a_circuit_is_written_and_a_bad_text_says_what_to_do(visit):
    with visit("machine") as tab:
        write(tab, "R0-p(R1,C1)")
        tab.locator("#determined", has_text="3 parameters").wait_for()
        assert tab.locator(".bench").is_hidden()
        tab.fill("#machine-text", "nonsense")
        tab.locator("#machine-trouble", has_text="write a circuit as").wait_for()
        tab.fill("#machine-text", "")
        tab.locator("#machine-trouble", has_text="write a machine such as").wait_for()
        tab.fill("#machine-text", "<img src=x onerror=alert(1)>; F1; S1")
        tab.locator("#machine-trouble", has_text="<img").wait_for()
        assert tab.locator("#page-machine img").count() == 0
        write(tab, "1~2; F1; S2")
        assert tab.inner_text("#machine-trouble") == ""


def test_two_models_and_their_motion(visit):
    with visit("compare") as tab:
        tab.fill("#compare-left", "3:1")
        tab.fill("#compare-right", "3:11")
        tab.locator("#pair-formulas", has_text="m3'  = m1 + m2 + m3").wait_for()
        tab.locator("#motion-how", has_text="Both show the same acceleration").wait_for()
        where = "figure:nth-of-type(2) svg.graph g"
        before = tab.locator(where).first.get_attribute("transform")
        tab.locator("[aria-label=Time]").focus()
        for _ in range(8):
            tab.keyboard.press("ArrowRight")
        wait_change(tab, where, "transform", before)
        tab.click("text=Play")
        tab.locator("button", has_text="Pause").click()
        tab.click("[aria-label='Exchange the two models']")
        tab.locator("#relation", has_text="indistinguishable").wait_for()
        assert tab.input_value("#compare-left") == "3:11"
        tab.fill("#compare-left", "p(R1,R2-C1)")
        tab.fill("#compare-right", "R1-C1")
        tab.locator("#pair-verdict strong", has_text="distinguishable").wait_for()
        tab.locator("text=In motion").wait_for(state="hidden")
        tab.fill("#compare-right", "1=2; F1; S1")
        tab.locator("#pair-verdict .trouble, #relation").first.wait_for()


def gains(tab) -> list[list[float]]:
    """Curves of the amplitudes of both models, as numbers of their paths."""
    paths = [tab.locator(f"#motion-bode path.curve.{one}").first for one in ("one", "two")]
    return [[float(x) for x in re.findall(r"[\d.]+", p.get_attribute("d"))] for p in paths]


def test_bode_diagrams_a_sweep_and_the_nearest_values(visit):
    with visit("compare") as tab:
        tab.fill("#compare-left", "3:1")
        tab.fill("#compare-right", "3:11")
        tab.locator("#motion-how", has_text="Both show the same acceleration").wait_for()
        one, two = gains(tab)
        assert one == pytest.approx(two, abs=0.11)
        tab.click("label:has(input[value=sweep])")
        tab.locator("#motion-run path.curve").first.wait_for()
        assert "in 40 s" in tab.inner_text("#page-compare")
        mark = "#motion-bode path.now"
        before = tab.get_attribute(mark, "d")
        tab.focus("[aria-label=Time]")
        tab.keyboard.press("PageUp")
        wait_change(tab, mark, "d", before)
        assert "Hz" in tab.get_attribute("[aria-label=Time]", "aria-valuetext")
        tab.fill("#compare-right", "3:2")
        tab.locator("#motion-nearest[data-state=found]").wait_for()
        assert "is off by up to" in tab.inner_text("#motion-how")
        assert "dB apart" in tab.locator("#motion-bode").inner_html()
        one, two = gains(tab)
        assert one != pytest.approx(two, abs=0.11)
        assert barriers(tab) == []


@pytest.mark.parametrize(
    ("page", "field"), [("compare", "#compare-left"), ("machine", "#machine-text")]
)
@pytest.mark.parametrize(("before", "after"), [("3:1", ""), ("", "3:1")])
def test_what_is_written_before_the_saved_page_comes_stays(visit, page, field, before, after):
    """The page asks for what was shown last; it came late, replaced what somebody wrote, and stood
    before what somebody was about to write.
    """
    with visit("data") as tab:
        held = []
        tab.route("**/api/open", lambda route: held.append(route))
        tab.goto(f"{tab.url.partition('#')[0]}?#{page}")
        tab.reload()
        tab.focus(field)
        tab.keyboard.type(before)
        while not held:
            tab.wait_for_timeout(50)
        for route in held:
            route.continue_()
        tab.unroute("**/api/open")
        tab.wait_for_timeout(500)
        tab.keyboard.type(after)
        assert tab.input_value(field) == "3:1"


@pytest.mark.parametrize(
    ("width", "scheme"),
    [
        (1280, "light"),
        (390, "dark"),
        pytest.param(1280, "dark", marks=pytest.mark.slow),  # colours do not depend on the width
        pytest.param(390, "light", marks=pytest.mark.slow),
    ],
)
def test_pages_have_no_barriers_and_fit_their_window(visit, width, scheme):
    with visit("machine", width, scheme) as tab:
        write(tab, "1=2; F1; S1")
        tab.locator("#next .answer p").first.wait_for()
        for fold in tab.locator("#page-machine summary").all():
            fold.click()
        assert barriers(tab) == []
        assert tab.evaluate(OVERFLOW) == 0
        tab.goto(tab.url.partition("#")[0] + "#compare")
        tab.fill("#compare-left", "3:1")
        tab.fill("#compare-right", "3:11")
        tab.locator("#motion-how", has_text="Both show the same acceleration").wait_for()
        assert barriers(tab) == []
        assert tab.evaluate(OVERFLOW) == 0
