"""Arguments that are wrong, and all that people find out without a manual: names, docstrings, types."""

import inspect
import math
import pathlib
import re

import numpy as np
import pytest

import gnomon

FLAT = np.zeros((4, 4), np.float32)


def plane(**changes):
    return gnomon.make_shape("plane", **{"quads": (2, 2), "size": (4, 4), **changes})


def trace(**changes):
    surface = plane()
    arguments = {
        "surface": surface,
        "heights": FLAT,
        "samples": gnomon.atlas(surface, 2),
        "lights": [(0, 0, 1)],
        "step": 0.5,
    }
    return gnomon.trace(**{**arguments, **changes})


def camera(**changes):
    return gnomon.camera(plane(), **{"eye": (0, 0, 9), **changes})


def samples(face=0, s=0.5, t=0.5):
    return gnomon.Samples([[face]], [[s]], [[t]])


def square(**changes):
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    arguments = {
        "positions": [(*corner, 0) for corner in corners],
        "faces": [[0, 1, 2, 3]],
        "uvs": corners,
    }
    return gnomon.make_surface(**{**arguments, **changes})


#: What is called, with what, and how the answer begins.
WRONG = [
    (samples, {"face": 2**32}, "face: 4294967296 found at (0, 0), a whole number from"),
    (samples, {"face": 1.9}, "face: 1.9 found at (0, 0), a whole number from"),
    (samples, {"face": math.nan}, "face: nan found at (0, 0), a whole number from"),
    (samples, {"face": "x"}, "face: [['x']] found, (height, width) numbers expected"),
    (samples, {"s": math.nan}, "s: nan found at (0, 0), a finite number"),
    (samples, {"t": 1j}, "t: [[1j]] found, (1, 1) as of face numbers expected"),
    (square, {"faces": [[0, 1, 2, 2**32 + 3]]}, "faces: 4294967299 found at (0, 3), a whole"),
    (square, {"faces": [[0, 1, 2, 3.5]]}, "faces: 3.5 found at (0, 3), a whole number"),
    (square, {"faces": [[0, 1]]}, "faces: shape (1, 2) found, (faces, 3 or 4) expected"),
    (square, {"faces": [0, 1, 2, 3]}, "faces: shape (4,) found, (faces, 3 or 4) expected"),
    (square, {"face_uvs": [[0, 1, 2]]}, "face_uvs: shape (1, 3) found, (1, 4) as of faces"),
    (square, {"positions": [(0, 0)]}, "positions: shape (1, 2) found, (vertices, 3) expected"),
    (square, {"uvs": [(0, 0), (1,)]}, "uvs: [(0, 0), (1,)] found, (texture vertices, 2) numbers"),
    (plane, {"quads": (2.5, 2)}, "quads: 2.5 found at (0,), a whole number from"),
    (plane, {"quads": (0, 2)}, "plane: quads: 0 found, a number of at least 1 and at most 4096"),
    (plane, {"size": 4}, "size: shape () found, (2,) expected"),
    (plane, {"size": (4, -1)}, "plane: size: -1 found, a number above 0 expected"),
    (plane, {"curvature": 1}, "plane: curvature: unknown key"),
    (plane, {"shape": "cone"}, None),
    (gnomon.make_shape, {"shape": "cone"}, "cone: shape: the string"),
    (gnomon.make_shape, {"shape": "torus", "quads": (64, 64), "major": 2}, "torus: minor: missing"),
    (gnomon.make_shape, {"shape": 3}, "shape: 3 found, the name of a shape expected"),
    (
        gnomon.read_surface,
        {"file": 3, "scheme": "none"},
        "file: 3 found, a path expected",
    ),
    (
        gnomon.read_surface,
        {"file": "x.obj", "scheme": 1},
        'scheme: 1 found, "catmull-clark", "loop" or "none" expected',
    ),
    (
        gnomon.read_surface,
        {"file": "x.obj", "scheme": "nurbs"},
        'surface: scheme: the string "nurbs" found, one of catmull-clark, loop, none expected',
    ),
    (gnomon.read_mask, {"file": None}, "file: None found, a path expected"),
    (gnomon.atlas, {"surface": 3, "samples": 2}, "surface: 3 found, a gnomon.Surface expected"),
    (gnomon.atlas, {"surface": plane, "samples": 1.5}, None),
    (camera, {"fov": 171}, "camera: fov: 171 found, a number of at least 0.1 and at most 170 expected (degrees"),
    (camera, {"fov": "wide"}, "fov: 'wide' found, a number of degrees expected"),
    (camera, {"eye": (0, 9)}, "eye: shape (2,) found, (3,) expected"),
    (camera, {"eye": (0, math.inf, 9)}, "eye: inf found at (1,), a finite number"),
    (camera, {"width": 2.5}, "width: 2.5 found, a whole number of pixels expected"),
    (camera, {"width": 2**40}, "width: 1099511627776 found, a whole number of pixels, at most"),
    (camera, {"height": 0}, "camera: height: 0 found, a whole number from 1 to 16384 expected (pixels)"),
    (camera, {"subdivisions": 0}, "camera: subdivisions: 0 found"),
    (gnomon.horizons, {"heights": FLAT, "azimuths": 2.5}, "azimuths: 2.5 found, a whole number of directions"),
    (gnomon.horizons, {"heights": FLAT, "azimuths": True}, "azimuths: True found, a whole number"),
    (gnomon.horizons, {"heights": FLAT, "azimuths": 0}, "horizons: azimuths: 0 found"),
    (gnomon.horizons, {"heights": FLAT, "radius": 0}, "horizons: radius: 0 found, .* (texels"),
    (gnomon.horizons, {"heights": FLAT, "spacing": 1e-320}, "spacing: 1e-320 found, a length from 1e-12"),
    (gnomon.horizons, {"heights": FLAT, "spacing": math.nan}, "spacing: nan found, a length from"),
    (gnomon.horizons, {"heights": FLAT, "repeats": 1}, "repeats: 1 found, True or False expected"),
    (gnomon.horizons, {"heights": [[1, 2], [3]]}, "heights: [[1, 2], [3]] found, (rows, columns) numbers"),
    (gnomon.horizons, {"heights": [[math.nan]]}, "heights: nan found at (0, 0), a finite number"),
    (gnomon.horizons, {"heights": [[1e300]]}, "heights: 1e+300 found at (0, 0), a finite number of float32"),
    (gnomon.horizons, {"heights": [[2e6]]}, "heights from 2e+06 to 2e+06 found, -1e+06 to 1e+06"),
    (gnomon.horizons, {"heights": np.ma.masked_less(FLAT, 1)}, "heights: masked values found, numbers"),
    (trace, {"heights": np.full((4, 4), 4e18)}, "heights from 4e+18 to 4e+18 found"),
    (trace, {"lights": [(1, 2)]}, "lights: shape (1, 2) found, (lights, 3), as [(0, 0, 1)] for one,"),
    (trace, {"lights": (0, 0, 1)}, "lights: shape (3,) found, (lights, 3), as [(0, 0, 1)] for one,"),
    (trace, {"lights": [(0, 0, 1), (1, 0)]}, "lights: [(0, 0, 1), (1, 0)] found, (lights, 3)"),
    (trace, {"lights": [(0, 0, 0)]}, "light 0: [0, 0, 0] found, a direction expected"),
    (trace, {"lights": []}, "lights: shape (0,) found"),
    (trace, {"samples": FLAT}, "samples: an array of shape (4, 4) and type float32 found, a gnomon.Samples"),
    (trace, {"repeats": (1, 0)}, "trace: repeats: 0 found, a number above 0"),
    (trace, {"repeats": 2}, "repeats: shape () found, (2,) expected"),
    (trace, {"step": 0}, "trace: step: 0 found, a number above 0 expected (texels"),
    (trace, {"step": "fine"}, "step: 'fine' found, a number of texels expected"),
    (trace, {"radius": -1}, "trace: radius: -1 found"),
    (trace, {"directions": 33}, "trace: directions: 33 found, an even number expected"),
    (trace, {"directions": 4.0}, "directions: 4.0 found, a whole number"),
    (trace, {"heights_in_texels": "no"}, "heights_in_texels: 'no' found, True or False"),
    (gnomon.run, {"study": 3}, "study: 3 found, a path expected"),
    (gnomon.run, {"study": "x.toml", "methods": "max-forsyth"}, "methods: 'max-forsyth' found, a list of labels"),
    (gnomon.run, {"study": "x.toml", "set": [1]}, "set: [1] found, a dictionary"),
    (gnomon.run, {"study": "x.toml", "set": {"a.b": None}}, "set: a.b: None found, a number, a text"),
    (gnomon.run, {"study": "x.toml", "progress": 3}, "progress: 3 found, a function"),
    (gnomon.load, {"folder": 3}, "folder: 3 found, a path expected"),
]
WRONG = [case for case in WRONG if case[2] is not None]


