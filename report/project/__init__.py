"""A project: its plain models, their Excel layout, reading and writing."""
