"""Functions on arrays: surfaces and their samples, horizons, exact shadows, comparisons of masks."""

import warnings
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from gnomon import _gnomon, arguments
from gnomon._gnomon import Surface

_MASK = (None, None)
_MASK_TEXT = "(height, width)"
#: Lengths that the library takes of a surface, too.
_SHORTEST, _LONGEST = 1e-12, 1e12


class Horizons(NamedTuple):
    """The horizons of a height map; both arrays are (azimuths, rows, columns) float32.

    slopes     tangent of the horizon's angle toward azimuth 360° m / azimuths, counter-clockwise
               from +x
    distances  to the nearest point that makes the horizon, in the unit of `spacing`
    """

    slopes: np.ndarray
    distances: np.ndarray


def horizons(
    heights: Any,
    azimuths: int = 32,
    radius: float = 64,
    spacing: float = 1,
    repeats: bool = True,
) -> Horizons:
    """The exact horizons of the bilinear function of a height map.

    heights   (rows, columns), in the unit of `spacing`, -1e6 to 1e6; row 0 has the smallest y
    azimuths  directions, 1 to 1024
    radius    how far to look, texels, above 0 and at most 1e5
    spacing   length of one texel, 1e-12 to 1e12
    repeats   whether the map goes on by repeating, else by its outermost texels

    Raises InputError for an argument of another kind or out of its range; Error where the result
    does not fit into memory.
    """
    length = arguments.number(spacing, "spacing", "length units")
    if not _SHORTEST <= length <= _LONGEST:
        arguments.refuse("spacing", spacing, f"a length from {_SHORTEST:g} to {_LONGEST:g}")
    slopes, distances = _gnomon.horizons(
        arguments.numbers(heights, "heights", _MASK, "(rows, columns)", np.float32),
        arguments.whole(azimuths, "azimuths", "directions"),
        arguments.number(radius, "radius", "texels"),
        arguments.flag(repeats, "repeats"),
    )
    if length == 1:
        return Horizons(slopes, distances)
    return Horizons(slopes / np.float32(length), distances * np.float32(length))


def make_shape(
    shape: str,
    *,
    quads: Optional[Sequence[int]] = None,
    size: Optional[Sequence[float]] = None,
    curvature: Optional[float] = None,
    major: Optional[float] = None,
    minor: Optional[float] = None,
    points: Optional[Sequence[Sequence[float]]] = None,
    columns: Optional[int] = None,
) -> Surface:
    """A built-in shape, u and v from 0 to 1 over the whole of it. The keywords are the keys of
    `[surface]` in a study, lengths are world units:

    "plane"     quads, size: the rectangle in z = 0 about the origin, outside at +z
    "cylinder"  quads, curvature, size: about the y axis
    "sphere"    quads, curvature, size: a patch whose middle faces +z
    "torus"     quads, major, minor: about the y axis
    "bezier"    quads, points: a bicubic patch
    "b-spline"  points, columns: a uniform bicubic surface

    quads      (along u, along v): faces, 1 to 4096 each; an arc spans less than 0.11 radians a face
    size       (along u, along v): arc lengths
    curvature  1 / radius; of a sphere below 0: its inside, a bowl
    major      radius of the torus' ring, `minor` of its tube
    points     (count, 3) control points, row by row; 16 of "bezier"
    columns    points a row

    >>> gnomon.make_shape("sphere", quads=(20, 20), curvature=1 / 50, size=(80, 80))

    Raises InputError for another shape, a keyword that it does not have or lacks, and a value out of
    range.
    """
    if not isinstance(shape, str) or not shape:
        arguments.refuse("shape", shape, "the name of a shape")
    keys: Dict[str, List[float]] = {}
    if quads is not None:
        keys["quads"] = arguments.indices(quads, "quads", (2,), "(2,)").tolist()
    if size is not None:
        keys["size"] = arguments.numbers(size, "size", (2,), "(2,)").tolist()
    for name, value, unit in [
        ("curvature", curvature, "1 / world units"),
        ("major", major, "world units"),
        ("minor", minor, "world units"),
    ]:
        if value is not None:
            keys[name] = [arguments.number(value, name, unit)]
    if points is not None:
        keys["points"] = arguments.numbers(points, "points", (None, 3), "(points, 3)").ravel().tolist()
    if columns is not None:
        keys["columns"] = [arguments.whole(columns, "columns", "points a row")]
    return _gnomon.make_shape(shape, keys)


