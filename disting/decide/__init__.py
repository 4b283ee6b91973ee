"""Decision of a pair of models: the sequence of steps to a verdict, and the tables of deciders.

A verdict on two models goes this way, and stops at the first step that decides
(`disting.verdict.cascade`):

1. Conditions 1 to 7 on the transfer-function coefficients (`disting.conditions.table`). A necessary
   condition (1 to 5) that fails shows a difference; a sufficient one (6, 7) that holds shows that
   both models are the same.
2. Conditions 3 to 7 on the Markov parameters.
3. Conditions 8 and 9 on the structure.
4. The exact decision over complex parameters: `SAME_*` below. What it leaves is UNDECIDED.
5. Of two models of unequal rank: whether generic models of the smaller one are limits of models of
   the other (`CLOSURE_*`), or have equivalents there (`IMAGE_*`, `BOTH_*`).
6. The domain. A difference over complex parameters is one over real and positive parameters too,
   because real and positive points are Zariski dense. Models that are the same over complex
   parameters are asked about again: `REAL_*` and `POSITIVE_*`. A renaming settles both.
7. The shares: which positive models of the one have a positive equivalent in the other, always,
   sometimes or never: `SHARE_*`.

Each table is for one kind of models: chains, chains under several experiments, and networks with
all other models. Its rows are tried in order; the first finding that decides is the answer, and a
row that abandons leaves its note. The order of the rows is the only order there is. `verify` looks
up in the same rows how evidence from a file is checked.

To add a theorem: write its function, which returns a finding or None, and how its evidence is
checked; add a row here. Nothing else has to change.

    >>> print(SHARE_MEASURED.as_text())
    share of positive models with a positive equivalent, one way (chains under several experiments)
    1. one experiment alone: fibre; Theorem, Exclusion, EmptyFibre, Interlacing, OnlyOne
    2. points by lists: fibre; Points
"""

from disting.decide.decider import (
    Asked as Asked,
    Cost as Cost,
    Decider as Decider,
    Of as Of,
    Table as Table,
    check as check,
    first_finding as first_finding,
    found_at_once as found_at_once,
    function as function,
    recheck as recheck,
)
from disting.evidence.conditions import Counts
from disting.evidence.decision import (
    GEARS,
    GROUNDS,
    INTERLACING,
    ONE_PORTS,
    REPLACEMENT,
    DeadTime,
    Exclusion,
    FibreAt,
    FibreUnder,
    Theorem,
)
from disting.evidence.general import (
    AtInverse,
    Constants,
    Explicit,
    Inequality,
    NoEquivalent,
    OfPart,
    Replacement,
    Witnesses,
)
from disting.evidence.ideals import ByRows, FullRows, NoShares, Refutation, Solutions
from disting.evidence.limits import (
    FullImage,
    LargerProjection,
    Limit,
    LimitFibre,
    Meeting,
    Minor,
    MissingElements,
    Outside,
    PoleSharing,
    RelativeDegrees,
    RowsInside,
    TooLarge,
)
from disting.evidence.positive import (
    BothWays,
    EmptyFibre,
    Interlacing,
    OddFibres,
    OnlyOne,
    Points,
    RealFactors,
    RealWitnesses,
)

# packages of the functions
_SAME, _CHECK = "decide.same.exact", "decide.same.evidence_check"
_QUICK, _REAL = "decide.same.low_cost", "decide.same.real_and_positive"
_SHARE, _SHARED = "decide.positive.shares", "decide.positive.confirmation"
_UNDER, _MEASURED = "experiments.exact", "experiments.measured_evidence"
_OVER, _FORMS, _VALUES = "general.over_domain", "general.forms", "general.admissible"
_INSIDE, _CONFIRM = "decide.inclusion.decide", "decide.inclusion.confirmation"
_INSIDE_ALL = "experiments.inclusion"
_MODELS, _EVIDENCE = "general.any_model", "general.model_evidence"

# --- chains: the same over complex parameters; rows have (left, right, settings) ---

