#!/usr/bin/env python3
"""How much masks differ between two systems or processors.

    gnomon run scenes/*.toml scenes/bodies/*.toml --out out      on each of them
    results/systems.py out-a out-b                               compares the masks of both
    results/systems.py --references out                          compares runs in full form with references

Prints a line of Markdown for every study: its masks, how many of them differ at all, the truth's and
the method's mask that differ most, as shares of their samples, and the largest change of a
rate; below them, in how many studies it is more than the least tolerance of a reference. With --references
it names the values of the references that the runs are off by more than their tolerance. Exit status 0,
whatever differs; 3 where a study, mask or value is missing on one side.
"""

import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PROGRAM = os.environ.get("GNOMON_PROGRAM", "gnomon")
REFERENCES = pathlib.Path(__file__).resolve().parent
RULE = REFERENCES.parent / "validate/study/judge/baseline.h"
RATES = ("error_rate", "false_shadow", "false_light", "prevalence")


def least_tolerance():
    """The least tolerance of a reference for a rate, a share, from the header that states it."""
    return float(re.search(r"leastRateTolerance = ([0-9.]+);", RULE.read_text(encoding="utf-8")).group(1))


def mask_folders(results):
    """The folders of masks below a folder of results, by the name of their study or step."""
    root = pathlib.Path(results)
    found = {str(path.parent.relative_to(root)): path for path in sorted(root.glob("**/masks"))}
    if not found:
        sys.exit(f"systems.py: {results}: no masks found, a folder of finished runs expected")
    return found


def completed(folder, names, place):
    """Links to all masks of a folder. Another base's truth, VIEW_LIGHT_truth_BASE, is written only
    where it differs from VIEW_LIGHT_truth, which stands for one that is not there."""
    place.mkdir()
    for name in names:
        mask = pathlib.Path(folder) / name
        if not mask.exists() and "_truth_" in name:
            mask = pathlib.Path(folder) / (name.split("_truth_")[0] + "_truth" + mask.suffix)
        if mask.exists():
            (place / name).symlink_to(mask.resolve())
    return place


def comparison(candidate, truth):
    """What the program says of two masks or two folders of them; its message where it cannot compare them."""
    try:
        run = subprocess.run([PROGRAM, "compare", candidate, truth, "--json", "-"], capture_output=True, text=True)
    except FileNotFoundError:
        sys.exit(f"systems.py: {PROGRAM}: not found; GNOMON_PROGRAM=build/release/gnomon expected, or an installed one")
    return json.loads(run.stdout) if run.returncode == 0 else run.stderr


def compared_pair(mask_a, mask_b):
    """The comparison of two masks. At an outline one of them may have a sample that the other lacks: a
    truth may lack samples, a candidate may not."""
    for pair in ((mask_a, mask_b), (mask_b, mask_a)):
        result = comparison(*pair)
        if isinstance(result, dict):
            return result
    sys.stderr.write(result)
    sys.exit(3)


def differing(pair):
    """Samples that differ in a pair, of those that one of both has, as a share."""
    outline = abs(pair["candidate"]["none"] - pair["truth"]["none"])
    return ((pair["error_rate"] or 0.0) * pair["samples"] + outline) / max(pair["samples"] + outline, 1)


def compared(folder_a, folder_b):
    """(name, share of samples that differ) of every mask of two folders."""
    names = {mask.name for folder in (folder_a, folder_b) for mask in pathlib.Path(folder).iterdir()
             if mask.is_file()}
    with tempfile.TemporaryDirectory() as folder:
        a, b = [completed(masks, names, pathlib.Path(folder) / side)
                for side, masks in (("a", folder_a), ("b", folder_b))]
        result = comparison(a, b)
        if isinstance(result, dict):
            pairs = result["pairs"] if "pairs" in result else [result]
        else:
            pairs = [compared_pair(a / name, b / name) for name in sorted(names)]
    return [(pathlib.Path(pair["candidate"]["file"]).stem, differing(pair)) for pair in pairs]


