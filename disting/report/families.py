"""The pages of pairs of a site: what a search needs of each, by its name."""

from collections.abc import Mapping, Sequence

from disting.catalogs import Catalog
from disting.catalogs.damper_family import DamperFamily, damper_name
from disting.catalogs.sizes_files import SizesCatalog
from disting.report.model import folder_of

Families = Mapping[str, Mapping[str, object]]
"""By the name of a page: number of `models`, of structures where there are sets of dampers to the
ground; the `folder` of their pages, where there are any; of a page of several sizes instead its
`sizes`, (masses, number of models) each.
"""


def families(
    catalogs: Sequence[Catalog],
    dampers: Sequence[DamperFamily] = (),
    across: Sequence[SizesCatalog] = (),
) -> dict[str, dict[str, object]]:
    """Of the pages of these catalogues, families with ground dampers, and catalogues of several
    sizes.

    >>> from disting.catalogs import catalog
    >>> families([catalog(3, damped=False)])
    {'chains-3-undamped': {'models': 11, 'folder': 'models/3-undamped'}}
    """
    found: dict[str, dict[str, object]] = {
        c.name: {"models": len(c.family), "folder": folder_of(c)} for c in catalogs
    }
    found |= {
        damper_name(f.family.n_masses, f.family.damped): {"models": len(f.family)} for f in dampers
    }
    return found | {
        s.name: {"sizes": [(c.n_masses, len(c.family)) for c in s.catalogs]} for s in across
    }
