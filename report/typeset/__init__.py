"""HTML to PDF, and equations to SVG. Read `pdf`."""
