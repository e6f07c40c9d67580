# SPDX-License-Identifier: MIT
"""Rendering into numpy arrays."""
import functools
import os
import re
import threading
import weakref
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from ._library import ffi, lib, names, text
from .errors import Cancelled, MangataError, SceneError
from .scenes import Scene, SceneLike, as_scene, change_texts

Progress = Callable[[float], Optional[bool]]

DISPLAY = "display"
_LAYERS = names(lib.mgt_layer_name)
_BACKENDS = names(lib.mgt_backend_name)
_ISAS = names(lib.mgt_isa_name)


def layers() -> Sequence[str]:
    """The names of layers, "display" (8-bit colour) last."""
    return [*_LAYERS, DISPLAY]


def methods() -> Sequence[str]:
    """The names of methods; ssaa stands for ssaa2, ssaa3, …"""
    return names(lib.mgt_method_name)


def split_method(method: str) -> Tuple[str, Optional[int]]:
    """A method's name and the number of ssaaN, which has a key of its own in the scene format."""
    number = re.fullmatch(r"ssaa([0-9]+)", method)
    return ("ssaa", int(number[1])) if number else (method, None)


def listed(names_: Union[str, Iterable[str]]) -> List[str]:
    """A list of names; a single one may stand for itself."""
    return [names_] if isinstance(names_, str) else list(names_)


def size_changes(size: Tuple[int, int]) -> Dict[str, int]:
    """(width, height) as changes of a scene."""
    if len(size) != 2 or any(number != int(number) for number in size):
        raise ValueError(f"size {size}: allowed are two whole numbers, width and height")
    return {"image.width": int(size[0]), "image.height": int(size[1])}


def choose(words: Sequence[str], word: str, what: str) -> int:
    if word not in words:
        raise ValueError(f"{what} {word!r}: allowed is {', '.join(words)}")
    return words.index(word)


class Context:
    """What renders: threads and tables that are kept from one frame to the next. One thread renders at a time, others wait.

    backend: "cpu", "gl", "auto" or "null". threads: up to 1024; 0 for as many as the CPUs that this process may use. isa: the highest instruction set.
    `with Context() as context:` ends its threads behind the block, as close() does. A process that was forked has a context of its own in place of each.
    """

    def __init__(self, backend: str = "cpu", threads: int = 0, isa: str = "auto") -> None:
        desc = ffi.new("mgt_context_desc *")
        lib.mgt_context_desc_init(desc, ffi.sizeof("mgt_context_desc"))
        desc.backend = choose(_BACKENDS, backend, "backend")
        desc.isa = choose(_ISAS, isa, "isa")
        if not 0 <= threads <= 1024:
            raise ValueError(f"threads {threads}: allowed is 0, as many as the CPUs, to 1024")
        desc.threads = threads
        self._progress: Optional[Progress] = None
        self._raised: Optional[BaseException] = None
        desc.progress = self._callback = _callback(self)
        self._desc, self._context, self._closed = desc, ffi.NULL, False
        self._after_fork()
        self._open()
        _living.add(self)

    def _open(self) -> None:
        out = ffi.new("mgt_context **")
        status = lib.mgt_context_create(out, self._desc)
        if status:
            raise MangataError(text(lib.mgt_last_error(ffi.NULL)), text(lib.mgt_status_name(status)))
        self._context = ffi.gc(out[0], lib.mgt_context_destroy)

    def _after_fork(self) -> None:
        # The threads of a context are not there in a forked process: waiting for their end would never end.
        if self._context != ffi.NULL:
            ffi.gc(self._context, None)
        self._context = ffi.NULL
        self._lock = threading.Lock()
        self._renders: Optional[int] = None  # the thread that renders

    def _refuse_own_thread(self) -> None:
        if self._renders == threading.get_ident():
            raise RuntimeError("a progress function uses the context that has called it; render(context=Context()) takes another")

    def close(self) -> None:
        """Ends its threads; to render with it is a ValueError from then on. A second time does nothing."""
        self._refuse_own_thread()
        with self._lock:
            self._closed = True
            if self._context != ffi.NULL:
                ffi.release(self._context)
                self._context = ffi.NULL

    def __enter__(self) -> "Context":
        return self

    def __exit__(self, *_raised: object) -> None:
        self.close()

    def _step(self, fraction: float) -> bool:
        # Also where a signal such as Ctrl-C becomes an exception.
        answer = None if self._progress is None else self._progress(fraction)
        return not (isinstance(answer, (bool, np.bool_)) and not answer)

    def render_into(self, scene: Any, targets: Sequence[Tuple[str, np.ndarray]], progress: Optional[Progress] = None) -> None:
        """Renders a C scene, `Scene.frame()`, into arrays of the crop's size: float32 (h, w, 3) of color, normal and refraction, float32 (h, w) of the other
        layers, uint8 (h, w, 4) of "display". Rows may have a stride; pixels of a row are packed. Nothing is copied."""
        array = ffi.new("mgt_target[]", len(targets))
        kept = []
        for target, (layer, pixels) in zip(array, targets):
            lib.mgt_target_init(ffi.addressof(target), ffi.sizeof("mgt_target"))
            target.layer, target.format = _layer_format(layer)
            _check_array(layer, pixels, scene.image)
            pointer = ffi.cast("void *", pixels.__array_interface__["data"][0])
            kept.append(pointer)
            target.pixels = pointer
            target.row_stride = pixels.strides[0]
        self._refuse_own_thread()
        with self._lock:
            if self._closed:
                raise ValueError("the context is closed")
            if self._context == ffi.NULL:
                self._open()
            self._renders, self._progress, self._raised = threading.get_ident(), progress, None
            try:
                status = lib.mgt_render(self._context, scene, array, len(targets))
                message = text(lib.mgt_last_error(self._context)) if status else ""
            finally:
                raised = self._raised
                self._renders = self._progress = self._raised = None
        if raised is not None:
            raise raised
        if status == lib.MGT_CANCELLED:
            raise Cancelled(message, "cancelled")
        if status == lib.MGT_ERROR_SCENE:
            raise SceneError(message)
        if status == lib.MGT_ERROR_MEMORY:
            raise MemoryError(message)
        if status:
            raise MangataError(message, text(lib.mgt_status_name(status)))


