"""A light with a disc: shares in place of masks, those of the command line to the bit."""

import json
import math

import numpy as np
import pytest
from conftest import command

import gnomon

DISC = 4  # degrees


@pytest.fixture
def soft(study):
    """The small study under a disc and under a point."""
    text = study.read_text().replace("elevation = 30\n", f"elevation = 30\nradius = {DISC}\n")
    text += '[[light]]\nname = "point"\nazimuth = 20\nelevation = 30\n'
    study.write_text(text + '[[method]]\nname = "max-forsyth"\ndisc = true\n')
    return study


def test_a_run_gives_shares_where_the_light_is_soft(soft):
    result = gnomon.run(soft)
    for key in [("camera", "evening"), ("max-forsyth", "camera", "evening")]:
        map = result.truth[key] if len(key) == 2 else result.masks[key]
        assert map.dtype == np.float32
    truth = result.truth["camera", "evening"]
    assert ((truth > 0) & (truth < 1)).sum() > 100
    of_hard = result.masks["max-forsyth", "camera", "evening"]
    assert set(np.unique(of_hard[~np.isnan(of_hard)])) == {0, 1}
    shares = result.masks["max-forsyth + disc", "camera", "evening"]
    assert ((shares > 0) & (shares < 1)).sum() > 100
    assert result.truth_of("max-forsyth", "camera", "evening").tobytes() == truth.tobytes()
    hard = result.truth["camera", "point"]
    assert hard.dtype == np.uint8 and set(np.unique(hard)) <= {0, 1, 2}
    assert result.masks["max-forsyth", "camera", "point"].dtype == np.uint8
    assert (np.isnan(truth) == (hard == 2)).all()


def test_compare_gives_the_command_line_s_figures(soft):
    result = gnomon.run(soft)
    truth = "out/small/masks/camera_evening_truth.png"
    for method, file in [("max-forsyth", "max-forsyth"), ("max-forsyth + disc", "max-forsyth-disc")]:
        told = command(
            "compare", f"out/small/masks/camera_evening_{file}.png", truth, "--json", "-"
        )
        assert told.returncode == 0, told.stderr
        expected = json.loads(told.stdout)
        mask = result.masks[method, "camera", "evening"]
        found = gnomon.compare(mask, result.truth["camera", "evening"])
        for key in ["tp", "fp", "fn", "tn", "samples"]:
            assert found[key] == expected[key], key
        metrics = {key: value for key, value in expected.items() if key in found}
        assert {"mae", "rmse", "assd", "penumbra_iou"} < set(metrics)
        assert metrics == {key: found[key] for key in metrics}
        interval = expected["confidence"]
        assert found["error_interval"] == [interval["low"], interval["high"]]
        # The study's own figures are of shares that no picture has rounded.
        assert found["mae"] == pytest.approx(result.value(method, "mae", "evening"), abs=1e-5)


def test_a_trace_gives_the_exported_shares(soft):
    """A map that both read, the exported samples, the same light: the same shares, to the bit."""
    heights = np.random.default_rng(5).integers(0, 2, (32, 32)).astype(np.float32)
    with open("heights.pgm", "wb") as file:
        file.write(b"P5 32 32 1\n" + heights.astype(np.uint8).tobytes())
    text = soft.read_text()
    begin, end = text.index("[relief]"), text.index("[bake]")
    relief = '[relief]\nimage = "heights.pgm"\nheight = 4\nheight_space = "world"\n'
    soft.write_text(text[:begin] + relief + text[end:])
    told = command("export", soft)
    assert told.returncode == 0, told.stderr
    exported = json.loads(open("out/small/export/export.json").read())
    values = np.load("out/small/export/samples/camera.npy")
    channels = {name: values[..., i] for i, name in enumerate(exported["channel_order"])}
    masks = {mask["light"]: mask for mask in exported["views"][0]["masks"]}
    lights = {light["name"]: light["direction"] for light in exported["lights"]}
    traced = gnomon.trace(
        gnomon.make_shape("plane", quads=(4, 4), size=(32, 32)),
        4 * heights[::-1],  # a picture's last row is v = 0
        gnomon.Samples(channels["face"], channels["s"], channels["t"]),
        [lights["evening"], lights["point"]],
        step=0.5,
        light_radius=[DISC, 0],
    )
    shares = gnomon.read_shares("out/small/export/" + masks["evening"]["shares"])
    assert np.array_equal(traced[0].shares, shares, equal_nan=True)
    assert 0 < np.nanmean(shares) < 1
    assert (traced[0].mask == np.where(np.isnan(shares), 2, shares >= 0.5)).all()
    assert traced[1].shares is None
    assert (traced[1].mask == gnomon.read_mask("out/small/export/" + masks["point"]["truth"])).all()
    for truth, light in zip(traced, ["evening", "point"]):
        assert truth.uncertainty == masks[light]["uncertainty"]


def test_compare_takes_masks_and_shares(soft):
    truth = np.array([[1, 0.5], [0, math.nan]])
    mask = np.array([[1, 0], [0, 2]], np.uint8)
    found = gnomon.compare(mask, truth)
    assert found["mae"] == found["error_rate"] == found["false_shadow"] == pytest.approx(0.5 / 3)
    assert gnomon.compare(truth, truth)["mae"] == 0
    assert gnomon.compare(truth, truth, weights=np.ones((2, 2)))["samples"] == 3
    assert gnomon.compare(truth, truth, roi=np.array([[True, False], [True, True]]))["samples"] == 2
    assert "mae" not in gnomon.compare(mask, mask)
    with pytest.raises(gnomon.InputError, match="candidate: numbers of type float64 found"):
        gnomon.compare(truth, mask)
    with pytest.raises(gnomon.InputError, match="candidate map: 2 at column 0, row 0"):
        gnomon.compare(2 * truth, truth)


@pytest.mark.parametrize(
    "radius, message",
    [
        (-1, "light 0: radius: -1 found, .* at most 10 expected .degrees"),
        (10.5, "light 0: radius: 10.5 found"),
        (math.nan, "light 0: radius: nan found"),
        ([0.1, 0.1], "light radii: 2 found, one for each of 1 lights expected"),
        ("sun", "light_radius: 'sun' found, a number of degrees expected"),
        ([[1]], r"light_radius: shape \(1, 1\) found, \(lights,\) expected"),
    ],
)
def test_radii_that_are_none_are_refused(radius, message):
    plane = gnomon.make_shape("plane", quads=(1, 1), size=(1, 1))
    flat = np.zeros((2, 2), np.float32)
    with pytest.raises(gnomon.InputError, match=message):
        gnomon.trace(
            plane, flat, gnomon.atlas(plane, 2), [(0, 0, 1)], step=0.5, light_radius=radius
        )
