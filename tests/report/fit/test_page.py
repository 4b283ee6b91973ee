"""The page of a fit: complete, closed in itself, safe against hostile text, reproducible."""

import csv
import json
import re
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import pytest

from disting.cli.fit_text import fit_text
from disting.errors import InputError
from disting.export import read_model
from disting.files import __version__
from disting.fit.judge.admissible import Rule
from disting.fit.judge.explanation import Miss
from disting.fit.judge.look_alikes import LookAlikeKind
from disting.fit.judge.members import Disagreement
from disting.fit.judge.modes import physical
from disting.fit.judge.outside import Outside
from disting.fit.judge.readings import QuantityReading
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import chosen_ports
from disting.fit.select import select
from disting.measurement import FrequencyResponse
from disting.model.chain import Quantity, text_drawing
from disting.model.names import name_of
from disting.report.fit import (
    collinearity_dots,
    fit_page,
    importance_bars,
    write_fit_report,
)
from disting.report.fit.answer import answer
from disting.report.fit.criteria import limits, nearest, parameters_by_threshold, weakest
from disting.report.fit.selection_json import selection_to_dict
from disting.report.fit.selection_page import reasons
from disting.report.fit.sentences import first_lines, suspicions
from disting.report.fit.style import FigureFiles
from disting.report.fit.words import readable
from disting.report.fit.write import candidates_csv
from disting.statistics.practical import Thresholds
from tests.report.outline import Outline

from .conftest import DRIVE, HOSTILE, response

pytestmark = pytest.mark.full

