"""The page of a list of general models: what it says is what was decided, names are shown and
never obeyed, and all can use it.
"""

import json
import re
from itertools import combinations
from pathlib import Path

import pytest

from disting import (
    Engine,
    InputError,
    Level,
    Model,
    ModelList,
    Query,
    View,
    global_identifiability,
    identifiability,
)
from disting.general.global_identifiability import IDENTIFIABILITY
from disting.general.model_files import models_of
from disting.report import write_family
from disting.report.formulas import written_model
from disting.report.listing import Listing, judge
from disting.report.model_list import (
    list_pages,
    listed_model_page,
    model_list_page,
    page_name,
    write_model_list,
)
from tests.cli.process import called
from tests.report.outline import Outline

LEAKS = {"A": [["-k12-k01", "0"], ["k12", "-k02"]], "B": ["1", "0"], "C": ["0", "1"]}
MODELS = [
    {"name": "two leaks", **LEAKS},
    {"name": "exchange", "num": ["k12"], "den": ["1", "k01 + k12 + k21", "k01*k21"]},
    {"name": "low passes", "G": "k/((T1*s + 1)*(T2*s + 1))"},
    {"name": "drive", "chain": "2:1", "damped": True},
    {"name": "by hand", "num": ["J2", "d", "k"], "den": ["J1*J2", "d*(J1 + J2)", "k*(J1 + J2)"]},
]  # fmt: skip
HOSTILE = [
    "<script>alert(1)</script>", "</script><img src=x onerror=alert(1)>", '"><svg onload=alert(1)>', "{{7*7}}", "{L}", "{R} and {L}",
    "javascript:alert(1)", "&lt;b&gt;", "=1+1", "a, b",
]  # fmt: skip
NAME = "list-vessels"


def of(entries):
    return models_of({"models": entries})


def hostile():
    """Every second one is the same as the first; so sentences of all kinds name them."""
    entries = [
        {"name": name, "num": ["k"], "den": ["T", *["1"] * (1 + i % 2)]}
        for i, name in enumerate(HOSTILE)
    ]
    return of(entries)


@pytest.fixture(scope="module")
def vessels():
    return judge(of(MODELS), Engine())


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory, vessels) -> Path:  # type: ignore[no-untyped-def]
    folder = tmp_path_factory.mktemp("lists")
    write_model_list(Listing(vessels, "Two vessels", NAME), folder)
    bad = Listing(judge(hostile(), Engine()), HOSTILE[0], "list-hostile")
    write_model_list(bad, folder)
    return folder


def data(page: str):
    text = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)
    return json.loads(text[1])


@pytest.mark.full
def test_what_is_judged_is_what_compare_says(vessels) -> None:  # type: ignore[no-untyped-def]
    engine, models = Engine(), vessels.family
    for view in (View.POSITIVE, View.EXACT):
        for i, j in combinations(range(len(models)), 2):
            sides = engine.general_subjects((models[i], models[j]))
            alone = engine.verdict(*sides, Query(view, inclusion=False))
            found = vessels.verdict(i + 1, j + 1, view)
            assert (found.relation, found.sentence) == (alone.relation, alone.sentence)
            assert vessels.relation(j + 1, i + 1, view) is found.relation
    assert vessels.classes(View.POSITIVE) == ((4, 5),)
    assert vessels.classes(View.EXACT) == ((1, 2, 3), (4, 5))
    assert vessels.depending(View.POSITIVE) == ((1, 2), (1, 3), (2, 3))


@pytest.mark.full
def test_the_pages_say_it_without_a_script(vessels) -> None:  # type: ignore[no-untyped-def]
    shown = Listing(vessels, "Two vessels", NAME)
    page = model_list_page(shown)
    outline = Outline(page)
    assert outline.texts["h1"] == ["Two vessels"]
    for number, model in enumerate(vessels.family, 1):
        assert f'<a href="models/{NAME}/{number}.html">{model.name}</a>' in page
        own = Outline(listed_model_page(shown, number))
        assert f"Parameters: {', '.join(model.parameters)}. " in own.text
        found, over_complex = identifiability(model), global_identifiability(model).sentence
        assert found.sentence in own.text
        is_one = found.level is Level.GLOBAL and found.over_complex is None
        assert (f"Over complex parameters: {over_complex}" in own.text) is not is_one
        assert own.count("math") >= 4
    for left, right, verdict in vessels.pairs(View.POSITIVE):
        assert f"{vessels.family[left - 1].name} and {vessels.family[right - 1].name}</th>" in page
        assert verdict.evidence.sentence(verdict.left, verdict.right) in page
    found = data(page)
    assert found["names"] == [m.name for m in vessels.family] and found["models"] == 5
    assert set(found["views"]) == {"positive", "exact"} and not found["numbered"]


