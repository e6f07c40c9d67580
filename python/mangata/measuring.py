# SPDX-License-Identifier: MIT
"""Metrics on arrays, comparisons of methods, pictures from files."""
import itertools
import math
import os
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from ._library import ffi, io, lib, names
from .rendering import DISPLAY, choose, layers, listed, render, size_changes, split_method
from .rendering import methods as method_names
from .scenes import Scene, SceneLike, as_scene, new_error, path_bytes, raise_io, without_nul

_METRICS = names(io.mgt_metric_name)


def metric_names() -> Sequence[str]:
    """The metrics that there are; docs/metrics.md says what they mean."""
    return list(_METRICS)


# The greatest values of whole numbers: as in PNG they stand for fractions.
_WHITE = {np.dtype(np.uint8): 255, np.dtype(np.uint16): 65535}


def _clip(picture: ArrayLike, clip: bool) -> np.ndarray:
    """(frames, h, w, channels) float32; nothing is copied where it is packed float32 already."""
    if np.ma.is_masked(picture):
        raise ValueError("a picture has masked pixels, which metrics cannot leave out: score a rectangle without them, or their filled() values")
    picture = np.asarray(picture)
    white = _WHITE.get(picture.dtype.newbyteorder("="))
    if white is None and picture.dtype.kind not in "fb":
        raise ValueError(f"a picture of {picture.dtype}: allowed are floats, bool, and uint8 and uint16, whose 255 and 65535 stand for 1")
    if white == 255 and picture.shape[-1:] == (4,) and (picture[..., 3] == 255).all():
        picture = picture[..., :3]  # "display" of render()
    if picture.dtype.itemsize > 4 and (np.isfinite(picture) & (np.abs(picture) > np.finfo(np.float32).max)).any():
        raise ValueError("a picture has values beyond those of float32, 3.4e38")
    picture = np.ascontiguousarray(picture, np.float32)
    if white is not None:
        picture = picture / np.float32(white)
    dimensions = picture.ndim - int(clip)
    if dimensions == 2:
        picture = picture[..., None]
    elif dimensions != 3 or picture.shape[-1] not in (1, 3):
        raise ValueError(f"a picture has the shape (h, w) or (h, w, 3), a clip one dimension more in front, not {picture.shape}")
    return picture if clip else picture[None]


def _encoding(a: ArrayLike, b: ArrayLike, encoding: Optional[str]) -> str:
    """What the values are: whole numbers are sRGB-encoded, as those of PNG, unless the caller says otherwise."""
    if encoding not in (None, "linear", "srgb"):
        raise ValueError(f"encoding {encoding!r}: allowed is linear, srgb")
    whole = [np.asarray(picture).dtype.kind == "u" for picture in (a, b)]
    if encoding is None and whole[0] != whole[1]:
        raise ValueError("one picture holds whole numbers, as PNG does, the other floats: encoding='linear' or 'srgb' says what both are")
    return encoding or ("srgb" if whole[0] else "linear")


def _words(metrics: Union[str, Sequence[str]]) -> List[str]:
    """The metrics of "rmse,flip" or a list, each a word of the library's."""
    words = metrics.split(",") if isinstance(metrics, str) else list(metrics)
    words = [word.strip() for word in words]
    for word in words:
        if word not in _METRICS:
            raise ValueError(f"metric {word!r}: allowed are {', '.join(_METRICS)}")
    if not words:
        raise ValueError("no metric is given")
    return words


def _named(words: Sequence[str]) -> List[str]:
    """All metrics that the words stand for, in their order: "flicker" for all of its kinds."""
    return [name for name in _METRICS if name in words or ("flicker" in words and name.startswith("flicker-"))]


def _measure(
    a: ArrayLike,
    b: ArrayLike,
    words: Optional[Sequence[str]],
    clip: bool,
    encoding: Optional[str],
    pixels_per_degree: float,
    map_metric: int = 0,
    with_map: bool = False,
) -> Tuple[List[float], Optional[np.ndarray]]:
    encoding = _encoding(a, b, encoding)
    a, b = _clip(a, clip), _clip(b, clip)
    if a.shape != b.shape:
        raise ValueError(f"the pictures have different shapes: {a.shape} and {b.shape}")
    if clip and not len(a):
        raise ValueError("a clip has no frame")
    desc = ffi.new("mgt_metrics_desc *")
    io.mgt_metrics_desc_init(desc, ffi.sizeof("mgt_metrics_desc"))
    frames, desc.height, desc.width, desc.channels = a.shape
    desc.srgb_encoded = encoding == "srgb"
    desc.pixels_per_degree = pixels_per_degree
    kept = ffi.new("char[]", ",".join(words).encode()) if words is not None else ffi.NULL
    desc.metrics = kept
    pointers = [ffi.new("float *[]", [ffi.cast("float *", frame.__array_interface__["data"][0]) for frame in clip_]) for clip_ in (a, b)]
    scores = ffi.new("double[]", len(_METRICS))
    picture = np.empty(a.shape[1:3], np.float32) if with_map else None
    pixels = ffi.cast("float *", picture.__array_interface__["data"][0]) if with_map else ffi.NULL
    error = new_error()
    status = io.mgt_metrics_measure(desc, pointers[0], pointers[1], frames, scores, map_metric, pixels, error)
    if status:
        raise_io(status, error)
    return list(scores), picture


