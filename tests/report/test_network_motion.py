"""Trees and loops in motion: the page computes what Python computes, and draws them so that they can
be read.
"""

import json
import re
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import null_space
from scipy.signal import lsim

from disting.general.any_model import of_network
from disting.general.model_files import ModelList
from disting.model.chain import Quantity
from disting.network import network_of
from disting.network.families import family_of
from disting.report.listing import Listing, judge
from disting.report.model_list import write_model_list
from disting.report.motion import (
    drawing_of,
    machine_of,
    motion_page_of,
    page_of_motion,
    places,
    start_values_of,
)
from disting.simulation import frequency_response, matrices, port_vectors
from disting.verdict.engine import Engine
from disting.verdict.result import View

pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
TEXTS = {
    "tree": "1=2, 1=3; F1; S1",
    "row": "1=2=3; F1; S1",
    "loop": "1=2=3=1; F1; S1",
    "held": "1=2=3=1, 2=#, 3-#; F1:2; S3",
}
GEARED = ["1=2*5/2=3; F1; S3", "1~2*i, 1=3*j, 3~4*i; F2; S4", "1=2*i=3=#; F1; S1"]
FAMILIES = ("machines-2", "machines-2-damped", "machines-3", "trees-4")
PAGE = "list-loops-motion.html"


def listed(texts):
    models = tuple(of_network(network_of(t, name=n)) for n, t in texts.items())
    return Listing(judge(ModelList(models), Engine()), "Loops", "list-loops")


@pytest.fixture(scope="module")
def found():
    return listed(TEXTS)


