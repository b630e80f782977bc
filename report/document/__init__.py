"""What documents are made of: tables, blocks and templates. Owns no content of a page."""
