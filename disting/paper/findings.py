"""What claims and figures are checked against; each part is computed once, when it is first
asked for.
"""

from concurrent.futures import Executor
from dataclasses import dataclass, field
from functools import cached_property

from disting.catalogs import Catalog, catalog
from disting.catalogs.dampers import DamperSets, DamperTable, dampers
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import figure_1
from disting.fit.select import select
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain, Sensor
from disting.model.family import Family
from disting.model.question import Domain
from disting.paper.refit import Refit, refitted
from disting.simulation import demo
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.query import Query, View

PictureKey = tuple[int, bool, View, int, Sensor]


@dataclass
class Findings:
    """Verdicts, catalogues and fits behind one engine; `sizes` = numbers of masses of the
    fitted candidates of Fig. 1.
    """

    engine: Engine = field(default_factory=Engine)
    executor: Executor | None = None
    progress: Progress = silent
    sizes: tuple[int, ...] = (1, 2, 3, 4)
    _pictures: dict[PictureKey, Decisions] = field(default_factory=dict, repr=False)
    _tables: dict[tuple[Chain, DamperSets], DamperTable] = field(default_factory=dict, repr=False)

    def picture(
        self,
        n_masses: int,
        damped: bool,
        view: View,
        markov: int = 0,
        sensor: Sensor = Sensor.ACCELERATION,
    ) -> Decisions:
        """All pairs of a family, by the conditions in one view; `markov` parameters after G_0,
        0 = all.
        """
        key = (n_masses, damped, view, markov, sensor)
        if key not in self._pictures:
            chains = enumerate(Family(n_masses, damped, sensor), 1)
            subjects = [self.engine.subject(f"A{number}", chain) for number, chain in chains]
            self._pictures[key] = self.engine.decisions(
                subjects, Query(view, markov=markov), executor=self.executor
            )
        return self._pictures[key]

    def catalog(self, n_masses: int, *, damped: bool) -> Catalog:
        """The shipped catalogue."""
        return catalog(n_masses, damped=damped)

    def dampers(self, chain: Chain, which: DamperSets = DamperSets.SINGLE) -> DamperTable:
        """Ground dampers of a chain against each other, over complex parameters, as the paper
        has them.
        """
        if (chain, which) not in self._tables:
            self._tables[chain, which] = dampers(
                chain, which, domain=Domain.COMPLEX, engine=self.engine, executor=self.executor
            )
        return self._tables[chain, which]

    @cached_property
    def train(self) -> FrequencyResponse:
        """The simulated demonstration drive, measured once."""
        return demo(0).response("acceleration")

    @cached_property
    def test(self) -> FrequencyResponse:
        """The same drive, measured again."""
        return demo(1).response("acceleration")

    @cached_property
    def selection(self) -> Selection:
        """The candidates of Fig. 1 fitted to the demonstration drive."""
        candidates = figure_1(self.sizes)
        return select(
            self.train,
            candidates,
            test=self.test,
            engine=self.engine,
            executor=self.executor,
            progress=self.progress,
        )

    @cached_property
    def refit(self) -> Refit:
        """A4 fitted to A1."""
        return refitted()
