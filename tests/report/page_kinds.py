"""Every kind of page that is written, and a folder with all of them."""

import json
import shutil
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from disting import Engine, Quantity, network_of
from disting.catalogs import catalog
from disting.catalogs.dampers import damper_catalog
from disting.catalogs.network_files import recall
from disting.catalogs.sizes import SizesCatalog, sizes_catalog
from disting.cli import main
from disting.cli.run import parser
from disting.cli.verdicts import list_of
from disting.fit.judge.readings import QuantityReading
from disting.fit.networks import fit_networks
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import figure_1
from disting.fit.search.joint import FurtherResponse
from disting.fit.search.setup import Setup
from disting.fit.select import select
from disting.general.model_files import ModelList
from disting.measurement import FrequencyResponse, look
from disting.report import write_report
from disting.report.fit import fit_page, waterfall, write_fit_report
from disting.report.fit.links import Site
from disting.report.fit.network_page import network_page, write_network_report
from disting.report.fit.style import FigureFiles
from disting.report.listing import Listing, judge
from disting.report.look import write_look
from disting.report.model_list import write_model_list
from tests.report.fit.conftest import DRIVE, response
from tests.report.fit.test_network_page import TEXTS, cell
from tests.report.fit.test_responses import data
from tests.report.test_model_list import MODELS, hostile, of

REPORTS = Path(__file__).parents[2] / "reports"
SHIPPED = ("paper", "notebooks")  # parts of the site that other commands write, in minutes
LONG = (
    "fit", "glossary", "theorems", "gallery", "notebook-bench-commissioned", "commands",
    "python-measurement",
)  # fmt: skip
SIGHTS = ((1280, 800), (1920, 1080), (390, 844), (320, 640))
SCHEMES = ("light", "dark")


def kinds(masses: int) -> dict[str, str]:
    """Addresses of pages of every kind, for chains of so many masses, in the folder that
    `write_all` writes.
    """
    chains, dampers, motion = (
        f"{kind}-{masses}-damped.html" for kind in ("chains", "dampers", "motion")
    )
    return {
        "start": "index.html",
        "start, a machine described": f"index.html#machine={masses},damped,2,2,{masses},1,3",
        "catalogue": chains,
        "catalogue, a pair": f"{chains}#2-5",
        "catalogue, a model": f"{chains}#A5",
        "list of models": "list-vessels.html#1-2",
        "list of models, a model": "models/list-vessels/1.html",
        "family of networks": "list-circuits-4.html#10-26",
        "family of networks, a model": "models/list-circuits-4/27.html",
        "list of models alone, hostile": "alone/list-hostile.html",
        "model": f"models/{masses}-damped/1.html",
        "sizes": "sizes-damped.html",
        "sizes, a pair": "sizes-damped.html#2:1-3:4",
        "dampers": dampers,
        "dampers, a pair": f"{dampers}#2+b1+b2/5+b1+b2+b3",
        "dampers, a structure": f"{dampers}#A3",
        "next": f"next-{masses}-damped.html",
        "motion": f"{motion}#A1-A4",
        "motion, presented": f"{motion}#A1-A2,present",
        "guide": "guide/index.html",
        **{f"guide, {name}": f"guide/{name}.html" for name in LONG},
        "paper": "paper/index.html",
        "fit": "fit/fit.html",
        "fit of two responses": "alone/joint/fit.html",
        "fit, nothing explains": "alone/nothing/fit.html",
        "fit, the quantity is open": "alone/quantity/fit.html",
        "fit of networks": "alone/networks/fit.html",
        "plan of a fit": "alone/networks/plan.html",
        "look": "alone/look/look.html",
        "look, refused": "alone/refused/look.html",
    }


def write_all(folder: Path, masses: int, *, whole: bool) -> None:
    """Write a site of chains of so many masses, and pages without one in `alone`; `whole`: all
    models of larger lists, fits with all their figures and all their candidates.
    """
    for part in SHIPPED:
        shutil.copytree(REPORTS / part, folder / part)
    sizes = sizes_catalog(damped=True)
    write_report(
        [catalog(masses, damped=True)],
        folder,
        [damper_catalog(masses, damped=True)],
        parser(),
        across=[sizes if whole else SizesCatalog(sizes.catalogs[:3], sizes.records)],
    )
    engine = Engine()
    write_model_list(Listing(judge(of(MODELS), engine), "Two vessels", "list-vessels"), folder)
    recall("circuits-4", engine)  # as `disting report circuits-4` does
    circuits = list_of("circuits-4")
    models = circuits.models
    shown = circuits if whole else ModelList((*models[:26], models[44]))  # the last has an equal
    family = judge(shown, engine)
    write_model_list(Listing(family, "Circuits", "list-circuits-4"), folder)
    write_model_list(Listing(judge(hostile(), engine), "Hostile", "list-hostile"), folder / "alone")
    found = fits(whole)
    starts = waterfall(found[0][1].described)
    write_look(
        look(_record(folder / "record.csv"), input="u [Nm]", output="y [rad]"),
        folder / "alone" / "look",
    )
    write_look(look(_refused(folder / "refused.csv")), folder / "alone" / "refused")
    _write_networks(folder / "alone" / "networks", None if whole else starts)
    for address, selection, train, test in found:
        if whole:
            write_fit_report(selection, folder / address, train, test)
        else:
            _write_fit(selection, folder / address, train, starts)


