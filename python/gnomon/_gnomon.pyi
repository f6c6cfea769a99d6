import pathlib
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

class Error(RuntimeError): ...
class InputError(Error, ValueError): ...
class NoOpenGLError(Error): ...

class Surface:
    @property
    def face_count(self) -> int: ...

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

def make_shape(shape: str, sizes: Sequence[float], columns: int, rows: int) -> Surface: ...
def read_surface(file: Union[str, pathlib.Path], triangles: bool = False) -> Surface: ...
def make_surface(
    positions: np.ndarray,
    faces: np.ndarray,
    uvs: np.ndarray,
    face_uvs: Optional[np.ndarray] = None,
) -> Surface: ...
def atlas(surface: Surface, side: int) -> Samples: ...
def camera(
    surface: Surface,
    eye: Sequence[float],
    target: Sequence[float],
    up: Sequence[float],
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
    lights: Sequence[Tuple[float, ...]],
    repeats: Tuple[float, float],
    heights_in_texels: bool,
    map_repeats: bool,
    step: Optional[float],
    radius: Optional[float],
    discs: List[float],
    directions: int,
) -> List[Dict[str, Any]]: ...
def compare(
    candidate: np.ndarray,
    truth: np.ndarray,
    roi: Optional[np.ndarray],
    weights: Optional[np.ndarray],
) -> Dict[str, Any]: ...
def read_mask(file: Union[str, pathlib.Path]) -> np.ndarray: ...
def read_shares(file: Union[str, pathlib.Path]) -> np.ndarray: ...
def run(
    study: pathlib.Path,
    out: pathlib.Path,
    methods: List[str],
    settings: List[str],
    quick: bool,
    cache: bool,
    progress: Optional[Callable[[str, float], None]],
) -> Tuple[pathlib.Path, bool, List[str]]: ...
