"""The responses of a fit one by one: their data, their drawings, how much of them is reproduced."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from markupsafe import Markup

from disting.fit.results.selection import Selection
from disting.fit.search.setup import Setup, port
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.report.drawing import Port, draw, state
from disting.report.fit.residuals import bands_in_words
from disting.report.fit.style import FigureFiles
from disting.report.fit.words import fit_in_words
from disting.report.scene import PAGE_PALETTE, Scene, body, number

PANELS = 2  # of a response: Bode diagram and residuals


@dataclass(frozen=True, slots=True, eq=False)
class Response:
    """Response `at`, counted from 0, with its data."""

    at: int
    setup: Setup
    train: FrequencyResponse
    test: FrequencyResponse | None


@dataclass(frozen=True, slots=True, eq=False)
class ShownResponse:
    """A response as the page shows it; `drawing`: of the machine as it is there, "" where that is
    the one of the result.
    """

    title: str
    drawing: Markup
    description: str
    fitted: str
    panels: Sequence[tuple[FigureFiles, Sequence[str]]]


def responses(
    selection: Selection, train: FrequencyResponse, test: FrequencyResponse | None
) -> list[Response]:
    """All responses; `train` and `test` are data of the first one."""
    cost, judging = selection.task.cost, selection.judging
    tests = {} if judging is cost else dict(zip(judging.setups, judging.parts, strict=True))
    each = list(enumerate(zip(cost.setups, cost.parts, strict=True)))
    return [
        Response(0, cost.setups[0], train, test),
        *(
            Response(at, setup, part.measured, tests[setup].measured if setup in tests else None)
            for at, (setup, part) in each[1:]
        ),
    ]


def shown_responses(
    selection: Selection,
    train: FrequencyResponse,
    test: FrequencyResponse | None,
    figures: Sequence[FigureFiles],
) -> list[ShownResponse]:
    """Each response with its figures; `figures`: Bode diagram and residuals of each come first."""
    the_shown_responses = []
    for response in responses(selection, train, test):
        own = figures[PANELS * response.at : PANELS * (response.at + 1)]
        words = bands_in_words(selection, response.train, response.test, response.at)
        scene = in_response(selection.described.chain, selection, response)
        the_shown_responses.append(
            ShownResponse(
                response.setup.text,
                drawing(scene) if _is_changed(response.setup) else Markup(""),
                scene.title,
                fit_in_words(selection, response.train, response.test, response.at),
                [*zip(own, words, strict=False)],
            )
        )
    return the_shown_responses


def with_all_sensors(chain: Chain, selection: Selection) -> Scene:
    """A chain with all sensors that are read on the machine as it is."""
    setups = [setup for setup in _setups(chain, selection) if not _is_changed(setup)]
    signs = _signs(chain, selection)
    ports = {_port(chain, setup) for setup in setups}
    read = {sign: place for sign, place in signs.items() if place in ports}
    also = "".join(f"; {sign}: sensor {_name_port(read[sign])}" for sign in read if sign != "y")
    return replace(state(chain, read), title=f"{draw(chain).title.removesuffix('.')}{also}.")


def in_response(chain: Chain, selection: Selection, response: Response) -> Scene:
    """A chain as it is in one response."""
    setup = _setups(chain, selection)[response.at]
    n, place = chain.n_masses, _port(chain, setup)
    read = {sign: at for sign, at in _signs(chain, selection).items() if at == place}
    measured = setup.experiment(n)
    scene = state(chain, read, measured.changes, measured.force)
    title = f"{draw(chain).title.removesuffix('.')}; measured here: {response.setup.text}."
    return replace(scene, title=title)


def drawing(scene: Scene) -> Markup:
    """A chain as an engineer sketches it."""
    box = f"0 0 {number(scene.width)} {number(scene.height)}"
    return Markup(
        '<svg class="chain" width="{}" viewBox="{}" role="img" aria-label="{}">{}</svg>'
    ).format(number(1.4 * scene.width), box, scene.title, Markup(body(scene, PAGE_PALETTE)))


def _signs(chain: Chain, selection: Selection) -> dict[str, Port]:
    """All places of sensors, "y" that of the first response, then "y2", "y3" .. as they come."""
    ports = dict.fromkeys(_port(chain, setup) for setup in _setups(chain, selection))
    return {f"y{k}" if k > 1 else "y": place for k, place in enumerate(ports, 1)}


def _setups(chain: Chain, selection: Selection) -> tuple[Setup, ...]:
    """All setups, at the masses of a chain."""
    return selection.task.cost.setups_of(chain.structure)


def _port(chain: Chain, setup: Setup) -> Port:
    if not setup.sensor:
        return chain.meas_plus, chain.meas_minus
    minus, plus = port(setup.sensor, chain.n_masses)
    return plus, minus


def _name_port(place: Port) -> str:
    return f"at mass {place[0]}" + (f" against mass {place[1]}" if place[1] else "")


def _is_changed(setup: Setup) -> bool:
    return bool(setup.changes or setup.force)
