#!/usr/bin/env python3
"""The figures of tables in the manual and in results/README.md, from the files that results/ holds.

    results/tables.py            writes them anew
    results/tables.py --check    names the rows that differ, and ends with 1 where there is one

Who writes a table chooses its rows and columns. A table is known by its header, or by the heading over
it; its figures keep as many decimals as they have, and what no file has is "–". Tables of other kinds,
and figures in sentences, stay as they are.
"""

import collections
import csv
import functools
import itertools
import json
import pathlib
import re
import sys

RESULTS = pathlib.Path(__file__).resolve().parent
PAGES = ("README.md", "results/README.md", "results/tables.md", "docs/settings.md", "docs/which-method.md")
NONE = "–"


# ---- what the files say, in percent


def rows_of(name):
    with open(RESULTS / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@functools.cache
def json_of(name):
    return json.loads((RESULTS / name).read_text(encoding="utf-8"))


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else None


@functools.cache
def ranked(folder):
    """{(study, method): row} of the ranking of a folder of results."""
    return {(row["study"], row["method"]): row for row in rows_of(f"{folder}ranking.csv")}


def studies_in(folder):
    return {study for study, _ in ranked(folder)}


@functools.cache
def errors(study, value=""):
    """{method: its errors as drawn in all views under all lights}, from the study's reference; of a
    sweep those of the cases whose folder begins with the value."""
    folder, _, name = study.rpartition("/")
    found = collections.defaultdict(list)
    for row in json_of(f"{folder}/reference/{name}.json" if folder else f"reference/{name}.json")["values"]:
        is_asked = (row["answer"], row["metric"]) == ("drawn", "error_rate")
        if is_asked and row["study"].startswith(f"{name}/{value}" if value else name):
            found[row["method"]].append(100 * row["value"])
    return found


@functools.cache
def table_of(study):
    """{method: row} of a study's table: means over its views and lights."""
    return {row["method"]: row for row in rows_of(f"{study}/table.csv")}


def mean_error(study, method):
    return mean(errors(study).get(method, []))


@functools.cache
def costs(study):
    return {row["method"]: row for row in rows_of(f"{study}/costs.csv")}


def bytes_text(count):
    """As reports say it: "983 kB", "1.97 MB"."""
    if not count:
        return NONE
    return f"{count / 1e6:.2f} MB" if count >= 1e6 else f"{count / 1e3:.0f} kB"


# ---- tables


class Table:
    """Lines of a page that begin with "|", with the heading and the line of text over them."""

    def __init__(self, lines, heading, text):
        cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip()[1:-1])] for line in lines]
        self.header, self.rows = cells[0], cells[2:]
        self.heading, self.text = heading, text
        self.columns = [plain(cell) for cell in self.header]


def plain(cell):
    return cell.replace("`", "").replace("\\*", "").strip()


def figure(value, old, decimals=2):
    """A value with the decimals of what stands there."""
    if value is None:
        return NONE
    number = re.search(r"\.(\d+)", old)
    return f"{value:.{len(number.group(1)) if number else decimals}f}"


def over_studies(table):
    """Methods × studies."""
    studies = table.columns[1:]
    for folder in ("", "soft/"):
        if table.columns[0] == "method" and studies and set(studies) <= studies_in(folder):
            break
    else:
        return None

    def value(method, study):
        if method.startswith("truth"):
            return max(float(row["uncertainty"]) for (of, _), row in ranked(folder).items() if of == study)
        row = ranked(folder).get((study, method))
        return float(row["error_rate"]) if row and row["error_rate"] else None

    def text(method, study, old):
        found = value(method, study)
        return figure(None if found is None else 100 * found, old)

    return [row[:1] + [text(plain(row[0]), study, old) for study, old in zip(studies, row[1:])]
            for row in table.rows]


def ranking(table):
    if table.columns != ["method", "mean", "worst", "worst on"]:
        return None
    return [[f"`{method['label']}`", figure(100 * method["mean_error_rate"], ""),
             figure(100 * method["worst_error_rate"], ""), f"`{method['worst_study']}`"]
            for method in json_of("ranking.json")["methods"] if method["rank"]]


