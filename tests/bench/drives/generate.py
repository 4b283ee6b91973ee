"""Simulate the drives of the bench: data/KIND-NN-{A,B}.csv and drives.json (the truth).

Usage: python generate.py [KIND ...]   (default: all kinds; what exists is written again)
"""

import ctypes as C  # noqa: N812
import json
import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
DATA = HERE / "data"
FS, NSUB = 8000.0, 6
LSB = 2 * np.pi / 2**20
COUNT = {
    "hold": 16,
    "trend": 16,
    "coulomb": 15,
    "backlash": 15,
    "base": 16,
    "branch": 14,
    "loop": 14,
    "loopref": 14,
}
KINDS = list(COUNT)
STRENGTH = ("weak", "medium", "strong")
LINES = 90


class Drive(C.Structure):
    _fields_ = (
        [(n, C.c_int) for n in ("nb", "nc", "fi", "fj", "nsub", "hold", "closed")]
        + [("ci", C.c_int * 16), ("cj", C.c_int * 16), ("J", C.c_double * 8)]
        + [(n, C.c_double * 16) for n in ("k", "d", "gap")]
        + [
            (n, C.c_double)
            for n in ("tc", "vs", "fs", "lsb", "t0", "ramp", "kp", "ki", "filt", "wref")
        ]
    )


D = C.POINTER(C.c_double)


@cache
def library():
    """The simulator, compiled."""
    made = HERE / "sim.so"
    source = str(HERE / "sim.c")
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-o", str(made), source, "-lm"], check=True)
    loaded = C.CDLL(str(made))
    loaded.simulate.argtypes = [C.POINTER(Drive), D, C.c_long, C.c_long, D, D, D, D, D]
    return loaded


def ptr(a):
    return a.ctypes.data_as(D)


def modes(J, couplings):
    """Undamped natural frequencies [Hz] and the share of mass 1 in each mode."""
    n = len(J)
    K = np.zeros((n, n))
    for i, j, k, *_ in couplings:
        K[i, i] += k
        if j >= 0:
            K[j, j] += k
            K[i, j] -= k
            K[j, i] -= k
    s = 1 / np.sqrt(np.asarray(J))
    w2, V = np.linalg.eigh(s[:, None] * K * s[None, :])
    return np.sqrt(np.abs(w2)) / (2 * np.pi), V


def slowest(J, couplings):
    """Longest time constant [s] of a motion that decays; rigid motion without friction does not."""
    n = len(J)
    K, D = np.zeros((2, n, n))
    for i, j, k, d, _ in couplings:
        for M, x in ((K, k), (D, d)):
            M[i, i] += x
            if j >= 0:
                M[j, j] += x
                M[i, j] -= x
                M[j, i] -= x
    m = np.asarray(J)[:, None]
    poles = np.linalg.eigvals(np.block([[np.zeros((n, n)), np.eye(n)], [-K / m, -D / m]]))
    slow = poles.real[poles.real < -1e-2]
    return float(1 / abs(slow).min()) if len(slow) else 0.5


def chain(rng, n, low=20.0, high=300.0):
    """Inertias and couplings (i, j, k, d) of a random chain with resonances low..high Hz."""
    while True:
        J = 10 ** rng.uniform(-4, -2) * np.concatenate([[1], 10 ** rng.uniform(-0.6, 0.6, n - 1)])
        if J.min() < 1e-4 or J.max() > 1e-2:
            continue
        f = 10 ** rng.uniform(np.log10(low), np.log10(high), n - 1)
        k = [(2 * np.pi * f[i]) ** 2 * J[i] * J[i + 1] / (J[i] + J[i + 1]) for i in range(n - 1)]
        cs = [(i, i + 1, k[i]) for i in range(n - 1)]
        hz, V = modes(J, cs)
        hz, share = hz[1:], V[0, 1:] ** 2
        if hz.min() < low or hz.max() > high or share.min() < 0.03 or share.max() > 0.97:
            continue
        if n > 2 and (hz[1:] / hz[:-1]).min() < 1.3:
            continue
        return J, [(i, j, k, damper(rng, k, f[i])) for i, j, k in cs]


def damper(rng, k, hertz):
    zeta = 10 ** rng.uniform(np.log10(0.003), np.log10(0.03))
    return 2 * zeta * k / (2 * np.pi * hertz)


def lines(rng, style):
    """Odd ones with gaps for the detection of distortion, or all below 50 Hz."""
    if style == "odd":
        every = np.arange(3, 500, 2)
        low = every[every < 50]
        low = low[rng.random(len(low)) > 0.2]
    else:
        every = np.arange(3, 501)
        low = every[every < 46]
    rest = every[every > low.max()]
    want = np.geomspace(low.max() + 2, 500, LINES - len(low))
    high = np.unique([rest[np.argmin(abs(rest - w))] for w in want])
    return np.unique(np.concatenate([low, high]))


def size(kind, i):
    """Masses of the chain: three in one drive of three; of a base too in one of four, of a branch never."""
    if kind == "branch":
        return 2
    if kind == "base":
        return 3 if i % 8 in (3, 4) else 2
    return 3 if i % 4 == 3 or i % 6 == 2 else 2


