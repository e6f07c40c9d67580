// SPDX-License-Identifier: MIT
// The kernels as WebGL2 programs: pictures of a method into textures, textures to the canvas.

const DATA_WIDTH = 4096; // texels of a row, as in web_data.glsl; first hits of a picture of 3840 × 2160 take up to 28 million texels
const SPARE_ROWS = 256; // of a texture that has grown
// `byLanes`: workers can draw it, too.
const METHODS = {
  none: { about: "one sample at the pixel's centre", program: ["points.frag"], byLanes: true },
  "ggx-moments": { about: "as in game engines: GGX of the slopes' moments", program: ["slopes.frag", "kernels/baselines/ggx_moments.k", "ggx_moments_result"], byLanes: true },
  bruneton: { about: "Bruneton et al. 2010: Gaussian slopes", program: ["slopes.frag", "kernels/baselines/bruneton.k", "bruneton_result"], byLanes: true },
  leadr: { about: "Dupuy et al. 2013: a tiled map of slope moments", program: ["slopes.frag", "kernels/baselines/leadr.k", "leadr_result"], map: true },
  taa: { about: "temporal anti-aliasing: eight frames of none", program: ["points.frag"], blends: true },
  mangata: { about: "this library's closed form", program: ["slopes.frag", "kernels/glitter/glitter.k"], byLanes: true },
};
// As src/frame/whole_frame.h has them: frames of taa, and where in the pixel each looks (Halton 2, 3).
const TAA_FRAMES = 8;
const MAP_LEVELS = 13; // of the map of slope moments: 4096 texels to 1

