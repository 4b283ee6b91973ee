"""All choices that steer a computation, made once into one frozen value and passed down."""

from dataclasses import asdict, dataclass


@dataclass(frozen=True, slots=True)
class Settings:
    """`seed` names the random points, `points` counts the independent ones behind every rank
    (error bounds multiply; more are taken where the least accepted bound needs them),
    `subset_limit` bounds the subsets of rows that a matroid search may visit (about 10 ns each).
    """

    seed: str = "disting"
    points: int = 3
    subset_limit: int = 30_000_000

    def to_dict(self) -> dict[str, object]:
        """Plain data for keys and provenance."""
        return asdict(self)