def suite(table):
    if table.columns[1:4] != ["mean", "95 %", "median"]:
        return None
    name = "suite-2" if "suns" in table.heading else "suite-1"
    statistics = json_of(f"{name}/suite.json")
    # Meshes are named in the titles of their scenes, "solid noise on a koala".
    bodies = {scene["name"] for scene in statistics["scenes"]
              if scene["title"].rsplit(" ", 1)[-1] in ("spot", "koala", "goathead", "trefoil")}
    count = len(statistics["scenes"])
    if table.columns[4:] != [f"{count - len(bodies)} patches", f"{len(bodies)} bodies"]:
        raise SystemExit(f"results/tables.py: {name}: {count} scenes, {len(bodies)} of them bodies")
    scenes = collections.defaultdict(lambda: ([], []))
    for row in rows_of(f"{name}/suite.csv"):
        if row["error_rate"]:
            scenes[row["method"]][row["scene"] in bodies].append(100 * float(row["error_rate"]))
    methods = {method["label"]: method for method in statistics["methods"]}

    def cells(row):
        label = plain(row[0])
        method, (patches, on_bodies) = methods[label], scenes[label]
        two = lambda value: f"{100 * value:.2f}"
        return [row[0], two(method["mean"]), f"{two(method['low'])} to {two(method['high'])}",
                two(method["median"]), figure(mean(patches), ""), figure(mean(on_bodies), "")]

    return [cells(row) for row in table.rows]


def papers_scenes(table):
    if table.columns[:4] != ["scene", "method", "error", "test alone"]:
        return None
    study, rows = "", []
    for row in table.rows:
        study, method = plain(row[0]) or study, plain(row[1])
        found = table_of(study)[method]
        metric = lambda name, old="": figure(100 * float(found[name]), old)
        rows.append(row[:2] + [metric("error_rate"), metric("test_error_rate"), metric("false_shadow"),
                               metric("false_light"), metric("iou", "0.0"), bytes_text(float(found["bytes"]))])
    return rows


def resolution(table):
    """Errors on maps of 1, 3 and 5 times as many texels a side."""
    names = [f"resolution-{name}" for name in table.columns[1:]]
    if table.columns[0] != "method" or not all((RESULTS / name).is_dir() for name in names) or \
            "Milliseconds" in table.text:
        return None
    swept = [{(row["method"], row["value"]): row["error_rate"] for row in rows_of(f"{name}/sweep.csv")}
             for name in names]
    return [row[:1] + [" / ".join(figure(100 * float(values[plain(row[0]), times]), "")
                                  for times in ("1", "3", "5")) for values in swept]
            for row in table.rows]


def cost(table):
    if table.columns[:5] != ["method", "triangles", "tables", "passes", "ms a frame"]:
        return None
    frame = lambda method: float(costs("figure8")[method]["frame_ms"])

    def cells(row):
        name = plain(row[0])
        method = costs("figure8")[name]
        return [row[0], f"{int(method['polygons']):,}", bytes_text(int(method["table_bytes"])), method["passes"],
                f"{frame(name):.1f}", f"{frame(name) / frame('max-forsyth'):.2f}"]

    return [cells(row) for row in table.rows]


def figure8(table):
    if table.columns != ["method", "wrong pixels", "95 % interval", "tables and height map"]:
        return None

    def cells(row):
        method = table_of("figure8")[re.match(r"`([^`]+)`", row[0]).group(1)]
        share, low, high = (f"{100 * float(method[key]):.2f}" for key in ("error_rate", "low", "high"))
        return [row[0], f"{share} %", f"{low} to {high}", bytes_text(float(method["bytes"]))]

    return [cells(row) for row in table.rows]


def spot(table):
    if table.columns != ["method", "terrain", "cells", "columns"]:
        return None
    return [row[:1] + [figure(mean_error(f"spot-{name}", plain(row[0])), old)
                       for name, old in zip(table.columns[1:], row[1:])] for row in table.rows]


def spot_regions(table):
    """Of all samples of a region, in the views and under the lights together."""
    if table.columns[:2] != ["method", "lit"]:
        return None

    def rows(method, region):
        return [row for row in rows_of("spot-terrain/metrics.csv")
                if (row["method"], row["answer"], row["region"]) == (method, "drawn", region)]

    def value(method, region):
        samples = lambda found: sum(float(row["samples"]) for row in found)
        if method == "share":
            return 100 * samples(rows("unshadowed", region)) / samples(rows("unshadowed", "all"))
        found = [row for row in rows(method, region) if row["error_rate"]]
        return 100 * sum(float(row["error_rate"]) * float(row["samples"]) for row in found) / samples(found)

    return [row[:1] + [figure(value(plain(row[0]), region), old)
                       for region, old in zip(table.columns[1:], row[1:])] for row in table.rows]


