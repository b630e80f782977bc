"""What a design value follows from: rule set, routes, arrays, separations, friction."""
