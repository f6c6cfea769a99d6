import csv
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from conftest import command

import gnomon


def test_a_run_is_the_command_line_s_to_the_bit(study):
    result = gnomon.run(study, out="python")
    told = command("run", study, "--out", "shell")
    assert told.returncode == 0, told.stderr
    shell = gnomon.load("shell/small")
    for name in ["metrics.csv", "bins.csv"]:
        assert (result.folder / name).read_bytes() == (shell.folder / name).read_bytes()
    assert result.summary["results"] == shell.summary["results"]
    assert result.passed is None and result.failures == []
    masks = result.masks
    assert set(masks) == {(m, "camera", "evening") for m in ("unshadowed", "max-forsyth")}
    for key in masks:
        assert (masks[key] == shell.masks[key]).all()


def test_the_masks_give_the_metrics(study):
    result = gnomon.run(study)
    for method, view, light in result.masks:
        figures = gnomon.compare(result.masks[method, view, light], result.truth[view, light])
        assert figures["error_rate"] == result.value(method)
        assert (result.truth_of(method, view, light) == result.truth[view, light]).all()
    # The control: without shadows more is wrong.
    assert result.value("unshadowed") > result.value("max-forsyth")


def test_metrics_are_one_long_table(study):
    result = gnomon.run(study, methods=["max-forsyth"])
    rows = result.rows()
    (error,) = [
        row["value"]
        for row in rows
        if (row["metric"], row["region"], row["answer"]) == ("error_rate", "all", "drawn")
    ]
    assert error == result.value("max-forsyth")
    with open(result.folder / "metrics.csv", encoding="utf-8") as stream:
        wide = list(csv.DictReader(stream))
    assert len(rows) == len(wide) * (len(wide[0]) - 6)


def test_rows_have_the_intervals_and_the_truths_uncertainty(study):
    """As the long table of a sweep of one case has them."""
    several = study.read_text() + '[[light]]\nname = "noon"\nazimuth = 20\nelevation = 60\n'
    for text, out in [(study.read_text(), "one"), (several, "two")]:
        study.write_text(text)
        single = gnomon.run(study, out=out + "-single")
        study.write_text(text + '[sweep]\nkey = "relief.height"\nvalues = [4, 5]\n')
        swept = gnomon.run(study, out=out + "-swept")
        known = ("method", "light", "view", "answer", "region", "metric")
        by_name = {tuple(row[key] for key in known): row for row in single.rows()}
        shares = ["error_rate", "false_shadow", "false_light"]
        compared = 0
        for row in swept.rows():
            if row["relief.height"] != 4:
                continue
            own = by_name[tuple(row[key] for key in known)]
            assert own["value"] == row["value"]
            assert (own["low"], own["high"]) == (row["low"], row["high"])
            if row["metric"] in shares and row["region"] == "all":
                assert own["uncertainty"] == row["uncertainty"]
                compared += 1
        assert compared > 10
        scores = [row for row in single.rows() if row["low"] is not None]
        assert len(scores) == 2 * (1 if out == "one" else 2)
        assert all(row["low"] <= row["value"] <= row["high"] for row in scores)


def test_names_that_are_not_there_are_answered_with_those_that_are(study):
    result = gnomon.run(study)
    for asked, message in [
        ({"method": "max-forsith"}, "method 'max-forsith' not found, one of 'max-forsyth', 'unshadowed' expected"),
        ({"metric": "error"}, "metric 'error' not found, one of .*'error_rate'.* expected"),
        ({"metric": "method"}, "metric 'method' not found"),
        ({"light": "noon"}, "light 'noon' not found, one of 'evening' expected"),
        ({"view": "atlas"}, "view 'atlas' not found, one of 'camera' expected"),
        ({"region": "sea"}, "region 'sea' not found, one of 'all'"),
        ({"answer": "asked"}, "answer 'asked' not found, one of 'drawn', 'test' expected"),
    ]:
        with pytest.raises(gnomon.UnknownNameError, match="^" + message) as refused:
            result.value(**{"method": "max-forsyth", **asked})
        assert isinstance(refused.value, KeyError) and isinstance(refused.value, gnomon.InputError)
        assert "\n" not in str(refused.value)
    key = ("max-forsyth", "camera", "noon")
    with pytest.raises(KeyError, match="'max-forsyth', 'camera', 'evening'"):
        result.masks[key]
    assert key not in result.masks and result.masks.get(key) is None
    with pytest.raises(KeyError, match="'camera', 'evening'"):
        result.truth["camera", "noon"]
    with pytest.raises(KeyError, match="'max-forsyth', 'camera', 'evening'"):
        result.truth_of(*key)
    study.write_text(
        study.read_text() + '[[light]]\nname = "noon"\nazimuth = 20\nelevation = 60\n'
    )
    with pytest.raises(KeyError, match="light: none found, one of 'evening', 'noon' expected"):
        gnomon.run(study).value("max-forsyth")


