// SPDX-License-Identifier: MIT
// Rows of tiles by workers: pixels of the library's own kernels, or what shaders read of the tiles.

const TILE_ROWS = 16, TILE_COLUMNS = 32; // pixels of a tile
const MAP_SIZE = 4096, MAP_BAND = 64;      // texels of the map of slopes each way, and rows of a band of it

// What a worker does with a job's rows. A job is { id, kind: "pixels", "shown", "tiles" or "slopes", settings, method, width, height, jitter, sorted, tiles }; `tiles`: the first column of tiles, and that after the last.
function laneTasks(post) {
  let library, begun = 0, head = 0;
  const begin = job => {
    const { calls } = library, number = library.method(job.method);
    library.update(job.settings);
    if (job.kind === "tiles" || job.kind === "slopes") head = calls.prepare(number, job.width, job.height, ...job.jitter, job.sorted ? 1 : 0);
    else calls.picture_begin(number, job.width, job.height, 0, ...job.jitter);
    begun = job.id;
  };
  const numbersAt = (at, count) => new Int32Array(library.calls.memory.buffer, at, count);
  const pixelsOf = (job, row) => {
    const { calls } = library, first = row * TILE_ROWS * job.width, count = Math.min(TILE_ROWS, job.height - row * TILE_ROWS) * job.width;
    calls.picture_row(row, ...job.tiles);
    const data = job.kind === "shown" ? library.copy(Uint8ClampedArray, calls.picture_shown(first, count), 4 * count)
      : library.copy(Float32Array, calls.picture_half(0) + 16 * first, 4 * count);
    return { data, frame: library.copy(Uint8Array, calls.picture_frame(), calls.frame_bytes()) };
  };
  const tilesOf = (job, row) => {
    const { calls } = library;
    const [tiles, lists, searched, hits, listCount, searchCount, hitCount] = numbersAt(calls.prepare_row(row, ...job.tiles) + 44, 7), columns = numbersAt(head, 11)[9];
    return {
      tiles: library.copy(Uint32Array, tiles, columns * calls.tile_bytes() / 4), lists: library.copy(Float32Array, lists, 4 * listCount),
      searched: library.copy(Float32Array, searched, 12 * searchCount), hits: library.copy(Float32Array, hits, 8 * hitCount),
    };
  };
  const slopesOf = band => ({ data: library.copy(Uint16Array, library.calls.lean_band(band), library.calls.lean_band_rows() * MAP_SIZE * 2) });
  const headOf = () => {
    const { calls } = library, [frame, waves, foam, leanData, leanWaves, waveCount, hasFoam, choppy, leanCount, columns, rows] = numbersAt(head, 11), [skyline, skylineCount] = numbersAt(head + 72, 2);
    const foamBytes = calls.foam_bytes();
    return {
      frame: library.copy(Uint8Array, frame, calls.frame_bytes()), waves: library.copy(Float32Array, waves, calls.wave_bytes() / 4 * waveCount), waveCount, choppy: choppy !== 0, columns, rows,
      foam: hasFoam ? library.copy(Uint8Array, foam, foamBytes) : null, foamWaves: hasFoam ? library.copy(Float32Array, foam + foamBytes, calls.foam_wave_bytes() / 4 * (waveCount + 1)) : null,
      skyline: library.copy(Float32Array, skyline, 2 * Math.max(2, skylineCount)),
      lean: leanData ? { data: library.copy(Uint8Array, leanData, calls.lean_bytes()), waves: library.copy(Uint8Array, leanWaves, calls.lean_wave_bytes() * leanCount), count: leanCount } : null,
      skyColumns: calls.sky_columns(), skyRows: calls.sky_rows(), sky: library.copy(Float32Array, calls.sky_table(), 3 * calls.sky_columns() * calls.sky_rows()), tileWords: calls.tile_bytes() / 4,
    };
  };
  return async task => {
    try {
      if (task.module) {
        library = openLibrary(task.module);
        post({});
        return;
      }
      library = await library;
      const { job, row } = task;
      if (job.id !== begun) begin(job);
      const answer = job.kind === "tiles" ? { ...tilesOf(job, row), head: task.first ? headOf() : null } : job.kind === "slopes" ? slopesOf(row) : pixelsOf(job, row);
      answer.memory = library.calls.memory.buffer.byteLength;
      post(answer, [answer.data, answer.tiles, answer.lists, answer.searched, answer.hits].filter(Boolean).map(a => a.buffer));
    } catch (error) {
      begun = 0;
      post({ wrong: error.message });
    }
  };
}

