"""Table a run of the bench: python table.py OUT.jsonl [--against OTHER.jsonl] [--worst N] [--list KIND] [--first]

--against: only the runs that both files have, both tabled. --first: only drives 1,2,3,4,6 of each kind.
"""

import argparse
import json
import re
import shlex
from collections import defaultdict
from pathlib import Path

HERE = Path(__file__).parent
FS = 8000.0
NAMED = {
    "hold": r"--hold|zero-order hold|\bheld\b|hold of",
    "trend": r"trend|constant speed|speed from|drift|removed from",
    "coulomb": r"friction|not linear|nonlinear|non-linear|distortion|backlash|changed between",
    "backlash": r"backlash|\bplay\b|not linear|nonlinear|non-linear|distortion|changed between",
    "base": r"\bbase\b|housing",
    "branch": r"branch|\btree\b",
    "loop": r"closed loop|feedback|controller",
    "loopref": r"closed loop|feedback|controller",
}
# what is said in any case, or is the friction of the model, names nothing
STANDING = re.compile(
    r"machines outside them, such as a branch or an elastic base, are not excluded|no branch of as many masses and no base is proven[^\n]*"
    r"|friction at (the )?(motor|load|mass \d+) \(b\d\)|\(zero-order hold\), as models are compared|distortion below 0\.01 %"
    r"|an elastic base \(force and encoder between base and motor\) has other responses[^\n]*|look-alikes[^\n]*not looked for[^\n]*"
    r"|(?<= or )(mass \d|the load) \(b\d\)|conclusions that hold.*|conclusions, .*|disting report.*|friction at the motor|bearing friction"
)
CRY = re.compile(
    r"probably friction|not linear|nonlinear|distortion (?!below)[\d.]+ %"
)  # an alarm where the drive is linear


def plain(text, g):
    """Without standing sentences and the names of files, which name the kind."""
    return STANDING.sub("", text.replace(g["name"], "file"))


def answer(row):
    fit = row["fit"]
    if fit and fit.get("answer"):
        return fit["answer"]
    return [x for x in row["stdout"].splitlines() if re.match("(data|structure|next): ", x)][:3]


def structure(e):
    """Of an entry of the JSON: size, gap, parameters without delay and lag; delay; lag."""
    names = set(e["parameters"]) if e.get("parameters") else set()
    ground = tuple(x for x in sorted(names) if x[0] == "b")
    return (
        e["n_masses"],
        e.get("gap", 0),
        ground or tuple(f"b{b}" for b in e.get("ground_dampers", ())),
        bool(e["delay"]),
        bool(e["lag"]),
    )


def with_truth(g):
    """A load behind the load is no branch: the drive is a chain of three masses."""
    if g["structure"] != "branch at mass 2":
        return g
    truth = {f"m{i}": m for i, m in enumerate(g["bodies"], 1)} | {"b1": g["b"]}
    for i, j, k, d, _ in g["couplings"]:
        if j >= 0:
            truth |= {f"k{i + 1}{j + 1}": k, f"d{i + 1}{j + 1}": d}
    return g | {"truth": truth}


def true_structure(g):
    if g["structure"] == "branch at mass 1":
        return None
    if g["kind"] == "base":
        return g["n"] + 1, 1, (), False, False
    return g["n"], 0, ("b1",) if "b1" in g["truth"] else (), "delay" in g["structure"], False


def named(name):
    m = re.match(r"(\d+):1((?:\+b\d)*)((?:\+lag|\+delay)*)$", name)
    return m and (int(m[1]), 0, tuple(re.findall(r"b\d", m[2])), "delay" in m[3], "lag" in m[3])


def is_true(e, g):
    """An entry with the elements of the truth; a base with friction in its bearing has one that others have not."""
    want = true_structure(g)
    if want is None or structure(e)[:3] != want[:3]:
        return False
    if g["kind"] != "base":
        return True
    have = {x for x in e["parameters"] if x not in ("T1", "Td")}
    return have == set(g["truth"]) or (
        len(have) == len(g["truth"]) and bool(g["bearing"] == "bearing")
    )


def kept(fit, g):
    """(exactly, counting lag and dead time)"""
    want = true_structure(g)
    if want is None or not fit:
        return None, None
    exact = loose = False
    for e in fit["not_excluded"] or ():
        if is_true(e, g):
            loose = True
            exact |= structure(e)[3:] == want[3:]
        for other in e.get("equivalents") or ():
            s = named(other if isinstance(other, str) else other.get("name", ""))
            if s and s[:3] == want[:3]:
                loose = True
                exact |= s[3:] == want[3:]
    return exact, loose


