"""Files of records as people have them: the format is told by the content, never by the name.

Public names are listed here; knows no code rules and changes no sample. Read
`reader.read_motion_file` first, then one format, such as `peer`.
"""

from solver.formats.motionfile import MotionFile
from solver.formats.reader import read_motion_file, read_record
from solver.records.units import UNIT_CHOICES

__all__ = ["UNIT_CHOICES", "MotionFile", "read_motion_file", "read_record"]