THEOREMS = Decider(
    name="symmetry, Foster's theorem, rows exchanged, duality",
    cost=Cost.CLOSED_FORM,
    decide=f"{_SAME}:by_theorem",
    yields=(Theorem,),
    check=f"{_CHECK}:check_theorem",
)
DEAD_TIME = Decider(
    name="dead time of one alone",
    cost=Cost.CLOSED_FORM,
    decide=f"{_SAME}:by_dead_time",
    yields=(DeadTime,),
    check=f"{_CHECK}:check_dead_time",
)
SYNTHESIS = Decider(
    name="one fibre by network synthesis",
    cost=Cost.FIBRE,
    applies=f"{_SAME}:are_alike",
    decide=f"{_SAME}:by_synthesis",
    yields=(FibreAt,),
    check=f"{_CHECK}:check_fibre",
)
FULL_ROWS = Decider(
    name="rows that give any receptance",
    cost=Cost.RANKS,
    applies=f"{_SAME}:are_alike",
    decide=f"{_SAME}:by_full_rows",
    yields=(FullRows,),
    check=f"{_CHECK}:check_full_rows",
)
SHARED_ROOTS = Decider(
    name="shares of the numerator's roots",
    cost=Cost.IDEALS,
    applies=f"{_SAME}:are_alike",
    decide=f"{_SAME}:by_shares",
    yields=(NoShares,),
    check=f"{_CHECK}:check_shares",
    recheck=f"{_SAME}:recheck_shares",
)
CHAIN_IDEALS = Decider(
    name="ideal of one fibre, in the parameters and in normalised ones",
    cost=Cost.IDEALS,
    applies=f"{_SAME}:are_alike",
    decide=f"{_SAME}:by_ideals",
    yields=(Solutions, Refutation),
    check=f"{_CHECK}:check_ideal",
    recheck=f"{_SAME}:recheck_labels",
)
SAME_CHAINS = Table(
    Asked.SAME,
    Of.CHAINS,
    (THEOREMS, DEAD_TIME, SYNTHESIS, FULL_ROWS, SHARED_ROOTS, CHAIN_IDEALS),
    at_once=(
        Decider(
            name="unequal ranks: condition 4 decides",
            cost=Cost.RANKS,
            decide=f"{_SAME}:refuse_unequal",
        ),
    ),
    note="Except for the theorems and the dead time, chains of one size and sensor quantity only.",
    question=f"{_SAME}:EXACTLY",
    confirms=f"{_CHECK}:of_sides",
)
SAME_CHAINS_QUICKLY = Table(
    Asked.SAME,
    Of.CHAINS,
    (
        THEOREMS,
        FULL_ROWS,
        Decider(
            name="one fibre by network synthesis, up to 60 s",
            cost=Cost.FIBRE,
            decide=f"{_QUICK}:by_synthesis_in_time",
            yields=(FibreAt,),
            check=f"{_CHECK}:check_fibre",
        ),
    ),
    note="For classes of thousands of chains, of one size and without dead time.",
)
SAME_CHAINS_PATIENTLY = Table(
    Asked.SAME,
    Of.CHAINS,
    (
        SHARED_ROOTS,
        Decider(
            name="ideal of one fibre, within small limits",
            cost=Cost.IDEALS,
            decide=f"{_QUICK}:by_small_ideals",
            yields=(Solutions, Refutation),
            check=f"{_CHECK}:check_ideal",
            recheck=f"{_SAME}:recheck_labels",
        ),
    ),
    note="For pairs of those classes that the quick table leaves open.",
)

# --- chains: real and positive parameters ---

