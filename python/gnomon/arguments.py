"""Arguments of the public functions, checked: what is wrong raises InputError with one line that names
the argument, what was found and what was expected."""

import os
import pathlib
import warnings
from typing import Any, NoReturn, Optional, Sequence, Tuple

import numpy as np

from gnomon import _gnomon

#: What an int of the library holds.
_LEAST, _MOST = -(2**31), 2**31 - 1


def refuse(name: str, found: Any, expected: str) -> NoReturn:
    raise _gnomon.InputError(f"{name}: {_text(found)} found, {expected} expected")


def _text(value: Any) -> str:
    """A value in one line of some sixty letters."""
    if isinstance(value, np.ndarray) and value.ndim > 0:
        return f"an array of shape {value.shape} and type {value.dtype}"
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def _scalar(value: Any) -> Any:
    return value[()] if isinstance(value, np.ndarray) and value.ndim == 0 else value


def number(value: Any, name: str, unit: str) -> float:
    value = _scalar(value)
    if isinstance(value, (bool, np.bool_)) or not isinstance(
        value, (int, float, np.integer, np.floating)
    ):
        refuse(name, value, f"a number of {unit}")
    try:
        return float(value)
    except OverflowError:
        refuse(name, value, f"a number of {unit}")


def whole(value: Any, name: str, unit: str) -> int:
    value = _scalar(value)
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        refuse(name, value, f"a whole number of {unit}")
    if not _LEAST <= value <= _MOST:
        refuse(name, value, f"a whole number of {unit}, at most {_MOST},")
    return int(value)


def flag(value: Any, name: str) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        refuse(name, value, "True or False")
    return bool(value)


def path(value: Any, name: str) -> pathlib.Path:
    if not isinstance(value, (str, os.PathLike)):
        refuse(name, value, "a path")
    return pathlib.Path(value)


def texts(value: Any, name: str, what: str) -> Sequence[str]:
    """A list of texts; a text alone would be taken as a list of its letters."""
    if isinstance(value, str) or not isinstance(value, (list, tuple, set, frozenset)):
        refuse(name, value, f"a list of {what}")
    for one in value:
        if not isinstance(one, str):
            refuse(name, one, f"a list of {what}")
    return list(value)


def instance(value: Any, name: str, kind: type) -> Any:
    if not isinstance(value, kind):
        refuse(name, value, f"a gnomon.{kind.__name__}")
    return value


def array(
    value: Any, name: str, sizes: Tuple[Optional[int], ...], shape: str, kinds: str = "buif"
) -> np.ndarray:
    """An array of so many dimensions.

    sizes  of each dimension; None is any
    shape  the same in words: "(lights, 3)"
    kinds  of numbers that are taken, as in NumPy's `dtype.kind`
    """
    if np.ma.is_masked(value):
        raise _gnomon.InputError(f"{name}: masked values found, numbers everywhere expected")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # older NumPys make objects of ragged lists
            found = np.asarray(value)
    except (ValueError, TypeError, Warning):
        refuse(name, value, f"{shape} numbers, lists of one length,")
    if found.dtype.kind not in kinds:
        refuse(name, value, f"{shape} numbers")
    fits = found.ndim == len(sizes) and all(
        size in (None, there) for size, there in zip(sizes, found.shape)
    )
    if not fits:
        raise _gnomon.InputError(f"{name}: shape {found.shape} found, {shape} expected")
    if found.size == 0:
        raise _gnomon.InputError(f"{name}: shape {found.shape} found, at least one value expected")
    return found


def _first(bad: np.ndarray) -> Tuple[int, ...]:
    return tuple(int(i) for i in np.argwhere(bad)[0])


def numbers(
    value: Any, name: str, sizes: Tuple[Optional[int], ...], shape: str, dtype: Any = np.float64
) -> np.ndarray:
    """An array of finite numbers, as one of a type of floats."""
    found = array(value, name, sizes, shape)
    with np.errstate(over="ignore"):
        made = np.ascontiguousarray(found, dtype)
    bad = ~np.isfinite(made)
    if bad.any():
        at = _first(bad)
        raise _gnomon.InputError(
            f"{name}: {found[at]} found at {at}, a finite number of {made.dtype} expected"
        )
    return made


def indices(
    value: Any, name: str, sizes: Tuple[Optional[int], ...], shape: str
) -> np.ndarray:
    """An array of whole numbers as int32. Floats are taken where they are whole: sample maps in EXR
    and .npy files hold nothing else."""
    found = array(value, name, sizes, shape, "uif")
    with np.errstate(invalid="ignore"):
        bad = ~((found >= _LEAST) & (found <= _MOST) & (np.floor(found) == found))
    if bad.any():
        at = _first(bad)
        raise _gnomon.InputError(
            f"{name}: {found[at]} found at {at}, a whole number from {_LEAST} to {_MOST} expected"
        )
    return np.ascontiguousarray(found, np.int32)


def mask(value: Any, name: str) -> np.ndarray:
    """A mask as bytes. Numbers of another type are refused, since 0.5 would become 0 without a word."""
    found = array(value, name, (None, None), "(height, width)")
    if found.dtype.kind == "f":
        raise _gnomon.InputError(
            f"{name}: numbers of type {found.dtype} found, True where it is lit or 1 lit, 0 shadowed, "
            "2 no answer expected"
        )
    bad = (found < 0) | (found > 2) if found.dtype.kind != "b" else np.zeros(0, bool)
    if bad.any():
        at = _first(bad)
        raise _gnomon.InputError(f"{name}: {found[at]} found at {at}, 0, 1 or 2 expected")
    return np.ascontiguousarray(found, np.uint8)
