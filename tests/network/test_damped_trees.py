"""Free trees of masses seen at their root: without dampers all are one, with dampers none are."""

from itertools import combinations

import networkx as nx
import pytest

from disting import compare
from disting.verdict.result import Relation


def rooted_trees(n_masses, joint):
    """Texts of all trees with a root, mass 1, where force and sensor are."""
    found = []
    for tree in nx.nonisomorphic_trees(n_masses):
        for root in tree.nodes:
            rooted = tree.copy()
            rooted.nodes[root]["root"] = True
            if not any(
                nx.is_isomorphic(rooted, other, node_match=dict.__eq__) for other, _ in found
            ):
                found.append((rooted, root))
    for tree, root in found:
        order = [root, *(j for _, j in nx.bfs_edges(tree, root))]
        number = {node: at for at, node in enumerate(order, 1)}
        edges = (sorted((number[a], number[b])) for a, b in tree.edges)
        yield ", ".join(f"{a}{joint}{b}" for a, b in edges) + "; F1; S1"


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    ("n_masses", "trees"),
    [(3, 2), *(pytest.param(*n, marks=pytest.mark.slow) for n in ((4, 4), (5, 9)))],
)
def test_trees_at_their_root(n_masses, trees):
    for joint, relation in (("~", Relation.INDISTINGUISHABLE), ("=", Relation.DISTINGUISHABLE)):
        texts = list(rooted_trees(n_masses, joint))
        assert len(texts) == trees
        for one, other in combinations(texts, 2):
            assert compare(one, other).relation is relation, (one, other)
