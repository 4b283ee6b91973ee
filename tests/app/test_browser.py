"""The Data page in a real browser: an engineer's way by mouse and by keyboard, a chemist's, what
goes wrong; on a desk and on a telephone, light and dark.
"""

import json
import re
import shutil
from collections.abc import Iterator

import pytest

from disting.app.project import LOCK
from tests.app.served import Served, bench_csv, serving, spectrum_csv
from tests.report.barriers import barriers
from tests.report.conftest import heard

pytestmark = pytest.mark.full
VELOCITY = {"quantity": "velocity"}
SLOW = 240_000  # milliseconds that a fit may take on a machine with other work
REFUSAL = re.compile(r"Failed to load resource: the server responded with a status of 422")
DROP = """([name, text]) => {
  const data = new DataTransfer();
  data.items.add(new File([text], name));
  for (const kind of ["dragover", "drop"]) document.querySelector(".drop").dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true }));
}"""


@pytest.fixture(scope="module")
def server(tmp_path_factory) -> Iterator[Served]:
    pytest.importorskip("starlette", reason="the extra app is not installed")
    with serving(tmp_path_factory.mktemp("own") / "project") as served:
        yield served


@pytest.fixture
def own(server) -> Iterator[Served]:
    """A server with an empty project: all that it knows lies in the folder, and another one would
    import for seconds.
    """
    yield server
    for job in json.loads(server.ask("GET", "/api/jobs")[2])["jobs"]:
        server.ask("POST", f"/api/jobs/{job['job']}/stop")
    for path in server.folder.iterdir():
        if path.is_dir():
            shutil.rmtree(path)
        elif path.name != LOCK:
            path.unlink()


@pytest.fixture
def visit(browser) -> Iterator[object]:
    """Open the page of a server; at the end: nothing on the console, no request but its own."""
    contexts, heards = [], []

    def go(served: Served, width: int = 1280, scheme: str = "light"):
        context = browser.new_context(
            viewport={"width": width, "height": 844 if width < 500 else 800},
            color_scheme=scheme,
            reduced_motion="reduce",
            has_touch=width < 500,
        )
        tab = context.new_page()
        tab.set_default_timeout(SLOW)
        listening = heard(tab)
        heards.append((served.base, listening, listening.__enter__()))
        contexts.append(context)
        tab.goto(served.first_address)
        tab.wait_for_selector("#page-data h1")
        return tab

    yield go
    for base, listening, (troubles, requests) in heards:
        listening.__exit__(None, None, None)
        assert [text for text in troubles if not REFUSAL.match(text)] == []
        assert all(url.startswith((base + "/", "data:", "blob:")) for url in requests)
    for context in contexts:
        context.close()


def drop(tab, name: str, content: bytes) -> None:
    tab.evaluate(DROP, [name, content.decode()])


def is_seen(tab, words: str) -> None:
    tab.wait_for_selector(f"text={words}")