def read_surface(file: Any, scheme: str) -> Surface:
    """The surface of an OBJ or PLY file, as `[surface] mesh` and `scheme` of a study.

    file    its path
    scheme  "catmull-clark", or of triangles "loop": the limit surface of the file as a control mesh;
            "none": its polygons as they are, with its normals

    Raises InputError naming the file and what is wrong in it.
    """
    if not isinstance(scheme, str):
        arguments.refuse("scheme", scheme, '"catmull-clark", "loop" or "none"')
    return _gnomon.read_surface(arguments.path(file, "file"), scheme)


def make_surface(
    positions: Any, faces: Any, uvs: Any, face_uvs: Any = None, polygons: bool = False
) -> Surface:
    """The limit surface of a control mesh, or its polygons as they are.

    positions  (vertices, 3), world units
    faces      (faces, 4) vertices, from 0, counter-clockwise seen from outside: a surface of Catmull
               & Clark; (faces, 3): of Loop
    uvs        (texture vertices, 2)
    face_uvs   texture vertices of the faces, shaped as `faces`; where there are none they are `faces`
    polygons   whether the faces themselves are the surface, as with scheme "none" of a file

    Raises InputError naming the face or vertex that has no limit surface.
    """
    corners = np.shape(faces)[-1] if np.ndim(faces) == 2 else 4
    if corners not in (3, 4):
        raise _gnomon.InputError(
            f"faces: shape {np.shape(faces)} found, (faces, 3 or 4) expected"
        )
    shape = "(faces, 3 or 4)"
    made = arguments.indices(faces, "faces", (None, corners), shape)
    return _gnomon.make_surface(
        arguments.numbers(positions, "positions", (None, 3), "(vertices, 3)"),
        made,
        arguments.numbers(uvs, "uvs", (None, 2), "(texture vertices, 2)"),
        made
        if face_uvs is None
        else arguments.indices(face_uvs, "face_uvs", made.shape, f"{made.shape} as of faces"),
        arguments.flag(polygons, "polygons"),
    )


class Samples:
    """Points of a surface at which masks answer, (height, width) of them, row 0 at the top. `atlas` and
    `camera` make them; another renderer's are made of its own arrays.

    face  (height, width) whole numbers: the face of each pixel, -1 where it shows no surface
    s, t  (height, width): its parameters in that face, 0 to 1

    Raises InputError for arrays of other shapes and for a face that is no whole number.
    """

    __slots__ = ("_held",)

    def __init__(self, face: Any, s: Any, t: Any) -> None:
        faces = arguments.indices(face, "face", _MASK, _MASK_TEXT)
        expected = f"{faces.shape} as of face"
        self._held = _gnomon.Samples(
            faces,
            arguments.numbers(s, "s", faces.shape, expected, np.float32),
            arguments.numbers(t, "t", faces.shape, expected, np.float32),
        )

    @classmethod
    def _of(cls, held: _gnomon.Samples) -> "Samples":
        samples = cls.__new__(cls)
        samples._held = held
        return samples

    @property
    def face(self) -> np.ndarray:
        """(height, width) int32; -1 where there is no surface."""
        return self._held.face

    @property
    def s(self) -> np.ndarray:
        """(height, width) float32, 0 to 1."""
        return self._held.s

    @property
    def t(self) -> np.ndarray:
        """(height, width) float32, 0 to 1."""
        return self._held.t

    @property
    def weights(self) -> Optional[np.ndarray]:
        """(height, width) float64, the world area of each sample; None where all count alike."""
        return self._held.weights

    @property
    def shape(self) -> Tuple[int, int]:
        """(height, width)."""
        return self.face.shape

    def __repr__(self) -> str:
        height, width = self.shape
        shown = int((self.face >= 0).sum())
        return f"<gnomon.Samples {width} x {height}, {shown} on the surface>"


