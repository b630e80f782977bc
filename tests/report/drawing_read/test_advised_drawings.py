"""What the refusal of a drawing says would do, does. Oracle: the plan that made each drawing."""

import io
import re
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from ezdxf.math import Matrix44

from fixtures.commands import output_of
from fixtures.dxf import BOX_FT, ROOF_FT, UNIT_FT, Sketch
from fixtures.marks import by_day
from fixtures.project_parts import FT, INCH
from fixtures.workbooks import blank, edit, put
from report.project.check.plan_shapes import shapes_of
from report.project.read.read import read

RTU = 'RTU-1, HT 42"'
OURS = ("ROOF-OUTLINE", "ARRAY", "OBJECT")
OTHERS = ("A-ROOF-OTLN", "PV-ARRAY", "M-RTU")
UNKNOWN = ("X-1", "X-2", "X-3")
CHOSEN = ("--layer", "X-1=roof", "--layer", "X-2=array", "--layer", "X-3=fixed object")


def plain(unit="ft", layers=OURS, *, array="A1", code=None):
    sketch = Sketch(unit=unit)
    for layer, points, name in zip(
        layers, (ROOF_FT, BOX_FT, UNIT_FT), ("", array, RTU), strict=True
    ):
        sketch.ring(layer, points, name)
    if code is not None:
        sketch.document.header["$INSUNITS"] = code
    return sketch


def text_of(sketch):
    sketch.document.write(out := io.StringIO())
    return out.getvalue().encode()


def turned(degrees, scale=1.0, shift=(0.0, 0.0), unit="ft"):
    sketch = plain(unit)
    matrix = Matrix44.chain(
        Matrix44.scale(scale), Matrix44.z_rotate(degrees * 3.141592653589793 / 180.0),
        Matrix44.translate(*shift, 0.0),
    )  # fmt: skip
    for entity in sketch.space:
        entity.transform(matrix)
    return text_of(sketch)


def in_a_layout():
    sketch = plain()
    layout = sketch.document.layout("Layout1")
    for entity in list(sketch.space):
        sketch.space.move_to_layout(entity, layout)
    return text_of(sketch)


def open_lines():
    sketch = Sketch()
    for layer, points in zip(OURS, (ROOF_FT, BOX_FT, UNIT_FT), strict=True):
        sketch.space.add_lwpolyline(points, dxfattribs={"layer": layer})
    return text_of(sketch)


def nested():
    sketch = plain()
    for level in range(10):
        block = sketch.document.blocks.new(f"B{level}")
        if level:
            block.add_blockref(f"B{level - 1}", (0, 0))
    sketch.space.add_blockref("B9", (0, 0))
    return text_of(sketch)


def with_points(count):
    sketch = plain()
    for k in range(count):
        sketch.space.add_point((k, 0))
    return text_of(sketch)


def binary():
    sketch = plain()
    sketch.document.write(out := io.BytesIO(), fmt="bin")
    return out.getvalue()


def zipped():
    with zipfile.ZipFile(out := io.BytesIO(), "w") as file:
        file.writestr("roof.dxf", text_of(plain()))
    return out.getvalue()


def array_at(x):
    return ((x, 20), (x + 40, 20), (x + 40, 75), (x, 75))


def of_others(x_ft):
    """Two arrays of one size beside each other, or a third one between them without a name."""
    sketch = Sketch()
    sketch.ring("ROOF-OUTLINE", ROOF_FT)
    sketch.ring("OBJECT", UNIT_FT, RTU)
    for name, x in x_ft.items():
        sketch.ring("ARRAY", array_at(x), name)
    return text_of(sketch)


def say_layers(path: Path) -> None:
    kinds = ("roof", "array", "fixed object")
    rows = enumerate(zip(UNKNOWN, kinds, strict=True), 1)
    cells = {}
    for row, (layer, kind) in rows:
        cells |= {f"Layers/{row}/Layer": layer, f"Layers/{row}/Content": kind}
    edit(path, lambda book: put(book, cells))


def ours():
    return text_of(plain())


@dataclass(frozen=True)
class Kind:
    """A drawing that is refused, what its message advises, and the drawing and options by that."""

    drawn: Callable[[], bytes]
    advice: str  # a pattern; what it has as a group is the value of the last option
    followed: Callable[[], bytes] | None = None  # another drawing, as advised
    given: tuple[str, ...] = ()
    then: tuple[str, ...] = ()
    before: Callable[[], bytes] | None = None  # a drawing that the workbook has already
    workbook: Callable[[Path], None] | None = None  # what is typed into it, as advised
    name: str = "roof.dxf"
    array_ft: tuple[tuple[float, float], ...] = BOX_FT


