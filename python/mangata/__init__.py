# SPDX-License-Identifier: MIT
"""Mangata: anti-aliased reflections of the sun and the moon on water, in numpy arrays.

    import mangata
    scene = mangata.load("scenes/sunset.json")
    picture = mangata.render(scene, method="mangata", layers=["display", "coverage"])
    picture["coverage"].mean()

Units: metres, seconds, degrees where a name says so; radiance in kcd/m². Pictures have their top row first. docs/python.md tells more.
"""
import os
from typing import Any, Mapping, Optional, Union

from ._library import lib as _lib
from ._library import text as _text
from .errors import Cancelled, MangataError, SceneError
from .measuring import compare, error_map, metric_names, metrics, read
from .rendering import Context, layers, methods, render
from .scenes import Scene
from .water import query, trace

__version__ = _text(_lib.mgt_version())


def load(path: Union[str, os.PathLike], changes: Optional[Mapping[str, Any]] = None) -> Scene:
    """Reads a scene file: `Scene.load`."""
    return Scene.load(path, changes)


def sea(changes: Optional[Mapping[str, Any]] = None, **words: Any) -> Scene:
    """A sea from the wind, sea(wind=12): `Scene.sea`."""
    return Scene.sea(changes, **words)


__all__ = ["Cancelled", "Context", "MangataError", "Scene", "SceneError", "compare", "error_map", "layers", "load", "methods", "metric_names", "metrics", "query", "read", "render", "sea", "trace"]
