#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints a script of the viewer with actions by chance: controls, keys, drags over picture and panels, wheel, pages, undo and redo, other scenes, sizes.

usage: random_actions.py COUNT SEED SCENE…

Each line is one action. Nothing that ends the viewer is among them.
"""
import random
import sys

WIDTH, HEIGHT = 640, 400
KEYS = ("f r p k space , . [ ] home x l - = i t c tab ? f1 escape 1 2 3 4 5 6 ctrl+z ctrl+y ctrl+shift+z ctrl+o shift+1 shift+3 shift+5").split()


def place(chance):
    return f"{chance.randrange(WIDTH)} {chance.randrange(HEIGHT)}"


def action(chance, scenes):
    roll = chance.random()
    if roll < 0.40:
        return f"random 1 {chance.randrange(1 << 30)} image."
    if roll < 0.55:
        return "press " + chance.choice(KEYS)
    if roll < 0.70:
        return f"drag {place(chance)} {place(chance)} " + chance.choice(("left", "left", "left", "middle", "right"))
    if roll < 0.76:
        return f"scroll {place(chance)} {chance.choice((-2, -1, 1, 2))}" + chance.choice(("", " ctrl"))
    if roll < 0.80:
        return f"page {chance.randrange(1, 8)}"
    if roll < 0.90:
        return "press " + chance.choice(("ctrl+z", "ctrl+z", "ctrl+y"))
    if roll < 0.93:
        return chance.choice(("wave add", "wave remove 0", "revert", "hold w 3", "hold e 3", "pointer " + place(chance)))
    if roll < 0.95:
        return f"drop {chance.choice(scenes)}"
    if roll < 0.96:
        return f"resize {WIDTH + chance.randrange(-200, 100)} {HEIGHT + chance.randrange(-150, 100)}"
    if roll < 0.98:
        return "set panel.shown on"
    return "frames 2"


def main():
    count, seed, scenes = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3:]
    chance = random.Random(seed)
    for i in range(count):
        print(action(chance, scenes))
        if i % 500 == 499: # scenes of many waves and methods of many samples would take all the time
            print(f"# {i + 1} actions")
            print("memory")
            print(f"drop {scenes[0]}")
    print("quit")


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main()