@pytest.mark.parametrize("function, arguments, begins", WRONG)
def test_what_is_wrong_is_told_in_one_line(function, arguments, begins):
    with pytest.raises(gnomon.InputError) as refused:
        function(**arguments)
    message = str(refused.value)
    assert "\n" not in message
    assert len(message) < 400
    pattern = re.escape(begins).replace(re.escape(".*"), ".*")
    assert re.match(pattern, message), message


def test_whole_floats_are_indices_as_sample_maps_hold_them():
    found = samples(face=np.float32(3))
    assert found.face.dtype == np.int32 and found.face[0, 0] == 3
    assert samples(face=-1).face[0, 0] == -1


def test_shapes_have_the_studys_keys():
    """Areas in closed form, of every shape that has one."""

    def area(shape, **keys):
        return gnomon.atlas(gnomon.make_shape(shape, **keys), 8).weights.sum()

    assert area("plane", quads=(2, 3), size=(4, 5)) == pytest.approx(20, rel=2e-5)
    assert area("cylinder", quads=(40, 2), curvature=0.2, size=(10, 4)) == pytest.approx(40, rel=1e-4)
    sphere = area("sphere", quads=(40, 40), curvature=1 / 7, size=(7, 14))
    assert sphere == pytest.approx(49 * 2 * math.sin(1), rel=1e-4)
    torus = area("torus", quads=(64, 64), major=6, minor=2)
    assert torus == pytest.approx(4 * math.pi**2 * 12, rel=1e-3)
    grid = [(x, y, 0) for y in range(4) for x in range(4)]
    assert area("bezier", quads=(2, 2), points=grid) == pytest.approx(9, rel=1e-4)
    assert area("b-spline", columns=4, points=grid) == pytest.approx(1, rel=1e-4)


