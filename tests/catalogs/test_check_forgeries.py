"""Forgeries that `catalog/check.py` refuses: several fields that fit each other, evidence of the
same pair over other values, models that no notation has, numbers that are none.
"""

import json
from copy import deepcopy
from importlib.util import module_from_spec, spec_from_file_location

import pytest

from disting.catalogs.files import shipped_folder


@pytest.fixture(scope="module")
def check():
    spec = spec_from_file_location("catalog_check", shipped_folder() / "check.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def records(name):
    text = (shipped_folder() / f"{name}.jsonl").read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()]


def table_of_text(check, tmp_path, name, text):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    table = check.Table()
    check.check_file(table, path)
    return table


def table_of(check, tmp_path, name, lines):
    text = "".join(json.dumps(line) + "\n" for line in lines)
    return table_of_text(check, tmp_path, f"{name}.jsonl", text)


def pair_at(lines, left, right):
    return next(r for r in lines if (r.get("left"), r.get("right")) == (left, right))


def is_refused(check, tmp_path, name, forge):
    """Return True if the file is wrong after `forge` changed its lines, and whole before."""
    lines = records(name)
    assert not table_of(check, tmp_path, name, lines).wrong
    forge(lines)
    return bool(table_of(check, tmp_path, name, lines).wrong)


DAMPED = "networks-machines-2-damped"
ALWAYS = {"relation": "indistinguishable", "decided_by": "admissible", "safety": 0,
          "representation": "parameters", "certainty": "proven"}  # fmt: skip
ABANDONED = [10, "abandoned", "proven", 0, None, "out of reach"]


def as_verdict_over_positive(lines):
    """5 and 11 are one class over complex values; over positive ones only some have equivalents."""
    r = pair_at(lines, 5, 11)
    assert r["positive"]["relation"] == "sometimes"
    r.update(positive=ALWAYS | {"evidence": r["complex"]["evidence"]}, finding=ABANDONED)


def as_finding(lines):
    r = pair_at(lines, 5, 11)
    finding = [10, "holds", "proven", 0, r["complex"]["evidence"], ""]
    r.update(positive=dict(ALWAYS), finding=finding)


def as_complex(lines):
    """Signs, which exclude positive equivalents only, put as evidence over complex values."""
    r = pair_at(lines, 10, 12)
    r["complex"].update(relation="distinguishable", decided_by="exact",
                        evidence=r["finding"][4])  # fmt: skip


def as_undecided(lines):
    """Two models that ranks tell apart become one class, with a pair that says nothing."""
    models = [r for r in lines if "network" in r and not r["group"]][:2]
    assert len({r["identifiability"]["rank"] for r in models}) == 2
    for r in models:
        r["group"] = 9
    nothing = {"relation": "undecided", "decided_by": "", "representation": "", "certainty": "",
               "safety": 0}  # fmt: skip
    ends = dict(zip(("left", "right"), (r["model"] for r in models), strict=True))
    lines.append(ends | {"complex": nothing | {"evidence": None}, "positive": nothing})


def with_a_condition(lines):
    """An open verdict that names a condition."""
    r = pair_at(lines, 5, 11)
    r["complex"].update(relation="undecided", evidence=None, certainty="")


def turned_round(lines):
    """Left and right exchanged with all that is on them: a pair stands the other way round."""
    r = pair_at(lines, 5, 11)
    r.update(left=11, right=5)
    e = r["finding"][4]
    e.update({k: not v for k, v in e.items() if k.endswith("left_given")})


def with_a_note(lines):
    """A field that an open verdict does not have."""
    r = next(r for r in lines if "positive" in r and not r["positive"].get("evidence"))
    r["positive"]["note"] = "it is distinguishable"


def evidence_of_a_neighbour(lines):
    """Evidence, verdict and finding of another pair of the same class."""
    r, other = pair_at(lines, 10, 13), pair_at(lines, 10, 12)
    r.update({k: deepcopy(other[k]) for k in ("complex", "positive", "finding")})
    r["finding"] = deepcopy(pair_at(lines, 5, 11)["finding"])
    r["positive"] = deepcopy(pair_at(lines, 5, 11)["positive"])


@pytest.mark.parametrize("forge", [
    as_verdict_over_positive, as_finding, as_complex, as_undecided, with_a_condition, turned_round,
    evidence_of_a_neighbour, with_a_note,
    lambda lines: lines[1].update(note="it is globally identifiable"),
    lambda lines: lines[0].update(schema=99),
    lambda lines: lines[1].update(network="#~1, 1=2; F-1; S2"),
    lambda lines: lines[1].update(network=lines[1]["network"].replace("F1", "F1:1")),
])  # fmt: skip
def test_a_forged_family_is_refused(check, tmp_path, forge):
    assert is_refused(check, tmp_path, DAMPED, forge)