def make(kind, i):
    """The truth of one drive as plain data."""
    rng = np.random.default_rng([KINDS.index(kind), i, 2811])
    n = size(kind, i)
    g = {"kind": kind, "drive": i, "name": f"{kind}-{i:02d}", "n": n, "strength": "", "bearing": ""}
    J, cs = chain(rng, n)
    total = float(J.sum())
    b = (
        0.0
        if (rng.random() < 0.2 and kind not in ("trend", "base", "branch", "loop"))
        else total * 10 ** rng.uniform(np.log10(0.5), np.log10(6))
    )
    truth = {f"m{p + 1}": float(m) for p, m in enumerate(J)}
    for p, (_, _, k, d) in enumerate(cs):
        truth[f"k{p + 1}{p + 2}"], truth[f"d{p + 1}{p + 2}"] = float(k), float(d)
    if b:
        truth["b1"] = float(b)
    g["structure"] = f"{n}:1" + ("+b1" if b else "")
    bodies, couplings, ports = (
        list(map(float, J)),
        [(a, c, float(k), float(d), 0.0) for a, c, k, d in cs],
        (0, -1),
    )
    g["lines"] = "odd" if rng.random() < 0.6 else "low"
    g["periods"] = (
        int(rng.choice([2, 3, 4])) if not kind.startswith("loop") else int(rng.choice([3, 4, 5]))
    )
    accel = rng.uniform(10, 50)  # of the whole inertia, amplitude of one line
    g["amplitude"] = total * accel
    noise, share = rng.uniform(0.01, 0.02), float(rng.random() < 0.35)  # of the disturbance
    hold = kind in ("hold", "loop", "loopref")
    g["noise"] = (
        "disturbance" if share else "measurement"
    )  # a disturbance makes an open loop wander
    g["disturbance"], g["measurement"] = noise * share, noise * (1 - share)
    g["speed"] = g["ramp"] = 0.0
    g["coulomb"] = 0.0
    rms = g["amplitude"] * np.sqrt(LINES / 2)
    ground = [(0, -1, 0.0, float(b), 0.0)] if b else []
    if kind == "trend":
        g["speed"] = float(rng.uniform(1, 20))
        g["ramp"] = (
            float(rng.choice([-1, 1]) * 10 ** rng.uniform(-3, -1.7) * g["speed"]) / g["periods"]
        )  # rad/s per s
    if kind == "coulomb":
        g["strength"] = STRENGTH[i % 3]
        g["coulomb"] = float((0.03, 0.1, 0.3)[i % 3] * rms * rng.uniform(0.8, 1.25))
    if kind == "backlash":
        g["strength"] = STRENGTH[i % 3]
        gap = float((0.3e-3, 1e-3, 3e-3)[i % 3] * rng.uniform(0.8, 1.25))
        couplings[0] = (*couplings[0][:4], gap)
        g["gap"] = gap
    if kind == "base":
        housing = float(bodies[0] * rng.uniform(3, 20))
        hz = float(rng.uniform(15, 80))
        k0 = (2 * np.pi * hz) ** 2 * housing
        d0 = damper(rng, k0, hz)
        couplings += [(n, -1, float(k0), float(d0), 0.0)]
        bodies.append(housing)
        ports = (0, n)
        g["bearing"] = "bearing" if i % 4 >= 2 else "none"
        ground = [(0, n, 0.0, float(b), 0.0)] if g["bearing"] == "bearing" else []
        truth = {"m1": housing, "k01": float(k0), "d01": float(d0)}
        truth |= {f"m{p + 2}": float(m) for p, m in enumerate(J)}
        for p, (_, _, k, d) in enumerate(cs):
            truth[f"k{p + 2}{p + 3}"], truth[f"d{p + 2}{p + 3}"] = float(k), float(d)
        if ground:
            truth["d12"] = float(b)
        g["structure"] = "base"
        g["base_hz"] = hz
    if kind == "branch":
        at = 0 if i % 2 == 0 else 1
        while True:
            J, cs = chain(rng, n)
            extra = float(J[at] * 10 ** rng.uniform(-0.5, 0.5))
            f = 10 ** rng.uniform(np.log10(20), np.log10(300))
            k = (2 * np.pi * f) ** 2 * extra * J[at] / (extra + J[at])
            hz, V = modes([*J, extra], [*cs, (at, n, k)])
            hz, sh = hz[1:], V[0, 1:] ** 2
            if (
                hz.min() >= 20
                and hz.max() <= 300
                and (hz[1:] / hz[:-1]).min() > 1.25
                and sh.min() > 0.02
                and 1e-4 < extra < 1e-2
            ):
                break
        total = float(J.sum() + extra)
        b = total * 10 ** rng.uniform(np.log10(0.5), np.log10(6))
        g["amplitude"] = total * accel
        bodies = [*map(float, J), extra]
        couplings = [(a, c, float(kk), float(d), 0.0) for a, c, kk, d in cs] + [
            (at, n, float(k), float(damper(rng, k, f)), 0.0)
        ]
        ground = [(0, -1, 0.0, float(b), 0.0)]
        g["structure"] = f"branch at mass {at + 1}"
        g["n"] = n + 1
        truth = {}
    g["truth_delay"] = 1 / FS if hold else 0.0
    if hold:
        g["structure"] += "+delay"
        truth["Td"] = 1 / FS
    g["hold"] = hold
    if kind.startswith("loop"):
        g["bandwidth"] = float(10 ** rng.uniform(np.log10(5), np.log10(40)))
        g["speed"] = float(rng.choice([0, 1]) * rng.uniform(1, 20))
        g["noise"], g["disturbance"], g["measurement"] = "disturbance", 0.02, 0.0
    hz, _ = modes(bodies, couplings)
    g.update(
        bodies=bodies,
        couplings=couplings + ground,
        ports=ports,
        truth=truth,
        total=total,
        b=b,
        resonances=[float(x) for x in hz if x > 1e-3],
    )
    return g


