import pathlib
from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np

__version__: str

class Error(RuntimeError):
    """Gnomon could not do what it was asked for."""

class InputError(Error, ValueError):
    """An argument, file, study, mesh or shader is missing, malformed or out of range."""

class NoOpenGLError(Error):
    """This machine has no OpenGL 4.5."""

class Surface:
    """A smooth limit surface with texture coordinates. `make_shape`, `read_surface` and
    `make_surface` make it."""

    @property
    def face_count(self) -> int:
        """Faces, each a square of parameters (s, t) from 0 to 1."""

class Samples:
    def __init__(self, face: np.ndarray, s: np.ndarray, t: np.ndarray) -> None: ...
    @property
    def face(self) -> np.ndarray: ...
    @property
    def s(self) -> np.ndarray: ...
    @property
    def t(self) -> np.ndarray: ...
    @property
    def weights(self) -> Optional[np.ndarray]: ...

def make_shape(shape: str, keys: Dict[str, List[float]]) -> Surface: ...
def read_surface(file: pathlib.Path, triangles: bool) -> Surface: ...
def make_surface(
    positions: np.ndarray, faces: np.ndarray, uvs: np.ndarray, face_uvs: np.ndarray
) -> Surface: ...
def atlas(surface: Surface, samples: int) -> Samples: ...
def camera(
    surface: Surface,
    eye: List[float],
    target: List[float],
    up: List[float],
    fov: float,
    width: int,
    height: int,
    subdivisions: int,
) -> Samples: ...
def horizons(
    heights: np.ndarray, azimuths: int, radius: float, repeats: bool
) -> Tuple[np.ndarray, np.ndarray]: ...
def trace(
    surface: Surface,
    heights: np.ndarray,
    samples: Samples,
    lights: List[List[float]],
    repeats: List[float],
    heights_in_texels: bool,
    map_repeats: bool,
    step: Optional[float],
    radius: Optional[float],
    light_radii: List[float],
    directions: int,
) -> List[Dict[str, Any]]: ...
def compare(
    candidate: np.ndarray,
    truth: np.ndarray,
    roi: Optional[np.ndarray],
    weights: Optional[np.ndarray],
) -> Dict[str, Any]: ...
def read_mask(file: pathlib.Path) -> np.ndarray: ...
def read_shares(file: pathlib.Path) -> np.ndarray: ...
def run(
    study: pathlib.Path,
    out: pathlib.Path,
    methods: List[str],
    settings: List[str],
    quick: bool,
    cache: bool,
    progress: Optional[Callable[[str, float], None]],
) -> Tuple[pathlib.Path, bool, List[str]]: ...