def by_foster_over_real_values(lines):
    """Foster's sums have positive terms; over real parameters they may have complex poles."""
    r = next(r for r in lines if r.get("real", {}).get("relation") == "sometimes")
    e = {"kind": "theorem", "name": "Foster"}
    r["real"].update(relation="indistinguishable", certainty="theorem", safety=0, evidence=e)


def with_no_verdict(lines):
    r = pair_at(lines, 1, 2)
    for slot in ("tf", "markov", "structure", "fibre"):
        r.pop(slot, None)


@pytest.mark.parametrize("forge", [
    by_foster_over_real_values, with_no_verdict,
    lambda lines: lines[1].update(relation="the same as all others"),
])  # fmt: skip
def test_a_forged_file_of_chains_is_refused(check, tmp_path, forge):
    assert is_refused(check, tmp_path, "chains-3-undamped", forge)


OPEN = {"inclusion": "unknown", "certainty": "", "safety": 0, "evidence": {}, "reason": "too large"}


@pytest.mark.parametrize("told", [
    OPEN | {"note": "they are equal"}, OPEN | {"inclusion": "neither"}, OPEN | {"reason": ""},
    *({k: v for k, v in OPEN.items() if k != key} for key in OPEN if key != "evidence"),
])  # fmt: skip
def test_an_open_inclusion_has_its_fields(check, told):
    def wrong(told):
        table = check.Table()
        check.claim(table, "chains", "image", told, None, "")
        return table.wrong

    assert not wrong(OPEN)
    assert wrong(told)


@pytest.mark.parametrize("change", [{}, {"damped": False}, {"n_masses": 3}])
def test_a_file_of_chains_under_the_name_of_another_one_is_refused(check, tmp_path, change):
    head, *lines = records("chains-2-damped")
    name = "chains-3-damped" if "n_masses" in change else "chains-2-undamped"
    lines = [head | {"catalog": name} | change, *lines]
    assert table_of(check, tmp_path, name, lines).wrong


def one_candidate(lines, key, sign):
    r = next(r for r in lines if "left" in r)
    r[key] = sign + r[key][1:]


@pytest.mark.parametrize(("key", "sign"), [
    ("decided_by", "4"), ("decided_by", "e"), ("decided_by", "x"), ("certainty", "p"),
    ("certainty", "x"), ("representation", "f"),
])  # fmt: skip
def test_a_forged_sign_of_candidates_is_refused(check, tmp_path, key, sign):
    head, *lines = records("candidates")
    few = [r for r in lines if r.get("model", r.get("left", 9)) <= 4 - ("left" in r)]
    lines = [head | {"models": 4}, *(
        r | {k: v[: 4 - r["left"]] for k, v in r.items() if k != "left"} if "left" in r else r
        for r in few
    )]  # fmt: skip
    assert not table_of(check, tmp_path, "candidates", lines).wrong
    one_candidate(lines, key, sign)
    assert table_of(check, tmp_path, "candidates", lines).wrong


@pytest.mark.parametrize("text", [
    '{"group": 1, ', '{"rank": NaN, ', '{"rank": 1e999, ', '{"rank": ' + "7" * 5000 + ", ",
    '{"deep": ' + "[" * 100_000 + "]" * 100_000 + ", ",
])  # fmt: skip
def test_what_json_leaves_open_is_refused(check, tmp_path, text):
    """A name that stands twice, numbers that are none, more than can be read."""
    lines = [json.dumps(line) for line in records(DAMPED)]
    lines[2] = text + lines[2][1:]
    assert table_of_text(check, tmp_path, f"{DAMPED}.jsonl", "\n".join(lines)).wrong


def inequality(check):
    """(pair, evidence) of the first pair of the damped machines of three masses."""
    lines = records("networks-machines-3-damped")
    models = {r["model"]: check.network(r["network"]) for r in lines if "network" in r}
    r = next(r for r in lines if "finding" in r and (r["finding"][4] or {}).get("form"))
    return check.pair_of(models[r["left"]], models[r["right"]]), r["finding"][4]


def test_signs_of_numbers_that_are_none_show_nothing(check):
    """A term times a number that is none has no sign: it would cancel terms of the wrong sign."""
    pair, e = inequality(check)
    assert check.evidence(pair, e).status == check.CHECKED
    number, *names = e["form"][0]
    assert check.evidence(pair, e | {"form": [[-number, *names], *e["form"][1:]]}).status != (
        check.CHECKED
    )
    for none in (float("nan"), float("inf"), 1.0, True):
        form = [[-number, *names], [none, *names], *e["form"][1:]]
        assert check.evidence(pair, e | {"form": form}).status == check.WRONG


