"""Two machines in motion: what the page computes is what Python computes, what it says is what the
catalogue says, and everyone can drive it.
"""

import json
import re
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lsim

from disting.catalogs import catalog
from disting.equivalence import explicit_map
from disting.equivalence.theorems import images
from disting.fit.search.cost import Cost
from disting.fit.search.estimate import Task
from disting.fit.search.exchange import estimates
from disting.fit.search.plant import Plant
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.model.family import Family
from disting.report import write_report
from disting.report.motion import motion_page, start_values
from disting.report.search import families
from disting.report.write import _files
from disting.verdict.result import Relation, View
from tests.report.links import follow_link

pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
SMALL, LARGER = "motion-3-damped.html", "motion-4-undamped.html"
FAMILIES = [Family(n, damped) for n in (2, 3, 4, 5) for damped in (False, True)]
NEXT_FRAME = "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
PATIENT = 120_000  # ms: the machine that tests may be busy


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    write_report([catalog(3, damped=True)], folder)
    (folder / LARGER).write_text(motion_page(catalog(4, damped=False)), encoding="utf-8")
    return folder


def drawn(chain: Chain, rng: np.random.Generator) -> np.ndarray:
    """Values around those that the page begins with."""
    return np.array(start_values(chain)) * np.exp(rng.uniform(-1, 1, len(chain.parameters)))


def asked(chain: Chain) -> list[object]:
    """Arguments of the page's `chainOf`."""
    return [chain.n_masses, chain.damped, list(chain.indices[1:])]


def response(chain: Chain, values: np.ndarray, omega: np.ndarray) -> np.ndarray:
    return Plant(chain.structure, omega).response(np.asarray(values, dtype=float))


def complex_of(pairs: list[list[float]]) -> np.ndarray:
    return np.array([complex(*pair) for pair in pairs])


def wait_for(tab, selector: str, words: str) -> None:  # type: ignore[no-untyped-def]
    tab.wait_for_function(
        "([at, words]) => document.querySelector(at).textContent.includes(words)",
        arg=[selector, words],
        timeout=PATIENT,
    )


# ---- what is computed


@pytest.mark.full
def test_frequency_responses_are_those_of_python(visit) -> None:  # type: ignore[no-untyped-def]
    rng, omega = np.random.default_rng(1), np.geomspace(0.5, 80, 12)
    models = [(chain, drawn(chain, rng)) for family in FAMILIES for chain in family.models]
    found = visit(SMALL).evaluate(
        """([models, omega]) => models.map(([chain, values]) => {
          const given = chainOf(...chain), solver = createSolver(given), parts = partsOf(given, values);
          return [given.names, omega.map((w) => solver.response(parts, 0, w))];
        })""",
        [[[asked(chain), values.tolist()] for chain, values in models], omega.tolist()],
    )
    for (chain, values), (names, pairs) in zip(models, found, strict=True):
        assert tuple(names) == chain.parameters
        np.testing.assert_allclose(complex_of(pairs), response(chain, values, omega), rtol=1e-9)


MAPPED = """(pairs) => pairs.map(([given, other, values]) => mapped(chainOf(...given), chainOf(...other), values))"""


def _mapped(
    tab, family: Family, rng: np.random.Generator
) -> list[tuple[Chain, Chain, np.ndarray, list[float] | None]]:  # type: ignore[no-untyped-def]
    pairs = [(a, b, drawn(a, rng)) for a in family.models for b in family.models if a != b]
    found = tab.evaluate(MAPPED, [[asked(a), asked(b), values.tolist()] for a, b, values in pairs])
    return [(*pair, values) for pair, values in zip(pairs, found, strict=True)]


def _exact(given: Chain, other: Chain, values: np.ndarray) -> np.ndarray | None:
    found = explicit_map(given, other)
    if found is None:
        return None
    at = found.at(dict(zip(given.parameters, map(str, values), strict=True)))
    return np.array([float(Fraction(str(at[name]))) for name in other.parameters])