REAL_CHAINS = Table(
    Asked.REAL,
    Of.CHAINS,
    (
        Decider(
            name="symmetry and duality, whose maps are rational",
            cost=Cost.CLOSED_FORM,
            decide=f"{_REAL}:by_rational_map",
            yields=(Theorem,),
            check=f"{_CHECK}:check_theorem",
        ),
        Decider(
            name="real factors of all degrees that are needed",
            cost=Cost.CLOSED_FORM,
            decide=f"{_REAL}:by_real_factors",
            yields=(RealFactors,),
            check=f"{_CHECK}:check_real_factors",
        ),
        Decider(
            name="real models with and without real equivalents",
            cost=Cost.SEARCH,
            decide=f"{_REAL}:by_witnesses",
            yields=(RealWitnesses,),
            check=f"{_CHECK}:check_real_witnesses",
        ),
        Decider(
            name="odd numbers of equivalents",
            cost=Cost.IDEALS,
            decide=f"{_REAL}:by_odd_fibres",
            yields=(OddFibres,),
            check=f"{_CHECK}:check_odd_fibres",
        ),
    ),
    answer=f"{_REAL}:of_sides",
    prepare=f"{_REAL}:prepare",
)
POSITIVE_CHAINS = Table(
    Asked.POSITIVE,
    Of.CHAINS,
    rows=(),
    at_once=(
        Decider(
            name="the shares of positive models, both ways",
            cost=Cost.SEARCH,
            decide="decide.asking:by_shares_both_ways",
            yields=(BothWays,),
            check=f"{_CHECK}:check_both_ways",
        ),
    ),
)
SHARE_CHAINS = Table(
    Asked.SHARE,
    Of.CHAINS,
    (
        Decider(
            name="symmetry, duality, Foster's and Cauer's theorems",
            cost=Cost.CLOSED_FORM,
            decide=f"{_SHARE}:by_theorem",
            yields=(Theorem,),
            check=f"{_SHARED}:check_theorem",
        ),
        Decider(
            name="obstacles: decay, residues, own poles, signs, exchanged rows",
            cost=Cost.CLOSED_FORM,
            applies=f"{_SHARE}:are_plain",
            decide=f"{_SHARE}:by_obstacle",
            yields=(Exclusion,),
            check=f"{_SHARED}:check_obstacle",
        ),
        Decider(
            name="order of the poles and zeros of each row",
            cost=Cost.CLOSED_FORM,
            applies=f"{_SHARE}:are_plain",
            decide=f"{_SHARE}:by_words",
            yields=(Interlacing,),
            check=f"{_SHARED}:check_words",
        ),
        Decider(
            name="rows that would have to be exchanged, at one point",
            cost=Cost.FIBRE,
            applies=f"{_SHARE}:are_plain",
            decide=f"{_SHARE}:by_swap",
            yields=(Exclusion,),
            check=f"{_SHARED}:check_obstacle",
        ),
        Decider(
            name="a point without any equivalent",
            cost=Cost.FIBRE,
            applies=f"{_SHARE}:are_plain",
            decide=f"{_SHARE}:by_empty_fibre",
            yields=(EmptyFibre,),
            check=f"{_SHARED}:check_empty_fibre",
        ),
        Decider(
            name="points with and without a positive equivalent",
            cost=Cost.SEARCH,
            applies=f"{_SHARE}:are_plain",
            decide=f"{_SHARE}:by_points",
            yields=(Points,),
            check=f"{_SHARED}:check_points",
        ),
    ),
    note="Except for the first row, chains without ground dampers and lag only.",
    question=f"{_REAL}:POSITIVELY",
    confirms=f"{_SHARED}:proves",
    is_stated=f"{_INSIDE}:are_of_one_size",
)

# --- chains under several experiments ---

SAME_MEASURED = Table(
    Asked.SAME,
    Of.MEASURED,
    (
        Decider(
            name="equivalents of one experiment put into the others",
            cost=Cost.FIBRE,
            decide="experiments.listing:by_list",
            yields=(FibreUnder,),
            check=f"{_MEASURED}:check_list",
        ),
        Decider(
            name="ideal of one fibre of all experiments",
            cost=Cost.IDEALS,
            decide=f"{_UNDER}:by_ideals",
            yields=(Solutions, Refutation),
            check=f"{_MEASURED}:check_ideal",
            recheck=f"{_MEASURED}:recheck_labels",
        ),
    ),
    at_once=(
        Decider(
            name="unequal ranks, degrees or dead times: the conditions decide",
            cost=Cost.RANKS,
            decide=f"{_UNDER}:refuse_unequal",
        ),
    ),
    question=f"{_UNDER}:EXACTLY",
    confirms=f"{_MEASURED}:of_sides",
)
SAME_MEASURED_QUICKLY = Table(
    Asked.SAME,
    Of.MEASURED,
    (
        Decider("rows with the same behaviour", Cost.RANKS, f"{_UNDER}:by_rows"),
        Decider("lists at points that all places share", Cost.FIBRE, f"{_UNDER}:by_shared_list"),
        Decider("ranks of numerators, denominators and parts", Cost.RANKS, f"{_UNDER}:by_parts"),
        Decider("ideals within small limits", Cost.IDEALS, f"{_UNDER}:by_small_ideals"),
    ),
    note="For all places of a menu of experiments; such findings are not verified one by one.",
)
POSITIVE_MEASURED = Table(
    Asked.POSITIVE,
    Of.MEASURED,
    rows=(),
    at_once=(
        Decider(
            name="the shares of positive models, both ways",
            cost=Cost.SEARCH,
            decide="decide.asking:by_shares_both_ways",
            yields=(BothWays,),
            check=f"{_MEASURED}:check_both_ways",
        ),
    ),
    answer=f"{_UNDER}:over_positive",
)
SHARE_MEASURED = Table(
    Asked.SHARE,
    Of.MEASURED,
    (
        Decider(
            name="one experiment alone",
            cost=Cost.FIBRE,
            decide=f"{_UNDER}:by_one_experiment",
            yields=(Theorem, Exclusion, EmptyFibre, Interlacing, OnlyOne),
        ),
        Decider("points by lists", Cost.FIBRE, f"{_UNDER}:by_points", (Points,)),
    ),
    question=f"{_UNDER}:POSITIVELY",
)

