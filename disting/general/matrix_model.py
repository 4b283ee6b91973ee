"""Parametric models with several inputs and outputs: matrices of rational transfer functions with
one parameter vector, of a state space at rest (zero initial state).

Each entry is in lowest terms over Z[s, p] by itself; an entry that is zero for all parameters is
part of the form. So two models behave alike exactly if all their entries are equal.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from disting.algebra.symbols import RationalFunction, symbols
from disting.errors import InputError, enumeration, of_type, short
from disting.general.entries import (
    frequency,
    parameters_of,
    polynomial,
    refuse_name,
    refuse_namesakes,
    rows_of,
)
from disting.general.expansion import Expansion
from disting.general.model import NO_PARAMETER, Model, entry_of, unwritten
from disting.general.powers import PLAIN, Powers
from disting.general.response import fraction, network_powers, network_ratios, transfer_functions
from disting.model.presentation import NotebookTable, plural, summary
from disting.network.forests import counts_of
from disting.network.network import Network

MOST_ENTRIES = 100


@dataclass(frozen=True, slots=True)
class MatrixModel(NotebookTable):
    """A matrix of transfer functions, made by `from_state_space`, `from_transfer_functions` or
    `from_network`.

    `rows`: a row for each output, an entry for each input; each is a `Model` in all `parameters`,
    or None where it is zero. Immutable and hashable; equal if parameters and entries are, whatever
    they are called.

    >>> m = MatrixModel.from_transfer_functions([["1/(s + a)", 0], ["b/(s + a)", "1/(s + b)"]])
    >>> m.shape, m.parameters
    ((2, 2), ('a', 'b'))
    """

    parameters: tuple[str, ...]
    rows: tuple[tuple[Model | None, ...], ...]
    name: str = field(default="model", compare=False)
    network: Network | None = field(default=None, init=False, compare=False)

    def __repr__(self) -> str:
        outputs, inputs = self.shape
        size = f"{plural(outputs, 'output')}, {plural(inputs, 'input')}"
        return summary(self, f"{self.name}, {size}, {', '.join(self.parameters)}")

    def __post_init__(self) -> None:
        refuse_name(self.name)
        if not self.parameters:
            raise InputError(NO_PARAMETER)
        if self.shape[0] * self.shape[1] > MOST_ENTRIES:
            raise InputError(f"a matrix of transfer functions has {MOST_ENTRIES} entries at most")
        if not self.entries:
            raise InputError(
                "the transfer function is zero: no output depends on an input; mend B, C or the"
                " numerator, or leave the model away"
            )

    @staticmethod
    def from_state_space(
        a: object,
        b: object,
        c: object,
        d: object = 0,
        *,
        x0: object = None,
        known: Sequence[str] = (),
        s: object = "s",
        name: str = "model",
    ) -> "MatrixModel":
        """Model x' = A x + B u, y = C x + D u, with A (n x n), B (n x m), C (p x n), D (p x m);
        entries as in `Model.from_state_space`. D = 0 is a matrix of zeros.

        `x0`: the initial state, n entries, 0 where it is missing. It is one more input, on which a
        unit impulse acts: the last column is C (s I - A)^-1 x0. B may be None then. `known`:
        parameters whose values are known, each shown by a row of its own. Raises InputError.

        >>> from sympy import Matrix, eye, symbols
        >>> k, m = symbols("k m")
        >>> oscillator = Matrix([[0, 1], [-k / m, 0]])
        >>> found = MatrixModel.from_state_space(oscillator, Matrix([0, 1 / m]), eye(2))
        >>> print(found)
        G(s) = [[1/(k + m*s**2)], [s/(k + m*s**2)]]
        >>> print(MatrixModel.from_state_space([["-k"]], None, [1], x0=["c"], known=["c"]))
        G(s) = [[c/(k + s)], [c]]
        """
        ratios, parameters = transfer_functions(a, b, c, d, s, x0)
        return of_ratios([*ratios, *_shown(known, parameters, ratios[0])], parameters, name)

    @staticmethod
    def from_transfer_functions(
        rows: object, *, s: object = "s", name: str = "model"
    ) -> "MatrixModel":
        """Model of a matrix of expressions in s, a SymPy matrix or a list of rows, one for each
        output. Raises InputError.
        """
        variable = frequency(s)
        entries = rows_of(rows)
        unit = polynomial(1, variable)
        sides = [[(polynomial(entry, variable), unit) for entry in row] for row in entries]
        refuse_namesakes(*(entry for row in entries for entry in row), s)
        parameters = parameters_of((top for row in sides for top, _ in row), variable)
        ring = symbols([variable, *parameters])
        expansion = Expansion(ring, ring[variable] ** 0)
        return of_ratios([[fraction(e, expansion) for e in row] for row in sides], parameters, name)

    @staticmethod
    def from_network(network: Network) -> "MatrixModel":
        """The transfer functions of a network, a row for each output, a column for each input;
        raises InputError.
        """
        rows = tuple(tuple(_counted(cell) for cell in row) for row in network.cells)
        if all(is_known for row in rows for is_known, _ in row):
            entries = tuple(tuple(entry for _, entry in row) for row in rows)
            model = MatrixModel(network.parameters, entries, network.name)
        else:
            ratios = network_ratios(network)
            powers = network_powers([x for row in ratios for x in row], network)
            model = of_ratios(ratios, network.parameters, network.name, powers)
        object.__setattr__(model, "network", network)
        return model

    @property
    def powers(self) -> Powers:
        """What the powers of v are, but for what was cancelled."""
        return replace(self.entries[0].powers, lost=0)

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of outputs and inputs."""
        return len(self.rows), len(self.rows[0])

    @property
    def cells(self) -> tuple[Model | None, ...]:
        """All entries, row by row."""
        return tuple(entry for row in self.rows for entry in row)

    @property
    def entries(self) -> tuple[Model, ...]:
        """Those that are not zero."""
        return tuple(entry for entry in self.cells if entry is not None)

    @property
    def n_states(self) -> int:
        """Largest order of an entry."""
        return max(entry.n_states for entry in self.entries)

    @property
    def content(self) -> tuple[object, ...]:
        """All that tells two models apart: their names do not."""
        return self.parameters, self.shape, *(e and e.content[1:] for e in self.cells)

    def __str__(self) -> str:
        rows = (", ".join(_written(row)) for row in self.rows)
        return f"G(s) = [{', '.join(f'[{row}]' for row in rows)}]"


