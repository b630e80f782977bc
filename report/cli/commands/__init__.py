"""The options of each command, in a module with related ones; importing one loads only click.

A command imports the module that does its work, in `report.cli`, when it runs.
"""
