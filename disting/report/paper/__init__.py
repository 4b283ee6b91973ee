"""The paper's figures and tables from our own data, and the page "The paper, claim by claim"."""

from disting.report.paper.figures import paper_figures as paper_figures
from disting.report.paper.paper_page import paper_page as paper_page, write_paper as write_paper
