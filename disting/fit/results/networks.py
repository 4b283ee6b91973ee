"""Result of a fit of networks: each with its values, those that explain the data, those that
remain.
"""

from dataclasses import dataclass, field

import numpy as np

from disting.errors import enumeration
from disting.files import Format
from disting.fit.judge.explanation import FEW_CLEAR, Miss
from disting.fit.judge.interval import Interval
from disting.fit.judge.network_intervals import NetworkTwin, intervals_to_dict
from disting.fit.search.cost import comparable
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.measurement.linearity import describe_nonlinearity
from disting.model.presentation import NotebookTable, summary
from disting.network.network import Network
from disting.network.notation.entries import entry_of
from disting.statistics.practical import NoiseModel
from disting.statistics.scatter import Scatter
from disting.verdict.decisions import Decisions

BAR = " | "  # between names of networks, which have commas


@dataclass(frozen=True, slots=True, eq=False)
class FittedNetwork:
    """A network with its values of least |r|^2, r whitened, shape (n_y,), and how well it explains
    the data.

    `same`: other candidates that give the same responses for all positive values; `relative`:
    standard deviations of the logarithms of the values, infinite of what the data or the network do
    not determine; `chi2` per line, 1 for the true one; `excluded_by`: the network that excludes it;
    `apart`: it explains the data apart from its `misses`;
    `columns`: sensitivities of r by the logarithms of the values, shape (n_y, n_p);
    `intervals` of 95 % of the values: of fits that are not excluded, and of the best one; `twins`,
    the networks of `same` with their own values: of those of these that contain no other one;
    `contains`: the simplest network left that it contains, "" if there is none.
    """

    network: Network
    values: dict[str, float]
    relative: dict[str, float]
    rank: int
    chi2: float
    residual: Real = field(repr=False)
    basis: Real = field(repr=False)
    noise: NoiseModel = field(repr=False)
    same: tuple[str, ...] = ()
    explains: bool = False
    apart: bool = False
    excluded_by: str = ""
    contains: str = ""
    misses: tuple[Miss, ...] = ()
    intervals: dict[str, Interval] = field(default_factory=dict)
    twins: tuple[NetworkTwin, ...] = ()
    columns: Real = field(repr=False, default_factory=lambda: np.empty((0, 0)))

    @property
    def cost(self) -> float:
        """|r|^2."""
        return float(self.residual @ self.residual)

    @property
    def is_left(self) -> bool:
        """True if it explains the data and no other network excludes it."""
        return self.explains and not self.excluded_by

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; None for a deviation that is infinite."""
        return {
            "name": self.network.name,
            "values": self.values,
            "relative_deviations": {
                name: x if np.isfinite(x) else None for name, x in self.relative.items()
            },
            "intervals": intervals_to_dict(self.intervals),
            "rank": self.rank,
            "chi2": self.chi2,
            "explains": self.explains,
            "apart": self.apart,
            "excluded_by": self.excluded_by,
            "contains": self.contains,
            "same": list(self.same),
            "twins": [twin.to_dict() for twin in self.twins],
            "misses": [miss.sentence for miss in self.misses],
        }


@dataclass(frozen=True, slots=True, eq=False)
class NetworkSelection(NotebookTable):
    """Result of a selection of networks: `fits`, the selected one first, then by chi2; all
    candidates (`networks`); the responses (`measured`), and `scatter` of the lines.
    """

    fits: tuple[FittedNetwork, ...]
    networks: tuple[Network, ...]
    measured: tuple[FrequencyResponse, ...] = field(repr=False)
    scatter: Scatter
    decisions: Decisions = field(repr=False)

    def __repr__(self) -> str:
        chosen = self.selected
        return summary(self, chosen.network.name if chosen else "none explains the data")

    @property
    def left(self) -> tuple[FittedNetwork, ...]:
        """Those that explain the data, that no other one excludes, and that contain no other one
        which is left.
        """
        return tuple(f for f in self.fits if f.is_left and not f.contains)

    @property
    def containing(self) -> tuple[FittedNetwork, ...]:
        """Those that contain one that is left: no experiment excludes them if that is true."""
        return tuple(f for f in self.fits if f.is_left and f.contains)

    @property
    def selected(self) -> FittedNetwork | None:
        """Of those that are left the one with the fewest determinable values, then of the least
        cost, to six digits, then the first that was named.
        """
        return min(self.left, key=lambda f: (f.rank, comparable(f.cost)), default=None)

    @property
    def sentence(self) -> str:
        """The answer in a sentence."""
        chosen = self.selected
        if self.scatter.clear < FEW_CLEAR:
            return "The data are mostly noise: they support no network."
        if chosen is None:
            return "None of these networks explains the data."
        twins = (
            f", which cannot be distinguished from {enumeration(chosen.same, BAR)}"
            if chosen.same
            else ""
        )
        others = [f.network.name for f in self.left if f is not chosen]
        more = f" The data do not exclude {enumeration(others, BAR)} either." if others else ""
        if self.containing:
            larger = enumeration([f.network.name for f in self.containing], BAR)
            contain = "contains" if len(self.containing) == 1 else "contain"
            more += f" Nor do they exclude {larger}, which {contain} one of these."
        missed = "; ".join(miss.sentence for miss in chosen.misses) or "a small misfit"
        apart = f" apart from {missed}" if chosen.apart else ""
        return f"{chosen.network.name} is the simplest that explains the data{apart}{twins}.{more}"

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on a machine or circuit that is not linear."""
        return tuple(dict.fromkeys(filter(None, map(describe_nonlinearity, self.measured))))

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON."""
        chosen, (first, *_) = self.selected, self.measured
        return {
            "format": Format.NETWORK_FIT.value,
            "sentence": self.sentence,
            "warnings": list(self.warnings),
            "selected": chosen.network.name if chosen else None,
            "scatter": self.scatter.typical,
            "frequencies": {
                "low": float(first.frequency[0]),
                "high": float(first.frequency[-1]),
                "lines": len(first),
            },
            "networks": [{"name": n.name, **entry_of(n)} for n in self.networks],
            "fits": [fit.to_dict() for fit in self.fits],
        }
