// The controls of how a body is shown and held, which all pages have. They change the state and say what changed; keys do
// the same. What they look for is in the page.
import { digits_beside } from "./digits.mjs";

const layers = [["body", "b", "Body"], ["skeleton", "s", "Skeleton"], ["names", "n", "Names"], ["floor", "g", "Floor"],
  ["curve", "c", "Curve"], ["sections", "x", "Sections"], ["frame", "f", "Directions"]];
const schemes = [["looks", "4", "Materials"], ["plain", "1", "Plain"], ["sides", "2", "Sides"], ["weights", "3", "Weights"]];
const keys = [
  ["1 2 3 4", "plain, sides, weights, materials"], ["[ ]", "joint before, after"], ["arrows", "turn"],
  ["+ \u2212", "zoom"], ["0", "see all"], ["r", "rest pose"], ["space", "play"], ["m", "controls"],
];
const axes = ["bend", "twist", "swing"];
const axis_index = { bend: 0, twist: 1, swing: 2 }; // about x, y (the bone) and z
const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const degrees = (radians) => Math.round((radians * 180) / Math.PI);

export const element = (id) => document.getElementById(id);
export const on_click = (id, act) => element(id).addEventListener("click", act);

export function add(parent, tag, text, attributes = {}) {
  const made = document.createElement(tag);
  made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  parent.append(made);
  return made;
}

export class Panel {
  /// `viewer` has the state and does what is asked for. `keys_from`: where keys are heard.
  constructor(viewer, { keys_from = window, is_folded = window.innerWidth <= 700 } = {}) {
    this.viewer = viewer;
    const own_layers = layers.filter(([name]) => name in viewer.shown);
    this.layer_buttons = this.buttons("layers", own_layers, (name) => viewer.toggle(name));
    this.colour_buttons = this.buttons("colours", viewer.has_looks ? schemes : schemes.slice(1), (name) => viewer.colour(name));
    element("opacity").addEventListener("input", (event) => viewer.set_opacity(Number(event.target.value)));
    for (const { name } of viewer.joints) add(element("joint"), "option", name.replaceAll("_", " "), { value: name });
    element("joint").addEventListener("change", (event) => viewer.select(event.target.selectedIndex));
    for (const axis of axes) element(axis).addEventListener("input", () => viewer.bend(this.turns()));
    element("curl").addEventListener("input", (event) => viewer.curl(this.digits(), (Number(event.target.value) * Math.PI) / 180));
    on_click("rest", () => viewer.rest());
    on_click("fold", () => this.fold());
    const of_layers = [own_layers.map(([, key]) => key).join(" "), own_layers.map(([, , text]) => text.toLowerCase()).join(", ")];
    for (const [key, what] of [of_layers, ...this.keys()]) {
      add(element("keys"), "dt", key);
      add(element("keys"), "dd", what);
    }
    this.offer_clips();
    keys_from.addEventListener("keydown", (event) => this.key(event));
    if (is_folded) this.fold(); // bodies first
  }

  /// Keys and what they do, but for those of the layers.
  keys() {
    return keys;
  }

  buttons(id, names, act) {
    return new Map(names.map(([name, key, text]) => {
      const button = add(element(id), "button", text, { "aria-pressed": "false", title: `Key ${key}` });
      button.addEventListener("click", () => act(name));
      return [name, button];
    }));
  }

  fold() {
    const folded = element("panel").classList.toggle("folded");
    element("fold").setAttribute("aria-expanded", String(!folded));
  }

  offer_clips() {
    const names = this.viewer.poses.clips();
    element("motion").hidden = names.length === 0;
    for (const name of names) add(element("clip"), "option", name);
    element("clip").addEventListener("change", () => this.viewer.choose_clip(element("clip").value));
    element("time").addEventListener("input", (event) => this.viewer.scrub(Number(event.target.value)));
    on_click("play", () => this.viewer.play());
  }

  turns() {
    const turns = [0, 0, 0];
    for (const axis of axes) turns[axis_index[axis]] = (Number(element(axis).value) * Math.PI) / 180;
    return turns;
  }

  /// What is curled where the chosen joint is of a hand or foot.
  digits() {
    const { joints, joint } = this.viewer;
    return digits_beside(joints, joints[joint]?.name);
  }

  show_angle(id, radians) {
    const value = degrees(radians);
    element(id).value = String(value);
    document.querySelector(`output[for="${id}"]`).textContent = `${value}\u00b0`;
  }

  /// Shows the state as it is.
  update() {
    const { viewer } = this, { poses } = viewer;
    for (const [name, button] of this.layer_buttons) button.setAttribute("aria-pressed", String(viewer.shown[name]));
    for (const [name, button] of this.colour_buttons) button.setAttribute("aria-pressed", String(viewer.scheme === name));
    element("opacity").value = String(viewer.opacity);
    element("joint").selectedIndex = viewer.joint;
    const turns = poses.bend_of(viewer.joints[viewer.joint]?.name), digits = this.digits();
    for (const axis of axes) this.show_angle(axis, turns[axis_index[axis]]);
    element("curl").parentElement.hidden = digits.length === 0;
    if (digits.length > 0) this.show_angle("curl", poses.curl_of(digits));
    element("play").setAttribute("aria-pressed", String(poses.playing));
    element("play").textContent = poses.playing ? "Pause" : "Play";
    this.show_time();
  }

  show_time() {
    const { poses } = this.viewer;
    element("time").value = poses.clip && poses.duration() > 0 ? String(poses.time / poses.duration()) : "0";
  }

  /// What an arrow key does, to the right and up.
  step(right, up) {
    const turn = 0.1; // radians
    this.viewer.stage.orbit(right * turn, -up * turn);
  }

  /// What keys do that stand for themselves.
  acts() {
    const { viewer } = this;
    return {
      "[": () => viewer.select(viewer.joint - 1), "]": () => viewer.select(viewer.joint + 1),
      "+": () => viewer.stage.zoom(0.85), "-": () => viewer.stage.zoom(1 / 0.85),
      "0": () => viewer.see_all(), r: () => viewer.rest(), m: () => this.fold(),
    };
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { viewer } = this;
    const on_control = ["INPUT", "SELECT"].includes(event.target.tagName);
    const layer = layers.find(([name, key]) => key === event.key && this.layer_buttons.has(name));
    const scheme = schemes.find(([, key]) => key === event.key);
    // On a slider or a list these keys are its own.
    const own = on_control || event.target.tagName === "BUTTON" ? {} : { " ": () => viewer.play() };
    const arrow = on_control ? null : arrows[event.key];
    const act = arrow ? () => this.step(...arrow, event.shiftKey)
      : layer ? () => viewer.toggle(layer[0])
      : scheme && this.colour_buttons.has(scheme[0]) ? () => viewer.colour(scheme[0])
      : { ...this.acts(), ...own }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}