@pytest.mark.full
def test_links_lead_to_pages_that_are_there(vessels, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    shown = Listing(vessels, "Two vessels", NAME)
    first = write_model_list(shown, tmp_path)[0].read_text("utf-8")
    assert 'href="index.html"' not in first and "guide/" not in first
    (tmp_path / "index.html").touch()
    again = write_model_list(shown, tmp_path)
    assert 'href="index.html"' in again[0].read_text("utf-8")
    files = [f"{NAME}.html", f"{NAME}.csv", f"{NAME}.json", f"{NAME}-models.csv", "style.css"]
    assert [p.name for p in again] == [*files, *(f"{n}.html" for n in range(1, 6))]


@pytest.mark.full
def test_the_table_of_models_says_what_the_pages_say(vessels, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    path = write_model_list(Listing(vessels, "Two vessels", NAME), tmp_path)[3]
    head, *rows = path.read_text("utf-8").splitlines()
    assert head == ("number,name,parameters,inputs,outputs,determinable,sets,group,complex_group")
    assert rows[0] == "1,two leaks,k01 k02 k12,1,1,3,1 or 2,0,1"
    assert [row.split(",")[-2:] for row in rows[3:]] == [["1", "2"], ["1", "2"]]


@pytest.mark.full
def test_names_are_text_in_the_page(site: Path) -> None:
    tame, page = (Outline((site / f"{n}.html").read_text("utf-8")) for n in (NAME, "list-hostile"))
    assert {tag for tag, _ in page.elements} <= {tag for tag, _ in tame.elements}
    attributes = {a for _, found in page.elements for a in found}
    assert not {a for a in attributes if a.startswith("on")}
    assert data((site / "list-hostile.html").read_text("utf-8"))["names"] == HOSTILE


@pytest.mark.full
def test_large_models_are_told_by_their_degrees() -> None:
    long = Model.from_transfer_function("1", "*".join(f"(s + a{i} + b{i})" for i in range(8)))
    assert written_model(long).lines == () and "b_{0}" in written_model(long).latex
    short = Model.from_transfer_function(["gain"], ["tau_m", "1"])
    assert "<mi>gain</mi>" in "".join(
        part for _, parts in written_model(short).lines for part in parts
    )
    assert "a_{1} &= \\mathrm{tau}_{m}\n" in written_model(short).latex


def test_identifiability_is_kept_as_it_is() -> None:
    for model in of(MODELS):
        found = global_identifiability(model)
        assert IDENTIFIABILITY.decode(IDENTIFIABILITY.encode(found)) == found
    many = Model.from_transfer_function(
        [f"b{i}" for i in range(5)], [1, *(f"a{i}" for i in range(5))]
    )
    quick = global_identifiability(many, tries=0)
    assert (quick.count, quick.local.rank, len(quick.combinations)) == (None, 10, 10)


@pytest.mark.parametrize(
    ("file", "name"),
    [("leaks.json", "list-leaks"), ("../x/Ä b.C.json", "list-b-c"), ("index.json", "list-index")],
)
def test_page_names_stay_in_the_folder(file: str, name: str) -> None:
    assert page_name(Path(file)) == name


def test_a_name_without_letters_is_refused() -> None:
    with pytest.raises(InputError, match="rename the file"):
        page_name(Path("ä ö.json"))


@pytest.mark.full
def test_the_command_writes_the_page_and_refuses_what_it_cannot(tmp_path: Path) -> None:
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        text = json.dumps({"title": "Vessels & drives", "models": MODELS})
        (tmp_path / folder / "vessels.json").write_text(text)
    one, two = tmp_path / "one" / "vessels.json", tmp_path / "two" / "vessels.json"
    out = tmp_path / "out"
    done = called("report", one, "--out", out, cache=tmp_path / "cache.sqlite3")
    assert done.returncode == 0
    assert done.stdout.splitlines()[0] == (
        "Vessels & drives, over positive parameters: 6 distinguishable, 1 indistinguishable, 3"
        " sometimes, 0 undecided"
    )
    first = (out / "list-vessels.html").read_bytes()
    assert b"<h1>Vessels &amp; drives</h1>" in first
    called("report", one, "--out", out, cache=tmp_path / "cache.sqlite3")
    assert (out / "list-vessels.html").read_bytes() == first
    for arguments, cause in (
        ((one, two), "two files would have one page"),
        ((one, "--damped"), "--damped is supported for numbered chains only"),
        ((tmp_path / "no.json",), "cannot be read"),
        ((), "number of masses, or a file of models"),
    ):
        done = called("report", *arguments, "--out", tmp_path / "none")
        assert done.returncode == 2 and cause in done.stderr and not (tmp_path / "none").exists()


def test_a_list_is_no_iterable_of_numbers() -> None:
    found = ModelList(of(MODELS).models[:2], "T")
    assert [m.name for m in found] == ["two leaks", "exchange"] and len(found) == 2


def _settle(tab) -> None:  # type: ignore[no-untyped-def]
    tab.evaluate(
        "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
    )


@pytest.mark.full
def test_a_pair_is_found_by_its_names_and_told(visit, vessels) -> None:  # type: ignore[no-untyped-def]
    tab = visit(f"{NAME}.html")
    tab.fill("#find", "Two leaks, exch")
    tab.press("#find", "Enter")
    verdict = vessels.verdict(1, 2, View.POSITIVE)
    assert tab.inner_text("#detail h3") == "two leaks and exchange"
    assert tab.inner_text("#detail .shown").startswith(
        "It depends on the values: some responses fit both two leaks"
    )
    tab.click("#detail summary")
    assert tab.inner_text("#detail .why") == verdict.evidence.sentence("two leaks", "exchange")
    assert (
        tab.inner_text('[data-slot="in-exact"]')
        == "indistinguishable, condition 7, transfer function"
    )
    assert tab.url.endswith("#1-2")
    assert tab.get_attribute('[role="gridcell"]', "aria-label").startswith(
        "two leaks and exchange: "
    )
    tab.focus('[role="gridcell"]')
    tab.keyboard.press("ArrowDown")
    tab.keyboard.press("Enter")
    assert tab.inner_text("#detail h3") == "two leaks and low passes"
    tab.click('#detail [data-slot="left-name"]')
    assert tab.url.endswith(f"models/{NAME}/1.html")
    assert tab.inner_text("h1") == "two leaks"
    tab.click(".path a")
    tab.fill("#find", "nobody")
    tab.press("#find", "Enter")
    assert tab.inner_text("#trouble").startswith("Type the name of a model")


@pytest.mark.full
def test_the_domain_changes_groups_and_views(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(f"{NAME}.html")
    assert tab.locator("#groups .group:visible").count() == 1
    tab.check('[name="domain"][value="exact"]', force=True)
    assert tab.locator("#groups .group:visible").count() == 2
    tab.check('[name="order"][value="group"]', force=True)
    _settle(tab)
    assert tab.locator("#group option").all_inner_texts()[1] == "1: two leaks, exchange, low passes"


@pytest.mark.full
def test_hostile_names_are_told_and_not_obeyed(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("list-hostile.html#1-2")
    assert tab.inner_text("#detail h3") == f"{HOSTILE[0]} and {HOSTILE[1]}"
    tab = visit("list-hostile.html#5-6")
    tab.click("#detail summary")
    assert tab.inner_text("#detail .why").startswith("{L} has a numerator of degree 0")
    assert "{R} and {L} a numerator" in tab.inner_text("#detail .why")


def drives():
    """A motor with two loads, in a row or side by side, and a sensor anywhere: a family of one's
    own.
    """
    for second in ("2~3", "1~3"):
        for sensor in (1, 2, 3):
            yield f"1~2, {second}; F1; S{sensor}"


@pytest.fixture(scope="module")
def own(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    return write_family(drives(), "Two loads", tmp_path_factory.mktemp("own"))


@pytest.mark.full
def test_a_family_of_ones_own_has_the_same_pages(own: list[Path]) -> None:
    assert [p.name for p in own[:4]] == [
        "list-two-loads.html", "list-two-loads.csv", "list-two-loads.json", "list-two-loads-models.csv",
    ]  # fmt: skip
    page = Outline(own[0].read_text("utf-8"))
    texts = list(drives())
    assert page.texts["h1"] == ["Two loads"] and page.count("svg", role="img") >= len(texts)
    assert data(own[0].read_text("utf-8"))["names"] == texts
    for number, text in enumerate(texts, 1):
        model = Outline((own[0].parent / f"models/list-two-loads/{number}.html").read_text("utf-8"))
        assert f"A{number}: {text} \u2013 Two loads" in model.text
        assert model.count("svg", role="img") >= 1 and "Transfer function" in model.text


@pytest.mark.full
def test_values_on_a_page_are_equivalents(tmp_path: Path) -> None:
    """Put into the other circuit by hand: R0' = R0 + R1 for p(R0,R1-C1) from R0-p(R1,C1)."""
    folder = write_family(["R0-p(R1,C1)", "p(R0,R1-C1)"], "Cells", tmp_path)[0].parent
    page = (folder / "models/list-cells/1.html").read_text("utf-8")
    r0 = "<msubsup><mi>R</mi><mn>0</mn><mo>\u2032</mo></msubsup><mo>=</mo>"
    plus = "<msub><mi>R</mi><mn>0</mn></msub><mo>+</mo><msub><mi>R</mi><mn>1</mn></msub>"
    assert f"<math>{r0}{plus}</math>" in page
    assert "no measurement at this port distinguishes it from" in page and "Impedance" in page
    assert "equivalents &#34;R0-p(R1,C1)&#34; --to &#34;p(R0,R1-C1)&#34; --set C1=..,R0=" in page


@pytest.mark.full
def test_networks_of_several_ports_have_pages(tmp_path: Path) -> None:
    texts = ["1~2; F1; S1 S2", "1~2, 2~#; F1; S1 S2"]
    folder = write_family(texts, "Two encoders", tmp_path)[0].parent
    page = Outline((folder / "models/list-two-encoders/2.html").read_text("utf-8"))
    assert "From input 1 to output 2" in page.texts["h3"]
    assert "2 outputs, 1 input" in page.text


@pytest.mark.parametrize(
    ("models", "title", "cause"),
    [
        (["R1"], "One", "two models at least"),
        (["R1", "R1"], "Two", "names 2 models"),
        (["R1-C1", "1~2; F1; S1 S2"], "Ports", "outputs"),
        (["R1-C1", "p(R1,C1)"], "\u00e4", "no letter"),
        (7, "Seven", "a list of models"),
        (["R1-C1", 3], "Three", "a model is a Model"),
    ],
)
def test_what_is_no_family_is_refused(
    models: object, title: str, cause: str, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match=cause):
        write_family(models, title, tmp_path / "none")  # type: ignore[arg-type]
    assert not (tmp_path / "none").exists()


@pytest.mark.full
def test_what_lies_beside_and_is_no_list_is_passed_over(tmp_path: Path) -> None:
    """Damaged or foreign files of such names."""
    write_family(["R0-p(R1,C1)", "p(R0,R1-C1)"], "Two & more", tmp_path)
    (tmp_path / "list-broken.html").write_bytes(b"<h1>\xff\x00</h1>")
    (tmp_path / "list-broken-models.csv").write_bytes(b"\xff,../../x\n1,2\n" + b"7,x,,,,,,,\n")
    (tmp_path / "list-alone.html").write_text("<h1>No table</h1>")
    (tmp_path / "list-bare.html").write_text("nothing")
    found = dict(list_pages(tmp_path))
    titles = {link[0]: link[1] for link in found}
    assert titles["list-two-more.html"] == "Two & more" and "list-alone.html" not in titles
    models = {link[0]: of for link, of in found.items()}
    assert [m[:2] for m in models["list-two-more.html"]] == [
        ("models/list-two-more/1.html", "R0-p(R1,C1)"),
        ("models/list-two-more/2.html", "p(R0,R1-C1)"),
    ]
    assert models["list-broken.html"] == []


@pytest.mark.full
def test_a_page_says_which_part_of_a_model_another_one_reaches(tmp_path):
    """a12 > a20, and both ways; on the panel in words."""
    texts = ["1>0, 1>2, 2>0; in 1; out 2", "1>0, 1>2, 2>1; in 2; out 1"]
    matrix, *_ = write_family(texts, "Two ways out", tmp_path)
    page = (tmp_path / "models/list-two-ways-out/1.html").read_text("utf-8")
    assert "Of A1, exactly this part has a positive equivalent A2, special values aside:" in page
    assert "Every A2 with positive parameters has a positive equivalent A1." in page
    plain = re.sub(r"<[^>]+>", "", page)
    assert "a12&gt;a20" in plain
    said = "{L} has a positive equivalent {R} exactly where a12 \\u003e a20, special values aside."
    assert said in matrix.read_text("utf-8")


@pytest.mark.full
def test_a_page_says_where_a_model_gives_more_than_its_twin(tmp_path):
    """Foster's form has one pole where both its parts have the same time constant, Cauer's none."""
    texts = ["p(R1,C1)-p(R2,C2)", "p(C1,R1-p(R2,C2))"]
    write_family(texts, "Two forms", tmp_path)
    for number in (1, 2):
        page = (tmp_path / f"models/list-two-forms/{number}.html").read_text("utf-8")
        plain = re.sub(r"<[^>]+>", "", page)
        assert "For all positive values of A2, A1 can give the same (proven)" in plain
        assert "A1 has fewer poles where C1R1=C2R2." in plain