@pytest.mark.full
@pytest.mark.parametrize(
    ("masses", "expected"),
    [(2, [2, 2]), (3, [12, 6]), pytest.param(4, [18, 18], marks=pytest.mark.slow)],
)
def test_mapped_values_are_those_of_the_formulas(visit, masses: int, expected: list[int]) -> None:  # type: ignore[no-untyped-def]
    """All pairs of up to 3 masses; of 4 those of symmetries and duality. A formula is known to
    the page exactly where it is to Python.
    """
    tab, rng, counts = visit(SMALL), np.random.default_rng(2), []
    for family in (Family(masses, damped=False), Family(masses, damped=True)):
        counts.append(0)
        for given, other, values, found in _mapped(tab, family, rng):
            if masses > 3 and other not in _renamed_or_dual(given):
                continue
            exact = _exact(given, other, values)
            assert (exact is None) == (found is None), (given, other)
            if exact is not None:
                np.testing.assert_allclose(found, exact, rtol=1e-9)
                counts[-1] += 1
    assert counts == expected


@cache
def _renamed_or_dual(given: Chain) -> frozenset[Chain]:
    return frozenset(i.chain for i in images(given, dict.fromkeys(given.parameters, 1.0)))


@pytest.mark.full
@pytest.mark.parametrize("masses", [4, pytest.param(5, marks=pytest.mark.slow)])
def test_mapped_values_give_the_same_response(visit, masses: int) -> None:  # type: ignore[no-untyped-def]
    tab, rng, omega = visit(SMALL), np.random.default_rng(3), np.geomspace(0.5, 60, 9)
    for family in (Family(masses, damped=False), Family(masses, damped=True)):
        for given, other, values, found in _mapped(tab, family, rng):
            if found is not None:
                assert min(found) > 0
                ours, theirs = response(given, values, omega), response(other, found, omega)
                np.testing.assert_allclose(theirs, ours, rtol=1e-9)


@pytest.mark.slow
def test_mapped_values_are_those_of_continued_fractions_of_four_masses(visit) -> None:  # type: ignore[no-untyped-def]
    for given, other, values, found in _mapped(
        visit(SMALL), Family(4, damped=False), np.random.default_rng(4)
    ):
        exact = _exact(given, other, values)
        assert (exact is None) == (found is None), (given, other)
        if exact is not None:
            np.testing.assert_allclose(found, exact, rtol=1e-9)


MOVED = """([chain, values, force, dt]) => {
  const given = chainOf(...chain), found = moved(given, partsOf(given, values), Float64Array.from(force), dt);
  return { acceleration: [...found.acceleration], distance: [...found.distance], places: [...found.places] };
}"""


def _state_space(chain: Chain, values: np.ndarray) -> tuple[np.ndarray, ...]:
    """x'' = M^-1 (e F - K x - D x'), and the acceleration at the sensor."""
    n, named = chain.n_masses, dict(zip(chain.parameters, values, strict=True))
    stiff = {"k": np.zeros((n, n)), "d": np.zeros((n, n))}
    for element in chain.structure.elements:
        if element.kind in stiff:
            v = np.zeros(n + 1)
            v[element.at], v[element.at + 1] = -1, 1
            stiff[element.kind] += named[element.parameter] * np.outer(v[1:], v[1:])
    mass = np.array([named[f"m{i}"] for i in range(1, n + 1)])
    ends = np.zeros((2, n + 1))
    ends[0, chain.act_plus], ends[1, chain.meas_plus] = 1, 1
    ends[0, chain.act_minus], ends[1, chain.meas_minus] = -1, -1
    push, see = ends[0, 1:] / mass, ends[1, 1:]
    below = np.hstack([-stiff["k"] / mass[:, None], -stiff["d"] / mass[:, None]])
    a = np.vstack([np.hstack([np.zeros((n, n)), np.eye(n)]), below])
    return (
        a,
        np.concatenate([np.zeros(n), push])[:, None],
        (see @ below)[None],
        np.array([[see @ push]]),
    )


