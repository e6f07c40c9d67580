// SPDX-License-Identifier: MIT
// The library as WebAssembly, and its kernels as WebGL2 programs: scenes from settings, pictures of a method into textures, textures to the canvas.

const DATA_WIDTH = 1024; // texels of a row, as in web_data.glsl
const METHODS = {
  none: { about: "one sample at the pixel's centre", program: ["points.frag"] },
  "ggx-moments": { about: "as in game engines: GGX of the slopes' moments", program: ["slopes.frag", "kernels/baselines/ggx_moments.k", "ggx_moments_result"] },
  bruneton: { about: "Bruneton et al. 2010: Gaussian slopes", program: ["slopes.frag", "kernels/baselines/bruneton.k", "bruneton_result"] },
  taa: { about: "temporal anti-aliasing: eight frames of none", program: ["points.frag"], blends: true },
  mangata: { about: "this library's closed form", program: ["slopes.frag", "kernels/glitter/glitter.k", "glitter_result"] },
};
// As src/frame/whole_frame.h has them: frames of taa, and where in the pixel each looks (Halton 2, 3).
const TAA_FRAMES = 8;

async function unpacked() {
  const bytes = Uint8Array.from(atob(PACKED), c => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const all = await new Response(stream).arrayBuffer();
  const length = new DataView(all).getUint32(0, true);
  return { texts: JSON.parse(new TextDecoder().decode(new Uint8Array(all, 4, length))), code: all.slice(4 + length) };
}

// One thread's copy of the library.
async function openLibrary(module) {
  const nothing = () => 0;
  const instance = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: { fd_close: nothing, fd_seek: nothing, fd_write: nothing } });
  const calls = instance.exports;
  calls._initialize();
  const library = { calls, numbers: {} };
  library.bytes = (at, size) => new Uint8Array(calls.memory.buffer, at, size);
  library.floats = (at, count) => new Float32Array(calls.memory.buffer, at, count);
  library.method = name => {
    if (!(name in library.numbers)) {
      const text = new TextEncoder().encode(name + "\0");
      const at = calls.take(text.length);
      library.bytes(at, text.length).set(text);
      library.numbers[name] = calls.method_number(at);
    }
    return library.numbers[name];
  };
  // Bits: 1 the sky has changed, 2 the sea has. Below 0: there is no such sea, and the one before stays.
  library.update = settings => {
    new Float64Array(calls.memory.buffer, calls.settings(), SETTINGS.length).set(SETTINGS.map(s => settings[s.name]));
    new Float64Array(calls.memory.buffer, calls.target(), 3).set(cameraTarget(settings));
    return calls.update();
  };
  return library;
}

// A point one metre ahead of the camera, in the decimals that commands have.
function cameraTarget(s) {
  const pitch = s.pitch * Math.PI / 180, heading = s.heading * Math.PI / 180;
  const ahead = [Math.sin(heading) * Math.cos(pitch), Math.sin(pitch), -Math.cos(heading) * Math.cos(pitch)];
  return ahead.map((v, i) => Number(((i === 1 ? s.height : 0) + v).toFixed(5)));
}

