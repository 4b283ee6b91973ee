"""What a notebook shows of an object: a drawing, a table, a plot with matplotlib; and a chain as
formulas or numbers.

The rooms below ask for it as `disting.model.presentation.Presenter`, which `Notebook` is.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from disting.algebra.symbols import Expr
from disting.behaviour.transfer import transfer_function
from disting.export import state_space, to_control
from disting.fit.search.data import check_range
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain, StateSpace
from disting.network.network import Network
from disting.report.drawing import chain_svg
from disting.report.network_drawing import network_svg
from disting.report.notebook.plots import drawn_on
from disting.report.notebook.tables import table_of  # with those of `tables`
from disting.simulation.mechanics import check_values, frequency_response
from disting.statistics.scatter import scatter


class Notebook:
    """Draws what a notebook asks for; it keeps nothing."""

    def html(self, shown: Any, /) -> str:
        """The object as a piece of an HTML page; raises TypeError for what has none."""
        return table_of(shown)

    def svg(self, shown: Chain | Network, /) -> str:
        """The drawing of a chain or a network on white paper, which is right in light and dark
        notebooks.
        """
        return chain_svg(shown) if isinstance(shown, Chain) else network_svg(shown)

    def transfer_function(self, shown: Chain, /) -> Expr:
        """G(s) from force to sensor."""
        return transfer_function(shown)

    def frequency_response(self, shown: Chain, values: Mapping[str, float], omega: Any, /) -> Any:
        """G(j omega) with numbers."""
        return frequency_response(shown, values, np.asarray(omega, dtype=float))

    def state_space(self, shown: Chain, values: Mapping[str, float], /) -> StateSpace:
        """The matrices with numbers."""
        return state_space(shown, check_values(shown, values))

    def to_control(self, shown: Chain, values: Mapping[str, float], /) -> Any:
        """The same for python-control."""
        return to_control(shown, check_values(shown, values))

    def scatter(self, shown: FrequencyResponse, /) -> tuple[float, str]:
        """Median over the lines of sigma / (|G| sqrt 2), and the source that it is known from.
        Raises InputError for numbers that a fit does not compute with.
        """
        check_range(shown)
        known = scatter(shown)
        return known.typical, known.source

    def plot(self, shown: Any, ax: Any, style: Mapping[str, Any], /) -> Any:
        """The object on axes of matplotlib; raises TypeError for what has no plot."""
        return drawn_on(shown, ax, style)