def metrics(
    a: ArrayLike,
    b: ArrayLike,
    metrics: Optional[Union[str, Sequence[str]]] = None,
    *,
    clip: bool = False,
    encoding: Optional[str] = None,
    pixels_per_degree: float = 0.0,
) -> Dict[str, float]:
    """Scores of picture a against b, the reference, by name; 0 is best, but for energy, ssim and flicker-ratio, where 1 is.

    All are NaN where a value is finite in one picture only, NaN in either, or infinite with unlike signs.

    a, b       arrays (h, w) or (h, w, 3); with clip=True (frames, h, w) or (frames, h, w, 3), scored as one clip. float32 is not copied; uint8 and uint16 stand
               for fractions of 255 and 65535; "display" of render() is taken without its alpha; what is masked is refused
    metrics    "rmse,flip" or a list; None: all that are defined, of pictures that cannot be compared all that there are. "flicker" stands for all of its kinds
    encoding   of the values: "linear" or "srgb"; None: linear, of uint8 and uint16 sRGB, as in PNG
    pixels_per_degree  of the viewer's eye, for FLIP; 0: 67.0206, as in its papers
    """
    words = None if metrics is None else _words(metrics)
    scores, _ = _measure(a, b, words, clip, encoding, pixels_per_degree)
    asked = _named(words) if words else _METRICS if np.isnan(scores).all() else ()
    return {name: score for name, score in zip(_METRICS, scores) if score == score or name in asked}


def error_map(a: ArrayLike, b: ArrayLike, metric: str = "flip", *, encoding: Optional[str] = None, pixels_per_degree: float = 0.0) -> np.ndarray:
    """The error of each pixel of a against b, float32 (h, w), by "rmse", "relrmse" (over b's own strength), "flip", "hdr-flip" or
    "ssim" (1 − SSIM): docs/metrics.md.

    NaN at pixels that cannot be compared, as those that are NaN in a alone. Arrays and `encoding` are those of metrics()."""
    mapped = ("rmse", "relrmse", "flip", "hdr-flip", "ssim")
    if metric not in mapped:
        raise ValueError(f"metric {metric!r}: allowed is {', '.join(mapped)}")
    errors = _measure(a, b, [metric], False, encoding, pixels_per_degree, _METRICS.index(metric), True)[1]
    assert errors is not None
    return errors


def _reference(scene: Scene, frames: Sequence[int], options: Mapping[str, Any]) -> Tuple[str, Dict[str, Any]]:
    """The method of the reference and its options: where there is more to see than the surface from above, ssaa takes as many samples and refracted rays."""
    shown = scene.changed({"quality.method": "reference"})
    views = [shown.frame(frame) for frame in frames]
    options = {"seed": (views[0].quality.seed + 1) % 2**64, **options}
    if all(lib.mgt_supports(lib.MGT_BACKEND_NULL, view, lib.MGT_LAYER_COVERAGE) for view in views):
        return "reference", options
    options = {"spatial": 8, "time_samples": 8, **options}
    options["time_samples"] = max(2, options["time_samples"])  # a single one would be the instant when the shutter closes
    if views[0].object_count:
        side = min(64, 1 + math.isqrt(options["spatial"] ** 2 * options["time_samples"] - 1))
        options = {"refraction": "truth", "refraction_samples": side, **options}
    return "ssaa", options


def _named_scenes(scenes: Union[SceneLike, Iterable[SceneLike], Mapping[str, SceneLike]]) -> Dict[str, SceneLike]:
    """Scenes by name, of a file its own without folder and extension; a second one of a name has a number, as in the command: high, high-2."""
    if isinstance(scenes, Mapping):
        # A scene itself has one value that is a text, its description.
        if any(isinstance(scene, (Scene, os.PathLike)) or (isinstance(scene, str) and name != "description") for name, scene in scenes.items()):
            return dict(scenes)
        scenes = [scenes]
        alone = True
    else:
        alone = False
    found: Dict[str, SceneLike] = {}
    for place, scene in enumerate([scenes] if isinstance(scenes, (Scene, str, bytes, os.PathLike)) else scenes):
        path = os.path.basename(os.fsdecode(scene)) if isinstance(scene, (str, bytes, os.PathLike)) else ""
        base = os.path.splitext(path)[0] or ("scene" if alone else f"scene{place}")
        free = (name for number in itertools.count(2) if (name := f"{base}-{number}") not in found)
        found[base if base not in found else next(free)] = scene
    return found


