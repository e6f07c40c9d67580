#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the command on hostile files, one row each, and checks its exit code, its message and place, that it takes at most 5 s of a core and 500 MB, and that no file
is left behind.

usage: hostile.py COMMAND [PATTERN]     PATTERN: only rows whose name matches; in the environment SANITIZED=1: a build whose time and memory say nothing"""
import base64
import copy
import json
import os
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

SANITIZED = os.environ.get("SANITIZED") == "1"
SECONDS, MEGABYTES = (60, 1 << 20) if SANITIZED else (5, 500)
BAD, MISSING, USAGE = 65, 66, 64
rows = []  # name, files {name: bytes, Link, Folder or Pipe}, words of the command, exit code, pattern of the message


class Link(str):
    """A symbolic link to this."""

    def make(self, path):
        os.symlink(self, path)


class Packed:
    """A long content, packed: forks of a large process take long, and their memory counts as the command's."""

    def __init__(self, content):
        self.content = zlib.compress(content, 1)

    def make(self, path):
        with open(path, "wb") as out:
            out.write(zlib.decompress(self.content))


class Folder:
    def make(self, path):
        os.mkdir(path)


class Pipe:
    def make(self, path):
        os.mkfifo(path)


def kept(content):
    content = content.encode() if isinstance(content, str) and not isinstance(content, Link) else content
    return Packed(content) if isinstance(content, bytes) and len(content) > 1 << 16 else content


def row(name, files, words, code, pattern):
    rows.append((name, {file: kept(content) for file, content in files.items()}, words, code, pattern))


def check(name, file, content, pattern, code=BAD, more=None, key="mesh"):
    """A scene that names the file."""
    scene = {"mesh": f"mangata: 1\nobjects:\n  - {{mesh: {file}}}\n", "texture": f"mangata: 1\nobjects:\n  - {{shape: box, material: {{texture: {file}}}}}\n",
             "heights": f"mangata: 1\nobjects:\n  - {{shape: floor, heights: {file}}}\n"}[key]
    place = {"mesh": "s.yaml:3:[0-9]+: objects\\[0\\].mesh: ", "texture": "s.yaml:3:[0-9]+: objects\\[0\\].material.texture: ", "heights": "s.yaml:3:[0-9]+: objects\\[0\\].heights: "}[key]
    row(f"{key} {name}", {"s.yaml": scene, **({file: content} if content is not None else {}), **(more or {})}, ["scene", "check", "s.yaml"], code, place + pattern)


# ---- glTF ----

FLOATS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def data_uri(data):
    return "data:application/octet-stream;base64," + base64.b64encode(data).decode()


BASE = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "children": [1]}, {"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}], "materials": [{"pbrMetallicRoughness": {}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}, {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        "buffers": [{"byteLength": 42, "uri": data_uri(FLOATS + struct.pack("<3H", 0, 1, 2))}]}
GONE = object()
SPARSE = {"count": 1, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}}


def edited(edits):
    document = copy.deepcopy(BASE)
    for path, value in edits:
        *way, last = [int(p) if p.isdigit() else p for p in path.split(".")]
        at = document
        for step in way:
            at = at[step]
        if value is GONE:
            del at[last]
        elif isinstance(at, list) and last == len(at):
            at.append(value)
        else:
            at[last] = value
    return json.dumps(document, indent=1)


def gltf(name, pattern, *edits):
    check(name, "x.gltf", edited(edits), "x.gltf:[0-9]+:[0-9]+: .*" + pattern)


