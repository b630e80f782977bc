"""Sources of a package: files, hashes, software. Read `package_sources`."""