@pytest.mark.full
def test_the_motion_is_that_of_the_state_space(visit) -> None:  # type: ignore[no-untyped-def]
    tab, dt = visit(SMALL), 0.02
    force = np.sin(np.arange(400) ** 2 / 2000) + (np.arange(400) < 90)
    for chain in (
        Chain(3, 0, 0, 1, 0, 2, damped=True),
        Chain(4, 2, 1, 3, 2, 4, damped=False),
        Chain(5, 1, 1, 2, 1, 5, damped=True),
    ):
        values = drawn(chain, np.random.default_rng(5))
        found = tab.evaluate(MOVED, [asked(chain), values.tolist(), force.tolist(), dt])
        _, expected, _ = lsim(_state_space(chain, values), force, dt * np.arange(400))
        close = 1e-9 * np.abs(expected).max()
        np.testing.assert_allclose(found["acceleration"], expected, atol=close, err_msg=str(chain))
        free = np.array(found["places"]).reshape(400, -1)[:, chain.gap :]
        mass = values[chain.gap : chain.n_masses]
        assert np.abs(free @ mass).max() < 1e-9 * np.abs(free).max()  # its centre stays in place


@pytest.mark.full
def test_twins_show_the_same_over_time(visit) -> None:  # type: ignore[no-untyped-def]
    tab, family, force = visit(SMALL), Family(3, damped=True), [10.0] * 300 + [0.0] * 300
    rng = np.random.default_rng(6)
    for a, b in ((1, 11), (11, 1), (2, 5), (9, 10)):
        values = drawn(family[a], rng)
        (other,) = tab.evaluate(MAPPED, [[asked(family[a]), asked(family[b]), values.tolist()]])
        runs = [
            tab.evaluate(MOVED, [asked(chain), of, force, 0.02])
            for chain, of in ((family[a], values.tolist()), (family[b], other))
        ]
        for shown in ("acceleration", "distance"):
            one, two = (np.array(run[shown]) for run in runs)
            np.testing.assert_allclose(two, one, atol=1e-9 * np.abs(one).max())


IMITATED = """([given, other, values, usual]) => {
  const a = chainOf(...given), b = chainOf(...other), [low, high] = createSecond(() => 0).band(a, values), task = createTask(a, values, b, low, high);
  const all = startsOf(task, usual, 6).map((start) => descended(task, start)), best = all.sort((p, q) => p.cost - q.cost)[0];
  return { ...best, low, high, most: partedMost(task, best.values) };
}"""


def _imitated(tab, given: Chain, other: Chain) -> dict[str, object]:  # type: ignore[no-untyped-def]
    values = [list(start_values(chain)) for chain in (given, other)]
    return tab.evaluate(IMITATED, [asked(given), asked(other), *values])


def _cost(found: dict[str, object], given: Chain) -> Cost:
    omega = np.geomspace(found["low"], found["high"], 400)
    return Cost(FrequencyResponse(omega, response(given, start_values(given), omega)))


@pytest.mark.full
def test_the_cost_of_an_imitation_and_where_it_parts_most(visit) -> None:  # type: ignore[no-untyped-def]
    """The cost is (14) at the same frequencies; where both part most is looked for on a fine grid."""
    given, other = Family(3, True)[1], Family(3, True)[4]
    found = _imitated(visit(SMALL), given, other)
    cost = _cost(found, given)
    total = cost.total(response(other, found["values"], cost.measured.omega))
    assert total == pytest.approx(found["cost"], rel=1e-9)
    fine = np.geomspace(found["low"], found["high"], 50_001)
    ratio = response(other, found["values"], fine) / response(given, start_values(given), fine)
    apart = 20 * np.log10(np.abs(ratio))
    worst = np.abs(apart).argmax()
    assert found["most"]["decibels"] == pytest.approx(apart[worst], rel=1e-5)
    assert found["most"]["omega"] == pytest.approx(fine[worst], rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("left", "right"), [(1, 4), (4, 1), (6, 2), (8, 3)])