class Engine {
  // Throws a text where the canvas has no WebGL2 that can draw this.
  constructor(canvas, lanes, texts, calls) {
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, alpha: false, preserveDrawingBuffer: true, powerPreference: "high-performance" });
    const others = gl || document.createElement("canvas").getContext("webgl2"); // another canvas has one
    if (!gl) throw new Error(others ? "the canvas has a context of another kind; one without is needed" : "this browser has no WebGL2");
    if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("its WebGL2 cannot draw into floating-point pictures");
    Object.assign(this, { canvas, lanes, texts, gl, programs: new Map(), buffers: {}, textures: {}, times: {} });
    this.parallel = gl.getExtension("KHR_parallel_shader_compile");
    this.blockBytes = calls.block_waves() * calls.wave_bytes();
    this.blockWaves = gl.getParameter(gl.MAX_UNIFORM_BLOCK_SIZE) >= this.blockBytes ? calls.block_waves() : 0;
    const names = gl.getExtension("WEBGL_debug_renderer_info");
    this.byCpu = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
    this.mostRows = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    this.empty = gl.createVertexArray();
    gl.bindVertexArray(this.empty);
    gl.disable(gl.DITHER);
  }

  // ---- programs ----

  assembled(name, seen, method) {
    if (name === "method.k") name = method;
    if (seen.has(name)) return "";
    seen.add(name);
    return this.texts[name].split("\n").map(line => {
      const include = /^# ?include "([^"]+)"/.exec(line);
      return include ? this.assembled(include[1], seen, method) : line;
    }).join("\n") + "\n";
  }

  program(file, method, result, defines) {
    const key = [file, method, defines].join();
    if (this.programs.has(key)) return this.programs.get(key);
    const gl = this.gl, program = gl.createProgram();
    const head = "#version 300 es\n" + defines + (result ? `#define method_result ${result}\n` : "");
    const shaders = [[gl.VERTEX_SHADER, "whole.vert"], [gl.FRAGMENT_SHADER, file]].map(([kind, name]) => {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, (name === file ? head : "#version 300 es\n") + this.assembled(name, new Set(), method));
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      return shader;
    });
    gl.linkProgram(program);
    const entry = { program, shaders, key, ready: false, places: {} };
    this.programs.set(key, entry);
    return entry;
  }

  // False while the driver still compiles.
  isReady(entry) {
    const gl = this.gl;
    if (entry.ready) return true;
    if (this.parallel && !gl.getProgramParameter(entry.program, this.parallel.COMPLETION_STATUS_KHR)) return false;
    if (!gl.getProgramParameter(entry.program, gl.LINK_STATUS)) {
      const logs = entry.shaders.map(s => gl.getShaderInfoLog(s)).join("\n");
      throw new Error(`${entry.key}: ${logs} ${gl.getProgramInfoLog(entry.program)}`);
    }
    ["FrameBlock", "FoamBlock", "WaveBlock", "LeanBlock"].forEach((block, i) => {
      const index = gl.getUniformBlockIndex(entry.program, block);
      if (index !== gl.INVALID_INDEX) gl.uniformBlockBinding(entry.program, index, i);
    });
    gl.useProgram(entry.program);
    TEXTURES.forEach((name, unit) => {
      const place = gl.getUniformLocation(entry.program, name);
      if (place) gl.uniform1i(place, unit);
    });
    entry.ready = true;
    return true;
  }

  place(entry, name) {
    if (!(name in entry.places)) entry.places[name] = this.gl.getUniformLocation(entry.program, name);
    return entry.places[name];
  }

  // `choppy`, `foamy`, `waves`: what the water is, and of how many.
  methodProgram(name, { choppy, foamy, waves }) {
    const { program: [file, kernel, result], map } = METHODS[name];
    const defines = (map ? "#define LEAN_MAP\n" : "") + (choppy ? "#define CHOPPY_WATER\n" : "") + (foamy ? "#define FOAMY_WATER\n" : "") + (waves <= this.blockWaves ? `#define WAVES_IN_BLOCK ${this.blockWaves}\n` : "");
    return this.program(file, kernel || "", result, defines);
  }

  // ---- data ----

  block(name, index, bytes) {
    const gl = this.gl, buffer = this.buffers[name] = this.buffers[name] || gl.createBuffer();
    gl.bindBuffer(gl.UNIFORM_BUFFER, buffer);
    gl.bufferData(gl.UNIFORM_BUFFER, bytes, gl.STREAM_DRAW);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, index, buffer);
  }

  bind(name, texture) {
    this.gl.activeTexture(this.gl.TEXTURE0 + TEXTURES.indexOf(name));
    this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
  }

  newTexture(name, format, width, height, levels = 1) {
    const gl = this.gl, texture = gl.createTexture();
    this.bind(name, texture);
    gl.texStorage2D(gl.TEXTURE_2D, levels, format, width, height);
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, levels > 1 && side === gl.TEXTURE_MIN_FILTER ? gl.NEAREST_MIPMAP_NEAREST : gl.NEAREST);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
    return texture;
  }

  // Texels of four numbers each, in rows of DATA_WIDTH.
  data(name, numbers) {
    const gl = this.gl, whole = numbers instanceof Uint32Array, texels = numbers.length / 4, rows = Math.max(1, Math.ceil(texels / DATA_WIDTH));
    let entry = this.textures[name];
    if (rows > this.mostRows) throw new Error("the picture is too large for the textures of this WebGL2");
    if (!entry || entry.rows < rows) {
      if (entry) gl.deleteTexture(entry.texture);
      const room = Math.min(rows + Math.min(rows, SPARE_ROWS), this.mostRows);
      entry = this.textures[name] = { rows: room, texture: this.newTexture(name, whole ? gl.RGBA32UI : gl.RGBA32F, DATA_WIDTH, room) };
    }
    this.bind(name, entry.texture);
    const full = Math.floor(texels / DATA_WIDTH), rest = texels % DATA_WIDTH;
    const put = (row, width, height, from) =>
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, width, height, whole ? gl.RGBA_INTEGER : gl.RGBA, whole ? gl.UNSIGNED_INT : gl.FLOAT, numbers, 4 * from);
    if (full > 0) put(0, DATA_WIDTH, full, 0);
    if (rest > 0) put(full, rest, 1, full * DATA_WIDTH);
  }

  // What lanes.tiles() gave.
  upload(tiles) {
    const gl = this.gl, { skyColumns: columns, skyRows: rows } = tiles;
    this.block("frame", 0, tiles.frame);
    if (tiles.foam) {
      this.block("foam", 1, tiles.foam);
      this.data("foam_texture", tiles.foamWaves);
    }
    if (tiles.waveCount <= this.blockWaves) {
      const all = new Float32Array(this.blockBytes / 4); // shaders ask for a whole block
      all.set(tiles.waves);
      this.block("waves", 2, all);
    } else this.data("wave_texture", tiles.waves);
    for (const [name, numbers] of [["tile", tiles.tiles], ["list", tiles.lists], ["search", tiles.searched], ["hit", tiles.hits], ["skyline", tiles.skyline]]) this.data(name + "_texture", numbers);
    if (!this.sky) this.sky = this.newTexture("sky_texture", gl.RGB32F, columns, rows);
    this.bind("sky_texture", this.sky);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, columns, rows, gl.RGB, gl.FLOAT, tiles.sky);
  }

  // A picture to draw into.
  target(width, height) {
    const gl = this.gl, texture = this.newTexture("first_texture", gl.RGBA32F, width, height), frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    return { width, height, texture, frame };
  }

  discard(target) {
    this.gl.deleteTexture(target.texture);
    this.gl.deleteFramebuffer(target.frame);
  }

  // Deletes all that it holds in the canvas's WebGL2, but for targets.
  free() {
    const { gl, map } = this, textures = Object.values(this.textures).map(t => t.texture);
    for (const { program, shaders } of this.programs.values()) {
      shaders.forEach(s => gl.deleteShader(s));
      gl.deleteProgram(program);
    }
    Object.values(this.buffers).forEach(b => gl.deleteBuffer(b));
    [...textures, this.sky, ...(map ? [map.mean, map.square] : [])].forEach(t => gl.deleteTexture(t));
    if (map) gl.deleteFramebuffer(map.frame);
    gl.deleteVertexArray(this.empty);
  }

  // A picture that lanes.pixels() gave.
  put(target, picture) {
    const gl = this.gl;
    this.block("frame", 0, picture.frame);
    this.bind("first_texture", target.texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, target.width, target.height, gl.RGBA, gl.FLOAT, picture.data);
  }

  // Draws over rows and columns of pixels of a target: the first, and that after the last.
  fill(entry, target, rows = [0, target.height], columns = [0, target.width]) {
    const gl = this.gl;
    gl.useProgram(entry.program);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.viewport(0, 0, target.width, target.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(columns[0], rows[0], columns[1] - columns[0], rows[1] - rows[0]);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.SCISSOR_TEST);
  }

  // Until what has been asked for is drawn.
  async finished() {
    const gl = this.gl, sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (gl.clientWaitSync(sync, 0, 0) === gl.TIMEOUT_EXPIRED) await pause(1);
    gl.deleteSync(sync);
  }

  async compiled(entry) {
    while (!this.isReady(entry)) {
      if (this.gone) throw new Error("the shaders are gone"); // they will never be ready
      await pause(5);
    }
    return entry;
  }

  // A picture of the scene by a method that needs no history. With `stale`, it is drawn in bands; false: stale() was true, and the picture is not whole.
  // `jitter` in pixels; `sorted` false: every wave counts in every tile.
  async draw(method, target, settings, { jitter, sorted, columns, stale } = {}) {
    const start = performance.now(), { width, height } = target;
    const tiles = await this.lanes.tiles({ method, settings, width, height, jitter, sorted, columns }, stale);
    if (!tiles) return false;
    this.times.tiles = performance.now() - start;
    const entry = await this.compiled(this.methodProgram(method, { choppy: tiles.choppy, foamy: tiles.foam !== null, waves: tiles.waveCount }));
    if (METHODS[method].map && !await this.makeMap({ method, settings, width, height }, tiles.lean, stale)) return false;
    this.upload(tiles);
    this.gl.useProgram(entry.program);
    this.gl.uniform2i(this.place(entry, "tile_grid"), tiles.columns, height);
    for (let row = 0, rows = stale ? Math.ceil(5e4 / width) : height; row < height; row += rows) {
      this.fill(entry, target, [row, Math.min(height, row + rows)], columns);
      await this.finished();
      if (stale && stale()) return false;
    }
    return true;
  }

  // The map of slope moments that `lean` says; one that is there already stays. this.progress, where it is set, gets the fraction of the map that is made.
  async makeMap(job, lean, stale) {
    const { gl } = this, key = lean.waves.join();
    this.block("lean", 3, lean.data);
    const map = this.map = this.map || {
      mean: this.newTexture("lean_mean_texture", gl.RG16F, MAP_SIZE, MAP_SIZE, MAP_LEVELS), frame: gl.createFramebuffer(),
      square: this.newTexture("lean_square_texture", gl.RGBA16F, MAP_SIZE / 2, MAP_SIZE / 2, MAP_LEVELS - 1),
    };
    if (map.key === key) return true;
    map.key = "";
    let bands = 0;
    const put = (slopes, band) => {
      this.bind("lean_mean_texture", map.mean);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, band * MAP_BAND, MAP_SIZE, MAP_BAND, gl.RG, gl.HALF_FLOAT, slopes);
      if (this.progress) this.progress(++bands * MAP_BAND / MAP_SIZE);
    };
    if (!await this.lanes.slopes(job, put, stale)) return false;
    const entry = await this.compiled(this.program("lean_shrink.frag", "", "", ""));
    gl.useProgram(entry.program);
    const levels = (name, first, last) => {
      this.bind(name, name === "lean_mean_texture" ? map.mean : map.square);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_BASE_LEVEL, first);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, last);
    };
    gl.bindFramebuffer(gl.FRAMEBUFFER, map.frame);
    for (let level = 1; level < MAP_LEVELS; level++) {
      // What is read is never what is drawn into: of the second moments level 1 reads nothing, but some level must be named.
      levels("lean_mean_texture", level - 1, level - 1);
      levels("lean_square_texture", level === 1 ? 1 : level - 2, level === 1 ? 1 : level - 2);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, map.mean, level);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT1, gl.TEXTURE_2D, map.square, level - 1);
      gl.drawBuffers([gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1]);
      gl.viewport(0, 0, MAP_SIZE >> level, MAP_SIZE >> level);
      gl.uniform1i(this.place(entry, "level"), level);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    levels("lean_mean_texture", 0, MAP_LEVELS - 1);
    levels("lean_square_texture", 0, MAP_LEVELS - 2);
    map.key = key;
    return true;
  }

  // Adds history.current to `history`, { current, pictures: two targets, frames }; the picture is then history.pictures[0].
  async blend(history) {
    const gl = this.gl, entry = await this.compiled(this.program("blend.frag", "", "", ""));
    gl.useProgram(entry.program);
    this.bind("current_texture", history.current.texture);
    this.bind("history_texture", history.pictures[0].texture);
    gl.uniform1f(this.place(entry, "weight"), history.frames === 0 ? 1 : Math.max(1 / (history.frames + 1), 0.1));
    this.fill(entry, history.pictures[1]);
    history.pictures.reverse();
    history.frames++;
  }

  copy(from, to) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, from.frame);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, to.frame);
    gl.blitFramebuffer(0, 0, from.width, from.height, 0, 0, to.width, to.height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }

  history(width, height) {
    return { current: this.target(width, height), pictures: [this.target(width, height), this.target(width, height)], frames: 0 };
  }

  // Shows one picture, or two of the same size: the first in the left `fraction` of the canvas, stretched over it. The program must have been compiled.
  show(first, second = first, fraction = 1) {
    const { gl, canvas } = this, { width, height } = first, entry = this.program("display.frag", "", "", "");
    gl.useProgram(entry.program);
    this.bind("first_texture", first.texture);
    this.bind("second_texture", second.texture);
    gl.uniform1i(this.place(entry, "wipe"), Math.round(fraction * width));
    gl.uniform2f(this.place(entry, "texels"), width / canvas.width, height / canvas.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  read(target) {
    const pixels = new Float32Array(4 * target.width * target.height);
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, target.frame);
    this.gl.readPixels(0, 0, target.width, target.height, this.gl.RGBA, this.gl.FLOAT, pixels);
    return pixels;
  }
}

const TEXTURES = ["sky_texture", "tile_texture", "list_texture", "search_texture", "hit_texture", "wave_texture", "foam_texture", "skyline_texture", "first_texture", "second_texture",
  "current_texture", "history_texture", "lean_mean_texture", "lean_square_texture"];

function halton(index, base) {
  let value = 0;
  for (let part = 1 / base; index > 0; part /= base, index = Math.floor(index / base)) value += part * (index % base);
  return value;
}

// Where frame `index` of taa looks, in pixels from the centre.
function taaOffset(index) { return [halton(index + 1, 2) - 0.5, halton(index + 1, 3) - 0.5]; }