def until(tab, script: str) -> None:
    """Wait until a script in the page is true; Playwright's own way needs eval, which the policy of
    the page refuses.
    """
    for _ in range(SLOW // 200):
        if tab.evaluate(script):
            return
        tab.wait_for_timeout(200)
    raise AssertionError(script)


def at_diagram(tab) -> dict[str, float]:
    """The place of the diagram in the window, once it is not drawn anew any more."""
    find = "document.querySelector('#diagram')"
    until(tab, f"(window.drawn === {find}) || !(window.drawn = {find})")
    tab.evaluate(f"{find}.scrollIntoView({{ block: 'center' }})")
    return tab.evaluate(f"{find}.getBoundingClientRect().toJSON()")


def overflow(tab) -> int:
    """Pixels by which the page is wider than its window."""
    return tab.evaluate(
        "document.documentElement.scrollWidth - document.documentElement.clientWidth"
    )


def test_an_engineer_by_mouse(own, visit):
    tab = visit(own)
    assert tab.url == own.base + "/#data"  # the token is gone from the address
    assert tab.locator("#fit").is_hidden()
    drop(tab, "bench.csv", bench_csv())
    tab.wait_for_selector("#diagram circle")
    assert (
        tab.locator("#diagram").get_attribute("aria-label")
        == "Bode diagram of 80 lines from 5 to 300 Hz, bars of 95 %"
    )
    assert tab.locator(".field.assumed label").all_inner_texts() == ["Quantity assumed"]
    tab.select_option("#field-quantity", "velocity")
    tab.wait_for_selector(".field.assumed", state="detached")
    assert "velocity; 80 lines" in tab.locator("#read").inner_text()
    tab.fill("#field-band-1", "200")
    tab.keyboard.press("Tab")
    until(tab, "document.getElementById('diagram')?.getAttribute('aria-label').includes('to 19')")
    for n in (3, 4):
        tab.click(f".masses input[value='{n}']")
    tab.click("#fit button.main")
    tab.wait_for_selector("#answer-title")
    assert tab.evaluate("document.activeElement.id") == "answer-title"
    lines = tab.locator("#answer li").all_inner_texts()
    assert [line.partition(":")[0] for line in lines] == ["Data", "Structure", "Next"]
    assert "2:1+b1+delay explains this data" in lines[1]
    frame = tab.frame_locator("iframe.report")
    assert "explains" in frame.locator("h1").inner_text()
    until(tab, "document.querySelector('iframe.report').clientHeight > 2000")
    frame.locator("#candidates thead button").first.click()  # the page's own script runs
    with tab.expect_download() as saved:
        tab.click("#answer a[href$='model.mat']")
    assert saved.value.suggested_filename == "model.mat"
    assert barriers(tab) == []
    tab.reload()
    tab.wait_for_selector("#answer-title")
    assert tab.input_value("#field-quantity") == "velocity"


def test_a_second_measurement_tests_the_fit_and_what_comes_after_it_is_on_the_page(own, visit):
    tab = visit(own)
    drop(tab, "bench.csv", bench_csv())
    tab.wait_for_selector("#diagram circle")
    tab.select_option("#field-quantity", "velocity")
    tab.wait_for_selector(".field.assumed", state="detached")
    assert tab.locator("#together").is_hidden()
    drop(tab, "again.csv", bench_csv(81))
    is_seen(tab, "What was read: again.csv")
    assert tab.locator("#together").is_visible()  # else somebody adds the data of another machine
    tab.select_option("#role", "test")
    is_seen(tab, "It is read as the first measurement")
    assert tab.locator(".field.assumed").count() == 0
    is_seen(tab, "2. again.csv (test)")
    for n in (1, 3, 4):
        tab.click(f".masses input[value='{n}']")
    tab.click("text=Known values, ranges, controller")
    tab.fill("#fix", "Td=late")
    tab.click("#fit button.main")
    is_seen(tab, "Known values: write them like m1=0.02, Td=0.0003, not Td=late.")
    tab.fill("#fix", "Td=0.0003")
    tab.click("#fit button.main")
    is_seen(tab, "Answer of fit 1: bench.csv")
    (command,) = (found["command"] for found in own.call("fits", {})[1]["fits"])
    assert "--test data/again.csv" in command and "--fix Td=0.0003" in command
    shutil.copytree(own.folder / "fits" / "1", own.folder / "fits" / "2")
    tab.reload()
    is_seen(tab, "Answer of fit 2: bench.csv")
    tab.click("#answer button:has-text('What to measure next')")
    is_seen(tab, "no further measurement is needed to distinguish structures")
    tab.click("#answer button:has-text('Plan: how much more')")
    tab.wait_for_selector("#answer a[href$='plan.html'] >> text=Open the page of the plan")
    tab.click("text=Compare the fits")
    tab.wait_for_selector("#two-fits table")
    is_seen(tab, "Both select the same structure, 2:1+b1+delay.")
    tab.evaluate("document.querySelectorAll('details').forEach((part) => { part.open = true; })")
    assert barriers(tab) == []
    tab.set_viewport_size({"width": 390, "height": 844})
    assert overflow(tab) <= 0
    tab.reload()
    tab.wait_for_selector("#answer .onward h3")
    assert tab.locator("#answer .onward h3").all_inner_texts() == [
        "What to measure next",
        "How much more of the same to measure",
    ]


def test_the_advised_measurement_is_added_with_its_place(own, visit):
    folder = own.folder / "fits" / "1"
    folder.mkdir(parents=True)
    words = {
        "first": "measure next: sensor at mass 2",
        "text": "",
        "warnings": [],
        "command": "disting next x",
        "setup": "sensor=2",
    }
    (folder / "about.json").write_text(json.dumps({"answer": ["Data: fine"], "next": words}))
    (folder / "fit.html").write_text("<title>fit</title>")
    assert own.upload("bench.csv", bench_csv())[0] == 200
    own.call(
        "save",
        {"page": "data", "content": {"measurements": [{"file": "bench.csv", "reading": VELOCITY}]}},
    )
    tab = visit(own)
    with tab.expect_file_chooser() as chooser:
        tab.click("text=Add this measurement (sensor=2)")
    chooser.value.set_files({"name": "second.csv", "mimeType": "text/csv", "buffer": bench_csv(81)})
    is_seen(tab, "What was read: second.csv")
    assert tab.input_value("#place-sensor") == "2"
    is_seen(tab, "only the structures that fit 1 left")
    assert tab.locator(".masses").is_hidden()
    saved = own.call("open", {"page": "data"})[1]["content"]
    assert saved["measurements"][1] == {"file": "second.csv", "reading": VELOCITY, "sensor": "2"}
    assert saved["left"] == 1
    tab.uncheck("#left")
    assert tab.locator(".masses").is_visible()


def test_an_engineer_by_keyboard_stops_a_fit_that_a_closed_page_finds_again(own, visit):
    tab = visit(own)
    with tab.expect_file_chooser() as chooser:  # before the first key: the browser needs a moment
        tab.keyboard.press("Tab")
        assert tab.evaluate("document.activeElement.id") == "tab-data"
        tab.keyboard.press("Tab")
        assert tab.evaluate("document.activeElement.id") == "file"
        tab.keyboard.press("Enter")
    chooser.value.set_files({"name": "bench.csv", "mimeType": "text/csv", "buffer": bench_csv()})
    tab.wait_for_selector("#diagram circle")
    tab.focus("#field-quantity")
    tab.keyboard.type("vel")
    tab.keyboard.press("Tab")
    tab.wait_for_selector(".field.assumed", state="detached")
    tab.focus(".masses input[value='2']")
    tab.keyboard.press("Space")
    assert not tab.is_checked(".masses input[value='2']")
    tab.focus("#fit button.main")
    tab.keyboard.press("Enter")
    until(
        tab, "/Candidates fitted: \\d+ of \\d+/.test(document.querySelector('.progress').innerText)"
    )
    tab.reload()
    tab.wait_for_selector(".progress button:visible")
    tab.focus(".progress button:visible")
    tab.keyboard.press("Enter")
    is_seen(tab, "Stopped.")
    assert tab.locator("#fit button.main").is_enabled()
    assert own.call("fits", {})[1] == {"fits": []}


def test_a_chemist_pastes_a_spectrum(own, visit):
    tab = visit(own)
    tab.click("text=Paste a table")
    tab.fill("#pasted", spectrum_csv(40).decode())
    tab.click("text=Read the table")
    tab.wait_for_selector("#diagram.nyquist circle")
    tab.get_by_role("button", name="Zoom in").click()
    tab.get_by_role("button", name="Move up").click()
    assert shown(tab).startswith("Re Z ")
    assert tab.is_checked("input[name=sort][value=models]")
    tab.click("#fit button.main")
    is_seen(tab, "Name at least one model.")
    tab.fill("#models", "R1-C1\nR0-p(R1,C1)")
    tab.click("#fit button.main")
    tab.wait_for_selector("#answer-title")
    assert "R0-p(R1,C1)" in tab.locator("#answer li").first.inner_text()
    assert barriers(tab) == []


def shown(tab, diagram: str = "#diagram") -> str:
    """The part of a diagram that is shown; empty where all of it is."""
    return tab.locator(diagram).get_attribute("aria-label").partition("; shown: ")[2]


def ends(tab) -> list[float]:
    """Limits of the part that is shown [Hz]."""
    return [float(part) for part in shown(tab).removesuffix(" Hz").split(" to ")]


ZOOMED = "document.getElementById('diagram').getAttribute('aria-label').includes('shown')"


WHEEL = """(() => {
  const diagram = document.getElementById("diagram"), { left, top, width, height } = diagram.getBoundingClientRect();
  const event = new WheelEvent("wheel", { deltaY: -100, clientX: left + width / 2, clientY: top + height / 2, bubbles: true, cancelable: true });
  diagram.dispatchEvent(event);
  return event.defaultPrevented;
})()"""


def test_the_diagram_is_zoomed_by_mouse(app, visit):
    tab = visit(app)
    drop(tab, "bench.csv", bench_csv())
    tab.wait_for_selector("#diagram circle")
    assert not tab.evaluate(WHEEL) and shown(tab) == ""  # a page that scrolls goes on
    box = at_diagram(tab)
    y = box["y"] + box["height"] / 3
    x = [box["x"] + share * box["width"] for share in (0.4, 0.5, 0.6)]
    tab.mouse.move(x[0], y)
    tab.mouse.down()
    tab.mouse.move(x[1], y)
    tab.mouse.move(x[2], y)
    assert tab.locator("#diagram .chosen").count() == 1
    tab.mouse.up()
    until(tab, ZOOMED)
    low, high = ends(tab)
    assert 20 < low < high < 75
    assert tab.locator("#diagram .chosen").count() == 0
    assert tab.evaluate(WHEEL)  # it has the focus since the drag
    assert low < ends(tab)[0] < ends(tab)[1] < high
    tab.mouse.dblclick(x[1], y)
    until(tab, f"!{ZOOMED}")
    tab.mouse.click(x[1], y)  # a click without a drag chooses no range
    assert shown(tab) == ""
    assert barriers(tab) == []


def test_the_diagram_is_zoomed_by_keys_and_buttons(app, visit):
    tab = visit(app, 390)
    drop(tab, "bench.csv", bench_csv())
    tab.wait_for_selector("#diagram circle")
    tab.focus(".zoom")
    for key in ("+", "+", "ArrowRight"):
        tab.keyboard.press(key)
    first = shown(tab)
    assert first.endswith(" Hz")
    tab.keyboard.press("ArrowLeft")
    assert shown(tab) not in ("", first)
    tab.keyboard.press("Escape")
    assert shown(tab) == ""
    buttons = tab.locator("figure", has=tab.locator("#diagram"))
    buttons.get_by_role("button", name="Zoom in").click()
    assert shown(tab) != ""
    assert shown(tab) in tab.locator("#status").inner_text()
    buttons.get_by_role("button", name="Zoom out").click()
    buttons.get_by_role("button", name="Zoom out").click()
    assert shown(tab) == ""
    assert overflow(tab) <= 0


def touch(session, kind: str, *places: tuple[float, float]) -> None:
    """A touch event of the browser itself, with a finger at each place."""
    points = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(places)]
    session.send("Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": points})