def values(row, g, held):
    """(name, true, estimate, low, high) of the selected structure where it has the masses of the truth."""
    fit = row["fit"]
    if not fit or not fit["selected"] or true_structure(g) is None:
        return
    s, want = fit["selected"], true_structure(g)
    if structure(s)[:2] != want[:2]:
        return
    e = next((e for e in fit["not_excluded"] or () if e["name"] == s["name"]), None)
    for name, interval in ((e or {}).get("intervals") or {}).items():
        if not interval or interval[0] is None or interval[1] is None:
            continue
        estimate = e["parameters"].get(name)
        if estimate is None:
            continue
        true = g["truth"].get(name, 0.0)
        if name == "Td" and not held and g["hold"]:
            true = 1.5 / FS
        yield name, true, estimate, *interval


def sigmas(true, estimate, low, high):
    half = max(high - estimate if true > estimate else estimate - low, 1e-300)
    return 2 * abs(true - estimate) / half


def judge(row, g):
    fit = row["fit"]
    held = "--hold" in row["words"]
    text = "\n".join(answer(row))
    every = row["stdout"] + "\n" + row["stderr"]
    new = bool(text)
    pattern = re.compile(NAMED[g["kind"]])
    said3 = bool(pattern.search(plain(text, g)))
    said = bool(pattern.search(plain(every, g)))
    checked = [
        (n, t, e, sigmas(t, e, lo, hi), lo <= t <= hi or (t == 0 and lo <= 1e-3 * abs(e)))
        for n, t, e, lo, hi in values(row, g, held)
    ]
    exact, loose = kept(fit, g)
    sel = fit and fit["selected"]
    want = true_structure(g)
    right = bool(
        sel
        and want
        and any(
            is_true(e, g) and structure(e)[3:] == want[3:]
            for e in fit["not_excluded"] or ()
            if e["name"] == sel["name"]
        )
    )
    explained = bool(fit and fit["explained"])
    beyond = [c for c in checked if c[3] > 3]
    lost = exact is False and not loose
    silent = (
        explained
        and not (said3 if new else said)
        and (bool(beyond) or lost or want is None or (g["kind"] == "base" and not loose))
    )
    return {
        "explained": explained,
        "kept": exact,
        "loose": loose,
        "right": right,
        "checked": checked,
        "inside": sum(c[4] for c in checked),
        "n": len(checked),
        "beyond": beyond,
        "said3": said3 if new else None,
        "said": said,
        "silent": silent,
        "cry": bool(CRY.search(plain(text if new else every, g))),
        "failed": fit is None,
        "cpu": row["cpu"],
        "size": len(fit["not_excluded"] or ()) if fit else 0,
    }


def load(path):
    return {(r["drive"], r["run"]): r for r in map(json.loads, open(path))}


def table(rows, drives, title):
    print(f"\n{title}")
    print(
        f"{'kind':<9} {'run':<10} {'runs':>4} {'expl':>4} {'kept':>5} {'+lag':>5} {'sel':>4} {'in 2s':>9} {'%':>4} {'>3s':>4} {'said3':>5} {'said':>5} {'cry':>4} {'silent':>6} {'fail':>4} {'cpu':>5}"
    )
    groups = defaultdict(list)
    for (name, run), r in rows.items():
        g = drives[name]
        extra = g["strength"] or g["bearing"]
        j = judge(r, g)
        groups[g["kind"], run].append(j)
        if extra:
            groups[g["kind"], f"{run}:{extra}"].append(j)
        if g["kind"] not in ("coulomb", "backlash"):
            groups[g["kind"], f"{run}:{g['noise'][:4]}"].append(j) if g["kind"] in (
                "hold",
                "trend",
            ) else None
    order = list(dict.fromkeys(g["kind"] for g in drives.values()))
    for (kind, run), js in sorted(
        groups.items(), key=lambda kv: (order.index(kv[0][0]), kv[0][1].split(":")[0], kv[0][1])
    ):
        n, inside = sum(j["n"] for j in js), sum(j["inside"] for j in js)

        def c(key, js=js):
            return "-" if all(j[key] is None for j in js) else sum(bool(j[key]) for j in js)

        label = "  :" + run.split(":")[1] if ":" in run else run
        print(
            f"{kind if ':' not in run else '':<9} {label:<10} {len(js):>4} {c('explained'):>4} {c('kept'):>5} {c('loose'):>5} {c('right'):>4} {f'{inside}/{n}':>9} {100 * inside / n if n else float('nan'):>4.0f} {sum(len(j['beyond']) for j in js):>4} {c('said3'):>5} {c('said'):>5} {c('cry'):>4} {c('silent'):>6} {c('failed'):>4} {sum(j['cpu'] for j in js) / len(js):>5.1f}"
        )
    print(
        "total CPU", round(sum(r["cpu"] for r in rows.values()) / 60, 1), "min,", len(rows), "runs"
    )


