"""The kernels in the browser are those of the solver, and so is what is made of them there."""

import base64
import importlib.util
import math
import subprocess
import sys
from collections import Counter
from dataclasses import asdict, replace

import numpy as np
import pytest

from fixtures.browser import chromium, quiet_page
from fixtures.marks import nightly
from fixtures.paths import ROOT
from report.page_file.page import _script
from solver.model import Friction, HorizontalComponent, Motion, Orientation, coulomb
from solver.sliding import model_selection

_SPEC = importlib.util.spec_from_file_location("page_parts", ROOT / "docs" / "page_parts.py")
page_parts = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(page_parts)
PARTS = ROOT / "templates" / "page-file"
LENGTHS = ("prd_m", "down_m", "up_m", "across_m", "residual_m", "residual_across_m")
MADE = """
  const { createKernels, LENGTHS } = modules["kernels.js"];
  const bytes = Uint8Array.from(atob(wasm), (letter) => letter.codePointAt(0));
  for (const motion of motions) motion.parts = motion.parts.map((part) => Float64Array.from(part));
  const kernels = createKernels(bytes, motions);
"""
HISTORY = f"""([wasm, motions, [scene]]) => {{{MADE}
  return kernels.history(scene).rows.flatMap((row) => [...row]);
}}"""
RUN = f"""([wasm, motions, scenes]) => {{{MADE}
  return scenes.map((scene) => kernels.run(scene))
    .map((done) => [done.model, done.error_m, ...LENGTHS.map((name) => done[name])]);
}}"""


def wasm():
    return base64.b64encode((PARTS / "kernels.wasm").read_bytes()).decode()


@pytest.mark.quick
def test_the_file_of_the_kernels_is_of_the_kernels_as_they_are():
    now = page_parts.hashes((PARTS / "kernels.wasm").read_bytes())
    assert (PARTS / "kernels.sha256").read_text() == now, "run docs/page_parts.py"
    assert now.count("\n") == 4


@pytest.mark.quick
def test_words_beside_a_kernel_change_no_hash_of_it_and_a_number_does(tmp_path):
    source = ROOT / "solver" / "kernels" / "one_axis.py"
    text, path = source.read_text(), tmp_path / "one_axis.py"
    before = page_parts.statements(source)
    path.write_text(
        text.replace('    """', '    """Other. ', 1).replace("\n\n\n", "\n\n# why\n\n", 1)
    )
    assert page_parts.statements(path) == before
    path.write_text(text.replace("2.0**-52", "2.0**-51", 1))
    assert page_parts.statements(path) != before


@pytest.mark.nightly
def test_kernels_and_fonts_are_built_again_to_the_byte(tmp_path):
    for part, name in page_parts.FONTS.items():
        assert page_parts.font(name) == (PARTS / f"{part}.woff").read_bytes()
    if page_parts.linker() is None:
        pytest.skip("LLD is not installed: sudo apt-get install lld-14")
    command = [sys.executable, ROOT / "docs" / "page_parts.py", tmp_path]
    subprocess.run(command, check=True, timeout=900)
    assert (tmp_path / "kernels.wasm").read_bytes() == (PARTS / "kernels.wasm").read_bytes()


def shaken(rng, k):
    """A random motion; some lack the transverse or the vertical component."""
    n, dt = int(rng.integers(600, 1500)), float(rng.choice([0.005, 0.01, 0.02]))
    t = dt * np.arange(n)
    parts = []
    for strength in (5.0, 4.0, 3.0):
        waves = [(rng.uniform(0.3, 8.0), rng.uniform(0, 6.3), rng.normal()) for _ in range(12)]
        shape = sum(a * np.sin(6.283 * f * t + p) for f, p, a in waves)
        envelope = np.minimum(1.0, t / 2.0) * np.exp(-t / (0.4 * t[-1]))
        parts.append(strength * rng.uniform(0.4, 1.2) / 2.4 * shape * envelope)
    none = np.empty(0)
    x, y, z = parts[0], none if k % 5 == 1 else parts[1], none if k % 5 == 2 else parts[2]
    return Motion(
        id=f"M{k}", source="", signs=(1, -1), dt_s=dt, scale=1.0, ax_mps2=x, ay_mps2=y, az_mps2=z
    )


