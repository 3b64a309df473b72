// The page: takes files, has the worker find the body in them, shows it and gives it away rigged.
import { RemoteMesh, SkelgenWorker, SkelgenError } from "../../bindings/wasm/remote.mjs";
import { kinds_of_digits } from "../view/digits.mjs";
import { Figure } from "../view/figure.mjs";
import { Stage } from "../view/stage.mjs";
import { Viewer } from "./viewer.mjs";
import { percent, sentence, told_confidence, told_error, told_joint, told_try } from "./words.mjs";

const element = (id) => document.getElementById(id);
const here = (path) => new URL(path, document.baseURI);
const readable = ["glb", "vrm", "gltf", "obj", "ply", "stl", "off"];
const shown_faces = 3e6; // of a mesh that has no skeleton yet; more takes a browser too long

function put(parent, tag, text) {
  const made = document.createElement(tag);
  made.textContent = text;
  parent.append(made);
  return made;
}

const extension = (name) => name.replace(/\.gz$/i, "").split(".").pop().toLowerCase();
const stem = (name) => name.replace(/\.gz$/i, "").replace(/\.[^.]+$/, "") || "body";
const name_of_conventions = {
  skelgen: "skelgen", smpl: "SMPL", smplx: "SMPL-X", mixamo: "Mixamo", vrm: "VRM", unity: "Unity", godot: "Godot", unreal: "Unreal", rigify: "Rigify",
};

/// What the page is at. Whatever is begun ends what was begun before.
class App {
  worker = new SkelgenWorker({ worker: here("worker.js"), wasm: here("skelgen.wasm").href });
  job = null; // what is being done, to be ended
  mesh = null; // in the worker
  body = null;
  rig = null;
  viewer = null;
  clips = []; // names and contents of the motions that were dropped
  before = []; // skeletons before joints were moved

  constructor() {
    this.stage = new Stage(element("canvas"), (seconds) => this.viewer?.before_frame(seconds) ?? false);
    this.listen();
    this.say_ready();
  }

  async say_ready() {
    document.body.dataset.state = "ready";
    try {
      await this.worker.start();
      for (const name of this.worker.jointNames) put(element("names"), "option", name_of_conventions[name] ?? name).value = name;
      this.walk = await (await fetch(here("walk.bvh"))).text();
      document.body.dataset.worker = "ready";
    } catch (error) {
      this.refuse("this page", error);
    }
  }

  // ---- what is going on ----

  state(state, text) {
    document.body.dataset.state = state;
    element("busy").hidden = state !== "busy";
    if (state === "busy") this.busy(text);
    if (text) element("status").textContent = text;
  }
  busy(text, part = null) {
    element("busy-text").textContent = text;
    if (part === null) element("progress").removeAttribute("value");
    else element("progress").value = part;
  }

  /// Does `work` with a signal that ends it, unless something else is begun before.
  async begin(name, text, work) {
    this.job?.abort();
    const job = (this.job = new AbortController());
    this.state("busy", text);
    try {
      await work(job.signal);
      if (this.job === job) this.state(this.viewer ? "shown" : "ready");
    } catch (error) {
      if (this.job !== job) return; // nobody waits for it
      if (error?.code === "cancelled") this.reset();
      else this.refuse(name, error);
    } finally {
      if (this.job === job) this.job = null;
    }
  }

  cancel() {
    this.job?.abort();
    this.job = null;
    this.reset();
    this.state("ready", "Cancelled.");
  }

  /// As at the beginning.
  reset() {
    this.forget();
    element("welcome").hidden = false;
    element("side").hidden = true;
    element("legend").hidden = true;
    this.state("ready");
  }

  forget() {
    this.viewer?.dispose();
    this.viewer = null;
    for (const thing of [this.rig, this.body, ...this.before, this.mesh]) thing?.delete();
    this.rig = this.body = this.mesh = null;
    this.before = [];
    element("controls").replaceChildren();
  }

  refuse(name, error) {
    const known = error instanceof SkelgenError ? error : { code: "internal", message: error?.message ?? String(error) };
    const { title, reason, advice } = told_error(name, known);
    element("welcome").hidden = this.viewer !== null;
    for (const id of ["result", "made"]) element(id).hidden = true;
    element("side").hidden = element("refused").hidden = false;
    element("legend").hidden = true;
    element("refused-title").textContent = title;
    element("refused-reason").textContent = reason;
    element("refused-advice").textContent = advice;
    this.show_trail(known.trail ?? []);
    this.offer_components(known);
    this.state("refused", `${title}. ${reason} ${advice}`);
  }

