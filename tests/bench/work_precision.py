"""Claim: no method is faster than the product's, and of those as accurate each takes longer.

Every method with its best settings on the same runs, in one process: two axes under whole roof
motions, the product's case, and one axis under the 18 real records of pySLAMMER, a case each, where
it is installed, else under the records of the manual; other programs where they are installed.
Errors are relative to the exact method, in two axes to the tightest tolerance, which
`solver_accuracy` compares with 40-digit arithmetic and SciPy. Then every method in one axis against
50 digits, under random records and the shipped roof motions. Draws the chart of the docs.
"""

import io
import itertools
from dataclasses import asdict, fields

import pandas as pd
from measure import ROOT, SMOKE, figure
from PIL import Image

import peers
from peers import PeerPoint
from report.figures.base import INK, png_bytes
from report.manual.work_figures import LOOKS, overview
from solver.formats import read_record
from solver.rivals.methods import METHODS
from solver.sliding.two_axes import DEFAULT_TOLERANCE
from solver.verification import checks, workprecision
from solver.verification.study_cases import CASES, compared_runs
from solver.verification.verification_motions import own_triples
from solver.verification.workprecision import OURS, SCIPY, SINGLE, TIME, times_longer, work_points

PICTURES = ROOT / "docs" / "pictures"
FLOOR_PERCENT = 1e-13
"""Error at which the exact method is drawn, see `solver_accuracy`."""
AS_ACCURATE = ("compiled-rk45", "compiled-dop853", "events-rk45", "events-dop853")


def printed(name: str, times_s: pd.Series, errors: pd.Series, of: str) -> None:
    """Print the median time of a method or program, with its errors."""
    words = f"ms; error of the {of} {errors.median():.2g} % in the median, {errors.max():.3g} %"
    figure(name, float(times_s.median()) * 1e3, f"{words} at most")


def two_axes() -> pd.DataFrame:
    """Print time and error of each method at its finest setting, and how much longer it takes."""
    found = workprecision.work(own_triples(quick=True), quick=SMOKE)
    figure("two axes: runs of each method", len(found[workprecision.RUN].drop_duplicates()))
    ours = found[(found["method"] == OURS) & (found["setting"] == DEFAULT_TOLERANCE)]
    error = "residual error [%]"
    for name, own in [("", ours), *found.groupby("method", sort=False)]:
        finest = own[own["setting"] == own["setting"].iloc[-1]]
        name = f"two axes: {name or OURS}, {finest['parameters'].iloc[0]}"
        printed(name, finest[TIME], finest[error], "position")
    for label in [METHODS[name].label for name in AS_ACCURATE[:2]] + [SCIPY]:
        runs = found[found["method"] == label]
        for words, time in (("", TIME), (", a single run", SINGLE)):
            name = f"two axes: {label}, relative to the power series to 1e-6{words}"
            figure(name, times_longer(runs, ours, error, time))
    return found


def one_axis(plane: pd.DataFrame) -> None:
    """Print time and error of each method and program, and draw them beside those in two axes."""
    real = () if SMOKE else peers.real_records()
    runs = list(zip(real, itertools.cycle(CASES), strict=False)) or compared_runs(SMOKE)
    source = "real" if real else "generated"
    figure("runs of each method", len(runs), f"under {source} records")
    found = work_points(runs, quick=SMOKE)
    error = "PRD error [%]"
    exact = found[found["method"] == "exact"]
    for (name, value), own in found.groupby(["method", "setting"], sort=False, dropna=False):
        method = METHODS[name]
        if method.knob in ("", "velocity_mps") or value == method.parameters[method.knob]:
            at = f", {method.knob} = {value:g}" if method.knob else ""
            printed(f"{method.label}{at}", own[TIME], own[error], "PRD")
    figure(
        "exact, a single run with the bounds of its record",
        float(exact[SINGLE].median()) * 1e3,
        "ms",
    )
    for name in AS_ACCURATE:
        own = found[found["method"] == name]
        for words, time in (("", TIME), (", a single run", SINGLE)):
            figure(
                f"{METHODS[name].label}, relative to exact{words}",
                times_longer(own, exact, error, time),
            )
    judges = {peers.ONE_AXIS: peers.JUDGES[peers.ONE_AXIS]}
    points = list(peers.peer_points(judges, runs, (), quick=SMOKE))
    judged = pd.DataFrame(map(asdict, points), columns=[each.name for each in fields(PeerPoint)])
    assert isinstance(LOOKS, dict)
    for marker, (name, own) in zip("1+x2", judged.groupby("peer", sort=False), strict=False):
        label = f"{name} {own['version'].iloc[0]}"
        printed(label, own["seconds"], own["prd_error_percent"], "PRD")
        # Drawn as a method with one setting.
        LOOKS[name] = {
            "linestyle": "", "marker": marker, "markersize": 9, "color": INK, "label": name,
        }  # fmt: skip
        row = {"method": name, "setting": 0.0, TIME: own["seconds"], SINGLE: own["seconds"]}
        others = pd.DataFrame(row | {error: own["prd_error_percent"]})
        found = pd.concat([found, others], ignore_index=True)
    if not SMOKE:
        drawn = overview(found, plane, FLOOR_PERCENT, png_bytes)
        picture = Image.open(io.BytesIO(drawn)).convert("RGB")
        for name, panel in panels(picture).items():
            panel.quantize(64).save(PICTURES / f"work-precision-{name}.png", optimize=True)


def panels(picture: Image.Image) -> dict[str, Image.Image]:
    """Cut the chart into its two plots and its legend, which are readable on a narrow screen."""
    wide, high = picture.size
    scale = wide / 1400.0  # the pixels below are those of a chart of this width

    def cut(left: int, top: int, right: int, bottom: int) -> Image.Image:
        return picture.crop(tuple(round(scale * edge) for edge in (left, top, right, bottom)))

    below = round(high / scale)
    # The labels of the error are on the left of the first plot alone.
    labels, second = cut(0, 0, 118, 610), cut(772, 0, 1400, 610)
    one_axis = Image.new("RGB", (labels.width + second.width, second.height), "white")
    one_axis.paste(labels, (0, 0))
    one_axis.paste(second, (labels.width, 0))
    columns = [cut(left, 660, left + 455, below) for left in (0, 460, 930)]
    legend = Image.new("RGB", (columns[0].width, sum(one.height for one in columns)), "white")
    for row, column in enumerate(columns):
        legend.paste(column, (0, row * column.height))
    return {"two-axes": cut(0, 0, 745, 610), "one-axis": one_axis, "legend": legend}


def against_fifty_digits() -> None:
    """Print the errors of every method under random records and the shipped roof motions."""
    paths = sorted(ROOT.glob("projects/*/records/*-x.csv"))
    records = [read_record(path, units="g") for path in paths[: 1 if SMOKE else None]]
    # A case of each in turn.
    roof = [[*checks.roof_blocks(record)][k % 8] for k, record in enumerate(records)]
    random = [*checks.random_blocks()][: 5 if SMOKE else None]
    kinds = {"random records": random, "roof motions": roof}
    for kind, blocks in kinds.items():
        figure(f"runs against 50 digits, {kind}", len(blocks))
    found = checks.rival_errors(kinds)
    for (key, kind), own in found.groupby(["method", "motions"], sort=False):
        errors = own["error [%]"]
        words = f"% in the median, {errors.max():.2g} % at most"
        figure(
            f"error against 50 digits, {kind}: {METHODS[key].label}", float(errors.median()), words
        )


if __name__ == "__main__":
    in_plane = two_axes()
    one_axis(in_plane)
    against_fifty_digits()