# --- networks and other models; at once: of two sides ---

GEARS_ALONE = Decider(
    name="gears as units",
    cost=Cost.CLOSED_FORM,
    decide=f"{_OVER}:by_gears",
    yields=(Theorem(GEARS),),
    check=f"{_EVIDENCE}:check_gears",
)
SAME_NETWORKS = Table(
    Asked.SAME,
    Of.NETWORKS,
    (
        Decider(
            name="ideal of one fibre",
            cost=Cost.IDEALS,
            decide=f"{_MODELS}:by_ideals",
            yields=(Solutions, Refutation),
            check=f"{_EVIDENCE}:check_ideal",
            recheck=f"{_EVIDENCE}:recheck_labels",
        ),
    ),
    at_once=(
        Decider(
            name="unequal ranks or degrees: the conditions decide",
            cost=Cost.RANKS,
            decide=f"{_OVER}:refuse_unequal",
        ),
        Decider(
            name="functions without parameters",
            cost=Cost.CLOSED_FORM,
            decide=f"{_OVER}:by_constants",
            yields=(Constants,),
            check=f"{_EVIDENCE}:check_constants",
        ),
        Decider(
            name="gears as units",
            cost=Cost.CLOSED_FORM,
            decide=f"{_OVER}:same_by_gears",
            yields=(Theorem(GEARS),),
            check=f"{_EVIDENCE}:check_gears",
        ),
        Decider(
            name="functions with too many terms: left open",
            cost=Cost.CLOSED_FORM,
            decide=f"{_OVER}:refuse_large",
        ),
    ),
    question=f"{_MODELS}:EXACTLY",
    ground="general.network_view:in_every_order",
    confirms=f"{_OVER}:confirms",
)
NO_CASE = Decider(
    name="no case left: no equivalents",
    cost=Cost.SEARCH,
    decide=f"{_VALUES}:by_no_case",
    yields=(NoEquivalent,),
    check="general.formulas:is_without",
)
COVERING_MAPS = Decider(
    name="explicit maps that cover all parameters",
    cost=Cost.SEARCH,
    decide=f"{_VALUES}:by_covering_maps",
    yields=(Explicit,),
    check="general.formulas:is_explicit",
)
WITNESSES = Decider(
    name="points with and without an equivalent",
    cost=Cost.SEARCH,
    decide=f"{_VALUES}:by_witnesses",
    yields=(Witnesses,),
    check=f"{_EVIDENCE}:confirms",
)
MAPS = Decider(
    name="explicit maps, by roots too",
    cost=Cost.SEARCH,
    decide=f"{_VALUES}:by_maps",
    yields=(Explicit,),
    check="general.formulas:is_explicit",
)
LEFT_OPEN = Decider("what the search found", Cost.CLOSED_FORM, f"{_VALUES}:left_open")


def _of_points(name: str, decide: str) -> Decider:
    """A search for points over positive parameters."""
    return Decider(name, Cost.SEARCH, decide, (Witnesses,), f"{_EVIDENCE}:confirms")


