# SPDX-License-Identifier: MIT
"""The package against the command, against numpy, and with bad input."""
import copy
import gc
import inspect
import os
import pickle
import signal
import subprocess
import threading
import time
import typing

import numpy as np
import pytest

import mangata

SOURCE = os.path.join(os.path.dirname(__file__), "..", "..")
SIMPLE = os.path.join(SOURCE, "scenes", "simple.json")
SMALL = (64, 36)


@pytest.fixture(scope="module")
def scene():
    return mangata.load(SIMPLE)


def command(*words):
    subprocess.run([os.environ["MANGATA"], *map(str, words), "--quiet"], check=True)


# ---- scenes ----


def test_scene_as_file_text_and_dictionary_are_one(scene):
    import json

    with open(SIMPLE) as f:
        text = f.read()
    for other in (mangata.Scene(text), mangata.Scene(json.loads(text)), scene.changed({})):
        assert other.frames == scene.frames and other.size == scene.size and other.fps == scene.fps
        assert np.array_equal(other.waves(), scene.waves())
    assert scene.waves().shape[1] == 5


def test_examples_of_the_docstring_are_legal():
    examples = [line.strip().split("  ")[0] for line in mangata.Scene.__doc__.splitlines() if line.strip().startswith("Scene(")]
    assert len(examples) == 3
    for example in examples:
        assert len(eval(example, {"Scene": mangata.Scene}).waves()) > 0, example


def test_changes_take_numbers_lists_and_arrays(scene):
    other = scene.changed({"camera.position": np.array([0.0, 9.0, 0.0]), "light.elevation_deg": np.float64(33), "image.width": 10})
    view = other.frame(0)
    assert view.camera.position[1] == 9 and view.light.elevation_deg == 33 and other.size[0] == 10
    assert scene.frame(0).camera.position[1] != 9


def test_the_last_change_counts():
    base = mangata.Scene({"water": {"wind": 9}})
    waves = [{"amplitude": 0.5, "a": 0.3, "b": 0.4, "c": -1}, {"amplitude": 0.25, "a": 0.1, "b": 0.4, "c": -1}]
    assert len(base.changed({"water.wind": 5}).changed({"water": {"waves": waves}}).waves()) == 2
    assert len(base.changed({"water": {"waves": waves}}).changed({"water": {"waves": waves[:1]}}).waves()) == 1
    one = base.changed({"water": {"waves": waves[:1]}}).changed({"water.waves[0]": waves[0]}).changed({"water.waves[1]": waves[1]})
    assert one.changed({"water.waves[0].amplitude": 0.125}).waves()[:, 0].tolist() == [0.125, 0.25]
    assert one.changed({"water.waves[0]": waves[1]}).waves()[:, 0].tolist() == [0.25, 0.25]
    again = base.changed({"light.elevation_deg": 3}).changed({"light": {"azimuth_deg": 5}}).changed({"light.elevation_deg": 7})
    assert again.frame().light.elevation_deg == 7 and again.frame().light.azimuth_deg == 5


def test_scenes_stay_what_they_are(scene, tmp_path, monkeypatch):
    path = tmp_path / "a.yaml"
    path.write_text("mangata: 1\nlight: {elevation_deg: 3}\n")
    monkeypatch.chdir(tmp_path)
    loaded, place = mangata.load("a.yaml"), np.array([0.0, 4.0, 0.0])
    moved = loaded.changed({"camera.position": place})
    path.write_text("mangata: 1\nlight: {elevation_deg: 9}\n")
    place[1] = 8
    monkeypatch.chdir("/")
    path.unlink()
    assert loaded.changed({"image.width": 9}).frame().light.elevation_deg == 3
    view = moved.changed({"image.width": 9}).frame()
    assert view.light.elevation_deg == 3 and view.camera.position[1] == 4
    assert mangata.render(loaded, size=SMALL)["color"].shape == (36, 64, 3)
    # numpy prints eight digits, and not every item of a long array: neither tells what a picture shows.
    for height in (4, 4 + 1e-9, 4 + 1e-3):
        mangata.render(scene, size=(4, 2), changes={"camera.position": np.array([0, height, 0])})
        assert scene._last_change[1].frame().camera.position[1] == height


def test_scenes_are_copied_and_pickled(scene):
    for original in (scene, scene.changed({"light.elevation_deg": 3}), mangata.sea(wind=9), mangata.Scene({"description": "🌊 ü", "water": {"wind": 9}})):
        for same in (copy.copy(original), copy.deepcopy(original), pickle.loads(pickle.dumps(original))):
            assert np.array_equal(same.waves(), original.waves()) and repr(same) == repr(original)
            assert same.frame().light.elevation_deg == original.frame().light.elevation_deg
    with pytest.raises(mangata.SceneError) as caught:
        mangata.Scene("mangata: 2")
    assert vars(pickle.loads(pickle.dumps(caught.value))) == vars(caught.value)