@pytest.mark.parametrize("network", [
    "0>1, 1>2, 2>0; in 1; out 2", "#>1, 1>2, 2>0; in 1; out 2", "1~2; F-1; S2", "1~2; F1; S2:-1",
    "R1 -1 0; R2 1 0", "1>2, 2>0; in 0; out 2",
])  # fmt: skip
def test_nodes_that_are_none_are_refused(check, network):
    with pytest.raises(ValueError, match="no nodes"):
        check.network(network)


@pytest.mark.parametrize("indices", [
    (3, 0, 2, 1, 0, 1), (3, 3, 1, 1, 1, 1), (3, 1, 2, 3, 1, 2), (3, 0, 0, 4, 0, 1),
    (3, 0, 0, 1, 0, -1), (True, 0, 0, 1, 0, 2),
])  # fmt: skip
def test_indices_of_no_chain_are_refused(check, indices):
    """Theorems look at rows only: a port in the other row would not be seen."""
    with pytest.raises(ValueError, match="no chain"):
        check.chain(*indices, True)
    assert check.chain(3, 0, 0, 1, 0, 1, True, (3,))
    with pytest.raises(ValueError, match="no chain"):
        check.chain(3, 0, 0, 1, 0, 1, True, (4,))


def test_a_chain_is_damped_or_not(check):
    """1 stands for True: built as a damped chain, it would be read as an undamped one."""
    ends = [[0, 0, 1, 0, 1], [0, 0, 2, 0, 2]]
    for damped, *others in ((1, False, False), (True, 0, False), (True, False, 0), (None,)):
        with pytest.raises(ValueError, match="no chain"):
            check.chain(3, *ends[0], damped, (), *others)
    models = [check.chain(3, *end, True) for end in ends]
    e = {"kind": "theorem", "name": "Foster"}
    assert check.evidence(check.pair_of(*models), e).status == check.WRONG


def test_one_mass_is_one_equation(check):
    """Of two damped chains whose cones do not meet by their dimensions."""
    small, big = check.chain(3, 0, 0, 1, 0, 1, True), check.chain(4, 1, 1, 2, 1, 4, True)
    x, y = map(check.profile, (small, big))
    least = min(a - b for a, b in zip(y.degrees, x.degrees, strict=True))
    e = {"kind": "meeting", "left_is_larger": False, "rank": y.full_rank, "factors": least + 1,
         "coordinates": sum(y.degrees) + 2}  # fmt: skip
    pair = check.pair_of(small, big)
    for same_mass in (False, True, 2, 50):
        assert check.evidence(pair, e | {"same_mass": same_mass}).status == check.WRONG


def test_a_root_of_s_is_no_resistor(check):
    """A file of circuits counts powers of s, not of its root: W1 would have power 0."""
    a, b = check.network("p(W1,C1)"), check.network("p(R1,C1)")
    e = {"kind": "free-choice", "rank": 2, "free": ["b0", "a0"]}
    assert check.evidence(check.pair_of(a, b), e).status == check.WRONG


@pytest.mark.parametrize(("part", "whole"), [
    ("P1", "p(P1,P2)"), ("P1-p(P2,R1)", "P1-p(P2,R1,P3)"),
])  # fmt: skip
def test_a_constant_phase_element_more_is_no_embedding(check, part, whole):
    """Two exponents are two powers of s, not one that stands for both."""
    pair = check.pair_of(check.network(part), check.network(whole), 2)
    nodes = [[i, i] for i in range(pair.left.nodes + 1)]
    for rank in range(9):
        e = {"kind": "embedding", "left_is_submodel": True, "numbering": nodes, "rank": rank}
        assert check.evidence(pair, e).status == check.WRONG


def test_a_number_that_is_minus_one_modulo_the_prime_has_no_sign(check):
    """Whoever writes formulas cannot know the prime that they are put in modulo."""
    pair = check.pair_of(check.network("p(R1,R2)"), check.network("R1-R2"))
    whole, half = "R1*R2/(R1+R2)", "1/2*R1*R2/(R1+R2)"
    back = [False, [], [["R1", "2*(R1+R2)"], ["R2", "2*(R1+R2)"]], None]

    def status(first, second):
        formulas = [[True, [], [["R1", first], ["R2", second]], None], back]
        e = {"kind": "explicit", "domain": "positive", "formulas": formulas}
        return check.evidence(pair, e).status

    assert status(half, half) == check.CHECKED
    assert status(f"{whole}-R1", "R1") == check.SEARCH
    for label in (pair.label, f"{pair.left.nodes} nodes", f"{pair.right.nodes} nodes"):
        assert status(f"{whole}+{check.prime_of(label) - 1}*R1", "R1") == check.WRONG


