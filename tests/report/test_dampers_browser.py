"""Pages of families with ground dampers in a real browser: what the script looks up is what
Python does, and people find it.
"""

from dataclasses import replace
from itertools import combinations, permutations
from pathlib import Path

import numpy as np
import pytest

from disting.catalogs import catalog
from disting.catalogs.dampers import DamperFamily, DamperSets, damper_catalog
from disting.conditions.rule import EXACT
from disting.model.family import Family
from disting.report import damper_page, write_report
from disting.verdict.classes import Classes
from tests.report.links import follow_link

pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
CURSOR = '[role="gridcell"]'
SMALL, LARGE, START = "dampers-3-damped.html", "dampers-5-undamped.html", "index.html"
PAIR = SMALL + "#2+b1+b2/5+b1+b2+b3"
CODES = {"distinguishable": 0, "indistinguishable": 1, "undecided": 3}
BLUE, ORANGE = "0,114,178", "240,168,24"
LOOK_UP = """(pairs) => {
  const classes = createClasses(JSON.parse(document.getElementById("data").textContent));
  return pairs.map(([i, j]) => [classes.relation(i, j), classes.rule(i, j)]);
}"""


@pytest.fixture(scope="module")
def small() -> DamperFamily:
    return damper_catalog(3, damped=True)


@pytest.fixture(scope="module")
def undamped() -> DamperFamily:
    return damper_catalog(3, damped=False)