def _write_networks(folder: Path, one: FigureFiles | None) -> None:
    """The page of a fit of circuits of which two are left and two cannot be told apart, and the
    page of its plan; with `one` figure for all, or of networks of five parameters with their own.
    """
    if one is None:
        omega = 2 * np.pi * np.logspace(-1, 4, 30)
        noise = np.random.default_rng(2).normal(size=(2, 30)) * 0.04
        impedance = 10 + 1 / (1 / 80 + 2e-5 * (1j * omega) ** 0.93)
        measured = impedance * (1 + noise[0] + 1j * noise[1])
        data = FrequencyResponse(omega, measured, quantity=Quantity.POSITION, is_impedance=True)
        texts = ("R0-p(R1,P1)", "R0-p(R1,C1)-p(R2,C2)", "p(R2,R0-P1)", "R0-p(R1,C1)")
        write_network_report(fit_networks(data, list(map(network_of, texts))), folder)
    else:
        found = fit_networks(cell(), list(map(network_of, TEXTS)))
        figures = [replace(one, name=name) for name in ("nyquist", "bode", "residuals")]
        folder.mkdir(parents=True)
        _write_page(folder, network_page(found, figures, folder), figures)
        (folder / "fit.json").write_text(json.dumps(found.to_dict()), encoding="utf-8")
    assert main(["plan", str(folder / "fit.json"), "--out", str(folder)]) == 0


def _record(path: Path) -> Path:
    """Three periods of a multisine, and a motion that follows it."""
    time = np.arange(3000) / 1000
    phases = np.outer(time, np.arange(5, 200, 2)) + np.arange(98) ** 2 / 50
    u = np.cos(2 * np.pi * phases).sum(axis=1)
    y = np.convolve(np.concatenate([u[:1000], u]), np.exp(-np.arange(50) / 9))[1000:4000]
    rows = zip(time.tolist(), u.tolist(), y.tolist(), strict=True)
    text = ["t [s],u [Nm],y [rad]", *(f"{t},{a},{b}" for t, a, b in rows), ""]
    path.write_text("\n".join(text))
    return path


def _refused(path: Path) -> Path:
    """A unit that is unknown, and a long hostile name."""
    names = f"frequency,magnitude [furlong],{'<script>alert(1)</script>' * 4}"
    path.write_text("\n".join([names, *(f"{k},{k},{k}" for k in range(1, 30)), ""]))
    return path


def fits(whole: bool) -> list[tuple[str, Selection, FrequencyResponse, FrequencyResponse]]:
    """Where the pages of fits lie, and what they show: an answer, two responses, none, the
    question for the sensor quantity.
    """
    train, test = response(0, 2, 1), response(1, 3, 2)
    some = figure_1((1, 2)) if whole else [replace(DRIVE, dead_time=late) for late in (False, True)]
    second = Setup("2")
    further = FurtherResponse(data(second, 2, 0.01), second, data(second, 3, 0.03))
    both = data(Setup(), 10, 0.01), data(Setup(), 11, 0.03)
    pair = [DRIVE, *([replace(DRIVE, ground_dampers=(1, 2))] if whole else [])]
    found = select(train, some, test=test)
    return [
        ("fit", found, train, test),
        ("alone/quantity", asking(found), train, test),
        ("alone/joint", select(both[0], pair, test=both[1], further=[further]), *both),
        ("alone/nothing", select(train, figure_1((1,))[:2], test=test), train, test),
    ]


def asking(found: Selection) -> Selection:
    """The selection, if a speed had explained its data as well."""
    best = found.described.estimate
    readings = (
        QuantityReading(Quantity.ACCELERATION, best, 1.0, is_assumed=True, integrates=True),
        QuantityReading(Quantity.VELOCITY, best, 1.02),
    )
    return replace(
        found,
        selected=None,
        members=(),
        containing=(),
        relied_on=(),
        alternatives=(),
        quantities=readings,
    )


def _write_fit(selection: Selection, out: Path, train: FrequencyResponse, one: FigureFiles) -> None:
    """The page of a fit with one figure, and empty files beside it."""
    out.mkdir(parents=True, exist_ok=True)
    _write_page(out, fit_page(selection, [], [one], train, site=Site(out.parent, out)), [one])


def _write_page(out: Path, page: str, figures: Sequence[FigureFiles]) -> None:
    """A page of a fit, and empty files beside it."""
    (out / "fit.html").write_text(page, encoding="utf-8")
    for figure in figures:
        for kind in ("svg", "png", "pdf"):
            (out / f"{figure.name}.{kind}").touch()
    for name in ("fit.json", "candidates.csv"):
        (out / name).touch()