  /// Where several bodies stand apart each can be chosen; the message says how many there are.
  offer_components({ refusal, message }) {
    const box = element("components");
    box.replaceChildren();
    const count = refusal === "several_bodies" ? Math.min(Number(/\d+/.exec(message)?.[0] ?? 2), 12) : 0;
    box.hidden = count === 0 || !this.mesh;
    for (let number = 1; number <= count; ++number)
      put(box, "button", number === 1 ? "The largest" : `Number ${number}`).addEventListener("click", () => this.find(this.mesh.name, number));
  }

  // ---- from files to a body ----

  /// Files that were dropped or chosen: a mesh with what belongs to it, or a motion, or a skeleton, for the body there is.
  take(files) {
    files = [...files];
    if (files.length === 0) return;
    const of = (wanted) => files.find(({ name }) => extension(name) === wanted);
    const main = readable.map(of).find(Boolean);
    if (!main && this.rig && of("bvh")) return this.add_clip(of("bvh"));
    if (!main && this.body && of("json")) return this.take_skeleton(of("json"));
    this.open(main ?? files[0], main ? files.filter((file) => file !== main) : []);
  }

  open(file, others = []) {
    const name = file.name ?? "mesh";
    return this.begin(name, `Reading ${name}…`, async (signal) => {
      this.forget();
      this.clips = [];
      if (["fbx", "dae"].includes(extension(name)))
        throw new SkelgenError({ code: "bad_input", message: `is ${extension(name).toUpperCase()}, which this page does not read; export it as GLB` });
      if (extension(name) === "bvh")
        throw new SkelgenError({ code: "bad_input", message: "is a motion; drop a character first, then the motion" });
      const files = Object.fromEntries(others.map((other) => [other.webkitRelativePath || other.name, other]));
      const mesh = await this.worker.open({ name, bytes: file, files }, { signal, glb: true });
      if (signal.aborted) return mesh.delete();
      this.mesh = mesh;
      const faces = mesh.faces.length / 3;
      element("welcome").hidden = true;
      if (faces <= shown_faces) {
        const figure = await Figure.load({ name, faces, glb: mesh.glb });
        if (signal.aborted) return figure.dispose();
        mesh.glb = null; // the figure has it
        this.show(figure, true);
      }
      this.counted = { vertices: mesh.positions.length / 3, faces };
      mesh.positions = mesh.faces = null; // the worker has them
      await this.look(name, 0, signal);
    });
  }

  /// Another of several bodies in the mesh that is there.
  find(name, component) {
    return this.begin(name, "Looking for the skeleton…", (signal) => this.look(name, component, signal));
  }

  async look(name, component, signal) {
    this.busy("Looking for the skeleton…");
    this.component = component;
    let tries = 0;
    const onProgress = ({ spent, budget }) => {
      if (++tries > 1) this.busy(`Looking for the skeleton: try ${tries}…`, spent / budget);
    };
    const body = await this.worker.extract(this.mesh, { component, signal, onProgress });
    if (signal.aborted) return body.delete();
    this.body?.delete();
    this.body = body;
    await this.make(signal, true);
    this.told_found(name);
  }

  settings() {
    return { rest: element("rest-pose").value, fingers: element("fingers").value, toes: element("toes").checked };
  }

  /// Binds the body as the settings have it, and shows that.
  async make(signal, is_first = false) {
    this.busy("Binding the mesh to its bones…");
    const rig = await this.body.rig(this.settings());
    if (signal.aborted) return rig.delete();
    for (const { name, text } of [{ name: "walk", text: this.walk }, ...this.clips]) if (text) await rig.follow(text, name);
    const glb = await rig.file("glb");
    const data = {
      name: this.body.name, glb, step: 1, in_metres: rig.unitIsKnown, has_looks: rig.hasLooks, faces: this.counted.faces,
      joints: rig.joints,
    };
    const figure = await Figure.load(data);
    if (signal.aborted) {
      figure.dispose();
      return rig.delete();
    }
    this.rig?.delete();
    this.rig = rig;
    this.show(figure, is_first);
    this.told_rig();
  }

