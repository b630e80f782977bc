"""The page in a real browser: what is dropped and chosen, and what is taken away."""

import io
import itertools
import json
import math
import re
import shutil
from urllib.parse import urlsplit
from xml.etree import ElementTree

import openpyxl
import pytest
from pypdf import PdfReader

from fixtures import cells
from fixtures.browser import (
    DESKTOP,
    PHONE,
    TABLET,
    at_rest,
    moved,
    numbers,
    opened,
    quiet_page,
    saved,
    served,
    tab_to,
)
from fixtures.commands import stdout_of
from fixtures.dxf import BOX_FT, ROOF_FT, Sketch
from fixtures.paths import ROOT
from fixtures.project_parts import FT
from fixtures.workbooks import SECTIONS, blank, make, type_into
from report.project.read.read import read

EXAMPLE = ROOT / "projects" / "example"
CONDITIONS = ROOT / "projects" / "conditions"
INCH_M = 0.0254


def required(clearance):
    """A required separation [in], rounded up where a smaller one provided would print alike."""
    needed, given = (clearance[name] / INCH_M for name in ("required_m", "provided_m"))
    is_alike = needed > given and f"{needed:.1f}" == f"{given:.1f}"
    return f"{math.ceil(10 * needed - 1e-6) / 10 if is_alike else needed:.1f} in"


def sent(page, project, folder):
    """Open a copy of a project in a page."""
    shutil.copytree(project, folder, ignore=shutil.ignore_patterns("out"))
    page.set_input_files("#folder", folder)


@pytest.mark.nightly
def test_errors_are_listed_by_cell_beside_a_picture_of_the_row(page, tmp_path):
    project, name = tmp_path / "yours", "Arrays/A2/CG height"
    shutil.copytree(EXAMPLE, project, ignore=shutil.ignore_patterns("out"))
    book = type_into(project / "input.xlsx", {name: "low"})
    page.set_input_files("#folder", project)
    page.wait_for_selector("#problems tbody tr")
    where = page.locator("#problems tbody th").first.inner_text()
    assert where.startswith(cells.address(book, name))
    assert page.locator("#problems .is-faulty input").first.input_value() == "low"
    assert page.locator("#workspace").is_hidden()
    assert page.evaluate("document.activeElement.textContent") == "Errors in the workbook"
    page.click("text=Back to Distribution Warehouse")
    page.wait_for_selector("#problems", state="hidden")
    assert "Distribution Warehouse" in page.inner_text("h1")
    moved(page, "friction", 0.95)
    page.wait_for_url("**/#friction=0.95")
    at_rest(page)
    # Of a workbook alone the page says first that its records are missing.
    page.set_input_files("#files", EXAMPLE / "input.xlsx")
    page.wait_for_selector("#problems tbody tr")
    assert page.inner_text("#problems h2") == "The records were not uploaded"
    assert page.inner_text("#problems p").startswith("Only the workbook was uploaded.")


def edited(page):
    """Open the fields of the tables of the project."""
    page.get_by_role("button", name="Edit workbook").click()
    page.get_by_text("Arrays", exact=True).click()
    return page.get_by_label("Friction coefficient, Arrays!E9", exact=True)


@pytest.mark.nightly
def test_what_was_edited_stays_when_records_follow(page, tmp_path):
    sent(page, CONDITIONS, tmp_path / "small")
    page.wait_for_selector("h1:has-text('Small Warehouse')")
    page.get_by_role("button", name="New project").click()
    page.get_by_text("no array is entered").wait_for()
    page.get_by_role("button", name="Back to").click()
    assert page.get_by_role("region", name="Next step").is_hidden()  # that of the new one
    edited(page).fill("0.41")
    page.get_by_role("button", name="Fill in and check").click()
    page.wait_for_selector("#controls [type=number][placeholder=various]")
    page.set_input_files("#files", tmp_path / "small" / "records" / "RM1-x.csv")
    page.wait_for_selector("#busy:visible")
    page.wait_for_selector("#busy", state="hidden")
    assert edited(page).input_value() == "0.41"


