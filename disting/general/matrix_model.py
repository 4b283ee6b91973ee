"""Parametric models with one input and one output: rational transfer functions whose coefficients
depend on parameters.

    G(s) = C (s I - A)^-1 B + D = sum b_i(p) s^i / sum a_i(p) s^i

Entries are rational functions of the parameters; their denominators are cleared. G is brought to
lowest terms over Z[s, p] exactly: what is common for all parameters (such as a mode that is not
controllable or not observable) is cancelled. Then G has one form but for the sign, which is fixed,
and its coefficients show exactly which of them vanish or are constant.

Parametric models with several inputs and outputs: matrices of rational transfer functions with
one parameter vector, of a state space at rest (zero initial state).

Each entry is in lowest terms over Z[s, p] by itself; an entry that is zero for all parameters is
part of the form. So two models behave alike exactly if all their entries are equal.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING

from flint import Ordering, fmpz_mpoly, fmpz_mpoly_ctx

from disting.algebra.symbols import RationalFunction, quotient, rename_symbols, symbols, text_in_s
from disting.behaviour.transfer import expand
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
from disting.general.expression import LONGEST_NUMBER
from disting.general.powers import PLAIN, Powers, Terms as Terms, cell_in, in_v
from disting.general.response import fraction, network_powers, network_ratios, transfer_functions
from disting.model.chain import Chain
from disting.model.names import name_of
from disting.model.presentation import NotebookTable, plural, summary
from disting.network.chains import as_chain, of_chain
from disting.network.denotation import Naming, naming_of, refuse_misnamed
from disting.network.forests import Counts, counts_of
from disting.network.network import Network

TERMS = ("numerator_terms", "denominator_terms")
NO_PARAMETER = (
    "a parametric model has at least one parameter, and this one holds numbers only: write a name"
    " such as 'k' for each value that is not known"
)


@dataclass(frozen=True, slots=True)
class Model(NotebookTable):
    """A transfer function in lowest terms, made by `from_state_space`, `from_transfer_function`,
    `from_network` or `from_chain`.

    `parameters` by name; `numerator_terms` and `denominator_terms` hold the coefficients of s^0,
    s^1, .., of networks with Warburg or constant phase elements those of v^0, v^1, .., defined by
    `powers`. Immutable and hashable; two models are equal if their parameters and coefficients are,
    whatever they are called. `network`: the network that it is, where it was made of one; `chain`:
    the chain that it is, in the chain's own parameters; such models are compared as chains. What is
    made of one by `dataclasses.replace` is a transfer function alone: it may be another one. Raises
    InputError for a name that is not printable, which could contain more than a name.

    >>> str(Model.from_transfer_function(["k"], ["m", "d", "k"]))
    'G(s) = k/(k + d*s + m*s**2)'
    """

    parameters: tuple[str, ...]
    numerator_terms: tuple[Terms, ...]
    denominator_terms: tuple[Terms, ...]
    name: str = field(default="model", compare=False)
    powers: Powers = PLAIN
    chain: Chain | None = field(default=None, init=False, compare=False)
    network: Network | None = field(default=None, init=False, compare=False)

    def __post_init__(self) -> None:
        refuse_name(self.name)

    def __repr__(self) -> str:
        return summary(
            self, f"{self.name}, {plural(self.n_states, 'state')}, {', '.join(self.parameters)}"
        )

    @staticmethod
    def from_state_space(
        a: object, b: object, c: object, d: object = 0, *, s: object = "s", name: str = "model"
    ) -> "Model":
        """Model x' = A x + B u, y = C x + D u with A (n x n), B (n x 1), C (1 x n), D (1 x 1).

        Matrices are SymPy or NumPy ones or nested lists; B and C may be flat lists, D a single
        entry. Entries are exact numbers, texts such as "k12/m1" or SymPy expressions; parameters
        are their symbols, sorted by name, whatever is assumed of them. `s` is the frequency
        variable and must not be among them. Raises InputError.

        >>> from sympy import Matrix, symbols
        >>> k, m = symbols("k m")
        >>> a, b, c = Matrix([[0, 1], [-k / m, 0]]), Matrix([0, 1 / m]), Matrix([[1, 0]])
        >>> str(Model.from_state_space(a, b, c))
        'G(s) = 1/(k + m*s**2)'
        """
        ratios, parameters = transfer_functions(a, b, c, d, s)
        if (len(ratios), len(ratios[0])) != (1, 1):
            raise InputError(
                f"these are {len(ratios)} outputs and {len(ratios[0])} inputs: a Model has one of"
                " each, a MatrixModel any number"
            )
        return _model(ratios[0][0], parameters, name)

    @staticmethod
    def from_transfer_function(
        num: object, den: object = 1, *, s: object = "s", name: str = "model"
    ) -> "Model":
        """Model num/den: lists of coefficients, the highest power first (as in scipy and
        python-control), or expressions in s.

        An expression may be all of G(s). Entries as in `from_state_space`. The numerator may have
        the higher degree. Raises InputError.

        >>> Model.from_transfer_function("k*s", "(s + p)*(s + q)*k").denominator
        (p*q, p + q, 1)
        """
        variable = frequency(s)
        sides = tuple(polynomial(side, variable) for side in (num, den))
        refuse_namesakes(num, den, s)
        parameters = parameters_of(sides, variable)
        ring = symbols([variable, *parameters])
        return _model(fraction(sides, Expansion(ring, ring[variable] ** 0)), parameters, name)

    @staticmethod
    def from_chain(chain: Chain, *, name: str = "") -> "Model":
        """The model of a chain in its own parameters, sorted; raises InputError for a dead time,
        which is no rational function, and for a name that denotes another model.

        >>> str(Model.from_chain(Chain(1, damped=False)))
        'G(s) = 1/m1'
        """
        if chain.dead_time:
            raise InputError("a dead time exp(-Td s) is no rational function of s")
        refuse_misnamed(name, naming_of(name, chain))
        parameters = tuple(sorted(chain.parameters))
        ring = symbols(["s", *parameters])
        num, den = (rename_symbols(part, ring, {}) for part in expand(chain.structure))
        made = _model(RationalFunction(num, den), parameters, name or name_of(chain))
        object.__setattr__(made, "chain", chain)
        if not chain.lag:
            object.__setattr__(made, "network", of_chain(chain, made.name))
        return made

    @staticmethod
    def from_network(network: Network) -> "Model":
        """The transfer function of a network with one input and one output, in all its parameters;
        raises InputError. A network that is a chain in the chain's own names is that chain.

        >>> from disting.network import network_of
        >>> str(Model.from_network(network_of("R0-p(R1,C1)")))
        'G(s) = (R0 + R1 + C1*R0*R1*s)/(1 + C1*R1*s)'
        """
        if network.shape != (1, 1):
            raise InputError("this network has several inputs or outputs: it is a MatrixModel")
        if counts_of(network, network.halves) is None:
            ((ratio,),) = network_ratios(network)
            powers = network_powers([ratio], network)
            made = _model(ratio, network.parameters, network.name, powers)
            object.__setattr__(made, "network", network)
        else:
            made = unwritten(network)
        chain = as_chain(network)
        if chain is not None and naming_of(network.name, chain) is not Naming.FALSE:
            object.__setattr__(made, "chain", chain)
        return made

    @property
    def written_fields(self) -> dict[str, object]:
        """All fields; of a network whose terms are counted all but the terms, which follow."""
        left_out = () if self._counts is None else TERMS
        return {f.name: getattr(self, f.name) for f in fields(self) if f.name not in left_out}

    if not TYPE_CHECKING:  # other names that are missing are still found by the checker of types

        def __getattr__(self, name: str) -> object:
            """The terms of a network that are only counted are written out when they are first
            requested; raises InputError where they are too many.
            """
            if name not in TERMS:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            ((ratio,),) = network_ratios(self.network)
            written = _model(ratio, self.parameters, self.name, self.powers)
            for side in TERMS:
                object.__setattr__(self, side, getattr(written, side))
            return getattr(self, name)

    @property
    def numerator(self) -> tuple[fmpz_mpoly, ...]:
        """Polynomials b_0, b_1, .. in the parameters."""
        return self._polynomials(self.numerator_terms)

    @property
    def denominator(self) -> tuple[fmpz_mpoly, ...]:
        """Polynomials a_0, a_1, .. in the parameters."""
        return self._polynomials(self.denominator_terms)

    @property
    def n_states(self) -> int:
        """Order: the larger degree of numerator and denominator in lowest terms; of a proper
        transfer function the number of states of a minimal realisation.
        """
        return max(self.degrees)

    @property
    def entries(self) -> tuple["Model", ...]:
        """Its one transfer function: as of a `MatrixModel` with several."""
        return (self,)

    @property
    def cells(self) -> tuple["Model", ...]:
        """The same: it is not zero."""
        return (self,)

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of outputs and inputs."""
        return 1, 1

    @property
    def content(self) -> tuple[object, ...]:
        """All that distinguishes two models: their names do not."""
        weights = (weight for _, weight in self.powers.weights)
        powers = (*("halves",) * self.powers.halves, *weights)
        return self.parameters, self.numerator_terms, self.denominator_terms, *powers

    @property
    def degrees(self) -> tuple[int, int]:
        """Degrees of numerator and denominator in s, or in v."""
        if self._counts is not None:
            return self._counts.degrees
        return len(self.numerator_terms) - 1, len(self.denominator_terms) - 1

    @property
    def n_terms(self) -> int:
        """Number of the terms of all coefficients."""
        if self._counts is not None:
            return sum((*self._counts.num, *self._counts.den))
        return sum(map(len, (*self.numerator_terms, *self.denominator_terms)))

    @property
    def _counts(self) -> Counts | None:
        """Known properties of a network without its terms."""
        network = self.network
        return None if network is None else counts_of(network, self.powers.halves)

    def __str__(self) -> str:
        return f"G(s) = {text_in_s(self.numerator, self.denominator, self.powers.text)}"

    def expression(self) -> object:
        """G(s) as a SymPy expression."""
        return quotient(self.numerator, self.denominator, self.powers.exponent)

    def _polynomials(self, coefficients: tuple[Terms, ...]) -> tuple[fmpz_mpoly, ...]:
        context = fmpz_mpoly_ctx.get(self.parameters, Ordering.lex)
        return tuple(context.from_dict(dict(terms)) for terms in coefficients)


