"""The basis of a design value: rule set, procedures, arrays, separations, friction."""