def atlas(surface: Surface, samples: int) -> Samples:
    """A grid of points in every face, weighted by area: no camera takes part.

    samples  along a face's side, 1 to 4096: `samples` x `samples` a face, 2**27 in all at most

    Raises InputError.
    """
    arguments.instance(surface, "surface", Surface)
    return Samples._of(
        _gnomon.atlas(surface, arguments.whole(samples, "samples", "points a side"))
    )


def camera(
    surface: Surface,
    eye: Sequence[float],
    target: Sequence[float] = (0, 0, 0),
    up: Sequence[float] = (0, 1, 0),
    fov: float = 30,
    width: int = 512,
    height: int = 512,
    subdivisions: int = 1,
) -> Samples:
    """The point of the surface that each pixel of a camera shows.

    eye           where the camera is, (3,), world units; `target` is in the middle of its picture,
                  `up` points upward in it
    fov           full vertical angle, degrees, 0.1 to 170
    width         pixels, 1 to 16384; `height` too
    subdivisions  pieces of every face's side, of which the drawn mesh consists, 1 to 1024

    Raises InputError; NoOpenGLError where this machine has no OpenGL 4.5.
    """
    arguments.instance(surface, "surface", Surface)
    places = [
        arguments.numbers(place, name, (3,), "(3,)").tolist()
        for place, name in [(eye, "eye"), (target, "target"), (up, "up")]
    ]
    return Samples._of(
        _gnomon.camera(
            surface,
            *places,
            arguments.number(fov, "fov", "degrees"),
            arguments.whole(width, "width", "pixels"),
            arguments.whole(height, "height", "pixels"),
            arguments.whole(subdivisions, "subdivisions", "pieces"),
        )
    )