GLTF = [
    ("no asset", "asset is missing", ("asset", GONE)), ("no version", "asset.version is missing", ("asset.version", GONE)),
    ("version 1", "asset.version is 1.0; allowed: 2.0", ("asset.version", "1.0")), ("version 3", "asset.version is 3.0", ("asset.version", "3.0")),
    ("Draco required", r"extensionsRequired names KHR_draco_mesh_compression: not supported; allowed: KHR_lights_punctual, ", ("extensionsRequired", ["KHR_xmp_json_ld", "KHR_draco_mesh_compression"])),
    ("two extensions required", "names EXT_a, KHR_b: not", ("extensionsRequired", ["EXT_a", "KHR_b"])), ("an extension of 100000 letters", "names XXX", ("extensionsRequired", ["X" * 100000])),
    ("10000 extensions", "names E0, E1", ("extensionsRequired", [f"E{i}" for i in range(10000)])), ("extensions a word", "extensionsRequired is of another kind", ("extensionsRequired", "KHR_a")),
    ("an extension by number", "extensionsRequired holds a value", ("extensionsRequired", [1])),
    ("version a number", "asset.version is of another kind", ("asset.version", 2)), ("asset a list", "asset is of another kind", ("asset", [])),
    ("scene beyond", "scene is none of the 1 scenes", ("scene", 1)), ("scene negative", "scene is none", ("scene", -1)), ("scene half", "scene is none", ("scene", 0.5)),
    ("scene huge", "scene is none", ("scene", 1e300)), ("scenes an object", "scenes is of another kind", ("scenes", {})), ("scene a number", "holds a value", ("scenes", [1])),
    ("scene's nodes a number", "nodes is of another kind", ("scenes.0.nodes", 1)), ("scene's node beyond", "names none of the 2 nodes", ("scenes.0.nodes", [2])),
    ("scene names a child", "another's child", ("scenes.0.nodes", [0, 1])), ("scene names a node twice", "named twice", ("nodes.0.children", GONE), ("scenes.0.nodes", [0, 0])),
    ("nodes in a circle", "circle", ("nodes.1.children", [0]), ("scenes.0.nodes", [])), ("node its own child", "circle|one parent", ("nodes.0.children", [0])),
    ("node twice a child", "one parent", ("nodes.0.children", [1, 1])), ("child beyond", "names none", ("nodes.0.children", [7])), ("child a word", "names none", ("nodes.0.children", ["a"])),
    ("children an object", "another kind", ("nodes.0.children", {})), ("mesh beyond", "mesh is none", ("nodes.0.mesh", 1)), ("skin beyond", "skin is none", ("nodes.0.skin", 0)),
    ("matrix short", "list of 16 numbers", ("nodes.0.matrix", [1, 0, 0])), ("matrix of words", "list of 16", ("nodes.0.matrix", ["1"] * 16)),
    ("rotation short", "list of 4", ("nodes.0.rotation", [1])), ("translation a number", "another kind", ("nodes.0.translation", 1)), ("scale long", "list of 3", ("nodes.0.scale", [1] * 4)),
    ("no primitives", "primitives is missing", ("meshes.0.primitives", GONE)), ("primitive a number", "is not an object", ("meshes.0.primitives.0", 3)),
    ("no attributes", "attributes is missing", ("meshes.0.primitives.0.attributes", GONE)), ("attribute beyond", "none of the 2 accessors", ("meshes.0.primitives.0.attributes.POSITION", 9)),
    ("attribute negative", "none of the 2 accessors", ("meshes.0.primitives.0.attributes.POSITION", -1)), ("places of shorts", "another type", ("meshes.0.primitives.0.attributes.POSITION", 1)),
    ("normals of scalars", "another type", ("meshes.0.primitives.0.attributes.NORMAL", 1)), ("joints of three", "another type", ("meshes.0.primitives.0.attributes.JOINTS_0", 0)),
    ("as many in each", "as many in each", ("accessors.2", {"bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3"}), ("meshes.0.primitives.0.attributes.NORMAL", 2)),
    ("indices beyond", "indices is none", ("meshes.0.primitives.0.indices", 5)), ("indices of floats", "another type", ("meshes.0.primitives.0.indices", 0)),
    ("mode 7", "mode is 7", ("meshes.0.primitives.0.mode", 7)), ("mode negative", "mode is -1", ("meshes.0.primitives.0.mode", -1)), ("material beyond", "material is none", ("meshes.0.primitives.0.material", 1)),
    ("targets an object", "targets is of another kind", ("meshes.0.primitives.0.targets", {})), ("target beyond", "none of the 2", ("meshes.0.primitives.0.targets", [{"POSITION": 4}])),
    ("no type", "type is missing", ("accessors.0.type", GONE)), ("type unknown", "type is unknown", ("accessors.0.type", "VEC9")), ("no componentType", "componentType is missing", ("accessors.0.componentType", GONE)),
    ("componentType 5124", "5124", ("accessors.0.componentType", 5124)), ("componentType 1", "componentType is 1", ("accessors.0.componentType", 1)), ("no count", "count is missing", ("accessors.0.count", GONE)),
    ("count 0", "count is 0", ("accessors.0.count", 0)), ("count negative", "count is -3", ("accessors.0.count", -3)), ("count half", "count is 1.5", ("accessors.0.count", 1.5)),
    ("count 4", "ends 48 bytes", ("accessors.0.count", 4)), ("count 2^32", "count is 4294967296", ("accessors.0.count", 4294967296)), ("count 2^31", "count is 2147483648", ("accessors.0.count", 2147483648)),
    ("count 1e30", "count is 1e", ("accessors.0.count", 1e30)), ("byteOffset -8", "byteOffset is -8", ("accessors.0.byteOffset", -8)), ("byteOffset 4", "ends 40 bytes", ("accessors.0.byteOffset", 4)),
    ("byteOffset 2^40", "ends", ("accessors.0.byteOffset", 1 << 40)), ("view beyond", "bufferView is none", ("accessors.0.bufferView", 2)), ("zeros from nothing", "come from nothing", ("accessors.0.bufferView", GONE), ("accessors.0.count", 150000000)),
    ("sparse empty", "sparse.count is missing", ("accessors.0.sparse", {})), ("sparse a list", "sparse is of another kind", ("accessors.0.sparse", [])),
    ("sparse without indices", "sparse.indices is missing", ("accessors.0.sparse", {"count": 1, "values": {"bufferView": 0}})), ("sparse without values", "sparse.values is missing", ("accessors.0.sparse", {"count": 1, "indices": {"bufferView": 1, "componentType": 5123}})),
    ("sparse count 4", "sparse.count is 4", ("accessors.0.sparse", {**SPARSE, "count": 4})), ("sparse count 1e9", "sparse.count is 1000000000", ("accessors.0.sparse", {**SPARSE, "count": 10**9})),
    ("sparse indices of floats", "componentType is 5126", ("accessors.0.sparse", {**SPARSE, "indices": {"bufferView": 1, "componentType": 5126}})), ("sparse values beyond", "sparse.values ends", ("accessors.0.sparse", {**SPARSE, "values": {"bufferView": 0, "byteOffset": 30}})),
    ("sparse indices beyond", "sparse.indices ends", ("accessors.0.sparse", {**SPARSE, "indices": {"bufferView": 1, "componentType": 5123, "byteOffset": 5}})),
    ("sparse index out of range", "is 16256|below 3", ("accessors.0.sparse", {**SPARSE, "indices": {"bufferView": 0, "componentType": 5123, "byteOffset": 14}})),
    ("sparse indices fall", "more than the one before", ("accessors.0.sparse", {"count": 2, "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 0}})),
    ("view's buffer beyond", "buffer is none of the 1", ("bufferViews.0.buffer", 1)), ("view without a buffer", "buffer is none", ("bufferViews.0.buffer", GONE)), ("view without a length", "byteLength is missing", ("bufferViews.0.byteLength", GONE)),
    ("view of length 0", "byteLength is out of range", ("bufferViews.0.byteLength", 0)), ("view too long", "ends 43 bytes", ("bufferViews.0.byteLength", 43)), ("view at -1", "byteOffset is out of range", ("bufferViews.0.byteOffset", -1)),
    ("view at the end", "ends 78 bytes", ("bufferViews.0.byteOffset", 42)), ("stride 4294967295", "byteStride is out of range", ("bufferViews.0.byteStride", 4294967295)), ("stride 2", "byteStride is out of range", ("bufferViews.0.byteStride", 2)),
    ("stride 252", "ends 516 bytes", ("bufferViews.0.byteStride", 252)), ("buffer without a length", "byteLength is missing", ("buffers.0.byteLength", GONE)), ("buffer of 43 bytes", "at most the 42 bytes", ("buffers.0.byteLength", 43)),
    ("buffer of GiB", "at most the 42 bytes", ("buffers.0.byteLength", 4 << 30)), ("buffer of 1e18 bytes", "out of range", ("buffers.0.byteLength", 10**18)), ("buffer of nothing", "uri is missing", ("buffers.0.uri", GONE)),
    ("uri a number", "uri is not a string", ("buffers.0.uri", 3)), ("uri not base64", "not in base64", ("buffers.0.uri", "data:text/plain,abc")), ("uri with a star", "base64's", ("buffers.0.uri", "data:;base64,AAA*")),
    ("uri missing", "cannot be read", ("buffers.0.uri", "nowhere.bin")), ("uri a device", "cannot be read", ("buffers.0.uri", "/dev/zero")), ("uri a folder", "cannot be read", ("buffers.0.uri", ".")), ("uri escaped", "cannot be read", ("buffers.0.uri", "\u0001\u0000x")),
    ("image of two", "or neither", ("images", [{}])), ("texture's image beyond", "source is none", ("textures", [{"source": 0}])), ("base colour beyond", "index is none", ("materials.0.pbrMetallicRoughness.baseColorTexture", {"index": 0})),
    ("base colour without index", "index is missing", ("materials.0.pbrMetallicRoughness.baseColorTexture", {})), ("base colour short", "list of 4", ("materials.0.pbrMetallicRoughness.baseColorFactor", [1])),
    ("skin without joints", "joints is missing", ("skins", [{}])), ("joint beyond", "names none", ("skins", [{"joints": [4]}])), ("matrices too few", "inverseBindMatrices", ("skins", [{"joints": [0], "inverseBindMatrices": 0}])),
]
for entry in GLTF:
    gltf(*entry[:2], *entry[2:])
LONG = copy.deepcopy(BASE)
LONG["nodes"] = [{"children": [i + 1]} for i in range(400)] + [{"mesh": 0}]
check("400 nodes deep", "x.gltf", json.dumps(LONG), "x.gltf:1:[0-9]+: .*deeper than 256")
TWICE = copy.deepcopy(BASE)
TWICE["nodes"] = [{"children": [i + 1, i + 1]} for i in range(31)] + [{"mesh": 0}]
check("2^30 nodes", "x.gltf", json.dumps(TWICE), "x.gltf:1:[0-9]+: .*one parent")
MANY = copy.deepcopy(BASE)
MANY["accessors"] = [{"componentType": 5126, "count": 100000, "type": "VEC3"} for _ in range(3000)]
check("thousands of accessors of nothing", "x.gltf", json.dumps(MANY), "x.gltf:1:[0-9]+: .*come from nothing")
check("glTF 1.0 in a circle", "x.gltf", '{"asset":{"version":"1.0"},"scene":"s","scenes":{"s":{"nodes":["a"]}},"nodes":{"a":{"children":["a"]}}}', "x.gltf:1:[0-9]+: asset.version")
for name, text, pattern in [
        ("empty", "", "not valid JSON"), ("blank", "  \n ", "not valid JSON"), ("a word", "glTF", "not valid in JSON"), ("200000 brackets", "[" * 200000, "nested deeper than 64"),
        ("200000 braces", '{"a":' * 200000, "nested deeper"), ("deep extras", '{"asset":{"version":"2.0"},"extras":' + "[" * 200000 + "]" * 200000 + "}", "nested deeper"),
        ("cut", edited([])[:200], "not valid JSON"), ("two documents", edited([]) + "{}", "text follows the document"), ("a list", "[]", "not a JSON object"), ("a zero byte", "{\0}", "not printable"),
        ("not UTF-8", b'{"a": "\xff"}', "not printable UTF-8"), ("a bare word", "{a: 1}", "name in quotes"), ("no colon", '{"a" 1}', "colon is missing"), ("no comma", '{"a": 1 "b": 2}', "comma"),
        ("trailing comma", '{"a": 1,}', "name in quotes"), ("NaN", '{"a": NaN}', "not valid in JSON"), ("1e999", '{"a": 1e999}', "too large"), ("a long number", '{"a": ' + "1" * 100 + "}", "63 characters"),
        ("01", '{"a": 01}', "comma"), ("minus", '{"a": -}', "digit"), ("escape", '{"a": "\\q"}', "escape"), ("half an escape", '{"a": "\\u12"}', "escape"), ("no end", '{"a": "b', "no end"),
        ("a line end in a string", '{"a\nb": 1}', "control character"), ("a tab in a string", '{"a": "\t"}', "control character"),
        ("two million values", "[" + "0," * 2100000 + "0]", "2000000 values")]:
    check("JSON " + name, "x.gltf", text, "x.gltf:[0-9]+:[0-9]+: .*" + pattern)

# ---- GLB ----

inner = copy.deepcopy(BASE)
del inner["buffers"][0]["uri"]


def glb(chunks, version=2, length=None, magic=b"glTF"):
    body = b"".join(struct.pack("<I", len(data) if size is None else size) + kind + data for kind, data, size in chunks)
    return magic + struct.pack("<II", version, 12 + len(body) if length is None else length) + body


TEXT = json.dumps(inner).encode()
TEXT += b" " * (-len(TEXT) % 4)
BYTES = FLOATS + struct.pack("<3HH", 0, 1, 2, 0)
for name, data, pattern in [
        ("empty", b"", "not binary glTF"), ("short", b"glTF\x02\0\0\0", "not binary glTF"), ("another word", glb([(b"JSON", TEXT, None)], magic=b"GLTF"), "not binary glTF"), ("version 1", glb([(b"JSON", TEXT, None)], 1), "version 1"),
        ("length 0", glb([(b"JSON", TEXT, None)], 2, 0), "says that it has 0 bytes"), ("length 4 GiB", glb([(b"JSON", TEXT, None)], 2, 0xFFFFFFFF), "says that it has"), ("chunk too long", glb([(b"JSON", TEXT, 0xFFFFFFF0)]), "chunk 0"),
        ("chunk cut", glb([(b"JSON", TEXT, len(TEXT) - 3), (b"BIN\0", BYTES, None)]), "chunk 1|chunk"), ("bytes first", glb([(b"BIN\0", BYTES, None), (b"JSON", TEXT, None)]), "chunk 0"), ("two JSON", glb([(b"JSON", TEXT, None), (b"JSON", TEXT, None)]), "chunk 1"),
        ("no bytes", glb([(b"JSON", TEXT, None)]), "line 1, column [0-9]+: buffers\\[0\\].uri is missing"), ("too few bytes", glb([(b"JSON", TEXT, None), (b"BIN\0", BYTES[:40], None)]), "column [0-9]+: buffers\\[0\\].byteLength"),
        ("empty JSON", glb([(b"JSON", b"", None), (b"BIN\0", BYTES, None)]), "not valid JSON"), ("JSON of zeros", glb([(b"JSON", b"\0" * 64, None)]), "not valid JSON")]:
    check("GLB " + name, "x.glb", data, "x.glb: .*" + pattern)

# ---- OBJ ----

V = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
for name, text, place, pattern in [
        ("empty", "", "1:1", "without a face"), ("places alone", V, "4:1", "without a face"), ("index 0", V + "f 0 1 2\n", "4:3", "places that do not exist"), ("index 4", V + "f 1 2 4\n", "4:7", "places that"),
        ("index -4", V + "f -1 -2 -4\n", "4:9", "places that"), ("index 2^64", V + "f 1 2 18446744073709551617\n", "4:7", "places that"), ("texture beyond", V + "f 1/1 2/1 3/1\n", "4:5", "texture coordinates"),
        ("normal beyond", V + "f 1//1 2//1 3//1\n", "4:6", "normals"), ("corner a word", V + "f a b c\n", "4:3", "no corner"), ("corner of four", V + "f 1/1/1/1 2 3\n", "4:", "corner|texture"), ("corner 1.5", V + "f 1.5 2 3\n", "4:3", "no corner"),
        ("two places", "v 0 0\n" + V + "f 1 2 3\n", "1:6", "number is missing"), ("nan", "v nan 0 0\n" + V + "f 1 2 3\n", "1:3", "no finite number"), ("inf", "v 0 inf 0\n" + V + "f 1 2 3\n", "1:5", "no finite number"),
        ("1e999", "v 0 1e999 0\n" + V + "f 1 2 3\n", "1:5", "no finite"), ("a word", "v 0 zero 0\n" + V + "f 1 2 3\n", "1:5", "no finite"), ("many numbers", "v 0 0 0 0 0 0 0 0 0\n" + V + "f 1 2 3\n", "1:19", "too many"),
        ("long number", "v " + "1" * 70 + " 0 0\n" + V + "f 1 2 3\n", "1:3", "63 characters"), ("a zero byte", V + "f 1 2\0 3\n", "4:6", "byte is zero"), ("a face of 70000", V + "f" + " 1" * 70000 + "\n", "4:", "65536 corners"),
        ("binary", bytes(range(256)) * 40, "1:1", "byte is zero")]:
    check("OBJ " + name, "x.obj", text, f"x.obj:{place}.*{pattern}")
check("OBJ that never ends", "x.obj", V + "f 1 2 3 \\\n" * 100000, "x.obj: ?.*allowed")
check("OBJ of one point", "x.obj", V + "f 1 1 1\n" * 1000, "x.obj: .*area")
check("OBJ with a pipe of materials", "x.obj", "mtllib /dev/zero\n" + V + "usemtl a\nf 1 2 3\n", "^$", 0)

# ---- PLY ----

HEAD = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
for name, text, place, pattern in [
        ("empty", "", "1:1", "begin with"), ("another", "plx\n", "1:1", "begin with"), ("cut", HEAD[:60], "[0-9]+:1", "ends in its header"), ("format", HEAD.replace("ascii", "utf"), "2:1", "format"), ("no format", HEAD.replace("format ascii 1.0\n", ""), "8:1", "no format"),
        ("negative", HEAD.replace("vertex 3", "vertex -3"), "3:1", "number"), ("a word", HEAD.replace("vertex 3", "vertex x"), "3:1", "number"), ("2^64", HEAD.replace("vertex 3", "vertex 18446744073709551616") + "0 0 0\n", "", "early|four thousand"),
        ("10^9", HEAD.replace("vertex 3", "vertex 1000000000") + "0 0 0\n", "", "early"), ("type", HEAD.replace("float x", "half x"), "4:1", "not understood"), ("list of floats", HEAD.replace("uchar int", "float int"), "8:1", "not understood"),
        ("no x", HEAD.replace(" x", " w") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "", "no x, y and z"), ("no vertices", HEAD.replace("vertex 3", "vertex 0") + "3 0 1 2\n", "", "no vertices|early|not"), ("values cut", HEAD + "0 0 0\n1 0", "", "early"),
        ("a value", HEAD + "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n", "11:3", "no number"), ("index", HEAD + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "13:7", "refers to a vertex"), ("index negative", HEAD + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -2\n", "13:7", "refers"),
        ("list of 10^9", HEAD + "0 0 0\n1 0 0\n0 1 0\n1000000000 0 1 2\n", "13:1", "longer than 65536"), ("seventeen elements", "ply\nformat ascii 1.0\n" + "element a 1\n" * 17, "19:1", "16 elements"), ("properties", "ply\nformat ascii 1.0\nelement a 1\n" + "property int a\n" * 65, "68:1", "64 of one"),
        ("property alone", "ply\nformat ascii 1.0\nproperty int a\n", "3:1", "without an element"), ("noise", HEAD.replace("ascii", "binary_little_endian").encode() + b"\xff" * 100, "", "PLY|vertex|list|nan"),
        ("a dead element", HEAD.replace("element face", "element dead 18446744073709551615\nelement face") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "", "^$")]:
    check("PLY " + name, "x.ply", text, "" if pattern == "^$" else f"x.ply:?{place}.*{pattern}", 0 if pattern == "^$" else BAD)

# ---- pictures ----


def chunk(kind, data, crc=None):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data) if crc is None else crc)


def png(width, height, depth=8, color=2, data=None, more=b"", end=True):
    row_bytes = (width * {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}.get(color, 1) * depth + 7) // 8
    data = zlib.compress(b"\0" * ((row_bytes + 1) * height), 9) if data is None else data
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, 0)) + more + chunk(b"IDAT", data) + (chunk(b"IEND", b"") if end else b"")


