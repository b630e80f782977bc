"""The formats of networks and databases of records, and the order in which they are asked.

Each knows its own files and no other format. Read one, such as `peer`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.formats.networks import cosmos, csmip, geonet, keyed, knet, peer, seed, smc

if TYPE_CHECKING:
    from solver.formats.reader import Format

# GeoNet before CSMIP, whose first line is similar, and PEER before headings of `KEY: value`.
NETWORKS: tuple[Format, ...] = (seed, cosmos, geonet, csmip, smc, knet, peer, keyed)
