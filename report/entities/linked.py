"""An array as a row of linked blocks, as it is written and shown.

Computes nothing: see `report.assessment.links`. Read `LinkedResult`.
"""

from __future__ import annotations

from typing import Annotated

from report.assessment.links import LinkedArray
from report.entities.shown import Entity, Number, at
from solver.model import Status


class LinkedRunResult(Entity):
    """A run as a row of blocks, and as one block."""

    motion: str
    along: Annotated[str, at("heading.component")]
    polarity: Annotated[int, at("heading.sign")]
    status: Annotated[Status, at("row.status")]
    rigid_status: Annotated[Status, at("rigid.status")]
    rigid_prd_m: Annotated[Number, at("rigid.prd_m")]
    prd_m: Annotated[tuple[Number, ...], at("row.prd_m")]
    residual_m: Annotated[tuple[Number, ...], at("row.residual_m")]
    stretch_m: Annotated[Number, at("row.stretch_m")]
    link_force_n: Number
    error_m: Annotated[Number, at("row.error_m")]
    n_stops: Annotated[int, at("row.n_stops")]


class LinkedResult(Entity):
    """An array as a row of linked blocks, beside its design as one rigid block."""

    array: Annotated[str, at("design.id")]
    mus: Annotated[tuple[float, ...], at("row.mus")]
    stiffness_n_per_m: Annotated[float, at("links.stiffness_n_per_m")]
    damping_ratio: Annotated[float, at("links.damping_ratio")]
    rigid_one_axis_m: Annotated[Number, at("rigid.value_m")]
    linked_one_axis_m: Annotated[Number, at("linked.value_m")]
    ratio: Number
    design_m: Annotated[Number, at("design.design_m")]
    estimated_m: Number
    link_force_n: Number
    rigid_is_enough: Annotated[bool, at("is_rigid_enough")]
    runs: tuple[LinkedRunResult, ...]


def linked_result(item: LinkedArray) -> LinkedResult:
    """Return an array as a row of linked blocks."""
    runs = tuple(
        LinkedRunResult.of(
            run, motion=motion.motion.id, link_force_n=run.row.link_force * item.block_n
        )
        for motion in item.motions
        for run in motion.runs
    )
    return LinkedResult.of(item, runs=runs)