class Lanes {
  constructor(module, count = Math.max(1, Math.min(8, navigator.hardwareConcurrency || 2))) {
    this.workers = Array.from({ length: count }, () => new TaskWorker(module, laneTasks));
    this.jobs = 0;
    this.memory = []; // bytes of each worker's library
  }

  // Ends the workers. What they were asked for rejects.
  end() { this.workers.forEach(worker => worker.end()); }

  // Every row's answer goes to take(answer, row). False: stale() was true, and not all rows are done. `columns`: of pixels, the first that matters, and that after the last.
  async run(job, take, stale = () => false) {
    const { jitter = [0, 0], sorted = true, columns = [0, job.width] } = job, rows = job.kind === "slopes" ? MAP_SIZE / MAP_BAND : Math.ceil(job.height / TILE_ROWS);
    const whole = { ...job, jitter, sorted, tiles: [Math.floor(columns[0] / TILE_COLUMNS), Math.ceil(columns[1] / TILE_COLUMNS)], id: ++this.jobs };
    let next = 0, done = 0;
    await Promise.all(this.workers.map(async (worker, index) => {
      while (next < rows && !stale()) {
        const row = next++, answer = await worker.ask({ job: whole, row, first: row === 0 });
        this.memory[index] = answer.memory;
        take(answer, row);
        done++;
      }
    }));
    return done === rows;
  }

  // A picture as floats of red, green, blue and coverage, or, `shown`, as displayed bytes; with the frame's uniform data. Null: stale() was true.
  async pixels(job, stale, shown = false) {
    const data = new (shown ? Uint8ClampedArray : Float32Array)(4 * job.width * job.height), picture = { data };
    const whole = await this.run({ ...job, kind: shown ? "shown" : "pixels" }, (answer, row) => {
      data.set(answer.data, 4 * TILE_ROWS * job.width * row);
      picture.frame = answer.frame;
    }, stale);
    return whole ? picture : null;
  }

  // Level 0 of the map of slope moments of a picture: bands of slopes x, z in half precision go to take(slopes, band). False: stale() was true.
  slopes(job, take, stale) { return this.run({ ...job, kind: "slopes" }, (answer, band) => take(answer.data, band), stale); }

  // What the shaders read of a picture's tiles. Null: stale() was true.
  async tiles(job, stale) {
    const rows = [];
    if (!await this.run({ ...job, kind: "tiles" }, (answer, row) => { rows[row] = answer; }, stale)) return null;
    const { head } = rows[0], joined = name => {
      const all = new rows[0][name].constructor(rows.reduce((sum, r) => sum + r[name].length, 0));
      let at = 0;
      for (const r of rows) { all.set(r[name], at); at += r[name].length; }
      return all;
    };
    const first = [0, 0, 0]; // of a row's waves, searched waves and hits
    for (const { tiles, lists, searched, hits } of rows) {
      for (let at = head.tileWords - 4; at < tiles.length; at += head.tileWords) {
        tiles[at] += first[0];
        tiles[at + 1] += first[1];
        if (tiles[at + 2] !== 0xffffffff) tiles[at + 2] += first[2];
      }
      first[0] += lists.length / 4;
      first[1] += searched.length / 12;
      first[2] += hits.length / 8;
    }
    return { ...head, tiles: joined("tiles"), lists: joined("lists"), searched: joined("searched"), hits: joined("hits") };
  }
}
