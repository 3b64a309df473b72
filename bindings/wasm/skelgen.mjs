// The package's front door: loads the WebAssembly and makes of its answers values, or errors with codes.
import makeCore from "./core.mjs";

/// What is wrong, in `message`; what to do about it follows from `code`.
export class SkelgenError extends Error {
  constructor({ code, message, refusal, trail }) {
    super(message);
    this.name = "SkelgenError";
    this.code = code;
    this.refusal = refusal ?? null;
    this.trail = trail ? JSON.parse(trail).tried : [];
  }
}

const fail = (code, message) => {
  throw new SkelgenError({ code, message });
};

const mostBytes = 2 ** 30; // a file and its mesh have to have room in 4 GiB
const mostFaces = 20e6;

const megabytes = (bytes) => `${Math.round(bytes / 2 ** 20)} MB`;

function refuseSize(bytes) {
  if (bytes > mostBytes)
    fail("bad_input", `has ${megabytes(bytes)}, and ${megabytes(mostBytes)} is the most; simplify the mesh first`);
}

/// What a file compressed by gzip holds; no more than may be.
async function unpacked(bytes) {
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes;
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")).getReader();
  const pieces = [];
  let size = 0;
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      refuseSize((size += value.length));
      pieces.push(value);
    }
  } catch (error) {
    if (error instanceof SkelgenError) throw error;
    fail("bad_input", "is no sound gzip file; pack it again, or unpack it first");
  }
  const all = new Uint8Array(size);
  let place = 0;
  for (const piece of pieces) {
    all.set(piece, place);
    place += piece.length;
  }
  return all;
}

const isBlob = (value) => typeof Blob === "function" && value instanceof Blob;

async function bytesOf(content) {
  if (isBlob(content)) {
    refuseSize(content.size);
    try {
      return new Uint8Array(await content.arrayBuffer());
    } catch {
      return fail("bad_input", "cannot be read: it was moved or changed, or is too large for this machine");
    }
  }
  if (content instanceof ArrayBuffer) return new Uint8Array(content);
  if (ArrayBuffer.isView(content)) return new Uint8Array(content.buffer, content.byteOffset, content.byteLength);
  if (typeof content === "string") return new TextEncoder().encode(content);
  return fail("usage", "a file's content is a Blob, an ArrayBuffer, a typed array or text");
}

/// A file's name without what leads to it, or below its folder.
const plainName = (name) => name.split(/[\\/]/).pop().replace(/^\.+$/, "") || "mesh";
const belowFolder = (name) => name.split(/[\\/]/).filter((part) => part && part !== "." && part !== "..").join("/");

function requireArrays({ positions, faces }) {
  if (!ArrayBuffer.isView(positions) || !ArrayBuffer.isView(faces))
    fail("usage", "a mesh is {positions, faces}, typed arrays, or a file as {name, bytes}, or a File");
  if (positions.length % 3 !== 0 || faces.length % 3 !== 0)
    fail("usage", "positions and faces have three entries for each vertex and each face");
  if (faces.length / 3 > mostFaces) fail("bad_input", `has more than ${mostFaces / 1e6} million faces; simplify it first`);
  const vertices = positions.length / 3;
  for (const index of faces) if (!(index < vertices && index >= 0)) fail("bad_input", `a face names vertex ${index}, and there are ${vertices}`);
  for (const value of positions) if (!Number.isFinite(value)) fail("bad_input", "a coordinate is no finite number");
}

