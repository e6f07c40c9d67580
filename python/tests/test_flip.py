# SPDX-License-Identifier: MIT
"""FLIP and HDR-FLIP once more, written from the papers' equations in double precision with filters of two dimensions, against the library on pairs of pictures.

MANGATA_FLIP_PICTURES=FOLDER names a folder with the pictures that the papers' program is published with (reference.png, test.png, reference.exr, test.exr); their published means are then
held as well. No Debian package has them."""
import os
import subprocess

import numpy as np
import pytest

import mangata

SOURCE = os.path.join(os.path.dirname(__file__), "..", "..")
PIXELS_PER_DEGREE = np.pi / 180 * 0.7 * 3840 / 0.7
PRIMARIES = np.array([[0.64, 0.30, 0.15], [0.33, 0.60, 0.06], [0.03, 0.10, 0.79]])
WHITE = np.array([0.31271, 0.32902, 0.35827]) / 0.32902
TO_XYZ = PRIMARIES * np.linalg.solve(PRIMARIES, WHITE)


def decoded(values):
    return np.where(values > 0.04045, ((values + 0.055) / 1.055) ** 2.4, values / 12.92)


def filtered(plane, kernel):
    radius = kernel.shape[0] // 2
    padded, out = np.pad(plane, radius, mode="edge"), np.zeros_like(plane)
    for (y, x), weight in np.ndenumerate(kernel):
        out += weight * padded[y : y + plane.shape[0], x : x + plane.shape[1]]
    return out


def sensitivity(terms):
    """Eqs. 3 and 4 of the paper of 2020: a sum of a √(π/b) exp(−π² d²/b)."""
    radius = int(np.ceil(3 * np.sqrt(0.04 / (2 * np.pi**2)) * PIXELS_PER_DEGREE))
    y, x = np.mgrid[-radius : radius + 1, -radius : radius + 1] / PIXELS_PER_DEGREE
    kernel = sum(a * np.sqrt(np.pi / b) * np.exp(-(np.pi**2) * (x * x + y * y) / b) for a, b in terms)
    return kernel / kernel.sum()


def lab(xyz):
    t = xyz / WHITE
    f = np.where(t > (6 / 29) ** 3, np.cbrt(t), t / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], -1)


def hunt(color):
    return np.stack([color[..., 0], 0.01 * color[..., 0] * color[..., 1], 0.01 * color[..., 0] * color[..., 2]], -1)


def hyab(a, b):
    return np.abs(a[..., 0] - b[..., 0]) + np.hypot(a[..., 1] - b[..., 1], a[..., 2] - b[..., 2])


def seen(light):
    relative = light @ TO_XYZ.T / WHITE
    opponent = [116 * relative[..., 1] - 16, 500 * (relative[..., 0] - relative[..., 1]), 200 * (relative[..., 1] - relative[..., 2])]
    terms = [[(1, 0.0047)], [(1, 0.0053)], [(34.1, 0.04), (13.5, 0.025)]]
    y, cx, cz = (filtered(plane, sensitivity(t)) for plane, t in zip(opponent, terms))
    y = (y + 16) / 116
    xyz = np.stack([y + cx / 500, y, y - cz / 200], -1) * WHITE
    color = hunt(lab(np.clip(xyz @ np.linalg.inv(TO_XYZ).T, 0, 1) @ TO_XYZ.T))
    deviation = 0.5 * 0.082 * PIXELS_PER_DEGREE
    radius = int(np.ceil(3 * deviation))
    dy, dx = np.mgrid[-radius : radius + 1, -radius : radius + 1]
    gaussian = np.exp(-(dx * dx + dy * dy) / (2 * deviation**2))
    features = []
    for kernel in (-dx * gaussian, (dx * dx / deviation**2 - 1) * gaussian):
        kernel = np.where(kernel > 0, kernel / kernel[kernel > 0].sum(), kernel / -kernel[kernel < 0].sum())
        features.append(np.hypot(filtered((opponent[0] + 16) / 116, kernel), filtered((opponent[0] + 16) / 116, kernel.T)))
    return color, features


