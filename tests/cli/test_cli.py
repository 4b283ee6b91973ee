"""The command line as its users meet it: what it prints, and its exit status."""

import json

import pytest

from disting.cli.commands import COMMANDS, SECTIONS, Group
from disting.store import Store
from tests.cli.process import called, disting, rows


@pytest.mark.full
def test_models_lists_the_family():
    done = disting("models", 3, "--damped")
    assert done.returncode == 0
    lines = done.stdout.splitlines()
    assert len([line for line in lines if line.split()[0].isdigit() and "[" in line]) == 11
    assert "#=[1fs]   [2F]=[3S]" in done.stdout
    assert "parameters, gap 1: m1 m2 m3 k01 k23 d01 d23" in done.stdout


@pytest.mark.full
def test_models_asks_for_parameter_sets_only_where_it_is_told_to():
    listed = called("models", 6, "--no-cache", "--undamped").stdout
    assert "· not computed (--identifiability)" in listed and "A98" not in listed
    rows = [
        line.split() for line in listed.splitlines() if line.split()[0].isdigit() and "[" in line
    ]
    assert len(rows) == 157 and {row[8] for row in rows} == {"·"}


def test_compare_explains_one_pair():
    done = called("compare", "3:1", "3:4", "--damped")
    assert done.returncode == 0
    assert done.stdout.startswith("DISTINGUISHABLE")
    assert "condition 5, Markov parameters" in done.stdout
    assert "2^-1" in done.stdout


@pytest.mark.full
def test_compare_as_json_of_shipped_computed_and_mixed_pairs():
    shipped = json.loads(called("compare", "3:2", "3:5", "--json", "--undamped").stdout)
    found = (shipped["relation"], shipped["decided_by"], shipped["certainty"], shipped["domain"])
    assert found == ("indistinguishable", "admissible", "theorem", "positive")
    paper = json.loads(
        called("compare", "3:2", "3:5", "--domain", "complex", "--json", "--undamped").stdout
    )
    assert (paper["relation"], paper["decided_by"], paper["domain"]) == (
        "indistinguishable",
        "6",
        "complex",
    )
    computed = json.loads(
        called("compare", "3:2", "3:5", "--json", "--quantity", "velocity", "--undamped").stdout
    )
    assert computed["relation"] == "indistinguishable"
    mixed = json.loads(called("compare", "2:1", "3:1", "--json", "--undamped").stdout)
    assert (mixed["left"], mixed["right"], mixed["relation"]) == ("2:1", "3:1", "distinguishable")


@pytest.mark.full
def test_compare_reads_ground_dampers_lag_and_dead_time():
    found = json.loads(called("compare", "3:1+b1", "3:4+b3+lag", "--damped", "--json").stdout)
    assert (found["left"], found["right"], found["relation"]) == (
        "3:1+b1",
        "3:4+b3+lag",
        "distinguishable",
    )
    found = json.loads(called("compare", "3:1+delay", "3:11+delay", "--damped", "--json").stdout)
    assert (found["left"], found["right"], found["relation"]) == (
        "3:1+delay",
        "3:11+delay",
        "indistinguishable",
    )


