"""Metadata state the same however they are written, and what they state otherwise is found."""

from pypdf.generic import DecodedStreamObject

from report.proof.metadata import PRODUCER, facts, is_date

NAMES = (
    'xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns:pdf="http://ns.adobe.com/pdf/1.3/"'
    ' xmlns:dc="http://purl.org/dc/elements/1.1/" xmlns:xmp="http://ns.adobe.com/xap/1.0/"'
)
TITLE = '<dc:title><rdf:Alt><rdf:li xml:lang="x-default">Roof</rdf:li></rdf:Alt></dc:title>'


def stated(inside):
    stream = DecodedStreamObject()
    stream.set_data(f"<rdf:RDF {NAMES}>{inside}</rdf:RDF>".encode())
    return facts(stream)


def test_an_attribute_states_what_an_element_states():
    one = f'<rdf:Description pdf:Producer="A"/><rdf:Description>{TITLE}</rdf:Description>'
    two = f"<rdf:Description>{TITLE}<pdf:Producer> A </pdf:Producer></rdf:Description>"
    assert stated(one) == stated(two)
    assert (PRODUCER, "A") in stated(one)


def test_another_title_and_another_property_are_stated():
    same = stated(f"<rdf:Description>{TITLE}</rdf:Description>")
    assert stated(f"<rdf:Description>{TITLE.replace('Roof', 'Dam')}</rdf:Description>") != same
    assert stated(f'<rdf:Description xmp:Label="OK">{TITLE}</rdf:Description>') != same


def test_the_date_of_a_rewriting_does_not_count_and_a_word_in_its_place_does():
    assert stated('<rdf:Description xmp:ModifyDate="2026-11-23T21:26:02+00:00"/>') == stated("")
    assert stated('<rdf:Description xmp:ModifyDate="Approved"/>') != stated("")
    assert is_date("D:20251120000000Z")
    assert is_date("D:20251120000000+01'00'")
    assert not is_date(5)