def _of_inequalities(name: str, decide: str) -> Decider:
    """A search for inequalities, and for points that they exclude."""
    check_all = f"{_EVIDENCE}:check_inequalities"
    return Decider(name, Cost.SEARCH, decide, (Inequality, Witnesses), check_all)


REAL_NETWORKS = Table(
    Asked.REAL,
    Of.NETWORKS,
    (NO_CASE, COVERING_MAPS, WITNESSES, MAPS, LEFT_OPEN),
    at_once=(GEARS_ALONE,),
    answer=f"{_OVER}:over_domain",
    prepare=f"{_OVER}:prepare",
)
VALUES_REAL = REAL_NETWORKS
VALUES_POSITIVE = Table(
    Asked.POSITIVE,
    Of.NETWORKS,
    (
        _of_inequalities(
            "first inequalities, of many parameters", f"{_VALUES}:by_first_inequalities"
        ),
        _of_points("first lists of all equivalents of a point", f"{_VALUES}:by_first_lists"),
        _of_points("first points in rounded numbers", f"{_VALUES}:by_first_numbers"),
        NO_CASE,
        COVERING_MAPS,
        Decider(
            name="one-ports: Foster's and Cauer's theorems",
            cost=Cost.CLOSED_FORM,
            decide=f"{_VALUES}:by_one_ports",
            yields=(Theorem(ONE_PORTS),),
            check=f"{_EVIDENCE}:check_one_ports",
        ),
        WITNESSES,
        MAPS,
        _of_points("lists of all equivalents of more points", f"{_VALUES}:by_more_lists"),
        _of_points("more points in rounded numbers", f"{_VALUES}:by_more_numbers"),
        _of_inequalities("inequalities", f"{_VALUES}:by_all_inequalities"),
        LEFT_OPEN,
    ),
    note="Two models as they are, or the networks that represent them in the next table.",
)
POSITIVE_NETWORKS = Table(
    Asked.POSITIVE,
    Of.NETWORKS,
    (
        Decider(
            name="maps and points of the simplest networks with the same behaviour",
            cost=Cost.SEARCH,
            decide=f"{_FORMS}:by_values",
            yields=(Replacement,),
            check=f"{_FORMS}:confirms_forms",
        ),
        Decider(
            name="the same networks at 1/s",
            cost=Cost.SEARCH,
            decide=f"{_FORMS}:by_inverse",
            yields=(AtInverse,),
            check=f"{_FORMS}:confirms_forms",
        ),
        Decider(
            name="parts of either network",
            cost=Cost.SEARCH,
            decide=f"{_FORMS}:by_parts",
            yields=(OfPart,),
            check=f"{_FORMS}:confirms_forms",
        ),
    ),
    at_once=(
        GEARS_ALONE,
        Decider(
            name="replacement of parts",
            cost=Cost.CLOSED_FORM,
            decide=f"{_OVER}:by_replacement",
            yields=(Theorem(REPLACEMENT),),
            check=f"{_EVIDENCE}:check_sets",
        ),
        Decider(
            name="interlacing: undamped machines with zeros between poles",
            cost=Cost.CLOSED_FORM,
            decide=f"{_OVER}:by_interlacing",
            yields=(Theorem(INTERLACING),),
            check=f"{_EVIDENCE}:check_sets",
        ),
        Decider(
            name="places of springs to the ground, undamped machines",
            cost=Cost.CLOSED_FORM,
            decide=f"{_OVER}:by_grounds",
            yields=(Theorem(GROUNDS),),
            check=f"{_EVIDENCE}:check_sets",
        ),
    ),
    note=(
        "Where a theorem leaves out special values and a brief search finds a map without"
        " exception, the map is the evidence."
    ),
    answer=f"{_OVER}:over_domain",
    prepare=f"{_OVER}:prepare",
)

# --- of unequal rank: limits (CLOSURE) and equivalents (IMAGE) of the model of smaller rank ---

