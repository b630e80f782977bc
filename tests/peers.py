"""Other programs for comparison, each only if installed; the product needs none of them.

Each is run as its users would, on the same scene, in the axes of the roof if it has no slope.
If a program raises an error, its result is NaN and the note gives the reason.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from solver.forces import components
from solver.formats import read_record
from solver.model import STANDARD_GRAVITY_MPS2, Motion, Scene, coulomb
from solver.records.record import Record
from solver.sliding import checked, one_axis, two_axes
from solver.verification import model_checks
from solver.verification.evidence import percent_off
from solver.verification.study_cases import (
    CLOCK,
    MODEL_CASES,
    Case,
    clocked,
    posed,
    samples_of,
    scene_of,
)
from solver.verification.verification_motions import cut

SUBSTEPS = 10
MOTIONS = 3
MOTION_S = 10.0
"""Longest duration used of a motion of three components [s]."""

STIFFNESS_PER_M = 1e5

ONE_AXIS, VERTICAL, TWO_AXES = "one axis", "one axis with vertical", "two axes with vertical"
"""The models that are judged."""

_G = STANDARD_GRAVITY_MPS2

_Named = tuple[str, Case, Scene]


def real_records() -> tuple[Record, ...]:
    """Return the records that the package pyslammer carries, if installed; it is not imported."""
    spec = importlib.util.find_spec("pyslammer")
    places = spec.submodule_search_locations if spec else None
    paths = sorted(Path((places or [""])[0]).glob("sample_ground_motions/*.csv"))
    return tuple(replace(read_record(path, units="g"), name=path.stem) for path in paths)


@dataclass(frozen=True, slots=True, kw_only=True)
class PeerPoint:
    """One run by another program, if installed."""

    peer: str
    version: str
    model: str  # such as `ONE_AXIS`
    record: str
    scene: str
    seconds: float  # [s]; NaN for a failed run
    prd_error_percent: float  # see `percent_off`; NaN for a failed run
    note: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Peer:
    """Another program."""

    name: str
    module: str
    note: str
    prd_m: Callable[[Scene], float]  # PRD [m] of a scene; NaN if it does not converge


def peer_points(
    judges: Mapping[str, Sequence[Peer]],
    runs: Sequence[tuple[Record, Case]],
    triples: Sequence[Motion],
    *,
    quick: bool,
) -> Iterator[PeerPoint]:
    """Run the installed programs of each model: one axis on runs, others on parts of motions.

    Uses the strongest parts of the first motions whose vertical does not lift the block.
    """
    kept = [triple for triple in triples if model_checks.stays(triple)][:MOTIONS]
    scenes = {
        ONE_AXIS: [
            (record.name, case, posed(checked.scene, record, case)()) for record, case in runs
        ],
        VERTICAL: list(_motion_scenes(kept, quick, second=False)),
        TWO_AXES: list(_motion_scenes(kept, quick, second=True)),
    }
    for model, peers in judges.items():
        for peer in peers:
            if importlib.util.find_spec(peer.module) is not None:
                yield from (_point(peer, model, *named) for named in scenes[model])


def _motion_scenes(triples: Sequence[Motion], quick: bool, *, second: bool) -> Iterator[_Named]:
    for triple in triples:
        part = cut(triple, min(round(MOTION_S / triple.dt_s) + 1, triple.ax_mps2.size))
        for case in MODEL_CASES[:1] if quick else MODEL_CASES:
            yield part.id, case, scene_of(part, case, coulomb(case.mu), second=second)


def _point(peer: Peer, model: str, record: str, case: Case, scene: Scene) -> PeerPoint:
    exact = two_axes.run(scene) if scene.ay_mps2.size else one_axis.run(scene)
    note, seconds = peer.note, math.nan
    try:
        importlib.import_module(peer.module)
        prd_m, seconds = clocked(partial(peer.prd_m, scene), CLOCK)
        if not math.isfinite(prd_m):
            seconds, note = math.nan, f"{note}; did not converge"
    except Exception as error:  # another program may raise anything
        prd_m, note = math.nan, f"{type(error).__name__}: {error}"
    return PeerPoint(
        peer=peer.name,
        model=model,
        version=_version(peer.module),
        record=record,
        scene=str(case),
        seconds=seconds,
        prd_error_percent=float(percent_off(prd_m, exact.prd_m)),
        note=note,
    )


def _version(package: str) -> str:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return "unknown"


def _opensees(scene: Scene) -> float:
    """Run a flatSliderBearing in the axes of the roof: dead load, then uniform excitation."""
    ops = importlib.import_module("openseespy.opensees")
    sine, cosine = math.sin(scene.slope_rad), math.cos(scene.slope_rad)
    (level, _, vertical), dt = map(scene.scaled, components(scene)), scene.dt_s
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for node in (1, 2):
        ops.node(node, 0.0, 0.0)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 0, 0, 1)
    ops.mass(2, 1.0 / _G, 1.0 / _G, 0.0)
    ops.frictionModel("Coulomb", 1, scene.friction.mu_slow)
    ops.uniaxialMaterial("Elastic", 1, 10.0 * STIFFNESS_PER_M)
    ops.uniaxialMaterial("Elastic", 2, 1e3)
    bearing = ("flatSliderBearing", 1, 1, 2, 1, STIFFNESS_PER_M, "-P", 1, "-Mz", 2)
    ops.element(*bearing, "-orient", 0.0, 1.0, 0.0, -1.0, 0.0, 0.0)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, sine, -cosine, 0.0)
    _prepare_opensees(ops, "Static", "LoadControl", 1.0)
    if ops.analyze(1) != 0:
        return math.nan
    ops.loadConst("-time", 0.0)
    # On a slope the dead load shears the elastic bearing: displacements count from there.
    rest = ops.nodeDisp(2, 1)
    down, off = cosine * level - sine * vertical, sine * level + cosine * vertical
    for axis, values in ((1, down), (2, off)):
        ops.timeSeries("Path", 1 + axis, "-dt", dt, "-values", *values.tolist())
        ops.pattern("UniformExcitation", 1 + axis, axis, "-accel", 1 + axis)
    ops.wipeAnalysis()
    _prepare_opensees(ops, "Transient", "Newmark", 0.5, 0.25)
    peak = 0.0
    for _ in range((level.size - 1) * SUBSTEPS):
        if ops.analyze(1, dt / SUBSTEPS) != 0:
            return math.nan
        peak = max(peak, abs(ops.nodeDisp(2, 1) - rest))
    return peak * cosine


def _prepare_opensees(ops: object, analysis: str, *integrator: object) -> None:
    for command, arguments in (
        ("constraints", ("Plain",)),
        ("numberer", ("Plain",)),
        ("system", ("BandGeneral",)),
        ("test", ("NormDispIncr", 1e-12, 25, 0)),
        ("algorithm", ("Newton",)),
        ("integrator", integrator),
        ("analysis", (analysis,)),
    ):
        getattr(ops, command)(*arguments)


def _pyslammer(scene: Scene) -> float:
    """Run its one-way rigid block downslope and upslope; the larger is the PRD."""
    # Downslope s'' = (cos(theta) + mu sin(theta)) (-a - g tan(phi - theta)), and it integrates the
    # second factor alone.
    pyslammer = importlib.import_module("pyslammer")
    mu, a = scene.friction.mu_slow, scene.scaled(scene.ax_mps2)
    travels_m = []
    for theta, way in ((scene.slope_rad, -a), (-scene.slope_rad, a)):
        motion = pyslammer.GroundMotion(way / _G, scene.dt_s)
        travel = pyslammer.RigidAnalysis(math.tan(math.atan(mu) - theta), motion).max_sliding_disp
        share = math.cos(theta) + mu * math.sin(theta)
        travels_m.append(float(travel) * share * math.cos(theta))
    return max(travels_m)


_MUJOCO = """<mujoco>
<option timestep="{step}" cone="elliptic" noslip_iterations="20" iterations="50"/>
<worldbody><geom type="plane" size="0 0 1" condim="3" friction="{mu} 0 0" {contact}/>
<body pos="0 0 0.1"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
<joint type="slide" axis="0 0 1"/>
<geom type="box" size="0.5 0.5 0.1" mass="1" condim="3" friction="{mu} 0 0" {contact}/>
</body></worldbody></mujoco>"""

_STIFF = 'solref="{time} 1" solimp="0.99 0.9999 1e-6"'


def _mujoco(contact: str, scene: Scene) -> float:
    """Slide a box on a plane; gravity is set to the acceleration in the axes of the roof."""
    mujoco = importlib.import_module("mujoco")
    step, mu = scene.dt_s / SUBSTEPS, scene.friction.mu_slow
    held = contact.format(time=f"{2.0 * step:g}")
    model = mujoco.MjModel.from_xml_string(_MUJOCO.format(step=step, mu=mu, contact=held))
    data = mujoco.MjData(model)
    cosine = math.cos(scene.slope_rad)
    rows = samples_of(scene)
    at = np.arange((len(rows) - 1) * SUBSTEPS) / SUBSTEPS
    down, across, cap = (np.interp(at, np.arange(len(rows)), row) for row in rows.T)
    peak = 0.0
    for pull in zip(down.tolist(), across.tolist(), (-cap / mu).tolist(), strict=True):
        # In the frame of the roof its acceleration is a gravity that changes.
        model.opt.gravity[:] = pull
        mujoco.mj_step(model, data)
        peak = max(peak, math.hypot(data.qpos[0] * cosine, data.qpos[1]))
    return float(peak)


_OPENSEES = Peer(
    name="OpenSeesPy (by steps)",
    module="openseespy",
    note=f"flatSliderBearing, {STIFFNESS_PER_M:,.0f} /m, Newmark, {SUBSTEPS} sub-steps",
    prd_m=_opensees,
)
_MUJOCOS = tuple(
    Peer(
        name=f"MuJoCo, {words} contact (by steps)",
        module="mujoco",
        note=f"box on a plane, elliptic cone, no-slip solver, {SUBSTEPS} sub-steps",
        prd_m=partial(_mujoco, contact),
    )
    for contact, words in (("", "default"), (_STIFF, "stiffest"))
)
_PYSLAMMER = Peer(
    name="pySLAMMER (interpreted)",
    module="pyslammer",
    note="rigid block that slides in one direction only, larger of both directions, step of record",
    prd_m=_pyslammer,
)

JUDGES = {ONE_AXIS: (_OPENSEES, *_MUJOCOS, _PYSLAMMER), VERTICAL: (_OPENSEES,), TWO_AXES: _MUJOCOS}
