"""Groups records of a folder into motions: two horizontal components and a vertical one.

RM1-x.csv, RM1-y.csv and RM1-z.csv are the motion RM1.

Components are identified by the heading of a channel or the end of its file name, by time step,
length and start time; ambiguous sets are skipped with the reason, never guessed. Read `sets_of`.
"""

from __future__ import annotations

import datetime as dt
import math
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from report.motions.record_reading import BAR, MAX_BYTES
from report.motions.stored import MOST_FILES
from report.text.aligned import aligned
from solver.errors import InputError
from solver.formats import MotionFile, read_motion_file

# Of an ID.
MOST_NAME = 40
# Part by which components may differ in length: those of one recording often end apart.
LENGTHS_WITHIN = 0.05
# Largest difference of the start times of components: some headings print whole seconds.
STARTS_WITHIN = dt.timedelta(seconds=1)

_UP, _DOWN, _AZIMUTH = "up", "down", "azimuth"
# Hidden files, locks of Office, and what macOS adds to a zip.
_HIDDEN = re.compile(r"/(\.|~\$|__MACOSX/)")
_SPELLED = {
    (_UP, 0): ("up", "u", "ud", "u-d", "v", "ver", "vrt", "vert", "vertical", "z"),
    (_DOWN, 0): ("dn", "dwn", "down"),
    ("xy", 0): ("x",), ("xy", 90): ("y",), ("12", 0): ("h1", "1"), ("12", 90): ("h2", "2"),
    ("en", 0): ("e", "ew", "e-w", "we"), ("en", 90): ("n", "ns", "n-s"),
    ("en", 180): ("w",), ("en", 270): ("s",),
    ("lt", 0): ("l", "long", "longitudinal", "r", "radial"),
    ("lt", 90): ("t", "tran", "trans", "transverse"),
    ("fn", 0): ("fn",), ("fn", 90): ("fp",),  # normal and parallel to the fault
}  # fmt: skip
# A word for the vertical anywhere in a name.
VERTICAL = re.compile(rf"(?<![a-z])({'|'.join(_SPELLED[_UP, 0])})(?![a-z]|\.[a-z])", re.IGNORECASE)

_NAMED: dict[str, tuple[str, int]] = {}
for _component, _words in _SPELLED.items():
    _NAMED |= dict.fromkeys(_words, _component)
# Of SEED: network, station, location (whose digits are no azimuth) and channel.
_IDENTITY = re.compile(r"([a-z0-9]+\.[a-z0-9]+\.[a-z0-9]*)\.([befhs][gln])([enz12])")
# Of SEED, after band and instrument; of KiK-net, before the number of the sensor.
_WITHIN = re.compile(r"([befhs][gln])([enz12])|(ns|ew|ud)(\d)")
_BEARING = re.compile(r"([ns])(\d{1,2})([ew])")
_CHANNEL = re.compile(r"\b(?:(?:sta|rcrdr)\s+)?cha?nn?(?:el)?\s*+(?::\s*)?\d+\s*:?", re.IGNORECASE)
_VOLUME = re.compile(r"\.v([12])[a-z]?$", re.IGNORECASE)
_CHANNEL_OF_NAME = re.compile(r"[-_. ]?cha?nn?(?:el)?[-_ ]?\d+", re.IGNORECASE)
_NOISE = re.compile("comp(onent)?|deg|axis|accelerometer|longitudinal|transverse|vertical")
_END = re.compile(
    r"(.*?)(?:(?:^|(?<![-_. ])[-_. ]+)(u-d|n-s|e-w|[a-z]+\d?|[ns]\d+[ew]|\d\d\d?)|(?<!\d)(\d{3}))",
    re.IGNORECASE,
)
_MARKS = "-_. "
_FIELD = re.compile(rf"[^{_MARKS}]+")
_GLUED_ENDS = re.compile("...$"), re.compile("..$")
_GLUED = re.compile(r"(.+?)(dwn|vrt|vert|[ns]\d\d[ew])", re.IGNORECASE)


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidate:
    """A channel of a file as a component of a motion."""

    file: str  # its path from the folder
    channel: str  # empty where the file has one
    format: str
    dt_s: float
    npts: int
    start: dt.datetime | None  # None where the heading has none
    family: str  # of names for components, one of `_SPELLED` or azimuths
    degrees: int  # within the family
    motion: tuple[str, str]  # what names the motion: the file without the component, the heading

    @property
    def name(self) -> str:
        """Its name relative to the folder."""
        return f"{self.file} {BAR} {self.channel}" if self.channel else self.file

    @property
    def taken_for(self) -> str:
        """Its component according to heading or name."""
        if not self.is_horizontal:
            return f"vertical, positive {self.family}"
        if self.family == _AZIMUTH:
            return f"horizontal {self.degrees} deg"
        words = _SPELLED.get((self.family, self.degrees), (self.degrees,))
        return f"horizontal {words[0]}"

    @property
    def is_horizontal(self) -> bool:
        """Whether it is neither up nor down."""
        return self.family not in (_UP, _DOWN)