def _callback(context: Context) -> Any:
    """The progress function of C. It does not keep the context, whose threads end with the last use of it."""
    weak = weakref.ref(context)

    def step(_user, fraction: float) -> bool:
        return weak()._step(fraction)

    def fail(_kind, exception, _traceback) -> None:
        weak()._raised = exception

    return ffi.callback("bool(void *, double)", step, error=False, onerror=fail)


_living: "weakref.WeakSet[Context]" = weakref.WeakSet()


def _after_fork() -> None:
    global _contexts_lock
    _contexts_lock = threading.Lock()
    for context in list(_living):
        context._after_fork()


os.register_at_fork(after_in_child=_after_fork)


def _layer_format(layer: str) -> Tuple[int, int]:
    if layer == DISPLAY:
        return lib.MGT_LAYER_COLOR, lib.MGT_FORMAT_RGBA8_SRGB
    place = choose(layers(), layer, "layer")
    return place, lib.MGT_FORMAT_RGB32F if lib.mgt_layer_channels(place) == 3 else lib.MGT_FORMAT_R32F


def _shape(layer: str, width: int, height: int) -> Tuple[Tuple[int, ...], Any]:
    if layer == DISPLAY:
        return (height, width, 4), np.uint8
    channels = lib.mgt_layer_channels(_layer_format(layer)[0])
    return ((height, width, 3) if channels == 3 else (height, width)), np.float32


def _crop_size(image) -> Tuple[int, int]:
    return image.crop_width or image.width - image.crop_x, image.crop_height or image.height - image.crop_y


def _check_array(layer: str, pixels: np.ndarray, image) -> None:
    shape, dtype = _shape(layer, *_crop_size(image))
    packed = np.dtype(dtype).itemsize * (shape[2] if len(shape) == 3 else 1)
    good = isinstance(pixels, np.ndarray) and pixels.shape == shape and pixels.dtype == dtype and pixels.flags.writeable
    if not good or pixels.strides[1] != packed or (len(shape) == 3 and pixels.strides[2] != np.dtype(dtype).itemsize):
        raise ValueError(f"layer {layer} needs a writeable array of {np.dtype(dtype).name} {shape} with packed rows")


_contexts: Dict[Tuple[str, int, str], Context] = {}
_contexts_lock = threading.Lock()


def _context(backend: str, threads: int, isa: str) -> Context:
    with _contexts_lock:
        key = (backend, threads, isa)
        if key not in _contexts:
            _contexts[key] = Context(backend, threads, isa)
        return _contexts[key]


