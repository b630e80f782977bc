"""The layers of a roof plan, in DXF and on paper."""

from __future__ import annotations

from enum import Enum


class Layer(Enum):
    """A layer: its name, its color by AutoCAD's index, and whether its lines are dashed.

    Names in the form of the U.S. National CAD Standard: discipline S, structural, because the plan
    is of seismic displacement and not of the solar installation, then groups of four letters. Not
    every group is one of the standard's list.
    """

    OUTLINE = ("S-ROOF-OTLN", 8, False)
    EDGE = ("S-ROOF-EDGE", 7, True)
    PARAPET = ("S-ROOF-PRPT", 7, False)
    BARE_EDGE = ("S-ROOF-EDGE-BARE", 1, True)
    ARRAY = ("S-SOLR-ARRY", 5, False)
    UNLIKE = ("S-SOLR-ARRY-UNLK", 9, False)
    OBJECT = ("S-EQPM", 8, False)
    CLEARANCE = ("S-ANNO-DIMS", 3, False)
    CLEARANCE_NG = ("S-ANNO-DIMS-FAIL", 1, False)
    CLEARANCE_NONE = ("S-ANNO-DIMS-NONE", 2, False)
    DESIGN = ("S-SOLR-ENVL-DSGN", 6, True)
    RUNS = ("S-SOLR-ENVL-RUNS", 30, False)
    NOTES = ("S-ANNO-NOTE", 7, False)
    NORTH = ("S-ANNO-NRTH", 7, False)
    SCHEDULE = ("S-ANNO-SCHD", 7, False)
    TITLE = ("S-ANNO-TTLB", 7, False)
    WINDOW = ("S-ANNO-NPLT", 8, False)  # of the plan in its layout; not plotted

    @property
    def title(self) -> str:
        """Its name."""
        return self.value[0]