BLACK = zlib.compressobj(9)
BOMB = b"".join(BLACK.compress(b"\0" * 16384 * 64) for _ in range(64)) + BLACK.flush()
PNGS = [("empty", b"", "PNG"), ("signature alone", b"\x89PNG\r\n\x1a\n", "ends too early|PNG"), ("16384 x 16384", png(16384, 16384, 8, 0, BOMB), "268435456 pixels.*MANGATA_PIXELS=268435456"),
        ("16384 x 16384 of 16 bits", png(16384, 16384, 16, 6, BOMB), "268435456 pixels"), ("2^31 x 1", png(0x7FFFFFFF, 1, 8, 0, BOMB), "PNG|dimension|width|allowed"), ("0 x 0", png(0, 0), "allowed"),
        ("depth 3", png(2, 2, 3), "allowed"), ("colour 5", png(2, 2, 8, 5), "allowed"), ("no palette", png(2, 2, 8, 3), "allowed"), ("no data", png(9, 9, 8, 2, b""), "allowed"), ("data cut", png(64, 64, 8, 2, zlib.compress(b"\0" * 500)), "allowed"),
        ("data noise", png(64, 64, 8, 2, os.urandom(0) + bytes(range(256)) * 4), "allowed"), ("checksum", b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0), 1), "allowed"), ("text of 20 MB", png(2, 2, 8, 2, None, chunk(b"zTXt", b"a\0\0" + zlib.compress(b"x" * (20 << 20)))), "allowed")]
