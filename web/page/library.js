// SPDX-License-Identifier: MIT
// The library as WebAssembly, and workers that call it.

const pause = milliseconds => new Promise(resolve => setTimeout(resolve, milliseconds));

// The bytes of a text in base 85: five DIGITS for four bytes, the highest first; r bytes that are left at the end are r + 1 digits.
function bytesOf(text) {
  const worth = new Uint8Array(128), words = new DataView(new ArrayBuffer(4 * Math.ceil(text.length / 5)));
  Array.from(DIGITS, (digit, i) => { worth[digit.charCodeAt(0)] = i; });
  for (let at = 0; 5 * at < text.length; at++) {
    let word = 0;
    for (let i = 5 * at; i < 5 * at + 5; i++) word = 85 * word + (i < text.length ? worth[text.charCodeAt(i)] : 84);
    words.setUint32(4 * at, word);
  }
  return new Uint8Array(words.buffer, 0, Math.floor(4 * text.length / 5));
}

async function unpacked() {
  const stream = new Blob([bytesOf(PACKED)]).stream().pipeThrough(new DecompressionStream("gzip"));
  const all = await new Response(stream).arrayBuffer();
  const length = new DataView(all).getUint32(0, true);
  return { texts: JSON.parse(new TextDecoder().decode(new Uint8Array(all, 4, length))), module: await WebAssembly.compile(all.slice(4 + length)) };
}

// A point one metre ahead of the camera, in the decimals that commands have.
function cameraTarget(s) {
  const pitch = s.pitch * Math.PI / 180, heading = s.heading * Math.PI / 180;
  const ahead = [Math.sin(heading) * Math.cos(pitch), Math.sin(pitch), -Math.cos(heading) * Math.cos(pitch)];
  return ahead.map((v, i) => Number(((i === 1 ? s.height : 0) + v).toFixed(5)));
}

// One copy of the library, with a scene of its own. Workers have the text of this function.
async function openLibrary(module) {
  const nothing = () => 0;
  const instance = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: { fd_close: nothing, fd_seek: nothing, fd_write: nothing } });
  const calls = instance.exports, numbers = {};
  calls._initialize();
  const take = settings => {
    new Float64Array(calls.memory.buffer, calls.settings(), SETTINGS.length).set(SETTINGS.map(s => settings[s.name]));
    new Float64Array(calls.memory.buffer, calls.target(), 3).set(cameraTarget(settings));
  };
  const check = (good, { wind, fetch }) => {
    const allowed = "a longer fetch, or 0 for a fully developed sea";
    if (!good) throw new Error(`no sea has a wind of ${wind} m/s over a fetch of ${fetch} km; allowed: ${allowed}`);
  };
  return {
    calls,
    copy: (Type, at, count) => new Type(calls.memory.buffer.slice(at, at + count * Type.BYTES_PER_ELEMENT)),
    method(name) {
      if (!(name in numbers)) {
        const text = new TextEncoder().encode(name + "\0"), at = calls.take(text.length);
        new Uint8Array(calls.memory.buffer, at, text.length).set(text);
        numbers[name] = calls.method_number(at);
        calls.give(at);
      }
      return numbers[name];
    },
    // Both throw where there is no such sea; the one before stays.
    checkSea(settings) { take(settings); check(calls.take_sea() >= 0, settings); },
    update(settings) { take(settings); check(calls.update() >= 0, settings); },
  };
}

// Where workers may not be started, their tasks are done here, between the page's own. `tasks` is a function that makes what takes a task from what posts an answer.
class TaskWorker {
  constructor(module, tasks) {
    this.waiting = [];
    const answered = answer => { if (!this.ended) this.waiting.shift().resolve(answer); };
    const here = () => {
      const take = tasks(answered);
      this.post = task => setTimeout(() => take(task));
      this.waiting.forEach(w => this.post(w.task));
    };
    try {
      const text = `const SETTINGS = ${JSON.stringify(SETTINGS)}, TILE_ROWS = ${TILE_ROWS}, TILE_COLUMNS = ${TILE_COLUMNS}, MAP_SIZE = ${MAP_SIZE};\n${cameraTarget}\n${openLibrary}\n${tasks}\nconst take = ${tasks.name}((answer, moved) => postMessage(answer, moved));\nonmessage = e => take(e.data);`;
      const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" })), worker = this.worker = new Worker(address);
      worker.onmessage = event => { URL.revokeObjectURL(address); answered(event.data); };
      worker.onerror = event => { event.preventDefault(); if (!this.ended) here(); };
      this.post = task => worker.postMessage(task);
    } catch {
      here();
    }
    this.ask({ module }).catch(() => {}); // the next task tells
  }

  // What has been asked for, and will be, rejects.
  end() {
    this.ended = true;
    if (this.worker) this.worker.terminate();
    this.waiting.splice(0).forEach(w => w.reject(new Error("the worker has been ended")));
  }

  // Resolves to the task's answer. Rejects with what is wrong.
  ask(task) {
    return new Promise((resolve, reject) => {
      if (this.ended) throw new Error("the worker has been ended");
      this.waiting.push({ task, reject, resolve: answer => (answer.wrong ? reject(new Error(answer.wrong)) : resolve(answer)) });
      this.post(task);
    });
  }
}
