#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Decodes Cryptomatte out of an EXR without compression, by the specifications alone.

  cryptomatte.py FILE                      checks hashes, manifest, ranks and sums
  cryptomatte.py FILE NAME [X Y]           and prints the mean share of NAME over the picture, or its share at a pixel
  cryptomatte.py FILE --crop-of OTHER X Y  and compares the mattes with those of OTHER from (X, Y) on"""
import array
import json
import struct
import sys


def murmur3_32(data):
    c1, c2, mask, h = 0xCC9E2D51, 0x1B873593, 0xFFFFFFFF, 0
    rotate = lambda x, r: (x << r | x >> (32 - r)) & mask
    mixed = lambda k: rotate(k * c1 & mask, 15) * c2 & mask
    whole = len(data) // 4 * 4
    for (k,) in struct.iter_unpack("<I", data[:whole]):
        h = (rotate(h ^ mixed(k), 13) * 5 + 0xE6546B64) & mask
    h ^= mixed(int.from_bytes(data[whole:], "little")) if len(data) > whole else 0
    h ^= len(data)
    h = (h ^ h >> 16) * 0x85EBCA6B & mask
    h = (h ^ h >> 13) * 0xC2B2AE35 & mask
    return h ^ h >> 16


def bits_of(name):
    """The hash as a float's bits: exponents of all zeros or all ones become normal ones."""
    h = murmur3_32(name.encode())
    return h ^ 1 << 23 if h >> 23 & 255 in (0, 255) else h


def read_exr(path):
    """(attributes, width, height, {channel: 32 bit words})."""
    data = open(path, "rb").read()
    assert struct.unpack_from("<I", data)[0] == 20000630, "no EXR"
    flags = struct.unpack_from("<I", data, 4)[0]
    assert flags & 0x1A00 == 0, "tiled, deep or of several parts"
    attributes, at = {}, 8

    def text(at):
        end = data.index(b"\0", at)
        return data[at:end].decode(), end + 1

    while data[at]:
        name, at = text(at)
        kind, at = text(at)
        size = struct.unpack_from("<I", data, at)[0]
        attributes[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    assert attributes["compression"] == b"\0", "compressed"
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    names, place, listed = [], 0, attributes["channels"]
    while listed[place]:
        end = listed.index(b"\0", place)
        kind = struct.unpack_from("<I", listed, end + 1)[0]
        names.append((listed[place:end].decode(), {1: 2, 2: 4}[kind]))
        place = end + 17
    channels = {name: array.array("I") for name, size in names if size == 4}
    for (offset,) in struct.iter_unpack("<Q", data[at + 1 : at + 1 + 8 * height]):
        line = offset + 8
        for name, size in names:
            if size == 4:
                channels[name].frombytes(data[line : line + 4 * width])
            line += size * width
    return attributes, width, height, channels


def floats(words):
    return array.array("f", words.tobytes())


class Mattes:
    def __init__(self, path):
        attributes, self.width, self.height, channels = read_exr(path)
        keys = [name for name in attributes if name.startswith("cryptomatte/") and name.endswith("/name")]
        assert len(keys) == 1, keys
        key = keys[0].split("/")[1]
        said = {word: attributes[f"cryptomatte/{key}/{word}"].decode() for word in ("name", "hash", "conversion", "manifest")}
        assert said["hash"] == "MurmurHash3_32" and said["conversion"] == "uint32_to_float32", said
        assert len(key) == 7 and key == ("%08x" % murmur3_32(said["name"].encode()))[:7], key
        self.manifest = {name: int(digits, 16) for name, digits in json.loads(said["manifest"]).items()}
        for name, bits in self.manifest.items():
            assert bits == bits_of(name), name
        ranks = sorted(name[: -len(".R")] for name in channels if name.startswith(said["name"]) and name.endswith(".R"))
        assert ranks == [f"{said['name']}{i:02d}" for i in range(len(ranks))] and ranks, ranks
        self.pairs = [(channels[f"{layer}.{i}"], floats(channels[f"{layer}.{share}"])) for layer in ranks for i, share in ("RG", "BA")]
        known = {*self.manifest.values(), 0}
        for i in range(self.width * self.height):
            shares = [share[i] for _, share in self.pairs]
            assert all(a >= b >= 0 for a, b in zip(shares, shares[1:])), f"ranks of pixel {i}: {shares}"
            assert sum(shares) < 1 + 1e-5 and (shares[-1] > 0 or sum(shares) > 1 - 1e-5), f"sum of pixel {i}: {shares}"
            for ids, share in self.pairs:
                assert ids[i] in known and (ids[i] != 0) == (share[i] > 0), f"pixel {i}: {ids[i]:08x}, {share[i]}"

    def share(self, name, i):
        return sum(share[i] for ids, share in self.pairs if ids[i] == self.manifest[name])


def main():
    mattes = Mattes(sys.argv[1])
    if len(sys.argv) > 2 and sys.argv[2] == "--crop-of":
        other, x, y = Mattes(sys.argv[3]), *map(int, sys.argv[4:6])
        for row in range(mattes.height):
            own, start = row * mattes.width, (y + row) * other.width + x
            for (a, s), (b, t) in zip(mattes.pairs, other.pairs):
                assert a[own : own + mattes.width] == b[start : start + mattes.width] and s[own : own + mattes.width] == t[start : start + mattes.width], f"row {row}"
    elif len(sys.argv) == 5:
        print(mattes.share(sys.argv[2], int(sys.argv[4]) * mattes.width + int(sys.argv[3])))
    elif len(sys.argv) == 3:
        count = mattes.width * mattes.height
        print(sum(mattes.share(sys.argv[2], i) for i in range(count)) / count)


if __name__ == "__main__":
    main()
