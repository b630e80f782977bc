"""Output of `roofslip new`: a workbook and the folder of its records."""

from __future__ import annotations

import os
from contextlib import ExitStack
from pathlib import Path

import click

from report.cli.input_errors import input_errors
from report.project.model.choices import UnitsFirst
from report.project.write.template import example_files, write_template
from report.text.command_line import command
from solver.errors import InputError
from solver.file_checks import check_plain
from solver.file_writing import add_folder, write_all


def new_project(folder: Path, units: str, *, is_example: bool, is_study: bool) -> None:
    """Write a workbook and its records folder, and print the next step."""
    with input_errors(folder):
        path = _write(folder, UnitsFirst(units), is_example=is_example, is_study=is_study)
    if is_example:
        click.echo(f"{path}: a complete example, a warehouse with three arrays and seven motions;")
        click.echo(f"to create its package, run: {command('report', folder)}")
        return
    click.echo(f"{path}: fill in the yellow cells, put the roof motions in {folder / 'records'},")
    click.echo(f"then run: {command('study' if is_study else 'check', folder)}")


def _write(folder: Path, units: UnitsFirst, *, is_example: bool, is_study: bool) -> Path:
    """Write a workbook and its records folder; never overwrite a workbook or a record."""
    path = folder / "input.xlsx"
    # A dangling link as well, which `exists` does not see.
    if os.path.lexists(path):
        raise InputError(f"{path}: already exists; choose another folder, or move the file")
    records = folder / "records"
    # Through a link at records/, the example would be written to wherever that leads.
    check_plain(records, folder, is_folder=True)
    try:
        if is_example and records.is_dir() and any(records.iterdir()):
            raise InputError(f"{records}: is not empty; choose another folder")
        with ExitStack() as undo:
            add_folder(records, undo)
            if is_example:
                write_all(example_files(units), folder)
            elif is_study:
                from report.study.read_study import write_study  # an extra

                write_study(path, units=units)
            else:
                write_template(path, units=units)
            # All is written: only now nothing is taken back.
            undo.pop_all()
    except OSError as error:
        raise InputError(
            f"{path}: cannot be written ({error.strerror}); choose another folder"
        ) from error
    return path