def test_a_dead_time_is_no_coefficient(check):
    """Of two chains with dead times: five parameters are determined, the coefficients are four."""
    a = check.chain(3, 1, 1, 2, 1, 3, False, (), False, True)
    b = check.chain(3, 2, 1, 3, 2, 3, False, (), False, True)
    e = {"kind": "free-choice", "rank": 5, "free": ["a0", "a2", "b0", "b2", "b4"]}
    assert check.evidence(check.pair_of(a, b), e).status == check.WRONG


def linked(check, tmp_path, word, e):
    """Pairs of a file of dampers that a settled pair beside it links."""
    ends = "3 masses, gap 0, force 1-0, sensor 1-0", "3 masses, gap 0, force 1-0, sensor 2-0"
    line = {"left": ends[0], "right": ends[1], "finding": [10, word, "proven", 0, e, ""]}
    (tmp_path / "settled-dampers.jsonl").write_text(json.dumps(line), encoding="utf-8")
    table, name = check.Table(), "dampers-3-undamped"
    table.folder = tmp_path
    models = check.damped_models(table, name, records(name))
    first = {m.form: i for i, m in reversed([*enumerate(models)])}
    spots = {first[repr(check.form_of(check.chain_text(end)))] for end in ends}
    return [pair for pair in check.links(table, models) if {*pair} == spots]


def test_a_settled_pair_links_only_what_it_shows_to_be_the_same(check, tmp_path):
    e = {"kind": "counts", "left": [4, 4], "right": [2, 4]}
    assert check.evidence(check.pair_of(*map(check.chain_text, (
        "3 masses, gap 0, force 1-0, sensor 1-0", "3 masses, gap 0, force 1-0, sensor 2-0"
    ))), e).status == check.CHECKED  # fmt: skip
    assert linked(check, tmp_path, "holds", e) == []


def test_a_point_with_a_million_digits_is_refused(check):
    """Within a moment: a power of ten is not written out."""
    pair = check.pair_of(*map(check.network, ("1>2, 2>0; in 1; out 1", "1>0, 1>2; in 1; out 1")))
    e = {"kind": "witnesses", "with_left_given": True, "without_left_given": True,
         "domain": "positive", "point_with": [["a10", "1e99999999"], ["a12", "1"]],
         "equivalent": [["a10", "1"], ["a12", "1"]], "point_without": []}  # fmt: skip
    assert check.evidence(pair, e).status == check.WRONG


CHAIN = {
    "n_masses": 3, "gap": 0, "act_minus": 0, "act_plus": 1, "meas_minus": 0, "meas_plus": 1,
    "damped": True, "sensor": "acceleration", "ground_dampers": [], "lag": False,
    "dead_time": False,
}  # fmt: skip
TREES = [{"network": "1~2, 1~3; F1; S1"}, {"network": "1~2, 2~3; F1; S1"}]
REPLACEMENT = {"kind": "theorem", "name": "replacement"}
EQUAL = {"kind": "theorem", "name": "symmetry"}
SAME = {"relation": "indistinguishable", "domain": "positive", "decided_by": "admissible",
        "certainty": "theorem", "safety": 0}  # fmt: skip


def verdict(check, models, evidence, **others):
    """The table of a single verdict."""
    table = check.Table()
    told = {"models": models, "query": {}, "notes": [], "evidence": evidence} | SAME | others
    check.verdict_file(table, "", told)
    return table


def statuses(table):
    return {status for row in table.counts.values() for status in row}


def test_the_verdicts_that_are_forged_below_are_checked(check):
    assert statuses(verdict(check, TREES, REPLACEMENT)) == {check.CHECKED}
    assert statuses(verdict(check, [CHAIN, CHAIN], EQUAL)) == {check.CHECKED}
    assert statuses(verdict(check, [CHAIN, CHAIN], EQUAL, domain="real")) == {check.CHECKED}


ALWAYS_SAME = {"share": "always", "certainty": "theorem", "safety": 0, "evidence": EQUAL}
BOTH_WAYS = {"kind": "both ways", "left": ALWAYS_SAME, "right": ALWAYS_SAME}


