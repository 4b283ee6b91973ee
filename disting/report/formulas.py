"""A chain's formulas, typeset and as LaTeX: its transfer function, what it determines, and its
maps to other chains.

The transfer function of a damped chain is that of the undamped one with every k_ij replaced by κ_ij
= k_ij + d_ij s, since a spring and the damper in parallel act as one dynamic stiffness. Written out
in k, d and s, coefficients of 4 masses have a hundred terms and more; in κ they stay readable, and
nothing is lost.

Pages have mathematics as MathML Core (W3C), which browsers typeset without a script.

A long sum is a list of terms, each an element of its own: a browser breaks lines between elements,
never inside of one. Every name is a parameter's or a fixed letter, an identifier, so nothing has to
be escaped.

SymPy's printer writes an expression as one element, and for the 15,500 pieces of the shipped pages
of models it took 5.9 s instead of 0.6 s (all of these pages take 8.8 s) and 3.2 MB instead of
2.2 MB, with indices as identifiers.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import starmap

from markupsafe import Markup

from disting.algebra.symbols import (
    Content,
    Polynomial,
    RationalFunction,
    Sum,
    Term,
    coefficients,
    content,
    factors,
    latex,
    latex_symbol,
    polynomial_of,
    split_name,
    symbols,
    terms,
)
from disting.behaviour.transfer import expand
from disting.equivalence import explicit_map
from disting.equivalence.duplicates import Assignment
from disting.equivalence.reach import Piece
from disting.equivalence.theorems import images
from disting.general.expansion import Expansion
from disting.general.expression import names as symbols_of, tree
from disting.general.matrix_model import Model
from disting.model.chain import Chain
from disting.questions.identifiability.parts import Combination, Formula


def math(inner: str) -> Markup:
    """A math element in the line."""
    return Markup(f"<math>{inner}</math>")


def symbol(name: str, exponent: int = 1) -> str:
    """A parameter with its index, and its power.

    >>> symbol("k01"), symbol("s", 2), symbol("gain")
    ('<msub><mi>k</mi><mn>01</mn></msub>', '<msup><mi>s</mi><mn>2</mn></msup>', '<mi>gain</mi>')
    """
    head, below = split_name(name)
    letter, index = f"<mi>{head}</mi>", f"<mn>{below}</mn>"
    if not below:
        return letter if exponent == 1 else f"<msup>{letter}<mn>{exponent}</mn></msup>"
    if exponent == 1:
        return f"<msub>{letter}{index}</msub>"
    return f"<msubsup>{letter}{index}<mn>{exponent}</mn></msubsup>"


def prime(name: str) -> str:
    """A parameter of another model.

    >>> prime("m1")
    '<msubsup><mi>m</mi><mn>1</mn><mo>′</mo></msubsup>'
    """
    return symbol(name).replace("msub>", "msubsup>").replace("</mn><", "</mn><mo>′</mo><")


def product(coefficient: int, powers: Mapping[str, int]) -> str:
    """|coefficient| times a product of powers.

    >>> product(-2, {"m1": 1})
    '<mn>2</mn><msub><mi>m</mi><mn>1</mn></msub>'
    """
    size = abs(coefficient)
    number = f"<mn>{size}</mn>" if size != 1 or not powers else ""
    return number + "".join(starmap(symbol, powers.items()))


def summands(items: Iterable[Term]) -> list[str]:
    """The terms of a sum, each with its sign, the first one without a plus."""
    signed = [(_sign(c, first=i == 0), product(c, powers)) for i, (c, powers) in enumerate(items)]
    return [sign + text for sign, text in signed]


def fraction(top: str, bottom: str) -> str:
    """top over bottom."""
    return f"<mfrac><mrow>{top}</mrow><mrow>{bottom}</mrow></mfrac>"


def expression(value: RationalFunction) -> str:
    """A rational function, factorised."""
    top, bottom = ("".join(factorise(p)) for p in (value.num, value.den))
    return top if value.den.is_one() else fraction(top, bottom)


def formula(value: Formula) -> list[str]:
    """A Laurent polynomial, term by term: each a product or a fraction."""
    parts = []
    for place, (coefficient, exponents) in enumerate(value.terms):
        above = {name: e for name, e in exponents if e > 0}
        below = {name: -e for name, e in exponents if e < 0}
        top = product(coefficient, above)
        parts.append(
            _sign(coefficient, first=place == 0)
            + (fraction(top, product(1, below)) if below else top)
        )
    return parts


def equation(left: str, right: str) -> Markup:
    """left = right."""
    return math(f"{left}<mo>=</mo>{right}")


def factorise(polynomial: Polynomial) -> list[str]:
    """The factors of a polynomial, the number and single symbols as one, sums in parentheses."""
    content, powers = factors(polynomial)
    number = f"<mn>{abs(content)}</mn>" if abs(content) != 1 or not powers else ""
    alone = not number and content > 0 and len(powers) == 1
    single = "".join(_factor(p, e, alone) for p, e in powers if len(p) == 1)
    sums = [_factor(p, e, alone) for p, e in powers if len(p) > 1]
    head = ("<mo>−</mo>" if content < 0 else "") + number + single
    return [head, *sums] if head else sums


def _factor(polynomial: Polynomial, exponent: int, alone: bool) -> str:
    inner = terms(polynomial)
    if len(inner) == 1:
        coefficient, powers = inner[0]
        return product(coefficient, {name: e * exponent for name, e in powers.items()})
    text = "".join(summands(inner))
    if alone and exponent == 1:
        return text
    bracketed = f'<mrow><mo stretchy="false">(</mo>{text}<mo stretchy="false">)</mo></mrow>'
    return bracketed if exponent == 1 else f"<msup>{bracketed}<mn>{exponent}</mn></msup>"


def _sign(coefficient: int, *, first: bool) -> str:
    return "<mo>−</mo>" if coefficient < 0 else "" if first else "<mo>+</mo>"


# masses of maps by continued fractions; those of 4 masses have thousands of letters
LARGEST_SPELLED_OUT = 3  # masses; a damped chain of 4 has coefficients of a hundred terms
CAUER_UP_TO = 3
MOST_TERMS = 300  # of a general model whose coefficients are written out
LONGEST_BRACKET = 9  # letters of a sum in parentheses; a browser cannot break it
OF_S = '<mo stretchy="false">(</mo><mi>s</mi><mo stretchy="false">)</mo>'
Coefficient = tuple[int, Polynomial]
"""Power of s and its coefficient."""
Side = tuple[str, Sequence[Coefficient]]
"""Numerator or denominator: the letter of its coefficients, and those that are not zero."""


@dataclass(frozen=True, slots=True)
class TransferFunction:
    """`head`: the quotient of polynomials in s; `lines`: (name, terms) of its coefficients;
    `stiffness`: written in κ.
    """

    head: Markup
    lines: tuple[tuple[Markup, tuple[Markup, ...]], ...]
    latex: str
    stiffness: bool


@dataclass(frozen=True, slots=True)
class Correspondence:
    """The explicit map to another chain: an equation a parameter."""

    equations: tuple[Markup, ...]
    latex: str
    steps: str


def transfer_function_parts(chain: Chain) -> TransferFunction:
    r"""The transfer function of a chain, in k and d up to 3 masses, in κ above.

    >>> print(transfer_function_parts(Chain(1, damped=False)).latex)
    \begin{align}
      G(s) &= \frac{b_{0}}{a_{0}} \\
      b_{0} &= 1 \\
      a_{0} &= m_{1}
    \end{align}
    """
    stiffness = chain.damped and chain.n_masses > LARGEST_SPELLED_OUT
    polynomials = expand((replace(chain, damped=False) if stiffness else chain).structure)
    names = ("B", "A") if stiffness else ("b", "a")
    sides = [(letter, _coefficients(p)) for letter, p in zip(names, polynomials, strict=True)]
    return _transfer(sides, stiffness=stiffness)


def written_model(model: Model, letter: str = "G") -> TransferFunction:
    """The transfer function of a general model, called by a letter; of a large one the head
    alone.
    """
    sides = [
        (letter, [(power, p) for power, p in enumerate(side) if not p.is_zero()])
        for letter, side in (("b", model.numerator), ("a", model.denominator))
    ]
    size = sum(len(p) for _, pairs in sides for _, p in pairs)
    return _transfer(sides, spelled_out=size <= MOST_TERMS, called=letter)


def _transfer(
    sides: Sequence[Side],
    *,
    stiffness: bool = False,
    spelled_out: bool = True,
    called: str = "G",
) -> TransferFunction:
    """Numerator and denominator as a quotient and, spelled out, by their coefficients."""
    head = equation(symbol(called) + OF_S, fraction(*(_in_s(*side) for side in sides)))
    flat = [
        (f"{letter}{power}", _show_polynomial(content(p)))
        for letter, coefficients in sides
        for power, p in (coefficients if spelled_out else ())
    ]
    lines = tuple(
        (math(f"{symbol(label)}<mo>=</mo>"), _typeset(parts, stiffness))
        for label, (parts, _) in flat
    )
    text = _latex(sides, [(label, of) for label, (_, of) in flat], called)
    return TransferFunction(
        head, lines, text.replace("k_{", r"\kappa_{") if stiffness else text, stiffness
    )


def correspondence(chain: Chain, other: Chain) -> Correspondence | None:
    """The explicit map from one chain to another where a short one is known."""
    if chain.n_masses > CAUER_UP_TO and other not in _images(chain):
        return None
    formula_map = explicit_map(chain, other)
    if formula_map is None:
        return None
    lines = (
        equation(prime(name), expression(value)) for name, value in formula_map.formulas.items()
    )
    return Correspondence(tuple(lines), formula_map.latex, ", then ".join(formula_map.steps))


@cache
def _images(chain: Chain) -> frozenset[Chain]:
    return frozenset(image.chain for image in images(chain, dict.fromkeys(chain.parameters, 1.0)))


ROOT = re.compile(r"\((.+) \+ sqrt\((.+)\)\)/\((.+)\)")
"""The root of a quadratic equation, as it is written."""


@dataclass(frozen=True, slots=True)
class Values:
    """Values of another model in those of this one: where these `where` are positive an equation
    each, and the meaning of `root` in them.
    """

    where: tuple[Markup, ...]
    equations: tuple[Markup, ...]
    root: tuple[Markup, ...]


def written_values(assignment: Assignment) -> Values:
    """Formulas for the values of another model, typeset."""
    root = assignment.root
    steps = (equation(symbol(name), _typeset_rational(text)) for name, text in assignment.steps)
    equations = (equation(prime(name), _typeset_rational(text)) for name, text in assignment.values)
    return Values(
        tuple(math(_typeset_rational(text)) for text in assignment.where),
        (*steps, *equations),
        (math(symbol(root[0])), *(math(_typeset_rational(text)) for text in root[1:]))
        if root
        else (),
    )


def _typeset_rational(text: str) -> str:
    """A rational function, factorised; a text that is none, such as infinity, as it is."""
    if text.endswith("infinity"):
        return f"<mi>{text.replace('infinity', '∞')}</mi>"
    if root := ROOT.fullmatch(text):
        first, inside, below = map(_typeset_rational, root.groups())
        return fraction(f"{first}<mo>+</mo><msqrt>{inside}</msqrt>", below)
    number = tree(text)
    ring = symbols(sorted({*symbols_of(number)}) or ["s"])
    return expression(Expansion(ring, next(iter(ring.values())) ** 0).value(number))


@dataclass(frozen=True, slots=True)
class Conditions:
    """Where a model has equivalents: `positive` inequalities; an `equation` with a positive `root`
    at which these hold, the value of a `parameter`.
    """

    positive: tuple[Markup, ...]
    equation: Markup
    root: Markup
    parameter: Markup


def written_conditions(piece: Piece) -> Conditions:
    """Conditions on the values of a model, typeset."""
    return Conditions(
        tuple(typeset(text, "&gt;") for text in piece.positive),
        typeset(piece.equation) if piece.equation else Markup(),
        math(symbol(piece.root)) if piece.root else Markup(),
        math(prime(piece.parameter)) if piece.parameter else Markup(),
    )


def typeset(polynomial: str, relation: str = "=") -> Markup:
    """A polynomial that is zero, or positive (`relation`: &gt;), as an equation or an inequality of
    its positive and its negative terms.
    """
    ring = symbols(sorted({*symbols_of(tree(polynomial))}))
    value = Expansion(ring, next(iter(ring.values())) ** 0).value(tree(polynomial)).num
    sides = [
        [(abs(c), powers) for c, powers in terms(value) if (c > 0) is sign]
        for sign in (True, False)
    ]
    left, right = ("".join(summands(side)) or "<mn>0</mn>" for side in sides)
    return math(f"{left}<mo>{relation}</mo>{right}")


def combinations(basis: Sequence[Combination]) -> tuple[Markup, ...]:
    """Determinable combinations of parameters, those too long to read by the name of their
    coefficient.
    """
    parts = ([symbol(c.name)] if c.is_named else formula(c.formula) for c in basis)
    return tuple(Markup(" ").join(map(math, texts)) for texts in parts)


def _coefficients(polynomial: Polynomial) -> list[Coefficient]:
    return [(power, p) for power, p in enumerate(coefficients(polynomial, "s")) if not p.is_zero()]


@cache
def _show_polynomial(own_parts: Content) -> tuple[tuple[str, ...], str]:
    """A polynomial in MathML and in LaTeX.

    Many chains of a family share it: a denominator does not depend on the ports.
    """
    shown = _readable(polynomial_of(own_parts))
    parts = factorise(shown.num) if isinstance(shown, RationalFunction) else summands(shown)
    return tuple(parts), latex(shown)


def _readable(polynomial: Polynomial) -> RationalFunction | Sum:
    """To be written factorised where no factor is long, else term by term."""
    brackets = (sum(map(sum, p.monoms())) for p, _ in factors(polynomial)[1] if len(p) > 1)
    is_short = all(letters <= LONGEST_BRACKET for letters in brackets)
    return RationalFunction(polynomial, polynomial**0) if is_short else terms(polynomial)


def _typeset(parts: Sequence[str], stiffness: bool) -> tuple[Markup, ...]:
    return tuple(
        math(part.replace("<mi>k</mi>", "<mi>κ</mi>") if stiffness else part) for part in parts
    )


def _in_s(letter: str, items: Sequence[Coefficient]) -> str:
    return "<mo>+</mo>".join(
        symbol(f"{letter}{n}") + (symbol("s", n) if n else "") for n, _ in reversed(items)
    )


def _latex(sides: Sequence[Side], flat: Sequence[tuple[str, str]], called: str) -> str:
    top, bottom = (_latex_in_s(letter, tuple(n for n, _ in items)) for letter, items in sides)
    rows = [rf"{called}(s) &= \frac{{{top}}}{{{bottom}}}"] + [
        f"{latex_symbol(label)} &= {of}" for label, of in flat
    ]
    return "\\begin{align}\n  " + " \\\\\n  ".join(rows) + "\n\\end{align}"


@cache
def _latex_in_s(letter: str, powers: tuple[int, ...]) -> str:
    return latex([(1, {f"{letter}{n}": 1, "s": n}) for n in reversed(powers)])
