"""The renamings of a model's parameters that keep all its transfer functions: a group.

Candidates come from colour refinement (see `algebra.colouring`), among which all of them are; each
is proven as an identity of polynomials.
"""

from collections.abc import Iterable, Sequence
from functools import partial
from itertools import islice

from disting.algebra.certainty import prime
from disting.algebra.colouring import renamings
from disting.decide.identifiability.parts import Renaming
from disting.general.any_model import is_renamed
from disting.general.matrix_model import AnyModel
from disting.general.network_model import behaviour_of

MOST = 720  # renamings: six equal branches
Permutation = tuple[int, ...]
"""For the value at each position the position that it is moved to."""


def symmetries_of(model: AnyModel) -> list[Permutation]:
    """All permutations of the parameters that keep the response, the identity first; the first
    `MOST` of them if there are more.

    >>> from disting.general.matrix_model import Model
    >>> symmetries_of(Model.from_transfer_function("c", "(s + a)*(s + b)"))
    [(0, 1, 2), (1, 0, 2)]
    """
    names = model.parameters
    columns = partial(behaviour_of(model).columns, modulus=prime("renaming"))
    candidates = islice(renamings(columns, columns, len(names)), MOST)
    kept = [
        images
        for images in candidates
        if is_renamed(model, model, {names[i]: names[j] for i, j in enumerate(images)})
    ]
    identity = tuple(range(len(names)))
    return [identity, *sorted(images for images in kept if images != identity)]


def generators_of(group: Sequence[Permutation]) -> list[Permutation]:
    """Few permutations that generate a group, those that move least first.

    >>> generators_of([(0, 1, 2), (1, 0, 2), (0, 2, 1), (2, 1, 0), (1, 2, 0), (2, 0, 1)])
    [(0, 2, 1), (1, 0, 2)]
    """
    chosen, reached = list[Permutation](), {group[0]}
    for images in sorted(group, key=lambda g: (sum(i != j for i, j in enumerate(g)), g)):
        if images not in reached:
            chosen.append(images)
            reached = _closure(group[0], chosen)
    return chosen


def exchange_of(images: Permutation, names: Sequence[str]) -> Renaming:
    """A permutation as a renaming of the parameters that it moves."""
    moved = ((names[i], names[j]) for i, j in enumerate(images) if i != j)
    return Renaming(tuple(moved), ())


def _closure(identity: Permutation, chosen: Iterable[Permutation]) -> set[Permutation]:
    reached, new = {identity}, [identity]
    while new:
        new = [n for g in new for c in chosen if (n := tuple(c[i] for i in g)) not in reached]
        reached.update(new)
    return reached
