"""The sentence of each group of structures that a page on what to measure next shows."""

import pytest

from disting.catalogs.next_files import next_catalog
from disting.report.next_steps import next_for
from disting.verdict.next_words import group_in_words


@pytest.mark.parametrize("n", [2, 3, 4])
@pytest.mark.parametrize("damped", [True, False])
def test_each_shipped_group_has_a_sentence_that_its_table_bears_out(n, damped):
    catalog = next_catalog(n, damped=damped)
    for members in catalog.groups:
        menu = next_for(catalog, members)
        said = group_in_words(menu)
        everywhere = any(map(menu.anywhere, menu.kinds))
        single = [
            any(not menu.option(k, (item,)).left for item in menu.items(k))
            for k in range(len(members))
        ]
        assert said.startswith("all separated by ") == everywhere
        assert said.startswith("one experiment separates each") == (all(single) and not everywhere)
        assert said.startswith("no ") == (not all(single) and not everywhere)


def test_two_experiments_are_said_where_one_is_not_enough():
    menu = next_for(next_catalog(5, damped=True), (24, 29, 31, 37))
    assert group_in_words(menu) == (
        "no single experiment always separates A24, A29, A31, A37 from the others, but two do"
    )
