"""Runs of studies, and what they left in their folders."""

import csv
import json
import os
import pathlib
from typing import (
    Any,
    Callable,
    Dict,
    Iterable,
    Iterator,
    List,
    Mapping,
    Optional,
    Sequence,
    Set,
    Tuple,
    Union,
)

import numpy as np

from gnomon import _gnomon, arguments

Path = Union[str, "os.PathLike[str]"]
Row = Dict[str, Any]

#: Columns of metrics.csv that say what a row is about; all others are metrics.
_ABOUT = ("study", "method", "light", "view", "answer", "region")
#: What a result of summary.json has beside metrics.
_NO_METRICS = {"method", "light", "view", "answer", "region", "undefined"}
#: Metrics that are shares of all samples, of which the truth's uncertainty is one.
_SHARES = {"error_rate", "false_shadow", "false_light", "mae"}
#: Columns of names, which stay text even where they look like numbers.
_NAMES = {*_ABOUT, "metric", "unit"}


class UnknownNameError(_gnomon.InputError, KeyError):
    """A method, view, light, metric or other name that a result does not have."""

    def __str__(self) -> str:
        return str(self.args[0])


def _unknown(what: str, name: Any, known: Iterable[Any]) -> UnknownNameError:
    there = ", ".join(sorted({repr(one) for one in known})) or "none"
    return UnknownNameError(f"{what} {name!r} not found, one of {there} expected")


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


def _object(pairs: List[Tuple[str, Any]]) -> Dict[str, Any]:
    """An object of JSON, none of whose keys may stand twice."""
    found = dict(pairs)
    if len(found) < len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise ValueError(f'"{twice}": a second time in one object, one expected')
    return found