def test_a_field_of_view_is_in_degrees():
    """A plane 4 wide from 9 away: it fills the picture where tan(fov / 2) = 2 / 9."""
    fits = 2 * math.degrees(math.atan(2 / 9))
    assert (camera(fov=fits - 0.01, width=64, height=64).face >= 0).all()
    wider = camera(fov=2 * math.degrees(math.atan(4 / 9)), width=64, height=64).face >= 0
    assert wider.sum() == 32 * 32


def test_reprs_say_what_things_are():
    surface = plane()
    assert repr(surface) == "<gnomon.Surface of 4 faces>"
    assert repr(square()) == "<gnomon.Surface of 1 face>"
    assert repr(gnomon.atlas(surface, 2)) == "<gnomon.Samples 4 x 4, 16 on the surface>"
    assert gnomon.atlas(surface, 2).shape == (4, 4)


PUBLIC = [getattr(gnomon, name) for name in gnomon.__all__ if not name.startswith("__")]


def documented():
    for thing in PUBLIC:
        yield thing.__name__, thing
        for name, member in vars(thing).items() if inspect.isclass(thing) else ():
            if not name.startswith("_") and not isinstance(member, type(gnomon.Truth.mask)):
                yield f"{thing.__name__}.{name}", member


@pytest.mark.parametrize("name, thing", list(documented()))
def test_everything_public_has_a_docstring(name, thing):
    text = thing.__doc__
    assert text and len(text) > 10, name
    if inspect.isfunction(thing) and "." not in name:
        assert "Raises InputError" in text, "of errors, too"
        for argument in inspect.signature(thing).parameters:
            assert re.search(rf"\b{argument}\b", text) or argument == "surface", argument


def test_the_version_is_the_projects():
    text = (pathlib.Path(__file__).parents[2] / "CMakeLists.txt").read_text(encoding="utf-8")
    assert re.search(r"^project\(Gnomon VERSION ([0-9.]+)", text, re.M).group(1) == gnomon.__version__
