"""Roof plans as pictures, and a size smaller than any that is printed."""

from report.drawing.on_paper import plan_on_paper
from report.drawing.sheet import PlanSize
from report.figures.plan import paper_svg

SMALL = PlanSize(wide=6.7, tall=2.95, key_wide=2.05, key_tall=0.95)


def roof_plan(assessment, size):
    """Return the plan of an assessment as SVG."""
    return paper_svg(plan_on_paper(assessment, size).paper)