def test_scenes_take_paths(tmp_path):
    corners = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
    (tmp_path / "a.ply").write_text(f"ply\nformat ascii 1.0\n{corners}end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    found = mangata.Scene({"objects": [{"mesh": tmp_path / "a.ply"}]})
    assert found.frame().object_count == 1


def test_options_that_the_method_does_not_read_are_refused(scene):
    for method, option in (("mangata", {"spatial": 3}), ("none", {"time_samples": 1}), ("podee-pixel", {"samples": 4}), (None, {"kernels": "9"}), ("adaptive", {"slots": 9})):
        with pytest.raises(mangata.SceneError, match=rf"^{next(iter(option))}: it is for .*method .* alone$"):
            mangata.render(scene, method, size=SMALL, **option)
    with pytest.raises(ValueError, match="spatial: write the number into ssaaN"):
        mangata.render(scene, "ssaa2", size=SMALL, spatial=3)
    with pytest.raises(mangata.SceneError, match="unknown key"):
        mangata.render(scene, "mangata", size=SMALL, colour=3)
    mangata.render(scene, "ssaa", size=SMALL, spatial=1, seed=2)
    mangata.render(scene, "mangata", size=SMALL, changes={"quality.spatial": 3})


def test_errors_carry_file_line_and_column(tmp_path):
    path = tmp_path / "bad: name.yaml"
    path.write_text("mangata: 1\nlight:\n  elevation_deg: 300\n")
    with pytest.raises(mangata.SceneError) as caught:
        mangata.load(path)
    error = caught.value
    assert (error.file, error.line, error.column) == (str(path), 3, 18)
    assert "allowed" in error.reason and str(path) not in error.reason and str(error).startswith(f"{path}:3:18: ")
    assert isinstance(error, ValueError)


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: mangata.Scene(""),
        lambda: mangata.Scene("mangata: 1\nsky: {model: green}"),
        lambda: mangata.Scene({"water": {"wind": float("nan")}}),
        lambda: mangata.Scene({"no": 1}),
        lambda: mangata.sea(wind=-1),
        lambda: mangata.sea(breeze=3),
        lambda: mangata.load(SIMPLE, {"light": 3}),
        lambda: mangata.load(SIMPLE, {"": 3}),
        lambda: mangata.load(SIMPLE).frame(-1),
    ],
)
def test_bad_scenes_are_scene_errors(wrong):
    with pytest.raises(mangata.SceneError):
        wrong()


def test_names_end_where_they_end(tmp_path):
    # A NUL would end a name of C early: another file, another value.
    for wrong in (lambda: mangata.load(str(SIMPLE) + "\0.yaml"), lambda: mangata.load(SIMPLE, {"light.elevation_deg=3 #\0": 1}), lambda: mangata.sea(wind="9\0"), lambda: mangata.read("a\0.png"), lambda: mangata.Scene("mangata: 1", name="a\0b")):
        with pytest.raises(ValueError, match="null"):
            wrong()
    odd = os.fsdecode(os.fsencode(tmp_path) + b"/\xff.yaml")
    with open(odd, "w", encoding="ascii") as out:
        out.write("mangata: 1\ntime: {frames: 7}\n")
    assert mangata.load(odd).frames == 7


def test_arrays_of_all_kinds(scene):
    for answer in ({"points": np.zeros((4, 3))}, {"points": np.zeros(())}, {"points": [["a", "b"]]}, {"points": np.zeros((4, 2)), "answers": ["depth"]}, {"points": np.zeros((4, 2)), "least_wavelength": float("nan")}, {"points": np.zeros((4, 2)), "time": float("inf")}):
        with pytest.raises((ValueError, mangata.MangataError)):
            mangata.query(scene, **answer)
    points = np.random.default_rng(1).uniform(-9, 9, (6, 4))
    wanted = mangata.query(scene, np.ascontiguousarray(points[:, ::2]))["height"]
    for same in (points[:, ::2], np.asfortranarray(points[:, ::2]), points[:, ::2].astype(">f8"), points[:, ::2].tolist()):
        assert np.array_equal(mangata.query(scene, same)["height"], wanted)
    assert np.isnan(mangata.query(scene, [[np.nan, 0], [np.inf, 0]])["height"]).all() and mangata.query(scene, np.zeros((0, 2)))["height"].shape == (0,)
    with pytest.raises(ValueError):
        mangata.trace(scene, np.zeros((2, 3)), np.zeros((3, 3)))


def test_missing_file_is_missing():
    with pytest.raises(FileNotFoundError, match="^/nowhere/scene.yaml: "):
        mangata.load("/nowhere/scene.yaml")
    with pytest.raises(FileNotFoundError, match="^/nowhere/picture.exr: "):
        mangata.read("/nowhere/picture.exr")


def test_errors_without_a_place(tmp_path):
    path = tmp_path / "bad.png"
    path.write_text("no picture")
    with pytest.raises(mangata.SceneError) as caught:
        mangata.read(path)
    assert (caught.value.file, caught.value.line) == (str(path), None) and str(caught.value) == f"{path}: {caught.value.reason}"
    with pytest.raises(mangata.SceneError, match='^change light.elevation_deg="high": ') as caught:
        mangata.load(SIMPLE, {"light.elevation_deg": "high"})
    assert caught.value.file is None


# ---- rendering ----


