"""disting report: pages, figures and tables of whole catalogues, or of a file of models."""

import argparse
from concurrent.futures import Executor
from pathlib import Path

from disting.catalogs import Catalog, catalog
from disting.catalogs.dampers import (
    SHIPPED_SIZES as DAMPER_SIZES,
    damper_catalog,
)
from disting.catalogs.files import SHIPPED_SIZES
from disting.catalogs.network_files import SHIPPED, recall
from disting.catalogs.sizes import sizes_catalog
from disting.cli.arguments import Listed, add_out, add_work, size_or_list
from disting.cli.relations import relations_in_words
from disting.cli.run import parser
from disting.cli.verdicts import LISTS, list_of
from disting.cli.workers import announce, announce_pairs, engine_for, pairs_by_size, pairs_work
from disting.errors import InputError
from disting.files import write_whole
from disting.general.model_files import ModelList
from disting.verdict.engine import Engine, Progress
from disting.verdict.result import Query, View


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    text = f"numbers of masses, files of models, or {LISTS}"
    metavar = "N|FILE.json|FAMILY"
    parser.add_argument("masses", type=size_or_list, nargs="*", metavar=metavar, help=text)
    choice = parser.add_mutually_exclusive_group()
    for name in ("damped", "undamped", "both"):
        choice.add_argument(
            f"--{name}", dest="damping", action="store_const", const=name, help=f"{name} models"
        )
    parser.set_defaults(damping="both")
    add_out(parser, "reports")
    add_work(parser)


def run(options: argparse.Namespace) -> int:
    """Write pages, figures and tables."""
    from disting.report.model_list import page_name
    from disting.report.write import write_report

    if not options.masses:
        raise InputError("name at least one number of masses, or a file of models")
    files = [x for x in options.masses if isinstance(x, Listed)]
    options.masses = [x for x in options.masses if not isinstance(x, Listed)]
    lists = [(page_name(Path(file)), file, list_of(file)) for file in files]
    if files and not options.masses and options.damping != "both":
        raise InputError(f"--{options.damping} belongs to numbered chains: leave it away")
    names = [name for name, *_ in lists]
    if len(set(names)) < len(names):
        raise InputError("two files would have one page: rename one of them")
    # pages of lists first: the start page and the search of the site find them
    for name, file, models in lists:
        _model_list(options, models, file, name)
    if options.masses:
        _catalogues(options)
    elif lists and (options.out / "index.html").is_file():
        write_report((), options.out, commands=parser())
    return 0


def _model_list(options: argparse.Namespace, models: ModelList, file: Listed, name: str) -> None:
    """Write the page of a file of models, or of a family of networks."""
    from disting.report import ladenheim
    from disting.report.listing import Listing, judge
    from disting.report.model_list import write_model_list

    title = models.title or Path(file).stem
    with engine_for(options) as (engine, pool, progress):
        if isinstance(file, str):
            recall(file, engine)
        if file not in SHIPPED:
            sides = engine.general_subjects(models.models)
            announce_pairs(str(file), sides, Query(View.POSITIVE), engine, options.jobs)
        decided = judge(models, engine, executor=pool, progress=progress)
    shown = Listing(decided, title, name)
    site = bool(options.masses)
    paths = write_model_list(shown, options.out, site=site)
    if file == ladenheim.FAMILY:
        page = ladenheim.ladenheim_page(shown, site=site or (options.out / "index.html").is_file())
        paths.append(write_whole(options.out / ladenheim.ADDRESS, [page]))
    relations = relations_in_words(v.relation for *_, v in decided.pairs(View.POSITIVE))
    print(f"{title}, over positive parameters: {relations}")
    print(f"{len(paths)} files in {options.out}; open {paths[0]}")


def _catalogues(options: argparse.Namespace) -> None:
    """Write the pages of catalogues."""
    from disting.report.write import write_report

    choices = _choices(options)
    for damped in choices:
        new = [n for n in options.masses if n not in SHIPPED_SIZES]
        announce(pairs_work(damped), pairs_by_size(new, across=False), options.jobs)
    with engine_for(options) as (engine, pool, progress):
        catalogs = [
            _catalog(n, damped, engine, pool, progress)
            for n in options.masses
            for damped in choices
        ]
    sizes = set(options.masses)
    with_dampers = [
        damper_catalog(n, damped=d) for n in options.masses if n in DAMPER_SIZES for d in choices
    ]
    # of all shipped sizes, whichever are asked for
    together = len(sizes.intersection(SHIPPED_SIZES)) > 1
    across = [sizes_catalog(damped=d, known=catalogs) for d in choices if together]
    paths = write_report(catalogs, options.out, with_dampers, parser(), across)
    for c in catalogs:
        relations = relations_in_words(v.relation for *_, v in c.pairs())
        print(
            f"{c.name}, over positive parameters: {relations}; {len(c.classes())} groups of"
            " indistinguishable models"
        )
    print(f"{len(paths)} files in {options.out}; open {options.out / 'index.html'}")


def _choices(options: argparse.Namespace) -> list[bool]:
    """Undamped, damped, or both."""
    return [False, True] if options.damping == "both" else [options.damping == "damped"]


def _catalog(
    n: int, damped: bool, engine: Engine, pool: Executor | None, progress: Progress
) -> Catalog:
    """The shipped catalogue, or a new one where none is shipped."""
    from disting.catalogs.build import build

    if n in SHIPPED_SIZES:
        return catalog(n, damped=damped)
    return build(n, damped=damped, engine=engine, executor=pool, progress=progress)
