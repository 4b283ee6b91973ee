"""Profiles as JSON text and back: what a cache keeps. Never pickled, so that a foreign file can
do no harm.
"""

import json
from dataclasses import asdict, fields
from typing import Any

from disting.algebra.matroid import Component, Matroid
from disting.behaviour.profile import Profile, Unsearched
from disting.behaviour.sample import Representation


def profile_to_json(profile: Profile) -> str:
    """Compact JSON text of a profile."""
    data = {f.name: getattr(profile, f.name) for f in fields(profile)} | {
        "proven_zeros": sorted(profile.proven_zeros)
    }
    data["matroid"] = (
        asdict(profile.matroid)
        if isinstance(profile.matroid, Unsearched)
        else _plain(profile.matroid)
    )
    return json.dumps(data, separators=(",", ":"))


def profile_from_json(text: str) -> Profile:
    """Inverse of `profile_to_json`; raises ValueError, KeyError or TypeError for what is none."""
    data = json.loads(text)
    return Profile(
        **data
        | {
            "representation": Representation(data["representation"]),
            "labels": tuple(data["labels"]),
            "free": tuple(data["free"]),
            "constants": tuple(data["constants"]),
            "degrees": tuple(data["degrees"]),
            "matroid": _matroid(data["matroid"]),
            "proven_zeros": frozenset(data["proven_zeros"]),
        }
    )


def _plain(m: Matroid) -> dict[str, Any]:
    components = [
        {"rows": c.rows, "rank": c.rank, "dual": c.dual, "flats": c.flats} for c in m.components
    ]
    return {"size": m.size, "rank": m.rank, "components": components}


def _matroid(data: dict[str, Any]) -> Matroid | Unsearched:
    if "reason" in data:
        return Unsearched(data["reason"])
    return Matroid(data["size"], data["rank"], tuple(_component(c) for c in data["components"]))


def _component(data: dict[str, Any]) -> Component:
    flats = tuple((tuple(rows), rank) for rows, rank in data["flats"])
    return Component(tuple(data["rows"]), data["rank"], data["dual"], flats)
