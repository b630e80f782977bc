"""The options of each command, in a module with those beside it; importing one loads click alone.

A command imports the module that does its work, in `report.cli`, where it runs.
"""