@pytest.mark.nightly
def test_what_was_typed_stays_when_it_is_checked_again_before_the_filled_workbook_came(page):
    held = []
    page.get_by_role("button", name="New project").click()
    page.route("**/api/plan", lambda route: held.append(route))
    for label, text in (("project name is missing", "Shed"), ("project number is missing", "S-1")):
        page.get_by_label(label).fill(text)
        # The workbook is sent once its cells are filled in: the route is held by then.
        with page.expect_request("**/api/plan"):
            page.get_by_role("button", name="Fill in and check").click()
    for route in held:
        route.continue_()
    page.get_by_text("project number is missing").wait_for(state="detached")
    assert page.get_by_text("project name is missing").count() == 0
    assert page.get_by_text("prepared by is missing").count() == 1


@pytest.mark.nightly
def test_a_zip_with_two_errors_is_filled_in_one_after_the_other(page, tmp_path):
    project = shutil.copytree(CONDITIONS, tmp_path / "a", ignore=shutil.ignore_patterns("out"))
    cells = {"Arrays/A1/CG height": "low", "Arrays/A2/Slope": "steep"}
    type_into(project / "input.xlsx", cells)
    page.set_input_files("#files", shutil.make_archive(tmp_path / "sent", "zip", project))
    page.get_by_text("CG height is 'low'").wait_for()
    page.get_by_label("CG height is 'low'").fill("9")
    page.get_by_role("button", name="Fill in and check").click()
    page.get_by_text("CG height is 'low'").wait_for(state="detached")
    assert page.get_by_text("slope is 'steep'").is_visible()
    page.get_by_label("slope is 'steep'").fill("0.25")
    name, content = saved(page, page.get_by_role("button", name="Fill in and save").click)
    assert page.inner_text("h1").startswith("Small Warehouse")
    (tmp_path / name).write_bytes(content)
    assert read(tmp_path / name).project.arrays[0].cg_height_m == pytest.approx(9 * INCH_M)


@pytest.mark.nightly
def test_what_is_sent_is_told_before_the_server_answers_and_the_example_as_well(page, tmp_path):
    held = []
    page.route("**/api/upload", lambda route: held.append(route))
    sent(page, CONDITIONS, tmp_path / "conditions")
    page.wait_for_selector("#busy:has-text('Uploading and checking')")
    held[0].continue_()
    page.wait_for_selector("h1:has-text('Small Warehouse')")
    assert page.locator("#busy").is_hidden()
    page.click("#example")
    page.wait_for_selector("h1:has-text('Distribution Warehouse')")
    page.wait_for_selector("#busy", state="hidden")


@pytest.mark.nightly
def test_names_of_40_characters_are_cut_with_the_whole_as_a_tooltip(page, tmp_path):
    long = {name: f"{name} of the roof north of the expansion jt" for name in ("A1", "A2")}
    rows = {
        section: [dict(row) for row in SECTIONS[section]] for section in ("arrays", "clearances")
    }
    for row in (*rows["arrays"], *rows["clearances"]):
        row |= {key: long[row[key]] for key in ("id", "array", "object") if row.get(key) in long}
    make(tmp_path, **rows)
    page.set_input_files("#folder", tmp_path)
    page.wait_for_selector(f"#arrays [data-name='{long['A1']}']", state="attached")
    at_rest(page)
    assert page.locator("#clearances th[title]").first.get_attribute("title").count(" ") > 8
    for size in (DESKTOP, TABLET, PHONE):
        page.set_viewport_size(size)
        assert page.evaluate("document.body.scrollWidth <= innerWidth"), size
        name = page.locator("#arrays tbody .cut:visible").first
        assert name.evaluate("(one) => one.scrollWidth > one.clientWidth"), size


