# SPDX-License-Identifier: MIT
"""The page of `mangata compare` in Chromium: sorts, flips, wipes, zooms, shows values, asks for nothing.

usage: report_test.py REPORT_FOLDER COVERAGE.pfm COLOR.pfm [SCREENSHOTS]
Rendered apart: the first method's coverage of the first scene's first frame, and its colour of the second scene's."""
import array
import json
import os
import sys

import browser

failures = 0


def check(right, text):
    global failures
    if not right:
        failures += 1
        print(f"FAIL {text}")


def read_pfm(path):
    """Rows of values, the top one first; three numbers a pixel where there is colour."""
    with open(path, "rb") as file:
        kind, size, order = file.readline(), file.readline(), file.readline()
        values = array.array("f", file.read())
    width, height = map(int, size.split())
    assert kind in (b"Pf\n", b"PF\n") and float(order) < 0
    row = width * (3 if kind == b"PF\n" else 1)
    return [values[(height - 1 - y) * row:(height - y) * row] for y in range(height)]


PIXELS = """(() => {{ const c = document.getElementById('stage'), r = c.width / c.clientWidth;
return Array.from(c.getContext('2d').getImageData({x} * r, {y} * r, {w} * r, {h} * r).data); }})()"""


def stage_bytes(page, x, y, width, height):
    """Bytes of a part of the stage, places as shares of its size."""
    box = page.run("(() => { const b = document.getElementById('stage').getBoundingClientRect(); return [b.width, b.height]; })()")
    return page.run(PIXELS.format(x=round(x * box[0]), y=round(y * box[1]), w=round(width * box[0]), h=round(height * box[1])))


def shown(page):
    page.settle()
    return page.run("document.getElementById('stage').dataset.shown")


def test_table(page, report):
    rows = len(report["scenes"]) * len(report["scenes"][0]["methods"])
    means = len(report["scenes"][0]["methods"]) if len(report["scenes"]) > 1 else 0
    check(page.run("document.querySelectorAll('#results tbody tr').length") == rows + means, "rows of the table")
    check(page.run("document.querySelectorAll('#results tfoot tr').length") == len(report["scenes"]) + bool(means), "a row of noise floors for each scene")
    hidden = "document.querySelectorAll('#results tfoot tr[hidden]').length"
    choose = "(() => {{ const s = document.getElementById('table-scene'); s.value = '{}'; s.dispatchEvent(new Event('change')); }})()"
    page.run(choose.format("0"))
    check(page.run(hidden) == len(report["scenes"]) - 1 + bool(means), "noise floors of one scene")
    page.run(choose.format(""))
    check(page.run(hidden) == 0, "noise floors of all scenes")
    index = page.run("[...document.querySelectorAll('#results thead th')].findIndex(c => c.textContent === 'RMSE')")
    values = f"[...document.querySelectorAll('#results tbody tr')].map(r => +r.cells[{index}].dataset.value)"
    heading = f"#results thead th:nth-child({index + 1}) button"
    page.click(heading)
    ascending = page.run(values)
    check(ascending == sorted(ascending) and len(set(ascending)) > 3, f"a click does not sort: {ascending}")
    known = sorted(m["scores"]["coverage.rmse"] for s in report["scenes"] for m in s["methods"])
    check(all(min(abs(v - k) for v in ascending) < 1e-6 for k in known), "the table's figures are not those of report.json")
    page.click(heading)
    check(page.run(values) == sorted(ascending, reverse=True), "a second click does not turn the order")
    check(page.run(f"document.querySelector('#results thead th:nth-child({index + 1})').getAttribute('aria-sort')") == "descending", "aria-sort")
    hidden = "getComputedStyle(document.querySelector('#results td.minor')).display"
    check(page.run(hidden) == "none", "minor metrics show at once")
    page.click("#table-all")
    check(page.run(hidden) != "none", "every metric")
    page.click("#table-all")


