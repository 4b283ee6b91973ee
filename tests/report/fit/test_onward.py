"""Links to the pages of the catalogues, and commands that run as they are printed."""

import shlex
from dataclasses import replace
from pathlib import Path

import pytest

from disting.cli import main
from disting.fit.judge.members import Twin
from disting.fit.results.selection import Selection
from disting.model.chain import Chain
from disting.report.fit.links import Link, Site, folders_near, next_steps, step_to, steps_of
from disting.report.fit.next_of_fit import NetworkAdvice
from tests.report.fit.conftest import DRIVE

REPORTS = Path(__file__).parents[3] / "reports"


LOADED = Chain(3, damped=True, ground_dampers=(1, 3))


@pytest.mark.parametrize(
    ("chain", "link"),
    [
        (LOADED, Link("3:1+b1+b3", "dampers-3-damped.html#1+b1+b3")),
        (
            replace(LOADED, lag=True, dead_time=True),
            Link("3:1+b1+b3", "dampers-3-damped.html#1+b1+b3"),
        ),
        (replace(LOADED, ground_dampers=(), dead_time=True), Link("3:1", "models/3-damped/1.html")),
        (Chain(3, damped=False), Link("3:1", "models/3-undamped/1.html")),
        (DRIVE, Link("2:1", "models/2-damped/1.html")),  # no page of ground dampers for 2 masses
    ],
)
def test_structures_lead_to_their_pages(chain: Chain, link: Link) -> None:
    assert Site(REPORTS, REPORTS).page(chain) == link
    assert Site(REPORTS, REPORTS / "new").page(chain) == replace(link, address=f"../{link.address}")


def test_what_has_no_page_has_no_link(tmp_path: Path) -> None:
    assert (
        Site(REPORTS, REPORTS).page(Chain(7, damped=False))
        is None
        is Site(tmp_path, tmp_path).page(DRIVE)
    )


def test_a_structure_with_a_damper_across_its_gap_has_no_page(
    tmp_path: Path,
) -> None:
    across, site = Chain(3, 1, 1, 2, 1, 2, damped=True), Site(tmp_path, tmp_path)
    (tmp_path / "models" / "3-damped").mkdir(parents=True)
    (tmp_path / "models" / "3-damped" / "6.html").touch()
    assert site.page(across) == Link("3:6", "models/3-damped/6.html")
    assert site.page(replace(across, gap_damper=True)) is None


def test_networks_that_no_others_imitate_are_told_by_more_of_the_same() -> None:
    one = NetworkAdvice("my fit.json", ("R1-C1",), ())
    alone = "the data of my fit.json leave R1-C1; no other candidate gives the same responses as one of them"
    assert one.first == alone == "; ".join(one.sentences)
    both = NetworkAdvice("my fit.json", ("R1-C1", "R1-L1"), ())
    assert both.first == both.sentences[0] == "the data of my fit.json leave R1-C1 | R1-L1"
    assert both.sentences[1].endswith("separates these: disting plan 'my fit.json'")


def test_pages_beside_are_found_and_addresses_are_quoted(tmp_path: Path) -> None:
    (tmp_path / "a b" / "models" / "2-damped").mkdir(parents=True)
    (tmp_path / "a b" / "models" / "2-damped" / "1.html").touch()
    assert Site(tmp_path / "a b", tmp_path).page(DRIVE) == Link(
        "2:1", "a%20b/models/2-damped/1.html"
    )
    assert (
        folders_near(tmp_path / "a b") == tmp_path / "a b" == folders_near(tmp_path / "a b" / "fit")
    )
    assert folders_near(tmp_path) == tmp_path


def test_a_page_finds_the_way_home_where_there_is_a_guide(tmp_path: Path) -> None:
    assert Site(REPORTS, REPORTS / "fit").home == "../" and Site(REPORTS, REPORTS).home == "./"
    (tmp_path / "a b" / "guide").mkdir(parents=True)
    assert Site(tmp_path / "a b", tmp_path).home is None
    (tmp_path / "a b" / "guide" / "index.html").touch()
    assert Site(tmp_path / "a b", tmp_path).home == "a%20b/"


@pytest.fixture(scope="module")
def both(selection: Selection) -> Selection:
    """As if the data excluded neither of two structures."""
    (first,) = selection.members
    other = next(c for c in selection.candidates if c.chain == replace(DRIVE, ground_dampers=(1,)))
    return replace(selection, members=(first, replace(first, candidate=other)))


@pytest.mark.full
def test_each_structure_has_its_commands(both: Selection) -> None:
    first, second = both.members
    compare, equivalents = (step.command for step in next_steps(both))
    assert compare == "disting compare 2:1+b2 2:1+b1 --damped"
    assert equivalents.startswith('disting equivalents 2:1+b2 --damped --to "2+b*" --set m1=0.0')
    assert steps_of(both, first) == []
    assert [step.command[:35] for step in steps_of(both, second)] == [
        "disting compare 2:1+b1 2:1+b2 --dam",
        "disting equivalents 2:1+b1 --damped",
    ]


@pytest.mark.full
def test_commands_run_as_they_are_printed(
    both: Selection, capsys: pytest.CaptureFixture[str]
) -> None:
    first, second = both.members
    twin = Twin(second.candidate.chain, second.candidate.estimate.parameters)
    steps = [*next_steps(both), *steps_of(both, second), step_to(first, twin)]
    for step in steps:
        program, *arguments = shlex.split(step.command)
        assert program == "disting" and main(arguments) == 0, step
    assert "DISTINGUISHABLE" in capsys.readouterr().out