@pytest.mark.nightly
def test_six_arrays_under_seven_motions_print_in_two_pages(page, tmp_path):
    folder = shutil.copytree(EXAMPLE, tmp_path / "six", ignore=shutil.ignore_patterns("out"))
    # A3 becomes four.
    corners = itertools.product((200, 278), (30, 108))
    like = (3, "degrees", 0.4, "EX-FT-1, example values", "Ballasted tray, 10 deg tilt")
    quarters = [
        (f"A{count}", *like, 30_900, 9, 40, x, x + 72, y, y + 72, 270)
        for count, (x, y) in enumerate(corners, start=3)
    ]
    gaps = [
        ("A4", "PV-OLD", "upslope", 72),
        ("A5", "EAST", "cross-slope", 120),
        ("A6", "EAST", "cross-slope", 120),
    ]
    gaps += [("A3", "A4", "upslope", 72), ("A5", "A6", "upslope", 72)]
    gaps += [("A3", "A5", "cross-slope", 72), ("A4", "A6", "cross-slope", 72)]
    tables = {"Arrays": ("BCDEFGKLMNOPQR", 10, quarters), "Clearances": ("BCDE", 12, gaps)}
    cells = {
        f"{sheet}!{column}{number}": value
        for sheet, (columns, first, rows) in tables.items()
        for number, row in enumerate(rows, start=first)
        for column, value in zip(columns, row, strict=True)
    }
    type_into(folder / "input.xlsx", cells)
    page.set_input_files("#folder", folder)
    page.wait_for_selector("#arrays [data-name=A6]", state="attached")
    at_rest(page)
    assert len(PdfReader(io.BytesIO(page.pdf(prefer_css_page_size=True))).pages) == 2


@pytest.mark.nightly
def test_real_files_that_are_dragged_onto_the_page_are_opened(page, tmp_path):
    folder = tmp_path / "small"
    shutil.copytree(CONDITIONS, folder, ignore=shutil.ignore_patterns("out"))
    (folder / "roof.dxf").write_text("no drawing")
    drag = page.context.new_cdp_session(page)
    for kind in ("dragEnter", "dragOver", "drop"):
        files = {"items": [], "files": [str(folder)], "dragOperationsMask": 1}
        where = {"x": 500, "y": 400}
        drag.send("Input.dispatchDragEvent", {"type": kind, **where, "data": files})
        assert page.locator("#drop").is_visible() == (kind != "drop")
    page.wait_for_selector("h1:has-text('Small Warehouse')")
    at_rest(page)
    said = page.inner_text("#drawing")
    assert said.startswith("roof.dxf: ")
    assert page.locator("#drawing button").count() == 0
    page.click("#example")
    page.wait_for_selector("#drawing", state="hidden")


@pytest.mark.nightly
def test_the_plan_is_read_from_a_drawing_beside_the_workbook(page, tmp_path):
    folder = tmp_path / "new"
    folder.mkdir()
    blank(folder / "input.xlsx")
    sketch = Sketch("R2018")
    sketch.ring("PV MODULES", BOX_FT, "A2")
    sketch.ring("X-9", ROOF_FT)
    sketch.saved(folder)
    page.set_input_files("#folder", folder)
    page.wait_for_selector("#drawing .layers")
    assert page.inner_text("#steps [aria-current]") == "Plan"
    assert page.locator("#no-motions").is_hidden()
    kinds = page.locator("#drawing td select")
    assert [each.input_value() for each in kinds.all()] == ["array", "not read"]
    kinds.last.select_option("roof")
    page.click("text=Fill in the plan")
    page.wait_for_selector("text=The plan is filled in from")
    assert page.locator("#steps").is_hidden()  # the plan is there; cells of other sheets are not
    name, content = saved(page, lambda: page.click("text=Save filled workbook"))
    assert name == "input.xlsx"
    (tmp_path / name).write_bytes(content)
    inputs = read(tmp_path / name).inputs
    assert [row["id"] for row in inputs["arrays"]] == ["A2"]
    assert inputs["roof"][0]["x_to_m"] == pytest.approx(240 * FT, abs=1e-6)
    assert {row["layer"]: row["kind"] for row in inputs["layers"]}["X-9"] == "roof"


