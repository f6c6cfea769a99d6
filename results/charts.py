#!/usr/bin/env python3
"""The series of meshes cut into charts as one table, from its runs (`./gnomon reproduce --only charts`).

    python3 scenes/charts/charts.py series FOLDER
    gnomon run FOLDER/charts-*.toml --metrics-only --out RUNS
    results/charts.py RUNS charts.csv

Prints for every case the share of wrong samples in percent, the mean over views and lights, and the truth's own
uncertainty; writes the same as shares. Below stands where `two-scales-surface` is worse than `two-scales` by more
than 0.05 points, than `shadow-map` by more than the truth's uncertainty, or than no shadows at all, and where
`two-scales` is beyond 0.7 % or worse than `shadow-map` by more than the truth's uncertainty.
"""

import csv
import json
import pathlib
import sys

METHODS = ("unshadowed", "shadow-map", "two-scales", "two-scales-surface")


def cases_of(runs):
    """A row of the table for every case, in the order of the runs' own names."""
    cases = {}
    with open(runs / "ranking.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if not row["study"].startswith("charts-"):
                continue
            case = cases.setdefault(row["study"], {})
            case[row["method"]] = float(row["error_rate"])
            case["uncertainty"] = float(row["uncertainty"])
    for study, case in cases.items():
        if missing := [method for method in METHODS if method not in case]:
            sys.exit(f"charts.py: {study}: {', '.join(missing)} missing")
        texture = json.loads((runs / study / "summary.json").read_text(encoding="utf-8"))["texture"]
        case.update(case=study.removeprefix("charts-"), charts=texture["charts"], shared_area=texture["shared_area"])
    return list(cases.values())


def faults(case):
    """What a method is worse than, and by how many points."""
    limits = [("two-scales-surface", "two-scales", case["two-scales"] + 0.0005),
              ("two-scales-surface", "shadow-map", case["shadow-map"] + case["uncertainty"]),
              ("two-scales-surface", "unshadowed", case["unshadowed"]),
              ("two-scales", "0.70 %", 0.007),
              ("two-scales", "shadow-map", case["shadow-map"] + case["uncertainty"])]
    return [f"{case['case']}: `{method}` {100 * case[method]:.3f} %, worse than {than if than[0] == '0' else f'`{than}`'}"
            for method, than, most in limits if case[method] > most]


def main(runs, table):
    cases = cases_of(pathlib.Path(runs))
    if not cases:
        sys.exit(f"charts.py: {runs}: no run of a study `charts-…` found")
    print("| case | charts | shared, % | " + " | ".join(f"`{method}`" for method in METHODS) + " | truth ± |")
    print("|---|" + "---|" * (len(METHODS) + 3))
    for case in cases:
        errors = " | ".join(f"{100 * case[name]:.2f}" for name in (*METHODS, "uncertainty"))
        print(f"| {case['case']} | {case['charts']:,} | {100 * case['shared_area']:.1f} | {errors} |")
    for line in (line for case in cases for line in faults(case)):
        print(line)
    pathlib.Path(table).parent.mkdir(parents=True, exist_ok=True)
    with open(table, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ("case", "charts", "shared_area", *METHODS, "uncertainty"), lineterminator="\n")
        writer.writeheader()
        writer.writerows(cases)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: results/charts.py RUNS charts.csv")
    main(*sys.argv[1:])
