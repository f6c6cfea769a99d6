#!/usr/bin/env python3
"""What results/ keeps of a study's run, and whether another run gives the same.

    results/kept.py keep RUNS STUDY…      copies it from the folder of runs
    results/kept.py compare RUNS STUDY…   names what differs; ends with 1 where something does

A study keeps its tables and `sha256.txt`: a hash of every table without its frame times, and one of all
masks. What pages show or `tables.py` reads beside these is in `ALSO`.
"""

import csv
import hashlib
import io
import json
import pathlib
import shutil
import sys

RESULTS = pathlib.Path(__file__).resolve().parent
TABLES = ("table.csv", "table.md", "sweep.csv", "frontier.csv", "budget.csv")
HASHED = ("table.csv", "metrics.csv", "bins.csv", "cases.csv", "sweep.csv", "frontier.csv", "budget.csv", "masks")
ALSO = {"figure8": ("metrics.csv", "costs.csv", "images", "masks", "regions"), "spot-terrain": ("metrics.csv",),
        "frontier": ("plots/frontier.svg",), "bodies/frontier-spot": ("costs.csv", "plots/frontier_time.svg")}
COSTS = ("method", "polygons", "passes", "table_bytes", "height_bytes", "frame_ms", "still_ms")


def rows_without_times(text):
    rows = list(csv.reader(io.StringIO(text)))
    kept = [k for k, name in enumerate(rows[0]) if name != "frame_ms"] if rows else []
    return [[row[k] for k in kept] for row in rows]


def hash_of(file):
    """Of a folder over the names and hashes of its files."""
    if file.is_dir():
        text = "".join(f"{hash_of(one)}  {one.name}\n" for one in sorted(file.iterdir()))
        return hashlib.sha256(text.encode()).hexdigest()
    if file.suffix == ".csv":
        rows = rows_without_times(file.read_text(encoding="utf-8"))
        return hashlib.sha256("".join(",".join(row) + "\n" for row in rows).encode()).hexdigest()
    return hashlib.sha256(file.read_bytes()).hexdigest()


def hashed(run, study):
    names = [name for name in HASHED + ALSO.get(study, ()) if name not in ("costs.csv", "plots/frontier_time.svg")]
    return {name: hash_of(run / name) for name in dict.fromkeys(names) if (run / name).exists()}


def write_costs(run, file):
    """What a frame of each method takes: triangles, passes, bytes and milliseconds."""
    summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
    with open(file, "w", newline="", encoding="utf-8") as stream:
        rows = csv.DictWriter(stream, COSTS, extrasaction="ignore", lineterminator="\n")
        rows.writeheader()
        rows.writerows(summary["cost"])


def keep(run, study):
    folder = RESULTS / study
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name in TABLES + ALSO.get(study, ()):
        source = run / name
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        if name == "costs.csv":
            write_costs(run, folder / name)
        elif source.is_dir():
            shutil.copytree(source, folder / name)
        elif source.exists():
            shutil.copyfile(source, folder / name)
    lines = [f"{sha}  {name}\n" for name, sha in hashed(run, study).items()]
    (folder / "sha256.txt").write_text("".join(lines), encoding="utf-8")
    return 0


def compare(run, study):
    lines = (RESULTS / study / "sha256.txt").read_text(encoding="utf-8").splitlines()
    before = {name: sha for sha, name in (line.split("  ") for line in lines)}
    now = hashed(run, study)
    differing = [name for name in before if now.get(name) != before[name]]
    for name in differing:
        print(f"differs: {name} of {run} from that of results/{study}/sha256.txt")
    return len(differing)


def main(arguments):
    tasks = {"keep": keep, "compare": compare}
    if len(arguments) < 3 or arguments[0] not in tasks:
        raise SystemExit("usage: results/kept.py keep|compare RUNS STUDY…")
    runs = pathlib.Path(arguments[1])
    return min(1, sum(tasks[arguments[0]](runs / study, study) for study in arguments[2:]))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
