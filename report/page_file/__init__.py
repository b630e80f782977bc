"""calc-package.html: the package as one file for a browser. Read `page`."""