# The channels of x, y and z by the name of the motion.
Sets = dict[str, Sequence[Candidate]]

# What was not taken, and why.
Left = tuple[str, str]

_Clear = tuple[str, str, list[Candidate]]  # name, longer name, channels


def sets_of(
    folder: Path,
    units: str = "",
    dt_s: float = math.nan,
    *,
    name_of_all: str = "",
    without_vertical: bool = False,
) -> tuple[Sets, Sequence[Left]]:
    """Return the sets of three in a folder and its subfolders, and the remaining files.

    A motion not named by its files gets `name_of_all`, or the name of the folder. Two horizontal
    records alone form a set if requested. Raises `InputError` if it has more than `MOST_FILES`
    files.
    """
    # Sorted: what is taken does not depend on the order of the file system.
    paths = sorted(
        path
        for path in folder.rglob("*")
        if not _HIDDEN.search(f"/{path.relative_to(folder).as_posix()}") and path.is_file()
    )
    if len(paths) > MOST_FILES:
        raise InputError(f"has {len(paths)} files, more than {MOST_FILES}; use a subfolder")
    unclear: list[Left] = []
    groups: dict[tuple[str, ...], list[Candidate]] = {}
    for path in paths:
        file = path.relative_to(folder).as_posix()
        try:
            if path.stat().st_size > MAX_BYTES:
                raise InputError(f"has more than {MAX_BYTES / 1e6:.0f} MB")
            for channel in _channels(file, read_motion_file(path, units=units, dt_s=dt_s)):
                suffix = path.suffix.casefold()
                # The suffix of K-NET is a component.
                kind = "" if _by_word(suffix[1:]) else suffix
                key = (str(PurePosixPath(file).parent), *channel.motion, channel.format, kind)
                groups.setdefault(key, []).append(channel)
        except InputError as error:
            unclear.append((file, error.problems[0].removeprefix(f"{path.name}: ")))
    clear: list[_Clear] = []
    for (parent, stem, remainder, *_), group in groups.items():
        # x before y by azimuth, the vertical last: the order of the sheet.
        group.sort(key=lambda channel: (not channel.is_horizontal, channel.degrees))
        if why := next(_unclear(group, without_vertical), ""):
            unclear.append((_listed(group), why))
        else:
            name = (
                _short(stem) or PurePosixPath(parent).name or name_of_all or folder.resolve().name
            )
            clear.append((name, f"{name} {remainder}".strip(), group))
    clear = list(_corrected(clear, unclear))
    plain = Counter(name for name, _, _ in clear)
    named = [(name if plain[name] == 1 else longer, group) for name, longer, group in clear]
    times = Counter(name for name, _ in named)
    sets: Sets = {}
    for name, group in named:
        if times[name] == 1 and len(name) <= MOST_NAME:
            sets[name] = group
        else:
            remedy = f"use a unique name of at most {MOST_NAME} characters"
            unclear.append((_listed(group), f"several sets have the name {name}; {remedy}"))
    return sets, unclear