def test_two_fingers_zoom_a_diagram_about_their_middle(app, visit):
    tab = visit(app, 390)
    drop(tab, "bench.csv", bench_csv())
    tab.wait_for_selector("#diagram circle")
    box = at_diagram(tab)
    middle, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 3
    fingers = tab.context.new_cdp_session(tab)
    touch(fingers, "Start", (middle - 20, y))
    touch(fingers, "Start", (middle - 20, y), (middle + 20, y))
    for far in (40, 60, 80):
        touch(fingers, "Move", (middle - far, y), (middle + far, y))
    touch(fingers, "End")
    until(tab, ZOOMED)
    low, high = ends(tab)
    assert 10 < low < 35 < high < 150  # a quarter of 5 to 300 Hz, about its middle
    assert 2 < high / low < 4
    assert tab.locator("#diagram .chosen").count() == 0
    assert f"{low:g} to" in tab.locator("#status").inner_text()
    touch(fingers, "Start", (middle - 80, y), (middle + 80, y))
    touch(fingers, "Move", (middle - 10, y), (middle + 10, y))
    touch(fingers, "End")
    until(tab, f"!{ZOOMED}")


def answered(served: Served) -> None:
    """A finished fit of an impedance with two curves, as a fit writes it."""
    folder = served.folder / "fits" / "1"
    folder.mkdir(parents=True)
    f = [10.0**k for k in range(5)]
    Z = [10 + 100 / (1 + 0.02j * x) for x in f]
    line = {
        "frequency": f,
        "re": [z.real for z in Z],
        "im": [z.imag for z in Z],
        "gain": [abs(z) for z in Z],
        "phase": [0.0, -10.0, -40.0, -10.0, 0.0],
    }
    half = [0.02] * 5
    band = {"wide": half, "wide_phase": half, "across_re": half, "across_im": half}
    figure = {
        "kind": "nyquist",
        "title": "",
        "unit": "Ω",
        "measured": [{"name": "data", **line, "wide": half}],
        "curves": [{"name": "R0-p(R1,C1)", **line, **band}, {"name": "R0-p(R1,P1)", **line}],
    }
    (folder / "figures.json").write_text(json.dumps({"figures": [figure]}))
    request = {"models": ["R0-p(R1,C1)"], "measurements": [{"file": "eis.csv", "reading": {}}]}
    about = {"answer": ["Data: fine"], "request": request}
    (folder / "about.json").write_text(json.dumps(about))
    (folder / "fit.html").write_text(
        "<!DOCTYPE html><html lang='en'><title>fit</title><h1>fit</h1>"
    )


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (390, "dark")])
def test_the_answers_diagrams_are_zoomed_and_their_curves_hidden(own, visit, width, scheme):
    answered(own)
    tab = visit(own, width, scheme)
    nyquist, bode = "#answer-diagram-0", "#answer-diagram-1"
    tab.wait_for_selector(f"{bode} path.curve", state="attached")
    assert tab.locator(f"{nyquist} path.curve").count() == 2
    assert tab.locator(f"{nyquist} path.band").count() == 1
    assert tab.locator(f"{bode} path.curve").count() == 4  # amplitude and phase
    label = tab.locator(bode).get_attribute("aria-label")
    assert label.endswith("bars of 95 %, with R0-p(R1,C1), R0-p(R1,P1)")
    tab.locator("#answer .zoom").nth(1).focus()
    for key in ("+", "+", "ArrowRight"):
        tab.keyboard.press(key)
    assert shown(tab, bode).endswith(" Hz") and shown(tab, nyquist) == ""
    ticks = tab.locator(f"{bode} .axes text").all_text_contents()
    assert "1" not in ticks and "100" in ticks  # the axis is drawn anew
    tab.locator("#answer figure").nth(1).get_by_role("checkbox", name="R0-p(R1,P1)").uncheck()
    assert tab.locator(f"{bode} path.curve").count() == 2
    assert shown(tab, bode).endswith(" Hz")
    tab.locator("#answer").get_by_role("button", name="Zoom in").first.click()
    assert shown(tab, nyquist).startswith("Re Z ")
    assert tab.get_by_text("Add another measurement").count() == 0
    assert "fitted to one measurement" in tab.locator("#answer").inner_text()
    assert barriers(tab) == []
    assert overflow(tab) <= 0