def test_flip(page, report):
    names = [m["method"] for m in report["scenes"][0]["methods"]]
    page.click("#modes button[data-mode=flip]")
    pictures = {}
    for number, name in list(enumerate(names, 1))[:9]:
        page.key(str(number))
        check(shown(page) == name, f"key {number} shows {shown(page)} instead of {name}")
        pictures[name] = stage_bytes(page, 0.3, 0.35, 0.4, 0.6)
    page.key("0")
    check(shown(page) == "reference", "key 0")
    check(len({tuple(p) for p in pictures.values()}) == len(pictures), "methods that differ look alike")
    check(all(any(p[i] > 40 for i in range(0, len(p), 4)) for p in pictures.values()), "a picture is black")


def test_wipe(page):
    page.key("1")
    page.key("f")
    page.settle()
    first = [stage_bytes(page, x, 0.3, 0.18, 0.65) for x in (0.3, 0.52)]
    page.key("0")
    page.settle()
    second = [stage_bytes(page, x, 0.3, 0.18, 0.65) for x in (0.3, 0.52)]
    check(first[0] != second[0] and first[1] != second[1], "pictures to wipe are alike")
    page.key("1")
    page.click("#modes button[data-mode=wipe]")
    x, y, width, height = page.box("#stage")
    page.move(x + 0.5 * width, y + 0.15 * height)
    page.settle()
    check(stage_bytes(page, 0.3, 0.3, 0.18, 0.65) == first[0] and stage_bytes(page, 0.52, 0.3, 0.18, 0.65) == second[1], "wipe in the middle")
    page.move(x + 0.8 * width, y + 0.15 * height)
    page.settle()
    check(stage_bytes(page, 0.52, 0.3, 0.18, 0.65) == first[1], "wipe to the right")
    page.move(x + 0.2 * width, y + 0.15 * height)
    page.settle()
    check(stage_bytes(page, 0.3, 0.3, 0.18, 0.65) == second[0], "wipe to the left")


def test_zoom(page):
    page.run("document.getElementById('b').focus()")
    page.key("s")  # in a list a letter chooses an entry, it is no command
    page.run("document.activeElement.blur()")
    page.key("r")
    page.click("#modes button[data-mode=side]")
    page.run("(() => { const b = document.getElementById('b'); b.value = document.getElementById('a').value;"
             "b.dispatchEvent(new Event('change')); })()")
    x, y, width, height = page.box("#stage")
    page.settle()
    before = stage_bytes(page, 0.05, 0.4, 0.4, 0.5)
    page.wheel(x + 0.22 * width, y + 0.6 * height, -600)
    page.settle()
    zoom = float(page.run("document.getElementById('stage').dataset.zoom"))
    check(zoom > 2, f"the wheel zooms to {zoom}")
    left, right = (pane_pixels(page, i) for i in range(2))
    check(left == right, "the panes do not zoom in step")
    check(stage_bytes(page, 0.05, 0.4, 0.4, 0.5) != before, "the wheel changes nothing")
    # The place under the pointer stays, and both panes show the same pixel at the same place.
    page.move(x + 0.22 * width, y + 0.6 * height)
    page.settle()
    one = page.run("document.getElementById('values').dataset.pixel")
    page.move(x + 0.22 * width + width / 2 + 2, y + 0.6 * height)
    page.settle()
    two = page.run("document.getElementById('values').dataset.pixel")
    check(one == two, f"pixel {one} left, {two} right")
    # A drag moves both.
    page.move(x + 0.2 * width, y + 0.5 * height)
    page.mouse("mousePressed", x + 0.2 * width, y + 0.5 * height, button="left", buttons=1, clickCount=1)
    page.mouse("mouseMoved", x + 0.2 * width - 60, y + 0.5 * height - 30, button="left", buttons=1)
    page.mouse("mouseReleased", x + 0.2 * width - 60, y + 0.5 * height - 30, button="left", clickCount=1)
    page.settle()
    check(pane_pixels(page, 0) != left, "a drag does not move")
    check(pane_pixels(page, 0) == pane_pixels(page, 1), "a drag does not move both")
    page.key("r")
    page.settle()
    check(float(page.run("document.getElementById('stage').dataset.zoom")) == 1, "r does not fit")
    page.run("(() => { const b = document.getElementById('b'); b.value = '0'; b.dispatchEvent(new Event('change')); })()")


