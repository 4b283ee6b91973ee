"""What is asked of general models of either kind: with one input and output, or with several."""

from dataclasses import replace

from disting.algebra.sampling import Size, enough, prime
from disting.behaviour.profile import Profile
from disting.behaviour.sample import Representation, Sample
from disting.conditions.finding import Finding
from disting.fibres.ideals import StackedMap, decide_matched
from disting.general.exact import LIMITS, exact_finding
from disting.general.matrix_model import AnyModel, MatrixModel
from disting.general.matrix_profiles import (
    Constants,
    matrix_constants,
    matrix_maps,
    matrix_products,
    matrix_profile,
    matrix_samples,
    stacked_size,
)
from disting.general.model import Model
from disting.general.profiles import profile, proven_constants
from disting.general.renaming import is_renaming, products
from disting.general.samples import minor_size, samples
from disting.model.chain import Chain
from disting.model.settings import Settings
from disting.questions.same.exact import decided


def as_chain(model: Chain | AnyModel) -> Chain | None:
    """The chain that it is, if it is one."""
    if isinstance(model, Chain):
        return model
    return model.chain if isinstance(model, Model) else None


def unnamed(model: AnyModel, name: str = "model") -> AnyModel:
    """The transfer functions alone, whatever they are called and however they were made."""
    return replace(model, name=name)


def profile_of(
    model: AnyModel, representation: Representation, count: int, settings: Settings
) -> Profile:
    """Its profile."""
    if isinstance(model, MatrixModel):
        return matrix_profile(model, representation, count, settings)
    return profile(model, representation, count, settings)


def constants_of(model: AnyModel) -> Constants:
    """Coefficients that are proven constant, by their labels."""
    if isinstance(model, MatrixModel):
        return matrix_constants(model, Representation.TF, 0)
    return proven_constants(model, Representation.TF, 0)


def samples_of(model: AnyModel, settings: Settings) -> tuple[list[Sample], Size]:
    """Coefficients and their Jacobian at so many independent points as a bound needs, and the size
    of the Jacobian's minors.
    """
    if isinstance(model, MatrixModel):
        size = stacked_size(model, Representation.TF, 0)
        points = enough(size, settings.points)
        return list(matrix_samples(model, Representation.TF, 0, points, settings.seed)), size
    size = minor_size(model, Representation.TF, 0)
    points = enough(size, settings.points)
    return list(samples(model, Representation.TF, 0, points, settings.seed)), size


def map_of(model: AnyModel) -> StackedMap:
    """The polynomial map of its coefficients, for its fibre in itself, in p1, p2, .."""
    if isinstance(model, Model):
        model = MatrixModel(model.parameters, ((model,),))
    (found,) = matrix_maps(model)
    return found


def columns_of(model: AnyModel, point: list[int]) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
    """Functions in which a renaming of the parameters is seen, and their Jacobian columns, modulo
    one and the same prime.
    """
    seen = matrix_products if isinstance(model, MatrixModel) else products
    return seen(model, point, prime("renaming"))  # type: ignore[arg-type]


def is_renamed(left: AnyModel, right: AnyModel, renaming: dict[str, str]) -> bool:
    """Whether renaming the left parameters turns all left transfer functions into the right ones:
    exact.
    """
    if isinstance(left, MatrixModel) and isinstance(right, MatrixModel):
        pairs = list(zip(left.cells, right.cells, strict=left.shape == right.shape))
        return left.shape == right.shape and all(
            a is b is None or (a and b and is_renaming(a, b, renaming)) for a, b in pairs
        )
    if isinstance(left, MatrixModel) or isinstance(right, MatrixModel):
        return False
    return is_renaming(left, right, renaming)


def same(left: AnyModel, right: AnyModel, settings: Settings) -> Finding:
    """The exact decision, for equal ranks and degrees."""
    if isinstance(left, MatrixModel) and isinstance(right, MatrixModel):
        maps = matrix_maps(left, right)
        return decided(decide_matched(*maps, equal_rank=True, seed=settings.seed, limits=LIMITS))
    assert isinstance(left, Model) and isinstance(right, Model)
    return exact_finding(left, right, settings.seed)
