# SPDX-License-Identifier: MIT
"""The C libraries: where they are, and their declarations, which are those of the public headers."""
import os

import cffi

ffi = cffi.FFI()
_HERE = os.path.dirname(os.path.abspath(__file__))
_TREE = os.path.join(_HERE, "..", "..", "build")


def _places():
    """Folders with the libraries and, beside them or in python/, the declarations: MANGATA_BUILD, the tree's build, else the system's."""
    if "MANGATA_BUILD" in os.environ:
        yield os.environ["MANGATA_BUILD"]
    yield os.path.normpath(_TREE)


def _read(path):
    with open(path, encoding="utf-8") as f:
        return f.read()


def _load(name):
    """A library for good: threads of Embree may still run when the interpreter ends, which would unload their code."""
    return ffi.dlopen(name, ffi.RTLD_NOW | os.RTLD_NODELETE)


def _open():
    for folder in _places():
        declarations = os.path.join(folder, "python", "declarations.h")
        libraries = [os.path.join(folder, name) for name in ("libmangata.so", "libmangata-io.so")]
        if os.path.exists(declarations) and all(map(os.path.exists, libraries)):
            ffi.cdef(_read(declarations))
            return [_load(path) for path in libraries]
    declarations = os.path.join(_HERE, "declarations.h")
    if not os.path.exists(declarations):
        raise ImportError("mangata: neither built here (make) nor installed; MANGATA_BUILD names a build folder")
    ffi.cdef(_read(declarations))
    # Each line is a library's place from here in the prefix of the installation; elsewhere the system knows its name.
    libraries = _read(os.path.join(_HERE, "libraries.txt")).split()
    beside = [os.path.normpath(os.path.join(_HERE, path)) for path in libraries]
    if all(map(os.path.exists, beside)):
        return [_load(path) for path in beside]
    try:
        return [_load(os.path.basename(path)) for path in libraries]
    except OSError as error:
        raise ImportError(f"mangata: {error}; looked for {' and '.join(beside)}, then where the system has libraries") from error


lib, io = _open()
if ffi.string(lib.mgt_version()) != ffi.string(io.mgt_io_version()):
    raise ImportError("mangata: libmangata and libmangata-io are of different versions")


def text(pointer):
    """A C string; None for NULL."""
    return None if pointer == ffi.NULL else ffi.string(pointer).decode("utf-8", "replace")


def names(function):
    """The names of an enum, from 0 on."""
    found = []
    while (name := text(function(len(found)))) is not None:
        found.append(name)
    return found