@pytest.mark.parametrize("method, words", [("mangata", []), ("podee-pixel", []), ("ssaa3", ["--seed", 5]), ("adaptive", ["--samples", 4])])
def test_pixels_are_those_of_the_command(scene, tmp_path, method, words):
    options = {words[0][2:]: words[1]} if words else {}
    layers = ["color", "coverage", "mask", "depth", "normal"]
    command("render", SIMPLE, "-o", tmp_path / "a.exr", "--size", "64x36", "--frames", 7, "--method", method, *words, *sum((["--layer", layer] for layer in layers), []))
    ours = mangata.render(scene, method, layers, 7, size=SMALL, **options)
    assert list(ours) == layers
    for layer in layers:
        assert np.array_equal(ours[layer], mangata.read(tmp_path / "a.exr", layer)), layer


@pytest.mark.parametrize("method, options, samples", [
    (None, {}, 12), ("ssaa", {}, 16), ("ssaa2", {}, 4), ("ssaa", {"spatial": 3}, 9),
    ("ssaa", {"time_samples": 2}, 32), ("reference", {"spatial": 1}, 8), ("mangata", {}, 1), (None, {"spatial": 1}, 3)])
def test_samples_of_a_scene_are_those_of_the_command(tmp_path, method, options, samples):
    path = tmp_path / "own.yaml"
    path.write_text("mangata: 1\nwater: {wind: 6}\nquality: {method: ssaa, spatial: 2, time_samples: 3, seed: 5}\n")
    words = (["--method", method] if method else []) + [f"--{key.replace('_', '-')}={value}" for key, value in options.items()]
    command("render", path, "-o", tmp_path / "a.exr", "--size", "16x9", "--layer", "coverage", "--layer", "color", "--layer", "samples", *words)
    ours = mangata.render(path, method, ["coverage", "color", "samples"], size=(16, 9), **options)
    assert (ours["samples"] == samples).all()
    for layer in ours:
        assert np.array_equal(ours[layer], mangata.read(tmp_path / "a.exr", layer)), layer


def test_display_crop_and_threads(scene, tmp_path):
    command("render", SIMPLE, "-o", tmp_path / "a.png", "--size", "64x36")
    whole = mangata.render(scene, layers=["display"], size=SMALL)["display"]
    assert np.array_equal(whole[..., :3] / np.float32(255), mangata.read(tmp_path / "a.png"))
    part = mangata.render(scene, layers=["coverage"], size=SMALL, crop=(8, 4, 20, 10), threads=1)["coverage"]
    all_of_it = mangata.render(scene, layers=["coverage"], size=SMALL, threads=2)["coverage"]
    assert np.array_equal(part, all_of_it[4:14, 8:28])


def test_renders_into_arrays_of_the_caller(scene):
    film = np.zeros((3, 36, 64), np.float32)
    for frame in range(3):
        out = mangata.render(scene, layers=["coverage"], frame=frame, size=SMALL, out={"coverage": film[frame]})
        assert out["coverage"].base is film
    assert film.any(axis=(1, 2)).all()
    wide = np.zeros((36, 100), np.float32)
    mangata.render(scene, layers=["coverage"], size=SMALL, out={"coverage": wide[:, :64]})
    assert np.array_equal(wide[:, :64], film[0]) and not wide[:, 64:].any()
    up = np.zeros((36, 64), np.float32)
    mangata.render(scene, layers=["coverage"], size=SMALL, out={"coverage": up[::-1]})
    assert np.array_equal(up[::-1], film[0])
    for bad in (np.zeros((36, 64)), np.zeros((36, 63), np.float32), np.zeros((36, 128), np.float32)[:, ::2], [[0.0]]):
        with pytest.raises(ValueError):
            mangata.render(scene, layers=["coverage"], size=SMALL, out={"coverage": bad})


def test_arguments_that_would_do_nothing_are_refused(scene):
    with pytest.raises(ValueError, match="out: layer 'mask' is not among the layers that are rendered, color"):
        mangata.render(scene, size=SMALL, out={"mask": np.zeros((36, 64), np.float32)})
    for size in ((64.5, 36), (64,), (64, 36, 3)):
        with pytest.raises(ValueError, match="two whole numbers"):
            mangata.render(scene, size=size)
    assert mangata.render(scene, layers=["mask"], size=(np.float64(64), np.int64(36)))["mask"].shape == (36, 64)
    with pytest.raises(ValueError, match="points has masked values"):
        mangata.query(scene, np.ma.masked_array(np.zeros((2, 2)), [[0, 1], [0, 0]]))


def test_bad_arguments(scene):
    for arguments in ({"layers": ["light"]}, {"crop": (60, 0, 10, 10)}, {"crop": (0, 0, 100, 1)}, {"backend": "vulkan"}, {"isa": "mmx"}, {"method": "nope"}, {"spatial": 0, "method": "reference"}):
        with pytest.raises((ValueError, mangata.MangataError)):
            mangata.render(scene, size=SMALL, **arguments)


