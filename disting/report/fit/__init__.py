"""A fit in sentences, as a page, as figures, and as plain data for a file. This package renders
what `disting.fit` found, and requests from it the data of figures.

The names:

    write_fit_report, write_network_report   page, figures and data of a fit, in a folder
    fit_page, fit_figures, selection_to_dict   the page, the figures, the data alone
    export                        the structures that the data leave, for other programs
    bode, residuals, profile_panels, waterfall   figures of a candidate
    importance_bars, collinearity_dots           figures of its parameters
    models_by_threshold, parameters_by_threshold   figures of the criteria
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.report.fit.bode import bode as bode
    from disting.report.fit.convergence import (
        profile_panels as profile_panels,
        waterfall as waterfall,
    )
    from disting.report.fit.criteria import (
        models_by_threshold as models_by_threshold,
        parameters_by_threshold as parameters_by_threshold,
    )
    from disting.report.fit.network_page import write_network_report as write_network_report
    from disting.report.fit.residuals import residuals as residuals
    from disting.report.fit.selection_json import selection_to_dict as selection_to_dict
    from disting.report.fit.selection_page import fit_page as fit_page
    from disting.report.fit.sensitivity import (
        collinearity_dots as collinearity_dots,
        importance_bars as importance_bars,
    )
    from disting.report.fit.write import (
        export as export,
        fit_figures as fit_figures,
        write_fit_report as write_fit_report,
    )

offer(__name__)
