# SPDX-License-Identifier: MIT
"""How much light does a road of glitter return, and who tells it right? A study in Python, of a figure's size:

  PYTHONPATH=python python3 examples/glitter_study.py [-o FIGURE.png] [--size WxH] [--frames N]

From top to bottom: the sea by `mangata` at three winds; the coverage of each row of pixels by three methods and by brute force, the mean of some frames; the
height of the water under a place against time, with waves of more than 5 m alone. Needs matplotlib (python3-matplotlib)."""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import mangata

WINDS = (4, 8, 14)
METHODS = {"none": "tab:gray", "lean": "tab:orange", "mangata": "tab:blue", "ssaa4": "black"}
LIGHT = {"light.elevation_deg": 12, "light.angular_radius_deg": 1.0, "light.azimuth_deg": 0}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", default="glitter_study.png")
    parser.add_argument("--size", default="160x90", help="pixels of each picture")
    parser.add_argument("--frames", type=int, default=4, help="that the curves are the mean of")
    options = parser.parse_args()
    size = tuple(int(side) for side in options.size.split("x"))

    figure, axes = plt.subplots(3, len(WINDS), figsize=(4 * len(WINDS), 8), layout="constrained", gridspec_kw={"height_ratios": [9, 10, 6]})
    for column, wind in enumerate(WINDS):
        sea = mangata.sea(wind=wind, count=96, changes=LIGHT)
        picture, curves, heights = axes[:, column]

        picture.imshow(mangata.render(sea, layers=["display"], size=size)["display"])
        picture.set_title(f"wind {wind} m/s")
        picture.set_axis_off()

        for method, color in METHODS.items():
            samples = {"time_samples": 4} if method == "ssaa4" else {}
            rows = np.mean([mangata.render(sea, method, ["coverage"], frame, size=size, **samples)["coverage"].mean(axis=1) for frame in range(options.frames)], axis=0)
            curves.plot(rows, color=color, label=f"{method}, 4 instants" if samples else method)
        curves.set_xlabel("row of the picture, from the top")

        times = np.linspace(0, 20, 400)
        all_waves = [mangata.query(sea, [[0, 0]], time, ["height"])["height"][0] for time in times]
        long_waves = [mangata.query(sea, [[0, 0]], time, ["height"], least_wavelength=5)["height"][0] for time in times]
        heights.plot(times, all_waves, color="tab:blue", label="all waves")
        heights.plot(times, long_waves, color="tab:red", linewidth=1, label="longer than 5 m")
        heights.set_xlabel("seconds")

    axes[1, 0].set_ylabel("coverage, mean of a row")
    axes[1, 0].legend()
    axes[2, 0].set_ylabel("height of the water, m")
    axes[2, 0].legend(loc="lower left")
    figure.savefig(options.output, dpi=80, metadata={"Software": None})
    print(options.output)


if __name__ == "__main__":
    main()