def test_an_imitation_is_as_good_as_that_of_a_fit(visit, left: int, right: int) -> None:  # type: ignore[no-untyped-def]
    given, other = Family(3, True)[left], Family(3, True)[right]
    found = _imitated(visit(SMALL), given, other)
    assert found["cost"] <= 1.001 * estimates([other], Task(_cost(found, given)))[other].j


@pytest.mark.full
def test_no_resonance_is_hidden_between_two_lines(visit) -> None:  # type: ignore[no-untyped-def]
    """The least cost at 400 lines has a resonance without damping between two of them: 47 dB."""
    given, other = Family(5, True)[9], Family(5, True)[32]
    values = [list(start_values(chain)) for chain in (given, other)]
    spiked, found = visit(SMALL).evaluate(
        """([given, other, values, usual]) => {
          const a = chainOf(...given), b = chainOf(...other), [low, high] = createSecond(() => 0).band(a, values);
          const [coarse, fine] = [80, 400].map((lines) => createTask(a, values, b, low, high, { lines }));
          const starts = startsOf(fine, usual, 24).map((start) => descended(coarse, start, { rounds: 40, least: 1e-4 }));
          const refined = starts.sort((p, q) => p.cost - q.cost).slice(0, 3).map((one) => descended(fine, one.unknowns));
          const best = refined.sort((p, q) => p.cost - q.cost)[0];
          return [best, withoutSpikes(fine, best)].map((one) => [one.values, low, high]);
        }""",
        [asked(given), asked(other), *values],
    )

    def worst(values: list[float], low: float, high: float, lines: int) -> float:
        omega = np.geomspace(low, high, lines)
        ratio = response(other, np.array(values), omega) / response(
            given, start_values(given), omega
        )
        return float(np.abs(20 * np.log10(np.abs(ratio))).max())

    assert worst(*spiked, 50_001) > 40 > 30 > worst(*spiked, 400)
    assert worst(*found, 50_001) < 30


# ---- what is said


def _data(text: str) -> dict[str, list[object]]:
    return json.loads(re.search(r'id="data">(.*?)</script>', text)[1])  # type: ignore[index]


@pytest.mark.parametrize(
    ("masses", "damped", "count"), [(3, True, 0), (3, False, 7), (4, False, 38)]
)
def test_the_page_knows_which_verdicts_leave_special_values_aside(masses, damped, count) -> None:  # type: ignore[no-untyped-def]
    """As the verdicts say, and as the page says of the first pair."""
    c = catalog(masses, damped=damped)
    pairs = [
        [low, high]
        for low, high, v in c.pairs(View.POSITIVE)
        if v.relation is Relation.INDISTINGUISHABLE and v.has_exceptions
    ]
    assert sorted(_data(motion_page(c))["aside"]) == pairs and len(pairs) == count


@pytest.mark.full
def test_a_pair_says_that_special_values_are_left_aside(visit) -> None:  # type: ignore[no-untyped-def]
    low, high = next(
        (low, high)
        for low, high, v in catalog(4, damped=False).pairs(View.POSITIVE)
        if v.has_exceptions
    )
    said = visit(LARGER + f"#A{high}-A{low}").inner_text("#verdict")
    assert said.startswith(f"Whatever the positive parameters of A{high}, special values aside,")


def test_the_page_knows_every_verdict() -> None:
    data = _data(motion_page(catalog(4, damped=False)))
    assert data["groups"] == [list(group) for group in catalog(4, damped=False).classes()]
    assert [2, 6, "always"] in data["able"] and [6, 2, "sometimes"] in data["able"]
    assert len(data["able"]) == 6 and data["open"] == []
    assert data["models"] == [list(chain.indices[1:]) for chain in Family(4, damped=False).models]


def test_first_values_are_not_special() -> None:
    """Neither equal masses nor equal ratios k/d, which would make more models equivalent."""
    chain = Chain(5, damped=True)
    named = dict(zip(chain.parameters, start_values(chain), strict=True))
    ratios = [named[f"k{i}{i + 1}"] / named[f"d{i}{i + 1}"] for i in range(1, 5)]
    assert len(set(ratios)) == 4 and len({named[f"m{i}"] for i in range(1, 6)}) == 5