def table(sets: Sets) -> Iterator[str]:
    """Yield the lines of a table: which channel is x, y and z of each set."""
    rows = [("motion", "", "record", "used as", "dt [s]", "samples", "format")]
    for name, group in sets.items():
        for axis, channel in zip("xyz", group, strict=False):
            cells = (
                channel.name,
                channel.taken_for,
                f"{channel.dt_s:.4g}",
                str(channel.npts),
                channel.format,
            )
            rows.append((name if axis == "x" else "", axis, *cells))
    return aligned(rows, "<<<<>><")


def _listed(group: Sequence[Candidate]) -> str:
    return ", ".join(f"{channel.name} ({channel.taken_for})" for channel in group)


def _corrected(clear: Sequence[_Clear], unclear: list[Left]) -> Iterator[_Clear]:
    """Yield the sets without those of volume 1 if the same motion exists as volume 2."""
    volumes = [(longer, _VOLUME.search(group[0].file)) for _, longer, group in clear]
    corrected = {longer for longer, volume in volumes if volume and volume[1] == "2"}
    for item, (longer, volume) in zip(clear, volumes, strict=True):
        if volume and volume[1] == "1" and longer in corrected:
            unclear.append((_listed(item[2]), "uncorrected; the corrected records are used"))
        else:
            yield item


def _short(name: str) -> str:
    """Return as many fields of a name as fit in an ID."""
    ends = [field.end() for field in _FIELD.finditer(name) if field.end() <= MOST_NAME]
    return name[: max(ends, default=None)] if len(name) > MOST_NAME else name


def _unclear(group: Sequence[Candidate], without_vertical: bool) -> Iterator[str]:
    """Yield reasons why a group in the order x, y, z is not the set of a motion."""
    level = [channel for channel in group if channel.is_horizontal]
    if (len(level), len(group)) not in ((2, 3), (2, 2 if without_vertical else 3)):
        counts = f"{len(level)} horizontal and {len(group) - len(level)} vertical of one motion"
        alone = "; --without-vertical uses the two" if len(level) == len(group) == 2 else ""
        yield f"{counts}; a set has 2 and 1{alone}"
    # With the sign wrong, uplift and contact would change places.
    elif group[-1].family == _DOWN:
        yield (
            f"{group[-1].name} is positive downward: enter it with factor -1, as motion convert"
            " --factor -1 writes it"
        )
    # By 90 or 270 degrees: each component may be positive either way.
    elif level[0].family != level[1].family or (level[1].degrees - level[0].degrees) % 180 != 90:
        yield "the names of the horizontal components are not perpendicular"
    steps, lengths = [channel.dt_s for channel in group], [channel.npts for channel in group]
    # Steps of headings differ by the rounding of a division alone.
    if max(steps) - min(steps) > 1e-9 * max(steps):
        yield f"time steps differ: {min(steps):g} to {max(steps):g} s"
    if min(lengths) < (1.0 - LENGTHS_WITHIN) * max(lengths):
        yield f"lengths differ: {min(lengths)} to {max(lengths)} samples"
    starts = [channel.start for channel in group if channel.start is not None]
    # Two events at one station have the same names: their start times tell them apart.
    if starts and max(starts) - min(starts) > STARTS_WITHIN:
        yield f"start times differ: {min(starts)} to {max(starts)}"


