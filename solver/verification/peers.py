"""Other programs as outside judges, each only where it is installed; the product needs none.

Each is used as its users would, on the same scaled record, in the axes of the roof where it knows
no slope. What a peer raises becomes a hole with its reason.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from solver import sliding
from solver.model import STANDARD_GRAVITY_MPS2, Floats, Scene, coulomb
from solver.motion import Record
from solver.verification.evidence import PeerPoint, percent_off
from solver.verification.plane_scipy import samples_of
from solver.verification.scenes import CASES, Case, scale_to
from solver.verification.triples import Triple
from solver.verification.workprecision import run

SUBSTEPS = 10
PLANE_S = 10.0
"""Longest part of a motion in two axes [s]."""

PLANE_CASES = (Case(2.0, 0.4, 1.0), Case(0.0, 0.3, 1.0), Case(5.0, 0.5, 1.5))
MUJOCO = "mujoco"
STIFFNESS_PER_M = 1e5

_G = STANDARD_GRAVITY_MPS2


@dataclass(frozen=True, slots=True, kw_only=True)
class Peer:
    """Another program.

    Attributes
    ----------
    name, module, package, note : str
    prd_m : callable
        PRD [m] of a scaled record [m/s2], its interval [s] and a case; NaN where it gives up.
    """

    name: str
    module: str
    package: str
    note: str
    prd_m: Callable[[Floats, float, Case], float]


def peer_points(records: Sequence[Record], *, quick: bool) -> Iterator[PeerPoint]:
    """Run what is installed on the records, in a few cases."""
    for peer in PEERS:
        if importlib.util.find_spec(peer.module) is None:
            continue
        for record in records:
            for case in CASES[:2] if quick else CASES[:4]:
                yield _point(peer, record, case)


def plane_points(triples: Sequence[Triple], *, quick: bool) -> Iterator[PeerPoint]:
    """Run what is installed and knows two axes on the strongest seconds of motions."""
    if importlib.util.find_spec(MUJOCO) is None:
        return
    for triple in triples:
        part = triple.cut(min(round(PLANE_S / triple.dt_s) + 1, triple.x_mps2.size))
        for case in PLANE_CASES[:1] if quick else PLANE_CASES:
            scene = part.scene(case, coulomb(case.mu))
            exact, _ = sliding.in_plane(scene)
            for contact, note in _contacts(scene) if not math.isnan(exact.prd_m) else ():
                yield _plane_point(scene, part.name, case, exact.prd_m, contact, note)


def _contacts(scene: Scene) -> tuple[tuple[str, str], ...]:
    """Return the settings of a contact: as it comes, and as stiff as its step allows."""
    stiff = f'solref="{2.0 * scene.dt_s / SUBSTEPS:g} 1" solimp="0.99 0.9999 1e-6"'
    return ("", "contact as it comes"), (stiff, "contact as stiff as its step allows")


def _plane_point(
    scene: Scene, record: str, case: Case, prd_m: float, contact: str, note: str
) -> PeerPoint:
    note, seconds = f"two axes and vertical: {_MUJOCO_NOTE}; {note}", math.nan
    try:
        start = time.perf_counter()
        found = _mujoco_plane(scene, contact)
        seconds = time.perf_counter() - start
    except Exception as error:  # nobody knows what another program raises
        found, note = math.nan, f"{type(error).__name__}: {error}"
    return PeerPoint(
        peer="MuJoCo",
        version=_version(MUJOCO),
        record=record,
        scene=str(case),
        seconds=seconds,
        prd_error_percent=float(percent_off(found, prd_m)),
        note=note,
    )


def _point(peer: Peer, record: Record, case: Case) -> PeerPoint:
    a = record.a_mps2 * scale_to(record, case.ppa_g)
    note, seconds = peer.note, math.nan
    try:
        importlib.import_module(peer.module)
        start = time.perf_counter()
        prd_m = peer.prd_m(a, record.dt_s, case)
        if math.isfinite(prd_m):
            seconds = time.perf_counter() - start
        else:
            note = f"It did not converge. {note}"
    except Exception as error:  # nobody knows what another program raises
        prd_m, note = math.nan, f"{type(error).__name__}: {error}"
    exact = run(record, case, "exact", {}).prd_m
    return PeerPoint(
        peer=peer.name,
        version=_version(peer.package),
        record=record.name,
        scene=str(case),
        seconds=seconds,
        prd_error_percent=float(percent_off(prd_m, exact)),
        note=note,
    )


def _version(package: str) -> str:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return "unknown"


def _opensees(a: Floats, dt: float, case: Case) -> float:
    """Run a flatSliderBearing in the axes of the roof: dead load, then uniform excitation."""
    ops = importlib.import_module("openseespy.opensees")
    sine, cosine = math.sin(case.slope_rad), math.cos(case.slope_rad)
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for node in (1, 2):
        ops.node(node, 0.0, 0.0)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 0, 0, 1)
    ops.mass(2, 1.0 / _G, 1.0 / _G, 0.0)
    ops.frictionModel("Coulomb", 1, case.mu)
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
    rest = ops.nodeDisp(2, 1)
    for axis, part in ((1, cosine), (2, sine)):
        ops.timeSeries("Path", 1 + axis, "-dt", dt, "-values", *(part * a).tolist())
        ops.pattern("UniformExcitation", 1 + axis, axis, "-accel", 1 + axis)
    ops.wipeAnalysis()
    _prepare_opensees(ops, "Transient", "Newmark", 0.5, 0.25)
    peak = 0.0
    for _ in range((a.size - 1) * SUBSTEPS):
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


def _pyslammer(a: Floats, dt: float, case: Case) -> float:
    """Run its one-way rigid block down the slope and up it; the larger is the PRD.

    s'' = (cos(theta) + mu sin(theta)) (-a - g tan(phi - theta)) down the slope.
    """
    pyslammer = importlib.import_module("pyslammer")
    phi, found = math.atan(case.mu), []
    for theta, way in ((case.slope_rad, -a), (-case.slope_rad, a)):
        motion = pyslammer.GroundMotion(way / _G, dt)
        travel = pyslammer.RigidAnalysis(math.tan(phi - theta), motion).max_sliding_disp
        share = math.cos(theta) + case.mu * math.sin(theta)
        found.append(float(travel) * share * math.cos(theta))
    return max(found)


_MUJOCO_NOTE = f"box on a plane, elliptic cone, no-slip solver, {SUBSTEPS} sub-steps"
_MUJOCO = """<mujoco>
<option timestep="{step}" cone="elliptic" noslip_iterations="20" iterations="50"/>
<worldbody><geom type="plane" size="0 0 1" condim="3" friction="{mu} 0 0" {contact}/>
<body pos="0 0 0.1"><joint type="slide" axis="1 0 0"/>{across}<joint type="slide" axis="0 0 1"/>
<geom type="box" size="0.5 0.5 0.1" mass="1" condim="3" friction="{mu} 0 0" {contact}/>
</body></worldbody></mujoco>"""


def _mujoco(a: Floats, dt: float, case: Case) -> float:
    """Let a box slide on a plane, gravity being what the roof's own axes feel."""
    mujoco = importlib.import_module("mujoco")
    step = dt / SUBSTEPS
    model = mujoco.MjModel.from_xml_string(
        _MUJOCO.format(step=step, mu=case.mu, across="", contact="")
    )
    data = mujoco.MjData(model)
    sine, cosine = math.sin(case.slope_rad), math.cos(case.slope_rad)
    fine = np.interp(np.arange((a.size - 1) * SUBSTEPS) / SUBSTEPS, np.arange(a.size), a)
    peak = 0.0
    for now in fine.tolist():
        model.opt.gravity[:] = _G * sine - now * cosine, 0.0, -(_G * cosine + now * sine)
        mujoco.mj_step(model, data)
        peak = max(peak, abs(data.qpos[0]))
    return float(peak * cosine)


