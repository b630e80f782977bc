"""What a package was computed from: files, hashes, software. Read `package_sources`."""