FIGURES = [
    "bode",
    "residuals",
    "parameters-by-threshold",
    "models-by-threshold",
    "importance",
    "collinearity",
    "starts",
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("fit") / "new" / "folder"


@pytest.fixture(scope="module")
def written(
    selection: Selection, train: FrequencyResponse, test: FrequencyResponse, folder: Path
) -> list[Path]:
    return write_fit_report(selection, folder, train, test)


@pytest.fixture(scope="module")
def outline(written: list[Path]) -> Outline:
    return Outline(written[0].read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def empty(nothing: Selection, train: FrequencyResponse, starts: FigureFiles) -> Outline:
    """With one figure: of the files of all of them, those of `written` are looked at."""
    found = nothing.described
    return Outline(fit_page(nothing, physical(found, nothing.task), [starts], train))


def test_all_files_are_written_and_linked(written: list[Path], outline: Outline) -> None:
    figures = [f"{name}.{kind}" for name in FIGURES for kind in ("svg", "png", "pdf")]
    assert [p.name for p in written] == ["fit.html", *figures, "fit.json", "candidates.csv"]
    assert all(p.is_file() for p in written)
    links = {a.get("href") for t, a in outline.elements if t == "a"}
    assert {p.name for p in written[1:]} <= links


def test_the_same_figures_page_and_data_again(
    selection: Selection, train: FrequencyResponse, test: FrequencyResponse, written: list[Path]
) -> None:
    """One figure, drawn and written by what draws and writes all; `disting fit` writes all twice
    in the slow one.
    """
    content = {p.name: p.read_bytes() for p in written}
    drawn = importance_bars(selection.described, selection.thresholds)
    for kind in ("svg", "png", "pdf"):
        assert getattr(drawn, kind) == content[f"{drawn.name}.{kind}"], (drawn.name, kind)
    assert drawn.inline in content["fit.html"].decode()
    assert candidates_csv(selection).encode() == content["candidates.csv"]
    assert json.loads(content["fit.json"]) == json.loads(json.dumps(selection_to_dict(selection)))


@pytest.mark.slow
def test_two_runs_write_the_same_bytes(
    selection: Selection,
    train: FrequencyResponse,
    test: FrequencyResponse,
    written: list[Path],
    tmp_path: Path,
) -> None:
    again = write_fit_report(selection, tmp_path, train, test)
    assert [p.read_bytes() for p in again] == [p.read_bytes() for p in written]


def test_figures_of_the_parameters_say_how_much_is_allowed(outline: Outline) -> None:
    """And of how many parameters."""
    titles = [str(a["aria-label"]) for tag, a in outline.elements if tag == "svg"]
    assert sum("allowed 1000" in title for title in titles) == 2  # wide and narrow
    assert sum(" for all 5, " in title for title in titles) == 2


def test_nothing_is_fetched(written: list[Path], outline: Outline) -> None:
    text = written[0].read_text(encoding="utf-8")
    assert "http:" not in text and "https:" not in text
    beside = {p.name for p in written}
    for _, attributes in outline.elements:
        for key in ("src", "href", "action"):
            target = attributes.get(key) or "#"
            assert target.startswith(("#", "data:image/svg+xml,")) or target in beside


def test_ids_are_unique_and_links_lead_somewhere(outline: Outline) -> None:
    ids = [a["id"] for _, a in outline.elements if "id" in a]
    assert len(ids) == len(set(ids))
    inner = {
        str(a["href"])[1:] for _, a in outline.elements if str(a.get("href", "")).startswith("#")
    }
    assert inner and inner <= set(ids)


def test_hostile_text_stays_text(outline: Outline, empty: Outline) -> None:
    for page in (outline, empty):
        assert HOSTILE in page.text
        assert not any(t == "img" or "onerror" in a for t, a in page.elements)


def test_the_result_comes_first(selection: Selection, outline: Outline) -> None:
    said = " ".join(outline.text.split())
    admissible = sum(c.admissible for c in selection.candidates)
    others, more = len(selection.members) - 1, len(selection.containing)
    assert (others, more) == (0, 3)
    order = (
        "2 masses, friction at the load (b2): this explains the measurement",
        *first_lines(selection),
        f"misfit {readable(selection.explanation.chi2)}",
        "structures left 1 of 12",
        "3 more contain it",
        "resonance 1 58",
        "The rule: Of",
    )
    places = [said.index(words) for words in order]
    assert places == sorted(places)
    assert f"5 parameters, cost J = {readable(selection.described.j_train)} on training" in said
    assert f"{admissible} of 12 fitted candidates are admissible" in said
    assert "antiresonance 1" in said and "kg m²" in said and "N m s/rad" in said
    drawings = [a for t, a in outline.elements if t == "svg"]
    sketched = len(selection.members) + sum(len(m.twins) for m in selection.members)
    assert len(drawings) == 1 + sketched + 2 * len(FIGURES) and all(
        a.get("aria-label") for a in drawings
    )


def test_that_a_chain_explains_does_not_make_the_machine_one(written: list[Path]) -> None:
    page = written[0].read_text(encoding="utf-8")
    assert page.count("The machine need not be a chain") == 1


def test_every_candidate_has_a_row_and_its_reasons(selection: Selection, outline: Outline) -> None:
    rows = [t for t, a in outline.elements if t == "th" and a.get("scope") == "row"]
    assert len(rows) >= len(selection.candidates)
    assert [a for t, a in outline.elements if a.get("class") == "chosen"] != []
    for candidate in selection.candidates:
        assert all(reason in outline.text for reason in candidate.reasons)


def test_more_candidates_than_fit_are_behind_details(
    selection: Selection,
    train: FrequencyResponse,
    starts: FigureFiles,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # the package has a function of the module's name
    monkeypatch.setitem(import_module("disting.report.fit.selection_page").ALWAYS, "first", 10)
    text = fit_page(selection, [], [starts], train)
    assert "<summary>All 12 candidates</summary>" in text
    assert len(re.findall('class="plain candidates"', text)) == 2
    assert len(re.findall('class="chosen"', text)) in (1, 2)


def test_data_are_the_selection_s_own(selection: Selection, written: list[Path]) -> None:
    assert selection.selected is not None
    chain, values = read_model(written[-2])
    assert chain == DRIVE and values == selection.selected.estimate.parameters
    assert len(json.loads(written[-2].read_text(encoding="utf-8"))["candidates"]) == 12
    rows = list(csv.DictReader(written[-1].read_text(encoding="utf-8").splitlines()))
    assert [row["rank"] for row in rows] == [str(i) for i in range(1, 13)]
    assert [float(row["j_test"]) for row in rows] == [c.j_test for c in selection.candidates]
    assert [row["admissible"] == "true" for row in rows] == [
        c.admissible for c in selection.candidates
    ]
    assert all(bool(row["reasons"]) != (row["admissible"] == "true") for row in rows)


def test_nothing_admissible_is_said_with_the_nearest_and_why(
    nothing: Selection, empty: Outline
) -> None:
    assert nothing.selected is None
    said = " ".join(empty.text.split())
    assert said.startswith(
        f"Fit: no admissible model disting {__version__} Help: disting fit --help Guide and glossary: disting"
        " report 3 writes them No model is admissible " + " ".join(first_lines(nothing))
    )
    first = nearest(nothing)[0]
    assert all(reason in said for reason in first.reasons)
    assert "at its bound" in said and "fixed" in said and "J cross-validated" in said
    assert "each line is predicted by a fit without it" in said


def test_text_and_notebook_say_why_nothing_is_admissible(
    nothing: Selection, train: FrequencyResponse
) -> None:
    lines = list(fit_text(nothing, train))
    why = lines[: lines.index("more excitation or wider --thresholds may help")]
    for candidate in nothing.candidates[:8]:
        drawn = text_drawing(candidate.chain)
        assert f"  {drawn}: {'; '.join(candidate.reasons)}" in why
    assert "No candidate is admissible." in nothing._repr_html_()


def test_the_nearest_exceeds_its_thresholds_least(nothing: Selection) -> None:
    excess = [
        max(x.value / x.threshold for x in limits(c, nothing.thresholds)) for c in nearest(nothing)
    ]
    assert excess == sorted(excess) and excess[0] > 1


def test_the_page_describes_the_candidate_that_its_first_lines_are_about(
    nothing: Selection, empty: Outline
) -> None:
    """Where none is admissible: not the one nearest to its thresholds, which may fit worse."""
    assert nothing.described is nothing.candidates[0] is not nearest(nothing)[0]
    said = " ".join(empty.text.split())
    assert f"{name_of(nothing.described.chain)} comes near" in said


MISSED = Miss(30.0, 40.0, 0.2, 0.3, 0.8)
NO_PART = {"chi2": 1e3, "chi2_apart": 1e3}
DEGREES = {
    "apart": (
        {"chi2": 50.0, "chi2_apart": 1.0, "worst_apart": 1.0},
        "explains this data apart from small differences over the band: noise alone stays below",
        ": this explains the measurement apart from a part that it misses",
    ),
    "apart from one place": (
        {"chi2": 50.0, "chi2_apart": 1.0, "worst_apart": 1.0, "misses": (MISSED,)},
        "explains this data apart from 30 to 40 Hz (by up to 20 % and 17 degrees)",
        ": this explains the measurement apart from a part that it misses",
    ),
    "near": (
        {"is_beaten": True},
        "comes near, but misses it by more than noise (chi2 per line",
        "No fitted structure explains the measurement fully; near it: 2 masses",
    ),
    "not": (
        NO_PART,
        "structure: none of the candidates that may be selected explains this data",
        "No fitted structure explains the measurement",
    ),
    "noise": (
        {"clear": 0.01},
        "none of the candidates explains this data: it is mostly noise, only",
        "The measurement is mostly noise",
    ),
    "few": (
        {"lines": 3, "needed": 10},
        "structure: 3 lines are too few to judge 2:1+b2, the best candidate: at least 10 are needed",
        "3 lines are too few to judge a structure",
    ),
}


@pytest.mark.parametrize("degree", DEGREES)
def test_each_degree_of_an_explanation_has_its_words(selection: Selection, degree: str) -> None:
    changes, said, title = DEGREES[degree]
    told = replace(selection, explanation=replace(selection.explanation, **changes))
    assert said in first_lines(told)[1]
    assert title in answer(told, []).title
    assert ("The data are mostly noise." in told._repr_html_()) == (degree == "noise")
    if degree in ("not", "noise", "few"):
        assert (
            "use its values" in first_lines(told)[1] and suspicions(told)[0] in first_lines(told)[1]
        )


def test_what_would_explain_data_that_no_candidate_explains_is_named(selection: Selection) -> None:
    """A branch, another quantity: with the command that fits it."""
    nothing = replace(selection.explanation, **NO_PART)
    branch = Outside(LookAlikeKind.BRANCH, "1=2, 1=3; F1; S1", {}, 1.2, True, 0.1)
    _, structure, more = first_lines(replace(selection, explanation=nothing, outside=(branch,)))
    assert "outside the candidates this machine explains it: " in structure
    assert '--models "1=2, 1=3; F1; S1" with --masses' in more
    readings = tuple(
        QuantityReading(Quantity(name), selection.described.estimate, size, name == "acceleration")
        for name, size in (("acceleration", 1e3), ("velocity", 1.1))
    )
    told = replace(selection, explanation=nothing, selected=None, quantities=readings)
    wanted = "that it is acceleration is assumed; give --quantity velocity, or --quantity accel"
    assert told.question == "" and wanted in first_lines(told)[2]
    assert any(wanted in sentence for sentence in suspicions(told))


def test_what_training_and_test_data_give_differently_is_said(
    selection: Selection, train: FrequencyResponse
) -> None:
    first, *others = selection.members
    apart = replace(first, disagreements=(Disagreement("k12", 900.0, 990.0, 6.0),))
    told = replace(selection, members=(apart, *others))
    assert any(
        "training and test data disagree on k12 (900 and 990, 6 standard errors apart)" in sentence
        for sentence in suspicions(told)
    )
    (line,) = [line for line in fit_text(told, train) if line.startswith("  k12 ")]
    assert line.endswith("   test data: 990, 6 standard errors apart")


def test_why_this_one_and_not_the_lowest_cost(selection: Selection) -> None:
    said = dict(reasons(selection))
    assert "1 candidate the data do not exclude (3 more contain it)" in said["Choice"]
    out = sum(c.excluded is not None for c in selection.candidates)
    assert f" {out} candidate" in said["Choice"]
    assert set(said) == {
        "Validation",
        "Scatter",
        "Choice",
        "Akaike weights",
        "Starts",
        "Standard errors",
    }


def test_the_weakest_combination_names_its_largest_part_first(selection: Selection) -> None:
    terms = re.findall(r"ln (\w+)", weakest(selection.described))
    assert set(terms) == set(selection.described.practical.worst_direction)
    assert weakest(selection.described).startswith(f"ln {terms[0]}")


def test_an_unknown_parameter_has_no_profile(
    selection: Selection, train: FrequencyResponse, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="k23"):
        write_fit_report(selection, tmp_path / "x", train, profiles=["k23"])
    assert not (tmp_path / "x").exists()


FAR = replace(DRIVE, meas_plus=2)


def test_structures_that_no_data_can_tell_apart_are_named(starts: FigureFiles) -> None:
    train, test, loose = response(0, 2, 1, FAR), response(1, 3, 2, FAR), Thresholds(*3 * (1e12,))
    candidates = [c for c in chosen_ports([2], "1", "last") if not c.lag and not c.dead_time]
    found = select(train, candidates, test=test, thresholds=loose)
    assert (
        found.selected is not None
        and len(found.selected.chain.ground_dampers) == 1
        and found.saved == 1
    )
    said = " ".join(Outline(fit_page(found, [], [starts], train)).text.split())
    assert (
        "2 masses, force 1, sensor 2, damper b2. 2 masses, force 1, sensor 2, damper b1 and" in said
    )
    assert "2 masses, force 1, sensor 2, dampers b1, b2." in said
    assert "1 fit saved" in said and "None: each of" not in said
    lines = list(fit_text(found, train))
    same = next(
        i for i, line in enumerate(lines) if line.startswith("each of these gives the same")
    )
    assert lines[same + 1].startswith("  2 masses, force 1, sensor 2, damper b")


def test_no_alternatives_are_said_so(outline: Outline) -> None:
    assert (
        "None: for generic positive parameters none of the 7 other candidates with 2 masses has"
        " the transfer function" in " ".join(outline.text.split())
    )


def test_what_no_data_determine_is_said_in_words() -> None:
    free = replace(FAR, ground_dampers=())
    train = response(0, 2, 1, free)
    found = select(train, [free], test=response(1, 3, 2, free))
    candidate = found.described
    drawn = [
        parameters_by_threshold(found.candidates, found.thresholds),
        importance_bars(candidate, found.thresholds),
        collinearity_dots(candidate, found.task, found.thresholds),
    ]
    page = fit_page(found, physical(candidate, found.task), [d for d in drawn if d], train)
    said = " ".join(Outline(page).text.split())
    determined = "ot identifiable: no data determine more than k12/d12, m1 + m2, k12/(m1*m2)"
    assert f"N{determined}. Known parameters" in said and "no, not identifiable" in said
    none = select(train, [free], test=response(1, 3, 2, free), rule=Rule.PAPER)
    lines = list(fit_text(none, train))
    assert none.selected is None
    assert lines[lines.index("more excitation or wider --thresholds may help") + 1].startswith(
        "not identifiable: only known parameters (--fix NAME=VALUE)"
    )
    assert "∞" not in said and not re.search(r"\binf\b", said)
    (plain,) = json.loads(json.dumps(selection_to_dict(found), allow_nan=False))["candidates"]
    assert plain["unidentifiable"] == f"n{determined}" and plain["condition_index"] is None
    assert f"n{determined}" in candidates_csv(found)
