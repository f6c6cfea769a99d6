"""How right real-time bump-map shadows are, measured: Gnomon for Python.

Masks are arrays of bytes, 1 lit, 0 shadowed, 2 no answer (booleans are taken too, True is lit), row 0 at
the top. Under a light with a disc they are float32: the share of the disc that is seen, 0 none, 1 all of
it, NaN no answer. Height maps are arrays (rows, columns) whose row 0 is at v = 0. Angles are degrees,
lengths world units unless a name says texels: names and units are those of studies. Functions use all
processors and let other threads of Python run; Ctrl-C ends each of them within a second, the making of a surface of a
million faces within some three.

What is wrong raises InputError (a ValueError) with one line; a machine without OpenGL NoOpenGLError;
anything else Error.

>>> import gnomon
>>> result = gnomon.run("scenes/figure8.toml", methods=["max-forsyth"], quick=True)
>>> result.value("max-forsyth", "error_rate")
"""

import pathlib as _pathlib
import re as _re
import sys as _sys


def _refuse_interpreter() -> None:
    """Raises ImportError with one line where this interpreter is not the one to import gnomon."""
    version = "%d%d" % _sys.version_info[:2]
    folder = _pathlib.Path(__file__).resolve().parent
    built = [
        match.group(1)
        for file in _pathlib.Path(__file__).parent.glob("_gnomon.*.so")
        for match in [_re.match(r"_gnomon\.cpython-(\d+)", file.name)]
        if match
    ]
    if not built:
        raise ImportError(
            f"gnomon in {folder} is not built: `./gnomon python` in a checkout builds it and prints the "
            "folder to import it from"
        )
    if version not in built:
        wanted = " or ".join(f"{one[0]}.{one[1:]}" for one in built)
        raise ImportError(
            f"gnomon in {folder} is built for Python {wanted}; {_sys.executable} is Python "
            f"{version[0]}.{version[1:]}"
        )
    try:
        import numpy  # noqa: F401
    except ImportError as error:
        raise ImportError(
            f"gnomon takes NumPy, which {_sys.executable} does not have: install it there, or use an "
            f"interpreter that has it, as Debian's /usr/bin/python3 with python3-numpy ({error})"
        ) from None


_refuse_interpreter()

from gnomon._gnomon import (  # noqa: E402  once it is known that it can be
    Error,
    InputError,
    NoOpenGLError,
    Surface,
    __version__,
)
from gnomon.arrays import (  # noqa: E402
    Horizons,
    Samples,
    Truth,
    atlas,
    camera,
    compare,
    horizons,
    make_shape,
    make_surface,
    read_mask,
    read_shares,
    read_surface,
    trace,
)
from gnomon.results import Result, Results, UnknownNameError, load, run  # noqa: E402

__all__ = [
    "Error",
    "Horizons",
    "InputError",
    "NoOpenGLError",
    "Result",
    "Results",
    "Samples",
    "Surface",
    "Truth",
    "UnknownNameError",
    "__version__",
    "atlas",
    "camera",
    "compare",
    "horizons",
    "load",
    "make_shape",
    "make_surface",
    "read_mask",
    "read_shares",
    "read_surface",
    "run",
    "trace",
]