@pytest.mark.full
def test_report_writes_the_families_with_dampers_too(tmp_path):
    told = called("report", "3", "--damped", "--out", str(tmp_path)).stdout
    assert (tmp_path / "dampers-3-damped.html").is_file() and not (
        tmp_path / "dampers-3-undamped.html"
    ).exists()
    assert "dampers-3-damped.html" in (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "chains-3-damped" in told
    assert not (tmp_path / "sizes-damped.html").exists()


@pytest.mark.full
def test_report_compares_several_sizes(tmp_path):
    assert called("report", "1", "2", "--undamped", "--out", tmp_path).returncode == 0
    text = (tmp_path / "sizes-undamped.html").read_text(encoding="utf-8")
    # of 1 to 5 masses, whatever is asked
    assert "Of <strong>3,694</strong> pairs" in text and "1 in 2" in text
    assert "2 in 1" not in text
    assert "sizes-undamped.html" in (tmp_path / "index.html").read_text(encoding="utf-8")


def test_verdicts_csv_contract_and_subsets():
    everything = rows(called("verdicts", 3, "--damped", "--csv", "-").stdout)
    assert list(everything[0])[:6] == [
        "left",
        "right",
        "relation",
        "decided_by",
        "representation",
        "certainty",
    ]
    assert [(int(r["left"]), int(r["right"])) for r in everything] == [
        (i, j) for i in range(1, 12) for j in range(i + 1, 12)
    ]
    assert not [r for r in everything if r["relation"] == "undecided"]
    conditions = rows(called("verdicts", 3, "--damped", "--conditions", "1-9", "--csv", "-").stdout)
    assert sum(r["relation"] == "undecided" and r["decided_by"] == "" for r in conditions) == 6
    paper = rows(
        called(
            "verdicts",
            3,
            "--conditions",
            "1-5",
            "--representation",
            "tf",
            "--csv",
            "-",
            "--undamped",
        ).stdout
    )
    assert {r["decided_by"] for r in paper} == {"1", "4", "5", ""}
    eight = rows(
        called(
            "verdicts", 3, "--representation", "markov", "--markov", 8, "--csv", "-", "--undamped"
        ).stdout
    )
    assert {r["representation"] for r in eight} == {"markov", ""}


def test_verdicts_json_has_evidence(tmp_path):
    path = tmp_path / "v.json"
    done = called("verdicts", 2, "--json", path, "--undamped")
    assert done.returncode == 0
    assert done.stdout.startswith(
        "3 models, 3 pairs, over positive parameters: 2 distinguishable, 1 indistinguishable, 0"
        " undecided\n"
    )
    assert all(v["evidence"]["kind"] for v in json.loads(path.read_text())["verdicts"])


def test_every_command_of_the_grammar_has_what_runs_it():
    for row in COMMANDS:
        for command in row.commands if isinstance(row, Group) else [row]:
            assert callable(command.work()), command.name


@pytest.mark.full
def test_help_on_everything():
    names = [
        "models",
        "compare",
        "verdicts",
        "report",
        "catalog",
        "catalog build",
        "catalog verify",
        "cache info",
        "cache clear",
    ]
    for command in names:
        done = called(*command.split(), "--help")
        assert done.returncode == 0 and "usage: disting" in done.stdout
    assert "9  supermodel" in called("compare", "--help").stdout


def test_the_list_of_commands_is_short_and_by_subject():
    lines = called("--help").stdout.splitlines()
    assert len(lines) < 45
    assert [line for line in lines if line in {f"{title}:" for title in SECTIONS}] == [
        "measure and fit:",
        "models:",
        "maintenance:",
    ]
    assert all(sum(line.startswith(f"  {c.name} ") for line in lines) for c in COMMANDS)


@pytest.mark.full
def test_catalog_build_and_verify(tmp_path):
    assert called("catalog", "build", 2, "--out", tmp_path).returncode == 0
    good = called("catalog", "verify", 2, "--catalog", tmp_path)
    assert (good.returncode, good.stdout.count("every evidence holds")) == (0, 2)
    kept = tmp_path / "kept.sqlite3"
    again = ("catalog", "verify", 2, "--catalog", tmp_path, "--resume", kept)
    assert [called(*again).stdout for _ in range(2)] == [good.stdout] * 2
    with Store.open(kept) as store:
        assert store.info().entries > 0
    path = tmp_path / "chains-2-damped.jsonl"
    path.write_text(path.read_text().replace('"decided_by":"1"', '"decided_by":"2"'))
    refused = called("catalog", "verify", 2, "--catalog", tmp_path)
    assert refused.returncode == 2 and "chains-2-damped.jsonl is damaged" in refused.stderr
    (tmp_path / "provenance.json").unlink()
    bad = called("catalog", "verify", 2, "--catalog", tmp_path)
    assert bad.returncode == 1
    assert "line 5 is not what is computed now" in bad.stdout


@pytest.mark.slow
def test_worker_processes_and_a_dask_cluster_give_the_same_verdicts(tmp_path):
    alone = called("verdicts", 2, "--damped", "--csv", "-").stdout
    assert disting("verdicts", 2, "--damped", "--csv", "-", "--jobs", 2).stdout == alone
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
    ) as cluster:
        done = called(
            "verdicts", 2, "--damped", "--csv", "-", "--scheduler", cluster.scheduler_address
        )
    assert done.stdout == alone


@pytest.mark.full
def test_the_exact_decision_settles_what_conditions_leave_open():
    table = rows(called("verdicts", 3, "--damped", "--domain", "complex", "--csv", "-").stdout)
    exact = {
        (int(r["left"]), int(r["right"])): r["relation"]
        for r in table
        if r["decided_by"] == "exact"
    }
    assert len(exact) == 6
    assert [pair for pair, relation in exact.items() if relation == "indistinguishable"] == [
        (1, 11)
    ]
    assert not any(r["relation"] == "undecided" for r in table)
    shipped = json.loads(called("compare", "3:1", "3:6", "--damped", "--json").stdout)
    assert (shipped["relation"], shipped["decided_by"]) == ("distinguishable", "exact")
    paper = json.loads(
        called("compare", "3:1", "3:6", "--damped", "--conditions", "1-9", "--json").stdout
    )
    assert (paper["relation"], paper["decided_by"]) == ("undecided", "")


