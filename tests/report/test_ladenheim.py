"""The page of Ladenheim's networks. By default on the circuits of up to four elements, which are
shipped; the whole counts by hand.
"""

from collections import Counter
from math import comb
from pathlib import Path

import pytest

from disting import Domain, Engine, Network, compare, network_of
from disting.catalogs.network_files import recall
from disting.cli.verdicts import list_of
from disting.evidence.general import Replacement
from disting.general.any_model import of_network
from disting.general.identifiability import local_identifiability
from disting.network.exact import within
from disting.network.families import FAMILIES
from disting.report.ladenheim import classes, is_canonical, ladenheim_page, open_pairs
from disting.report.listing import Listing, judge
from disting.report.model_list import listed_model_page, model_list_page, write_model_list
from tests.report.outline import Outline
from tests.report.test_hard_words import unexplained


@pytest.mark.full
def test_108_of_148_circuits_determine_their_values() -> None:
    """Morelli and Smith, Passive Network Synthesis, SIAM 2019."""
    models = [of_network(n) for n in FAMILIES["circuits-5"].networks]
    canonical = [m for m in models if local_identifiability(m).rank == len(m.parameters)]
    assert (len(models), len(canonical)) == (148, 108)


@pytest.fixture(scope="module")
def four() -> Listing:
    engine = Engine()
    recall("circuits-4", engine)
    return Listing(judge(list_of("circuits-4"), engine), "Circuits of 4", "list-circuits-4")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory, four: Listing) -> Path:
    folder = tmp_path_factory.mktemp("ladenheim")
    write_model_list(four, folder)
    (folder / "ladenheim.html").write_text(ladenheim_page(four), encoding="utf-8")
    return folder


@pytest.mark.full
def test_classes_fall_apart_where_one_network_reaches_lower_degrees(four: Listing) -> None:
    """R1 C1 = R2 C2 makes one pole of two in Foster's form; Cauer's ladder always has both."""
    found = classes(four)
    assert sum(map(is_canonical, four.cards)) == 59
    assert (len(found), sum(len(c.parts) for c in found)) == (37, 41)
    split = [[[m.card.model.name for m in part] for part in c.parts] for c in found if len(c.parts) > 1]  # fmt: skip
    ladders = ["p(R1,C1-p(R2,C2))", "p(C1,R1-p(R2,C2))", "p(R1,C1,R2-C2)"]
    assert [["p(R1,C1)-p(R2,C2)"], ladders] in split
    assert len(split) == 4 and all(c.exact for c in found)


@pytest.mark.slow
def test_the_page_tells_it(visit, four: Listing) -> None:  # type: ignore[no-untyped-def]
    tab = visit("ladenheim.html")
    assert "59 are canonical" in tab.inner_text("main")
    assert "They fall into 37 classes" in tab.inner_text("main")
    assert "special values included, make 41 classes" in tab.inner_text("main")
    assert "two poles fall together" in tab.inner_text("main")
    drawn = tab.locator(".classes svg.chain").count()
    assert drawn == 59 and tab.locator("svg.chain").count() == 63
    assert tab.evaluate("document.documentElement.scrollHeight") < 12_000
    tab.locator(".classes a", has_text="A17").first.click()
    assert tab.inner_text("h1").startswith("Model A17")
    page = Outline(ladenheim_page(four))
    assert not [a for _, a in page.elements if a.get("href") == "index.html"]


@pytest.mark.full
def test_pages_of_a_family_use_no_word_of_the_trade_unexplained(four: Listing) -> None:
    """The sentences of evidence aside, which are in a box of algebra."""
    assert unexplained(ladenheim_page(four)) == set()
    assert unexplained(listed_model_page(four, 11)) == set()
    assert unexplained(model_list_page(four)) == set()


@pytest.mark.full
@pytest.mark.parametrize(
    ("family", "size", "apart", "joined"),
    [("circuits-4", 59, 43, 2), pytest.param("circuits-5", 108, 68, 8, marks=pytest.mark.slow)],
)
def test_exact_sets(family: str, size: int, apart: int, joined: int) -> None:
    """Without verdicts: networks made of parts with the same exact sets make so many groups.
    Formulas without exceptions join two of them each: the page tells 41 and 60.
    """
    models = map(of_network, FAMILIES[family].networks)
    canonical = [m for m in models if local_identifiability(m).rank == len(m.parameters)]
    assert len(canonical) == size
    groups = list[list[Network]]()
    for network in (m.network for m in canonical):
        alike = [g for g in groups if always_the_same(g[0], network)]
        assert len(alike) < 2
        if alike:
            alike[0].append(network)
        else:
            groups.append([network])
    assert len(groups) == apart
    for one, other in JOINED[:joined]:
        evidence = compare(one, other).evidence
        assert not always_the_same(network_of(one), network_of(other))
        if isinstance(evidence, Replacement):
            assert always_the_same(network_of(one), network_of(evidence.left))
            assert always_the_same(network_of(other), network_of(evidence.right))
            evidence = evidence.inner
        assert evidence.without_exception(Domain.POSITIVE)


def always_the_same(one: Network, other: Network) -> bool:
    return bool(within(one, other) and within(other, one))


JOINED = [
    ("R1-p(R2,L1-C1)", "p(R1,R2-L1-C1)"),
    ("R1-p(R2,L1,C1)", "p(R1,R2-p(L1,C1))"),
    ("R1-p(R2,L1-p(R3,C1))", "p(R1,L1-p(R2,R3-C1))"),
    ("R1-p(R2,C1-p(R3,L1))", "p(R1,C1-p(R2,R3-L1))"),
    ("R1-p(L1,R2-p(R3,C1))", "p(R1,R2-p(L1,R3-C1))"),
    ("R1-p(C1,R2-p(R3,L1))", "p(R1,R2-p(C1,R3-L1))"),
    # a star of three resistors for a triangle, and back
    ("R1-p(R2-L1,R3-C1)", "C1 1 2; L1 1 3; R1 2 3; R2 2 0; R3 3 0"),
    ("p(R1,p(R2,L1)-p(R3,C1))", "C1 1 2; R1 1 3; R2 2 3; L1 2 0; R3 3 0"),
]


@pytest.mark.slow
def test_all_of_them() -> None:
    """108 networks and 62 classes are the numbers of Morelli and Smith. Equal sets of impedances
    are 60; if the factor is kept that numerator and denominator have in common, 62.
    """
    engine = Engine()
    recall("circuits-5", engine)
    shown = Listing(judge(list_of("circuits-5"), engine), "Circuits of 5", "list-circuits-5")
    found = classes(shown)
    assert sum(map(is_canonical, shown.cards)) == 108
    assert (len(found), sum(len(c.parts) for c in found)) == (54, 60)
    assert sum(c.n_with_factors for c in found) == 62 and all(c.exact for c in found)
    kept = [Counter((i, m.factors) for i, part in enumerate(c.parts) for m in part) for c in found]
    # as many pairs as have been counted within their 62 classes
    assert sum(comb(n, 2) for c in kept for n in c.values()) == 76
    assert {relation.value for *_, relation in open_pairs(shown)} == {"sometimes"}
