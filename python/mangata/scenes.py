# SPDX-License-Identifier: MIT
"""Scenes: from files, text, dictionaries, or a few words about a sea."""
import json
import os
from typing import Any, Dict, Mapping, Optional, Tuple, Union

import numpy as np

from ._library import ffi, io, text
from .errors import MangataError, SceneError

Document = Union[str, Mapping[str, Any]]


def _plain(value: Any) -> Any:
    """numpy's numbers and arrays, and paths, as JSON has them."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    raise TypeError(f"{type(value).__name__} does not fit into a scene")


def change_texts(changes: Optional[Mapping[str, Any]]) -> Dict[str, str]:
    """Changes with their values as text, which later changes of an array or a list do not reach."""
    return {str(key): json.dumps(value, default=_plain) for key, value in (changes or {}).items()}


def _merged(before: Dict[str, str], changes: Dict[str, str]) -> Dict[str, str]:
    """Changes after others. A value replaces what was within it before; items of lists keep their places, for an index must not be beyond the end."""
    merged = dict(before)
    for key, value in changes.items():
        merged = {other: kept for other, kept in merged.items() if not other.startswith((key + ".", key + "["))}
        if any(key.startswith((other + ".", other + "[")) for other in merged):
            merged.pop(key, None)
        merged[key] = value
    return merged


def raise_io(status: int, error) -> None:
    """The exception of a failed call of libmangata-io."""
    reason, file = text(error.text), text(error.file)
    if status == io.MGT_IO_MEMORY:
        raise MemoryError(reason)
    if status == io.MGT_IO_MISSING:
        raise FileNotFoundError(f"{file}: {reason}" if file else reason)
    raise SceneError(reason, file or None, error.line or None, error.column or None)


def without_nul(data: bytes) -> bytes:
    """What C reads to its end."""
    if b"\0" in data:
        raise ValueError("embedded null byte")
    return data


def path_bytes(path: Union[str, bytes, os.PathLike]) -> bytes:
    """A file's name as the system has it."""
    return without_nul(os.fsencode(path))


def new_error():
    error = ffi.new("mgt_io_error *")
    io.mgt_io_error_init(error, ffi.sizeof("mgt_io_error"))
    return error


