"""disting catalog: compute, settle and verify catalogues."""

import argparse
from concurrent.futures import Executor
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

from disting.catalogs import Catalog, catalog
from disting.catalogs.dampers import DamperFamily
from disting.catalogs.files import shipped_folder
from disting.catalogs.network_files import SHIPPED, build_networks
from disting.cli.arguments import add_masses, add_out, add_work, size_or_family
from disting.cli.workers import announce, engine_for, pairs_by_size, pairs_work
from disting.network.families import family_of
from disting.store import Store

if TYPE_CHECKING:
    from disting.catalogs.build import FamilyCheck
from disting.verdict.engine import Engine, Progress

HOLDS_NOW = "all is as it is computed now, and every evidence holds"
NOT_SEARCHED = "; {} pairs that a brief search left open were not searched again (--search-open)"
LATE = "; what can be determined of {} networks was not found in time now, their lines not compared"


def add_build_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `build`."""
    add_masses(parser)
    add_out(parser, "catalog")
    add_work(parser)


def add_candidates_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `candidates`."""
    add_out(parser, "catalog")
    add_work(parser)


def add_sizes_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `sizes`."""
    add_out(parser, "catalog")
    add_work(parser)


def add_families_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `families`."""
    text = f"families of networks (default: {' '.join(SHIPPED)})"
    parser.add_argument("families", nargs="*", metavar="FAMILY", help=text)
    add_out(parser, "catalog")
    add_work(parser)


def add_menus_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `next`."""
    add_masses(parser, default="2 3 4 5")
    add_out(parser, "catalog")
    add_work(parser)


def add_settle_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `settle`."""
    add_masses(parser)
    _add_read_folder(parser, Path("catalog"), "catalog")


