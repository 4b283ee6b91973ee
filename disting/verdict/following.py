"""What follows from evidence: which relation, by which rule, over which domain, at which stage."""

from disting.conditions.rule import ADMISSIBLE, EXACT, Role, Stage
from disting.conditions.table import RULES
from disting.evidence.claims import CLAIMS, Carrier
from disting.evidence.kinds import Evidence
from disting.model.domain import Domain
from disting.verdict.cascade import PROVES
from disting.verdict.query import Query
from disting.verdict.result import Relation, Verdict

STAGES = {
    Role.NECESSARY: (Stage.TF, Stage.MARKOV),
    Role.SUFFICIENT: (Stage.TF, Stage.MARKOV),
    Role.STRUCTURAL: (Stage.STRUCTURE,),
}
DECISIONS = {
    EXACT: (Carrier.EXACT, Stage.FIBRE),
    ADMISSIBLE: (Carrier.ADMISSIBLE, Stage.PARAMETERS),
}


def follows(v: Verdict, evidence: Evidence, query: Query) -> bool:
    """Whether evidence of this kind shows this relation, by a rule of this kind, over this domain,
    where the query lets it decide. Over real and positive parameters equality is shown by the rule
    that asks for such; a difference over complex ones is one there too.
    """
    rule, claim = RULES[v.decided_by], CLAIMS[type(evidence)]
    carrier, stage = DECISIONS.get(rule, (Carrier.CONDITION, v.representation))
    if carrier not in claim.carriers or v.relation is not claim.shows(evidence, v.domain):
        return False
    if rule is ADMISSIBLE:
        return v.representation is stage and v.domain is not Domain.COMPLEX
    seen = stage in STAGES.get(rule.role, (stage,)) and v.representation is stage
    proves = v.relation in PROVES[rule.role].values()
    over = v.domain is Domain.COMPLEX or v.relation is Relation.DISTINGUISHABLE
    return seen and proves and over and v.representation in query.view.representations
