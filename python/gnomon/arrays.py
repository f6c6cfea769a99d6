"""Functions on arrays: horizons, samples of a surface, exact shadows, comparisons of masks."""

import math
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from gnomon import _gnomon


class Horizons(NamedTuple):
    """The horizons of a height map; both arrays are (azimuths, rows, columns) float32.

    slopes     tangent of the horizon's angle toward azimuth 2 pi m / azimuths, counter-clockwise
               from +x
    distances  to the nearest point that makes the horizon, in the unit of `spacing`
    """

    slopes: np.ndarray
    distances: np.ndarray


def horizons(
    heights: np.ndarray,
    azimuths: int = 32,
    radius: float = 64,
    spacing: float = 1,
    repeats: bool = True,
) -> Horizons:
    """The exact horizons of the bilinear function of a height map.

    heights  (rows, columns), in the unit of `spacing`; row 0 has the smallest y
    radius   how far to look, texels
    spacing  length of one texel
    repeats  whether the map goes on by repeating, else by its outermost texels
    """
    if not (spacing > 0 and math.isfinite(spacing)):
        raise _gnomon.InputError(f"spacing: {spacing} found, a length above 0 expected")
    slopes, distances = _gnomon.horizons(np.asarray(heights), azimuths, radius, repeats)
    if spacing == 1:
        return Horizons(slopes, distances)
    return Horizons(slopes / np.float32(spacing), distances * np.float32(spacing))


def atlas(surface: _gnomon.Surface, side: int) -> _gnomon.Samples:
    """A grid of `side` x `side` points in every face, weighted by area: no camera takes part."""
    return _gnomon.atlas(surface, side)


def camera(
    surface: _gnomon.Surface,
    eye: Sequence[float],
    target: Sequence[float] = (0, 0, 0),
    up: Sequence[float] = (0, 1, 0),
    fov: float = 0.5,
    width: int = 512,
    height: int = 512,
    subdivisions: int = 1,
) -> _gnomon.Samples:
    """The point of the surface that each pixel shows. `fov` is the full vertical angle, radians."""
    return _gnomon.camera(surface, eye, target, up, fov, width, height, subdivisions)


class Truth(NamedTuple):
    """The exact shadow under one light; mask and regions are (height, width) uint8.

    mask         0 lit, 1 shadowed, 2 no answer; of a disc 1 where less than half of it is seen
    regions      0 no sample, 1 lit, 2 attached, 3 cast, 4 distant, 5 beyond the terminator,
                 6 global; of a disc those of its centre
    uncertainty  share of the samples that change at half the resolution: differences between
                 methods below it mean nothing; of a disc the mean change of the shares
    shares       (height, width) float32, the share of the disc that a sample sees, NaN no answer;
                 None of a point light
    """

    mask: np.ndarray
    regions: np.ndarray
    uncertainty: float
    shares: Optional[np.ndarray] = None


def trace(
    surface: _gnomon.Surface,
    heights: np.ndarray,
    samples: _gnomon.Samples,
    lights: Sequence[Sequence[float]],
    repeats: Tuple[float, float] = (1, 1),
    heights_in_texels: bool = False,
    map_repeats: bool = True,
    step: Optional[float] = None,
    radius: Optional[float] = None,
    disc: Union[float, Sequence[float]] = 0,
    directions: int = 256,
) -> List[Truth]:
    """The exact shadows of a surface displaced by a height map, one truth a light.

    lights      vectors toward the lights, (lights, 3)
    repeats     times that the map is laid over one unit of u and of v
    step        longest edge of the traced mesh, texels; by default for four million triangles
    radius      occluders farther than this along the surface are "distant", texels
    disc        angular radius of all lights, or of each, radians; 0 is a point, the sun
                math.radians(0.266)
    directions  toward a disc, each for an equal solid angle: an even number
    """
    vectors = [tuple(float(x) for x in light) for light in lights]
    discs = np.asarray(disc, float)
    if discs.ndim == 0:
        discs = np.full(len(vectors), discs)
    truths = _gnomon.trace(
        surface,
        np.asarray(heights),
        samples,
        vectors,
        tuple(repeats),
        heights_in_texels,
        map_repeats,
        step,
        radius,
        discs.tolist(),
        directions,
    )
    return [Truth(**truth) for truth in truths]


def compare(
    candidate: np.ndarray,
    truth: np.ndarray,
    roi: Optional[np.ndarray] = None,
    weights: Optional[np.ndarray] = None,
) -> Dict[str, Any]:
    """A mask against the truth: tp, fp, fn, tn, samples and every metric of `gnomon compare`, and
    "error_interval", the 95 % interval [low, high] of error_rate.

    A truth of floats holds shares of a light's disc, as `Truth.shares`; the candidate may then be
    shares or a mask. Each sample is divided among tp, fp, fn and tn, error_rate is the mean
    difference of the shares, and mae, rmse, off_by_more_than_0.1, umbra_iou and penumbra_iou come
    with it.

    All arrays are (height, width). What is not defined is None, with its reason in "undefined".

    roi      where samples count; everywhere by default
    weights  of each sample, at least 0
    """
    return _gnomon.compare(np.asarray(candidate), np.asarray(truth), roi, weights)
