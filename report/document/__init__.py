"""Building blocks of documents: tables, blocks and templates. Contains no content of a page."""
