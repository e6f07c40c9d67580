# SPDX-License-Identifier: MIT
"""Queries about the water."""
from typing import Any, Dict, Optional, Sequence, TypedDict, Union, cast

import numpy as np
from numpy.typing import ArrayLike

from ._library import ffi, lib, text
from .errors import MangataError, SceneError
from .rendering import listed
from .scenes import SceneLike, as_scene

_ANSWERS = {"height": ("double *", np.float64, ()), "normal": ("float *", np.float32, (3,)), "velocity": ("float *", np.float32, (3,)), "jacobian": ("float *", np.float32, ()), "foam": ("float *", np.float32, ())}


class Answers(TypedDict, total=False):
    """What `query` gives: the answers asked for, "covariance" and "unsettled"."""

    height: np.ndarray
    normal: np.ndarray
    velocity: np.ndarray
    jacobian: np.ndarray
    foam: np.ndarray
    covariance: np.ndarray
    unsettled: int


def _pointer(kind: str, array: np.ndarray):
    return ffi.cast(kind, array.__array_interface__["data"][0])


def _unmasked(name: str, array: ArrayLike) -> ArrayLike:
    if np.ma.is_masked(array):
        raise ValueError(f"{name} has masked values; those of compressed() or filled() are taken")
    return array


def _raise(status: int) -> None:
    message = text(lib.mgt_last_error(ffi.NULL))
    if status == lib.MGT_ERROR_SCENE:
        raise SceneError(message)
    raise MangataError(message or text(lib.mgt_status_text(status)), text(lib.mgt_status_name(status)))


def query(
    scene: SceneLike,
    points: ArrayLike,
    time: Optional[float] = None,
    answers: Union[str, Sequence[str]] = ("height", "normal"),
    *,
    frame: int = 0,
    least_wavelength: float = 0.0,
    exact: bool = False,
) -> Answers:
    """Height, slope, motion and foam of the water at points.

    points   array (…, 2) of x and z in metres, float64; other types are copied
    time     seconds; None: that of `frame`
    answers  names, or a single one: "height" float64 (…), metres; "normal" float32 (…, 3), unit; "velocity" float32 (…, 3), metres a second;
             "jacobian" float32 (…);
             "foam" float32 (…), fraction that the scene's foam covers
    least_wavelength  metres: shorter waves count in the result's "covariance" alone: xx, xz, zz of their slopes
    exact    heights within 1e-9 m, in about twice the time

    Also in the result: "covariance" float64 (3,), "unsettled" int, points of choppy water whose place of rest was not found.
    """
    scene = as_scene(scene)  # the waves of its frames live as long as it does
    view = scene.frame(frame)
    points = np.ascontiguousarray(_unmasked("points", points), np.float64)
    if points.ndim < 1 or points.shape[-1] != 2:
        raise ValueError(f"points need the shape (…, 2), x and z in metres, not {points.shape}")
    shape = points.shape[:-1]
    asked = ffi.new("mgt_water_answers *")
    lib.mgt_water_answers_init(asked, ffi.sizeof("mgt_water_answers"))
    asked.least_wavelength, asked.exact = least_wavelength, int(exact)
    asked.foam_share, asked.foam_persistence = view.foam, view.foam_persistence
    result: Dict[str, Any] = {}
    for name in listed(answers):
        if name not in _ANSWERS:
            raise ValueError(f"answer {name!r}: allowed is {', '.join(_ANSWERS)}")
        kind, dtype, more = _ANSWERS[name]
        result[name] = np.empty(shape + more, dtype)
        setattr(asked, name, _pointer(kind, result[name]))
    water = ffi.addressof(view, "water")
    status = lib.mgt_water_query(water, view.time if time is None else time, _pointer("double *", points), int(np.prod(shape, dtype=np.int64)), asked)
    if status:
        _raise(status)
    result["covariance"] = np.array(list(asked.covariance))
    result["unsettled"] = int(asked.unsettled)
    return cast(Answers, result)


def trace(
    scene: SceneLike, origins: ArrayLike, directions: ArrayLike, reach: float = 1e5, time: Optional[float] = None, *, frame: int = 0
) -> np.ndarray:
    """Where rays first meet the water: multiples of their direction, float64 (…), inf where they do not by `reach`.

    origins, directions  arrays (…, 3), in metres and of any length, which may be broadcast against each other
    time     seconds; None: that of `frame`
    """
    scene = as_scene(scene)  # the waves of its frames live as long as it does
    view = scene.frame(frame)
    origins, directions = np.broadcast_arrays(
        np.asarray(_unmasked("origins", origins), np.float64), np.asarray(_unmasked("directions", directions), np.float64)
    )
    if origins.shape[-1:] != (3,):
        raise ValueError(f"origins and directions need the shape (…, 3), not {origins.shape}")
    rays = np.ascontiguousarray(np.concatenate([origins, directions], axis=-1))
    distance = np.empty(rays.shape[:-1])
    status = lib.mgt_water_trace(
        ffi.addressof(view, "water"), view.time if time is None else time, _pointer("double *", rays), distance.size, reach, _pointer("double *", distance)
    )
    if status:
        _raise(status)
    return distance


__all__ = ["query", "trace"]