class Scene:
    """A scene that has been read and checked. It does not change: `changed()` gives another one.

    Scene("mangata: 1\\nwater: {wind: 12}")    YAML or JSON
    Scene({"water": {"wind": 12}})            the same as a dictionary, whose values may be numpy's
    Scene({"water": {"wind": 12}}, {"light.elevation_deg": 6})  with changes, whose keys are paths of the scene format
    """

    def __init__(self, document: Document, changes: Optional[Mapping[str, Any]] = None, name: str = "scene") -> None:
        if not isinstance(document, str):
            document = json.dumps({"mangata": 1, **document}, default=_plain)
        self._open("text", document.encode(), change_texts(changes), name)

    @classmethod
    def load(cls, path: Union[str, os.PathLike], changes: Optional[Mapping[str, Any]] = None) -> "Scene":
        """Reads a scene file. FileNotFoundError, SceneError."""
        scene = cls.__new__(cls)
        name = os.fsdecode(path)
        scene._open("file", b"", change_texts(changes), name)
        if name != "-":
            # The scene stays what it is, whatever becomes of its file or of the working folder.
            with open(name, "rb") as file:
                scene._kind, scene._source = "text", file.read()
            scene._path = os.path.join(os.getcwd(), name)
        return scene

    @classmethod
    def sea(cls, changes: Optional[Mapping[str, Any]] = None, **words: Any) -> "Scene":
        """A sea under a low sun from the wind: sea(wind=12, direction=30, seed=3); the words are those of `mangata render --sea` (docs/seas.md)."""
        scene = cls.__new__(cls)
        words_ = ",".join(f"{key}={value}" for key, value in words.items())
        scene._open("sea", words_.encode(), change_texts(changes), words_)
        return scene

    def changed(self, changes: Mapping[str, Any]) -> "Scene":
        """The scene with these values: changed({"light.elevation_deg": 3, "camera.position": [0, 4, 0]})."""
        return self._changed(change_texts(changes))

    def _changed(self, changes: Dict[str, str]) -> "Scene":
        scene = type(self).__new__(type(self))
        scene._open(self._kind, self._source, _merged(self._changes, changes), self._name, self._path)
        return scene

    def _open(self, kind: str, source: bytes, changes: Dict[str, str], name: str, path: Optional[str] = None) -> None:
        self._kind, self._source, self._changes, self._name, self._path = kind, source, changes, name, path
        words = [ffi.new("char[]", without_nul(f"{key}={value}".encode())) for key, value in changes.items()]
        array = ffi.new("char *[]", words) if words else ffi.NULL
        error, out = new_error(), ffi.new("mgt_scene_file **")
        if kind == "file":
            status = io.mgt_scene_file_load(out, path_bytes(name), array, len(words), error)
        elif kind == "sea":
            status = io.mgt_scene_file_sea(out, without_nul(source), array, len(words), error)
        else:
            status = io.mgt_scene_file_parse(out, source, len(source), path_bytes(path or name), array, len(words), error)
        if status:
            raise_io(status, error)
        self._file = ffi.gc(out[0], io.mgt_scene_file_free)

    def __reduce__(self) -> Tuple[Any, ...]:
        # Read again from the text where it is loaded; other files that it names have to be there.
        return _again, (type(self), self._kind, self._source, self._changes, self._name, self._path)

    def frame(self, frame: int = 0) -> Any:
        """The C struct `mgt_scene *` of a frame; what it points to lives as long as this scene."""
        scene = ffi.new("mgt_scene *")
        if not 0 <= frame < 1 << 31 or io.mgt_scene_file_frame(self._file, frame, scene, ffi.sizeof("mgt_scene")):
            raise SceneError(f"frame {frame}: there is no such frame, or its camera is not a legal one")
        return scene

    @property
    def frames(self) -> int:
        """How many frames the scene has."""
        return io.mgt_scene_file_frame_count(self._file)

    @property
    def fps(self) -> float:
        """Frames per second."""
        return io.mgt_scene_file_fps(self._file)

    @property
    def size(self) -> Tuple[int, int]:
        """Width and height in pixels."""
        view = self.frame(0)  # structs inside it live as long as it does
        return view.image.width, view.image.height

    @property
    def warning(self) -> str:
        """A warning about values that are legal but probably a mistake; "" where there is none."""
        return text(io.mgt_scene_file_warning(self._file)) or ""

    def waves(self, frame: int = 0) -> np.ndarray:
        """The waves, an array of shape (count, 5): amplitude in metres, kx and kz in radians a metre, omega in radians a second, phase in radians;
        y += amplitude · sin(kx x + kz z + omega t + phase)."""
        view = self.frame(frame)  # structs inside it live as long as it does
        water = view.water
        return np.array([[w.amplitude, w.kx, w.kz, w.omega, w.phase] for w in (water.waves[i] for i in range(water.wave_count))]).reshape(-1, 5)

    def __repr__(self) -> str:
        width, height = self.size
        return f"<mangata.Scene {self._name!r}: {width} x {height}, {self.frames} frames>"


def _again(kind: type, *opened: Any) -> Scene:
    scene: Scene = kind.__new__(kind)
    scene._open(*opened)
    return scene


# What functions take as a scene.
SceneLike = Union[Scene, Document, os.PathLike]


def as_scene(scene: SceneLike) -> Scene:
    """A Scene; a path of a scene file, or a dictionary, becomes one."""
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, Mapping):
        return Scene(scene)
    return Scene.load(scene)


__all__ = ["Scene", "SceneLike", "as_scene", "MangataError"]