@pytest.mark.nightly
def test_a_second_drawing_is_asked_for_its_unit_and_what_it_moved_is_listed(page, tmp_path):
    folder = tmp_path / "revised"
    folder.mkdir()
    book = blank(folder / "input.xlsx")
    stdout_of("plan", "read", plan_of(tmp_path, FT), book)
    plan_of(folder, INCH_M, unit="in")
    page.set_input_files("#folder", folder)
    page.wait_for_selector("#drawing .field")
    page.click("text=Fill in the plan")
    page.wait_for_selector("#error:has-text('Unit on the page): ft')")
    page.get_by_label("Unit of the drawing").select_option("in")
    page.click("text=Fill in the plan")
    page.wait_for_selector("text=The plan is filled in from")
    assert "times as large" in page.locator("#drawing .printed li").first.inner_text()


def plan_of(folder, unit_m, unit="ft"):
    """A drawing of a roof and an array of numbers that are of a unit [m]."""
    sketch = Sketch(unit=unit)
    for layer, points, name in (("ROOF-OUTLINE", ROOF_FT, ""), ("ARRAY", BOX_FT, "A1")):
        sketch.ring(layer, [(x * unit_m / FT, y * unit_m / FT) for x, y in points], name)
    return sketch.saved(folder)


@pytest.mark.nightly
def test_the_package_the_workbook_and_the_page_agree(page, tmp_path):
    # Its package is made in half the time of the example's, with clearances OK and NG.
    sent(page, CONDITIONS, tmp_path / "conditions")
    page.wait_for_selector("h1:has-text('Small Warehouse')")
    at_rest(page)
    of_the_workbook = numbers(page, "arrays", 3)
    moved(page, "friction", 0.9)  # with less, no route is permitted
    moved(page, "intensity", 1.1)
    page.wait_for_url("**/#friction=0.9&intensity=1.1")
    at_rest(page)
    assert numbers(page, "arrays", 3) != of_the_workbook
    name, bytes_ = saved(page, lambda: page.click("#save-workbook"))
    book = openpyxl.load_workbook(io.BytesIO(bytes_))
    mus = [cell.value for row in book["Arrays"].iter_rows() for cell in row]
    assert name.endswith(".xlsx")
    assert 0.45 in mus
    page.click("#make-package")
    page.click("text=Cancel")
    page.wait_for_selector("text=The package was canceled.")
    page.click("#make-package")
    page.wait_for_selector("#package-status progress")
    page.wait_for_selector("#package-status .made", timeout=150_000)
    _, made = saved(page, lambda: page.click("text=results.json"))
    results = json.loads(made)
    assert page.inner_text("#verdict .tag") == results["verdict"]
    design = [f"{array['design_m'] / INCH_M:.1f} in" for array in results["arrays"]]
    assert numbers(page, "arrays", 3) == design
    made = results["clearances"]
    assert {item["verdict"] for item in made} == {"NG", "OK"}
    assert numbers(page, "clearances", 4) == list(map(required, made))
    assert numbers(page, "clearances", 6) == [item["verdict"] for item in made]
    name, pdf = saved(page, lambda: page.click("text=Calc package"))
    assert name == "calc-package.pdf"
    summary = "".join(sheet.extract_text() for sheet in PdfReader(io.BytesIO(pdf)).pages[:6])
    assert all(value.removesuffix(" in") in summary for value in design)
    moved(page, "friction", 0.95)
    assert "before the last change" in page.inner_text("#package-status")


NEEDED = {
    "project name is missing": "Shed", "project number is missing": "S-1",
    "prepared by is missing": "RG", "date is missing": "2026-03-05", "revision is missing": "0",
    "rule set is missing": "ASCE 7-16", "risk category is missing": "II",
    "S_DS is missing": "1.0", "seismic design category is missing": "D",
    "number of stories is missing": "1", "structure height h is missing": "24",
    "roof height z is missing": "24",
    **{f"{name}, Arrays!{cell}": text for name, cell, text in (
        ("ID", "B8", "A1"), ("Slope", "C8", "1"), ("Slope unit", "D8", "d"),
        ("Friction coefficient", "E8", "0.5"), ("Construction", "G8", "Tray"),
        ("Weight [lb]", "K8", "10000"), ("CG height [in]", "L8", "9"),
        ("Support spacing [in]", "M8", "40"), ("x from [ft]", "N8", "5"), ("x to [ft]", "O8", "25"),
        ("y from [ft]", "P8", "5"), ("y to [ft]", "Q8", "30"),
        ("Downslope direction [deg]", "R8", "270"),
    )},
}  # fmt: skip
"""What a new project needs, in the order of its fields."""


