"""All equivalents of an undamped model by Newton's method from random complex starts: no
theory, floating point only.
"""

import numpy as np

STARTS, STEPS = 300, 40


def responses(chain, q, at):
    """H at each x = s^2, shape (s, x), and its derivatives by the parameters q, shape (s, p),
    from dense matrices.
    """
    n, names = chain.n_masses, chain.parameters
    vectors = np.zeros((len(names), n + 1))
    for row, name in zip(vectors, names, strict=True):
        ends = (int(name[1:]), 0) if name[0] == "m" else (int(name[1]), int(name[2]))
        row[ends[0]], row[ends[1]] = 1.0, -1.0
    vectors, ports = vectors[:, 1:], np.zeros((2, n + 1))
    for row, plus, minus in (
        (0, chain.act_plus, chain.act_minus),
        (1, chain.meas_plus, chain.meas_minus),
    ):
        ports[row, plus] += 1.0
        ports[row, minus] -= 1.0
    powers = np.array([at if name[0] == "m" else np.ones(len(at)) for name in names])
    a = np.einsum("sp,px,pi,pj->sxij", q, powers, vectors, vectors)
    moved = np.linalg.solve(a, np.broadcast_to(ports[:, 1:].T, (*a.shape[:2], n, 2)))
    seen = np.einsum("pi,sxik->sxpk", vectors, moved)
    return moved[..., 0] @ ports[1, 1:], -seen[..., 0] * seen[..., 1] * powers.T


def solutions(given, point, other, count):
    """Up to `count` distinct parameter vectors of `other` with the receptance of `given` at
    this point.
    """
    source, size = np.random.default_rng(0), len(other.parameters)
    at = np.exp(2j * np.pi * (np.arange(size) + 0.3) / size) * 1.3
    wanted = responses(
        given, np.array([[point[name] for name in given.parameters]], dtype=complex), at
    )[0][0]
    found = []
    for _ in range(20):
        q = np.exp(
            1.2 * source.normal(size=(STARTS, size)) + 2j * np.pi * source.random((STARTS, size))
        )
        for p in _newton(other, q, at, wanted):
            if all(np.abs(p / known - 1).max() > 1e-5 for known in found):
                found.append(p)
        if len(found) >= count:
            break
    return found


def _newton(other, q, at, wanted):
    for _ in range(STEPS):
        h, slopes = responses(other, q, at)
        step = np.linalg.solve(slopes + 1e-14 * np.eye(len(at)), (h - wanted)[..., None])[..., 0]
        largest = np.abs(step).max(axis=1) / np.abs(q).max(axis=1)
        q = q - step * np.minimum(1.0, 2.0 / np.maximum(largest, 1e-300))[:, None]
        good = np.isfinite(q).all(axis=1)
        good[good] &= (np.abs(q[good]).max(axis=1) < 1e7) & (np.abs(q[good]).min(axis=1) > 1e-7)
        q, last = q[good], np.abs(step[good] / q[good]).max(axis=1)
        if not len(q):
            break
    return q[last < 1e-10] if len(q) else q


def is_real(q):
    """Whether all imaginary parts are rounding."""
    return np.abs(q.imag / q).max() < 1e-7
