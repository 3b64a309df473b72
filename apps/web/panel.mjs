// The controls of a page that shows one body; apps/view/panel.mjs has those of many, with editing of its own.
// The controls beside the picture. They change the state and say what changed; keys do the same.
const layers = [["body", "b"], ["skeleton", "s"], ["curve", "c"], ["sections", "x"], ["frame", "f"], ["names", "n"]];
const schemes = [["plain", "1"], ["sides", "2"], ["weights", "3"], ["looks", "4"]];
const keys = [
  ["b s c x f n", "body, skeleton, curve, sections, frame, names"], ["1 2 3 4", "colours"], ["[ ]", "joint before, after"],
  ["arrows, + \u2212", "turn, zoom"], ["0", "see all"], ["r", "pose at rest"], ["space", "play"], ["m", "controls"],
];
const axes = ["bend", "twist", "swing"];
const axis_index = { bend: 0, twist: 1, swing: 2 }; // about x, y (the bone) and z

const element = (id) => document.getElementById(id);

function add(parent, tag, text, attributes = {}) {
  const made = document.createElement(tag);
  made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  parent.append(made);
  return made;
}

const degrees = (radians) => Math.round((radians * 180) / Math.PI);

export class Panel {
  /// `viewer` has the state and does what is asked for. `keys_from`: where keys are heard.
  constructor(viewer, { keys_from = window, is_folded = window.innerWidth <= 700 } = {}) {
    this.viewer = viewer;
    const own_layers = layers.filter(([name]) => name in viewer.shown);
    this.layer_buttons = this.buttons("layers", own_layers, (name) => viewer.toggle(name));
    this.colour_buttons = this.buttons("colours", viewer.has_looks ? schemes : schemes.slice(0, 3), (name) => viewer.colour(name));
    element("opacity").addEventListener("input", (event) => viewer.set_opacity(Number(event.target.value)));
    for (const { name } of viewer.joints) add(element("joint"), "option", name);
    element("joint").addEventListener("change", (event) => viewer.select(event.target.selectedIndex));
    for (const axis of axes) element(axis).addEventListener("input", () => viewer.bend(this.turns()));
    element("rest").addEventListener("click", () => viewer.rest());
    for (const [key, what] of keys) {
      add(element("keys"), "dt", key);
      add(element("keys"), "dd", what);
    }
    element("fold").addEventListener("click", () => this.fold());
    this.list_bodies();
    this.offer_clips();
    keys_from.addEventListener("keydown", (event) => this.key(event));
    if (is_folded) this.fold(); // bodies first
  }

  buttons(id, names, act) {
    return new Map(names.map(([name, key]) => {
      const button = add(element(id), "button", name, { "aria-pressed": "false", title: `Key ${key}` });
      button.addEventListener("click", () => act(name));
      return [name, button];
    }));
  }

  fold() {
    const folded = element("panel").classList.toggle("folded");
    element("fold").setAttribute("aria-expanded", String(!folded));
  }

  list_bodies() {
    for (const { data } of this.viewer.figures) {
      const item = add(element("bodies-list"), "li", data.name);
      if (data.failure) add(item, "small", data.failure, { class: "failure" });
      else add(item, "small", `${data.faces} faces, sides ${data.sides_confidence.toFixed(2)} sure`);
      for (const warning of data.warnings ?? []) add(item, "small", warning, { class: "warning" });
    }
  }

  offer_clips() {
    const names = this.viewer.poses.clips();
    element("motion").hidden = names.length === 0;
    for (const name of names) add(element("clip"), "option", name);
    element("clip").addEventListener("change", () => this.viewer.choose_clip(element("clip").value));
    element("time").addEventListener("input", (event) => this.viewer.scrub(Number(event.target.value)));
    element("play").addEventListener("click", () => this.viewer.play());
  }

  turns() {
    const turns = [0, 0, 0];
    for (const axis of axes) turns[axis_index[axis]] = (Number(element(axis).value) * Math.PI) / 180;
    return turns;
  }

  /// Shows the state as it is.
  update() {
    const { viewer } = this;
    for (const [name, button] of this.layer_buttons) button.setAttribute("aria-pressed", String(viewer.shown[name]));
    for (const [name, button] of this.colour_buttons) button.setAttribute("aria-pressed", String(viewer.scheme === name));
    element("joint").selectedIndex = viewer.joint;
    const turns = viewer.poses.bend_of(viewer.joint);
    for (const axis of axes) {
      const value = degrees(turns[axis_index[axis]]);
      element(axis).value = String(value);
      document.querySelector(`output[for="${axis}"]`).textContent = `${value}\u00b0`;
    }
    const { poses } = viewer;
    element("play").setAttribute("aria-pressed", String(poses.playing));
    element("play").textContent = poses.playing ? "Pause" : "Play";
    this.show_time();
  }

  show_time() {
    const { poses } = this.viewer;
    element("time").value = poses.clip && poses.duration() > 0 ? String(poses.time / poses.duration()) : "0";
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const on_control = ["INPUT", "SELECT"].includes(event.target.tagName);
    const { viewer } = this;
    const layer = layers.find(([name, key]) => key === event.key && this.layer_buttons.has(name));
    const scheme = schemes.find(([, key]) => key === event.key);
    const acts = {
      "[": () => viewer.select(viewer.joint - 1), "]": () => viewer.select(viewer.joint + 1),
      "+": () => viewer.stage.zoom(0.85), "-": () => viewer.stage.zoom(1 / 0.85),
      "0": () => viewer.see_all(), r: () => viewer.rest(), m: () => this.fold(),
    };
    // On a slider or a list these keys are its own.
    const own = on_control || event.target.tagName === "BUTTON" ? {} : { " ": () => viewer.play() };
    const turn = 0.1;
    const turns = on_control ? {} : {
      ArrowLeft: () => viewer.stage.orbit(-turn, 0), ArrowRight: () => viewer.stage.orbit(turn, 0),
      ArrowUp: () => viewer.stage.orbit(0, -turn), ArrowDown: () => viewer.stage.orbit(0, turn),
    };
    const act = layer ? () => viewer.toggle(layer[0])
      : scheme && this.colour_buttons.has(scheme[0]) ? () => viewer.colour(scheme[0])
      : { ...acts, ...own, ...turns }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}