def _rows_of(file: pathlib.Path) -> List[Dict[str, str]]:
    try:
        with open(file, newline="", encoding="utf-8") as stream:
            return list(csv.DictReader(stream))
    except OSError as error:
        raise _gnomon.InputError(f"{file}: {error.strerror}; the table of a run expected") from None


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
        if key not in self._files:
            raise _unknown("key", key, self._files)
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
    failures  a line for each threshold that does not hold, after `run`

    Raises InputError for a folder without a summary.json.
    """

    def __init__(self, folder: Path, failures: Sequence[str] = ()) -> None:
        self.folder = arguments.path(folder, "folder")
        self.failures = list(failures)
        file = self.folder / "summary.json"
        try:
            self.summary: Dict[str, Any] = json.loads(
                file.read_text(encoding="utf-8"), object_pairs_hook=_object
            )
        except OSError as error:
            raise _gnomon.InputError(
                f"{file}: {error.strerror}; the folder of a run expected"
            ) from None
        except ValueError as error:
            raise _gnomon.InputError(f"{file}: no JSON: {error}") from None
        if not (isinstance(self.summary, dict) and {"schema", "status"} <= set(self.summary)):
            raise _gnomon.InputError(f"{file}: no `schema` and `status` found, those of a run expected")

    def __repr__(self) -> str:
        return f"<gnomon.Result {self.name!r} in {str(self.folder)!r}, {self.summary['status']}>"

    @property
    def name(self) -> str:
        """The study's name."""
        return self.folder.name

    @property
    def passed(self) -> Optional[bool]:
        """Whether every threshold of the study holds; None where it was not judged."""
        status = self.summary["status"]
        return None if status == "not judged" else status == "pass"

    def rows(self) -> List[Row]:
        """The metrics in long form: a row for each method, light, view, answer, region and metric, of a
        sweep also for each case, with the swept keys. Beside its "value" a row has

        low, high    its 95 % interval, where the metric has one: the drawn error rate over all samples
        uncertainty  of the truth in this view under this light, where the metric is a share of all
                     samples; differences below it mean nothing

        and None where there is nothing of the kind."""
        cases = self.folder / "cases.csv"
        if cases.exists():
            return [
                {key: text if key in _NAMES else _number(text) for key, text in row.items()}
                for row in _rows_of(cases)
            ]
        intervals = {
            (one["method"], one["view"], one["light"]): (one["low"], one["high"])
            for one in self.summary.get("confidence", [])
        }
        lights = {row["light"] for row in self.summary["results"]}
        if len(lights) == 1:  # then the mean over all is its own
            (only,) = lights
            for (method, view, _), interval in list(intervals.items()):
                intervals[method, view, only] = interval
        uncertainty = {
            (one["view"], one["light"]): one["flip_rate"] for one in self.summary["truth"].get("flips", [])
        }
        rows = []
        for row in _rows_of(self.folder / "metrics.csv"):
            about = {key: row[key] for key in _ABOUT}
            view, light = row["view"], row["light"]
            is_score = row["answer"] == "drawn" and row["region"] == "all"
            for metric, text in row.items():
                if metric in _ABOUT:
                    continue
                low, high = None, None
                if metric == "error_rate" and is_score:
                    low, high = intervals.get((row["method"], view, light), (None, None))
                is_whole = row["region"] == "all" and metric in _SHARES
                doubt = uncertainty.get((view, light)) if is_whole else None
                figures = {"value": _number(text), "low": low, "high": high, "uncertainty": doubt}
                rows.append({**about, "metric": metric, **figures})
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
        """One figure of a study, in the metric's own unit (docs/metrics.md); None where it is not
        defined. Light and view may be left out where there is one.

        Raises UnknownNameError (a KeyError and an InputError) for a name that the study does not have,
        with those that it has."""
        if (self.folder / "cases.csv").exists():
            raise _gnomon.InputError(
                f"{self.folder}: a sweep found, whose figures are those of its cases: rows() has them"
            )
        found = self.summary["results"]
        for key, wanted in [
            ("method", method),
            ("light", light),
            ("view", view),
            ("region", region),
            ("answer", answer),
        ]:
            known = [row[key] for row in found]
            if wanted is None and len(set(known)) > 1:
                names = ", ".join(sorted({repr(name) for name in known}))
                raise UnknownNameError(f"{key}: none found, one of {names} expected")
            found = [row for row in found if wanted in (None, row[key])]
            if not found:
                raise _unknown(key, wanted, known)
        (row,) = found
        if metric not in row or metric in _NO_METRICS:
            raise _unknown("metric", metric, set(row) - _NO_METRICS)
        return row[metric]

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
        """What each method drew, by (method, view, light): (height, width) uint8, 1 lit, 0 shadowed,
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
        """The truth at the samples of a method, as `masks`.

        Raises UnknownNameError for a method, view and light without a mask, with those that have one."""
        files = {
            (picture["method"], seen, lit): picture["truth"]["mask"]
            for seen, lit, picture in self._pictures()
            if picture["kind"] == "shaded" and picture.get("truth")
        }
        if (method, view, light) not in files:
            raise _unknown("key", (method, view, light), files)
        return _read(self.folder / files[method, view, light], self._is_soft(light))


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
    """What runs left: a `Result` for the folder of one, `Results` for the folder that holds several.
    Raises InputError where there is none."""
    path = arguments.path(folder, "folder")
    if (path / "summary.json").exists():
        return Result(path)
    found = sorted(path.glob("*/summary.json"))
    if not found:
        raise _gnomon.InputError(f"{path}: no summary.json found in it or one level below")
    return Results(Result(file.parent) for file in found)


def _setting(key: str, value: Any) -> str:
    """An override as the command line has it. Text stays bare: the study's key tells its type."""
    if isinstance(value, (bool, np.bool_)):
        return f"{key}={'true' if value else 'false'}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return f"{key}={json.dumps(value, default=lambda one: one.tolist())}"
    if isinstance(value, (np.integer, np.floating)):
        value = value.item()
    if not isinstance(value, (str, int, float)):
        arguments.refuse(f"set: {key}", value, "a number, a text, True, False or a list of them")
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

    study     its file
    set       overrides of its keys: {"relief.height": 4}
    methods   labels or names to keep; all by default
    out       the folder of results
    quick     a quarter of each view's side: a preview
    cache     take what earlier runs left in the user's cache, and leave this one's
    progress  called with the stage's name and its share, 0 to 1; what it raises ends the run

    Several runs may go on in threads at once, into folders of their own. Processes are to be started
    by "spawn": a fork of a process that has used gnomon has none of its threads.

    Raises InputError naming file, line and key; NoOpenGLError; Error. Ctrl-C ends it. None of them
    leaves a folder half written.
    """
    if set is not None and not isinstance(set, Mapping):
        arguments.refuse("set", set, "a dictionary of keys and values")
    if progress is not None and not callable(progress):
        arguments.refuse("progress", progress, "a function of a name and a share")
    settings = [_setting(key, value) for key, value in (set or {}).items()]
    summary, _, failures = _gnomon.run(
        arguments.path(study, "study"),
        arguments.path(out, "out"),
        arguments.texts(methods, "methods", "labels or names"),
        settings,
        arguments.flag(quick, "quick"),
        arguments.flag(cache, "cache"),
        progress,
    )
    return Result(pathlib.Path(summary).parent, failures)