def command(r):
    return "python -m disting fit " + shlex.join(r["words"])


def worst(rows, drives, count):
    bad = []
    for _key, r in rows.items():
        g = drives[r["drive"]]
        j = judge(r, g)
        told = j["said3"] if j["said3"] is not None else j["said"]
        top = max(j["checked"], key=lambda c: c[3], default=None) if j["explained"] else None
        score = (
            (j["failed"] * 1000)
            + (100 if j["silent"] else 0)
            + (
                50
                if j["explained"]
                and j["loose"] is False
                and j["kept"] is not None
                and g["kind"] in ("hold", "trend", "loop", "loopref")
                else 0
            )
            + (
                60
                if not j["explained"] and g["kind"] in ("hold", "trend", "loop", "loopref")
                else 0
            )
            + (min(top[3], 40) if top else 0)
        )
        bad.append((score, r, g, j, top, told))
    for _score, r, g, j, _top, told in sorted(bad, key=lambda b: -b[0])[:count]:
        sel = r["fit"]["selected"]["name"] if r["fit"] and r["fit"]["selected"] else None
        print(
            f"\n{r['drive']} {r['run']} ({g['strength'] or g['bearing'] or g['noise']}, {g['periods']} periods): truth {g['structure']}, selected {sel}, explained {j['explained']} chi2 {r['fit'] and r['fit']['chi2_per_line']}, kept {j['kept']}/{j['loose']}, named {told}, silent {j['silent']}, cry {j['cry']}"
        )
        for c in sorted(j["checked"], key=lambda c: -c[3])[:3]:
            if c[3] > 3:
                print(
                    f"   {c[0]}: true {c[1]:.5g}, fitted {c[2]:.5g}, {c[3]:.1f} sigma"
                    + (f", {100 * (c[2] / c[1] - 1):+.1f} %" if c[1] else "")
                )
        for a in answer(r)[:2]:
            print("   " + a[:420])
        if j["failed"]:
            print("   " + r["stderr"][-300:])
        print("   " + command(r))


def main():
    p = argparse.ArgumentParser()
    p.add_argument("out")
    p.add_argument("--against")
    p.add_argument("--worst", type=int, default=0)
    p.add_argument("--list", default="")
    p.add_argument("--first", action="store_true")
    o = p.parse_args()
    drives = {
        name: with_truth(g) for name, g in json.loads((HERE / "drives.json").read_text()).items()
    }
    rows = load(o.out)
    if o.first:
        rows = {k: r for k, r in rows.items() if drives[k[0]]["drive"] in (1, 2, 3, 4, 6)}
    other = load(o.against) if o.against else {}
    if other:
        {("ab" if k[1] == "ab-base" else k[1]) for k in rows}
        both = set(rows) & set(other)
        table({k: other[k] for k in other if k in both}, drives, o.against)
        rows = {
            k: r
            for k, r in rows.items()
            if k in both or (k[1].endswith(("base", "nohold")) and (k[0], "one") in both)
        }
    table(rows, drives, o.out)
    if o.list == "all":
        o.list = ""
        listed = True
    else:
        listed = bool(o.list)
    if listed:
        for (name, run), r in rows.items():
            if name.startswith(o.list):
                g, j = drives[name], judge(r, drives[name])
                sel = r["fit"]["selected"]["name"] if r["fit"] and r["fit"]["selected"] else None
                print(
                    f"{name} {run} n{g['n']} {g['periods']}p {g['noise'][:4]} {g['strength'] or g['bearing']} truth {g['structure']} -> {sel} chi2 {(r['fit'] and r['fit']['chi2_per_line']) or 0:.3g} expl {j['explained']:d} kept {j['kept']}/{j['loose']} {j['inside']}/{j['n']} beyond {[(c[0], round(c[3], 1)) for c in j['beyond']]} said3 {j['said3']} said {j['said']} cry {j['cry']}"
                )
    if o.worst:
        worst(rows, drives, o.worst)


if __name__ == "__main__":
    main()
