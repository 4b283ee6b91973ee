"""Catalogues as pages and figures. This layer renders verdicts and never decides; it writes
formulas out for people.

The names:

    write_report, write_family    a site of catalogues; pages of your own models
    page, index, model_page, damper_page   single pages as HTML
    chain_svg, chain_png, network_svg, network_png   drawings
    describe                      a chain in words
    matrix_svg, matrix_png        the verdict matrix of a catalogue
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

offer(__name__)