@pytest.fixture(scope="module")
def large() -> DamperFamily:
    """2336 models in made-up classes, in which every rule occurs, unknown buckets and open
    pairs.
    """
    family, sets, random = Family(5, damped=False), DamperSets.ALL.of(5), np.random.default_rng(5)
    chains = tuple(replace(chain, ground_dampers=masses) for chain in family for masses in sets)
    structure = np.repeat(np.arange(len(family)), len(sets))
    group = (structure // 2 * 9 + random.integers(0, 9, len(chains))).astype(np.int32)
    buckets = random.choice([-1, 0, 1, 2], (9 * len(family), 9), p=[0.1, 0.8, 0.06, 0.04]).astype(
        np.int32
    )
    rank = random.integers(10, 12, len(chains)).astype(np.int32)
    classes = Classes(
        chains=chains,
        tests=(*"12345345", EXACT.name),
        columns=buckets[group],
        group=group,
        renamed=(group * 12 + random.integers(0, 12, len(chains))).astype(np.int32),
        free=np.where(
            random.random(len(chains)) < 0.3, random.integers(0, 2, len(chains)), -1
        ).astype(np.int32),
        rank=rank,
        open_groups=frozenset(
            p for p in combinations(sorted(set(group.tolist())), 2) if random.random() < 0.05
        ),
    )
    return DamperFamily(family, sets, classes)


@pytest.fixture(scope="module")
def site(
    tmp_path_factory: pytest.TempPathFactory,
    small: DamperFamily,
    undamped: DamperFamily,
    large: DamperFamily,
) -> Path:
    folder = tmp_path_factory.mktemp("site")
    write_report([catalog(3, damped=True)], folder, [small])
    (folder / LARGE).write_text(damper_page(large), encoding="utf-8")
    (folder / "dampers-3-undamped.html").write_text(damper_page(undamped), encoding="utf-8")
    return folder


def _settle(tab) -> None:  # type: ignore[no-untyped-def]
    tab.evaluate(
        "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
    )


def _look_up(found: DamperFamily, pairs: list[tuple[int, int]]) -> list[list[object]]:
    told = (found.found.look_up(i, j) for i, j in pairs)
    return [[CODES[relation.value], rule] for relation, rule in told]


def _field(tab, row: int, column: int) -> dict[str, float]:  # type: ignore[no-untyped-def]
    """A place in a field, counted from 1, near its upper left corner, as seen from the window."""
    _settle(tab)
    box, of = (
        tab.locator("#matrix").bounding_box(),
        tab.locator("#matrix").evaluate("e => ({ ...e.dataset })"),
    )
    side, gutter = float(of["cell"]), float(of["gutter"])
    at = {
        k: gutter + float(of[edge]) + (n - 0.7) * side
        for k, edge, n in (("x", "left", column), ("y", "top", row))
    }
    return {"x": box["x"] + at["x"], "y": box["y"] + at["y"]}


def _colours(tab, fields: list[tuple[int, int]]) -> list[str]:  # type: ignore[no-untyped-def]
    """Colours of fields (row, column), counted from 1, near their upper left corners."""
    _settle(tab)
    found = tab.evaluate(
        """(fields) => {
          const canvas = document.querySelector("#matrix canvas"), of = canvas.parentElement.dataset;
          const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
          copy.drawImage(canvas, 0, 0);
          const at = (from, n) => Math.round(+of.gutter + +from + (n - 0.7) * of.cell);
          const one = ([row, column]) => copy.getImageData(at(of.left, column), at(of.top, row), 1, 1).data;
          return fields.map((field) => String(one(field).slice(0, 3)));
        }""",
        fields,
    )
    return [{BLUE: "blue", ORANGE: "orange"}.get(colour, "dim") for colour in found]


@pytest.mark.full
def test_look_ups_are_pythons(visit, small: DamperFamily, undamped: DamperFamily) -> None:  # type: ignore[no-untyped-def]
    pairs = list(permutations(range(88), 2))[::5]
    for name, found in ((SMALL, small), ("dampers-3-undamped.html", undamped)):
        assert visit(name).evaluate(LOOK_UP, pairs) == _look_up(found, pairs)


@pytest.mark.full
def test_look_ups_in_thousands_of_models_are_pythons(visit, large: DamperFamily) -> None:  # type: ignore[no-untyped-def]
    random = np.random.default_rng(1)
    pairs = [(int(i), int(j)) for i, j in random.integers(0, 2336, (1500, 2)) if i != j]
    near = [
        (int(i), int(i + d))
        for i, d in zip(random.integers(0, 2240, 1500), random.integers(1, 96, 1500), strict=True)
    ]
    expected = _look_up(large, pairs + near)
    assert {rule for _, rule in expected} == {"", "exact", *"123456789"} and {
        code for code, _ in expected
    } == {0, 1, 3}
    assert visit(LARGE).evaluate(LOOK_UP, pairs + near) == expected


@pytest.mark.full
def test_a_page_of_thousands_of_models_is_small(site: Path) -> None:
    assert (site / LARGE).stat().st_size < 500_000


@pytest.mark.slow
def test_a_page_of_thousands_of_models_is_fluid(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(LARGE)
    timed = """(selector) => new Promise((done) => {
      const from = performance.now();
      document.querySelector(selector).click();
      requestAnimationFrame(() => setTimeout(() => done(performance.now() - from)));
    })"""
    for selector in ("[data-zoom=in]", "[value=group]"):
        # milliseconds, on a busy machine too
        assert min(tab.evaluate(timed, selector) for _ in range(3)) < 400


@pytest.mark.full
def test_a_click_shows_names_drawings_rule_and_command(visit, small: DamperFamily) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    low, high = small.place((2, (1, 2))), small.place((5, (2, 3)))
    assert small.look_up((2, (1, 2)), (5, (2, 3)))[0].value == "indistinguishable"
    tab.evaluate("document.getElementById('matrix').scrollIntoView({behavior: 'instant'})")
    tab.mouse.click(**_field(tab, high + 1, low + 1))
    assert tab.inner_text("#detail h3") == "A2+b1+b2 and A5+b2+b3"
    assert tab.inner_text("#detail .badge") == "indistinguishable"
    rule = small.look_up((2, (1, 2)), (5, (2, 3)))[1]
    assert ("the exact decision" if rule == "exact" else f"condition {rule}") in tab.inner_text(
        "#detail .badges"
    )
    uses = tab.eval_on_selector_all(
        '#detail svg[data-slot="left"] use', "all => all.map(u => u.getAttribute('href'))"
    )
    assert uses == ["#chain-2", "#ground-1", "#ground-2"]
    box = tab.locator('#detail svg[data-slot="right"]').bounding_box()
    assert box["width"] > 150 and 80 < box["height"] < 140
    assert "damper from mass 3 to the ground" in tab.get_attribute(
        '#detail svg[data-slot="right"]', "aria-label"
    )
    assert tab.text_content("#detail code") == "disting compare 3:2+b1+b2 3:5+b2+b3 --damped"
    assert "A2, A5: 1+2, 1+3, 2+3, 1+2+3" in tab.inner_text('#detail [data-slot="members"]')
    assert tab.url.endswith("#2+b1+b2/5+b2+b3")
    tab.click('#detail [data-slot="right-name"]')
    tab.wait_for_url("**/models/3-damped/5.html")


@pytest.mark.full
def test_deep_links_lead_to_pairs_models_structures_and_groups(visit) -> None:  # type: ignore[no-untyped-def]
    for fragment, title in (
        ("#2+b1/5+b2", "A2+b1 and A5+b2"),
        ("#5%2Bb2/2+b1", "A2+b1 and A5+b2"),
        ("#2/2+b3+b1", "A2 and A2+b1+b3"),
        ("#3:2+b1-3:A5+b2", "A2+b1 and A5+b2"),
        ("#2+b1", "A2+b1"),
        ("#2+0", "A2"),
        ("#A2", "A2 with all sets of dampers"),
        ("#group-2", "Group 2"),
    ):
        tab = visit(SMALL + fragment)  # the first loads the page, the others lead on from there
        _settle(tab)
        assert tab.inner_text("#detail h3") == title, fragment


@pytest.mark.full
def test_other_fragments_select_nothing_and_say_why_where_they_name_something(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#A12")
    assert "There is no model 3:12" in tab.inner_text("#trouble")
    for fragment, said in (
        ("", ""),
        ("#2+b4", "There are the masses 1 to 3"),
        ("#2/12", "There is no model 3:12"),
        ("#0", "There is no model 3:0"),
        ("#group-0", "There is no group 0"),
        ("#group-99", "There is no group 99"),
        ("#groups", ""),
        ("#2/3/4", "Type a structure"),
        ("#4:2", "no catalogue of 4 masses"),
        ("#2%", "Type a structure"),
        ("#2%25", "Type a structure"),
    ):
        visit(SMALL + fragment)
        _settle(tab)
        assert not tab.is_visible("#detail"), fragment
        told = tab.inner_text("#trouble")
        assert said in told if said else not told, fragment


@pytest.mark.full
def test_the_search_finds_what_compare_calls_them(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    for typed, found in (
        ("3:7+b1+b3", "A7+b1+b3"),
        ("7+b1+b3 10+b2", "A7+b1+b3 and A10+b2"),
        ("3:2 3:5", "A2 and A5"),
        ("a9+b3+b1", "A9+b1+b3"),
        ("2 2+b1", "A2 and A2+b1"),
        ("3:7", "A7 with all sets of dampers"),
    ):
        tab.fill("#find", typed)
        tab.press("#find", "Enter")
        assert tab.inner_text("#detail h3") == found and not tab.inner_text("#trouble")
    # its block fills the square, when it is drawn
    tab.wait_for_function("() => Number(document.getElementById('matrix').dataset.cell) > 20")


@pytest.mark.full
def test_the_search_says_what_it_does_not_find(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    for typed in ("", "x", "3:12", "2+b4", "3:1 4:1", "0", "2+b"):
        tab.fill("#find", typed)
        tab.press("#find", "Enter")
        assert tab.inner_text("#trouble") and not tab.is_visible("#detail"), typed


@pytest.mark.full
def test_the_start_page_and_the_catalogue_lead_here(visit) -> None:  # type: ignore[no-untyped-def]
    for page, field in ((START, "#models"), ("chains-3-damped.html", "#find")):
        tab = visit(page)
        tab.fill(field, "3:2+b1 3:5+b2")
        tab.press(field, "Enter")
        tab.wait_for_url(f"**/{SMALL}#2+b1/5+b2")
        assert tab.inner_text("#detail h3") == "A2+b1 and A5+b2"
    tab = visit(START)
    tab.fill("#models", "3:2+b4")
    tab.press("#models", "Enter")
    assert "masses 1 to 3" in tab.inner_text("#said")
    follow_link(tab, f'.card a[href="{SMALL}"]')
    follow_link(tab, ".path >> text=Without")
    assert tab.inner_text("h1") == "Chains of 3 masses, damped"


@pytest.mark.full
def test_the_order_by_group_puts_blocks_on_the_diagonal(visit, small: DamperFamily) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    tab.check('input[value="group"]', force=True)
    largest = max(len(members) for members in small.classes())
    inside = [(row, column) for row in range(2, largest + 1) for column in range(1, row)]
    assert set(_colours(tab, inside)) == {"orange"}
    assert _colours(tab, [(largest + 1, 1), (1, largest + 1)]) == ["blue", "blue"]


@pytest.mark.full
def test_one_structure_is_the_table_of_its_sets(visit, small: DamperFamily) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    tab.select_option("#only", "structure-4")
    assert tab.get_attribute('[role="grid"]', "aria-rowcount") == "8"
    pairs = list(combinations(range(8), 2))
    expected = [
        "orange" if small.found.relation(24 + i, 24 + j).value == "indistinguishable" else "blue"
        for i, j in pairs
    ]
    assert set(expected) == {"orange", "blue"}
    assert (
        _colours(tab, [(j + 1, i + 1) for i, j in pairs])
        == _colours(tab, [(i + 1, j + 1) for i, j in pairs])
        == expected
    )
    tab.fill("#find", "2+b1 5")  # outside: all models come back
    tab.press("#find", "Enter")
    assert (
        tab.get_attribute('[role="grid"]', "aria-rowcount") == "88"
        and tab.input_value("#only") == "all"
    )


@pytest.mark.full
def test_one_group_holds_its_members(visit, small: DamperFamily) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    follow_link(tab, '#groups a[href="#group-4"]')
    assert tab.inner_text("#detail h3") == "Group 4" and tab.input_value("#only") == "group-4"
    size = int(tab.get_attribute('[role="grid"]', "aria-rowcount"))
    assert size == sorted(map(len, small.classes()), reverse=True)[3]
    assert _colours(tab, [(size, 1)]) == ["orange"]
    tab.select_option("#only", "all")
    follow_link(tab, '#groups a[href="#group-4"]')  # again
    assert tab.input_value("#only") == "group-4"
    tab.keyboard.press("Escape")
    assert not tab.is_visible("#detail") and "#" not in tab.url


@pytest.mark.full
def test_a_relation_can_be_dimmed(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#A2")
    tab.select_option("#only", "structure-2")
    assert _colours(tab, [(8, 1), (8, 7)]) == ["blue", "orange"]
    tab.uncheck('input[name="distinguishable"]')
    assert _colours(tab, [(8, 1), (8, 7)]) == ["dim", "orange"]


@pytest.mark.full
def test_the_keyboard_moves_opens_and_closes(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    tab.focus(CURSOR)
    for key in ("PageDown", "ArrowDown", "ArrowRight", "ArrowRight"):
        tab.keyboard.press(key)
    assert tab.evaluate("document.activeElement.getAttribute('aria-label')").startswith(
        "A1+b2 and A2+b1+b2: distinguishable, condition"
    )
    tab.keyboard.press("Enter")
    assert tab.inner_text("#detail h3") == "A1+b2 and A2+b1+b2"
    tab.keyboard.press("Escape")
    assert not tab.is_visible("#detail")
    assert tab.evaluate("document.activeElement.getAttribute('role')") == "gridcell"


@pytest.mark.full
def test_a_structures_panel_lists_what_is_not_told_apart(visit, small: DamperFamily) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#A3")
    assert "fall into 2 groups that are distinguishable" in tab.inner_text("#detail .why")
    assert (
        tab.inner_text('#detail [data-slot="members"]')
        == "Indistinguishable over complex parameters: 1 = 2 = 3 = 1+2 = 1+3 = 2+3 = 1+2+3."
    )
    assert (
        small.found.relation(small.place((3, ())), small.place((3, (1,)))).value
        == "distinguishable"
    )
    assert tab.text_content("#detail code") == "disting dampers 3:3 --sets all --damped"


@pytest.mark.full
def test_undecided_pairs_are_named_as_such(visit, large: DamperFamily) -> None:  # type: ignore[no-untyped-def]
    i, j = next(
        (i, j) for i, j, relation, _ in large.found.pairs() if relation.value == "undecided"
    )
    address = "/".join(large.text(k).removeprefix("5:") for k in (i, j))
    tab = visit(f"{LARGE}#{address}")
    assert tab.inner_text("#detail .badge") == "undecided" and "With more time" in tab.inner_text(
        "#detail .why"
    )
    assert (
        tab.text_content("#detail code")
        == f"disting compare {large.text(i)} {large.text(j)} --undamped"
    )
    assert "The available methods do not decide" in tab.text_content("#counts")


@pytest.mark.full
@pytest.mark.parametrize("width", [320, pytest.param(390, marks=pytest.mark.slow), 1280])
def test_nothing_of_the_panel_is_cut_off(visit, width: int) -> None:  # type: ignore[no-untyped-def]
    # never two fragments of one page in turn: the second would not load it
    for path in (PAIR, LARGE, SMALL + "#A3"):
        tab = visit(path, width)
        assert tab.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0, path
        # nor does the panel: no column of its table is cut off, whatever the names
        tab.evaluate(
            "slot('facts').querySelectorAll('tbody th').forEach((e) => e.append(e.cloneNode(true)))"
        )
        for cut in ("#detail", ".beside"):
            assert (
                tab.evaluate(
                    f"(({{ scrollWidth, clientWidth }}) => scrollWidth - clientWidth)(document.querySelector('{cut}'))"
                )
                <= 0
            ), path


@pytest.mark.full
def test_without_script_the_tables_are_there(browser, site: Path) -> None:  # type: ignore[no-untyped-def]
    context = browser.new_context(java_script_enabled=False)
    tab = context.new_page()
    tab.goto(f"{site.as_uri()}/{SMALL}")
    assert tab.is_visible("noscript p") and not tab.is_visible(".tools")
    assert tab.is_visible("#row-11 .chain") and tab.is_visible("#groups td >> nth=0")
    context.close()


@pytest.mark.slow
@pytest.mark.parametrize("damped", [False, True], ids=["undamped", "damped"])
@pytest.mark.parametrize("n_masses", [4, 5])
def test_shipped_classes_are_looked_up_as_python_does(
    visit, site: Path, n_masses: int, damped: bool
) -> None:  # type: ignore[no-untyped-def]
    found = damper_catalog(n_masses, damped=damped)
    name = f"dampers-{n_masses}-shipped.html"
    (site / name).write_text(damper_page(found), encoding="utf-8")
    random = np.random.default_rng(n_masses)
    pairs = [(int(i), int(j)) for i, j in random.integers(0, len(found), (50_000, 2)) if i != j]
    pairs += [pair for members in found.found.classes() for pair in combinations(members, 2)]
    assert visit(name).evaluate(LOOK_UP, pairs) == _look_up(found, pairs)