def compare(
    scenes: Union[SceneLike, Iterable[SceneLike], Mapping[str, SceneLike]],
    methods: Union[str, Sequence[str]],
    *,
    layer: str = "coverage",
    frames: Iterable[int] = (0,),
    reference: Optional[Mapping[str, Any]] = None,
    external: Optional[Mapping[str, Callable[[Scene, int], ArrayLike]]] = None,
    metrics: Union[str, Sequence[str]] = "rmse,relrmse,energy,flip",
    size: Optional[Tuple[int, int]] = None,
    changes: Optional[Mapping[str, Any]] = None,
    progress: Optional[Callable[[str], None]] = None,
) -> List[Dict[str, Any]]:
    """Renders methods and the reference, and scores each method's clip against it: a list of {"scene", "method", metric: score, …}.

    scenes     one, a list, or a dictionary of names and scenes, each a Scene or a path; of files the name is their own, x of "a/x.json", and x-2 of "b/x.json"
               after it
    methods    names, or a single one
    layer      what is scored, "coverage", "color", …; "display" as it is seen
    reference  options of the method "reference": {"spatial": 8, "time_samples": 8}; in scenes with objects, and under water, of ssaa with refraction "truth".
               Its seed is that of the scene's `quality` + 1, which is not the methods'
    external   methods of your own: names, which no other method has, and functions of a scene and a frame that return the layer's array
    metrics    as in metrics()
    progress   called with a line before each picture
    """
    found, frames, ours, external = _named_scenes(scenes), list(frames), listed(methods), dict(external or {})
    if not frames:
        raise ValueError("no frame is given")
    choose(layers(), layer, "layer")
    for name in ours:
        if name not in external:
            choose(method_names(), split_method(name)[0], "method")
    for name, function in external.items():
        if split_method(name)[0] in method_names():
            raise ValueError(f"external {name!r}: a method has this name")
        if not callable(function):
            raise ValueError(f"external {name!r}: it is no function of a scene and a frame")
    words = _words(metrics)
    given = {**(changes or {}), **(size_changes(size) if size else {})}
    opened = {title: as_scene(scene).changed(given) for title, scene in found.items()}
    rows = []
    for title, scene in opened.items():

        def draw(method: str, label: str, wanted: Optional[np.ndarray] = None, **options: Any) -> np.ndarray:
            pictures = []
            for frame in frames:
                if progress:
                    progress(f"{title}, {label}, frame {frame}")
                picture = external[method](scene, frame) if method in external else render(scene, method, [layer], frame, **options)[layer]
                pictures.append(_clip(picture, False)[0])
                if wanted is not None and pictures[-1].shape != wanted.shape[1:]:
                    raise ValueError(f"{method}, frame {frame}: the picture has the shape {pictures[-1].shape}, the reference {wanted.shape[1:]}")
            return np.stack(pictures)

        method, options = _reference(scene, frames, reference or {})
        truth = draw(method, "reference", **options)
        for method in [*ours, *(name for name in external if name not in ours)]:
            scores, _ = _measure(draw(method, method, truth), truth, words, True, "srgb" if layer == DISPLAY else "linear", 0.0)
            rows.append({"scene": title, "method": method, **{m: s for m, s in zip(_METRICS, scores) if m in _named(words)}})
    return rows


def read(path: Union[str, os.PathLike], layer: Optional[str] = None) -> np.ndarray:
    """The pixels of a .png, .pfm or .exr: float32 (h, w) or (h, w, channels), top row first. `layer`: a layer or channel of an .exr. Nothing is copied."""
    picture = ffi.new("mgt_io_picture *")
    picture.struct_size = ffi.sizeof("mgt_io_picture")
    error = new_error()
    status = io.mgt_io_picture_read(picture, path_bytes(path), without_nul(layer.encode()) if layer else ffi.NULL, error)
    if status:
        raise_io(status, error)
    # The array keeps the buffer, which keeps these pixels.
    pixels = ffi.gc(picture.pixels, lambda _: io.mgt_io_picture_free(picture))
    values = np.frombuffer(ffi.buffer(pixels, 4 * picture.width * picture.height * picture.channels), np.float32)
    return values.reshape((picture.height, picture.width) + ((picture.channels,) if picture.channels > 1 else ()))


__all__ = ["compare", "error_map", "metric_names", "metrics", "read"]