def figures(table):
    """Rows over all samples of a table of figures, by method, view, light and answer."""
    with open(table, newline="", encoding="utf-8") as file:
        return {tuple(row[name] for name in ("method", "view", "light", "answer")): row
                for row in csv.DictReader(file) if row["region"] == "all"}


def rates(table):
    """The rates of a table of figures, by row and metric."""
    return {key + (metric,): float(row[metric])
            for key, row in figures(table).items() for metric in RATES if row.get(metric)}


def moved(folder_a, folder_b):
    """The largest change of a rate between two folders of one study."""
    a = rates(folder_a / "metrics.csv")
    b = rates(folder_b / "metrics.csv")
    return max((abs(a[key] - b[key]) for key in a.keys() & b.keys()), default=0.0)


def largest(masks):
    """The mask that differs most, in percent, with its name; a dash where there is none."""
    if not masks:
        return "–"
    name, share = max(masks, key=lambda mask: mask[1])
    return f"{100 * share:.4f}" + (f" ({name})" if share > 0 else "")


def count(masks):
    """How many of the masks differ at all."""
    return sum(share > 0 for _, share in masks)


def against_references(results):
    """Holds every value of the references, which lie by folders as the runs do, against its run."""
    count = 0
    beyond = []
    for path in sorted(REFERENCES.glob("**/reference/*.json")):
        folder = pathlib.Path(results) / path.parent.parent.relative_to(REFERENCES)
        tables = {}
        for value in json.loads(path.read_text(encoding="utf-8"))["values"]:
            study = folder / value["study"]
            if study not in tables:
                if not (study / "metrics.csv").exists():
                    sys.stderr.write(f"systems.py: {study}: no metrics.csv found\n")
                    sys.exit(3)
                tables[study] = figures(study / "metrics.csv")
            row = tables[study].get(tuple(value[name] for name in ("method", "view", "light", "answer")))
            if row is None or not row[value["metric"]]:
                sys.stderr.write(f"systems.py: {study}: no {value['metric']} of {value['method']} found\n")
                sys.exit(3)
            count += 1
            change = abs(float(row[value["metric"]]) - value["value"])
            if change > value["tolerance"]:
                beyond.append((change, value))
    print("| study | method | view, light, answer | metric | moved by | tolerance |\n|---|---|---|---|---|---|")
    for change, value in beyond:
        print(f"| `{value['study']}` | `{value['method']}` | {value['view']}, {value['light']}, {value['answer']} "
              f"| {value['metric']} | {change:.4f} | {value['tolerance']:.4f} |")
    print(f"\nValues of references: {count}, beyond their tolerance: {len(beyond)}")


def main(results_a, results_b):
    folders_a = mask_folders(results_a)
    folders_b = mask_folders(results_b)
    if missing := sorted(folders_a.keys() ^ folders_b.keys()):
        sys.exit(f"systems.py: {', '.join(missing)}: only one of the two folders has it")
    print("| study | masks | differ | truth, % | method, % | rate, points |")
    print("|---|---|---|---|---|---|")
    least = least_tolerance()
    beyond = 0
    all_masks, all_truths = [], []
    for name, folder_a in folders_a.items():
        masks = compared(folder_a, folders_b[name])
        truths = [mask for mask in masks if "_truth" in mask[0]]
        methods = [mask for mask in masks if "_truth" not in mask[0]]
        all_masks += masks
        all_truths += truths
        change = moved(folder_a.parent, folders_b[name].parent)
        beyond += change > least
        print(f"| `{name}` | {len(masks)} | {count(masks)} | {largest(truths)} | {largest(methods)} "
              f"| {100 * change:.4f} |", flush=True)
    print(f"\nMasks: {len(all_masks)}, that differ: {count(all_masks)}, of a truth: {count(all_truths)}")
    print(f"Studies with a rate that moved by more than {100 * least:g} points: {beyond}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: results/systems.py RESULTS RESULTS, or --references RESULTS")
    if sys.argv[1] == "--references":
        against_references(sys.argv[2])
    else:
        main(*sys.argv[1:])
