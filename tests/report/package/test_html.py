"""What a second process draws and typesets before the evidence is there."""

import re

import packages
import scenes
from report.assessment.changes import NO_FORMER
from report.assessment.evidence import support
from report.package.html import begin, pages
from report.workers import SameProcess


def test_every_equation_of_a_package_is_typeset_before_its_evidence_is_there():
    assessment = scenes.package().assessment
    with packages.undrawn():
        begun = begin(assessment, NO_FORMER, SameProcess())
        ready = {equation.src for equation in begun.equations.result().values()}
        evidence = support(assessment)
        html = pages(assessment, evidence, NO_FORMER, begun.plot(evidence))
    printed = set(re.findall(r'<div class="symbols"><img src="([^"]+)"', html))
    assert len(printed) > 15
    assert printed == ready