def test_masks_are_as_their_pictures_and_an_inverted_one_is_noticed(study):
    """White is 1: what a run writes, what Python reads, what a study is given."""
    result = gnomon.run(study)
    truth = result.truth["camera", "evening"]
    mask = result.masks["unshadowed", "camera", "evening"]
    assert (mask == 1).sum() > (truth == 1).sum() > (truth == 0).sum() > 0
    given = study.parent / "given"
    given.mkdir()
    # Without a writer of PNG: grey letters of the portable formats.
    picture = np.choose(truth, [255, 0, 128]).astype(np.uint8)
    for name in ["evening", "camera_evening"]:
        with open(given / f"{name}.pgm", "wb") as file:
            file.write(b"P5 %d %d 255\n" % picture.shape[::-1] + picture.tobytes())
    text = study.read_text() + '[[method]]\nmasks = "given"\nlabel = "theirs"\n'
    study.write_text(text)
    (given / "evening.pgm").unlink()
    measured = gnomon.run(study)
    assert measured.value("theirs") == 1
    expected = "100 % of the samples are wrong, and the complement would be 0 % wrong: is one of them inverted?"
    (notice,) = [one for one in measured.summary["notices"] if "inverted" in one]
    assert notice == f"theirs: camera_evening.pgm: {expected}"
    told = command("compare", given / "camera_evening.pgm", "out/small/masks/camera_evening_truth.png")
    assert expected in " ".join(told.stdout.split())
    with pytest.warns(UserWarning) as warned:
        figures = gnomon.compare(np.where(truth == 2, 2, 1 - truth % 2), truth)
    assert str(warned[0].message) == figures["notice"] == expected
    assert gnomon.compare(truth, truth)["notice"] is None


def test_settings_override_keys(study):
    low = gnomon.run(study, set={"relief.height": 1, "relief.wrap": "clamp"}, out="low")
    settings = low.summary["study"]["settings"]
    assert settings["relief"]["height"] == 1
    assert settings["relief"]["wrap"] == "clamp"
    assert gnomon.run(study, out="high").value("unshadowed") > low.value("unshadowed")
    with pytest.raises(gnomon.InputError, match="relief.hight"):
        gnomon.run(study, set={"relief.hight": 1})


def test_a_sweep_has_its_keys_in_the_rows(study):
    study.write_text(
        study.read_text() + '[sweep]\nkey = "relief.height"\nvalues = [1, 2]\n'
    )
    rows = gnomon.run(study).rows()
    assert {row["relief.height"] for row in rows} == {1, 2}
    assert {"case", "method", "metric", "value", "low", "high"} <= set(rows[0])


def test_a_sweep_has_no_single_figure(study):
    study.write_text(study.read_text() + '[sweep]\nkey = "relief.height"\nvalues = [1, 2]\n')
    with pytest.raises(gnomon.InputError, match=r"a sweep found, .* rows\(\) has them"):
        gnomon.run(study).value("max-forsyth")


@pytest.mark.parametrize("text", ["[]", "{}", "3", "{"])
def test_a_folder_of_something_else_is_refused(text, tmp_path):
    (tmp_path / "summary.json").write_text(text)
    with pytest.raises(gnomon.InputError, match="summary.json: no "):
        gnomon.load(tmp_path)


def test_names_stay_text(study):
    text = study.read_text().replace('"evening"', '"30"')
    study.write_text(text + '[sweep]\nkey = "relief.height"\nvalues = [1, 2]\n')
    assert {row["light"] for row in gnomon.run(study).rows()} == {"30"}


def test_a_folder_of_runs_is_one_table(study):
    gnomon.run(study)
    (study.parent / "other.toml").write_text(study.read_text().replace('"small"', '"other"'))
    gnomon.run(study.parent / "other.toml")
    results = gnomon.load("out")
    assert [result.name for result in results] == ["other", "small"]
    assert {row["study"] for row in results.rows()} == {"other", "small"}
    with pytest.raises(gnomon.InputError, match="no summary.json found"):
        gnomon.load(study.parent / "cache")
    summary = pathlib.Path("out/small/summary.json")
    summary.write_text(summary.read_text().replace("{", '{"schema": "none", ', 1))
    with pytest.raises(gnomon.InputError, match='"schema": a second time'):
        gnomon.load("out")


def test_metrics_are_a_frame_where_pandas_is(study):
    pandas = pytest.importorskip("pandas")
    frame = gnomon.run(study).metrics
    assert isinstance(frame, pandas.DataFrame)
    assert {"method", "metric", "value"} <= set(frame.columns)


