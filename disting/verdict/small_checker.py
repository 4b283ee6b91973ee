"""The small checker, `check.py` beside the shipped files, run from within: it shares no code with
the rest, so what it finds is a second opinion on what `disting verify` finds.

Its file is loaded by its path, because it is no part of the package: anybody can read it alone and
run it with the standard library alone.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from disting.errors import CatalogError
from disting.files import shipped_folder


@dataclass(frozen=True, slots=True)
class SecondOpinion:
    """Kinds of evidence that the small checker computed again (`checked`), those that rest on a
    search or a theorem that it does not repeat (`searched`), and sentences on what is wrong.
    """

    checked: tuple[str, ...]
    searched: tuple[str, ...]
    wrong: tuple[str, ...]
    n_checked: int = 0
    n_searched: int = 0

    @property
    def text(self) -> str:
        """Its findings in one line.

        >>> SecondOpinion(("counts",), (), ()).text
        'counts: computed again'
        """
        parts = [f"{', '.join(self.checked)}: computed again"] if self.checked else []
        parts += [f"not repeated: {', '.join(self.searched)}"] if self.searched else []
        return "; ".join([*self.wrong, *parts])

    @property
    def counts(self) -> str:
        """Numbers of records.

        >>> SecondOpinion((), (), (), 3, 1).counts
        '3 records computed again, 1 not repeated, 0 wrong'
        """
        return (
            f"{self.n_checked:,} records computed again, {self.n_searched:,} not repeated,"
            f" {len(self.wrong)} wrong"
        )


def opinion_on_verdict(data: dict[str, Any]) -> SecondOpinion:
    """Return what the small checker says of plain data of `verdict_file`.

    >>> from disting import verdict_file
    >>> opinion_on_verdict(verdict_file("3:1", "3:4", damped=True)).wrong
    ()
    """
    table = _checker().Table()
    _checker().verdict_file(table, "", data)
    return _opinion(table)


def opinion_on_files(paths: Iterable[Path]) -> SecondOpinion:
    """Return what the small checker says of shipped files, all records together."""
    table = _checker().Table()
    for path in paths:
        _checker().check_file(table, path)
    return _opinion(table)


def _opinion(table: Any) -> SecondOpinion:
    checked, searched = dict[str, None](), dict[str, None]()
    for (_, _, what, why), counts in table.counts.items():
        if counts["checked"]:
            checked[what] = None
        if counts["search"]:
            searched[f"{what} ({why})" if what else why] = None
    wrong = tuple(line.lstrip(": ") for line in table.wrong)
    numbers = (
        sum(row[status] for row in table.counts.values()) for status in ("checked", "search")
    )
    return SecondOpinion(tuple(checked), tuple(searched), wrong, *numbers)


@cache
def _checker() -> ModuleType:
    path = shipped_folder() / "check.py"
    spec = spec_from_file_location("disting_small_checker", path)
    if spec is None or spec.loader is None or not path.is_file():
        raise CatalogError(f"there is no {path}; install disting anew")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
