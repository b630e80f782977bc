"""All jitted functions, one family per file: numba caches by file. Read `one_axis` first."""

import os
import sys
from pathlib import Path

if sys.platform == "win32":
    import gstreamer_ext_runtime

    # Numba needs MSVCP140.dll, which a new Windows does not have.
    os.add_dll_directory(str(Path(gstreamer_ext_runtime.__file__).with_name("bin")))