def test_diagrams_that_cannot_be_read_leave_the_rest_of_the_answer(own, visit):
    answered(own)
    path = own.folder / "fits" / "1" / "figures.json"
    broken = [[], {"figures": [1]}, {"figures": [{"kind": "bode", "measured": [], "curves": [{}]}]}]
    for content in (*broken, {"figures": 5}):
        path.write_text(json.dumps(content))
        tab = visit(own)
        is_seen(tab, "Answer of fit 1: eis.csv")
        tab.wait_for_selector("#answer button:has-text('What to measure next')")
        if content:
            is_seen(tab, "The diagrams of this fit cannot be shown")


def test_the_page_of_a_fit_is_shown_without_an_empty_tail(own, visit):
    answered(own)
    words = "<p>" + "one two three four five " * 400
    (own.folder / "fits" / "1" / "fit.html").write_text(f"<!DOCTYPE html><title>fit</title>{words}")
    tab = visit(own, 390)
    frame = "document.querySelector('iframe.report')"
    until(tab, f"{frame}?.clientHeight > 1000")
    tall = tab.evaluate(f"{frame}.clientHeight")
    tab.set_viewport_size({"width": 1280, "height": 800})
    until(tab, f"{frame}.clientHeight < {tall} / 2")
    content = tab.evaluate(f"{frame}.contentDocument.documentElement.offsetHeight")
    assert 0 <= tab.evaluate(f"{frame}.clientHeight") - content <= 4


