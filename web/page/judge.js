// SPDX-License-Identifier: MIT
// The judge: brute force of two instants a frame apart, in a worker of its own, and what pictures of both instants are beside it.

// What the judge's worker does: { begin }, then { work: milliseconds, samples } until it has so many and { pictures }, as often as wanted.
function judgeTasks(post) {
  let instants, scene, row, samples;
  const begin = ({ settings, width, height }) => {
    scene = { width, height, count: width * height };
    row = samples = 0;
    instants.forEach((library, i) => {
      const { calls } = library;
      library.update(settings[i]);
      calls.picture_begin(library.method("none"), width, height, 1, 0, 0);
      calls.picture_next_sample();
    });
  };
  // A row of both instants at a time. Samples are numbered from 1.
  const work = (milliseconds, most) => {
    const end = performance.now() + milliseconds;
    while (samples < most && performance.now() < end) {
      instants.forEach(library => library.calls.picture_row(row, 0, Math.ceil(scene.width / TILE_COLUMNS)));
      row++;
      if (row * TILE_ROWS >= scene.height) {
        row = 0;
        samples++;
        instants.forEach(library => library.calls.picture_next_sample());
      }
    }
  };
  const lumaOf = (library, at, weight) => {
    const { calls } = library, out = calls.take(4 * scene.count);
    calls.picture_luma(at, weight, scene.count, out);
    const luma = library.copy(Float32Array, out, scene.count);
    calls.give(out);
    return luma;
  };
  const radiance = (library, at) => {
    const rgba = new Float32Array(library.calls.memory.buffer, at, 4 * scene.count);
    let sum = 0;
    for (let i = 0; i < rgba.length; i += 4) sum += 0.2126 * rgba[i] + 0.7152 * rgba[i + 1] + 0.0722 * rgba[i + 2];
    return sum;
  };
  // Sum of squares over pixels of what `of` makes of planes at a pixel.
  const squares = of => {
    let sum = 0;
    for (let i = 0; i < scene.count; i++) sum += of(i) ** 2;
    return sum;
  };
  // Displayed luma of an instant's mean, and half of what its halves differ by: the mean's noise.
  const truthOf = library => {
    const { calls } = library, halves = [0, 1].map(half => calls.picture_half(half)), at = calls.take(16 * scene.count);
    const [first, second, sum] = [...halves, at].map(place => new Float32Array(calls.memory.buffer, place, 4 * scene.count));
    for (let i = 0; i < sum.length; i++) sum[i] = first[i] + second[i];
    const mean = lumaOf(library, at, 1 / samples), [a, b] = halves.map(half => lumaOf(library, half, 2 / samples)), light = radiance(library, at) / samples;
    calls.give(at);
    return { mean, noise: a.map((v, i) => (v - b[i]) / 2), light };
  };
  const figures = pictures => {
    const { width, count } = scene, [now, next] = instants.map(truthOf);
    const beside = plane => i => (i % width ? plane[i] - plane[i - 1] : 0), step = (a, b) => i => b[i] - a[i];
    // Where more than a third is noise, the rest is too small, for glints that few samples meet are clipped when displayed; the ratio to it is then a bound.
    const rest = (all, noise) => ({ squared: all - noise, small: all < 3 * noise });
    const contrast = rest(squares(beside(now.mean)), squares(beside(now.noise))), flicker = rest(squares(step(now.mean, next.mean)), squares(step(now.noise, next.noise)));
    return pictures.map(pair => {
      const { calls } = instants[0], at = calls.take(16 * count);
      const planes = pair.map(rgba => {
        new Float32Array(calls.memory.buffer, at, 4 * count).set(rgba);
        return { luma: lumaOf(instants[0], at, 1), light: radiance(instants[0], at) };
      });
      calls.give(at);
      const own = planes[0].luma;
      return {
        error: Math.sqrt(Math.max(0, squares(step(now.mean, own)) - squares(i => now.noise[i])) / count), energy: planes[0].light / now.light,
        contrast: Math.sqrt(squares(beside(own)) / contrast.squared), flicker: Math.sqrt(squares(step(own, planes[1].luma)) / flicker.squared),
        bounds: { contrast: contrast.small, flicker: flicker.small },
      };
    });
  };
  return async task => {
    try {
      if (task.module) instants = Promise.all([openLibrary(task.module), openLibrary(task.module)]);
      else instants = await instants;
      if (task.begin) begin(task.begin);
      if (task.work) work(task.work, task.samples);
      post({ samples, sides: task.pictures ? figures(task.pictures) : null });
    } catch (error) {
      post({ wrong: error.message });
    }
  };
}

class Judge {
  constructor(module) { this.worker = new TaskWorker(module, judgeTasks); this.round = 0; this.idle = true; }

  stop() { this.round++; this.idle = true; }

  // Judges pictures[side][instant], floats of width × height, of settings[instant] by up to `most` samples. `duty`: fraction of the time that it works.
  // found(sides, samples) gets error, energy, contrast and flicker whenever the samples have doubled.
  async begin({ settings, width, height, pictures, most, duty }, found) {
    const round = ++this.round;
    this.idle = false;
    let next = 16;
    await this.worker.ask({ begin: { settings, width, height } });
    while (round === this.round && next <= most) {
      const start = performance.now(), { samples } = await this.worker.ask({ work: 30, samples: next });
      if (round !== this.round) return;
      if (samples === next) {
        const { sides } = await this.worker.ask({ pictures });
        if (round === this.round) found(sides, samples);
        next *= 2;
      }
      if (duty < 1) await pause((performance.now() - start) * (1 / duty - 1));
    }
    if (round === this.round) this.idle = true;
  }
}
