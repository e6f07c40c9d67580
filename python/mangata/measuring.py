# SPDX-License-Identifier: MIT
"""Metrics on arrays, comparisons of methods, pictures from files."""
import math
import os
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from ._library import ffi, io, lib, names
from .rendering import render
from .scenes import Scene, SceneLike, as_scene, new_error, path_bytes, raise_io, without_nul

_METRICS = names(io.mgt_metric_name)


def metric_names() -> Sequence[str]:
    """The metrics that there are; docs/metrics.md says what they mean."""
    return list(_METRICS)


def _clip(picture: np.ndarray, clip: bool) -> np.ndarray:
    """(frames, h, w, channels) float32; nothing is copied where it is packed float32 already."""
    picture = np.ascontiguousarray(picture, np.float32)
    dimensions = picture.ndim - int(clip)
    if dimensions == 2:
        picture = picture[..., None]
    elif dimensions != 3 or picture.shape[-1] not in (1, 3):
        raise ValueError(f"a picture has the shape (h, w) or (h, w, 3), a clip one dimension more in front, not {picture.shape}")
    return picture if clip else picture[None]


def _measure(a: np.ndarray, b: np.ndarray, words: Optional[str], clip: bool, encoding: str, pixels_per_degree: float, map_metric: int = 0, with_map: bool = False):
    a, b = _clip(a, clip), _clip(b, clip)
    if a.shape != b.shape:
        raise ValueError(f"the pictures have different shapes: {a.shape} and {b.shape}")
    if encoding not in ("linear", "srgb"):
        raise ValueError(f"encoding {encoding!r}: allowed is linear, srgb")
    desc = ffi.new("mgt_metrics_desc *")
    io.mgt_metrics_desc_init(desc, ffi.sizeof("mgt_metrics_desc"))
    frames, desc.height, desc.width, desc.channels = a.shape
    desc.srgb_encoded = encoding == "srgb"
    desc.pixels_per_degree = pixels_per_degree
    kept = ffi.new("char[]", without_nul(words.encode())) if words is not None else ffi.NULL
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
    a: np.ndarray,
    b: np.ndarray,
    metrics: Optional[Union[str, Sequence[str]]] = None,
    *,
    clip: bool = False,
    encoding: str = "linear",
    pixels_per_degree: float = 0.0,
) -> Dict[str, float]:
    """Scores of picture a against b, the reference, by name; 0 is best, but for energy, ssim and flicker-ratio, where 1 is.

    All are NaN where a value is finite in one picture only, NaN in either, or infinite with unlike signs.

    a, b       float arrays (h, w) or (h, w, 3); with clip=True (frames, h, w) or (frames, h, w, 3), scored as one clip. float32 is not copied
    metrics    "rmse,flip" or a list; None: all that are defined, of pictures that cannot be compared all that there are
    encoding   of the values: "linear" or "srgb"
    pixels_per_degree  of the viewer's eye, for FLIP; 0: 67.0206, as in its papers
    """
    words = metrics if metrics is None or isinstance(metrics, str) else ",".join(metrics)
    scores, _ = _measure(a, b, words, clip, encoding, pixels_per_degree)
    asked = words.split(",") if words else _METRICS if np.isnan(scores).all() else ()
    return {name: score for name, score in zip(_METRICS, scores) if score == score or name in asked}


def error_map(a: np.ndarray, b: np.ndarray, metric: str = "flip", *, encoding: str = "linear", pixels_per_degree: float = 0.0) -> np.ndarray:
    """The error of each pixel of a against b, float32 (h, w), by "rmse", "relrmse" (over b's own strength), "flip", "hdr-flip" or "ssim" (1 − SSIM): docs/metrics.md.

    NaN at pixels that cannot be compared, as those that are NaN in a alone."""
    mapped = ("rmse", "relrmse", "flip", "hdr-flip", "ssim")
    if metric not in mapped:
        raise ValueError(f"metric {metric!r}: allowed is {', '.join(mapped)}")
    return _measure(a, b, metric, False, encoding, pixels_per_degree, _METRICS.index(metric), True)[1]


def _reference(scene: Scene, frames: Sequence[int], options: Mapping[str, Any]) -> Tuple[str, Dict[str, Any]]:
    """The method of the reference and its options: where there is more to see than the surface from above, ssaa takes as many samples and refracted rays."""
    options = {"seed": 1, **options}
    views = [scene.changed({"quality.method": "reference"}).frame(frame) for frame in frames]
    if all(lib.mgt_supports(lib.MGT_BACKEND_NULL, view, lib.MGT_LAYER_COVERAGE) for view in views):
        return "reference", options
    options = {"spatial": 8, "time_samples": 8, **options}
    options["time_samples"] = max(2, options["time_samples"])  # a single one would be the instant when the shutter closes
    if views[0].object_count:
        side = min(64, 1 + math.isqrt(options["spatial"] ** 2 * options["time_samples"] - 1))
        options = {"refraction": "truth", "refraction_samples": side, **options}
    return "ssaa", options


def compare(
    scenes: Union[SceneLike, Sequence[SceneLike], Mapping[str, SceneLike]],
    methods: Sequence[str],
    *,
    layer: str = "coverage",
    frames: Sequence[int] = (0,),
    reference: Optional[Mapping[str, Any]] = None,
    external: Optional[Mapping[str, Callable[[Scene, int], np.ndarray]]] = None,
    metrics: Union[str, Sequence[str]] = "rmse,relrmse,energy,flip",
    size: Optional[Tuple[int, int]] = None,
    changes: Optional[Mapping[str, Any]] = None,
    progress: Optional[Callable[[str], None]] = None,
) -> List[Dict[str, Any]]:
    """Renders methods and the reference, and scores each method's clip against it: a list of {"scene", "method", metric: score, …}.

    scenes     one, a list, or a dictionary of names and scenes
    reference  options of the method "reference": {"spatial": 8, "time_samples": 8}; in scenes with objects, and under water, of ssaa with refraction "truth"
    external   methods of your own: names and functions of a scene and a frame that return the layer's array
    progress   called with a line before each picture
    """
    if isinstance(scenes, Mapping) and not any(isinstance(v, Scene) for v in scenes.values()):
        scenes = {"scene": scenes}
    if not isinstance(scenes, Mapping):
        listed = list(scenes) if isinstance(scenes, (list, tuple)) else [scenes]
        scenes = {os.path.splitext(os.path.basename(str(s)))[0] if isinstance(s, (str, os.PathLike)) else f"scene{i}": s for i, s in enumerate(listed)}
    words = metrics if isinstance(metrics, str) else ",".join(metrics)
    rows = []
    for name, scene in scenes.items():
        scene = as_scene(scene).changed({**(changes or {}), **({"image.width": size[0], "image.height": size[1]} if size else {})})

        def draw(method: str, title: str = "", **options: Any) -> np.ndarray:
            pictures = []
            for frame in frames:
                if progress:
                    progress(f"{name}, {title or method}, frame {frame}")
                pictures.append(external[method](scene, frame) if external and method in external else render(scene, method, [layer], frame, **options)[layer])
            return np.stack(pictures)

        method, options = _reference(scene, frames, reference or {})
        truth = draw(method, "reference", **options)
        for method in [*methods, *(external or {})]:
            scores, _ = _measure(draw(method), truth, words, True, "linear", 0.0)
            rows.append({"scene": name, "method": method, **{m: s for m, s in zip(_METRICS, scores) if m in words.split(",")}})
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