@pytest.fixture(scope="module")
def site(found, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("motion")
    assert folder / PAGE in write_model_list(found, folder)
    assert f'href="{PAGE}"' in (folder / "list-loops.html").read_text(encoding="utf-8")
    return folder


def data_of(page: str):
    return json.loads(re.search(r'id="data">(.*?)</script>', page)[1])


def drawn(machine, values):
    """Values under their names, as the page lists them: masses, springs, dampers, ratios."""
    rank = "mkd".index
    names = [e.value for e in sorted(machine.elements, key=lambda e: rank(e.letter))]
    names += sorted({e.ratio for e in machine.elements if e.known_ratio is None})
    return dict(zip(names, values, strict=True))


@pytest.mark.full
def test_frequency_responses_are_those_of_python(visit, found) -> None:
    rng, omega = np.random.default_rng(1), np.geomspace(0.5, 80, 9)
    every = [m for name in FAMILIES for m in family_of(name).networks[::7]]
    every += [machine_of(model) for model in found.found.family]
    every += [machine_of(of_network(network_of(text))) for text in GEARED]

    asked = []
    for machine in every:
        values = np.array(start_values_of(machine)) * np.exp(
            rng.uniform(-1, 1, len(machine.parameters))
        )
        asked.append([drawing_of(machine), values.tolist()])
    seen = visit(PAGE).evaluate(
        """([models, omega]) => models.map(([given, values]) => {
          const machine = machineOf(given), solver = createSolver(machine), parts = partsOf(machine, values);
          return omega.map((w) => solver.response(parts, 0, w));
        })""",
        [asked, omega.tolist()],
    )
    for machine, (_, values), pairs in zip(every, asked, seen, strict=True):
        expected = frequency_response(machine, drawn(machine, values), omega)
        np.testing.assert_allclose([complex(*pair) for pair in pairs], expected, rtol=1e-8)


@pytest.mark.full
def test_derivatives_behind_gears_are_those_of_differences(visit) -> None:
    machine = machine_of(of_network(network_of(GEARED[1])))
    given, values = drawing_of(machine), start_values_of(machine)
    seen = visit(PAGE).evaluate(
        """([given, values]) => {
          const machine = machineOf(given), solver = createSolver(machine), into = new Float64Array(2 * values.length), h = 1e-6;
          const log = (at) => { const [re, im] = solver.response(partsOf(machine, at), 0.1, 3); return [Math.log(Math.hypot(re, im)), Math.atan2(im, re)]; };
          solver.gradient(partsOf(machine, values), values.map(() => 1), 0.1, 3, into);
          return values.map((_, p) => {
            const [up, down] = [h, -h].map((step) => log(values.map((x, q) => x + (p === q) * step)));
            return [into[2 * p], into[2 * p + 1], (up[0] - down[0]) / (2 * h), (up[1] - down[1]) / (2 * h)];
          });
        }""",
        [given, values],
    )
    seen = np.array(seen)
    assert "i" in given["kinds"] and np.abs(seen).max() > 0.1
    np.testing.assert_allclose(seen[:, :2], seen[:, 2:], atol=1e-7)


MOVED = """([given, values, force, dt]) => {
  const machine = machineOf(given), found = moved(machine, partsOf(machine, values), Float64Array.from(force), dt);
  return { acceleration: [...found.acceleration], places: [...found.places], free: machine.free };
}"""


@pytest.mark.full
@pytest.mark.parametrize("name", ["loop", "held", *GEARED])
def test_the_motion_is_that_of_the_state_space(visit, name) -> None:
    machine = machine_of(of_network(network_of(TEXTS.get(name, name))))
    values = start_values_of(machine)
    m, (act, meas) = matrices(machine, drawn(machine, values)), port_vectors(machine)
    n, dt = len(m.M), 0.02
    inverse = np.linalg.inv(m.M)
    below = np.hstack([-inverse @ m.K, -inverse @ m.D])
    a = np.vstack([np.hstack([np.zeros((n, n)), np.eye(n)]), below])
    push = inverse @ act
    system = a, np.concatenate([np.zeros(n), push])[:, None], (meas @ below)[None], [[meas @ push]]
    force = np.sin(np.arange(400) ** 2 / 2000) + (np.arange(400) < 90)
    seen = visit(PAGE).evaluate(MOVED, [drawing_of(machine), values, force.tolist(), dt])
    _, expected, _ = lsim(system, force, dt * np.arange(400))
    np.testing.assert_allclose(seen["acceleration"], expected, atol=1e-9 * np.abs(expected).max())
    where = np.array(seen["places"]).reshape(400, -1)
    travel = null_space(m.K + m.D)  # how far each mass goes where nothing is stretched
    assert seen["free"] == list(range(n)) * travel.shape[1]
    # the centre of what travels stays where it was
    assert np.abs(where @ np.diag(np.diag(m.M)) @ travel).sum() < 1e-8 * np.abs(where).max()


@pytest.mark.full
def test_the_page_knows_every_verdict(found) -> None:
    data = data_of(motion_page_of(found))
    assert data["names"] == list(TEXTS) and data["masses"] == 3 and data["damped"]
    assert data["groups"] == [list(group) for group in found.found.classes(View.POSITIVE)]
    assert [m["order"] for m in data["machines"]] == [Quantity.ACCELERATION.order] * 4


@pytest.mark.full
def test_all_machines_of_the_families_can_be_read() -> None:
    """No two masses at one place, none on a joint of others; trees without a joint that crosses."""
    for name in FAMILIES:
        for machine in family_of(name).networks:
            placed = places(machine)
            assert set(placed) == set(machine.nodes)
            assert len(set(placed.values())) == len(placed)
            joints = {tuple(sorted(e.nodes)) for e in machine.elements if e.kind.ends == 2}
            lines = [tuple(placed[i] for i in joint) for joint in joints if 0 not in joint]
            for (ax, ay), (bx, by) in lines:
                assert ax != bx  # a joint that stands upright would shear
                for x, y in set(placed.values()) - {(ax, ay), (bx, by)}:
                    on = (bx - ax) * (y - ay) == (by - ay) * (x - ax)
                    assert not (on and min(ax, bx) < x < max(ax, bx))
            for one, other in combinations(lines, 2):
                assert not (name == "trees-4" and crosses(one, other))


def crosses(one, other):
    """Independent: both parameters of the meeting point lie inside."""
    (p, q), (r, s) = (np.array(line, dtype=float) for line in (one, other))
    matrix = np.array([q - p, r - s]).T
    if abs(np.linalg.det(matrix)) < 1e-9:
        return False
    t, u = np.linalg.solve(matrix, r - p)
    return 1e-6 < t < 1 - 1e-6 and 1e-6 < u < 1 - 1e-6


@pytest.mark.full
def test_a_pair_moves_and_is_named(visit) -> None:
    tab = visit(PAGE + "#A1-A4")
    assert tab.text_content("#pair").startswith("tree and held")
    assert (
        "at least one of tree and held has responses that the other cannot produce"
        in tab.inner_text("#verdict")
    )
    boxes = tab.locator("#two g rect")
    assert boxes.count() == 3 and tab.locator("#two text").count() > 10
    before = tab.locator("#two g >> nth=0").get_attribute("transform")
    tab.locator("#time").fill("0.11")
    assert tab.locator("#two g >> nth=0").get_attribute("transform") != before
    first = tab.locator("#two path").evaluate_all("(all) => all.map((e) => e.getAttribute('d'))")
    tab.locator("#time").fill("0.3")
    moved = tab.locator("#two path").evaluate_all("(all) => all.map((e) => e.getAttribute('d'))")
    assert (
        sum(a != b for a, b in zip(first, moved, strict=True)) == 9
    )  # springs and dampers, that of the bearing too
    tab.click("#after")
    assert re.search(r"#A\d-A\d$", tab.url)


@pytest.mark.full
def test_what_a_damper_alone_holds_has_a_band(visit) -> None:
    """The frequencies of the springs: that of travel is zero, though a damper holds it."""
    from_to = visit(PAGE).evaluate(
        """(given) => {
          const machine = machineOf(given);
          return [machine.free, machine.loose, ...createSecond(() => 0).band(machine, [1, 1, 100, 0.5])];
        }""",
        drawing_of(network_of("1~2, 1-#; F1; S2")),
    )
    free, loose, low, high = from_to
    own = np.sqrt(200)
    assert (free, loose) == ([], 1) and own / 16 < low < own / 4 and 2 * own < high < 8 * own


@pytest.mark.full
def test_gears_move(tmp_path) -> None:
    """The ratio has a slider, and the machine without its gear does the same."""
    texts = {"gear": "1=2*i; F1; S2", "plain": "1=2; F1; S2"}
    assert machine_of(of_network(network_of("1=2*i=3*j=1; F1; S1"))) is None
    data = data_of(motion_page_of(listed(texts)))
    assert data["groups"] == [[1, 2]]
    assert data["machines"][0]["names"] == ["m1", "m2", "k12", "d12", "i"]
    assert data["machines"][0]["joints"] == [[1, 2, "i"]]
    assert data["machines"][1]["joints"] == [[1, 2]]
    assert data["values"][0][-1] == 2.0


@pytest.mark.full
def test_wrong_addresses_say_what_there_is(visit) -> None:
    tab = visit(PAGE + "#A1-A9")
    assert "names no pair here: there are the models A1 to A4" in tab.inner_text("#trouble")


@pytest.mark.full
@pytest.mark.parametrize(
    "texts",
    [
        {"a": "R1-C1", "b": "p(R1,C1)"},
        {"a": "1=2; F1; S1", "b": "1=2=3; F1; S1"},
        pytest.param(  # no motion without stretch
            {"a": "1=2*i=3*j=1; F1; S1", "b": "1=2=3; F1; S1"}, marks=pytest.mark.slow
        ),
        {"a": "1=2; F1; S1; position", "b": "1=2; F1; S2"},
        {"a": "1-2; F1; S1", "b": "1=2; F1; S1"},
    ],
)
def test_other_lists_have_no_page(texts, tmp_path) -> None:
    assert page_of_motion(listed(texts)) == ""
    assert not any("motion" in path.name for path in write_model_list(listed(texts), tmp_path))


@pytest.mark.full
def test_machines_that_are_named_by_their_text_are_numbered(tmp_path) -> None:
    texts = ["1~2; F1; S1", "#~1~2; F1; S1"]
    found = listed(dict(zip(texts, texts, strict=True)))
    data = data_of(motion_page_of(found))
    assert data["names"] == ["A1", "A2"] and data["hints"] == texts
    assert data["folder"] == "models/list-loops"