_ACROSS = '<joint type="slide" axis="0 1 0"/>'


def _mujoco_plane(scene: Scene, contact: str) -> float:
    """Let a box slide both ways, gravity being what the roof's own axes feel."""
    mujoco = importlib.import_module("mujoco")
    step, mu = scene.dt_s / SUBSTEPS, scene.friction.mu_slow
    xml = _MUJOCO.format(step=step, mu=mu, across=_ACROSS, contact=contact)
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    cosine = math.cos(scene.slope_rad)
    rows = samples_of(scene)
    at = np.arange((len(rows) - 1) * SUBSTEPS) / SUBSTEPS
    down, across, cap = (np.interp(at, np.arange(len(rows)), row) for row in rows.T)
    peak = 0.0
    for pull in zip(down.tolist(), across.tolist(), (-cap / mu).tolist(), strict=True):
        model.opt.gravity[:] = pull
        mujoco.mj_step(model, data)
        peak = max(peak, math.hypot(data.qpos[0] * cosine, data.qpos[1]))
    return float(peak)


PEERS = (
    Peer(
        name="OpenSeesPy",
        module="openseespy",
        package="openseespy",
        note=f"flatSliderBearing, {STIFFNESS_PER_M:g} 1/m, Newmark, {SUBSTEPS} sub-steps",
        prd_m=_opensees,
    ),
    Peer(
        name="MuJoCo",
        module=MUJOCO,
        package=MUJOCO,
        note=_MUJOCO_NOTE,
        prd_m=_mujoco,
    ),
    Peer(
        name="pySLAMMER",
        module="pyslammer",
        package="pyslammer",
        note="rigid block, one way at a time, at the record's own step",
        prd_m=_pyslammer,
    ),
)