for name, data, pattern in PNGS:
    check("PNG " + name, "x.png", data, "x.png: .*" + pattern, key="texture")
    row("diff PNG " + name, {"a.png": data, "b.png": png(2, 2)}, ["diff", "a.png", "b.png"], BAD, "a.png: ")
    check("PNG " + name, "x.png", data, "x.png: ", key="heights")
check("JPEG cut", "x.jpg", b"\xff\xd8\xff\xe0\0\x10JFIF\0\1\2\0\0\1\0\1\0\0", "x.jpg: .*JPEG", key="texture")
check("JPEG noise", "x.jpg", b"\xff\xd8\xff" + bytes(range(256)) * 20, "x.jpg: .*JPEG", key="texture")
check("a folder", "d", None, "d: is a directory", MISSING, key="texture")
check("a device", "/dev/zero", None, "/dev/zero: is no regular file", MISSING, key="texture")
for name, data in [("PFM without a size", b"PF\n"), ("PFM of 2^32", b"PF\n4294967296 1\n-1.0\n"), ("PFM negative", b"PF\n-1 1\n-1.0\n"), ("PFM scale 0", b"PF\n1 1\n0\n" + b"\0" * 12), ("PFM scale nan", b"PF\n1 1\nnan\n" + b"\0" * 12), ("PFM cut", b"PF\n4 4\n-1.0\n" + b"\0" * 100),
                   ("PFM long", b"PF\n1 1\n-1.0\n" + b"\0" * 13), ("PFM 32768 x 32768", b"Pf\n32768 32768\n-1.0\n"), ("EXR magic", b"\x76\x2f\x31\x01"), ("EXR zeros", b"\x76\x2f\x31\x01" + b"\0" * 400), ("EXR noise", b"\x76\x2f\x31\x01\x02\0\0\0" + bytes(range(1, 256)) * 9),
                   ("EXR of long names", b"\x76\x2f\x31\x01\x02\0\0\0" + b"a" * 70000), ("EXR attribute of 2 GiB", b"\x76\x2f\x31\x01\x02\0\0\0channels\0chlist\0\xff\xff\xff\x7f"), ("text", b"a picture"), ("y4m", b"YUV4MPEG2 W9 H9\n")]:
    row("diff " + name, {"a": data, "b.png": png(2, 2)}, ["diff", "a", "b.png"], BAD, "^mangata: a: ")

# ---- files of sums ----


def sums(pixels="4x3", ranges="0,1", rows=b"\0" * 36, text=None, checksum=True, **more):
    """A part of a picture of 4 x 3 pixels, whose hash is none."""
    text = json.dumps({"mangata_version": "0.1.0", "method": "reference", "pixels": pixels, "ranges": ranges, **more}).encode() if text is None else text
    data = b"mangata sums 1\n" + struct.pack("<I", len(text)) + text + rows
    return data + struct.pack("<I", zlib.crc32(data) if checksum else 1)


for name, data, pattern in [
        ("empty", b"", "is not a file of sums"), ("text", b"a part", "is not a file of sums"), ("of version 2", b"mangata sums 2\n", "is not a file of sums"), ("PNG", png(4, 3), "is not a file of sums"),
        ("without a head", b"mangata sums 1\n", "ends too early"), ("head of 4 GiB", b"mangata sums 1\n\xff\xff\xff\xff" + b"{" * 100, "metadata are longer"),
        ("head cut", sums()[:60], "metadata are longer|ends too early"), ("head a list", sums(text=b"[]"), "not a JSON object"), ("100000 levels", sums(text=b"[" * 100000), "not a JSON object"), ("key twice", sums(text=b'{"a": "b", "a": "c"}'), "not a JSON object"),
        ("no size", sums(text=b'{"ranges": "0,1"}'), "pixels is missing"), ("size a number", sums(text=b'{"pixels": 3}'), "pixels is missing"), ("size 0", sums("0x3"), "pixels is missing"), ("size of words", sums("4x"), "pixels is missing"),
        ("32768 x 99999", sums("32768x99999"), "pixels is missing"), ("size -4", sums("-4x3"), "pixels is missing"), ("no ranges", sums(text=b'{"pixels": "4x3"}'), "ranges is missing"), ("empty ranges", sums(ranges=""), "ranges is missing"),
        ("range of none", sums(ranges="0,0"), "ranges is missing"), ("range of 2^64", sums(ranges="0,18446744073709551616"), "ranges is missing"), ("range -1", sums(ranges="-1,2"), "ranges is missing"), ("ranges that overlap", sums(ranges="0,3 2,2"), "ranges is missing"),
        ("10000 ranges", sums(ranges=" ".join(f"{2 * i},1" for i in range(10000))), "ranges is missing"), ("another method", sums(method="ssaa2"), "it has method ssaa2, and this merge has reference"),
        ("another version", sums(mangata_version="9.9\x1b[31m" + "x" * 5000), "it has mangata_version 9.9.\\[31mx+, and this merge has"), ("no hash", sums(), "it has method_options unknown")]:
    row("merge " + name, {"s.yaml": "mangata: 1\nimage: {width: 4, height: 3}\n", "p.sums": data}, ["merge", "s.yaml", "p.sums", "-o", "a.png", "--method", "reference"], BAD, "^mangata: p.sums: .*" + pattern)
row("merge a device", {"s.yaml": "mangata: 1\n"}, ["merge", "s.yaml", "/dev/zero", "-o", "a.png", "--method", "reference"], MISSING, "/dev/zero: is no regular file")
row("merge a folder", {"s.yaml": "mangata: 1\n"}, ["merge", "s.yaml", "d", "-o", "a.png", "--method", "reference"], MISSING, "d: is a directory")
row("merge nothing", {"s.yaml": "mangata: 1\n"}, ["merge", "s.yaml", "p.sums", "-o", "a.png", "--method", "reference"], MISSING, "p.sums: .*No such file")
row("diff sums", {"a": sums(), "b.png": png(2, 2)}, ["diff", "a", "b.png"], BAD, "^mangata: a: holds sums of samples; mangata merge")

# ---- scenes ----