@pytest.mark.full
def test_a_catalogue_of_one_model_has_no_page() -> None:
    names = {
        name
        for n in (1, 2)
        for name, _ in _files(
            catalog(n, damped=False), families([catalog(n, damped=False)], (), ())
        )
    }
    assert "motion-2-undamped.html" in names and "motion-1-undamped.html" not in names


@pytest.mark.full
def test_twins_follow_by_formulas(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#A1-A11")
    assert tab.text_content("#pair").startswith("A1 and A11")
    assert "no experiment with this force and sensor" in tab.inner_text("#verdict")
    assert "special values" not in tab.inner_text("#verdict")
    assert "by formulas" in tab.inner_text("#how")
    assert tab.locator("path.most").count() == 0
    before = tab.locator("#values tbody >> nth=1").inner_text()
    tab.locator('#values input[aria-label="k12 of A1"]').fill("0.5")
    wait_for(tab, "#values tbody", "474.3 N/m")
    exact = explicit_map(Family(3, True)[1], Family(3, True)[11])
    assert exact is not None
    names = Family(3, True)[1].parameters
    given = dict(zip(names, map(str, start_values(Family(3, True)[1])), strict=True))
    at = exact.at({**given, "k12": str(150 * 10**0.5)})
    after = tab.locator("#values tbody >> nth=1").inner_text()
    assert before != after and f"{float(Fraction(str(at['k01']))):.4g} N/m" in after


@pytest.mark.full
def test_the_mark_stands_where_the_curves_part_most(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#A1-A4")
    wait_for(tab, "#how", "Best values found")
    words = re.search(r"up to ([\d.]+) dB at ([\d.]+) Hz", tab.inner_text("#how"))
    found = tab.evaluate(
        IMITATED,
        [asked(Family(3, True)[i]) for i in (1, 4)]
        + [list(start_values(Family(3, True)[i])) for i in (1, 4)],
    )
    assert words
    assert float(words[1]) == pytest.approx(abs(found["most"]["decibels"]), rel=0.02)
    assert float(words[2]) == pytest.approx(found["most"]["omega"] / (2 * np.pi), rel=0.01)
    line = tab.locator("path.most").get_attribute("d")
    frame = tab.locator("#bode .frame >> nth=0").evaluate(
        "(e) => [e.x, e.width].map((v) => v.baseVal.value)"
    )
    share = np.log(found["most"]["omega"] / found["low"]) / np.log(found["high"] / found["low"])
    at = float(re.match(r"M([\d.]+)", line)[1])  # type: ignore[index]
    assert at == pytest.approx(frame[0] + frame[1] * share, abs=1)
    assert "dB apart" in tab.text_content("#bode text.most")


@pytest.mark.full
def test_values_that_are_not_positive_are_said_at_once(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(LARGER + "#A2-A6")
    wait_for(tab, "#how", "give the same response up to rounding")
    tab.click("#swap")
    assert "give the same response up to rounding" in tab.inner_text("#how")
    assert tab.locator("#values tr.fails").count() == 0
    for place in np.linspace(-0.7, -1, 7):
        tab.locator('#values input[aria-label="m1 of A6"]').fill(f"{place:.3f}")
        tab.evaluate(NEXT_FRAME)
        if tab.locator("#values tr.fails").count():
            break
    assert "not positive, which no machine has" in tab.inner_text("#how")
    failing = tab.locator("#values tr.fails").all_inner_texts()
    assert failing and all("−" in row and "not positive" in row for row in failing)
    for row in failing:
        assert row.split()[0] in tab.inner_text("#how")
    assert "cannot be built" in tab.inner_text("#two-how")


# ---- how it is driven


@pytest.mark.full
def test_links_lead_there(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("chains-3-damped.html#1-4")
    follow_link(tab, '#detail [data-slot="link"] a')
    assert tab.url.endswith(SMALL + "#A1-A4")
    tab = visit("models/3-damped/11.html")
    follow_link(tab, "text=both in motion")
    assert tab.url.endswith(SMALL + "#A11-A1")
    tab = visit("index.html")
    follow_link(tab, "text=See two machines in motion")
    assert tab.url.endswith(SMALL + "#A1-A11")
    follow_link(tab, "#one-name")
    assert tab.inner_text("h1").startswith("Model A1")


@pytest.mark.full
def test_wrong_addresses_show_the_first_pair_and_say_so(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#A1-A99")
    for wrong in ("", "#A3-A3", "#x", "#A1", "#4:1-4:2"):
        assert tab.text_content("#pair").startswith("A1 and A11"), wrong
        assert "names no pair here: there are the models 3:1 to 3:11" in tab.inner_text("#trouble")
        tab.evaluate(
            """(hash) => new Promise((done) => {
              addEventListener("hashchange", () => setTimeout(done), { once: true });
              location.hash = hash || "#none";
            })""",
            wrong,
        )
    assert tab.text_content("#pair").startswith("A1 and A11")
    tab.click("#after")
    assert tab.inner_text("#trouble") == ""
    visit(SMALL + "#3:1-3:A4")
    assert tab.text_content("#pair").startswith("A1 and A4")
    assert tab.inner_text("#trouble") == ""


@pytest.mark.full
def test_keys_of_the_presentation(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#A1-A11,present")
    assert tab.is_visible("#bode") and not tab.is_visible("h1") and not tab.is_visible("#values")
    tab.keyboard.press("ArrowRight")
    assert tab.url.endswith("#A2-A5,present")
    tab.keyboard.press("PageUp")
    assert tab.url.endswith("#A1-A11,present")
    tab.keyboard.press("x")
    assert tab.url.endswith("#A11-A1,present")
    tab.keyboard.press(" ")
    assert tab.inner_text("#play") == "Pause"
    tab.keyboard.press(" ")
    assert tab.inner_text("#play") == "Play"
    tab.keyboard.press("b")
    tab.keyboard.press("p")
    assert not tab.is_visible("#bode") and tab.is_visible("#values")
    tab.keyboard.press("3")
    assert tab.is_visible("#frequency")
    tab.keyboard.press("f")
    tab.wait_for_function("() => document.fullscreenElement")
    tab.keyboard.press("f")
    tab.wait_for_function("() => !document.fullscreenElement")
    tab.keyboard.press("?")
    assert tab.is_visible("#keys") and "next pair" in tab.inner_text("#keys")
    tab.keyboard.press("Escape")
    assert not tab.is_visible("#keys") and tab.url.endswith(",present")
    tab.keyboard.press("Escape")
    assert tab.is_visible("h1") and tab.url.endswith("#A11-A1")
    tab.keyboard.press("b")
    assert tab.is_visible("#bode")  # keys are those of the presentation


@pytest.mark.full
def test_it_moves_and_pauses(tab, visit) -> None:  # type: ignore[no-untyped-def]
    tab.emulate_media(reduced_motion="no-preference")
    visit(SMALL + "#A1-A11")
    first = tab.locator("#one [data-part='m1'] rect").get_attribute("x")
    tab.wait_for_function(
        "(x) => document.querySelector(\"#one [data-part='m1'] rect\").getAttribute('x') !== x",
        arg=first,
    )
    tab.click("#play")
    still = tab.input_value("#time")
    tab.evaluate(NEXT_FRAME)
    assert tab.input_value("#time") == still and float(still) > 0


@pytest.mark.full
def test_less_motion_is_respected(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    tab.evaluate(NEXT_FRAME)
    assert tab.inner_text("#play") == "Play" and float(tab.input_value("#time")) == 0
    tab.click("#play")
    tab.wait_for_function("() => +document.getElementById('time').value > 0")


@pytest.mark.full
def test_the_pages_stay_small(site: Path) -> None:
    assert (site / SMALL).stat().st_size < 120_000