def test_what_cannot_be_read_is_said_and_the_way_back_is_there(own, visit):
    tab = visit(own)
    drop(tab, "letter.csv", b"Dear Sir,\nthank you.\n")
    tab.wait_for_selector("#read .warning")
    assert "letter.csv" in tab.locator("#read .warning").inner_text()
    assert tab.locator("#fit").is_hidden()
    drop(tab, "bench.csv", bench_csv())
    tab.wait_for_selector("#diagram circle")
    tab.fill("#field-band-0", "many")
    tab.keyboard.press("Tab")
    is_seen(tab, "Band from: many is no number.")
    tab.fill("#field-band-0", "250")
    tab.fill("#field-band-1", "20")
    is_seen(tab, "the band begins at 250 Hz and ends at 20 Hz; swap them")
    tab.click("text=Read it without these settings")
    tab.wait_for_selector("#diagram circle")


@pytest.mark.parametrize(
    ("width", "scheme"),
    [
        (1280, "light"),
        (390, "dark"),
        pytest.param(1280, "dark", marks=pytest.mark.slow),  # colours do not depend on the width
        pytest.param(390, "light", marks=pytest.mark.slow),
    ],
)
def test_nothing_keeps_people_out_and_nothing_is_wider_than_the_window(app, visit, width, scheme):
    tab = visit(app, width, scheme)
    drop(tab, "bench.csv", bench_csv())
    tab.wait_for_selector("#diagram circle")
    tab.evaluate("document.querySelectorAll('details').forEach((part) => { part.open = true; })")
    assert barriers(tab) == []
    assert overflow(tab) <= 0


def test_a_name_with_markup_is_shown_as_it_is(own, visit):
    tab = visit(own)
    drop(
        tab,
        "x' onerror='alert(1).csv",
        bench_csv().replace(b"Re,", b"<img src=x onerror=alert(1)>,"),
    )
    is_seen(tab, "What was read: x' onerror='alert(1).csv")
    assert tab.locator("main img").count() == 0


def test_the_page_of_a_stranger_runs_nothing(own, browser):
    folder = own.folder / "fits" / "1"
    folder.mkdir(parents=True)
    (folder / "fit.html").write_text(
        "<title>before</title><script>document.title = 'run'</script><img src=x onerror=\"document.title = 'run'\">"
    )
    context = browser.new_context()
    tab = context.new_page()
    tab.goto(own.first_address)
    tab.goto(own.base + "/project/fits/1/fit.html")
    assert re.fullmatch("before", tab.title())
    context.close()
