"""Runs of studies, and what they left in their folders."""

import csv
import json
import os
import pathlib
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Set, Tuple, Union

import numpy as np

from gnomon import _gnomon

Path = Union[str, "os.PathLike[str]"]
Row = Dict[str, Any]

#: Columns of metrics.csv that say what a row is about; all others are metrics.
_ABOUT = ("study", "method", "light", "view", "answer", "region")
#: Columns of names, which stay text even where they look like numbers.
_NAMES = {*_ABOUT, "metric", "unit"}


def _frame(rows: List[Row]) -> Any:
    """Rows as a pandas DataFrame where pandas is there, else as they are."""
    try:
        import pandas
    except ImportError:
        return rows
    return pandas.DataFrame(rows)


def _number(text: str) -> Union[float, str, None]:
    if text == "":
        return None
    try:
        return float(text)
    except ValueError:
        return text


def _rows_of(file: pathlib.Path) -> List[Dict[str, str]]:
    with open(file, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def _read(file: pathlib.Path, is_soft: bool) -> np.ndarray:
    return _gnomon.read_shares(file) if is_soft else _gnomon.read_mask(file)


class _Masks(Mapping[Any, np.ndarray]):
    """Masks and maps of shares by key, each read when it is asked for.

    soft  the keys of maps of shares
    """

    def __init__(self, files: Dict[Any, pathlib.Path], soft: Set[Any]) -> None:
        self._files = files
        self._soft = soft

    def __getitem__(self, key: Any) -> np.ndarray:
        return _read(self._files[key], key in self._soft)

    def __iter__(self) -> Iterator[Any]:
        return iter(self._files)

    def __len__(self) -> int:
        return len(self._files)

    def __repr__(self) -> str:
        return f"masks of {list(self._files)}"


class Result:
    """The folder of one study or sweep that was run.

    folder    where it is
    summary   summary.json
    passed    whether every threshold holds; None where it was not judged
    failures  a line for each threshold that does not hold, after `run`
    """

    def __init__(self, folder: Path, failures: Sequence[str] = ()) -> None:
        self.folder = pathlib.Path(folder)
        self.failures = list(failures)
        file = self.folder / "summary.json"
        try:
            self.summary: Dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        except OSError as error:
            raise _gnomon.InputError(f"{file}: {error.strerror}; the folder of a run expected")
        except ValueError as error:
            raise _gnomon.InputError(f"{file}: no JSON: {error}")

    def __repr__(self) -> str:
        return f"<gnomon.Result {self.name!r} in {str(self.folder)!r}, {self.summary['status']}>"

    @property
    def name(self) -> str:
        """The study's name."""
        return self.folder.name

    @property
    def passed(self) -> Optional[bool]:
        status = self.summary["status"]
        return None if status == "not judged" else status == "pass"

    def rows(self) -> List[Row]:
        """The metrics in long form: a row for each method, light, view, answer, region and metric;
        of a sweep also for each case, with the swept keys."""
        cases = self.folder / "cases.csv"
        if cases.exists():
            return [
                {key: text if key in _NAMES else _number(text) for key, text in row.items()}
                for row in _rows_of(cases)
            ]
        rows = []
        for row in _rows_of(self.folder / "metrics.csv"):
            about = {key: row[key] for key in _ABOUT}
            for metric, text in row.items():
                if metric not in _ABOUT:
                    rows.append({**about, "metric": metric, "value": _number(text)})
        return rows

    @property
    def metrics(self) -> Any:
        """`rows` as a pandas DataFrame where pandas is there, else the list."""
        return _frame(self.rows())

    def value(
        self,
        method: str,
        metric: str = "error_rate",
        light: Optional[str] = None,
        view: Optional[str] = None,
        region: str = "all",
        answer: str = "drawn",
    ) -> Optional[float]:
        """One figure of a study. Light and view may be left out where there is one; None is a
        figure that is not defined."""
        found = [
            row
            for row in self.summary["results"]
            if row["method"] == method
            and row["region"] == region
            and row["answer"] == answer
            and light in (None, row["light"])
            and view in (None, row["view"])
        ]
        if len(found) != 1:
            raise KeyError(
                f"{len(found)} rows found for {method!r}, light {light!r}, view {view!r}, "
                f"region {region!r}, answer {answer!r}; one expected"
            )
        return found[0][metric]

    def _pictures(self) -> Iterator[Tuple[str, str, Dict[str, Any]]]:
        for panel in self.summary.get("panels", []):
            for picture in panel["pictures"]:
                yield panel["view"], panel["light"], picture

    def _is_soft(self, light: str) -> bool:
        """Whether a light is a disc: then what is called a mask holds shares."""
        lights = self.summary["study"]["settings"]["light"]
        return any(one["name"] == light and one.get("radius", 0) > 0 for one in lights)

    def _mask_files(self) -> Dict[Tuple[str, str, str], pathlib.Path]:
        return {
            (picture["method"], view, light): self.folder / picture["mask"]
            for view, light, picture in self._pictures()
            if picture["kind"] == "shaded" and picture["mask"]
        }

    @property
    def masks(self) -> Mapping[Tuple[str, str, str], np.ndarray]:
        """What each method drew, by (method, view, light): (height, width) uint8, 0 lit, 1 shadowed,
        2 no answer. Under a light with a disc float32: the share of it that is seen, in steps of
        1/65535, NaN no answer; of a hard method 0 and 1."""
        files = {key: file for key, file in self._mask_files().items() if key[0] != "truth"}
        return _Masks(files, {key for key in files if self._is_soft(key[2])})

    @property
    def truth(self) -> Mapping[Tuple[str, str], np.ndarray]:
        """The traced truth by (view, light), as `masks`: at the samples of the study's own mesh. Methods
        that draw another mesh have samples of their own, see `truth_of`."""
        files = {key[1:]: file for key, file in self._mask_files().items() if key[0] == "truth"}
        return _Masks(files, {key for key in files if self._is_soft(key[1])})

    def truth_of(self, method: str, view: str, light: str) -> np.ndarray:
        """The truth at the samples of a method."""
        for seen, lit, picture in self._pictures():
            if (picture.get("method"), seen, lit) == (method, view, light):
                return _read(self.folder / picture["truth"]["mask"], self._is_soft(lit))
        raise KeyError((method, view, light))


class Results(List[Result]):
    """Several runs, as `load` finds them in one folder."""

    def rows(self) -> List[Row]:
        """The rows of all of them, with the column "study"."""
        return [{"study": result.name, **row} for result in self for row in result.rows()]

    @property
    def metrics(self) -> Any:
        """`rows` as a pandas DataFrame where pandas is there, else the list."""
        return _frame(self.rows())


def load(folder: Path) -> Union[Result, Results]:
    """What runs left: a `Result` for the folder of one, `Results` for the folder that holds several."""
    path = pathlib.Path(folder)
    if (path / "summary.json").exists():
        return Result(path)
    found = sorted(path.glob("*/summary.json"))
    if not found:
        raise _gnomon.InputError(f"{path}: no summary.json found in it or one level below")
    return Results(Result(file.parent) for file in found)


def _setting(key: str, value: Any) -> str:
    """An override as the command line has it. Text stays bare: the study's key tells its type."""
    if isinstance(value, bool):
        return f"{key}={'true' if value else 'false'}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return f"{key}={json.dumps(np.asarray(value).tolist())}"
    if isinstance(value, (np.integer, np.floating)):
        value = value.item()
    return f"{key}={value}"


def run(
    study: Path,
    set: Optional[Mapping[str, Any]] = None,  # noqa: A002  the option's name
    methods: Sequence[str] = (),
    out: Path = "out",
    quick: bool = False,
    cache: bool = True,
    progress: Optional[Callable[[str, float], None]] = None,
) -> Result:
    """Measures a study or sweep as `gnomon run` does, and reads its folder `out`/NAME.

    set       overrides of its keys: {"relief.height": 4}
    methods   labels or names to keep; all by default
    quick     a quarter of each view's side: a preview
    progress  called with the stage's name and its share, 0 to 1; what it raises ends the run
    """
    settings = [_setting(key, value) for key, value in (set or {}).items()]
    summary, _, failures = _gnomon.run(
        pathlib.Path(study), pathlib.Path(out), list(methods), settings, quick, cache, progress
    )
    return Result(pathlib.Path(summary).parent, failures)