  show(figure, is_first) {
    const focused = document.activeElement?.id;
    const state = this.viewer?.state();
    this.viewer?.dispose();
    element("controls").replaceChildren();
    if (figure.data.joints) {
      element("controls").append(element("controls-template").content.cloneNode(true));
      element("by-confidence").addEventListener("change", ({ target }) => this.by_confidence(target.checked));
      element("add-clip").addEventListener("click", () => element("clip-file").click());
    }
    this.viewer = new Viewer(this.stage, figure, {
      state, is_first,
      moved: (name, place) => this.move_joint(name, place),
      chosen: ({ name }) => { element("moving").textContent = `Moving: ${told_joint(name)}`; },
    });
    if (figure.data.joints) {
      element("by-confidence").checked = this.viewer.by_confidence;
      this.viewer.correct(this.viewer.correcting);
    }
    if (focused) element(focused)?.focus();
  }

  by_confidence(wanted) {
    this.viewer.show_confidence(wanted);
    element("legend").classList.toggle("by-confidence", wanted);
  }

  // ---- what is said of it ----

  told_found(name) {
    element("refused").hidden = true;
    for (const id of ["side", "result", "made"]) element(id).hidden = false;
    element("legend").hidden = false;
    element("result-title").textContent = name;
    this.show_trail(this.body.trail);
    element("status").textContent = `A skeleton was found in ${name}. ${element("trust-text").textContent}`;
  }

  told_rig() {
    const { quality } = this.body.skeleton;
    const numbers = (count) => count.toLocaleString("en");
    const digits = kinds_of_digits(this.rig.joints);
    element("facts").textContent = `${numbers(this.counted.faces)} faces, ${this.rig.joints.length} bones${digits.length > 0 ? `, with ${digits.join(" and ")}` : ""}`;
    element("confidence").value = quality.sides_confidence;
    element("trust-text").textContent = this.before.length > 0 ? "Joints were moved by hand." : `${percent(quality.sides_confidence)}. ${told_confidence(quality.sides_confidence)}`;
    const list = element("warnings");
    list.replaceChildren();
    const unit = this.rig.unitIsKnown ? [] : ["its unit is unknown, as it has no person's height in any; lengths are left as they are"];
    for (const warning of new Set([...quality.warnings, ...this.rig.warnings, ...unit])) put(list, "li", sentence(warning));
    const table = element("joint-table");
    table.replaceChildren();
    for (const { name, confidence } of this.rig.joints) {
      const row = put(table, "tr", "");
      put(row, "td", told_joint(name));
      put(row, "td", percent(confidence));
    }
    element("undo").disabled = this.before.length === 0;
  }

  show_trail(trail) {
    element("trail-section").hidden = trail.length === 0;
    element("joints-section").hidden = !this.rig;
    element("trail").replaceChildren();
    for (const each of trail) put(element("trail"), "li", told_try(each));
  }

  // ---- changes ----

  again() {
    if (this.body) this.begin(this.body.name, "Binding the mesh to its bones…", (signal) => this.make(signal));
  }

  /// Another skeleton for the same mesh.
  async refit(skeleton, signal) {
    const body = await this.body.fit(skeleton, { component: this.component });
    if (signal.aborted) return body.delete();
    this.before.push(this.body);
    this.body = body;
    await this.make(signal);
  }

  /// `place`: in the rig's coordinates, from where the joint's own motion leads back to the mesh.
  move_joint(name, place) {
    const joint = this.rig.joints.find((one) => one.name === name);
    if (!joint?.motion) return;
    const [x, y, z, w, ...shift] = joint.motion;
    const p = place.map((value, axis) => value - shift[axis]);
    // Turned back: v + 2 w (q x v) + 2 q x (q x v), q the inverse turn's axis.
    const q = [-x, -y, -z];
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const once = cross(q, p), twice = cross(q, once);
    const position = p.map((value, axis) => (value + 2 * w * once[axis] + 2 * twice[axis]) / this.rig.metresPerUnit);
    const skeleton = structuredClone(this.body.skeleton);
    const moved = skeleton.joints.find((one) => one.name === name);
    if (!moved) return;
    moved.position = position;
    this.begin(this.body.name, `Moving ${told_joint(name)}…`, (signal) => this.refit(skeleton, signal));
  }