def test_thresholds_that_fail_are_told(study):
    study.write_text(
        study.read_text()
        + '[[threshold]]\nmethod = "unshadowed"\nmetric = "error_rate"\nmax = 0.0001\n'
    )
    result = gnomon.run(study)
    assert result.passed is False
    assert len(result.failures) == 1 and "unshadowed" in result.failures[0]


def test_progress_is_told_and_may_end_a_run(study):
    stages = []
    gnomon.run(study, cache=False, progress=lambda stage, share: stages.append((stage, share)))
    assert len({stage for stage, _ in stages}) > 3
    assert all(0 <= share <= 1 for _, share in stages)

    class Enough(Exception):
        pass

    def stop(stage, share):
        raise Enough(stage)

    with pytest.raises(Enough):
        gnomon.run(study, out="ended", cache=False, progress=stop)
    assert not (study.parent / "ended/small/summary.json").exists()


@pytest.mark.parametrize("wanted", ["truth", "compare"])
def test_an_interrupt_ends_a_run_within_a_second(study, wanted):
    """As Ctrl-C does: the signal comes while a stage of the run is at work."""
    sent = []

    def interrupt(stage, share):
        if wanted in stage and not sent:
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        gnomon.run(
            study,
            set={"view.0.width": 2048, "view.0.height": 2048, "truth.step": 0.02},
            cache=False,
            progress=interrupt,
        )
    assert time.monotonic() - sent[0] < 1.5
    assert not (study.parent / "out/small/summary.json").exists()


def test_runs_in_threads_do_not_touch_each_other(study):
    """One that fails early must not take the display from the others."""
    alone = gnomon.run(study, out="alone", cache=False)
    found = {}

    def run(number, **changes):
        try:
            found[number] = gnomon.run(study, out=f"thread-{number}", cache=False, **changes)
        except gnomon.InputError as error:
            found[number] = error

    changes = [{}, {"set": {"method.1.name": "no-such-method"}}] * 4
    threads = [
        threading.Thread(target=run, args=[number], kwargs=change)
        for number, change in enumerate(changes)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number, change in enumerate(changes):
        if change:
            assert "no-such-method" in str(found[number])
        else:
            for key, mask in alone.masks.items():
                assert (found[number].masks[key] == mask).all()


FORK = """
import multiprocessing, os, sys
import gnomon

def work(study):
    try:
        return repr(gnomon.run(study, out=sys.argv[2]).value("max-forsyth"))
    except gnomon.Error as error:
        return type(error).__name__ + ": " + str(error)

if __name__ == "__main__":
    for method in sys.argv[3:]:
        if method == "first":
            work(sys.argv[1])
        elif method == "bare":
            if os.fork() == 0:
                print(work(sys.argv[1]))
                sys.exit()
            os.wait()
        else:
            with multiprocessing.get_context(method).Pool(2) as pool:
                print(*pool.map(work, [sys.argv[1]]))
        sys.stdout.flush()
"""


def forked(study, *methods):
    script = study.parent / "fork.py"
    script.write_text(FORK)
    told = subprocess.run(
        [sys.executable, script, study, "forked", *methods],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert told.returncode == 0, told.stderr
    return told.stdout.splitlines()


def test_a_fork_of_a_process_that_has_used_gnomon_is_told_to_spawn(study):
    fork, bare, spawned = forked(study, "first", "fork", "bare", "spawn")
    for line in [fork, bare]:
        assert line.startswith("Error: this process is a fork of one that had used gnomon")
        assert 'multiprocessing.get_context("spawn")' in line
    assert spawned == repr(gnomon.run(study).value("max-forsyth"))


def test_a_fork_before_the_first_call_works(study):
    expected = repr(gnomon.run(study).value("max-forsyth"))
    assert forked(study, "fork", "bare") == [expected, expected]


def test_other_threads_run_meanwhile(study):
    counted = []
    done = threading.Event()

    def count():
        while not done.is_set():
            counted.append(1)
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = len(counted)
    gnomon.horizons(np.random.default_rng(3).random((512, 512), dtype=np.float32), 16, 128)
    between = len(counted) - before
    done.set()
    thread.join()
    assert between > 1


def test_what_is_no_study_is_one_line(study):
    study.write_text("[study]\nname = 3\n")
    with pytest.raises(gnomon.InputError, match=r"small\.toml:2: ") as refused:
        gnomon.run(study)
    assert "\n" not in str(refused.value)
    with pytest.raises(gnomon.InputError, match="nowhere.toml"):
        gnomon.run("nowhere.toml")
