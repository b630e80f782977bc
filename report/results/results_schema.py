"""The JSON schema of results.json: its models with their docstrings, its input with its notes.

Read `schema`.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Mapping
from functools import cache
from itertools import pairwise
from typing import Any

from pydantic import BaseModel
from pydantic.json_schema import GenerateJsonSchema

from report.project.model import ProjectInput
from report.project.model.values import Frozen
from report.project.workbook import SECTION, SECTIONS
from report.results.results_model import Results


def schema() -> dict[str, Any]:
    """Return the JSON schema of results.json."""
    return Results.model_json_schema(schema_generator=_Described)


class _Described(GenerateJsonSchema):
    """The JSON schema in which each field has a description."""

    def model_schema(self, schema: Any) -> dict[str, Any]:
        """Return the schema of a model, each field with its docstring or that of a base class."""
        written: dict[str, Any] = super().model_schema(schema)
        model = schema["cls"]
        if issubclass(model, Frozen):
            return _with_notes(written, model)
        texts = docstrings(model)
        for name in texts.keys() & written["properties"].keys():
            written["properties"][name].setdefault("description", texts[name])
        return written

    def field_is_present(self, field: Any) -> bool:
        """Return whether a field is written: of an input, what no cell has is not."""
        return not field.get("serialization_exclude")


def _with_notes(written: dict[str, Any], model: type[Frozen]) -> dict[str, Any]:
    """Return the schema of a model of the workbook with the headings and notes of its inputs."""
    if model is ProjectInput:
        for name, field in written["properties"].items():
            field["description"] = SECTION[name].note
    for section in SECTIONS:
        for entry in section.entries if section.model is model else ():
            field = written["properties"][entry.name]
            field["title"] = entry.heading
            field["description"] = entry.note
    return written


@cache
def docstrings(model: type[BaseModel]) -> Mapping[str, str]:
    """Return the docstrings of the fields that a model and those it extends have."""
    # As `use_attribute_docstrings` of pydantic, which takes its time whenever a model is imported.
    (definition,) = ast.parse(inspect.getsource(model)).body
    assert isinstance(definition, ast.ClassDef)
    texts: dict[str, str] = {}
    for base in model.__bases__:
        texts |= docstrings(base) if getattr(base, "model_fields", None) else {}
    for field, text in pairwise(definition.body):
        match field, text:
            case ast.AnnAssign(target=ast.Name(id=name)), ast.Expr(value=ast.Constant(value=said)):
                texts[name] = " ".join(str(said).split())
    return texts