def pane_pixels(page, index):
    """What a pane of two shows below its label."""
    return page.run(f"""(() => {{ const c = document.getElementById('stage'), r = c.width / c.clientWidth, w = (c.clientWidth - 4) / 2;
        const left = Math.round({index} * (w + 4) * r);
        const bytes = c.getContext('2d').getImageData(left + 4, 40 * r, w * r - 8, c.height - 40 * r).data;
        return bytes.reduce((s, v) => (s * 31 + v) % 2147483647, 7); }})()""")


def place(page, scene, i, j):
    """Where the pixel is on the screen, in a single pane that is not zoomed."""
    x, y, width, height = page.box("#stage")
    size = min(width / scene["width"], height / scene["height"])
    return x + (width - size * scene["width"]) / 2 + (i + 0.5) * size, y + (height - size * scene["height"]) / 2 + (j + 0.5) * size


def check_pixel(page, scene, pixels, i, j):
    channels = len(pixels[0]) // scene["width"]
    page.move(*place(page, scene, i, j))
    page.settle()
    page.wait(f"document.getElementById('values').dataset.pixel === '{i},{j}'", 5)
    for c in range(channels):
        text = page.run(f"document.querySelectorAll('#values tbody tr')[1].cells[{1 + c}].textContent")
        right = pixels[j][channels * i + c]
        check(abs(float(text) - right) <= 1e-3 * right + 1e-7, f"pixel {i}, {j}, channel {c}: {text} instead of {right}")


def test_values(page, report, pixels):
    """Pixel values are those of the pictures, to half precision."""
    scene = report["scenes"][0]
    page.key("1")
    page.key("f")
    page.key("r")
    page.settle()
    bright = max(((row[i], i, j) for j, row in enumerate(pixels) for i in range(len(row))))
    for i, j in ((bright[1], bright[2]), (bright[1] + 2, bright[2] - 1), (3, 2)):
        check_pixel(page, scene, pixels, i, j)
    rows = page.run("document.querySelectorAll('#values tbody tr').length")
    check(rows == len(scene["methods"]) + 1, "values of every method")
    page.click_at(*place(page, scene, 3, bright[2]))
    page.settle()
    check(page.run("document.getElementById('row-text').textContent") == str(bright[2]), "a click chooses the row")


def test_views(page, report, colors):
    """False colours, exposure, frames, strips, plot, commands."""
    page.key("e")
    page.settle()
    end = page.run("document.getElementById('scale').dataset.end")
    check(page.run("document.getElementById('scale').style.display") == "block" and float(end) > 0, "the scale of the error map")
    error = stage_bytes(page, 0.3, 0.3, 0.4, 0.6)
    page.key("2")
    page.settle()
    check(page.run("document.getElementById('scale').dataset.end") == end, "methods do not share the error's scale")
    check(stage_bytes(page, 0.3, 0.3, 0.4, 0.6) != error, "error maps are alike")
    page.click("#modes button[data-mode=flicker]")
    page.settle()
    check(shown(page).startswith("flicker of"), "flicker map")
    page.click("#modes button[data-mode=difference]")
    check("−" in shown(page), "difference")
    page.click("#modes button[data-mode=all]")
    check(shown(page).count(" / ") == len(report["scenes"][0]["methods"]), "all methods")
    page.key("f")
    page.settle()
    before = stage_bytes(page, 0.3, 0.3, 0.4, 0.6)
    page.key("]")
    page.settle()
    brighter = stage_bytes(page, 0.3, 0.3, 0.4, 0.6)
    check(sum(brighter) > sum(before), "exposure")
    page.key("[")
    page.settle()
    check(stage_bytes(page, 0.3, 0.3, 0.4, 0.6) == before, "exposure and back")
    page.key("ArrowRight")
    page.settle()
    check(page.run("document.getElementById('frame-text').textContent") == str(report["frames"][1]), "the next frame")
    check(stage_bytes(page, 0.3, 0.3, 0.4, 0.6) != before, "the next frame looks alike")
    box = page.box("#frame")
    page.click_at(box[0] + box[2] - 3, box[1] + box[3] / 2)
    page.settle()
    check(page.run("document.getElementById('frame-text').textContent") == str(report["frames"][-1]), "the scrubber")
    page.run("document.activeElement.blur()")
    page.key(" ")
    page.wait("document.getElementById('frame-text').textContent !== '%d'" % report["frames"][-1], 5)
    page.key(" ")
    check(page.run("document.querySelectorAll('#strips canvas').length") == 2, "strips of A and the reference")
    check(page.run("document.querySelectorAll('#plot polyline').length") == len(report["scenes"][0]["methods"]), "lines of the plot")
    check(page.run("document.getElementById('command').textContent") == report["command"], "the exact command")
    page.run("(() => { const s = document.getElementById('scene'); s.value = '1'; s.dispatchEvent(new Event('change')); })()")
    page.settle()
    check(page.run("document.getElementById('layer').value") == "1", "a scene with a sky shows its colour")
    page.key("1")
    box = page.box("#frame")
    page.click_at(box[0] + 2, box[1] + box[3] / 2)
    page.settle()
    for i, j in ((48, 40), (3, 3), (50, 24)):
        check_pixel(page, report["scenes"][1], colors, i, j)
    values = stage_bytes(page, 0.3, 0.5, 0.4, 0.4)
    check(20 < sum(values[0::4]) / (len(values) / 4) < 235, "the colours are black or white")


