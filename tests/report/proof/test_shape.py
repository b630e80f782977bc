"""What one PDF is built of and another one is not is found, at the nearest place."""

import io

import pikepdf

from report.proof.package import reader
from report.proof.shape import parts, strangers


def written(change=lambda pdf: None):
    out = io.BytesIO()
    with pikepdf.new() as pdf:
        for _ in range(2):
            pdf.add_blank_page(page_size=(612, 792))
        change(pdf)
        pdf.save(out)
    return reader(out.getvalue())


def strange(change):
    return strangers(written(change), parts(written()))


def test_numbers_are_no_part_and_what_is_there_already_is_no_stranger():
    def change(pdf):
        pdf.pages[0].obj.MediaBox = [0, 0, 1, 1]
        pdf.add_blank_page()

    assert strange(change) == []


def test_a_new_key_is_told_by_the_sheet_that_has_it():
    def change(pdf):
        pdf.pages[1].obj.Rotate = 90

    assert strange(change) == ["sheet 2 /Rotate"]


def test_a_known_key_that_holds_another_kind_or_name_is_told():
    def change(pdf):
        pdf.pages[0].obj.MediaBox = pikepdf.Name.Large
        pdf.Root.Lang = pikepdf.Dictionary(Type=pikepdf.Name.Page)

    assert strange(change) == ["sheet 1 /MediaBox", "document /Lang"]


def test_below_a_stranger_nothing_more_is_told_however_deep_it_goes():
    def change(pdf):
        below = pdf.make_indirect(pikepdf.Array())
        for _ in range(20_000):
            below = pdf.make_indirect(pikepdf.Array([below]))
        pdf.Root.Deep = below

    assert strange(change) == ["document /Deep"]