def add_verify_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `verify`."""
    text = "numbers of masses, or families of networks such as circuits-4"
    parser.add_argument("masses", type=size_or_family, nargs="+", metavar="N|FAMILY", help=text)
    _add_read_folder(parser, shipped_folder(), "the shipped one")
    text = "search again what a brief search left open in a family (hours)"
    parser.add_argument("--search-open", action="store_true", help=text)
    text = "keep in FILE what this verification computes; given again, it goes on from there"
    parser.add_argument("--resume", default="", metavar="FILE", help=text)
    add_work(parser)


def _add_read_folder(parser: argparse.ArgumentParser, default: Path, said: str) -> None:
    text = f"folder (default: {said})"
    parser.add_argument("--catalog", type=Path, default=default, metavar="DIR", help=text)


def build(options: argparse.Namespace) -> int:
    """Compute catalogues."""
    from disting.catalogs.build import build, write

    for damped in (False, True):
        counts = pairs_by_size(options.masses, across=False)
        announce(pairs_work(damped), counts, options.jobs)
    with engine_for(options) as (engine, pool, progress):
        for n in options.masses:
            pair = [
                build(n, damped=d, engine=engine, executor=pool, progress=progress)
                for d in (False, True)
            ]
            for path in write(pair, options.out)[:-1]:
                print(path)
    return 0


def candidates(options: argparse.Namespace) -> int:
    """Compute the verdicts on the candidates of a fit."""
    from disting.catalogs.candidates import matrix, write
    from disting.fit.search.candidates import figure_1

    with engine_for(options) as (engine, pool, progress):
        the_matrix = matrix(figure_1(), engine=engine, executor=pool, progress=progress)
    counts = ", ".join(f"{n} {relation}" for relation, n in the_matrix.counts().items())
    print(f"{write(the_matrix, options.out)}: {len(the_matrix.chains)} models, {counts}")
    return 0


def sizes(options: argparse.Namespace) -> int:
    """Compute the verdicts on pairs of models of different sizes."""
    from disting.catalogs.sizes import build_sizes, write

    with engine_for(options) as (engine, pool, progress):
        for damped in (False, True):
            text = build_sizes(damped=damped, engine=engine, executor=pool, progress=progress)
            print(write(text, damped, options.out))
    return 0


def families(options: argparse.Namespace) -> int:
    """Compute what is shipped of families of networks."""
    from disting.catalogs.next_files import write

    chosen = [family_of(name) for name in options.families or SHIPPED]
    with engine_for(options) as (engine, pool, progress):
        for family in chosen:
            text = build_networks(family, engine, executor=pool, progress=progress)
            print(write(text, options.out))
    return 0


def menus(options: argparse.Namespace) -> int:
    """Compute what to measure next for all groups of whole families."""
    from disting.catalogs.dampers import damper_catalog
    from disting.catalogs.next_files import (
        SHIPPED_SIZES as NEXT_SIZES,
        WITH_DAMPERS,
        build_next,
        write,
    )

    with engine_for(options) as (engine, pool, progress):
        for n, damped in product(options.masses or NEXT_SIZES, (False, True)):
            stored: list[Catalog | DamperFamily] = [catalog(n, damped=damped)]
            if n in WITH_DAMPERS:
                stored.append(damper_catalog(n, damped=damped))
            for this_catalog in stored:
                text = build_next(this_catalog, engine, executor=pool, progress=progress)
                print(write(text, options.out))
    return 0


def settle(options: argparse.Namespace) -> int:
    """Decide pairs of classes with dampers to the ground that are open, of the sizes that have
    files.
    """
    from disting.catalogs.build import settle_dampers
    from disting.catalogs.dampers import read

    with engine_for(options) as (engine, _, _):
        for n in options.masses:
            the_families = (read(options.catalog, n, damped) for damped in (False, True))
            count = sum(
                settle_dampers(family, options.catalog, engine.settings, print)
                for family in the_families
            )
            print(f"{n} masses with dampers to the ground: {count} pairs of classes settled")
    return 0


def verify(options: argparse.Namespace) -> int:
    """Verify catalogues; status 1 if something is wrong."""
    from disting.catalogs.build import verify_networks
    from disting.catalogs.files import SHIPPED_SIZES as CATALOGUED
    from disting.catalogs.sizes import verify_sizes

    sizes = [n for n in options.masses if isinstance(n, int)]
    networks = [name for name in options.masses if isinstance(name, str)]
    wrong = _wrong_by_second_opinion([*sizes, *networks], options.catalog)
    with engine_for(options) as (_, pool, progress), Store.open(options.resume) as kept:
        for name in networks:
            family = family_of(name)
            found = verify_networks(
                family,
                options.catalog,
                Engine(store=kept),
                search_open=options.search_open,
                executor=pool,
                progress=progress,
            )
            wrong += _report(name, [*found.wrong], _notes_of(found))
        for n, damped in product(sizes, (False, True)):
            fresh = Engine(store=kept)
            texts = _wrong_of_one_size(n, damped, options.catalog, fresh, pool, progress)
            wrong += _report(f"{n} masses, {_kind(damped)}", texts)
        for damped in (False, True) if set(CATALOGUED) <= set(sizes) else ():
            texts = verify_sizes(
                damped=damped,
                folder=options.catalog,
                engine=Engine(store=kept),
                executor=pool,
                progress=progress,
            )
            wrong += _report(f"different sizes, {_kind(damped)}", texts)
    return 1 if wrong else 0


def _notes_of(found: "FamilyCheck") -> str:
    """Sentence on a family that holds, and on what was not computed again."""
    notes = ((NOT_SEARCHED, found.not_searched), (LATE, found.late))
    return HOLDS_NOW + "".join(text.format(count) for text, count in notes if count)


def _wrong_by_second_opinion(names: list[int | str], folder: Path) -> list[str]:
    """Findings of the small checker; it takes seconds, so it comes first."""
    from disting.verdict.small_checker import opinion_on_files

    wrong = list[str]()
    for name in names:
        pattern = f"[!n]*-{name}-*damped" if isinstance(name, int) else f"networks-{name}"
        of_next = folder.glob(f"next-*{name}-*damped.jsonl") if isinstance(name, int) else ()
        files = sorted([*folder.glob(f"{pattern}.jsonl"), *of_next])
        if not files:
            continue  # the rebuild says which is missing
        opinion = opinion_on_files(files)
        wrong += _report(f"{name}, by check.py", [*opinion.wrong], opinion.counts)
    return wrong


def _wrong_of_one_size(
    n: int, damped: bool, folder: Path, fresh: Engine, pool: Executor | None, progress: Progress
) -> list[str]:
    """Faults of the files of chains of one size; nothing is taken from the cache: a verification
    computes, or goes on with what it has computed itself.
    """
    from disting.catalogs.build import verify as verify_chains, verify_dampers
    from disting.catalogs.dampers import SHIPPED_SIZES, read
    from disting.catalogs.next_files import SHIPPED_SIZES as NEXT_SIZES, WITH_DAMPERS, verify_next

    texts = list[str]()
    for check in (verify_chains, verify_dampers) if n in SHIPPED_SIZES else (verify_chains,):
        texts += check(
            n, damped=damped, folder=folder, engine=fresh, executor=pool, progress=progress
        )
    stored: list[Catalog | DamperFamily] = []
    if n in NEXT_SIZES:
        stored.append(catalog(n, damped=damped, folder=folder))
    if n in WITH_DAMPERS:
        stored.append(read(folder, n, damped))
    for this_catalog in stored:
        texts += verify_next(this_catalog, folder, fresh, executor=pool, progress=progress)
    return texts


def _kind(damped: bool) -> str:
    return "damped" if damped else "undamped"


def _report(
    what: str, texts: list[str], otherwise: str = "every byte and every evidence holds"
) -> list[str]:
    """Say what was found wrong, or what holds if nothing was; returns it."""
    print(f"{what}: {'; '.join(texts) or otherwise}")
    return texts