def _channels(file: str, motion_file: MotionFile) -> Sequence[Candidate]:
    """Return the channels of a file; raise if the component of one is ambiguous."""
    channels = []
    is_alone = len(motion_file.channels) == 1
    for record in motion_file.channels:
        channel_name = "" if record.name == motion_file.name else record.name
        stem, of_name = PurePosixPath(file).stem, None
        # Of several channels the name of the file can tell none.
        if is_alone:
            stem, of_name = _by_name(stem)
        of_heading = _by_heading(channel_name)
        # The heading goes first: it was written with the record, and a file may have been renamed.
        component = of_heading or of_name
        if component is None:
            raise InputError(
                f"neither its heading ({channel_name or 'none'}) nor its name states a component"
            )
        family, degrees, remaining = component
        if of_heading and of_name and _differ(of_heading, of_name):
            raise InputError(
                f"its heading ({channel_name}) and its name state different components"
            )
        if not of_name:
            stem = _without(stem, family, degrees)
        channels.append(
            Candidate(
                file=file,
                channel="" if is_alone else record.name,
                format=motion_file.format,
                dt_s=record.dt_s,
                npts=len(record.a_mps2),
                start=motion_file.start,
                family=family,
                degrees=degrees,
                motion=(stem, remaining),
            )
        )
    return channels


def _without(stem: str, family: str, degrees: int) -> str:
    """Return a name without the word for a component: the last of its fields, or glued to its end.

    Glued are three letters or two.
    """
    words = [*reversed([*_FIELD.finditer(stem)]), *(end.search(stem) for end in _GLUED_ENDS)]
    for word in words:
        if word and len(word[0]) < len(stem):
            direction = _by_word(word[0].casefold())
            if direction and direction[:2] == (family, degrees):
                remaining = stem[: word.start()] + stem[word.end() :].lstrip(_MARKS)
                return remaining.rstrip(_MARKS)
    return stem


_Meant = tuple[str, int, str]  # family, degrees, and the rest of what was said


def _differ(first: _Meant, second: _Meant) -> bool:
    """Whether one is vertical and the other not, or both are azimuths and not the same."""
    is_vertical = [family in (_UP, _DOWN) for family, _, _ in (first, second)]
    is_other = first[0] == second[0] == _AZIMUTH and (first[1] - second[1]) % 360 != 0
    return is_other or is_vertical[0] != is_vertical[1]


def _by_heading(text: str) -> _Meant | None:
    """Return the first component that a heading names, with its other words."""
    if identity := _IDENTITY.fullmatch(text.casefold()):
        return *_NAMED[identity[3]], f"{identity[2]} {identity[1]}"
    words = re.findall(r"[a-z0-9]+(?:-[a-z](?![a-z]))?", _CHANNEL.sub(" ", text.casefold()))
    for k, word in enumerate(words):
        if direction := _by_word(word):
            further = [text for text in (*words[:k], *words[k + 1 :]) if not _NOISE.fullmatch(text)]
            return direction[0], direction[1], " ".join(filter(None, (direction[2], *further)))
    return None


def _by_name(stem: str) -> tuple[str, _Meant | None]:
    """Return the name of a file without the component at its end, and that component."""
    if match := re.fullmatch(rf"(.*?){_CHANNEL_OF_NAME.pattern}", stem, re.IGNORECASE):
        return match[1], None
    match = _END.fullmatch(stem)
    direction = _by_word((match[2] or match[3]).casefold()) if match else None
    if not direction and (match := _GLUED.fullmatch(stem)):
        direction = _by_word(match[2].casefold())
    return (match[1], direction) if match and direction else (stem, None)


def _by_word(word: str) -> _Meant | None:
    if word.isdecimal():
        return (_AZIMUTH, int(word), "") if len(word) <= 3 and int(word) <= 360 else None
    if word in _NAMED:
        return (*_NAMED[word], "")
    if match := _BEARING.fullmatch(word):
        degrees = int(match[2]) * (1 if match[3] == "e" else -1)
        # N 30 E is 30 degrees from north over east, S 30 E is 150, N 30 W is 330.
        return _AZIMUTH, (degrees if match[1] == "n" else 180 - degrees) % 360, ""
    if match := _WITHIN.fullmatch(word):
        return (*_NAMED[match[2] or match[3]], match[1] or match[4])
    return None
