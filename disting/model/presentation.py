"""Display of objects: a line at a prompt, and in a notebook the drawing of a package above.

A line is made where the object is. A picture, a table of a notebook or a plot needs the layer above
(`disting.report`), which the rooms below must not import, whether at the top of a module or inside
a method. So they know only that there is a `Presenter`, and by which name it is called. Nothing is
drawn, and nothing that draws is imported, before somebody looks.
"""

from collections.abc import Mapping
from pkgutil import resolve_name
from typing import Any, Protocol

from disting.errors import printable

PRESENTER = "disting.report.notebook:Notebook"

LONGEST = 110  # characters of a line on a prompt
COUNTED = "degrees count powers of "  # begins a note on models with other powers than those of s
HALVES = f"{COUNTED}s^(1/2)"  # of models with Warburg elements
AS_CHAIN = "compared as the chain"
GENERIC = (
    "the exponents of constant phase elements are generic, those of both networks the same in some"
    " order"
)


class Presenter(Protocol):
    """Whoever draws: a notebook's table as HTML, a picture as SVG, a plot with matplotlib; and
    whoever writes a chain as formulas or as numbers.
    """

    def html(self, shown: Any, /) -> str:
        """The object as a piece of an HTML page, complete in itself."""

    def svg(self, shown: Any, /) -> str:
        """The object as a stand-alone SVG."""

    def transfer_function(self, shown: Any, /) -> Any:
        """G(s) of a chain as a SymPy expression."""

    def frequency_response(self, shown: Any, values: Any, omega: Any, /) -> Any:
        """G(j omega) of a chain with numbers."""

    def state_space(self, shown: Any, values: Any, /) -> Any:
        """The matrices of a chain with numbers."""

    def to_control(self, shown: Any, values: Any, /) -> Any:
        """A chain with numbers for python-control."""

    def scatter(self, shown: Any, /) -> tuple[float, str]:
        """Median scatter of a measured response, and its source in words."""

    def plot(self, shown: Any, ax: Any, style: Mapping[str, Any], /) -> Any:
        """The object on axes of matplotlib, made where none are given; returns them."""


class Presentation:
    """Drawing functions that a package above provides."""

    __slots__ = ()

    @property
    def _presenter(self) -> Presenter:
        presenter: Presenter = resolve_name(PRESENTER)()
        return presenter


class NotebookTable(Presentation):
    """Object that a notebook shows as a table."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        return self._presenter.html(self)


class NotebookPicture(Presentation):
    """Object that a notebook shows as a picture."""

    __slots__ = ()

    def _repr_svg_(self) -> str:
        return self._presenter.svg(self)


def summary(of: object, text: str) -> str:
    """A line for a prompt, `<Class: text>`, that fits a line whatever the text.

    >>> summary(NotebookTable(), "a" * 200)[-6:], len(summary(NotebookTable(), "a" * 200))
    ('aaaa…>', 110)
    """
    line = f"<{type(of).__name__}: {printable(' '.join(text.split()))}>"
    return line if len(line) <= LONGEST else f"{line[: LONGEST - 2]}…>"


def plural(count: int, single: str, many: str = "") -> str:
    """Number and noun.

    >>> plural(1, "pair"), plural(0, "pair"), plural(2, "mass", "masses")
    ('1 pair', '0 pairs', '2 masses')
    """
    return f"{count} {single if count == 1 else many or single + 's'}"