def flip_map(a, b):
    """Of linear light, 0 to 1."""
    (color_a, features_a), (color_b, features_b) = seen(a), seen(b)
    greatest = hyab(*(hunt(lab(np.array(primary) @ TO_XYZ.T)) for primary in ([0, 1.0, 0], [0, 0, 1.0]))) ** 0.7
    color, knee = hyab(color_a, color_b) ** 0.7, 0.4 * greatest
    color = np.where(color < knee, 0.95 / knee * color, 0.95 + (color - knee) / (greatest - knee) * 0.05)
    feature = np.sqrt(np.maximum(*(np.abs(p - q) for p, q in zip(features_a, features_b))) / np.sqrt(2))
    return color ** (1 - feature)


def tone_mapped(light, stops):
    x = 2.0**stops * np.maximum(light, 0)
    return np.clip(0.6 * x * (2.51 * 0.6 * x + 0.03) / (0.6 * x * (2.43 * 0.6 * x + 0.59) + 0.14), 0, 1)


def hdr_flip(a, b):
    """The paper of 2021, B being the reference."""
    target = (lambda p: np.max(np.roots(p)))([0.36 * (2.51 - 0.85 * 2.43), 0.6 * (0.03 - 0.85 * 0.59), -0.85 * 0.14])
    luminance = b @ [0.2126, 0.7152, 0.0722]
    first, last = np.log2(target / luminance.max()), np.log2(target / np.median(luminance))
    exposures = np.linspace(first, last, max(2, int(np.ceil(last - first))))
    return np.max([flip_map(tone_mapped(a, e), tone_mapped(b, e)) for e in exposures], axis=0)


@pytest.fixture(scope="module", params=["sunset", "moonlit"])
def pair(request, tmp_path_factory):
    """A method without anti-aliasing, and one that has it, as pictures and as light."""
    folder = tmp_path_factory.mktemp(request.param)
    for method in ("none", "mangata"):
        for kind in ("png", "exr"):
            subprocess.run([os.environ["MANGATA"], "render", os.path.join(SOURCE, "scenes", f"{request.param}.json"), "-o", folder / f"{method}.{kind}", "--method", method, "--frames", "0",
                            "--size", "96x54", "--quiet"], check=True)
    return folder


def test_means_are_those_of_the_equations(pair):
    shown, light = ([mangata.read(pair / f"{method}.{kind}") for method in ("none", "mangata")] for kind in ("png", "exr"))
    expected = flip_map(*(decoded(p.astype(float)) for p in shown))
    assert expected.mean() > 0.01
    assert mangata.metrics(*shown, "flip", encoding="srgb")["flip"] == pytest.approx(expected.mean(), abs=2e-6)
    assert mangata.error_map(*shown, "flip", encoding="srgb") == pytest.approx(expected, abs=2e-3)
    assert mangata.metrics(*light, "hdr-flip")["hdr-flip"] == pytest.approx(hdr_flip(*(p.astype(float) for p in light)).mean(), abs=5e-6)


def test_the_default_distance_is_the_papers():
    rng = np.random.default_rng(5)
    a, b = rng.random((2, 24, 32, 3), np.float32)
    standing = mangata.metrics(a, b, "flip")["flip"]
    assert standing == mangata.metrics(a, b, "flip", pixels_per_degree=PIXELS_PER_DEGREE)["flip"] != mangata.metrics(a, b, "flip", pixels_per_degree=67)["flip"]
    assert PIXELS_PER_DEGREE == pytest.approx(67.0206, abs=5e-5)


@pytest.mark.skipif("MANGATA_FLIP_PICTURES" not in os.environ, reason="the papers' pictures are in no package")
def test_published_means():
    folder = os.environ["MANGATA_FLIP_PICTURES"]
    shown, light = ([mangata.read(os.path.join(folder, f"{name}.{kind}")) for name in ("test", "reference")] for kind in ("png", "exr"))
    assert mangata.metrics(*shown, "flip", encoding="srgb")["flip"] == pytest.approx(0.159691, abs=1e-6)
    assert mangata.metrics(*light, "hdr-flip")["hdr-flip"] == pytest.approx(0.283478, abs=1e-6)