def law(rng):
    """Friction: half of it constant, a quarter each rises with velocity or falls."""
    slow = float(rng.uniform(0.1, 0.8))
    fast = slow * float(rng.choice([1.0, 1.0, rng.uniform(1.05, 1.5), rng.uniform(0.6, 0.95)]))
    rate = float(rng.uniform(2.0, 50.0)) if fast != slow else 0.0
    return Friction(mu_slow=slow, mu_fast=fast, mu_static=slow, rate_s_per_m=rate)


def compared(n_scenes, seed):
    """Runs of random scenes in Chromium beside those of the solver, and the largest difference."""
    rng = np.random.default_rng(seed)
    motions = [shaken(rng, k) for k in range(15)]
    scenes, natives = [], []
    for _ in range(n_scenes):
        at = int(rng.integers(len(motions)))
        motion, friction = motions[at], law(rng)
        kinds = list(HorizontalComponent)[: 1 + motion.has_transverse]
        along, sign = kinds[int(rng.integers(len(kinds)))], int(rng.choice([1, -1]))
        slope, scale = float(rng.uniform(0.0, 0.2)), float(rng.uniform(0.5, 2.0))
        scene = motion.scene(
            Orientation(component=along, polarity=sign), slope_rad=slope, friction=friction
        )
        native = model_selection.solve(replace(scene, scale=scale))
        natives.append(native)
        run = {"motion": at, "along": along, "polarity": sign, "slope_rad": slope, "scale": scale}
        scenes.append(run | {"friction": asdict(friction)})
    records = [(each.ax_mps2, each.ay_mps2, each.az_mps2) for each in motions]
    given = [
        {"dt_s": each.dt_s, "parts": [part.tolist() for part in parts]}
        for each, parts in zip(motions, records, strict=True)
    ]
    with chromium() as browser, quiet_page(browser) as page:
        page.add_script_tag(content=_script("kernels.js"))
        return natives, page.evaluate(RUN, [wasm(), given, scenes])


@pytest.mark.parametrize("n_scenes", [60, nightly(3000)])
def test_random_scenes_have_the_model_and_the_displacements_of_the_solver(n_scenes):
    natives, found = compared(n_scenes, seed=81)
    models, n_equal = Counter(), 0
    for native, (model, error_m, *lengths) in zip(natives, found, strict=True):
        result = native.result
        assert model == native.model
        models[native.model] += 1
        expected = [getattr(result, name) for name in LENGTHS]
        if math.isnan(result.prd_m):
            assert all(map(math.isnan, lengths))
            n_equal += 1
            continue
        changes = np.abs(np.subtract(lengths, expected))
        assert changes.max() <= 1e-12 + result.error_m + error_m
        n_equal += not changes.any()
    assert set(models) == set(model_selection.Model)
    assert n_equal >= 0.99 * len(natives)


def test_a_run_that_lifts_off_has_no_displacement_and_no_history():
    t = np.arange(0.0, 5.0, 0.01)
    lifting = -12.0 * np.sin(6.0 * t)
    scene = {
        "motion": 0,
        "along": "record",
        "polarity": 1,
        "slope_rad": 0.05,
        "friction": asdict(coulomb(0.4)),
        "scale": 1.0,
    }
    given = [{"dt_s": 0.01, "parts": [np.cos(9.0 * t).tolist(), [], lifting.tolist()]}]
    with chromium() as browser, quiet_page(browser) as page:
        page.add_script_tag(content=_script("kernels.js"))
        ((_, _, *lengths),) = page.evaluate(RUN, [wasm(), given, [scene]])
        rows = page.evaluate(HISTORY, [wasm(), given, [scene]])
    assert all(map(math.isnan, lengths))
    assert all(map(math.isnan, rows))
