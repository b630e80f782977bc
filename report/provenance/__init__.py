"""What a package was computed from: files, hashes, software. Read `files`, then `software`."""