@pytest.mark.nightly
def test_a_new_project_is_typed_and_its_package_made_with_the_keyboard_alone(page):
    def press(name):
        tab_to(page, page.get_by_role("button", name=name).first)
        page.keyboard.press("Enter")

    def enter(label, text):
        tab_to(page, page.get_by_label(label, exact=True).first)
        page.keyboard.type(text)

    press("New project")
    page.get_by_text("no array is entered").wait_for()
    for label, text in NEEDED.items():
        enter(label, text)
    press("Fill in and check")
    page.get_by_role("heading", name="Shed").wait_for()
    at_rest(page)
    tab_to(page, page.get_by_role("slider", name="SDS"))
    page.keyboard.press("ArrowLeft")
    page.wait_for_url("**/#s_ds=0.98")
    at_rest(page)
    press("Make package")
    page.get_by_text("Calc package").wait_for(timeout=150_000)
    _, made = saved(page, lambda: press("results.json"))
    results = json.loads(made)
    assert results["s_ds_g"] == pytest.approx(0.98)
    (array,) = results["arrays"]
    assert numbers(page, "arrays", 2) == [f"{array['design_m'] / INCH_M:.1f} in"]


@pytest.mark.nightly
def test_two_tabs_have_two_projects_and_an_address_brings_back_its_own(page, address, tmp_path):
    moved(page, "friction", 0.9)
    page.wait_for_url("**/#friction=0.9")
    at_rest(page)
    of_the_example, shown = page.url, numbers(page, "arrays", 3)
    other = page.context.new_page()
    opened(other, address)
    sent(other, CONDITIONS, tmp_path / "other")
    other.wait_for_selector("h1:has-text('Small Warehouse')")
    at_rest(other)
    other.keyboard.press("Control+z")  # of another project: nothing
    moved(page, "slope", 0.5)
    at_rest(page)
    assert page.locator("#error").is_hidden()
    page.go_back()
    at_rest(page)
    page.reload()
    at_rest(page)
    assert (page.url, numbers(page, "arrays", 3)) == (of_the_example, shown)
    of_conditions, as_typed = other.url, numbers(other, "arrays", 2)
    # Back to the project that the tab had before, forward again, and by a link.
    other.click("#zoom-in")
    other.go_back()
    other.wait_for_selector("h1:has-text('Distribution Warehouse')")
    at_rest(other)
    assert not other.locator("#plan-drawing.is-zoomed").count()
    other.go_forward()
    other.wait_for_selector("h1:has-text('Small Warehouse')")
    at_rest(other)
    assert (other.url, numbers(other, "arrays", 2)) == (of_conditions, as_typed)
    other.goto(of_the_example)
    other.wait_for_selector("h1:has-text('Distribution Warehouse')")
    at_rest(other)
    assert numbers(other, "arrays", 3) == shown


@pytest.mark.nightly
def test_an_address_of_a_server_that_ended_gets_its_values_once_its_project_is_open(
    page, browser, tmp_path
):
    sent(page, CONDITIONS, tmp_path / "conditions")
    page.wait_for_selector("h1:has-text('Small Warehouse')")
    moved(page, "friction", 0.9)
    page.wait_for_url("**/#friction=0.9")
    at_rest(page)
    shown = numbers(page, "arrays", 2)
    with served() as again, quiet_page(browser) as other:
        where = urlsplit(again[0])._replace(path=urlsplit(page.url).path, fragment="friction=0.9")
        other.goto(where.geturl())
        other.wait_for_selector("#other-project:visible", timeout=60_000)
        assert "is not open here" in other.inner_text("#other-project")
        assert other.inner_text("#changed") == "With the values of the workbook"
        other.set_input_files("#folder", tmp_path / "conditions")
        other.wait_for_selector("h1:has-text('Small Warehouse')")
        at_rest(other)
        assert other.locator("#other-project").is_hidden()
        assert other.url.endswith(urlsplit(page.url).path + "#friction=0.9")
        assert numbers(other, "arrays", 2) == shown