CLOSURE_CHAINS = Table(
    Asked.CLOSURE,
    Of.CHAINS,
    (
        Decider(
            name="other size: common poles, a fibre of limits",
            cost=Cost.IDEALS,
            applies=f"{_INSIDE}:differ_in_size",
            decide="decide.inclusion.across_sizes:compute",
            yields=(PoleSharing, LimitFibre),
            check=f"{_CONFIRM}:check_across_sizes",
        ),
        Decider(
            name="rows inside rows, and equations against it",
            cost=Cost.IDEALS,
            applies=f"{_INSIDE}:are_equal_in_size",
            decide=f"{_INSIDE}:by_rows",
            yields=(Outside, RowsInside),
            check=f"{_CONFIRM}:check_fibre",
        ),
        Decider(
            name="small ideals of both rows",
            cost=Cost.IDEALS,
            applies=f"{_INSIDE}:are_equal_in_size",
            decide=f"{_INSIDE}:by_two_rows",
            yields=(ByRows,),
            check=f"{_CONFIRM}:check_fibre",
        ),
    ),
    at_once=(
        Decider(
            name="two sensor quantities: not asked",
            cost=Cost.CLOSED_FORM,
            decide=f"{_INSIDE}:of_two_sensors",
        ),
        Decider(
            name="other size: limits of rows, missing elements, counts and ranks",
            cost=Cost.RANKS,
            applies=f"{_INSIDE}:are_of_two_sizes",
            decide="decide.inclusion.across_sizes:by_sizes",
            yields=(Limit, Meeting, TooLarge),
            check=f"{_CONFIRM}:check_across_sizes",
        ),
        Decider(
            name="elements that vanish or grow without bound",
            cost=Cost.CLOSED_FORM,
            applies=f"{_INSIDE}:are_of_one_size",
            decide=f"{_INSIDE}:of_elements",
            yields=(MissingElements,),
            check=f"{_CONFIRM}:check_missing",
        ),
        Decider(
            name="degrees, ranks of projections, a full image",
            cost=Cost.RANKS,
            applies=f"{_INSIDE}:are_of_one_size",
            decide=f"{_INSIDE}:of_profiles",
            yields=(Counts, LargerProjection, FullImage),
            check=f"{_CONFIRM}:check_profiles",
        ),
    ),
    answer=f"{_INSIDE}:inclusions",
    answer_all=f"{_INSIDE}:all_inclusions",
    confirms=f"{_CONFIRM}:confirms",
)
IMAGE_CHAINS = Table(
    Asked.IMAGE,
    Of.CHAINS,
    (
        Decider(
            name="relative degrees of the rows",
            cost=Cost.CLOSED_FORM,
            decide="decide.inclusion.image:by_degrees",
            yields=(RelativeDegrees,),
            check=f"{_CONFIRM}:check_relative_degrees",
        ),
        Decider(
            name="Markov parameters of the rows",
            cost=Cost.RANKS,
            decide="decide.inclusion.image:by_rows",
            yields=(ByRows,),
            check=f"{_CONFIRM}:check_fibre",
        ),
        Decider(
            name="one fibre by network synthesis",
            cost=Cost.FIBRE,
            decide="decide.inclusion.image:by_synthesis",
            yields=(FibreAt,),
            check=f"{_CONFIRM}:check_fibre",
        ),
        Decider(
            name="small ideal of one fibre",
            cost=Cost.IDEALS,
            decide="decide.inclusion.image:by_small_ideal",
            yields=(Refutation,),
            check=f"{_CONFIRM}:check_fibre",
        ),
    ),
    at_once=(
        Decider(
            name="no limits, so no equivalents",
            cost=Cost.CLOSED_FORM,
            decide=f"{_INSIDE}:of_limits",
        ),
        Decider(
            name="dead time of one alone",
            cost=Cost.CLOSED_FORM,
            decide=f"{_INSIDE}:of_dead_time",
            yields=(DeadTime,),
            check=f"{_CONFIRM}:check_dead_time",
        ),
        Decider(
            name="other size: not asked",
            cost=Cost.CLOSED_FORM,
            decide=f"{_INSIDE}:of_two_sizes",
        ),
    ),
)
BOTH_CHAINS = Table(
    Asked.BOTH,
    Of.CHAINS,
    (
        Decider(
            name="ideal of one fibre of the whole model",
            cost=Cost.IDEALS,
            decide=f"{_INSIDE}:by_ideals",
            yields=(Solutions, Refutation),
            check=f"{_CONFIRM}:check_fibre",
        ),
    ),
)
CLOSURE_MEASURED = Table(
    Asked.CLOSURE,
    Of.MEASURED,
    (
        Decider(
            name="elements that vanish or grow without bound, in all experiments",
            cost=Cost.CLOSED_FORM,
            decide=f"{_INSIDE_ALL}:of_missing_elements",
            yields=(MissingElements,),
            check=f"{_MEASURED}:check_missing",
        ),
        Decider(
            name="dead time of one alone",
            cost=Cost.CLOSED_FORM,
            decide=f"{_INSIDE_ALL}:of_dead_time",
            yields=(LargerProjection,),
            check=f"{_MEASURED}:check_larger",
        ),
        Decider(
            name="degrees in one experiment",
            cost=Cost.RANKS,
            decide=f"{_INSIDE_ALL}:of_degrees",
            yields=(Counts,),
            check=f"{_MEASURED}:check_counts",
        ),
        Decider(
            name="ranks in one experiment",
            cost=Cost.RANKS,
            applies=f"{_INSIDE_ALL}:have_equal_poles",
            decide=f"{_INSIDE_ALL}:of_one_experiment",
            yields=(LargerProjection,),
            check=f"{_MEASURED}:check_larger",
        ),
        Decider(
            name="ranks of projections, a full image",
            cost=Cost.RANKS,
            applies=f"{_INSIDE_ALL}:have_equal_poles",
            decide=f"{_INSIDE_ALL}:of_profiles",
            yields=(LargerProjection, FullImage),
            check=f"{_MEASURED}:check_profiles",
        ),
    ),
    answer=f"{_INSIDE_ALL}:of_sides",
    confirms=f"{_MEASURED}:inclusion_of_sides",
)
CLOSURE_NETWORKS = Table(
    Asked.CLOSURE,
    Of.NETWORKS,
    (
        Decider(
            name="elements that vanish or grow without bound",
            cost=Cost.CLOSED_FORM,
            decide="general.model_inclusions:by_minors",
            yields=(Minor,),
            check="general.model_inclusions:check_minor",
        ),
        Decider(
            name="degrees, ranks of projections, a full image",
            cost=Cost.RANKS,
            applies="general.model_inclusions:have_degrees",
            decide="general.model_inclusions:of_profiles",
            yields=(Counts, LargerProjection, FullImage),
            check="general.model_inclusions:check_profiles",
        ),
    ),
    answer=f"{_OVER}:inclusions",
    confirms=f"{_OVER}:includes",
)

