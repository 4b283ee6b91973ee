"""The start page's "Describe your machine" in a real browser: every description leads to its
model, with its drawing.
"""

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from disting import Family, compare, network_of
from disting.catalogs import Catalog, catalog
from disting.catalogs.dampers import damper_catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.model.chain import Chain, violations
from disting.model.names import chain_of
from disting.model.symmetry import Symmetry, forms
from disting.report import write_report
from disting.report.drawing import draw, part_name
from disting.report.index import descriptions, index, machines, parts
from disting.verdict.result import Relation
from tests.report.barriers import barriers
from tests.report.links import follow_link
from tests.report.sight import out_of_sight

pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
KINDS = [(n, damped) for n in SHIPPED_SIZES for damped in (False, True)]
SOME = [(n, damped) for n, damped in KINDS if n < 4 or not damped]
CHOICES = ("masses", "dampers", "gap", "force", "sensor")
EXCHANGE = (Symmetry.RECIPROCITY_FREE, Symmetry.RECIPROCITY_GROUNDED)
DESCRIBE = """(descriptions) => JSON.stringify(descriptions.map(([masses, dampers, gap, force, sensor]) => {
  const form = document.getElementById("machine"), read = (name) => form.querySelector(`[data-slot="${name}"]`).textContent;
  for (const [name, value] of Object.entries({ masses, dampers, gap, force, sensor })) {
    if (form.elements[name].value === value) continue;
    form.elements[name].value = value;
    form.elements[name].dispatchEvent(new Event("change", { bubbles: true }));
    if (form.elements[name].value !== value) throw new Error(`${name} does not offer ${value}`);
  }
  const uses = [...form.querySelectorAll("use")].map((use) => use.getAttribute("href"));
  const links = (name) => [...form.querySelectorAll(`[data-slot="${name}"] a`)].map((a) => a.getAttribute("href"));
  return {
    model: form.dataset.model, number: read("number"), remark: read("remark"), said: read("twins"), known: read("known"),
    twins: links("twins"), links: links("links"), uses, missing: uses.filter((use) => !document.querySelector(use)),
    label: form.querySelector("svg").getAttribute("aria-label"),
    offered: form.elements.force.options.length * form.elements.sensor.options.length,
  };
}))"""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("start")
    write_report([catalog(2, damped=True)], folder)
    (folder / "index.html").write_text(
        index([catalog(n, damped=damped) for n, damped in KINDS]), encoding="utf-8"
    )
    return folder


def _asked(chain: Chain) -> list[str]:
    """What is chosen to describe a chain."""
    ports = f"{chain.act_minus},{chain.act_plus}", f"{chain.meas_minus},{chain.meas_plus}"
    return [str(chain.n_masses), "damped" if chain.damped else "undamped", str(chain.gap), *ports]


def _described(tab, chains: list[Chain]) -> Iterator[tuple[Chain, dict]]:  # type: ignore[no-untyped-def]
    return zip(
        chains, json.loads(tab.evaluate(DESCRIBE, [_asked(chain) for chain in chains])), strict=True
    )