AnyModel = Model | MatrixModel
"""A general model."""


def _counted(cell: Network) -> tuple[bool, Model | None]:
    """Whether what a network does between two ports is known without its terms, and what it is."""
    if not cell.seen:
        return True, None
    is_known = counts_of(cell, cell.halves) is not None
    return is_known, unwritten(replace(cell, name="entry")) if is_known else None


def _shown(
    names: Sequence[str], parameters: tuple[str, ...], like: Sequence[RationalFunction]
) -> Iterator[tuple[RationalFunction, ...]]:
    """Yield a row for each known parameter, which shows it; raises InputError for other names."""
    wanted = "known parameters are a list of names such as ['x1']"
    for name in of_type(names, list | tuple, wanted):
        if name not in parameters:
            raise InputError(
                f"{short(name)} is known, but no parameter; there are {enumeration(parameters)}"
            )
        context, zero = like[0].num.context(), like[0] - like[0]
        value = context.gen(context.names().index(name))
        yield (*[zero] * (len(like) - 1), RationalFunction(value, value**0))


def _written(row: tuple[Model | None, ...]) -> Iterator[str]:
    for entry in row:
        yield "0" if entry is None else str(entry).removeprefix("G(s) = ")


def of_ratios(
    ratios: Sequence[Sequence[RationalFunction]],
    parameters: tuple[str, ...],
    name: str,
    powers: Powers = PLAIN,
) -> MatrixModel:
    """The model of transfer functions in the ring of s and the parameters, s first."""
    rows = tuple(
        tuple(None if r.num.is_zero() else entry_of(r, parameters, "entry", powers) for r in row)
        for row in ratios
    )
    return MatrixModel(parameters, rows, name)