for name, text, place in [
        ("empty", "", "1:1"), ("binary", bytes(range(256)), "1:1"), ("not UTF-8", b"mangata: 1\ndescription: \xc3\x28\n", "2:"), ("open list", "mangata: 1\nimage: [", "2:"), ("open quote", 'mangata: 1\ndescription: "a', "2:"), ("tabs", "mangata: 1\n\timage: {}", "1:10"),
        ("anchor", "mangata: 1\nimage: &a {width: 3}\n", "2:11"), ("alias", "mangata: 1\nimage: *a\n", "2:8"), ("tag", "mangata: 1\nimage: !!map {}\n", "2:14"), ("laughs", "a: &a [x,x]\nb: &b [*a,*a]\nc: [*b,*b]\n", "1:"), ("two documents", "mangata: 1\n---\nmangata: 1\n", "2:1"),
        ("100 levels", "mangata: 1\nimage: " + "[" * 100 + "]" * 100, "2:"), ("100000 levels", "{" * 100000, "1:"), ("100000 keys", "mangata: 1\n" + "".join(f"k{i}: 1\n" for i in range(100000)), "2:1"), ("key twice", "mangata: 1\nmangata: 1\n", "2:1"),
        ("a long key", "mangata: 1\n" + "k" * 70000 + ": 1\n", "2:1"), ("a list as key", "mangata: 1\n? [a]\n: 1\n", "2:"), ("version 2", "mangata: 2\n", "1:10"), ("no version", "image: {}\n", "1:"), ("NUL in a text", 'mangata: 1\ndescription: "a\\0b"\n', "2:14"),
        ("width 1e9", "mangata: 1\nimage: {width: 1000000000}\n", "2:16"), ("width octal", "mangata: 1\nimage: {width: 0o9}\n", "2:16"), ("nan", "mangata: 1\nlight: {elevation_deg: .nan}\n", "2:24"), ("fps 0", "mangata: 1\ntime: {fps: 0}\n", "2:13"), ("frames 1e12", "mangata: 1\ntime: {frames: 1000000000000}\n", "2:16"),
        ("wave of words", "mangata: 1\nwater: {waves: [{amplitude: high}]}\n", "2:"), ("waves a number", "mangata: 1\nwater: {waves: 3}\n", "2:"), ("2049 waves", "mangata: 1\nwater:\n  waves:\n" + "    - {amplitude: 0.01, a: 1, b: 0, c: 1}\n" * 2049, "[0-9]+:"),
        ("wind of words", "mangata: 1\nwater: {wind: {speed: fast}}\n", "2:"), ("count 1e9", "mangata: 1\nwater: {wind: {speed: 9, count: 1000000000}}\n", "2:"), ("70000 objects", "mangata: 1\nobjects:\n" + "  - {shape: box}\n" * 70000, "[0-9]+:"),
        ("triangles 1e12", "mangata: 1\nobjects: [{shape: sphere, triangles: 1000000000000}]\n", "2:"), ("camera at itself", "mangata: 1\ncamera: {position: [1, 2, 3], target: [1, 2, 3]}\n", "2:"), ("path of 1 time", "mangata: 1\ncamera: {path: [{time: 0}, {time: 0}]}\n", "2:")]:
    row("scene " + name, {"s.yaml": text}, ["scene", "check", "s.yaml"], BAD, f"^s.yaml:{place}")
row("scene of 17 MiB", {"s.yaml": "# " + "x" * (17 << 20)}, ["scene", "check", "s.yaml"], BAD, "larger than 16 MiB")
row("scene missing", {}, ["scene", "check", "s.yaml"], MISSING, "s.yaml: No such file")
row("scene a folder", {}, ["scene", "check", "d"], MISSING, "directory")
row("scene a device", {}, ["scene", "check", "/dev/urandom"], MISSING, "no regular file")

# ---- spectra ----

for name, text, place in [
        ("empty", "", ""), ("words", "this is no table\nof numbers\n", ":1:|:2:"), ("two columns", "0.1 0\n", ":1:"), ("nan", "0.1 0 nan\n", ":1:"), ("negative", "0.1 0 -1\n", ":1:"), ("falling", "0.2 0 1\n0.1 0 1\n", ":2:"), ("binary", b"0.1 0 1\n\x01", ":2:"), ("no NUL", "0.1", ":1:"),
        ("a long line", "0.1 " * 100000, ":1:"), ("one frequency", "0.1 0 1\n", ""), ("600000 lines", "".join(f"0.1 {i * 0.0005:.4f} 1\n" for i in range(600000)), ":5"), ("NDBC without a record", "#YY MM DD hh mm Sep_Freq\n", ""), ("NDBC without numbers", "#YY MM DD hh mm Sep_Freq\n2026 1 1 1 1 0.1 x (0.1)\n", ":2:"),
        ("Datawell cut", "1\n2\n3\n", ":")]:
    row("buoy " + name, {"x.txt": text}, ["waves", "--buoy", "x.txt"], BAD, f"x.txt{place}")

# ---- words of the command ----

for words, pattern in [
        (["render", "s.yaml", "-o", "a.png", "--frames", "9-1"], "frames"), (["render", "s.yaml", "-o", "a.png", "--frames", "0-99999999999"], "frames"), (["render", "s.yaml", "-o", "a%s.png", "--frames", "0-3"], "-o"), (["render", "s.yaml", "-o", "a%n.png"], "-o"),
        (["render", "s.yaml", "-o", "a.png", "--size", "0x0"], "size"), (["render", "s.yaml", "-o", "a.png", "--size", "99999999999x1"], "size"), (["render", "s.yaml", "-o", "a.png", "--crop", "1,2,3"], "crop"), (["render", "s.yaml", "-o", "a.png", "--crop", "0,0,0,0"], "crop"),
        (["render", "s.yaml", "-o", "a.png", "--threads", "-1"], "threads"), (["render", "s.yaml", "-o", "a.png", "--seed", "x"], "seed"), (["render", "s.yaml", "-o", "a.png", "--method", "ssaa99999999999"], "ssaa|method"), (["render", "s.yaml", "-o", "a.png", "--method", "%n%n"], "method"),
        (["render", "s.yaml", "-o", "a.gif"], "gif"), (["render", "s.yaml"], "-o"), (["render", "--sea", "wind=nan", "-o", "a.png"], "wind"), (["render", "--sea", "wind=9,wind=9,", "-o", "a.png"], "sea|wind"), (["render", "s.yaml", "-o", "a.png", "--set", "x"], "key=value"),
        (["render", "s.yaml", "-o", "a.png", "--set", "a" * 100000 + "=1"], "aaa"), (["diff", "a"], "diff"), (["\x1b[31m"], "verb|option")]:
    row("words " + " ".join(w[:30] for w in words).replace("\x1b", "ESC"), {"s.yaml": "mangata: 1\n"}, words, (USAGE, BAD), pattern)


# ---- of other kinds: encodings, numbers at their limits, texts that a terminal obeys, names of files ----

