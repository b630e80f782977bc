"""The calculation package as HTML. Read `html`."""