def test_numbers_that_c_does_not_hold(scene):
    for threads in (-1, 1025, 2**32, 2**80):
        for ask in (lambda: mangata.Context(threads=threads), lambda: mangata.render(scene, size=SMALL, threads=threads)):
            with pytest.raises(ValueError, match=f"threads {threads}: allowed is 0"):
                ask()
    for crop in ((-1, 0, 4, 4), (0, 0, 2**32, 4), (0, -(2**70), 4, 4)):
        with pytest.raises(ValueError, match="lies outside the picture of 64 x 36"):
            mangata.render(scene, size=SMALL, crop=crop)


def test_progress_and_cancel(scene):
    seen = []
    mangata.render(scene, "reference", size=(320, 180), progress=seen.append)
    assert seen and seen == sorted(seen) and 0 <= seen[0] and seen[-1] <= 1
    with pytest.raises(mangata.Cancelled):
        mangata.render(scene, "reference", size=(320, 180), progress=lambda share: False)

    def fail(share):
        raise KeyError("stop")

    with pytest.raises(KeyError):
        mangata.render(scene, "reference", size=(320, 180), progress=fail)
    assert mangata.render(scene, size=SMALL)["color"].shape == (36, 64, 3)


def test_progress_may_answer_with_numpy(scene):
    with pytest.raises(mangata.Cancelled):
        mangata.render(scene, "ssaa16", size=(320, 180), progress=lambda share: np.float64(share) < 0)


def test_progress_that_renders_with_its_own_context(scene):
    inner = []
    with pytest.raises(RuntimeError, match="uses the context that has called it"):
        mangata.render(scene, "ssaa16", size=(320, 180), progress=lambda share: mangata.render(scene, size=SMALL) and None)
    with mangata.Context() as other:
        mangata.render(scene, "ssaa16", size=(320, 180), progress=lambda share: inner.append(mangata.render(scene, size=(8, 4), context=other)))
    assert inner


def test_ctrl_c_ends_a_long_render(scene):
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored where the tests run in the background
    try:
        threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            mangata.render(scene, "reference", size=(640, 360), spatial=64, time_samples=64)
    finally:
        signal.signal(signal.SIGINT, before)
    assert mangata.render(scene, size=SMALL)["color"].shape == (36, 64, 3)


def test_contexts_end(scene):
    def threads():
        return len(os.listdir("/proc/self/task"))

    def all_ended():
        # a thread that was joined may stay in the list for a moment
        end = time.monotonic() + 10
        while threads() > before and time.monotonic() < end:
            time.sleep(0.01)
        return threads() <= before

    mangata.render(scene, size=SMALL)
    before = threads()
    gc.disable()
    try:
        for _ in range(4):
            mangata.Context(threads=3)
        assert all_ended()
    finally:
        gc.enable()
    with mangata.Context(threads=3) as context:
        assert mangata.render(scene, size=SMALL, context=context)["color"].shape == (36, 64, 3)
        assert threads() > before
    assert all_ended()
    context.close()
    with pytest.raises(ValueError, match="the context is closed"):
        mangata.render(scene, size=SMALL, context=context)


def test_renders_in_a_forked_process(scene):
    context = mangata.Context(threads=2)
    wanted = mangata.render(scene, size=SMALL, context=context)["color"]
    mangata.render(scene, size=SMALL)
    child = os.fork()
    if not child:
        signal.alarm(60)
        same = all(np.array_equal(mangata.render(scene, size=SMALL, context=which)["color"], wanted) for which in (context, None))
        context.close()
        os._exit(0 if same else 1)
    assert os.waitpid(child, 0)[1] == 0
    assert np.array_equal(mangata.render(scene, size=SMALL, context=context)["color"], wanted)


def test_many_renders_take_no_memory(scene):
    def memory():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def draw():
        for frame in range(250):
            mangata.render(scene, layers=["color", "coverage"], frame=frame % 60, size=(32, 18), changes={"light.elevation_deg": frame % 7})

    draw()
    before = memory()
    draw()
    assert memory() < before + 2**22


