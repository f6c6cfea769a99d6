"""How right real-time bump-map shadows are, measured: Gnomon for Python.

Masks are arrays of bytes, 0 lit, 1 shadowed, 2 no answer (booleans are taken too), row 0 at the top.
Under a light with a disc they are float32: the share of the disc that is seen, 0 none, 1 all of it, NaN
no answer. Height maps are arrays (rows, columns) whose row 0 is at v = 0. Angles are radians, lengths
world units unless a name says texels. Functions use all processors and let other threads of Python run.

>>> import gnomon
>>> result = gnomon.run("scenes/figure8.toml", methods=["max-forsyth"], quick=True)
>>> result.value("max-forsyth", "error_rate")
"""

from gnomon._gnomon import (
    Error,
    InputError,
    NoOpenGLError,
    Samples,
    Surface,
    make_shape,
    make_surface,
    read_mask,
    read_shares,
    read_surface,
)
from gnomon.arrays import atlas, camera, compare, horizons, trace
from gnomon.results import Result, Results, load, run

__all__ = [
    "Error",
    "InputError",
    "NoOpenGLError",
    "Result",
    "Results",
    "Samples",
    "Surface",
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
