"""The command line: parse, one call, print. Exit status 0 fine, 1 a failed verification, 2 bad usage or bad input."""

import argparse
import json
import re
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager
from pathlib import Path

from disting import __version__
from disting.catalogs import Catalog, catalog
from disting.catalogs.export import decisions_csv, decisions_json
from disting.catalogs.files import SHIPPED_SIZES, shipped_folder
from disting.comparison import compare
from disting.conditions.table import CONDITIONS
from disting.engine import Decisions, Engine, Progress, Store
from disting.errors import DistingError, InputError
from disting.model.chain import Chain, Sensor
from disting.model.drawing import LEGEND, text_drawing
from disting.model.family import Family
from disting.scheduling import executor
from disting.verdict import ALL_CONDITIONS, Query, Verdict, View

EPILOG = "conditions:\n" + "\n".join(f"  {c.number}  {c.title}: {c.text}" for c in CONDITIONS)
VIEWS = {"tf": View.TF, "markov": View.MARKOV, "all": View.COMBINED}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    warnings.showwarning = _warned
    try:
        options = _parser().parse_args(arguments)
        status: int = options.run(options)
        return status
    except DistingError as reason:
        print(f"disting: {reason}", file=sys.stderr)
        return 2
    except OSError as reason:
        print(f"disting: {reason.strerror or reason}: {reason.filename or ''}".rstrip(": "), file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("disting: interrupted; what was finished is kept in the cache", file=sys.stderr)
        return 130


def _models(options: argparse.Namespace) -> int:
    from rich.console import Console
    from rich.table import Table

    family = Family(options.masses, options.damped)
    with _engine(options) as (engine, pool, progress):
        rows = engine.profiles_of(family, executor=pool, progress=progress)
    table = Table("model", "gap", "act-", "act+", "meas-", "meas+", "degree", "free", "params", "rank", "drawing", box=None)
    for number, (chain, profile) in enumerate(zip(family, rows, strict=True), 1):
        n, m = profile.degrees
        numbers = (number, *chain.indices[1:], f"{n}/{m}", len(profile.form), profile.n_parameters, profile.rank)
        table.add_row(*map(str, numbers), text_drawing(chain).replace("[", r"\["))
    console = Console(highlight=False)
    console.width = max(console.width, 74 + 8 * family.n_masses)  # drawings are not cut, they may run over
    console.print(table)
    console.print(f"{len(family)} models; parameters of the first: {' '.join(family[1].parameters)}", markup=False)
    console.print(
        f"degree n/m of (25), free = non-constant coefficients, rank = determinable parameters\n{LEGEND}", markup=False
    )
    return 0


def _compare(options: argparse.Namespace) -> int:
    sensor = Sensor(options.sensor)
    references = [_reference(text) for text in (options.left, options.right)]
    chains = [Family(n, options.damped, sensor)[number] for n, number in references]
    verdict = _shipped(references, options.damped) if sensor is Sensor.ACCELERATION else None
    if verdict is None:
        with _engine(options) as (engine, _, _progress):
            verdict = compare(*chains, engine=engine)
    print(json.dumps(verdict.to_dict(), indent=1, ensure_ascii=False) if options.json else _explained(verdict, chains))
    return 0


def _verdicts(options: argparse.Namespace) -> int:
    family = Family(options.masses, options.damped, Sensor(options.sensor))
    query = Query(VIEWS[options.representation], options.conditions, options.markov)
    with _engine(options) as (engine, pool, progress):
        subjects = [engine.subject(f"A{number}", chain) for number, chain in enumerate(family, 1)]
        decided = engine.decisions(subjects, query, executor=pool, progress=progress)
    if options.csv:
        _emit(options.csv, decisions_csv(decided))
    if options.json:
        _emit(options.json, decisions_json(decided))
    if "-" not in (options.csv, options.json):
        print(_summary(decided))
    return 0


def _report(options: argparse.Namespace) -> int:
    from disting.report.write import write_report

    choices = [False, True] if options.damping == "both" else [options.damping == "damped"]
    with _engine(options) as (engine, pool, progress):
        catalogs = [_catalog(n, damped, engine, pool, progress) for n in options.masses for damped in choices]
    paths = write_report(catalogs, options.out)
    for c in catalogs:
        print(f"{c.name}: {_counted(c.counts())}, {len(c.classes())} indistinguishable groups")
    print(f"{len(paths)} files in {options.out}; open {options.out / 'index.html'}")
    return 0


def _build(options: argparse.Namespace) -> int:
    from disting.catalogs.build import build, write

    with _engine(options) as (engine, pool, progress):
        for n in options.masses:
            pair = [build(n, damped=d, engine=engine, executor=pool, progress=progress) for d in (False, True)]
            for path in write(pair, options.out)[:-1]:
                print(path)
    return 0


def _verify(options: argparse.Namespace) -> int:
    from disting.catalogs.verify import verify

    wrong: list[str] = []
    with _engine(options) as (_, pool, progress):
        for n in options.masses:
            for damped in (False, True):
                fresh = Engine()  # nothing is taken from the cache: a verification computes
                found = verify(n, damped=damped, folder=options.catalog, engine=fresh, executor=pool, progress=progress)
                what = f"{n} masses, {'damped' if damped else 'undamped'}"
                print(f"{what}: {'; '.join(found) or 'every byte and every evidence holds'}")
                wrong += found
    return 1 if wrong else 0


def _cache_info(options: argparse.Namespace) -> int:
    with Store.open(None) as store:
        info = store.info()
    print(f"path     {info.path or 'no cache'}\nentries  {info.entries}")
    print(f"size     {info.bytes} bytes\nschema   {info.schema_version}")
    return 0


def _cache_clear(options: argparse.Namespace) -> int:
    with Store.open(None) as store:
        print(f"{store.clear()} entries removed")
    return 0


def _shipped(references: list[tuple[int, int]], damped: bool) -> Verdict | None:
    """The stored verdict of a shipped pair."""
    (n, left), (m, right) = references
    return catalog(n, damped=damped).verdict(left, right) if n == m in SHIPPED_SIZES and left != right else None


def _catalog(n: int, damped: bool, engine: Engine, pool: Executor | None, progress: Progress) -> Catalog:
    from disting.catalogs.build import build

    if n in SHIPPED_SIZES:
        return catalog(n, damped=damped)
    return build(n, damped=damped, engine=engine, executor=pool, progress=progress)


def _explained(verdict: Verdict, chains: list[Chain]) -> str:
    drawings = [f"  {name}  {text_drawing(c)}" for name, c in zip((verdict.left, verdict.right), chains, strict=True)]
    lines = [verdict.relation.upper(), "", *drawings, "", verdict.sentence]
    if verdict.evidence:
        certainty = f"{verdict.certainty}, probability of error at most {verdict.error_bound}"
        lines += [f"evidence   {verdict.evidence.formula}", f"certainty  {certainty}"]
    return "\n".join([*lines, f"domain     {verdict.domain} parameters"])


def _summary(decided: Decisions) -> str:
    total = len(decided.subjects) * (len(decided.subjects) - 1) // 2
    return f"{len(decided.subjects)} models, {total} pairs: {_counted(decided.counts())}"


def _counted(counts: dict[str, int]) -> str:
    parts = [f"{n} by condition {number}" for number, n in counts.items() if number]
    return ", ".join([*parts, f"{counts.get('', 0)} undecided"])


def _emit(where: str, text: str) -> None:
    if where == "-":
        sys.stdout.write(text)
    else:
        Path(where).write_text(text, encoding="utf-8")


@contextmanager
def _engine(options: argparse.Namespace) -> Iterator[tuple[Engine, Executor | None, Progress]]:
    """Engine with the user's store, workers as asked, and a progress bar on a terminal's standard error."""
    with ExitStack() as stack:
        store = stack.enter_context(Store.open("" if getattr(options, "no_cache", False) else None))
        pool = stack.enter_context(executor(getattr(options, "jobs", 1), getattr(options, "scheduler", "")))
        yield Engine(store=store), pool, stack.enter_context(_progress())


@contextmanager
def _progress() -> Iterator[Progress]:
    if not sys.stderr.isatty():
        yield lambda what, done, total: None
        return
    from rich.console import Console
    from rich.progress import Progress as Bar

    with Bar(console=Console(stderr=True), transient=True) as bar:
        tasks: dict[str, object] = {}

        def advance(what: str, done: int, total: int) -> None:
            task = tasks.setdefault(what, bar.add_task(what) if what not in tasks else None)
            bar.update(task, completed=done, total=total)  # type: ignore[arg-type]

        yield advance


def _warned(message: Warning | str, *_: object, **__: object) -> None:
    print(f"disting: warning: {message}", file=sys.stderr)


def _reference(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{1,3}):(\d{1,6})", text)
    if not match:
        raise InputError(f"a model is written masses:number, for instance 3:4, not {text!r}")
    return int(match[1]), int(match[2])


def _whole(low: int) -> Callable[[str], int]:
    def number(text: str) -> int:
        if not text.isdigit() or int(text) < low:
            raise argparse.ArgumentTypeError(f"a whole number of at least {low} is needed, not {text!r}")
        return int(text)

    return number


def _conditions(text: str) -> tuple[int, ...]:
    """Numbers such as 1-5,8 as a sorted tuple."""
    chosen: set[int] = set()
    for part in text.split(","):
        match = re.fullmatch(r"([1-9])(?:-([1-9]))?", part.strip())
        if not match or int(match[2] or match[1]) < int(match[1]):
            raise argparse.ArgumentTypeError(f"conditions are written like 1-5,8 with numbers 1 to 9, not {text!r}")
        chosen |= set(range(int(match[1]), int(match[2] or match[1]) + 1))
    return tuple(sorted(chosen))


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="disting", description=__doc__, epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", action="version", version=f"disting {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=_Parser)
    masses = _whole(1)

    p = _command(commands, "models", _models, "the numbered list of all models of one size")
    p.add_argument("masses", type=masses, metavar="N", help="number of masses")
    _shared(p, damped=True, work=True)

    p = _command(commands, "compare", _compare, "one verdict, explained")
    p.add_argument("left", metavar="N:I", help="a model: masses:number, as 'disting models' lists it")
    p.add_argument("right", metavar="M:J", help="the other model, of the same or another size")
    _shared(p, damped=True, sensor=True)
    p.add_argument("--json", action="store_true", help="print the verdict with its evidence as JSON")
    p.add_argument("--no-cache", action="store_true", help="neither read nor write the cache")

    p = _command(commands, "verdicts", _verdicts, "all pairs of one size")
    p.add_argument("masses", type=masses, metavar="N", help="number of masses")
    _shared(p, damped=True, sensor=True, work=True)
    p.add_argument(
        "--conditions", type=_conditions, default=ALL_CONDITIONS, metavar="LIST", help="such as 1-5,8 (default: 1-9)"
    )
    p.add_argument("--representation", choices=VIEWS, default="all", help="which may decide (default: all)")
    p.add_argument("--markov", type=masses, default=0, metavar="K", help="use G_0 and G_1..G_K (default: all that are needed)")
    p.add_argument("--csv", metavar="FILE", help="write the verdicts as CSV; - is standard output")
    p.add_argument("--json", metavar="FILE", help="write the verdicts with evidence as JSON; - is standard output")

    p = _command(commands, "report", _report, "HTML pages, figures and tables of whole catalogues")
    p.add_argument("masses", type=masses, nargs="+", metavar="N", help="numbers of masses")
    choice = p.add_mutually_exclusive_group()
    for name in ("damped", "undamped", "both"):
        choice.add_argument(f"--{name}", dest="damping", action="store_const", const=name, help=f"{name} models")
    p.set_defaults(damping="both")
    p.add_argument("--out", type=Path, default=Path("reports"), metavar="DIR", help="folder to write to (default: reports)")
    _shared(p, work=True)

    p = commands.add_parser("catalog", help="build or verify the precomputed catalogues", description="Precomputed catalogues.")
    actions = p.add_subparsers(required=True, metavar="ACTION", parser_class=_Parser)
    q = _command(actions, "build", _build, "compute catalogues, undamped and damped")
    q.add_argument("masses", type=masses, nargs="+", metavar="N", help="numbers of masses")
    q.add_argument("--out", type=Path, default=Path("catalog"), metavar="DIR", help="folder to write to (default: catalog)")
    _shared(q, work=True)
    q = _command(actions, "verify", _verify, "rebuild catalogues, compare bytes, and check every evidence anew")
    q.add_argument("masses", type=masses, nargs="+", metavar="N", help="numbers of masses")
    q.add_argument(
        "--catalog",
        type=Path,
        default=shipped_folder(),
        metavar="DIR",
        help="folder to verify (default: the shipped one)",
    )
    _shared(q, work=True)

    p = commands.add_parser("cache", help="look at or empty the cache", description="The cache of profiles and verdicts.")
    actions = p.add_subparsers(required=True, metavar="ACTION", parser_class=_Parser)
    _command(actions, "info", _cache_info, "where the cache is and what it holds")
    _command(actions, "clear", _cache_clear, "remove all entries")
    return parser


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one sentence."""

    def error(self, message: str) -> None:  # type: ignore[override]
        self.exit(2, f"disting: {message}; see '{self.prog} --help'\n")


def _command(commands, name: str, run: Callable[[argparse.Namespace], int], text: str) -> argparse.ArgumentParser:  # type: ignore[no-untyped-def]
    parser: argparse.ArgumentParser = commands.add_parser(name, help=text, description=text[0].upper() + text[1:] + ".")
    parser.set_defaults(run=run)
    return parser


def _shared(parser: argparse.ArgumentParser, *, damped: bool = False, sensor: bool = False, work: bool = False) -> None:
    if damped:
        parser.add_argument("--damped", action="store_true", help="a damper beside every spring")
    if sensor:
        names = [s.value for s in Sensor]
        parser.add_argument("--sensor", choices=names, default="acceleration", help="measured quantity (default: acceleration)")
    if work:
        parser.add_argument("--no-cache", action="store_true", help="neither read nor write the cache")
        parser.add_argument("--jobs", type=_whole(1), default=1, metavar="K", help="worker processes (default: 1)")
        parser.add_argument("--scheduler", default="", metavar="ADDRESS", help="compute on a dask.distributed cluster")