KINDS = {
    "no unit": Kind(lambda: text_of(plain(code=0)), r"use --units with one of .*\bft\b",
                    then=("--units", "ft")),
    "survey feet": Kind(lambda: text_of(plain(code=21)), r"use --units (\w+)", then=("--units",)),
    "feet that say yards": Kind(lambda: text_of(plain(code=10)), r"use --units (\w+)",
                                then=("--units",)),
    "meters that say inches": Kind(lambda: text_of(plain("m", code=1)),
                                   r"Unit on the page\): (?:ft or )?(m)\b", then=("--units",)),
    "another unit than the workbook's": Kind(
        lambda: text_of(plain("m", code=2)), r"Unit on the page\): (m)\b", before=ours,
        given=("--replace",), then=("--replace", "--units"),
    ),
    "layers of others": Kind(lambda: text_of(plain(layers=OTHERS)), "use --accept to accept",
                             then=("--accept",)),
    "layers that nobody knows": Kind(lambda: text_of(plain(layers=UNKNOWN)),
                                     "or --layer NAME=TYPE for a layer", then=CHOSEN),
    "layers for the sheet": Kind(lambda: text_of(plain(layers=UNKNOWN)),
                                 "enter the types of the layers on the Layers"
                                 " worksheet", given=("--accept",),
                                 workbook=say_layers),
    "a layer that is not there": Kind(
        lambda: text_of(plain(layers=UNKNOWN)), r"did you mean '(X-1)'\?",
        given=("--layer", "X-11=roof", *CHOSEN[2:]), then=CHOSEN,
    ),
    "lines of a layout": Kind(in_a_layout, "not in model space; move them there in CAD", ours),
    "open lines": Kind(open_lines, "draw roof, arrays and objects as closed lines in CAD", ours),
    "places that are filled": Kind(ours, "use --replace to overwrite it", before=ours,
                                   then=("--replace",)),
    "north that is not stated": Kind(lambda: turned(-90.0), "use --rotate with an angle in degrees",
                                     given=("--rotate", "north"), then=("--rotate", "90")),
    "degrees": Kind(lambda: turned(0.0, 1e-6, (-118.25, 34.05), "m"), "export it in ft or m", ours),
    "a zip": Kind(zipped, "unpack it and use the DXF in it", ours),
    "a binary DXF": Kind(binary, "save it as DXF in text", ours),
    "half a drawing": Kind(lambda: ours()[:5000], "open it in CAD and save it again", ours),
    "blocks in blocks": Kind(nested, "nested more than 8 deep; explode it", ours),
    "too many entities": Kind(lambda: with_points(20_001),
                              "save only the layers of the roof plan", ours),
    "a name misspelled": Kind(ours, r"did you mean '.*roof\.dxf'\?", ours, name="roof2.dxf"),
    "an array that may be either": Kind(
        lambda: of_others({"": 100}), "write its name inside it as a text",
        lambda: of_others({"A1": 120}), before=lambda: of_others({"A1": 60, "A2": 140}),
        given=("--replace",), then=("--replace",), array_ft=array_at(120),
    ),
}  # fmt: skip


def box(points_ft):
    (x0, y0), _, (x1, y1), _ = points_ft
    return pytest.approx((x0 * FT, x1 * FT, y0 * FT, y1 * FT), abs=1e-5)


def check_plan(path, array_ft):
    inputs = read(path).inputs
    sides = ("x_from_m", "x_to_m", "y_from_m", "y_to_m")
    assert tuple(inputs["roof"][0][side] for side in sides) == box(ROOF_FT)
    shapes = shapes_of(inputs)
    for name, points in (("A1", array_ft), ("RTU-1", UNIT_FT)):
        assert tuple(getattr(shapes[name].bounds, side) for side in sides) == box(points)
    (height_m,) = (row["height_m"] for row in inputs["objects"] if row["id"] == "RTU-1")
    assert height_m == pytest.approx(42 * INCH)


@pytest.mark.parametrize("name", by_day(KINDS, 1))
def test_what_the_refusal_of_a_drawing_says_would_do_does(tmp_path, name):
    kind = KINDS[name]
    (tmp_path / "job").mkdir()
    path = blank(tmp_path / "job" / "input.xlsx")
    drawing = tmp_path / "roof.dxf"
    if kind.before:
        drawing.write_bytes(kind.before())
        output_of("plan", "read", drawing, path)
    drawing.write_bytes(kind.drawn())
    said = output_of("plan", "read", tmp_path / kind.name, path, *kind.given, exit_code=2)
    advised = re.search(kind.advice, said)
    assert advised, said
    if kind.followed:
        drawing.write_bytes(kind.followed())
    if kind.workbook:
        kind.workbook(path)
    value = advised.groups() if kind.then and kind.then[-1] == "--units" else ()
    output_of("plan", "read", drawing, path, *kind.then, *value)
    check_plan(path, kind.array_ft)