TABLES = (
    SAME_CHAINS,
    SAME_CHAINS_QUICKLY,
    SAME_CHAINS_PATIENTLY,
    REAL_CHAINS,
    POSITIVE_CHAINS,
    SHARE_CHAINS,
    CLOSURE_CHAINS,
    IMAGE_CHAINS,
    BOTH_CHAINS,
    SAME_MEASURED,
    SAME_MEASURED_QUICKLY,
    POSITIVE_MEASURED,
    SHARE_MEASURED,
    CLOSURE_MEASURED,
    SAME_NETWORKS,
    REAL_NETWORKS,
    VALUES_POSITIVE,
    POSITIVE_NETWORKS,
    CLOSURE_NETWORKS,
)
_ASKED = {(table.asked, table.of): table for table in reversed(TABLES) if table.is_asked}
OF_VERDICTS = (Asked.SAME, Asked.REAL, Asked.POSITIVE)
OF_INCLUSIONS = (Asked.CLOSURE, Asked.IMAGE, Asked.BOTH)


def table_of(asked: Asked, of: Of) -> Table | None:
    """Return the table by which two sides of a kind are asked a question, None if there is none."""
    return _ASKED.get((asked, of))


def deciders_of(of: Of, asked: tuple[Asked, ...] = OF_VERDICTS) -> tuple[Decider, ...]:
    """Return all rows for models of a kind that answer these questions, in order."""
    tables = [table for table in TABLES if table.of is of and table.asked in asked]
    return tuple(dict.fromkeys(row for table in tables for row in table.deciders))


def as_markdown() -> str:
    """Return all tables as Markdown, as the maintainers' guide shows them."""
    return "\n\n".join(table.as_markdown() for table in TABLES)
