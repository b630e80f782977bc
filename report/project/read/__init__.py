"""From an untrusted workbook to a checked project: opened, found, converted, checked."""