S = {"s.yaml": "mangata: 1\nimage: {width: 8, height: 8}\n"}
LONE = "frequency 0.1 Hz has one direction"
for name, text, pattern in [
        ("UTF-16", "\ufeffmangata: 1\n".encode("utf-16-le"), "1:1: not a text file"), ("UTF-32", "\ufeffmangata: 1\n".encode("utf-32-le"), "1:1: not a text file"), ("half a pair in UTF-8", b"mangata: 1\ndescription: \xed\xa0\x80\n", "2:14: not a text"),
        ("a slash of two bytes", b"mangata: 1\ndescription: \xc0\xaf\n", "2:14: not a text"), ("NUL behind the end", b"mangata: 1\n\0x: [\n", "2:1: not a text"), ("U+202E in a key", "mangata: 1\n\u202eabc: 1\n", r'2:1: unknown key "\?abc"'),
        ("U+2028 in a key", "mangata: 1\n\"a\u2028b\": 1\n", r'unknown key "a\?b"|2:'), ("U+2066 in a text", "mangata: 1\nsky: {model: \u2066black}\n", r'2:14: sky.model is \?black'), ("U+009B in a key", b"mangata: 1\nk\xc2\x9b31m: 1\n", r'2:1: unknown key "k\?31m"'),
        ("escape in a key", 'mangata: 1\n"\\e[31mX": 1\n', r'2:1: unknown key "\?\[31mX"'), ("escape in a value", 'mangata: 1\nsky: {model: "\\e]0;a\\a"}\n', "2:14: sky.model"), ("line end in a value", 'mangata: 1\nsky: {model: "a\\nb"}\n', r'2:14: sky.model is the text "a\?b"'),
        ("carriage returns alone", "mangata: 1\rimage: {width: 0}\r", "2:16: image.width is 0"), ("YAML 9.9", "%YAML 9.9\n---\nmangata: 1\n", "1:1: not valid"), ("a tag's prefix", "%TAG ! tag:x,2000:\n---\nmangata: !foo 1\n", "3:15: tags"), ("text behind the end", "mangata: 1\n...\nfoo\n", "2:1: a second"),
        ("comments alone", "# nothing\n", "1:1: the file is empty"), ("an empty key", 'mangata: 1\n"": 1\n', '2:1: unknown key ""'), ("a mapping as key", "mangata: 1\n{a: 1}: 1\n", "2:1: a list or mapping"), ("merge key", "mangata: 1\nimage: {<<: {width: 3}}\n", "2:9: unknown key"),
        ("a text as version", "mangata: '1'\n", "1:10: mangata is the text"), ("no version but a key", "mangata:\n", "1:1: mangata is empty"), ("nine aliases of nine", "mangata: 1\na: &a [x,x,x]\n" + "".join(f"{chr(98 + i)}: &{chr(98 + i)} [{','.join(['*' + chr(97 + i)] * 9)}]\n" for i in range(9)), "2:7: anchors"),
        ("-0 pixels", "mangata: 1\nimage: {width: -0}\n", "2:16: image.width is -0"), ("least double", "mangata: 1\nimage: {width: 4.9e-324}\n", "2:16: image.width"), ("1e400", "mangata: 1\nlight: {elevation_deg: 1e400}\n", "2:24: light"), ("-inf", "mangata: 1\nlight: {elevation_deg: -.inf}\n", "2:24: light"),
        ("400 digits", "mangata: 1\nimage: {width: " + "9" * 400 + "}\n", "2:16: image.width is 9+[.]{3};"), ("thousands by _", "mangata: 1\nimage: {width: 1_000}\n", "2:16"), ("a time", "mangata: 1\nimage: {width: 12:30:45}\n", "2:16"), ("Arabic digits", "mangata: 1\nimage: {width: ١٢}\n", "2:16"),
        ("true", "mangata: 1\nimage: {width: true}\n", "2:16"), ("a number in quotes", "mangata: 1\nimage: {width: '3'}\n", "2:16: image.width is the text"), ("seed of 2^64", "mangata: 1\nquality: {method: ssaa, seed: 18446744073709551616}\n", "2:31: quality.seed is 18446744073709551616; allowed: a whole number, 0 to 18446744073709551615"),
        ("seed of half", "mangata: 1\nquality: {method: ssaa, seed: .5}\n", "2:31"), ("camera a nanometre from its target", "mangata: 1\ncamera: {position: [1e-320, 4, 0], target: [1e-320, 4, 1e-9]}\n", "2:44: camera"), ("up of nan", "mangata: 1\ncamera: {up: [.nan, 1, 0]}\n", "2:15"),
        ("path of 100000", "mangata: 1\ncamera: {path: [" + ",".join(f"{{time: {i}}}" for i in range(100000)) + "]}\n", "2:16: camera.path has 100000"), ("text of 15 MiB", "mangata: 1\ndescription: " + "x" * (15 << 20) + "\n", "2:14: a text is too long"), ("number of 15 MiB", "mangata: 1\nimage: {width: " + "1" * (15 << 20) + "}\n", "2:16: a text is too long"),
        ("key of 15 MiB", "mangata: 1\n" + "a" * (15 << 20) + ": 1\n", "2:1: a text is too long"), ("900000 mappings", "mangata: 1\nobjects: [" + "{}," * 900000 + "{}]\n", "2:10: objects has 900001"), ("quotes of 10 MB", "mangata: 1\ndescription: '" + "''" * 5000000 + "'\n", "2:14: a text"),
        ("a million dashes", "mangata: 1\nobjects:\n" + "- " * 1000000 + "\n", "3:63: nested too deep"), ("100000 question marks", "mangata: 1\n" + "? " * 100000 + "\n", "2:3: a list or mapping"), ("a pair's half in JSON", '{"mangata": 1, "description": "\\ud800"}', "1:32: not valid"), ("NUL in JSON", '{"mangata": 1, "description": "\\u0000"}', "1:31: a text holds a NUL"),
        ("an empty name of a mesh", "mangata: 1\nobjects: [{mesh: ''}]\n", "2:12: objects"), ("mesh is the scene", "mangata: 1\nobjects: [{mesh: s.yaml}]\n", "2:18: .*another extension"), ("mesh is memory", "mangata: 1\nobjects: [{mesh: /proc/self/mem}]\n", "2:18: .*another extension"), ("texture of /proc", "mangata: 1\nobjects: [{shape: box, material: {texture: /proc/cpuinfo}}]\n", "2:44: .*neither PNG nor JPEG"),
        ("scale 0", "mangata: 1\nobjects: [{shape: box, scale: 0}]\n", "2:31"), ("size of 1e-320", "mangata: 1\nobjects: [{shape: box, size: [1e-320, 1, 1]}]\n", "2:31"), ("turned by 1e308", "mangata: 1\nobjects: [{shape: box, rotation_deg: [1e308, 1, 1]}]\n", "2:39"), ("start 1e300", "mangata: 1\ntime: {start: 1e300}\n", "2:15"), ("fps 1e-320", "mangata: 1\ntime: {fps: 1e-320}\n", "2:13"),
        ("wind 1e-320", "mangata: 1\nwater: {wind: {speed: 1e-320}}\n", "2:23"), ("water of 1e-300 m", "mangata: 1\nwater: {wind: {speed: 9, depth: 1e-300}}\n", "2:23: .*over this depth, that are all shorter.*deeper water"), ("fetch 1e-300", "mangata: 1\nwater: {wind: {speed: 9, fetch: 1e-300}}\n", "2:33"), ("seed -1", "mangata: 1\nwater: {wind: {speed: 9, seed: -1}}\n", "2:32")]:
    row("scene of " + name, {"s.yaml": text}, ["scene", "check", "s.yaml"], BAD, f"^s.yaml:{pattern}" if re.match("[0-9]", pattern) else pattern)
for name, words in [("long", "a" * 5000 + ".ply"), ("deep", "a/" * 2500 + "x.ply"), ("of two lines", '"a\\nb.ply"')]:
    row(f"scene of a mesh's name {name}", {"s.yaml": f"mangata: 1\nobjects: [{{mesh: {words}}}]\n"}, ["scene", "check", "s.yaml"], MISSING, "s.yaml:2:18: objects.0..mesh: ")

ZEROS = zlib.compress(bytes(100 << 20), 1)
for name, data, pattern in [
        ("filter 5", png(2, 2, data=zlib.compress(b"\5\0\0\0\0\0\0" * 2)), "invalid scanline filter"), ("two headers", png(2, 2)[:33] + png(2, 2)[8:], "invalid chunk position"), ("header late", png(2, 2)[:8] + chunk(b"tEXt", b"a\0b") + png(2, 2)[8:], "IHDR"),
        ("another checksum of its data", png(2, 2)[:-16] + b"\0\0\0\0" + png(2, 2)[-12:], "checksum"), ("chunk of 2^31", png(2, 2)[:33] + struct.pack(">I", 1 << 31) + b"IDAT" + b"x" * 10, "length"), ("unknown critical chunk", png(2, 2)[:33] + chunk(b"ABCD", b"x") + png(2, 2)[33:], "critical"),
        ("100000 texts", png(2, 2)[:33] + chunk(b"tEXt", b"render_hash\0x") * 100000 + png(2, 2)[33:], "limits"), ("profile of 100 MB", png(2, 2, more=chunk(b"iCCP", b"a\0\0" + ZEROS)), "limits"), ("text of 100 MB", png(2, 2, more=chunk(b"iTXt", b"a\0\1\0\0\0" + ZEROS)), "limits")]:
    check("PNG of " + name, "x.png", data, "x.png: .*" + pattern, key="texture")
    row("diff PNG of " + name, {"a.png": data, "b.png": png(2, 2)}, ["diff", "a.png", "b.png"], BAD, "^mangata: a.png: .*" + pattern)


def exr(window=(0, 0, 0, 0), channels=None, version=2, tail=b""):
    """An EXR file of one pixel, or one that says something else."""
    channels = b"".join(n + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for n in (b"B", b"G", b"R")) + b"\0" if channels is None else channels
    box = struct.pack("<4i", *window)
    attributes = [(b"channels", b"chlist", channels), (b"compression", b"compression", b"\0"), (b"dataWindow", b"box2i", box), (b"displayWindow", b"box2i", box), (b"lineOrder", b"lineOrder", b"\0"),
                  (b"pixelAspectRatio", b"float", struct.pack("<f", 1)), (b"screenWindowCenter", b"v2f", b"\0" * 8), (b"screenWindowWidth", b"float", struct.pack("<f", 1))]
    head = b"\x76\x2f\x31\x01" + struct.pack("<I", version) + b"".join(n + b"\0" + t + b"\0" + struct.pack("<i", len(d)) + d for n, t, d in attributes) + b"\0"
    return head + (struct.pack("<Qii3f", len(head) + 8, 0, 12, 1, 2, 3) if not tail else tail)


