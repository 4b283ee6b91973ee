"""A network, or any model with a transfer function or a matrix of them, as it is compared.

Condition 8 applies where both are networks, condition 9 never.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

from disting.algebra.certainty import Certainty, full_text, joint_safety
from disting.conditions.rule import Finding, Outcome
from disting.conditions.side import Side, View
from disting.conditions.sufficient import condition_6
from disting.evidence.conditions import Renaming
from disting.general.any_model import (
    LEFT,
    RIGHT,
    as_network,
    cells_of,
    is_renamed,
    is_writable,
    renamed_chain,
    without_names,
)
from disting.general.behaviour import GeneralModel
from disting.general.exponents import count_determined
from disting.general.interlacing import sets_of
from disting.general.matrix_model import AnyModel
from disting.general.model_inclusions import n_elements, numberings
from disting.general.network_model import NetworkModel, behaviour_of
from disting.general.readings import profile_text, readings
from disting.model.chain import Chain, Premise
from disting.model.presentation import GENERIC
from disting.model.question import Of
from disting.network.chains import RenamedChain

OTHER_ORDER = "the exponents can be matched in another order, which is not checked"


@dataclass(frozen=True)
class NetworkView(View):
    """A model with one transfer function or with a matrix of them; `experiments`, in words: those
    that the functions are of, where there are several.
    """

    of: ClassVar[Of] = Of.NETWORKS
    given: AnyModel
    experiments: tuple[str, ...] = ()

    @property
    def subject(self) -> AnyModel:
        """The model."""
        return self.given

    @property
    def content(self) -> tuple[str, ...]:
        """All that its verdicts depend on, as text."""
        return (full_text(self.given), *self.experiments)

    @cached_property
    def model(self) -> GeneralModel | NetworkModel:
        """The transfer functions, whatever they are called."""
        return behaviour_of(self.given)

    @cached_property
    def form(self) -> AnyModel:
        """The model without names."""
        return without_names(self.given)

    @cached_property
    def renamed_chain(self) -> RenamedChain | None:
        """The chain that it is, in whatever names of its parameters, if it is one."""
        return renamed_chain(self.given)

    @property
    def chain(self) -> Chain | None:
        """The chain that it is, if it is one."""
        return None if self.renamed_chain is None else self.renamed_chain.chain

    def chain_note(self, name: str) -> str:
        """Names of the chain's parameters in it."""
        return self.renamed_chain.note(name) if self.renamed_chain else ""

    @property
    def premise(self) -> Premise | None:
        """That of the chain that it is, if it is one; else how it is measured."""
        if self.experiments:
            return Premise(None, None, self.experiments)
        return None if self.chain is None else self.chain.premise

    def notes(self, name: str) -> tuple[str, ...]:
        """Notes on the variable that degrees count where it is not s, and on the exponents."""
        phrase = self.given.powers.sentence(name)
        return ((phrase,) if phrase else ()) + ((GENERIC,) if self.given.powers.weights else ())

    @property
    def in_s(self) -> bool:
        """True if powers of v are those of s, or of its root."""
        return not self.given.powers.weights

    @property
    def n_elements(self) -> int | None:
        """Number of elements with an effect on the response, if it is a network."""
        return n_elements(self.given.network)

    def rank_of_exponents(self) -> int:
        """Number of determinable exponents."""
        size = len(self.given.powers.weights)
        return count_determined(cells_of(self.given), size)[0] if size else 0

    def part_of(self, other: "NetworkView") -> dict[int, int] | None:
        """Return the numbering under which it is the other one with elements missing."""
        return next(numberings(self.given, other.given), None)

    def is_renamed(self, other: "NetworkView", renaming: dict[str, str]) -> bool:
        """Return True if renaming the parameters gives the other transfer function: exact, by the
        terms.
        """
        written = self.is_writable and other.is_writable
        return written and is_renamed(self.given, other.given, renaming)

    @cached_property
    def is_writable(self) -> bool:
        """True if its terms, in which exact decisions are made, are not too many."""
        return is_writable(self.given)

    @cached_property
    def asked_about(self) -> tuple[AnyModel, AnyModel]:
        """The network that it is, on the left and on the right of a question."""
        return as_network(self.given, LEFT), as_network(self.given, RIGHT)

    @cached_property
    def gives(self) -> dict[str, object]:
        """Sets of functions that the model gives by theorems on networks: models with equal sets
        are equivalent.
        """
        return sets_of(self.given) if self.is_writable else {}


NetworkSide = Side[NetworkView]


def other_orders(side: NetworkSide) -> tuple[tuple[tuple[str, ...], Renaming | None], ...]:
    """Return the other orders of its exponents that profiles leave open, each with a renaming of
    its parameters that is equivalent, if there is one.
    """
    return side.once("other orders", lambda: tuple(_other_orders(side)))


def _other_orders(side: NetworkSide) -> list[tuple[tuple[str, ...], Renaming | None]]:
    own = profile_text(side.transfer_profile)
    pairs = list[tuple[tuple[str, ...], Renaming | None]]()
    for model in readings(side.view.given):
        other = replace(side, view=replace(side.view, given=model))
        if profile_text(other.transfer_profile) == own:
            evidence = condition_6(side, other, True).evidence
            renaming = evidence if isinstance(evidence, Renaming) else None
            pairs.append((model.powers.exponents, renaming))
    return pairs


def has_other_readings(side: NetworkSide) -> bool:
    """Return True if its exponents can be matched in orders that are no symmetries of it."""
    return any(renaming is None for _, renaming in other_orders(side))


def in_every_order(left: NetworkSide, right: NetworkSide, finding: Finding) -> Finding:
    """Return what is found with the exponents in one order, of all of them: a difference is none
    where another order is no symmetry, and as sure as the profiles by which others are left out.
    """
    is_difference = finding.outcome in (Outcome.FAILS, Outcome.SOMETIMES)
    if not is_difference or not readings(left.view.given):
        return finding
    if has_other_readings(left):
        return Finding(finding.rule, Outcome.ABANDONED, note=OTHER_ORDER)
    safeties = [s.transfer_profile.safety for s in (left, right)]
    safety = joint_safety([*safeties, *([finding.safety] if finding.safety else [])])
    return replace(finding, certainty=Certainty.BOUNDED, safety=safety)