def test_shares_of_both_show_no_more_than_they_say(check):
    def of(e, **others):
        return statuses(verdict(check, [CHAIN, CHAIN], e, **others))

    assert of(BOTH_WAYS) == {check.SEARCH}
    some = ALWAYS_SAME | {"share": "sometimes"}
    forged = [(BOTH_WAYS, {"relation": "sometimes"}), (BOTH_WAYS, {"domain": "real"}),
              (BOTH_WAYS, {"relation": "distinguishable"}), (BOTH_WAYS | {"left": some}, {}),
              (BOTH_WAYS | {"left": some}, {"relation": "sometimes"}),
              (BOTH_WAYS | {"left": ALWAYS_SAME | {"safety": 9}}, {}),
              (BOTH_WAYS | {"left": ALWAYS_SAME | {"share": "x"}}, {}),
              (BOTH_WAYS, {"domain": "complex"})]  # fmt: skip
    assert [others for e, others in forged if check.WRONG not in of(e, **others)] == []


@pytest.mark.parametrize(("models", "evidence", "others"), [
    (TREES, REPLACEMENT, {"domain": "real"}),
    (TREES, REPLACEMENT, {"domain": "quaternion"}),
    (TREES, {}, {"over_complex": SAME | {"domain": "complex", "evidence": REPLACEMENT,
                                         "decided_by": "exact"}}),
    (TREES, REPLACEMENT, {"over_complex": SAME | {"evidence": REPLACEMENT}}),
    (TREES, {"kind": "replaced", "left": "k1 1 2, j1 1 0, j2 2 0, k2 1 3, j3 3 0, in 1 0, out 1 0",
             "right": "k1 1 2, j1 1 0, j2 2 0, k2 2 3, j3 3 0, in 1 0, out 1 0",
             "left_larger": False, "right_larger": False, "inner": REPLACEMENT},
     {"domain": "real"}),
])  # fmt: skip
def test_a_forged_verdict_is_refused(check, models, evidence, others):
    assert check.WRONG in statuses(verdict(check, models, evidence, **others))


def test_evidence_within_evidence_of_its_own_pair_is_not_read(check):
    """Degrees show that two differ, whatever is written inside them."""
    e = {"kind": "counts", "left": [0, 0], "right": [0, 1]}
    told = {"decided_by": "1", "certainty": "proven"}
    models = [{"network": "R1"}, {"network": "C1"}]
    whole = verdict(check, models, e, relation="distinguishable", **told)
    assert statuses(whole) == {check.CHECKED}
    for forged in (e, e | {"inner": EQUAL}, e | {"inner": EQUAL | {"domain": "positive"}}):
        assert check.WRONG in statuses(verdict(check, models, forged, **told))


def test_networks_that_give_more_show_only_a_difference(check):
    ends = {"left": "k1 1 2, j1 1 0, j2 2 0, k2 1 3, j3 3 0, in 1 0, out 1 0",
            "right": "k1 1 2, j1 1 0, j2 2 0, k2 2 3, j3 3 0, in 1 0, out 1 0"}  # fmt: skip
    for left, right in ((False, False), (True, False), (False, True)):
        e = {"kind": "replaced", **ends, "left_larger": left, "right_larger": right}
        found = statuses(verdict(check, TREES, e | {"inner": REPLACEMENT}, certainty="proven"))
        assert (check.WRONG in found) == (left or right), found


BENCH = {"elements": [["m1", 1], ["m2", 2], ["k12", 1, 2]], "force": [[1, 0]], "sensor": [[1, 0]],
         "quantity": "acceleration"}  # fmt: skip


@pytest.mark.parametrize("models", [
    [CHAIN, CHAIN | {"act_minus": 2}], [CHAIN, CHAIN | {"meas_plus": 9}],
    [CHAIN, CHAIN | {"known": {"m1": 1}}],
    [TREES[0], TREES[0] | {"known": {"m1": 1}}],
    # read in two ways: which of them is meant is not said
    [TREES[0], TREES[0] | {"sensor": "position"}], [TREES[0], CHAIN | TREES[0]],
    [BENCH, BENCH | TREES[0]], [BENCH, BENCH | {"port": [[1, 2]]}],
    [BENCH, {key: BENCH[key] for key in ("elements", "force", "sensor")}],
    [TREES[0], {"name": "x", "elements": [["m1", 1, 0, "", 7]], "force": [[1, 0]],
                "sensor": [[1, 0]], "quantity": "acceleration"}],
])  # fmt: skip
def test_a_verdict_on_models_that_are_not_known_here_is_not_checked(check, models):
    for evidence in (EQUAL, REPLACEMENT):
        assert check.CHECKED not in statuses(verdict(check, models, evidence))