@pytest.mark.nightly
def test_clearances_that_the_plan_lacks_are_added_by_a_button(page, tmp_path):
    assert not page.is_visible("#add-clearances")
    make(tmp_path / "roof", clearances=[], objects=SECTIONS["objects"][:1])
    page.set_input_files("#folder", tmp_path / "roof")
    page.wait_for_selector("#add-clearances", timeout=60_000)
    assert page.inner_text("#steps [aria-current]") == "Clearances"
    page.click("#add-clearances")
    page.wait_for_selector("#steps", state="hidden", timeout=60_000)
    at_rest(page)
    assert page.locator("#clearances tbody tr").count() == 2
    name, bytes_ = saved(page, lambda: page.click("#save-workbook"))
    (tmp_path / name).write_bytes(bytes_)
    assert [row.object for row in read(tmp_path / name).project.clearances] == ["A2", "RTU-1"]


@pytest.mark.parametrize("tab", ["plan", "contour"])
@pytest.mark.nightly
def test_a_drawing_is_saved_as_svg_and_png_once_it_is_there(page, tab):
    held = []
    page.route(f"**/static/{tab}.js", lambda route: held.append(route))
    page.click(f"#tab-{tab}")

    def save():
        page.click("#save-svg")
        for script in held:
            script.continue_()

    name, vector = saved(page, save)
    assert len(held) == (tab != "plan")
    assert name.endswith(f"{tab}.svg")
    drawn = list(ElementTree.fromstring(vector).iter())
    texts = [each.text for each in drawn if each.tag.endswith("text")]
    assert {"plan": "PV-OLD", "contour": "Slope [deg]"}[tab] in texts
    # A reader that stretches a drawing would stretch its lines.
    stretched = (each for each in drawn if each.get("preserveAspectRatio") == "none")
    assert [each.get("viewBox") for each in stretched] == [None] * (tab == "contour")
    lines = {each.get("stroke-width") for each in drawn if "isoline" in each.get("class", "")}
    assert lines == ({"1", "1.8"} if tab == "contour" else set())
    name, bytes_ = saved(page, lambda: page.click("#save-png"))
    wide, tall = (int.from_bytes(bytes_[at : at + 4], "big") for at in (16, 20))
    box = page.locator(f"#{tab}").bounding_box()
    assert (wide, tall) == pytest.approx((2 * box["width"], 2 * box["height"]), abs=2)


@pytest.mark.nightly
def test_an_address_is_good_once_restores_the_values_and_the_page_gives_another(page, browser):
    moved(page, "slope", 1.0)
    page.wait_for_url("**/#slope=1")
    at_rest(page)
    shown = numbers(page, "arrays", 3)
    page.evaluate("() => { navigator.clipboard.writeText = () => Promise.reject(); }")
    page.click("#copy-link")
    link = page.locator("#taken input").input_value()
    with quiet_page(browser) as other:
        other.goto(link)
        at_rest(other)
        assert other.url == page.url  # the token has left the address
        assert other.locator("#slider-slope").input_value() == "1"
        assert other.context.cookies() == []
        other.reload()
        at_rest(other)
        assert other.locator("#slider-slope").input_value() == "1"
        assert numbers(other, "arrays", 3) == shown
        other.get_by_label("Slope: reset to the workbook value").click()
        other.wait_for_url(re.compile(r"/$"))
        assert numbers(other, "arrays", 3) != shown
    for used in (link, link.partition("?")[0]):
        with quiet_page(browser) as third:
            assert third.goto(used).status == (403 if used == link else 200)
            third.wait_for_selector("#no-key:visible")
            assert "press Enter in its terminal" in third.inner_text("#no-key")
            assert third.inner_text("h1") == "This tab needs a new address"
            assert third.locator("#workspace, .open").evaluate_all(
                "(all) => all.every((one) => !one.checkVisibility())"
            )