class Truth(NamedTuple):
    """The exact shadow under one light; mask and regions are (height, width) uint8.

    mask         1 lit, 0 shadowed, 2 no answer; of a disc 0 where less than half of it is seen
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
    surface: Surface,
    heights: Any,
    samples: Samples,
    lights: Sequence[Sequence[float]],
    repeats: Tuple[float, float] = (1, 1),
    heights_in_texels: bool = False,
    map_repeats: bool = True,
    step: Optional[float] = None,
    radius: Optional[float] = None,
    light_radius: Union[float, Sequence[float]] = 0,
    directions: int = 256,
) -> List[Truth]:
    """The exact shadows of a surface displaced by a height map, one truth a light.

    heights            (rows, columns), -1e6 to 1e6, world units; row 0 is at v = 0
    samples            of `atlas`, `camera` or another renderer: the points that answer
    lights             vectors toward the lights, (lights, 3), of any length
    repeats            times that the map is laid over one unit of u and of v, above 0 and at most 1e6
    heights_in_texels  heights count texels, not world units
    map_repeats        whether the map goes on by repeating, else by its outermost texels
    step               longest edge of the traced mesh, texels; by default for four million triangles
    radius             occluders farther than this along the surface are "distant", texels, above 0
                       and at most 1e5; by default the longest shadow that the lights can cast
    light_radius       angular radius of all lights, or of each, degrees, 0 to 10; 0 is a point, the
                       sun 0.266
    directions         toward a light with a radius, each for an equal solid angle: an even number
                       from 32 to 65536

    Raises InputError for an argument of another kind or out of its range, and for a surface too small,
    too large or too far from the origin for floats; Error where the mesh does not fit into memory.
    """
    arguments.instance(surface, "surface", Surface)
    arguments.instance(samples, "samples", Samples)
    vectors = arguments.numbers(lights, "lights", (None, 3), "(lights, 3), as [(0, 0, 1)] for one,")
    if np.ndim(light_radius) == 0:
        radii = [arguments.number(light_radius, "light_radius", "degrees")] * len(vectors)
    else:
        radii = arguments.numbers(light_radius, "light_radius", (None,), "(lights,)").tolist()
    truths = _gnomon.trace(
        surface,
        arguments.numbers(heights, "heights", _MASK, "(rows, columns)", np.float32),
        samples._held,
        vectors.tolist(),
        arguments.numbers(repeats, "repeats", (2,), "(2,)").tolist(),
        arguments.flag(heights_in_texels, "heights_in_texels"),
        arguments.flag(map_repeats, "map_repeats"),
        None if step is None else arguments.number(step, "step", "texels"),
        None if radius is None else arguments.number(radius, "radius", "texels"),
        radii,
        arguments.whole(directions, "directions", "directions"),
    )
    return [Truth(**truth) for truth in truths]


def read_mask(file: Any) -> np.ndarray:
    """A picture of a mask, (height, width) uint8: white is 1, lit; black 0, shadowed; Gnomon's grey
    (128) or alpha 0 is 2, no answer. Raises InputError naming the file, for any other value too."""
    return _gnomon.read_mask(arguments.path(file, "file"))


def read_shares(file: Any) -> np.ndarray:
    """A picture of the share of a light's disc that is seen, (height, width) float32: 0 none, 1 all of
    it, NaN no answer. Raises InputError naming the file, for a value beyond 0 to 1 too."""
    return _gnomon.read_shares(arguments.path(file, "file"))


def _shares(value: Any, name: str) -> np.ndarray:
    """Shares; of a mask its answers as shares."""
    found = arguments.array(value, name, _MASK, _MASK_TEXT)
    if found.dtype.kind == "f":
        return np.ascontiguousarray(found, np.float32)
    bytes_ = arguments.mask(found, name)
    return np.where(bytes_ == 2, np.float32(np.nan), bytes_.astype(np.float32))


def compare(candidate: Any, truth: Any, roi: Any = None, weights: Any = None) -> Dict[str, Any]:
    """A mask against the truth: tp, fp, fn, tn (positive is shadowed), samples, every metric of
    `gnomon compare`, and "error_interval", the 95 % interval [low, high] of error_rate.

    A truth of floats holds shares of a light's disc, as `Truth.shares`; the candidate may then be
    shares or a mask. Each sample is divided among tp, fp, fn and tn, error_rate is the mean
    difference of the shares, and mae, rmse, off_by_more_than_0.1, umbra_iou and penumbra_iou come
    with it.

    All arrays are (height, width). What is not defined is None, with its reason in "undefined". A
    candidate that is wrong nearly everywhere, as an inverted one is, raises a warning, which is
    "notice" too, else None.

    candidate  1 or True lit, 0 or False shadowed, 2 no answer; the truth too
    roi        True where samples count; everywhere by default
    weights    of each sample, at least 0

    Raises InputError for arrays of another shape or type, and for a candidate without an answer that
    counts.
    """
    right = arguments.array(truth, "truth", _MASK, _MASK_TEXT)
    read = _shares if right.dtype.kind == "f" else arguments.mask
    expected = f"{right.shape} as of truth"
    region = None
    if roi is not None:
        region = arguments.array(roi, "roi", right.shape, expected, "bui") != 0
    found = _gnomon.compare(
        read(candidate, "candidate"),
        read(right, "truth"),
        region,
        None if weights is None else arguments.numbers(weights, "weights", right.shape, expected),
    )
    if found["notice"]:
        warnings.warn(found["notice"], UserWarning, stacklevel=2)
    return found