def render(
    scene: SceneLike,
    method: Optional[str] = None,
    layers: Union[str, Sequence[str]] = ("color",),
    frame: int = 0,
    *,
    size: Optional[Tuple[int, int]] = None,
    crop: Optional[Tuple[int, int, int, int]] = None,
    changes: Optional[Mapping[str, Any]] = None,
    out: Optional[Mapping[str, np.ndarray]] = None,
    progress: Optional[Progress] = None,
    backend: str = "cpu",
    threads: int = 0,
    isa: str = "auto",
    context: Optional[Context] = None,
    **options: Any,
) -> Dict[str, np.ndarray]:
    """Renders a frame: a dictionary of numpy arrays by layer, top row first.

    scene    a Scene, a dictionary, or the path of a scene file
    method   "mangata", "podee-pixel", "ssaa4", "reference", …, with its own `spatial` and `time_samples`, not the scene's; None: the scene's, with all of its
             options
    layers   names, or a single one: "color" float32 (h, w, 3), radiance in kcd/m², linear sRGB; "display" uint8 (h, w, 4), what a screen shows;
             "normal", "refraction" float32 (h, w, 3);
             "coverage", "mask", "foam" float32 (h, w), fractions of the pixel; "depth" float32 (h, w), metres along the ray to the water or to an object
             before it, else inf; "samples", …
    frame    from 0; its time is start + frame / fps
    size     (width, height) in pixels; crop: (x, y, width, height) of it
    changes  values of the scene: {"light.elevation_deg": 6}
    out      arrays to render into, by layer, in place of new ones
    progress called with the fraction done several times a second; returning False stops with Cancelled, an exception passes through
    options  those of the method: samples=16, spatial=8, time_samples=8, seed=1, kernels="9", refraction="hybrid", …; one that it does not read is a SceneError

    The same scene, frame and options give the same numbers, whatever the threads. Errors: SceneError with file, line, column; MangataError.
    """
    given = dict(changes or {})
    if size is not None:
        given.update(size_changes(size))
    if method is not None:
        name, number = split_method(method)
        given["quality.method"] = name
        if number is not None and "spatial" in options:
            raise ValueError("spatial: write the number into ssaaN")
        if name in methods():  # else the scene says what is wrong
            # As by --method of the command: the method brings its numbers of samples along, whatever the scene's are.
            given["quality.spatial"], given["quality.time_samples"] = _samples(name)
        if number is not None:
            given["quality.spatial"] = number
    given.update({f"quality.{key}": value for key, value in options.items()})
    scene = as_scene(scene)
    if given:
        scene = _changed(scene, given)
    view = scene.frame(frame)
    for option in options:
        if lib.mgt_option_check(view, option.encode()):
            raise SceneError(text(lib.mgt_last_error(ffi.NULL)))
    if crop is not None:
        if not all(0 <= number <= max(view.image.width, view.image.height) for number in crop):
            raise ValueError(f"crop {crop}: it lies outside the picture of {view.image.width} x {view.image.height} pixels")
        view.image.crop_x, view.image.crop_y, view.image.crop_width, view.image.crop_height = crop
    width, height = _crop_size(view.image)
    if not 0 < width <= view.image.width or not 0 < height <= view.image.height:
        raise ValueError(f"crop {crop}: it lies outside the picture of {view.image.width} x {view.image.height} pixels")
    result = {}
    layers = listed(layers)
    if not layers:
        raise ValueError("no layer is given")
    for layer in out or {}:
        if layer not in layers:
            raise ValueError(f"out: layer {layer!r} is not among the layers that are rendered, {', '.join(layers)}")
    for layer in layers:
        shape, dtype = _shape(layer, width, height)
        result[layer] = out[layer] if out and layer in out else np.empty(shape, dtype)
    (context or _context(backend, threads, isa)).render_into(view, list(result.items()), progress)
    return result


@functools.lru_cache(maxsize=None)
def _samples(method: str) -> Tuple[int, int]:
    """The method's own `spatial` and `time_samples`."""
    quality = Scene({"quality": {"method": method}}).frame().quality
    return quality.spatial_samples, quality.time_samples


def _changed(scene: Scene, changes: Mapping[str, Any]) -> Scene:
    """The changed scene, the last one of each kept, so that a second frame does not read it again."""
    texts = change_texts(changes)
    key = list(texts.items())
    kept = getattr(scene, "_last_change", None)
    if kept is None or kept[0] != key:
        kept = scene._last_change = (key, scene._changed(texts))
    return kept[1]


__all__ = ["Context", "layers", "methods", "render"]
