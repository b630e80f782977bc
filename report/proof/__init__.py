"""A package held against its own input. Read `package`, `updates`, then `verdict`."""
