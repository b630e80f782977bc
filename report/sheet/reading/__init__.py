"""From a workbook of a stranger to a checked project: opened, found, converted, checked."""