def _model(
    ratio: RationalFunction, parameters: tuple[str, ...], name: str, powers: Powers = PLAIN
) -> Model:
    """The model of a transfer function in the ring of s and the parameters, s first."""
    if ratio.num.is_zero():
        raise InputError(
            "the transfer function is zero: the output does not depend on the input; mend B, C or"
            " the numerator, or leave the model away"
        )
    if not parameters:
        raise InputError(NO_PARAMETER)
    return entry_of(ratio, parameters, name, powers)


def unwritten(network: Network) -> Model:
    """The model of a network with one input and one output whose terms are counted, but not written
    out yet.
    """
    made = object.__new__(Model)
    for name, value in (
        ("parameters", network.parameters),
        ("name", network.name),
        ("powers", Powers(network.halves)),
        ("network", network),
        ("chain", None),
    ):
        object.__setattr__(made, name, value)
    return made


def entry_of(
    ratio: RationalFunction, parameters: tuple[str, ...], name: str, powers: Powers = PLAIN
) -> Model:
    """The same without requiring parameters: of a matrix not every entry has some."""
    cell = cell_in(ratio, powers.exponents, len(parameters))
    top, bottom, powers = in_v(cell, powers)
    if any(
        abs(number).bit_length() > LONGEST_NUMBER
        for terms in (*top, *bottom)
        for _, number in terms
    ):
        raise InputError(f"numbers of a model have {LONGEST_NUMBER} bits at most in lowest terms")
    return Model(parameters, top, bottom, name, powers)


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
        return of_ratios([*ratios, *_rows_of_known(known, parameters, ratios[0])], parameters, name)

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
        rows = tuple(tuple(_count_cell(cell) for cell in row) for row in network.cells)
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
        """Powers that those of v denote, except for cancelled ones."""
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
        """All that distinguishes two models: their names do not."""
        return self.parameters, self.shape, *(e and e.content[1:] for e in self.cells)

    def __str__(self) -> str:
        rows = (", ".join(_write_row(row)) for row in self.rows)
        return f"G(s) = [{', '.join(f'[{row}]' for row in rows)}]"


AnyModel = Model | MatrixModel
"""A general model."""


def _count_cell(cell: Network) -> tuple[bool, Model | None]:
    """Pair of a flag, True if the function of a network between two ports is known without its
    terms, and its model.
    """
    if not cell.seen:
        return True, None
    is_known = counts_of(cell, cell.halves) is not None
    return is_known, unwritten(replace(cell, name="entry")) if is_known else None


def _rows_of_known(
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


def _write_row(row: tuple[Model | None, ...]) -> Iterator[str]:
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
