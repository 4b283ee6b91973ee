"""The page of Ladenheim's networks. By default on the circuits of up to four elements, which are
shipped; the whole counts by hand.
"""

from pathlib import Path

import pytest

from disting import Engine
from disting.catalogs.network_files import recall
from disting.cli.verdicts import list_of
from disting.general.any_model import of_network
from disting.general.identifiability import local_identifiability
from disting.network.families import FAMILIES
from disting.report.ladenheim import classes, is_canonical, ladenheim_page
from disting.report.listed_model import listed_model_page
from disting.report.listing import Listing, judged
from disting.report.model_list import model_list_page, write_model_list
from tests.report.outline import Outline
from tests.report.test_hard_words import unexplained


def test_108_of_148_circuits_determine_their_values() -> None:
    """Morelli and Smith, Passive Network Synthesis, SIAM 2019."""
    models = [of_network(n) for n in FAMILIES["circuits-5"].networks]
    canonical = [m for m in models if local_identifiability(m).rank == len(m.parameters)]
    assert (len(models), len(canonical)) == (148, 108)


@pytest.fixture(scope="module")
def four() -> Listing:
    engine = Engine()
    recall("circuits-4", engine)
    return Listing(judged(list_of("circuits-4"), engine), "Circuits of 4", "list-circuits-4")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory, four: Listing) -> Path:
    folder = tmp_path_factory.mktemp("ladenheim")
    write_model_list(four, folder)
    (folder / "ladenheim.html").write_text(ladenheim_page(four), encoding="utf-8")
    return folder


def test_classes_fall_apart_where_one_network_reaches_lower_degrees(four: Listing) -> None:
    """R1 C1 = R2 C2 makes one pole of two in Foster's form; Cauer's ladder always has both."""
    found = classes(four)
    assert sum(map(is_canonical, four.cards)) == 59
    assert (len(found), sum(len(c.parts) for c in found)) == (37, 41)
    split = [[[m.card.model.name for m in part] for part in c.parts] for c in found if len(c.parts) > 1]  # fmt: skip
    ladders = ["p(R1,C1-p(R2,C2))", "p(C1,R1-p(R2,C2))", "p(R1,C1,R2-C2)"]
    assert [ladders, ["p(R1,C1)-p(R2,C2)"]] in split
    assert len(split) == 4 and all(c.exact for c in found)


def test_the_page_tells_it(visit, four: Listing) -> None:  # type: ignore[no-untyped-def]
    tab = visit("ladenheim.html")
    assert "59 are canonical" in tab.inner_text("main")
    assert "They fall into 37 classes" in tab.inner_text("main")
    assert "Told apart, that makes 41 classes" in tab.inner_text("main")
    drawn = tab.locator(".classes svg.chain").count()
    assert drawn == 59 and tab.locator("svg.chain").count() == 63
    assert tab.evaluate("document.documentElement.scrollHeight") < 12_000
    tab.locator(".classes a", has_text="A17").first.click()
    assert tab.inner_text("h1").startswith("Model A17")
    page = Outline(ladenheim_page(four))
    assert not [a for _, a in page.elements if a.get("href") == "index.html"]


def test_pages_of_a_family_use_no_word_of_the_trade_unexplained(four: Listing) -> None:
    """The sentences of evidence aside, which are in a box of algebra."""
    assert unexplained(ladenheim_page(four)) == set()
    assert unexplained(listed_model_page(four, 11)) == set()
    assert unexplained(model_list_page(four)) == set()


@pytest.mark.slow
def test_all_of_them() -> None:
    """108 is the number of Morelli and Smith. Their 62 classes are of exact sets: 54 classes for
    almost all values make 60 where degrees fall; the other two are not found here.
    """
    engine = Engine()
    recall("circuits-5", engine)
    shown = Listing(judged(list_of("circuits-5"), engine), "Circuits of 5", "list-circuits-5")
    found = classes(shown)
    assert sum(map(is_canonical, shown.cards)) == 108
    assert (len(found), sum(len(c.parts) for c in found)) == (54, 60)
