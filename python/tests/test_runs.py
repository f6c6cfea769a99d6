import csv
import os
import signal
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


def test_an_interrupt_ends_a_run(study):
    """As Ctrl-C does: the signal comes while the run is at work."""
    began = threading.Event()

    def interrupt():
        began.wait(60)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        gnomon.run(
            study,
            set={"view.0.width": 2048, "view.0.height": 2048, "truth.step": 0.02},
            cache=False,
            progress=lambda stage, share: began.set(),
        )
    thread.join()
    assert time.monotonic() - start < 60
    assert not (study.parent / "out/small/summary.json").exists()


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
