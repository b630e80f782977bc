"""From ground to roof through an elastic building of a few modes. Read `roof`."""
