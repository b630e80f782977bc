"""Guesses the content of a layer from its name.

`PV_MODULES` has arrays, `M-HVAC-RTU` fixed objects, `A-ANNO-DIMS` nothing that is read; of `0`
nobody knows.
"""

from __future__ import annotations

import re

from report.drawing_read.roof_drawing import RoofDrawing
from report.project.model.choices import LayerKind

# Names, in capitals with hyphens for blanks and underscores, and what they mean; the first that
# fits counts.
#
# The fields ANNO, DIMS, IDEN, NPLT, PATT, TTLB (annotation), ROOF, OTLN (outline), EQPM (equipment)
# and their order are of the AIA CAD Layer Guidelines (U.S. National CAD Standard), the one letter
# at the end is its status. The names with `pvc` are those of PVCAD (PVComplete, help article "Layer
# Names"). SOLR, PV and the other words are taken by what they mean: no public list was found that
# has them, nor one of the layers that HelioScope, Aurora and PVcase export.
_PATTERNS: tuple[tuple[re.Pattern[str], LayerKind], ...] = (
    (re.compile(r"-(ANNO|DIMS|IDEN|NPLT|PATT|TTLB)(-|$)"), LayerKind.NOT_READ),
    (re.compile(r"^PVC(SETBACK|INSTALLATIONAREA|SHADOW|WINDZONES)$"), LayerKind.NOT_READ),
    (
        re.compile(
            r"^(A-)?ROOF(-(OTLN|OUTLINE|BOUNDARY|PERIMETER))?(-[A-Z])?$|^PVCROOF$|^BUILDING-(OUTLINE|FOOTPRINT)$"
        ),
        LayerKind.ROOF,
    ),
    (re.compile(r"PARAPET"), LayerKind.EDGE_WITH_PARAPET),
    (
        re.compile(
            r"-SOLR(-|$)|(^|-)(PV|SOLAR)-?(MODULE|PANEL|ARRAY)S?(-|$)|^PVCLAYOUT$"
            r"|^(PV|SOLAR)?-?(MODULES?|PANELS?|ARRAYS)$|^(PV|SOLAR)$"
        ),
        LayerKind.ARRAY,
    ),
    (
        re.compile(
            r"-EQPM(-|$)|^PVCOBSTRUCTION$|(^|-)(OBSTRUCTION|OBSTACLE|RTU|SKYLIGHT|VENT|CHIMNEY)S?(-|$)"
            r"|(^|-)(HVAC|HATCH(ES)?|KEEP-?OUTS?|EQUIPMENT|MECH-EQUIP|EXHAUST-FANS?)$"
            r"|^(MECH(ANICAL)?|ROOFTOP|HVAC|AC)-UNITS?$"
        ),
        LayerKind.FIXED,
    ),
)


def proposed(layer: str) -> LayerKind | None:
    """Return the likely content of a layer; None if its name does not tell."""
    # A reference that is bound to the drawing has its name before that of the layer.
    name = re.sub(r"[ _-]+", "-", re.split(r"[|$]", layer)[-1].upper())
    return next((kind for pattern, kind in _PATTERNS if pattern.search(name)), None)


def drawn_on(drawing: RoofDrawing, layer: str) -> str:
    """Return the entities on a layer, such as `3 LWPOLYLINE, 2 TEXT`."""
    counts = sorted(
        (kind, count) for (name, kind), count in drawing.counts.items() if name == layer
    )
    return ", ".join(f"{count} {kind}" for kind, count in counts)