def test_threads_of_python(scene):
    pictures = {}

    def draw(frame):
        pictures[frame] = mangata.render(scene, layers=["coverage"], frame=frame, size=SMALL)["coverage"]

    workers = [threading.Thread(target=draw, args=(frame,)) for frame in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    for frame in range(4):
        assert np.array_equal(pictures[frame], mangata.render(scene, layers=["coverage"], frame=frame, size=SMALL)["coverage"])


def test_scene_with_objects():
    pool = mangata.load(os.path.join(SOURCE, "scenes", "pool.yaml"))
    assert np.isfinite(mangata.render(pool, size=SMALL)["color"]).all()


# ---- water ----


def test_query_is_the_sum_of_sines(scene):
    rng = np.random.default_rng(1)
    points = rng.uniform(-20, 20, (5, 7, 2))
    amplitude, kx, kz, omega, phase = scene.waves().T
    time = 3.25
    angles = points[..., :1] * kx + points[..., 1:] * kz + omega * time + phase
    answer = mangata.query(scene, points, time, ["height", "normal", "velocity", "jacobian"], exact=True)
    assert np.allclose(answer["height"], (amplitude * np.sin(angles)).sum(-1) + scene.frame().water.level, atol=1e-9)
    slope = np.stack([-(amplitude * kx * np.cos(angles)).sum(-1), np.ones(angles.shape[:-1]), -(amplitude * kz * np.cos(angles)).sum(-1)], -1)
    assert np.allclose(answer["normal"], slope / np.linalg.norm(slope, axis=-1, keepdims=True), atol=1e-5)
    assert np.allclose(answer["velocity"][..., 1], (amplitude * omega * np.cos(angles)).sum(-1), atol=1e-4)
    assert answer["jacobian"].shape == (5, 7) and answer["covariance"].shape == (3,)
    with pytest.raises(ValueError):
        mangata.query(scene, [1, 2, 3])
    with pytest.raises(ValueError):
        mangata.query(scene, [1, 2], answers=["depth"])


def test_query_knows_foam():
    windy = mangata.sea(wind=16, count=64)
    points = np.random.default_rng(2).uniform(-500, 500, (20000, 2))
    foam = mangata.query(windy, points, 1.5, ["foam"])["foam"]
    assert foam.min() >= 0 and foam.max() <= 1 and foam.max() > 0.5
    assert abs(foam.mean() / windy.frame().foam - 1) < 0.25
    assert not mangata.query(windy.changed({"water.foam.amount": 0}), points[:100], 1.5, ["foam"])["foam"].any()


def test_trace_ends_on_the_water(scene):
    origins = np.array([[x, 4.0, 0.0] for x in range(-3, 4)])
    direction = np.array([0.1, -1.0, 0.3])
    hits = origins + mangata.trace(scene, origins, direction, time=1)[:, None] * direction
    assert np.allclose(mangata.query(scene, hits[:, [0, 2]], 1, ["height"], exact=True)["height"], hits[:, 1], atol=1e-6)
    assert np.isinf(mangata.trace(scene, [0, 4, 0], [0, 1, 0]))


def test_waves_and_answers_outlive_the_frame():
    sea = mangata.sea(wind=12)
    waves, churn = sea.waves(), []
    for _ in range(50):
        churn.append(bytes(range(256)) * 8)  # takes what was freed
        assert np.array_equal(sea.waves(), waves) and np.all(waves[:, 0] > 0)
        assert sea.size == (1280, 720)
    document = {"water": {"waves": [{"amplitude": 0.5, "a": 0.3, "b": 0.4, "c": -1}]}}
    kept = mangata.Scene(document)
    for _ in range(50):
        churn.append(bytes(range(256)) * 8)
        assert np.array_equal(mangata.query(document, [[1.0, 2.0]])["height"], mangata.query(kept, [[1.0, 2.0]])["height"])
        assert np.array_equal(mangata.trace(document, [0, 4, 0], [0, -1, 0.1]), mangata.trace(kept, [0, 4, 0], [0, -1, 0.1]))


def test_sea():
    sea = mangata.sea(wind=12, count=50, changes={"light.elevation_deg": 6})
    assert len(sea.waves()) == 50 and sea.frame().light.elevation_deg == 6
    assert mangata.render(sea, size=SMALL)["color"].mean() > 0
    with pytest.raises(mangata.SceneError, match="swell_period is given, but no swell"):
        mangata.sea(wind=12, swell_period=9)


# ---- metrics ----


def test_metrics_on_arrays():
    rng = np.random.default_rng(2)
    a, b = rng.random((2, 20, 30), np.float32)
    scores = mangata.metrics(a, b, "rmse,relrmse,energy,flip")
    assert scores["rmse"] == pytest.approx(np.sqrt(np.mean((a.astype(float) - b) ** 2)))
    assert scores["energy"] == pytest.approx(a.mean(dtype=float) / b.mean(dtype=float))
    assert 0 < scores["flip"] < 1
    assert mangata.metrics(a, a)["flip"] == 0 and mangata.metrics(a, a)["ssim"] == pytest.approx(1)
    clip = rng.random((2, 4, 20, 30, 3), np.float32)
    assert mangata.metrics(*clip, "rmse,flicker", clip=True)["flicker"] > 0
    assert mangata.error_map(a, b, "rmse") == pytest.approx(np.abs(a - b), abs=1e-6)
    floor = 0.01**2 * np.mean(b.astype(float) ** 2)
    assert mangata.error_map(a, b, "relrmse") == pytest.approx(np.abs(a - b) / np.sqrt(b.astype(float) ** 2 + floor), rel=1e-5, abs=1e-6)
    assert mangata.error_map(a, b).mean() == pytest.approx(scores["flip"], rel=1e-4)
    for bad in (lambda: mangata.metrics(a, b[1:]), lambda: mangata.metrics(a, b, "beauty"), lambda: mangata.metrics(a[0], b[0]), lambda: mangata.error_map(a, b, "energy"),
                lambda: mangata.metrics(a, b, encoding="pq")):
        with pytest.raises(ValueError):
            bad()


def test_whole_numbers_are_fractions_as_in_png(scene, tmp_path):
    shown = [mangata.render(scene, method, layers=["display"], size=SMALL)["display"] for method in ("none", "mangata")]
    floats = [picture[..., :3] / np.float32(255) for picture in shown]
    wanted = mangata.metrics(*floats, "rmse,flip,ssim", encoding="srgb")
    assert 0 < wanted["rmse"] < 1 and 0 < wanted["flip"] < 1 and wanted["ssim"] < 1
    assert mangata.metrics(*shown, "rmse,flip,ssim") == wanted == mangata.metrics(*(picture[..., :3] for picture in shown), "rmse,flip,ssim", encoding="srgb")
    assert np.array_equal(mangata.error_map(*shown), mangata.error_map(*floats, encoding="srgb"))
    deep = [picture.astype(np.uint16) * 257 for picture in (shown[0][..., 0], shown[1][..., 0])]
    assert mangata.metrics(*deep, "rmse") == pytest.approx(mangata.metrics(*(picture[..., 0] for picture in floats), "rmse"), rel=1e-6)
    linear = mangata.metrics(*floats, "flip")
    assert mangata.metrics(*shown, "flip", encoding="linear") == linear != mangata.metrics(*shown, "flip")
    assert mangata.metrics(shown[0], floats[1], "flip", encoding="srgb")["flip"] == wanted["flip"]
    for wrong, words in (
        (lambda: mangata.metrics(shown[0], floats[1]), "one picture holds whole numbers"),
        (lambda: mangata.metrics(shown[0][..., :3].astype(int), floats[1]), "a picture of int64"),
    ):
        with pytest.raises(ValueError, match=words):
            wrong()


def test_arrays_that_have_no_scores():
    a = np.random.default_rng(5).random((20, 30), np.float32)
    for bad, words in (
        (np.ma.masked_less(a, 0.5), "masked pixels"),
        (a.astype(float) * 1e300, "beyond those of float32"),
        (a * 1j, "a picture of complex64"),
        (a.astype(object), "a picture of object"),
        (np.full(a.shape, "1"), "a picture of <U1"),
        ((row for row in a), "a picture of object"),
        (np.zeros((20, 30, 4)), "has the shape"),
    ):
        for pair in ((bad, a), (a, bad)):
            with pytest.raises(ValueError, match=words):
                mangata.metrics(*pair, "rmse")
    with pytest.raises(ValueError, match="a clip has no frame"):
        mangata.metrics(np.zeros((0, 4, 4)), np.zeros((0, 4, 4)), clip=True)
    for words in ("", [], "rmse,", "beauty"):
        with pytest.raises(ValueError, match="metric"):
            mangata.metrics(a, a, words)
    wanted = mangata.metrics(a, a[::-1], "rmse,flip")
    kinds = (np.asfortranarray(a), a.astype(float), a.astype(">f4"), np.ma.masked_array(a, np.zeros(a.shape, bool)), np.repeat(a, 2, 1)[:, ::2], a.tolist())
    for same in kinds:
        assert mangata.metrics(same, a[::-1], "rmse, flip") == wanted
    assert mangata.metrics(a.astype(np.float16), a, "rmse")["rmse"] < 1e-3 and mangata.metrics(a > 0.5, a > 0.5, ["rmse"]) == {"rmse": 0}


def test_flicker_stands_for_all_of_its_kinds(scene):
    kinds = [name for name in mangata.metric_names() if name.startswith("flicker")]
    clip = np.random.default_rng(2).random((2, 4, 20, 30), np.float32)
    assert len(kinds) == 6 and list(mangata.metrics(*clip, "flicker", clip=True)) == kinds
    assert list(mangata.metrics(*clip, "flicker-power", clip=True)) == ["flicker-power"]
    rows = mangata.compare(scene, ["none"], metrics="flicker", frames=[0, 1], size=(16, 9), reference={"spatial": 1, "time_samples": 1})
    assert [name for name in rows[0] if name not in ("scene", "method")] == kinds


def test_broken_pictures_have_no_scores():
    b = np.random.default_rng(3).random((20, 30, 3), np.float32)
    for value, rows in ((np.nan, 20), (np.nan, 10), (np.inf, 1), (-np.inf, 1)):
        a = b.copy()
        a[:rows] = value
        for pair in ((a, b), (b, a)):
            scores = mangata.metrics(*pair)
            assert list(scores) == mangata.metric_names() and np.isnan(list(scores.values())).all()
            assert np.isnan(list(mangata.metrics(*pair, "rmse,energy,flip,ssim").values())).all()
            broken = np.isnan(mangata.error_map(*pair, "rmse"))
            assert broken[:rows].all() and not broken[rows:].any()
    b[0, 0] = np.inf
    assert mangata.metrics(b, b, "rmse") == {"rmse": 0}
def test_maps_are_written_or_refused():
    """By the library itself: what Python's error_map() refuses as well."""
    from mangata._library import ffi, io, text

    mapped = {"rmse", "relrmse", "flip", "hdr-flip", "ssim", "flicker"}
    frames = [np.full((20, 30), value, np.float32) for value in (0.25, 0.5)]
    desc = ffi.new("mgt_metrics_desc *")
    io.mgt_metrics_desc_init(desc, ffi.sizeof("mgt_metrics_desc"))
    desc.width, desc.height, desc.channels = 30, 20, 1
    words = desc.metrics = ffi.new("char[]", b"rmse")
    a, b = (ffi.new("float *[]", [ffi.from_buffer("float[]", frame)]) for frame in frames)
    scores = ffi.new("double[]", 32)
    error = ffi.new("mgt_io_error *")
    io.mgt_io_error_init(error, ffi.sizeof("mgt_io_error"))
    for metric, name in enumerate(mangata.metric_names()):
        scores[0] = -1
        out = np.full((20, 30), np.nan, np.float32)
        status = io.mgt_metrics_measure(desc, a, b, 1, scores, metric, ffi.from_buffer("float[]", out), error)
        if name in mapped:
            assert status == io.MGT_IO_OK and np.isfinite(out).all(), name
        else:
            assert status == io.MGT_IO_ARGUMENT and np.isnan(out).all() and scores[0] == -1, name
            assert text(error.text).startswith(f"metric {name} has no map")
    assert io.mgt_metrics_measure(desc, a, b, 1, scores, 2, ffi.NULL, error) == io.MGT_IO_OK
    del words


def test_frames_beyond_every_scene(scene):
    from mangata._library import ffi, io

    out = ffi.new("mgt_scene *")
    for frame, status in ((0, io.MGT_IO_OK), (2**31 - 1, io.MGT_IO_OK), (2**31, io.MGT_IO_ARGUMENT), (0xFFFFFFFF, io.MGT_IO_ARGUMENT)):
        assert io.mgt_scene_file_frame(scene._file, frame, out, ffi.sizeof("mgt_scene")) == status


def test_metrics_are_those_of_the_command(scene, tmp_path):
    a, b = (mangata.render(scene, method, ["coverage"], size=SMALL)["coverage"] for method in ("none", "mangata"))
    for method, name in (("none", "a"), ("mangata", "b")):
        command("render", SIMPLE, "-o", tmp_path / f"{name}.pfm", "--layer", "coverage", "--method", method, "--size", "64x36")
    import json

    said = json.loads(subprocess.run([os.environ["MANGATA"], "diff", tmp_path / "a.pfm", tmp_path / "b.pfm", "--metrics", "rmse,flip,ssim", "--json"], check=True, capture_output=True).stdout)
    for name, score in mangata.metrics(a, b, "rmse,flip,ssim").items():
        assert said["metrics"][name] == pytest.approx(score, rel=1e-9)


def test_compare_with_a_method_of_ones_own(scene):
    lines = []
    rows = mangata.compare({"simple": scene}, ["none", "mangata"], external={"black": lambda scene, frame: np.zeros((36, 64), np.float32)}, frames=[0, 1], size=SMALL,
                           reference={"spatial": 4, "time_samples": 4}, progress=lines.append)
    assert [row["method"] for row in rows] == ["none", "mangata", "black"] and {row["scene"] for row in rows} == {"simple"}
    errors = {row["method"]: row["rmse"] for row in rows}
    assert errors["mangata"] < errors["none"] and len(lines) == 8
    assert rows[2]["energy"] == 0 and rows[2]["relrmse"] == pytest.approx(1)


TINY = {"size": (16, 9), "reference": {"spatial": 1, "time_samples": 2}, "metrics": "rmse"}


def test_compare_refuses_names_of_methods(scene):
    def black(scene, frame):
        return np.zeros((9, 16))

    for name in ("reference", "none", "ssaa", "ssaa7"):
        with pytest.raises(ValueError, match=f"external '{name}': a method has this name"):
            mangata.compare(scene, ["none"], external={name: black}, **TINY)
    drawn = []
    for wrong, words in (
        ({"external": {"mine": 3}}, "external 'mine': it is no function"),
        ({"external": {"mine": lambda scene, frame: np.zeros((9, 17))}}, "mine, frame 0: the picture has the shape"),
        ({"methods": ["n"]}, "method 'n': allowed is none"),
        ({"layer": "light"}, "layer 'light': allowed is"),
        ({"frames": []}, "no frame is given"),
        ({"metrics": "beauty"}, "metric 'beauty': allowed"),
    ):
        with pytest.raises(ValueError, match=words):
            mangata.compare(scene, **{"methods": ["none"], "progress": drawn.append, **TINY, **wrong})
    with pytest.raises(FileNotFoundError):
        mangata.compare([scene, "/nowhere/scene.yaml"], ["none"], progress=drawn.append, **TINY)
    assert drawn == ["scene0, reference, frame 0", "scene0, none, frame 0", "scene0, mine, frame 0"]
    rows = mangata.compare(scene, ["mine", "none"], external={"mine": black}, **TINY)
    assert [row["method"] for row in rows] == ["mine", "none"]


def test_compare_scores_every_scene(tmp_path):
    paths = []
    for name, height in (("a/x", 0.1), ("b/x", 0.3), ("b/x-2", 0.2)):
        paths.append(tmp_path / f"{name}.yaml")
        paths[-1].parent.mkdir(exist_ok=True)
        paths[-1].write_text(f"mangata: 1\nwater: {{waves: [{{amplitude: {height}, a: 0.3, b: 0.4, c: -1}}]}}\n")
    rows = mangata.compare(paths, "none", layer="color", **TINY)
    assert [row["scene"] for row in rows] == ["x", "x-2", "x-2-2"] and len({row["rmse"] for row in rows}) == 3
    for same in ({"A": str(paths[0]), "B": paths[1]}, {"A": str(paths[0]), "B": str(paths[1])}, {"A": mangata.load(paths[0]), "B": mangata.load(paths[1])}):
        assert mangata.compare(same, ["none"], layer="color", **TINY) == [{**row, "scene": name} for row, name in zip(rows, "AB")]
    document = {"description": "one", "water": {"waves": [{"amplitude": 0.1, "a": 0.3, "b": 0.4, "c": -1}]}}
    assert mangata.compare(document, ["none"], layer="color", **TINY) == [{**rows[0], "scene": "scene"}]
    assert [row["scene"] for row in mangata.compare((path for path in paths[:2]), ["none"], frames=iter([0]), layer="color", **TINY)] == ["x", "x-2"]


def test_compare_draws_the_reference_by_other_rays(scene):
    for seed in (0, 1, 2**64 - 1):
        rows = mangata.compare(scene, ["reference"], changes={"quality.seed": seed}, size=(16, 9), reference={"spatial": 1, "time_samples": 1}, metrics="rmse")
        assert rows[0]["rmse"] > 0, seed


def test_compare_scores_what_is_displayed(scene):
    def mine(scene, frame):
        return mangata.render(scene, "none", "display")["display"]

    rows = mangata.compare(scene, ["none"], layer="display", external={"mine": mine}, **TINY)
    truth, none = (mangata.render(scene, size=(16, 9), layers="display", **words)["display"] for words in
                   ({"method": "reference", "spatial": 1, "time_samples": 2, "seed": 1}, {"method": "none"}))
    assert 0 < rows[0]["rmse"] == rows[1]["rmse"] == mangata.metrics(none, truth, "rmse")["rmse"]


def test_one_name_stands_for_itself(scene):
    assert list(mangata.render(scene, layers="coverage", size=(16, 9))) == ["coverage"]
    assert mangata.query(scene, [[0, 0]], answers="height")["height"].shape == (1,)
    with pytest.raises(ValueError, match="no layer is given"):
        mangata.render(scene, layers=[], size=SMALL)


def test_compare_where_there_is_more_than_the_surface(scene):
    hull = os.path.join(os.path.dirname(SIMPLE), "hull.yaml")
    lines = []
    try:
        mangata.render(hull, layers=["color"], size=(16, 9), refraction="truth")
    except mangata.MangataError:
        pytest.skip("no Embree here")
    rows = mangata.compare([hull], ["none", "ssaa4"], layer="color", size=(32, 18), reference={"spatial": 2, "time_samples": 4}, metrics="rmse", progress=lines.append)
    assert [row["scene"] for row in rows] == ["hull", "hull"] and lines[0] == "hull, reference, frame 0"
    truth = mangata.render(hull, "ssaa2", size=(32, 18), time_samples=4, seed=1, refraction="truth", refraction_samples=4)["color"]
    none = mangata.render(hull, "none", size=(32, 18))["color"]
    assert rows[0]["rmse"] == pytest.approx(mangata.metrics(none, truth, "rmse")["rmse"], rel=1e-9)
    under = mangata.compare({"under": scene}, ["none"], size=SMALL, changes={"camera.position": [0, -1, 0]}, reference={"spatial": 1, "time_samples": 1})
    assert under[0]["method"] == "none"


def test_pictures_outlive_what_read_them(scene, tmp_path):
    command("render", SIMPLE, "-o", tmp_path / "a.pfm", "--layer", "coverage", "--size", "64x36")
    picture = mangata.read(tmp_path / "a.pfm")
    copy = picture.copy()
    for _ in range(20):
        mangata.read(tmp_path / "a.pfm")
    gc.collect()
    assert np.array_equal(picture, copy)
    (tmp_path / "bad.exr").write_bytes(b"nothing")
    with pytest.raises(mangata.SceneError):
        mangata.read(tmp_path / "bad.exr")


def test_every_public_name_has_a_docstring_and_types():
    for name in mangata.__all__:
        thing = getattr(mangata, name)
        assert thing.__doc__, name
        if callable(thing) and not isinstance(thing, type):
            assert "return" in thing.__annotations__, name


# ---- types ----


def test_all_that_is_public_has_types_and_text():
    assert os.path.exists(os.path.join(os.path.dirname(mangata.__file__), "py.typed"))
    for name in mangata.__all__:
        thing = getattr(mangata, name)
        assert thing.__doc__, name
        members = [(key, member) for key, member in vars(thing).items() if not key.startswith("_") or key == "__init__"] if inspect.isclass(thing) else [(name, thing)]
        for key, member in members:
            function = member.fget if isinstance(member, property) else getattr(member, "__func__", member)
            if not inspect.isfunction(function):
                continue
            hints = typing.get_type_hints(function)
            missing = [word for word in [*inspect.signature(function).parameters, "return"] if word not in hints and word not in ("self", "cls")]
            assert not missing, f"{name}, {key}: no type of {', '.join(missing)}"
            assert function.__doc__ or key == "__init__", f"{name}, {key}: no text"