class Engine {
  // Throws a text where the canvas has no WebGL2 that can draw this.
  constructor(canvas, library, texts) {
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, alpha: false, preserveDrawingBuffer: true, powerPreference: "high-performance" });
    if (!gl) throw new Error("this browser has no WebGL2");
    if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("its WebGL2 cannot draw into floating-point pictures");
    Object.assign(this, { canvas, library, texts, gl, programs: new Map(), buffers: {}, textures: {}, times: {} });
    this.parallel = gl.getExtension("KHR_parallel_shader_compile");
    this.inBlock = gl.getParameter(gl.MAX_UNIFORM_BLOCK_SIZE) >= 512 * 96;
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
    const head = "#version 300 es\n" + defines + (result ? `#define method_result ${result}\n` : "") + (this.inBlock ? "#define WAVES_IN_BLOCK 512\n" : "");
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
    ["FrameBlock", "FoamBlock", "WaveBlock"].forEach((block, i) => {
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

  methodProgram(name) {
    const { program: [file, kernel, result] } = METHODS[name];
    const defines = (this.choppy ? "#define CHOPPY_WATER\n" : "") + (this.foamy ? "#define FOAMY_WATER\n" : "");
    return this.program(file, kernel || "", result, defines);
  }

  // ---- data ----

  block(name, index, bytes, at) {
    const gl = this.gl;
    const buffer = this.buffers[name] = this.buffers[name] || gl.createBuffer();
    gl.bindBuffer(gl.UNIFORM_BUFFER, buffer);
    gl.bufferData(gl.UNIFORM_BUFFER, this.library.bytes(at, bytes), gl.STREAM_DRAW);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, index, buffer);
  }

  bind(name, texture) {
    this.gl.activeTexture(this.gl.TEXTURE0 + TEXTURES.indexOf(name));
    this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
  }

  newTexture(name, format, width, height) {
    const gl = this.gl, texture = gl.createTexture();
    this.bind(name, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
    return texture;
  }

  // Texels of four numbers each, in rows of DATA_WIDTH.
  data(name, at, texels, whole) {
    const gl = this.gl, rows = Math.max(1, Math.ceil(texels / DATA_WIDTH));
    let entry = this.textures[name];
    if (!entry || entry.rows < rows) {
      if (entry) gl.deleteTexture(entry.texture);
      const room = Math.ceil(rows * 1.5);
      entry = this.textures[name] = { rows: room, texture: this.newTexture(name, whole ? gl.RGBA32UI : gl.RGBA32F, DATA_WIDTH, room) };
    }
    this.bind(name, entry.texture);
    const full = Math.floor(texels / DATA_WIDTH), rest = texels % DATA_WIDTH, buffer = this.library.calls.memory.buffer;
    const put = (row, width, height, from) => {
      const numbers = 4 * width * height, start = at + 16 * from;
      const view = whole ? new Uint32Array(buffer, start, numbers) : new Float32Array(buffer, start, numbers);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, width, height, whole ? gl.RGBA_INTEGER : gl.RGBA, whole ? gl.UNSIGNED_INT : gl.FLOAT, view);
    };
    if (full > 0) put(0, DATA_WIDTH, full, 0);
    if (rest > 0) put(full, rest, 1, full * DATA_WIDTH);
  }

  // Takes the settings. As library.update().
  update(settings) {
    const gl = this.gl, changed = this.library.update(settings);
    this.time = settings.time;
    this.choppy = settings.choppiness > 0;
    this.foamy = this.choppy && settings.foam > 0;
    if (changed > 0 && changed & 1) {
      const columns = 192, rows = 129;
      if (!this.sky) this.sky = this.newTexture("sky_texture", gl.RGB32F, columns, rows);
      this.bind("sky_texture", this.sky);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, columns, rows, gl.RGB, gl.FLOAT, this.library.floats(this.library.calls.sky_table(), 3 * columns * rows));
    }
    return changed;
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

  // Uploads what the shaders read of a picture; `jitter` in pixels, `sorted` false: every wave counts in every tile.
  prepare(method, width, height, jitter = [0, 0], sorted = true) {
    const gl = this.gl, calls = this.library.calls, start = performance.now();
    const at = calls.prepare(this.library.method(method), width, height, jitter[0], jitter[1], sorted ? 1 : 0);
    const [frame, waves, foam, tiles, lists, searched, hits, waveCount, hasFoam, choppy, columns, rows, listCount, searchCount, hitCount] =
      new Int32Array(calls.memory.buffer, at, 15);
    this.times.prepare = performance.now() - start;
    this.foamy = hasFoam !== 0;
    this.choppy = choppy !== 0;
    this.block("frame", 0, calls.frame_bytes(), frame);
    if (hasFoam) {
      this.block("foam", 1, calls.foam_bytes(), foam);
      this.data("foam_texture", foam + calls.foam_bytes(), 6 * waveCount);
    }
    if (this.inBlock) this.block("waves", 2, 512 * 96, waves);
    else this.data("wave_texture", waves, 6 * waveCount);
    this.data("tile_texture", tiles, columns * rows * calls.tile_bytes() / 16, true);
    this.data("list_texture", lists, listCount);
    this.data("search_texture", searched, 2 * searchCount);
    this.data("hit_texture", hits, 2 * hitCount);
    this.columns = columns;
    this.times.upload = performance.now() - start - this.times.prepare;
  }

  // Draws with a program that reads the prepared data. False while it is compiled.
  shade(entry, target) {
    const gl = this.gl;
    if (!this.isReady(entry)) return false;
    gl.useProgram(entry.program);
    gl.uniform2i(this.place(entry, "tile_grid"), this.columns, target.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.viewport(0, 0, target.width, target.height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    return true;
  }

  // A picture of the scene by a method that needs no history. False while its program is compiled.
  draw(method, target, options = {}) {
    if (!this.isReady(this.methodProgram(method))) return false; // nothing is uploaded in vain: drivers would queue it
    this.prepare(method, target.width, target.height, options.jitter, options.sorted !== false);
    this.bind("sky_texture", this.sky);
    return this.shade(this.methodProgram(method), target);
  }

  // The next frame of taa into `history`, { current, pictures: two targets, frames }; the picture is then history.pictures[0].
  blend(history) {
    const gl = this.gl, index = history.frames % TAA_FRAMES, width = history.current.width, height = history.current.height;
    const entry = this.program("blend.frag", "", "", "");
    if (!this.isReady(entry) || !this.draw("taa", history.current, { jitter: taaOffset(index) })) return false;
    gl.useProgram(entry.program);
    this.bind("current_texture", history.current.texture);
    this.bind("history_texture", history.pictures[0].texture);
    gl.uniform1f(this.place(entry, "share"), history.frames === 0 ? 1 : Math.max(1 / (history.frames + 1), 0.1));
    gl.bindFramebuffer(gl.FRAMEBUFFER, history.pictures[1].frame);
    gl.viewport(0, 0, width, height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    history.pictures.reverse();
    history.frames++;
    return true;
  }

  history(width, height) {
    return { current: this.target(width, height), pictures: [this.target(width, height), this.target(width, height)], frames: 0 };
  }

  // Shows one picture, or two with a wipe at this column of the canvas.
  show(first, second, wipe) {
    const gl = this.gl, entry = this.program("display.frag", "", "", "");
    if (!this.isReady(entry)) return false;
    gl.useProgram(entry.program);
    this.bind("first_texture", first.texture);
    this.bind("second_texture", (second || first).texture);
    gl.uniform2f(this.place(entry, "window"), this.canvas.width, this.canvas.height);
    gl.uniform1f(this.place(entry, "wipe"), second ? wipe : -1);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    return true;
  }

  read(target) {
    const pixels = new Float32Array(4 * target.width * target.height);
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, target.frame);
    this.gl.readPixels(0, 0, target.width, target.height, this.gl.RGBA, this.gl.FLOAT, pixels);
    return pixels;
  }
}

const TEXTURES = ["sky_texture", "tile_texture", "list_texture", "search_texture", "hit_texture", "wave_texture", "foam_texture", "first_texture", "second_texture",
  "current_texture", "history_texture"];

function halton(index, base) {
  let value = 0;
  for (let part = 1 / base; index > 0; part /= base, index = Math.floor(index / base)) value += part * (index % base);
  return value;
}

// Where frame `index` of taa looks, in pixels from the centre.
function taaOffset(index) { return [halton(index + 1, 2) - 0.5, halton(index + 1, 3) - 0.5]; }