def record(g, which):
    """Time series (t, torque, angle, excitation) of one record."""
    rng = np.random.default_rng([KINDS.index(g["kind"]), g["drive"], 77, which])
    P = int(FS)
    at = lines(np.random.default_rng([KINDS.index(g["kind"]), g["drive"], 5]), g["lines"])
    phase = rng.uniform(0, 2 * np.pi, len(at))
    over = 1 if g["hold"] else 2 * NSUB
    X = np.zeros(P * over // 2 + 1, complex)
    X[at] = g["amplitude"] * np.exp(1j * phase) * P * over / 2
    table = np.fft.irfft(X, P * over)
    rms = g["amplitude"] * np.sqrt(len(at) / 2)
    tau = slowest(g["bodies"], g["couplings"])
    warm = int(np.ceil(min(25, max(5, 8 * tau))))
    N = (warm + g["periods"]) * P
    p = Drive()
    p.nb, p.nc, (p.fi, p.fj), p.nsub = len(g["bodies"]), len(g["couplings"]), g["ports"], NSUB
    p.hold, p.fs, p.lsb = g["hold"], FS, LSB
    for i, J in enumerate(g["bodies"]):
        p.J[i] = J
    for c, (i, j, k, d, gap) in enumerate(g["couplings"]):
        p.ci[c], p.cj[c], p.k[c], p.d[c], p.gap[c] = i, j, k, d, gap
    p.tc, p.vs = g["coulomb"], 0.01
    speed = g["speed"]
    if not g["kind"].startswith("loop"):
        p.t0 = g["b"] * speed - g["b"] * g["ramp"] * warm if speed else 0.0
        p.ramp = g["b"] * g["ramp"]
    bandwidth = g.get("bandwidth", 0)
    if bandwidth:
        p.closed, p.wref = 1, speed
        p.kp = 2 * np.pi * bandwidth * g["total"]
        p.ki = p.kp * 2 * np.pi * bandwidth / 5
        p.filt = 1 - np.exp(-2 * np.pi * 400 / FS)
    x = np.zeros(2 * p.nb)
    if speed:
        x[p.nb :] = speed
    disturbance = g["disturbance"] * rms * rng.standard_normal(N)
    angle, command, excitation = np.zeros(N), np.zeros(N), np.zeros(N)
    away = library().simulate(
        p, ptr(table), P, N, ptr(disturbance), ptr(x), ptr(angle), ptr(command), ptr(excitation)
    )
    last = slice(warm * P, N)
    u, y, e = command[last], angle[last], excitation[last]
    wild = away or (bandwidth and u.std() > 6 * rms)
    u = u + g["measurement"] * rms * rng.standard_normal(len(u))
    return wild, u, y - y[0], e, warm


def write(g):
    for which, letter in enumerate("AB"):
        wild, u, y, e, _ = record(g, which)
        while wild:  # the loop is not stable with this bandwidth
            g["bandwidth"] /= 2
            assert g["bandwidth"] > 0.5, g["name"]
            wild, u, y, e, _ = record(g, which)
        t = np.arange(len(u)) / FS
        columns = [t, u, y] + ([e] if g["kind"] == "loopref" else [])
        head = "time [s],torque [Nm],angle [rad]" + (
            ",excitation [Nm]" if g["kind"] == "loopref" else ""
        )
        fmt = ["%.6f", "%.7g", "%.8f"] + (["%.7g"] if g["kind"] == "loopref" else [])
        np.savetxt(
            DATA / f"{g['name']}-{letter}.csv",
            np.column_stack(columns),
            delimiter=",",
            header=head,
            comments="",
            fmt=fmt,
        )


def main():
    DATA.mkdir(exist_ok=True)
    truth = {}
    path = HERE / "drives.json"
    if path.exists():
        truth = json.loads(path.read_text())
    for kind in sys.argv[1:] or KINDS:
        for i in range(COUNT[kind]):
            g = make(kind, i)
            write(g)
            truth[g["name"]] = g
            print(
                g["name"],
                g["structure"],
                [round(x, 1) for x in g["resonances"]],
                g["periods"],
                g.get("bandwidth", ""),
                flush=True,
            )
        path.write_text(json.dumps(truth, indent=1))


if __name__ == "__main__":
    main()