@pytest.mark.full
def test_every_model_is_reached_by_its_description(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("index.html")
    for n, damped in SOME:
        shipped, kind = catalog(n, damped=damped), "damped" if damped else "undamped"
        groups = shipped.classes()
        for chain, found in _described(tab, list(shipped.family)):
            number = shipped.family.number(chain)
            assert (found["model"], found["remark"]) == (f"{n}:{number}", "")
            assert found["number"] == f"A{number} of {n} mass{'es' if n > 1 else ''}, {kind}"
            assert found["links"] == [
                f"models/{n}-{kind}/{number}.html",
                f"{shipped.name}.html#A{number}",
            ]
            row = shipped.rows[number - 1]
            rank = f"fixes {row.rank} combination{'s' * (row.rank != 1)} of its {row.n_parameters}"
            assert rank in found["known"] if row.rank < row.n_parameters else not found["known"]
            group = next((g for g in groups if number in g), (number,))
            pairs = [sorted((number, other)) for other in group if other != number]
            assert found["twins"] == [f"{shipped.name}.html#{low}-{high}" for low, high in pairs]
            assert str(len(pairs)) in found["said"] or not pairs


@pytest.mark.full
def test_a_description_outside_of_the_family_leads_to_its_model_by_the_symmetries_named(
    visit,
) -> None:  # type: ignore[no-untyped-def]
    tab, seen = visit("index.html"), set()
    for n in SHIPPED_SIZES:
        family = catalog(n, damped=True).family
        for chain, found in _described(
            tab, list(descriptions(n, damped=True))[:: 7 if n > 4 else 1]
        ):
            mirrored, exchanged = "other end" in found["remark"], "exchanged" in found["remark"]
            named = EXCHANGE * exchanged + (Symmetry.REFLECTION,) * mirrored
            listed = family[int(found["model"].split(":")[1])]
            assert next(form.chain for form in forms(chain) if form.symmetries == named) == listed
            assert (found["remark"] != "") == any(violations(chain.indices, (38,)))
            seen.add((mirrored, exchanged))
    assert len(seen) == 4


@pytest.mark.full
def test_nothing_but_admissible_descriptions_is_offered(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("index.html")
    for n in SHIPPED_SIZES:
        first = {chain.gap: chain for chain in reversed(list(descriptions(n, damped=True)))}
        offered = sum(found["offered"] for _, found in _described(tab, list(first.values())))
        assert offered == len(list(descriptions(n, damped=True)))
        assert tab.locator('[name="gap"] option').count() == n


@pytest.mark.full
def test_the_drawing_is_that_of_the_chain(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("index.html")
    for chain, found in _described(
        tab,
        [
            *descriptions(3, damped=True),
            *list(descriptions(5, damped=False))[::5],
            Chain(5, 4, 4, 5, 4, 5, damped=False),
        ],
    ):
        assert found["uses"] == [f"#{part_name(chain, layer)}" for layer in draw(chain).layers]
        assert found["missing"] == []
    box = tab.get_attribute("#machine svg", "viewBox")
    assert (
        box == f"0 0 {draw(Chain(5, damped=False)).width:g} {draw(Chain(5, damped=False)).height:g}"
    )
    assert (
        found["label"]
        == "5 masses, undamped; gap: between mass 4 and mass 5; force on mass 5, against mass 4;"
        " sensor of mass 5, against mass 4."
    )


@pytest.mark.full
def test_a_part_shows_the_same_wherever_it_is_used() -> None:
    held = {
        part.name: part.layer for part in parts(catalog(n, damped=damped) for n, damped in KINDS)
    }
    for n, damped in KINDS:
        for chain in list(descriptions(n, damped=damped))[:: 9 if n > 3 else 1]:
            for layer in draw(chain).layers:
                assert held[part_name(chain, layer)] == layer


@pytest.mark.full
def test_the_keyboard_describes_and_the_links_lead_there(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("index.html")
    tab.focus('[name="masses"]')
    for key in ("3", "Tab", "Tab", "ArrowDown", "Tab", "ArrowDown", "Tab", "ArrowDown"):
        tab.keyboard.press(key)
    chain = Chain(3, 1, 1, 3, 1, 3, damped=True)
    number = catalog(3, damped=True).family.number(replace(chain, act_plus=2, meas_plus=2))
    assert tab.inner_text('[data-slot="typed"]') == f"3:{number}"
    assert "masses 2 to 3 counted from the other end" in tab.inner_text('[data-slot="remark"]')


@pytest.mark.full
def test_the_links_lead_there(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("index.html")
    tab.select_option('[name="masses"]', "2")
    tab.select_option('[name="sensor"]', "0,2")
    tab.wait_for_url("**/index.html#machine=2,damped,0,0,1,0,2")
    follow_link(tab, "text=Its column in the matrix")
    assert tab.inner_text("#detail h3") == "A2"
    tab.go_back()
    follow_link(tab, "text=Model page of A2")
    assert tab.inner_text("h1").startswith("Model A2")


@pytest.mark.full
def test_the_address_holds_the_description(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("index.html#machine=5,undamped,2,2,5,1,3")
    assert [tab.input_value(f'[name="{name}"]') for name in CHOICES] == _asked(
        Chain(5, 2, 2, 5, 1, 3, damped=False)
    )
    assert tab.inner_text('[data-slot="remark"]')
    tab.select_option('[name="gap"]', "1")
    tab.wait_for_url("**/index.html#machine=5,undamped,1,1,5,1,3")
    for wrong in ("#machine=9,damped,9,9,9,9,9", "#machine=1", "#describe"):
        tab.evaluate("(hash) => { location.hash = hash }", wrong)
        assert tab.input_value('[name="masses"]') == "5"


@pytest.mark.full
def test_undecided_pairs_are_said(visit, site: Path) -> None:  # type: ignore[no-untyped-def]
    shipped = catalog(3, damped=True)
    blank = [
        {"left": r["left"], "right": r["right"]} if (r.get("left"), r.get("right")) == (1, 3) else r
        for r in shipped.records
    ]
    opened = replace(shipped, records=blank)
    assert machines([opened])[0]["open"] == {1: 1, 3: 1}
    (site / "opened.html").write_text(index([opened]), encoding="utf-8")
    tab = visit("opened.html")
    for _, found in _described(tab, [shipped.family[3]]):
        assert found["said"] == "No other model is known to be indistinguishable from it."
    assert (
        tab.inner_text('[data-slot="open"]')
        == "With 1 model this is undecided over positive parameters."
    )


@pytest.mark.full
def test_a_size_with_one_kind_offers_that_kind(visit, site: Path) -> None:  # type: ignore[no-untyped-def]
    (site / "few.html").write_text(
        index([catalog(2, damped=False), catalog(3, damped=True)]), encoding="utf-8"
    )
    tab = visit("few.html")
    assert tab.locator('[name="dampers"] option').all_inner_texts() == ["at each spring"]
    tab.select_option('[name="masses"]', "2")
    assert tab.locator('[name="dampers"] option').all_inner_texts() == ["none"]
    assert tab.inner_text('[data-slot="number"]') == "A1 of 2 masses, undamped"


@pytest.mark.full
def test_without_catalogues_nothing_is_asked(visit, site: Path) -> None:  # type: ignore[no-untyped-def]
    (site / "empty.html").write_text(index([]), encoding="utf-8")
    assert visit("empty.html").locator("#machine").count() == 0


@pytest.mark.full
def test_the_page_stays_small(site: Path) -> None:
    assert (site / "index.html").stat().st_size < 150_000


def test_the_data_of_a_catalogue() -> None:
    shipped: Catalog = catalog(2, damped=True)
    (found,) = machines([shipped])
    assert found["models"] == [(0, 0, 1, 0, 1), (0, 0, 1, 0, 2), (1, 1, 2, 1, 2)]
    assert (found["groups"], found["open"]) == (shipped.classes(), {})


def _more(tab, **chosen: str | bool) -> str:  # type: ignore[no-untyped-def]
    """Choose by the names of fields, _ for -, in order; what the machine is called then."""
    for name, value in chosen.items():
        field = f'[name="{name.replace("_", "-")}"]'
        if isinstance(value, bool):
            tab.set_checked(field, value)
        else:
            tab.select_option(field, value)
    return str(tab.get_attribute("#machine", "data-model"))


def _opened(tab):  # type: ignore[no-untyped-def]
    tab.click(".further summary")
    return tab


def _commands(tab) -> list[str]:  # type: ignore[no-untyped-def]
    return list(tab.locator('[data-slot="commands"] code').all_inner_texts())


@pytest.mark.full
def test_friction_and_lag_are_in_the_name_at_the_masses_of_the_list(visit) -> None:  # type: ignore[no-untyped-def]
    """A free row counted from its other end: friction at mass 2 is at mass 3 of the listed chain."""
    tab = visit("index.html")
    name = _more(tab, masses="3", gap="1", force="1,3", sensor="1,3", friction_2=True, lag=True)
    listed, own = chain_of(name, Family(3)), Chain(3, 1, 1, 3, 1, 3, ground_dampers=(2,), lag=True)
    assert "counted from the other end" in tab.inner_text('[data-slot="remark"]')
    assert listed.ground_dampers == (3,) and listed.lag
    assert compare(own, listed).relation is Relation.INDISTINGUISHABLE
    assert [u.get_attribute("href") for u in tab.locator("#machine use").all()][-1] == (
        "#part-friction-2"
    )
    assert tab.inner_text('[data-slot="behind"]') == "The force acts behind a lag T1."
    (command,) = _commands(tab)
    assert command == (
        f'disting equivalents {name} --to "3+b*" --set m1=..,m2=..,m3=..,k01=..,d01=..,k23=..,'
        "d23=..,b2=..,T1=.."
    )
    assert _more(tab, lag=False, quantity="position", dampers="undamped").endswith("+b3")
    assert "--undamped --quantity position --set" in _commands(tab)[0]


@pytest.mark.full
def test_friction_alone_leads_to_the_catalogue_that_has_it(visit, site: Path) -> None:  # type: ignore[no-untyped-def]
    dampers = [damper_catalog(3, damped=True)]
    page = index([catalog(3, damped=True)], dampers=dampers)
    (site / "rubbed.html").write_text(page, encoding="utf-8")
    tab = visit("rubbed.html")
    assert _more(tab, masses="3", friction_1=True, friction_3=True) == "3:1+b1+b3"
    link = tab.get_attribute('[data-slot="twins"] a', "href")
    assert link == "dampers-3-damped.html#1+b1+b3" and _commands(tab) == []


@pytest.mark.full
@pytest.mark.parametrize(
    ("chosen", "text", "family"),
    [
        ({"masses": "4", "joined_4": "2"}, "1=2, 2=3, 2=4; F1; S1", "trees-4-damped"),
        (
            {"masses": "3", "dampers": "undamped", "loop": "1,3"},
            "1~2, 2~3, 1~3; F1; S1", "machines-3",
        ),
        (
            {"masses": "3", "gear": "2", "friction_3": True, "second": "0,3", "quantity": "velocity"},
            "1=2*i, 2=3, 3-#; F1; S1 S3; velocity", "",
        ),
        (
            {"masses": "4", "gap": "1", "joined_4": "2", "loop": "0,3", "friction_3": True},
            "#=1, 2=3, 2=4, #=3; F2:1; S2:1", "trees-4-damped",
        ),
    ],
)  # fmt: skip
def test_a_machine_that_is_no_chain_is_written_drawn_and_asked(
    visit, chosen: dict, text: str, family: str
) -> None:  # type: ignore[no-untyped-def]
    tab = _opened(visit("index.html"))
    assert _more(tab, **chosen) == text
    made = network_of(text)
    drawn = [u.get_attribute("data-element") for u in tab.locator("#machine [data-element]").all()]
    values = {p for e in made.elements for p in e.parameters}
    assert sorted(drawn) == sorted(values)
    assert not [u for u in tab.locator("#machine use").all() if not u.evaluate("(u) => document.querySelector(u.getAttribute('href')) && u.getBoundingClientRect().width")]  # fmt: skip
    ports = tab.locator("#machine [data-port]").count()
    assert ports == sum(1 + bool(p.minus) for p in (*made.inputs, *made.outputs))
    found = _commands(tab)
    assert found[0] == f'disting models "{text}"'
    tree = "loop" not in chosen or family.startswith("machines")
    assert (f'disting equivalents "{text}" --family {family}' in found) == (bool(family) and tree)
    assert found[-1] == f'disting draw "{text}" --svg machine.svg'


@pytest.mark.full
def test_no_all_clear_is_given_of_a_machine_that_is_not_shipped(visit) -> None:  # type: ignore[no-untyped-def]
    tab = _opened(visit("index.html"))
    _more(tab, masses="4")
    said = tab.inner_text("#machine [role=status]")
    assert "distinguish" in said
    for chosen in ({"joined_4": "1"}, {"joined_4": "3", "delay": True}, {"delay": False}):
        _more(tab, **chosen)  # type: ignore[arg-type]
        said = tab.inner_text("#machine [role=status]")
        clear = chosen == {"delay": False}
        assert ("distinguish" in said) == clear
        assert ("its equivalents are not listed here" in said) != clear


@pytest.mark.full
def test_the_address_holds_all_of_it(visit) -> None:  # type: ignore[no-untyped-def]
    tab = _opened(visit("index.html"))
    text = _more(tab, masses="4", joined_4="2", second="0,4", friction_3=True, delay=True)
    tab.wait_for_url(
        re.compile(r"machine=4,damped,0,0,1,0,1/friction-3=1/delay=1/joined-4=2/second=0,4$")
    )
    address = tab.url[tab.url.index("index.html") :]
    again = visit("guide/index.html")
    again = visit(address)
    assert again.get_attribute("#machine", "data-model") == text
    assert again.is_checked('[name="delay"]') and again.is_checked('[name="friction-3"]')


@pytest.mark.full
@pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.slow)])
def test_the_larger_form_fits_a_phone_and_has_no_barrier(visit, scheme: str) -> None:  # type: ignore[no-untyped-def]
    tab = _opened(visit("index.html", 320, scheme))
    _more(tab, masses="5", gap="2", joined_5="3", loop="0,5", friction_4=True)
    assert barriers(tab) == []
    assert out_of_sight(tab) == []