/// Bytes of the .wasm, or a compiled module, from where it lies: beside this file, unless told otherwise.
async function compiled(wasm) {
  if (wasm instanceof WebAssembly.Module) return wasm;
  if (wasm instanceof ArrayBuffer || ArrayBuffer.isView(wasm)) return WebAssembly.compile(wasm);
  const url = new URL(wasm ?? new URL("./skelgen.wasm", import.meta.url));
  if (url.protocol === "file:" && typeof process === "object") {
    const files = "node:fs/promises"; // a name that bundlers for pages do not look for
    return WebAssembly.compile(await (await import(files)).readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) fail("internal", `${url} cannot be had: ${response.status}`);
  return response.headers.get("Content-Type")?.startsWith("application/wasm")
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}

/// What holds memory of the WebAssembly until `delete()`, or the end of a `using` block.
class Handle {
  constructor(owner, native) {
    this.owner = owner;
    this.native = native;
  }
  delete() {
    if (this.native && !this.owner.crashed) this.native.delete();
    this.native = null;
  }
  /// \returns what a function of the native object answers.
  ask(name, ...values) {
    if (!this.native) fail("usage", `this ${this.constructor.name} was deleted`);
    return this.owner.ask(this.native, name, ...values);
  }
}
if (Symbol.dispose) Handle.prototype[Symbol.dispose] = Handle.prototype.delete;

const formats = ["glb", "vrm", "fbx", "bvh"];

/// A mesh bound to joints.
export class Rig extends Handle {
  constructor(owner, native, { name, rest }) {
    super(owner, native);
    this.name = name;
    this.rest = rest;
  }
  get joints() {
    return this.ask("joints").map((joint) => ({
      ...joint, position: [...joint.position], end: [...joint.end], motion: joint.motion ? [...joint.motion] : null,
    }));
  }
  get positions() {
    return this.ask("positions");
  }
  get faces() {
    return this.ask("faces");
  }
  get skinJoints() {
    return this.ask("skinJoints");
  }
  get skinWeights() {
    return this.ask("skinWeights");
  }
  get metresPerUnit() {
    return this.ask("metresPerUnit");
  }
  get unitIsKnown() {
    return this.ask("unitIsKnown");
  }
  get hasLooks() {
    return this.ask("hasLooks");
  }
  /// What is to be said of looks and licence, a sentence each.
  get warnings() {
    const forbidden = this.ask("forbidden");
    return [
      this.ask("lostLooks"),
      forbidden && `its licence forbids ${forbidden}: ask its authors before you use or pass on what is made of it`,
    ].filter(Boolean);
  }
  /// The rig as a file; with what it was made to `follow` where animations are wanted.
  file(format, { names = "skelgen", animations = true } = {}) {
    if (!formats.includes(format)) fail("usage", `format: '${format}' is none of ${formats.join(", ")}`);
    const stem = this.name.replace(/(\.gz)?$/i, "").replace(/\.[^.]*$/, "") || "body";
    return this.ask("file", format, names, stem, animations).bytes;
  }
  /// Has it move as the skeleton of a BVH file does; the animation is in the files that are made from now on.
  async follow(clip, name = "clip") {
    const bytes = await unpacked(await bytesOf(clip));
    return this.owner.withFiles({ "clip.bvh": bytes }, (folder) => void this.ask("follow", `${folder}/clip.bvh`, name));
  }
}

/// A body that was found in a mesh.
export class Body extends Handle {
  constructor(owner, native, mesh, { name, component }) {
    super(owner, native);
    this.mesh = mesh;
    this.name = name;
    this.component = component;
  }
  /// As the skeleton's file has it.
  get skeleton() {
    return (this.read ??= JSON.parse(this.ask("skeletonJson")));
  }
  get joints() {
    return this.skeleton.joints;
  }
  get frame() {
    return this.skeleton.frame;
  }
  get quality() {
    return this.skeleton.quality;
  }
  /// What was tried, in order.
  get trail() {
    return JSON.parse(this.ask("trailJson")).tried;
  }
  get repairs() {
    return this.ask("repairs");
  }
  get positions() {
    return this.mesh.ask("positions");
  }
  get faces() {
    return this.mesh.ask("faces");
  }
  /// Empty unless it was asked for.
  get curve() {
    return this.ask("curve");
  }
  /// The text of the skeleton's file.
  toJSONText() {
    return this.ask("skeletonJson");
  }
  segment({ parts = "bones" } = {}) {
    return this.ask("segment", parts);
  }
  measure() {
    const { bodies } = JSON.parse(this.ask("measure").json);
    return bodies[0];
  }
  rig(options = {}) {
    const { character } = this.ask("rig", options);
    return new Rig(this.owner, character, { name: this.name, rest: options.rest ?? "as-is" });
  }
  /// The same mesh with a skeleton that was put right: the object, or the text, of its file.
  fit(skeleton, { fingers = "off", toes = false, component = this.component } = {}) {
    const text = typeof skeleton === "string" ? skeleton : JSON.stringify(skeleton);
    const options = { fingers, toes, component };
    return this.owner.madeBody(this.name, options, this.mesh, (native) =>
      this.owner.ask(native, "fit", this.mesh.native, text, options));
  }
  delete() {
    super.delete();
    this.mesh?.release();
    this.mesh = null;
  }
}

/// A mesh that several bodies may be found in; the last of them lets go of it.
class Mesh extends Handle {
  users = 1;
  share() {
    ++this.users;
    return this;
  }
  release() {
    if (--this.users === 0) this.delete();
  }
  get glb() {
    return this.ask("glb").bytes;
  }
}

/// One WebAssembly with its memory.
export class Skelgen {
  static async load({ wasm } = {}) {
    const module = await compiled(wasm);
    const core = await makeCore({
      instantiateWasm: (imports, done) => {
        WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
        return {};
      },
      print: () => {},
      printErr: () => {},
    });
    return new Skelgen(core);
  }

  constructor(core) {
    this.core = core;
    this.crashed = false;
    this.folders = 0;
    this.version = core.version();
    this.jointNames = core.jointNames().split(" ");
  }

  /// What a native function answers. What brings the WebAssembly to a halt is the last that it does.
  ask(native, name, ...values) {
    if (this.crashed) fail("internal", "it has crashed before; load it anew");
    let answer;
    try {
      answer = native[name](...values);
    } catch (error) {
      this.crashed = true;
      const isRoom = error instanceof RangeError || /memory|stack/i.test(String(error?.message));
      return fail(isRoom ? "out_of_memory" : "internal",
        isRoom ? "needs more room than there is; simplify the mesh first" : `a fault of skelgen's own, please report it: ${error?.message ?? error}`);
    }
    if (answer?.error) throw new SkelgenError(answer.error);
    return answer;
  }

  /// Puts files into a folder of their own as long as `work` needs them.
  withFiles(files, work) {
    const { FS } = this.core;
    const folder = `/in${++this.folders}`;
    FS.mkdir(folder);
    const made = [];
    try {
      for (const [name, bytes] of Object.entries(files)) {
        const parts = belowFolder(name).split("/");
        for (let depth = 1; depth < parts.length; ++depth) {
          const below = `${folder}/${parts.slice(0, depth).join("/")}`;
          if (!FS.analyzePath(below).exists) FS.mkdir(below);
        }
        const path = `${folder}/${parts.join("/")}`;
        FS.writeFile(path, bytes, { canOwn: true });
        made.push(path);
      }
      return work(folder);
    } finally {
      for (const path of made) FS.unlink(path);
      const clear = (path) => {
        for (const name of FS.readdir(path)) if (name !== "." && name !== "..") clear(`${path}/${name}`);
        FS.rmdir(path);
      };
      clear(folder);
    }
  }

  /// A mesh of typed arrays, of a file, or of a body that was found before.
  async mesh(input) {
    if (input instanceof Body) return { mesh: input.mesh.share(), name: input.name };
    if (isBlob(input)) input = { name: input.name, bytes: input };
    if (input?.bytes === undefined) {
      requireArrays(input ?? {});
      const mesh = new Mesh(this, new this.core.Mesh(""));
      return this.orDeleted(mesh, () => mesh.ask("take", input.positions, input.faces), plainName(input.name ?? "mesh"));
    }
    const name = plainName(input.name ?? "mesh");
    const bytes = await unpacked(await bytesOf(input.bytes));
    if (bytes.length === 0) fail("bad_input", "is empty; export it again");
    const files = {};
    for (const [other, content] of Object.entries(input.files ?? {})) files[other] = await bytesOf(content);
    files[name] = bytes;
    return this.withFiles(files, (folder) => {
      const mesh = new Mesh(this, new this.core.Mesh(`${folder}/${name}`));
      return this.orDeleted(mesh, () => mesh.ask("read"), name);
    });
  }

  orDeleted(mesh, work, name) {
    try {
      work();
    } catch (error) {
      mesh.delete();
      throw error;
    }
    return { mesh, name };
  }

  madeBody(name, options, mesh, work) {
    const native = new this.core.FoundBody(name);
    try {
      work(native);
    } catch (error) {
      if (!this.crashed) native.delete();
      throw error;
    }
    return new Body(this, native, mesh.share(), { name, component: options.component ?? 0 });
  }

  async read(input) {
    const { mesh } = await this.mesh(input);
    try {
      return { positions: mesh.ask("positions"), faces: mesh.ask("faces") };
    } finally {
      mesh.release();
    }
  }

  /// Finds the body in a mesh. `options.progress(spent, budget)` is called before each try; the search ends where it
  /// returns false, `options.signal` is aborted, or `options.flag` (an Int32Array of shared memory) is not 0.
  async extract(input, options = {}) {
    const { mesh, name } = await this.mesh(input);
    try {
      return this.found(mesh, name, options);
    } finally {
      mesh.release();
    }
  }

  found(mesh, name, options) {
    const { progress, signal, flag, ...rest } = options;
    const isEnded = (spent, budget) =>
      Boolean((flag && Atomics.load(flag, 0) !== 0) || signal?.aborted || progress?.(spent, budget) === false);
    return this.madeBody(name, rest, mesh, (native) => this.ask(native, "find", mesh.native, rest, isEnded));
  }

  /// From a mesh to what is made of its body, in one step.
  async once(input, options, use) {
    const body = await this.extract(input, options);
    try {
      return use(body);
    } finally {
      body.delete();
    }
  }

  /// The mesh bound to its skeleton, as a file of `options.format`.
  rig(input, { format = "glb", names, ...options } = {}) {
    return this.once(input, { ...options, fingers: "off", toes: false }, (body) => {
      const rig = body.rig({ ...options, rest: options.rest ?? (format === "vrm" ? "t-pose" : "as-is") });
      try {
        return rig.file(format, { names });
      } finally {
        rig.delete();
      }
    });
  }

  segment(input, options = {}) {
    return this.once(input, options, (body) => body.segment(options));
  }

  measure(input, options = {}) {
    return this.once(input, options, (body) => body.measure());
  }
}

let shared = null;

/// The one that the functions below use; a new one where that has crashed.
export async function load(options) {
  if (options) return Skelgen.load(options);
  if (shared && (await shared).crashed) shared = null;
  shared ??= Skelgen.load().catch((error) => {
    shared = null;
    throw error;
  });
  return shared;
}

export const read = async (input) => (await load()).read(input);
export const extract = async (input, options) => (await load()).extract(input, options);
export const rig = async (input, options) => (await load()).rig(input, options);
export const segment = async (input, options) => (await load()).segment(input, options);
export const measure = async (input, options) => (await load()).measure(input, options);
