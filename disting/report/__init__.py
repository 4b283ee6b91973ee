"""Catalogues as pages and figures. This layer renders verdicts and never decides; it writes
formulas out for people.
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.report.damper_page import damper_page as damper_page
    from disting.report.drawing import (
        chain_png as chain_png,
        chain_svg as chain_svg,
        describe as describe,
    )
    from disting.report.index import index as index
    from disting.report.matrix import matrix_png as matrix_png, matrix_svg as matrix_svg
    from disting.report.model import model_page as model_page
    from disting.report.model_list import write_family as write_family
    from disting.report.network_drawing import (
        network_png as network_png,
        network_svg as network_svg,
    )
    from disting.report.page import page as page
    from disting.report.write import write_report as write_report

offer(
    __name__,
    {
        "damper_page": "damper_page",
        "drawing": "chain_png chain_svg describe",
        "index": "index",
        "matrix": "matrix_png matrix_svg",
        "model": "model_page",
        "model_list": "write_family",
        "network_drawing": "network_png network_svg",
        "page": "page",
        "write": "write_report",
    },
)
