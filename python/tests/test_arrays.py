import math
import os
import signal
import struct
import threading
import time

import numpy as np
import pytest

import gnomon


def test_horizons_are_those_of_a_plain_search():
    """On rows that are all alike the horizon toward +x is the largest slope to any texel: the
    bilinear function has its maxima at texel centres, as seen from one of them."""
    random = np.random.default_rng(1)
    row = random.random(24, dtype=np.float32) * 5
    found = gnomon.horizons(np.tile(row, (8, 1)), azimuths=4, radius=10)
    assert found.slopes.shape == found.distances.shape == (4, 8, 24)
    steps = np.arange(1, 11)
    for x in range(24):
        slopes = (row[(x + steps) % 24] - row[x]) / steps
        assert found.slopes[0, 3, x] == pytest.approx(slopes.max(), rel=1e-5, abs=1e-5)
    # Along y nothing rises.
    assert np.allclose(found.slopes[1], 0, atol=1e-6)


def test_spacing_turns_texels_into_lengths():
    heights = np.zeros((16, 16), np.float32)
    heights[8, 8] = 3
    plain = gnomon.horizons(heights, 8, 12)
    spaced = gnomon.horizons(heights, 8, 12, spacing=0.5)
    assert np.allclose(spaced.slopes, plain.slopes * 2)
    assert np.allclose(spaced.distances, plain.distances / 2)
    with pytest.raises(gnomon.InputError, match="spacing: 0 found"):
        gnomon.horizons(heights, 8, 12, spacing=0)


def test_arrays_are_not_copied():
    found = gnomon.horizons(np.zeros((4, 4), np.float32), 2, 2)
    assert not found.slopes.flags.owndata
    samples = gnomon.atlas(gnomon.make_shape("plane", quads=(1, 1), size=(1, 1)), 4)
    assert not samples.face.flags.owndata
    face = samples.face
    del samples  # the array keeps what it shows
    assert (face == 0).all()


def test_a_wall_on_a_plane_casts_its_shadow_in_closed_form():
    """A wall of height 4 along y, light from -x at 45 degrees: dark for 4 texels behind it."""
    heights = np.zeros((64, 64), np.float32)
    heights[:, 20:24] = 4
    plane = gnomon.make_shape("plane", quads=(8, 8), size=(64, 64))
    samples = gnomon.atlas(plane, 32)
    truth = gnomon.trace(plane, heights, samples, [(-1, 0, 1)], step=0.25, map_repeats=False)[0]
    assert truth.mask.shape == truth.regions.shape == samples.face.shape
    x = 64 * ((samples.face % 8 + samples.s) / 8)
    dark = truth.mask == 0
    # Between the wall's foot (centre 23.5, falling to 24.5) and 27.5 + the slope's own width.
    assert dark[(x > 24.6) & (x < 27.4)].all()
    assert not dark[(x > 27.6) | (x < 19)].any()
    assert truth.uncertainty < 0.02


def test_samples_of_another_renderer():
    plane = gnomon.make_shape("plane", quads=(1, 1), size=(8, 8))
    own = gnomon.atlas(plane, 8)
    given = gnomon.Samples(own.face, own.s, own.t)
    heights = np.random.default_rng(2).random((8, 8), dtype=np.float32)
    first, second = (
        gnomon.trace(plane, heights, samples, [(1, 0.3, 0.5)], step=0.25)[0]
        for samples in (own, given)
    )
    assert (first.mask == second.mask).all()
    with pytest.raises(gnomon.InputError, match=r"s: shape \(8, 4\) found, \(8, 8\) as of face"):
        gnomon.Samples(own.face, own.s[:, :4], own.t)


def test_a_surface_from_arrays_is_the_shape():
    """A plane of one quadrilateral: its limit surface is the plane itself but for the boundary."""
    surface = gnomon.make_surface(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
        [[0, 1, 2, 3]],
        [[0, 0], [1, 0], [1, 1], [0, 1]],
    )
    assert surface.face_count == 1
    seen = gnomon.camera(surface, (0.5, 0.5, 2), (0.5, 0.5, 0), width=9, height=9)
    assert seen.face[4, 4] == 0
    assert seen.s[4, 4] == pytest.approx(0.5, abs=1e-5)