def test_modes_of_reading(page, url):
    """Dark, and without scripts."""
    light = page.run("getComputedStyle(document.documentElement).backgroundColor")
    page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    check(page.run("getComputedStyle(document.documentElement).backgroundColor") != light, "prefers-color-scheme")
    page.call("Emulation.setScriptExecutionDisabled", value=True)
    page.open(url + "?plain")
    check(page.run("document.querySelectorAll('#results tbody td').length") > 50, "the table without scripts")
    check(page.run("getComputedStyle(document.querySelector('#results td.minor')).display") != "none", "a metric is hidden without scripts")
    check(page.run("[...document.querySelectorAll('.needs-script')].every(e => getComputedStyle(e).display === 'none')"), "dead controls show")
    check(page.run("document.querySelector('noscript p').getClientRects().length") == 1, "the noscript text")


def test_quiet(page, url):
    """No error on the console; nothing is fetched but the file itself and data in it."""
    for event in page.events:
        kind, details = event["method"], event["params"]
        if "getImageData" in details.get("entry", {}).get("text", ""):
            continue  # advice about the reading back that this test does
        if kind == "Runtime.exceptionThrown" or (kind == "Runtime.consoleAPICalled" and details["type"] in ("error", "warning", "assert")) or \
                (kind == "Log.entryAdded" and details["entry"]["level"] in ("error", "warning")):
            check(False, f"console: {json.dumps(details)[:400]}")
        if kind == "Network.requestWillBeSent":
            address = details["request"]["url"]
            check(address.split("?")[0] == url or address.startswith("data:"), f"a request leaves the file: {address}")


def main():
    path = browser.find()
    if not path:
        print("chromium is not installed: the report's page is not tested")
        return 77
    folder = os.path.abspath(sys.argv[1])
    url = f"file://{folder}/report.html"
    with open(f"{folder}/report.json", encoding="utf-8") as file:
        report = json.load(file)
    page = browser.Browser(path)
    try:
        page.open(url)
        page.wait("document.getElementById('stage').dataset.drawn")
        test_table(page, report)
        test_flip(page, report)
        test_wipe(page)
        test_zoom(page)
        test_values(page, report, read_pfm(sys.argv[2]))
        test_views(page, report, read_pfm(sys.argv[3]))
        if len(sys.argv) > 4:
            page.screenshot(f"{sys.argv[4]}/report.png")
        test_modes_of_reading(page, url)
        test_quiet(page, url)
    finally:
        page.close()
    print(f"{failures} failures")
    return 1 if failures else 0


sys.exit(main())