def channel(kind, step):
    return b"R\0" + struct.pack("<iB3xii", kind, 0, step, step) + b"\0"


for name, data, pattern in [
        ("window of 2^31", exr((0, 0, 2**31 - 1, 2**31 - 1)), "EXR"), ("window of all", exr((-2**31, -2**31, 2**31 - 1, 2**31 - 1)), "EXR"), ("window inside out", exr((5, 5, 0, 0)), "EXR"), ("30000 x 30000", exr((0, 0, 29999, 29999)), "900000000 pixels.*MANGATA_PIXELS"), ("a row of 2^30", exr((0, 0, 1 << 30, 0)), "EXR"),
        ("5000 x 5000 without rows", exr((0, 0, 4999, 4999)), "EXR"), ("steps of 0", exr(channels=channel(2, 0)), "EXR"), ("steps of 2^31", exr(channels=channel(2, 2**31 - 1)), "EXR"),
        ("numbers of kind 9", exr(channels=channel(9, 1)), "EXR"), ("version 3", exr(version=3), "EXR"), ("tiles that are none", exr(version=0x202), "EXR"), ("parts that are none", exr(version=0x1002), "EXR"),
        ("a row beyond", exr(tail=struct.pack("<Q", 1 << 63) + b"\0" * 20), "EXR"), ("a row in the header", exr(tail=struct.pack("<Q", 8) + b"\0" * 20), "EXR"), ("a row of -1 bytes", exr(tail=struct.pack("<Qii", len(exr()) - 20, 0, -1) + b"\0" * 12), "EXR"), ("row 2^31", exr(tail=struct.pack("<Qii", len(exr()) - 20, 2**31 - 1, 12) + b"\0" * 12), "EXR"),
        ("PFM with a comment", b"PF\n# a\n1 1\n-1.0\n" + b"\0" * 12, "PFM"), ("PFM of scale inf", b"PF\n1 1\ninf\n" + b"\0" * 12, "PFM"), ("PFM of 0x1", b"PF\n0x1 1\n-1.0\n" + b"\0" * 12, "PFM"), ("PFM of three sizes", b"PF\n1 1 1\n-1.0\n" + b"\0" * 12, "PFM"), ("PFM with line ends of two bytes", b"PF\r\n1 1\r\n-1.0\r\n" + b"\0" * 12, "PFM")]:
    row("diff of " + name, {"a": data, "b.png": png(1, 1)}, ["diff", "a", "b.png"], BAD, "^mangata: a: .*" + pattern)

for name, text, pattern in [
        ("UTF-16", "0.1 0 1\n".encode("utf-16"), ":1:1: not a text"), ("NUL", b"0.1 0 1\n0.2\0 0 1\n", ":2:4: not a text"), ("1e-320 Hz", "1e-320 0 1\n2e-320 0 1\n", ":1:1: frequency"), ("1e300 Hz", "1e300 0 1\n2e300 0 1\n", ":1:1: frequency"), ("density 1e300", "0.1 0 1e300\n0.2 0 1\n", ":1:7: density"), ("all zero", "0.1 0 -0\n0.2 0 0\n", LONE),
        ("direction 1e300", "0.1 1e300 1\n0.2 0 1\n", ":1:5: direction"), ("a frequency twice", "0.1 0 1\n0.1 0 1\n", "twice"), ("0 Hz", "0 0 1\n0.1 0 1\n", ":1:1: frequency"), ("-0.1 Hz", "-0.1 0 1\n", ":1:1: frequency"), ("hexadecimal", "0x1p-3 0 1\n", ":1:1: frequency"), ("decimal commas", "0,1 0 1\n", ":1:7: more than"), ("semicolons", "0.1;0;1\n", ":1:1: "),
        ("carriage returns alone", "0.1 0 1\r0.2 0 1\r", ":1:9: more"), ("17 MiB", "0.1 0 1\n" * 2300000, "larger than 16 MiB"), ("six columns", "0.1 0 1 2 3 4\n", ":1:9: more"), ("NDBC of many nines", "#YY MM DD hh mm\n" + "9 " * 100000, ":2:1: there are fewer"), ("NDBC of brackets", "#YY MM DD hh mm Sep_Freq\n2026 1 1 1 1 0.1 1 ((((((0.1)\n", ":2:20: ")]:
    row("buoy of " + name, {"x.txt": text}, ["waves", "--buoy", "x.txt", "-o", "o.yaml"], BAD, f"x.txt{pattern}" if pattern[0] == ":" else pattern)

# Pieces of a model, whose number makes the importer slow; and lines that other programs obey.
for name, text, code, pattern in [
        ("100000 objects", V + "".join(f"o a{i}\nf 1 2 3\n" for i in range(100000)), BAD, "x.obj:131077:[0-9]+: there are more than 65536 objects"), ("200000 groups", V + "".join(f"g a{i}\nf 1 2 3\n" for i in range(200000)), BAD, "x.obj:131077:[0-9]+: there are more"),
        ("a million names of one group", V + "g a\n" * 1000000 + "f 1 2 3\n", 0, ""), ("a command", "csh touch a\ncall x.obj\n" + V + "f 1 2 3\n", 0, ""), ("itself as material", "mtllib x.obj\n" + V + "f 1 2 3\n", 0, ""), ("a file above as material", "mtllib ../../../../etc/passwd\n" + V + "usemtl a\nf 1 2 3\n", 0, ""),
        ("lines alone", V + "l 1 2\n", BAD, "x.obj:5:1: .*without a face"), ("UTF-16", (V + "f 1 2 3\n").encode("utf-16"), BAD, "x.obj:1:[0-9]+: a byte is zero"), ("v 1e38", "v 1e38 -1e38 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", BAD, "x.obj")]:
    row("OBJ of " + name, {"s.yaml": "mangata: 1\nobjects:\n  - {mesh: x.obj}\n", "x.obj": text}, ["scene", "check", "s.yaml"], code, pattern)
