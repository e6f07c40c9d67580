// SPDX-License-Identifier: MIT
// The judge: brute force that refines while the picture stands still, in a second copy of the library, and what a picture's figures are beside it.

class Judge {
  constructor(library) { this.library = library; this.key = ""; }

  // Begins anew where the scene has changed.
  ask(settings, width, height) {
    const key = JSON.stringify([settings, width, height]);
    if (key === this.key) return;
    Object.assign(this, { key, width, height, samples: 0, row: 0 });
    this.library.update(settings);
    this.library.calls.picture_begin(this.library.method("none"), width, height, 1);
  }

  // Works for so many milliseconds; a sample of every pixel at a time.
  work(budget) {
    const end = performance.now() + budget, calls = this.library.calls;
    while (performance.now() < end && this.samples < 256) {
      if (this.row === 0 && this.samples === 0) calls.picture_next_sample();
      calls.picture_row(this.row++);
      if (this.row * 16 >= this.height) {
        this.row = 0;
        if (++this.samples < 256) calls.picture_next_sample();
      }
    }
  }

  // Of a picture of float RGBA as the judge's size: RMSE of displayed luminance, light and texture contrast over the judge's.
  figures(pixels, exposure) {
    if (this.samples < 4) return null;
    const truth = this.library.floats(this.library.calls.picture_color(), 3 * this.width * this.height);
    const shown = v => 1 - Math.exp(-v * exposure), luma = (a, i) => 0.2126 * a[i] + 0.7152 * a[i + 1] + 0.0722 * a[i + 2];
    let squares = 0, light = 0, trueLight = 0, contrast = 0, trueContrast = 0;
    let before = 0, trueBefore = 0;
    const count = this.width * this.height, all = this.samples + (this.row > 0 ? 1 : 0);
    for (let i = 0; i < count; i++) {
      const rowsDone = Math.floor(i / this.width) < this.row * 16 ? all : this.samples;
      const a = shown(luma(pixels, 4 * i)), b = shown(luma(truth, 3 * i) / rowsDone);
      squares += (a - b) ** 2;
      light += a; trueLight += b;
      if (i % this.width) { contrast += (a - before) ** 2; trueContrast += (b - trueBefore) ** 2; }
      before = a; trueBefore = b;
    }
    return { error: Math.sqrt(squares / count), light: light / trueLight, contrast: Math.sqrt(contrast / trueContrast), samples: this.samples };
  }
}