def bodies(table):
    """The mean and the worst over views and lights."""
    if table.columns[:3] != ["scene", "truth ±", "two-scales"]:
        return None

    def cells(row):
        name, _, size = plain(row[0]).partition(", ")
        study, value = f"bodies/{name}", ""
        if size:
            periods = {row["relief.period"] for row in rows_of(f"{study}/sweep.csv")}
            value = f"period-{(max if size == 'coarse' else min)(periods, key=float)}"
        for method in table.columns[2:]:
            found = errors(study, value)[method.split(",")[0]]
            yield f"{mean(found):.2f}, {max(found):.2f}"

    return [row[:2] + list(cells(row)) for row in table.rows]


def settings(table):
    """Half, the chosen and twice of a setting, on two studies."""
    if table.columns[:4] != ["method", "setting", "chosen", "why"]:
        return None
    rows = []
    for row in table.rows:
        method, setting = plain(row[0]), plain(row[1])
        if not method:
            rows.append(row)
            continue
        chosen = float(re.match(r"[\d.]+", plain(row[2])).group())
        new = list(row)
        for study, first in (("figure8-settings", 4), ("sphere-columns-settings", 8)):
            for k, old in enumerate(row[first:first + 3]):
                if not old:
                    continue
                label = method
                if k != 1 or "beside" in row[2]:
                    is_right = lambda number: (number < chosen, number == chosen, number > chosen)[k]
                    label = next(name for name in errors(study)
                                 if name.startswith(f"{method}, ") and setting in name
                                 and is_right(float(re.search(r"[\d.]+", name[len(method):]).group())))
                new[first + k] = figure(mean_error(study, label), old)
        rows.append(new)
    return rows


def frontier(table):
    if table.columns != ["method", "wrong", "frame, ms", "light still, ms"]:
        return None

    def cells(row):
        method = re.search(r"`([^`]+)`", row[0]).group(1)
        numbers = re.findall(r"(?:camera|light|,) ?(\d+)", row[0])
        label = f"{method} {', '.join(numbers)}".strip()
        label = label if label in costs("bodies/frontier-spot") else f"{method} 1"
        cost = costs("bodies/frontier-spot")[label]
        return [row[0], figure(mean_error("bodies/frontier-spot", label), ""),
                *(f"{float(cost[name]):.1f}" for name in ("frame_ms", "still_ms"))]

    return [cells(row) for row in table.rows]


KINDS = (figure8, over_studies, ranking, suite, papers_scenes, resolution, cost, spot, spot_regions, bodies,
         settings, frontier)


# ---- pages


def line_of(row, table, lines):
    """A row as a line; the line that is there, where it has the same cells."""
    return lines[table.rows.index(row)] if row in table.rows else "| " + " | ".join(row) + " |"


def filled(text, report):
    """A page with its tables filled; `report(old, new)` hears of every row that changes."""
    lines = text.split("\n")
    heading, before, at = "", "", 0
    while at < len(lines):
        line = lines[at]
        if line.startswith("#"):
            heading = line
        if not line.startswith("|"):
            before = line or before
            at += 1
            continue
        end = at
        while end < len(lines) and lines[end].startswith("|"):
            end += 1
        table = Table(lines[at:end], heading, before)
        rows = next((rows for kind in KINDS if (rows := kind(table)) is not None), table.rows)
        old = lines[at + 2:end]
        new = [line_of(row, table, old) for row in rows]
        for before_it, after_it in itertools.zip_longest(old, new, fillvalue=""):
            if before_it != after_it:
                report(before_it, after_it)
        lines[at + 2:end] = new
        end = at + 2 + len(new)
        at = end
    return "\n".join(lines)


def main(arguments):
    if arguments not in ([], ["--check"]):
        raise SystemExit("usage: results/tables.py [--check]")
    drift = 0
    for page in PAGES:
        file = RESULTS.parent / page

        def report(old, new):
            nonlocal drift
            drift += 1
            print(f"{page}\n  has  {old}\n  from the files  {new}")

        text = file.read_text(encoding="utf-8")
        new = filled(text, report)
        if not arguments and new != text:
            file.write_text(new, encoding="utf-8")
    print(f"{drift} rows differ" if drift else "all tables as the files have them")
    return 1 if drift and arguments else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