def test_polygons_are_what_they_are():
    """A cube, whose corners a limit surface would round off, has three lit sides."""
    corners = [[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    faces = [[4, 5, 7, 6], [1, 0, 2, 3], [5, 1, 3, 7], [0, 4, 6, 2], [6, 7, 3, 2], [0, 1, 5, 4]]
    uvs = [[0, 0], [1, 0], [1, 1], [0, 1]]
    face_uvs = [[0, 1, 2, 3]] * 6
    cube = gnomon.make_surface(corners, faces, uvs, face_uvs, polygons=True)
    assert cube.face_count == 6
    assert gnomon.atlas(cube, 9).weights.sum() == pytest.approx(24, rel=1e-4)
    rounded = gnomon.make_surface(corners, faces, uvs, face_uvs)
    assert gnomon.atlas(rounded, 9).weights.sum() < 12
    samples = gnomon.atlas(cube, 9)
    truth = gnomon.trace(cube, np.zeros((8, 8), np.float32), samples, [(1, 2, 3)], step=0.5)[0]
    shown = samples.face >= 0
    assert (truth.mask[shown] == np.isin(samples.face[shown], [0, 2, 4])).all()


def test_compare_by_hand():
    truth = np.array([[0, 0, 1, 1], [0, 1, 1, 2]], np.uint8)
    candidate = np.array([[0, 1, 1, 0], [0, 1, 1, 1]], np.uint8)
    found = gnomon.compare(candidate, truth)
    assert (found["tp"], found["fp"], found["fn"], found["tn"]) == (2, 1, 1, 3)
    assert found["samples"] == 7
    assert found["error_rate"] == pytest.approx(2 / 7)
    # The complement is wrong wherever the candidate is right.
    complement = np.where(truth == 2, 2, 1 - truth % 2)
    with pytest.warns(UserWarning, match="is one of them inverted"):
        assert gnomon.compare(complement, truth)["error_rate"] == 1
    assert gnomon.compare(truth, truth)["error_rate"] == 0
    upper = np.array([[True] * 4, [False] * 4])
    assert gnomon.compare(candidate, truth, roi=upper)["samples"] == 4
    weighted = gnomon.compare(candidate, truth, weights=np.array([[0, 0, 0, 3.0], [1, 1, 1, 1]]))
    assert weighted["fp"] == 3
    with pytest.raises(gnomon.InputError, match=r"roi: shape \(4, 2\) found, \(2, 4\) as of truth"):
        gnomon.compare(candidate, truth, roi=upper.T)
    with pytest.raises(gnomon.InputError, match=r"weights: shape \(8,\) found, \(2, 4\) as of truth"):
        gnomon.compare(candidate, truth, weights=np.ones(8))
    lit = np.ones((2, 2), bool)
    figures = gnomon.compare(lit, lit)
    assert figures["iou"] is None and "iou" in figures["undefined"]


def test_compare_gives_the_interval():
    random = np.random.default_rng(3)
    truth = random.random((96, 96)) < 0.5
    candidate = truth ^ (random.random((96, 96)) < 0.1)
    found = gnomon.compare(candidate, truth)
    low, high = found["error_interval"]
    assert 0 < low < found["error_rate"] < high < 0.2
    few = gnomon.compare(truth[:2, :2], truth[:2, :2])
    assert few["error_interval"] is None and few["undefined"]["error_interval"]


def interrupted(work):
    """Seconds until Ctrl-C, half a second after its start, has ended the work."""
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        work()
    timer.join()
    return time.monotonic() - start


def plane(side=64, quads=8):
    return gnomon.make_shape("plane", quads=(quads, quads), size=(side, side))


BUMPS = np.random.default_rng(1).random((64, 64), dtype=np.float32)
LONG_WORK = {
    # Half a minute: 200 million triangles.
    "a fine trace": lambda: gnomon.trace(
        plane(), BUMPS, gnomon.atlas(plane(), 64), [(1, 0, 1)], step=0.0064
    ),
    # Half an hour: a band of samples alone takes half a minute under all of them.
    "a trace of 6,000 lights": lambda: gnomon.trace(
        plane(), BUMPS, gnomon.atlas(plane(64, 1), 512), [(1, 0, 1)] * 6000, step=0.25
    ),
    "a trace of a disc": lambda: gnomon.trace(
        plane(), BUMPS, gnomon.atlas(plane(), 64), [(1, 0, 1)], light_radius=5, directions=65536
    ),
    # Two minutes.
    "a bake": lambda: gnomon.horizons(
        np.random.default_rng(1).random((1024, 1024), dtype=np.float32), azimuths=512, radius=500
    ),
}


@pytest.mark.parametrize("name", LONG_WORK)
def test_an_interrupt_ends_long_work_within_a_second(name):
    assert interrupted(LONG_WORK[name]) < 1.5


def test_an_interrupt_ends_the_making_of_a_surface():
    """Of a million faces: ten seconds and more, of which OpenSubdiv connects them in one step of two."""
    assert interrupted(lambda: plane(64, 1024)) < 8


@pytest.mark.parametrize(
    "mask, message",
    [
        (np.zeros((2, 3), np.uint8), "candidate"),
        (np.zeros(4, np.uint8), r"candidate: shape \(4,\) found, \(height, width\) expected"),
        (np.zeros((2, 2)), "candidate: numbers of type float64 found, True where it is lit"),
        (np.full((2, 2), 3), r"candidate: 3 found at \(0, 0\), 0, 1 or 2 expected"),
        (np.full((2, 2), -1), r"candidate: -1 found at \(0, 0\), 0, 1 or 2 expected"),
        (np.full((2, 2), "lit"), "candidate: an array of shape .* found, .* expected"),
        ([[0, 1], [0]], r"candidate: \[\[0, 1\], \[0\]\] found, .* lists of one length, expected"),
    ],
)
def test_masks_that_are_none_are_refused(mask, message):
    with pytest.raises(gnomon.InputError, match=message) as refused:
        gnomon.compare(mask, np.zeros((2, 2), np.uint8))
    assert "\n" not in str(refused.value)
    assert isinstance(refused.value, ValueError)


def test_errors_are_one_line():
    heights = np.full((4, 4), math.nan, np.float32)
    with pytest.raises(gnomon.InputError) as refused:
        gnomon.horizons(heights, 4, 4)
    assert "\n" not in str(refused.value)
    with pytest.raises(gnomon.InputError, match="nowhere.obj"):
        gnomon.read_surface("nowhere.obj", "none")


@pytest.mark.parametrize("order", "<>")
def test_masks_of_doubles_are_read_as_written(order, tmp_path):
    """A TIFF of 64-bit floats, put down by hand: 1 is lit."""
    tags = [(256, 3, 2), (257, 3, 2), (258, 3, 64), (259, 3, 1), (262, 3, 1), (273, 4, 8)]
    tags += [(278, 3, 2), (279, 4, 32), (339, 3, 3)]
    data = (b"II" if order == "<" else b"MM") + struct.pack(order + "HI4d", 42, 40, 1, 0, 0, 1)
    data += struct.pack(order + "H", len(tags))
    for tag, kind, value in tags:
        data += struct.pack(order + ("HHIHxx" if kind == 3 else "HHII"), tag, kind, 1, value)
    (tmp_path / "doubles.tif").write_bytes(data + bytes(4))
    assert gnomon.read_mask(tmp_path / "doubles.tif").tolist() == [[1, 0], [0, 1]]
    assert gnomon.read_shares(tmp_path / "doubles.tif").tolist() == [[1, 0], [0, 1]]
