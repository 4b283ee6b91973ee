"""Random chains for hypothesis: any admissible indices (also outside (38)), ground dampers,
lag, sensor.
"""

from hypothesis import strategies as st

from disting import Chain, Quantity


@st.composite
def chains(draw, min_masses=1, max_masses=4, dead_time=False):
    """A chain within (36) and (37)."""
    n = draw(st.integers(min_masses, max_masses))
    gap = draw(st.integers(0, n - 1))
    reference, mass = st.integers(1 if gap else 0, gap), st.integers(gap + 1, n)
    ports = [draw(part) for part in (reference, mass, reference, mass)]
    return Chain(
        n,
        gap,
        *ports,
        quantity=draw(st.sampled_from(Quantity)),
        damped=draw(st.booleans()),
        ground_dampers=tuple(sorted(draw(st.sets(st.integers(1, n))))),
        lag=draw(st.booleans()),
        dead_time=dead_time and draw(st.booleans()),
    )