  undo() {
    if (this.before.length === 0) return;
    this.begin(this.body.name, "Undoing…", async (signal) => {
      this.body.delete();
      this.body = this.before.pop();
      await this.make(signal);
    });
  }

  take_skeleton(file) {
    this.begin(file.name, `Reading ${file.name}…`, async (signal) => this.refit(await file.text(), signal));
  }

  add_clip(file) {
    this.begin(file.name, `Reading ${file.name}…`, async (signal) => {
      const text = await file.text(), name = stem(file.name);
      await this.rig.follow(text, name); // before it is kept: it may be no motion
      this.clips = [...this.clips.filter((clip) => clip.name !== name), { name, text }];
      await this.make(signal);
      this.viewer.choose_clip(name);
      element("clip").value = name;
    });
  }

  // ---- files to take away ----

  async download(format) {
    const name = `${stem(this.body.name)}.${format}`;
    await this.begin(this.body.name, `Writing ${name}…`, async () => {
      const bytes = format === "json" ? new TextEncoder().encode(JSON.stringify(this.body.skeleton, null, 1) + "\n") : await this.file(format);
      const link = document.createElement("a");
      link.href = URL.createObjectURL(new Blob([bytes]));
      link.download = name;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000); // the browser has begun by then
      element("status").textContent = `${name} was written.`;
    });
  }

  /// VRM knows the T-pose alone.
  async file(format) {
    const options = { names: element("names").value || "skelgen", animations: element("with-motions").checked };
    if (format !== "vrm" || element("rest-pose").value === "t-pose") return this.rig.file(format, options);
    const rig = await this.body.rig({ ...this.settings(), rest: "t-pose" });
    return rig.file(format, options).finally(() => rig.delete());
  }

  // ---- what is heard ----

  listen() {
    const files = element("file");
    for (const id of ["open", "choose"]) element(id).addEventListener("click", () => files.click());
    files.addEventListener("change", () => {
      this.take(files.files);
      files.value = ""; // the same file again is a change, too
    });
    element("clip-file").addEventListener("change", ({ target }) => {
      if (target.files[0]) this.add_clip(target.files[0]);
      target.value = "";
    });
    for (const button of element("samples").children) button.addEventListener("click", () => this.sample(button.dataset.sample));
    element("cancel").addEventListener("click", () => this.cancel());
    for (const id of ["rest-pose", "fingers", "toes"]) element(id).addEventListener("change", () => this.again());
    for (const button of element("downloads").children) button.addEventListener("click", () => this.download(button.dataset.format));
    element("correct").addEventListener("change", ({ target }) => {
      this.viewer.correct(target.checked);
      element("steps").hidden = !target.checked;
    });
    for (const button of document.querySelectorAll("[data-step]"))
      button.addEventListener("click", () => {
        const { viewer } = this;
        if (viewer?.joints.length > 0)
          this.move_joint(viewer.joints[viewer.joint].name, viewer.stepped(viewer.joint, button.dataset.step.split(",").map(Number)));
      });
    element("undo").addEventListener("click", () => this.undo());
    window.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && this.job) this.cancel();
      else if (this.viewer?.panel && event.key !== "m") this.viewer.panel.key(event);
    });
    let inside = 0; // of the elements that a dragged file is over
    window.addEventListener("dragenter", (event) => { event.preventDefault(); ++inside; element("drop").hidden = false; });
    window.addEventListener("dragleave", () => { if (--inside <= 0) element("drop").hidden = true; });
    window.addEventListener("dragover", (event) => event.preventDefault());
    window.addEventListener("drop", (event) => {
      event.preventDefault();
      inside = 0;
      element("drop").hidden = true;
      this.take(event.dataTransfer.files);
    });
  }

  async sample(path) {
    const name = path.split("/").pop().replace(/\.gz$/, "");
    try {
      const response = await fetch(here(path));
      if (!response.ok) throw new Error(`it is not there (${response.status})`);
      this.open(new File([await response.blob()], name));
    } catch (error) {
      this.refuse(name, new SkelgenError({ code: "bad_input", message: `cannot be had: ${error.message}` }));
    }
  }
}

// The page is seen before the graphics card is asked for a context, which takes longer.
requestAnimationFrame(() => setTimeout(() => {
  window.skelgen_app = new App(); // for those who look with a console
}));
if ("serviceWorker" in navigator && location.protocol.startsWith("http")) navigator.serviceWorker.register(here("offline.js")).catch(() => {});