@pytest.mark.full
def test_ranges_and_positive_parameters_are_told_both_ways():
    done = called("compare", "4:2", "4:6", "--undamped").stdout.splitlines()
    assert done[0] == "SOMETIMES"
    assert (
        done[-1]
        == "domain     positive parameters; over complex ones they are indistinguishable (--domain"
        " complex)"
    )
    assert any("77 of 100 random points have one: empirically 68% to 84%" in line for line in done)
    apart = called("compare", "3:6", "3:7", "--damped").stdout.splitlines()
    assert apart[-1].startswith("positive: 3:7 in 3:6 never. No generic positive parameters of 3:7")
    inside = called(
        "compare", "3:1", "3:4", "--bound", "k12=0..1000", "--bound", "m1=0.5..2", "--undamped"
    ).stdout.splitlines()
    for line, start in zip(inside[-2:], ("3:1 in 3:4", "3:4 in 3:1"), strict=True):
        assert line.startswith(f"within the ranges: {start} sometimes")
    for wrong, says in (
        ("k12=5", "written like"),
        ("x9=1..2", "no parameter"),
        ("k12=3..1", "not empty"),
    ):
        refused = called("compare", "3:1", "3:4", "--bound", wrong, "--undamped")
        assert refused.returncode == 2 and says in refused.stderr


@pytest.mark.full
def test_a_verdict_is_over_positive_parameters_where_nothing_is_said_and_over_complex_ones_in_the_papers_view():
    domains = {
        (): "positive",
        ("--domain", "real"): "real",
        ("--domain", "complex"): "complex",
        ("--conditions", "1-9"): "complex",
    }
    for given, domain in domains.items():
        told = called("compare", "4:3", "4:7", "--undamped", *given).stdout
        assert (
            f" over {domain} parameters (" in told and f"\ndomain     {domain} parameters" in told
        )
    table = rows(called("verdicts", 3, "--representation", "tf", "--csv", "-", "--undamped").stdout)
    assert {r["domain"] for r in table} == {"complex"}
    refused = called(
        "compare", "4:3", "4:7", "--conditions", "1-9", "--domain", "positive", "--undamped"
    )
    assert refused.returncode == 2 and "domain positive is not supported" in refused.stderr


@pytest.mark.full
def test_verdicts_names_the_domain_and_what_depends_on_the_values():
    told = called("verdicts", 4, "--undamped").stdout.splitlines()
    head = "29 models, 406 pairs, over positive parameters"
    assert told[0] == f"{head}: 357 distinguishable, 48 indistinguishable, 1 sometimes, 0 undecided"
    paper = called("verdicts", 3, "--damped", "--domain", "complex").stdout.splitlines()
    assert (
        paper[0]
        == "11 models, 55 pairs, over complex parameters: 52 distinguishable, 3 indistinguishable,"
        " 0 undecided"
    )
    assert paper[1].endswith("2 by condition 6, 6 by the exact decision")


@pytest.mark.full
def test_a_pair_in_the_other_order_draws_each_model_under_its_own_name():
    """A stored verdict names the lower number first: drawings, ranges and proofs follow it."""
    told = called("compare", "4:4", "4:1", "--undamped").stdout.splitlines()
    assert told[2:4] == ["  4:1  [1FS]~[2]~[3]~[4]", "  4:4  [1F]~[2]~[3]~[4S]"]
    turned = called(
        "compare", "3:4", "3:1", "--bound", "k12=0..1000", "--bound", "m1=0.5..2", "--undamped"
    ).stdout
    assert (
        turned
        == called(
            "compare", "3:1", "3:4", "--bound", "k12=0..1000", "--bound", "m1=0.5..2", "--undamped"
        ).stdout
    )


def test_the_rule_names_what_decided():
    """A theorem is not called a fibre."""
    assert (
        "(exact decision, a theorem)"
        in called("compare", "3:1", "3:11", "--damped", "--domain", "complex").stdout
    )
    assert "(exact decision, one fibre)" in called("compare", "3:1", "3:6", "--damped").stdout


def test_the_doctor_names_what_is_there():
    done = called("doctor")
    assert done.returncode == 0
    assert {"disting", "python-flint", "cache"} <= {
        line.split()[0] for line in done.stdout.splitlines()
    }


@pytest.mark.full
def test_proofs_on_request():
    table = rows(called("verdicts", 3, "--damped", "--prove", "--csv", "-").stdout)
    assert {r["certainty"] for r in table if r["decided_by"] in ("4", "5")} == {"proven"}


def test_models_tells_of_a_network_what_enters_and_what_is_determined():
    done = called("models", "1~2, 2~#, 3~#; F1; S1")
    assert done.stdout.splitlines() == [
        "1~2, 2~#, 3~#; F1; S1  G(s) = ((k02 + k12)*s**2 + m2*s**4)/(k02*k12 + (k02*m1 + k12*m1"
        " + k12*m2)*s**2 + m1*m2*s**4)",
        "without effect on the response, as no path leads through it: k03, m3",
        "6 parameters, only 4 determinable; globally: k02, k12, m1, m2; not: k03, m3; 2 can be"
        " chosen freely.",
    ]
    for arguments, wanted in (
        (["R0-p(R1,C1"], "it ends too early"),
        (["R1-C1", "--damped"], "--damped is supported for numbered chains"),
        (["R1-C1", "--also", "lock=1"], "experiments are on machines"),
    ):
        refused = called("models", *arguments)
        assert refused.returncode == 2 and wanted in refused.stderr
