"""The project and its revisions, as the cover prints them."""

from __future__ import annotations

import datetime as dt

from report.project.model.choices import RequiredText, Text, UnitsFirst
from report.project.model.frozen import Frozen


class Project(Frozen):
    """Project data."""

    name: RequiredText
    number: RequiredText
    client: Text = ""
    address: Text = ""
    prepared_by: RequiredText
    checked_by: Text = ""
    firm: Text = ""
    firm_contact: Text = ""
    license: Text = ""
    date: dt.date
    revision: RequiredText
    units_first: UnitsFirst = UnitsFirst.US
    plan_number: Text = ""
    plan_date: dt.date | None = None
    drawing_confirmed_by: Text = ""
    drawing_confirmed_date: dt.date | None = None
    drawing_covered: Text = ""


class Revision(Frozen):
    """One line of the revision block."""

    revision: RequiredText
    date: dt.date
    description: RequiredText
    by: Text = ""
