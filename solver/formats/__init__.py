"""Record files in common formats: the format is identified by content, never by file name.

The public names are listed here; `FORMATS` is the list of readers. Knows no code rules and changes
no sample. Read `reader.read_motion_file` first, then one format, such as `peer`.
"""

from solver.formats.reader import FORMATS, Format, read_motion_file, read_record
from solver.formats.record_file import MotionFile
from solver.records.record import UNIT_CHOICES

__all__ = ["FORMATS", "UNIT_CHOICES", "Format", "MotionFile", "read_motion_file", "read_record"]