for name, text, code, pattern in [
        ("20 million digits", HEAD + "1" * 20000000, BAD, "x.ply"), ("half a million comments", "ply\n" + "comment a\n" * 500000 + HEAD[4:] + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 0, ""), ("a vertex at inf", HEAD + "inf 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", BAD, "x.ply"), ("a vertex at 1e7", HEAD + "1e7 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", BAD, "x.ply"), ("faces of two", HEAD + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", BAD, "x.ply"),
        ("a list of -1", HEAD.replace("uchar", "char") + "0 0 0\n1 0 0\n0 1 0\n-1\n", BAD, "x.ply"), ("x twice", HEAD.replace("float y", "float x") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", BAD, "x.ply"), ("2^32 vertices in binary", HEAD.replace("vertex 3", "vertex 4294967295").replace("ascii", "binary_little_endian"), BAD, "x.ply")]:
    row("PLY of " + name, {"s.yaml": "mangata: 1\nobjects:\n  - {mesh: x.ply}\n", "x.ply": text}, ["scene", "check", "s.yaml"], code, pattern)

LOOP = {"l.png": Link("m.png"), "m.png": Link("l.png"), "n": Link("n")}
OUT = ["render", "s.yaml", "-o"]
for name, files, words, code, pattern in [
        ("no word", {}, [""], USAGE, ""), ("a line end", {}, ["\n"], USAGE, ""), ("no scene", {}, ["render", ""], (USAGE, MISSING, BAD), ""), ("an option of 100000 letters", {}, ["render", "--" + "a" * 100000], USAGE, "aaa"), ("two scenes", {}, OUT[:2] + ["s.yaml", "-o", "a.png"], USAGE, ""), ("no name of the output", {}, OUT + [""], USAGE, "-o"),
        ("output is a folder", {}, OUT + ["d"], 73, "d: is a directory"), ("output in a folder that is none", {}, OUT + ["x/y.png"], 73, "x/y.png"), ("output under a file", {}, OUT + ["s.yaml/a.png"], 73, "s.yaml/a.png"), ("output in /proc", {}, OUT + ["/proc/a.png"], 73, "/proc/a.png"), ("output behind /dev/full", {}, OUT + ["/dev/full"], 73, "/dev/full: is not a regular file"),
        ("output is a folder of pictures", {"e.png": Folder()}, OUT + ["e.png", "--overwrite"], 73, "e.png"), ("output a link to itself", LOOP, OUT + ["l.png"], 73, "l.png"), ("output in a link to itself", LOOP, OUT + ["n/a.png"], 73, "n/a.png"), ("scene a link to itself", LOOP, ["scene", "check", "n"], (BAD, MISSING), "n: "),
        ("output a link to nothing", {"g.png": Link("/nowhere/x.png")}, OUT + ["g.png"], 73, "g.png"), ("output a pipe", {"f.png": Pipe()}, OUT + ["f.png"], 73, "f.png"), ("skips a pipe", {"f.png": Pipe()}, OUT + ["f.png", "--skip-existing"], 73, "f.png"), ("skips a folder", {"f.png": Folder()}, OUT + ["f.png", "--skip-existing"], 73, "f.png"),
        ("a name of 300 letters", {}, OUT + ["a" * 300 + ".png"], USAGE, "aaa"), ("a path of 5000 letters", {}, OUT + ["a/" * 2500 + "x.png"], (USAGE, 73), ""), ("a path of 100000 letters", {}, OUT + ["a/" * 50000 + "x.png"], (USAGE, 73), ""), ("two numbers in a name", {}, OUT + ["a%04d%04d.png"], USAGE, "one frame number"), ("a number of 10^9 digits", {}, OUT + ["a%0999999999d.png"], USAGE, "-o"),
        ("%*d", {}, OUT + ["a%*d.png"], USAGE, "-o"), ("frames twice", {}, OUT + ["a_%d.png", "--frames", "0,0"], USAGE, "twice"), ("frames in steps of 0", {}, OUT + ["a_%d.png", "--frames", "0-5:0"], USAGE, "step"), ("65535 x 65535", {}, OUT + ["a.png", "--size", "65535x65535"], (USAGE, BAD), "65535|size"), ("+4x4", {}, OUT + ["a.png", "--size", "+4x4"], USAGE, "size"),
        ("crop of 2^32", {}, OUT + ["a.png", "--crop", "4294967295,0,2,1"], (USAGE, BAD), "crop"), ("1025 threads", {}, OUT + ["a.png", "--threads", "1025"], USAGE, "threads"), ("ssaa0", {}, OUT + ["a.png", "--method", "ssaa0"], USAGE, "ssaa"), ("method ff", {}, OUT + ["a.png", "--method", b"\xff"], USAGE, "method"),
        ("set =1", {}, OUT + ["a.png", "--set", "=1"], (USAGE, BAD), "--set"), ("set a value of two lines", {}, OUT + ["a.png", "--set", "image.width=3\nmangata: 2"], (USAGE, BAD), "--set"), ("set 100000 brackets", {}, OUT + ["a.png", "--set", "x=" + "[" * 100000], (USAGE, BAD), "--set"), ("set 100000 dots", {}, OUT + ["a.png", "--set", "." * 100000 + "=1"], (USAGE, BAD), "--set"),
        ("set wave 10^20", {}, OUT + ["a.png", "--set", "water.waves[99999999999999999999].amplitude=1"], (USAGE, BAD), "--set"), ("a sea of 1e300", {}, ["render", "--sea", "wind=1e300", "-o", "a.png"], (USAGE, BAD), "wind"), ("a sea of nothing", {}, ["render", "--sea", "", "-o", "a.png"], USAGE, "sea"), ("layer twice", {}, OUT + ["a.exr", "--layer", "color,color"], USAGE, "layer"),
        ("mattes of 0 rays", {}, OUT + ["a.exr", "--exr", "cryptomatte:0"], USAGE, "exr|cryptomatte"), ("shard 3/3", {}, OUT + ["a_%d.png", "--shard", "3/3"], USAGE, "shard"), ("shard of 0", {}, OUT + ["a_%d.png", "--shard", "0/0"], USAGE, "shard"), ("nan samples", {}, OUT + ["a.png", "--samples", "nan"], USAGE, "samples"), ("checkpoints every 1e300 s", {}, OUT + ["a.png", "--checkpoint", "1e300"], USAGE, "checkpoint"),
        ("diff of one device", {}, ["diff", "/dev/zero", "/dev/zero"], MISSING, "regular"), ("diff of names with %s", {}, ["diff", "a%s.png", "b%s.png"], (USAGE, MISSING), ""), ("diff by nan", {"a.png": png(2, 2)}, ["diff", "a.png", "a.png", "--ppd", "nan"], USAGE, "ppd"), ("bench of 0 frames", {}, ["bench", "s.yaml", "--frames", "0"], USAGE, "frames"),
        ("a scene's name that colours", {}, ["scene", "check", "\x1b]0;x\x07.yaml"], MISSING, r"\?\]0;x\?.yaml"), ("a scene's name in no encoding", {}, ["scene", "check", b"\xff.yaml"], MISSING, r"\?.yaml"), ("a scene's name from right to left", {}, ["scene", "check", "\u202eb.yaml"], MISSING, r"\?b.yaml"), ("a waves' file in a folder", {}, ["waves", "--wind", "9", "-o", "d"], 73, "d: is a directory")]:
    row("words: " + name, {**S, **files}, words, code, pattern)


def run(command, words, folder):
    """Exit code, message, seconds of a core and megabytes, of the command and what it started."""
    with open(os.path.join(folder, ".out"), "w+b") as out, open(os.path.join(folder, ".err"), "w+b") as err:
        process = subprocess.Popen([command, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (4 * SECONDS, 4 * SECONDS)))
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        err.seek(0)
        message = err.read().decode(errors="replace")
    os.remove(os.path.join(folder, ".out"))
    os.remove(os.path.join(folder, ".err"))
    return process.returncode, message, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def main():
    if len(sys.argv) < 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        return 64
    wanted = [r for r in rows if len(sys.argv) < 3 or re.search(sys.argv[2], r[0])]
    failed, slowest, largest, start = 0, ("", 0), ("", 0), time.monotonic()
    for name, files, words, code, pattern in wanted:
        folder = tempfile.mkdtemp(prefix="mangata-hostile-")
        os.mkdir(os.path.join(folder, "d"))
        for file, content in files.items():
            path = os.path.join(folder, file)
            if not isinstance(content, bytes):
                content.make(path)
                continue
            with open(path, "wb") as out:
                out.write(content)
        before = sorted(os.listdir(folder))
        found, message, seconds, megabytes = run(sys.argv[1], words, folder)
        slowest, largest = max(slowest, (name, seconds), key=lambda x: x[1]), max(largest, (name, megabytes), key=lambda x: x[1])
        wrong = []
        if found not in (code if isinstance(code, tuple) else (code,)):
            wrong.append(f"exit code {found} instead of {code}")
        if found != 0 and (message.count("\n") != 1 or not re.search(pattern, message)):
            wrong.append(f"says {message[:300]!r}, not {pattern!r}")
        if re.search("[^\\x20-\\x7e\\n\\u00a0-\\U0010ffff]|[\\u2028-\\u202e\\u2066-\\u2069]", message):
            wrong.append("prints control characters")
        if seconds > SECONDS:
            wrong.append(f"takes {seconds:.1f} s of a core")
        if megabytes > MEGABYTES:
            wrong.append(f"takes {megabytes:.0f} MB")
        if sorted(os.listdir(folder)) != before:
            wrong.append(f"leaves {set(os.listdir(folder)) - set(before)}")
        shutil.rmtree(folder)
        if wrong:
            failed += 1
            print(f"FAIL {name}: " + "; ".join(wrong))
    print(f"{len(wanted)} hostile inputs, {failed} of them with a failure, in {time.monotonic() - start:.1f} s; the slowest {slowest[1]:.2f} s ({slowest[0]}), "
          f"the largest {largest[1]:.0f} MB ({largest[0]})")
    return 1 if failed else 0


sys.exit(main())
