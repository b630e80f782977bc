"""From ground to roof: an elastic building of a few modes. Read `roof`."""
