"""A project: its plain models, what Excel knows of them, and how they are read and written."""
