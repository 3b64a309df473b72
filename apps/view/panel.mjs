// The controls beside the picture. They change the state and say what changed; keys do the same.
const layers = [["body", "b", "Body"], ["skeleton", "s", "Skeleton"], ["names", "n", "Names"], ["floor", "g", "Floor"],
  ["curve", "c", "Curve"], ["sections", "x", "Sections"], ["frame", "f", "Directions"]];
const schemes = [["looks", "4", "Materials"], ["plain", "1", "Plain"], ["sides", "2", "Sides"], ["weights", "3", "Weights"]];
const keys = [
  ["b s n g c x f", "body, skeleton, names, floor, curve, sections, directions"],
  ["1 2 3 4", "plain, sides, weights, materials"], ["[ ]", "joint before, after"], ["arrows", "turn; move the joint"],
  ["+ \u2212", "zoom"], ["0", "see all"], ["r", "rest pose"], ["e", "move joints"], ["k", "mirror the joint"],
  ["ctrl z", "undo; with shift redo"], ["space", "play"], ["m", "controls"],
];
const axes = ["bend", "twist", "swing"];
const axis_index = { bend: 0, twist: 1, swing: 2 }; // about x, y (the bone) and z
const by_finger = window.matchMedia("(pointer: coarse)").matches;
const hints = {
  look: by_finger ? "Drag to turn, two fingers to zoom and move, tap a joint to choose it"
    : "Drag to turn, wheel to zoom, right button to move, click a joint to choose it",
  edit: by_finger ? "Drag a joint to where it belongs; drag beside it to turn"
    : "Drag a joint to where it belongs, or move it by the arrow keys; drag beside it to turn",
};

const element = (id) => document.getElementById(id);

function add(parent, tag, text, attributes = {}) {
  const made = document.createElement(tag);
  made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  parent.append(made);
  return made;
}

const degrees = (radians) => Math.round((radians * 180) / Math.PI);
const on_click = (id, act) => element(id).addEventListener("click", act);

export class Panel {
  /// `viewer` has the state and does what is asked for. `keys_from`: where keys are heard.
  constructor(viewer, { keys_from = window, is_folded = window.innerWidth <= 700 } = {}) {
    this.viewer = viewer;
    const own_layers = layers.filter(([name]) => name in viewer.shown);
    this.layer_buttons = this.buttons("layers", own_layers, (name) => viewer.toggle(name));
    this.colour_buttons = this.buttons("colours", viewer.has_looks ? schemes : schemes.slice(1), (name) => viewer.colour(name));
    element("opacity").addEventListener("input", (event) => viewer.set_opacity(Number(event.target.value)));
    for (const { name } of viewer.joints) add(element("joint"), "option", name.replaceAll("_", " "), { value: name });
    element("joints").hidden = viewer.joints.length === 0;
    element("joint").addEventListener("change", (event) => viewer.select(event.target.selectedIndex));
    for (const axis of axes) element(axis).addEventListener("input", () => viewer.bend(this.turns()));
    on_click("rest", () => viewer.rest());
    on_click("edit", () => viewer.edit());
    on_click("undo", () => viewer.drag.undo());
    on_click("redo", () => viewer.drag.redo());
    on_click("mirror", () => viewer.mirror());
    on_click("save", () => viewer.drag.save(viewer.current));
    for (const [key, what] of keys) {
      add(element("keys"), "dt", key);
      add(element("keys"), "dd", what);
    }
    on_click("fold", () => this.fold());
    this.rows = viewer.figures.map((figure) => this.list(figure));
    this.offer_clips();
    keys_from.addEventListener("keydown", (event) => this.key(event));
    if (is_folded) this.fold(); // bodies first
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

  /// A body's line: its name brings it near, beside it is what hides it.
  list(figure) {
    const { data } = figure, { viewer } = this;
    const item = add(element("bodies-list"), "li", "");
    const row = add(item, "div", "", { class: "row" });
    const name = add(row, "button", data.name, { class: "name", title: `See ${data.name} alone` });
    name.addEventListener("click", () => viewer.focus(figure));
    const eye = add(row, "button", "Hide", { class: "eye" });
    eye.addEventListener("click", () => viewer.hide(figure, !figure.hidden));
    const say = (text, attributes) => add(item, "small", text, attributes);
    if (data.failure) say(data.failure, { class: "failure" });
    else say(`${data.faces.toLocaleString("en")} faces, ${Math.round(100 * data.sides_confidence)} % sure`);
    const warnings = data.warnings ?? [];
    if (warnings.length > 0) {
      const notes = add(item, "details", "");
      add(notes, "summary", warnings.length === 1 ? "1 note" : `${warnings.length} notes`);
      for (const warning of warnings) add(notes, "small", warning, { class: "warning" });
    }
    return { figure, item, name, eye };
  }

  offer_clips() {
    const names = this.viewer.poses.clips();
    element("motion").hidden = names.length === 0;
    for (const name of names) add(element("clip"), "option", name);
    element("clip").hidden = names.length < 2;
    element("clip").addEventListener("change", () => this.viewer.choose_clip(element("clip").value));
    element("time").addEventListener("input", (event) => this.viewer.scrub(Number(event.target.value)));
    on_click("play", () => this.viewer.play());
  }

  turns() {
    const turns = [0, 0, 0];
    for (const axis of axes) turns[axis_index[axis]] = (Number(element(axis).value) * Math.PI) / 180;
    return turns;
  }

  /// Shows the state as it is.
  update() {
    const { viewer } = this, { drag, poses } = viewer;
    for (const [name, button] of this.layer_buttons) button.setAttribute("aria-pressed", String(viewer.shown[name]));
    for (const [name, button] of this.colour_buttons) button.setAttribute("aria-pressed", String(viewer.scheme === name));
    element("opacity").value = String(viewer.opacity);
    document.querySelector('output[for="opacity"]').textContent = `${Math.round(100 * viewer.opacity)} %`;
    element("joint").selectedIndex = viewer.joint;
    const turns = viewer.poses.bend_of(viewer.joint);
    for (const axis of axes) {
      const value = degrees(turns[axis_index[axis]]);
      element(axis).value = String(value);
      document.querySelector(`output[for="${axis}"]`).textContent = `${value}\u00b0`;
    }
    for (const { figure, item, name, eye } of this.rows) {
      item.classList.toggle("hidden", figure.hidden);
      name.setAttribute("aria-current", String(this.rows.length > 1 && figure === viewer.focused));
      eye.textContent = figure.hidden ? "Show" : "Hide";
      eye.setAttribute("aria-label", `${eye.textContent} ${figure.data.name}`);
    }
    element("play").setAttribute("aria-pressed", String(poses.playing));
    element("play").textContent = poses.playing ? "Pause" : "Play";
    element("hint").textContent = drag.on ? hints.edit : hints.look;
    element("edit").setAttribute("aria-pressed", String(drag.on));
    element("editing").hidden = !drag.on;
    if (drag.on) this.show_moves();
    this.show_time();
  }

  show_moves() {
    const { drag, current, joints, joint, figures } = this.viewer;
    const moved = current.joints_moved.size, of = figures.length > 1 ? ` of ${current.data.name}` : "";
    element("moved").textContent = `${moved === 0 ? "No joint" : moved === 1 ? "1 joint" : `${moved} joints`}${of} moved`;
    element("undo").disabled = drag.done.length === 0;
    element("redo").disabled = drag.undone.length === 0;
    element("mirror").disabled = joints[joint].side === "none";
    element("save").disabled = !current.data.skeleton;
  }

  show_time() {
    const { poses } = this.viewer;
    element("time").value = poses.clip && poses.duration() > 0 ? String(poses.time / poses.duration()) : "0";
  }

  key(event) {
    const { viewer } = this;
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z" && viewer.drag.on) {
      event.preventDefault();
      return event.shiftKey ? viewer.drag.redo() : viewer.drag.undo();
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const on_control = ["INPUT", "SELECT"].includes(event.target.tagName);
    const layer = layers.find(([name, key]) => key === event.key && this.layer_buttons.has(name));
    const scheme = schemes.find(([, key]) => key === event.key);
    const acts = {
      "[": () => viewer.select(viewer.joint - 1), "]": () => viewer.select(viewer.joint + 1),
      "+": () => viewer.stage.zoom(0.85), "-": () => viewer.stage.zoom(1 / 0.85),
      "0": () => viewer.see_all(), r: () => viewer.rest(), m: () => this.fold(), e: () => viewer.edit(),
      k: () => viewer.mirror(),
    };
    // On a slider or a list these keys are its own.
    const own = on_control || event.target.tagName === "BUTTON" ? {} : { " ": () => viewer.play() };
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const step = event.shiftKey ? 0.02 : 0.004, turn = 0.1; // of the picture's height; radians
    const arrow = on_control ? null : arrows[event.key];
    const act = arrow ? () => viewer.drag.on ? viewer.drag.nudge(viewer.current, viewer.joint, arrow[0] * step, arrow[1] * step)
        : viewer.stage.orbit(arrow[0] * turn, -arrow[1] * turn)
      : layer ? () => viewer.toggle(layer[0])
      : scheme && this.colour_buttons.has(scheme[0]) ? () => viewer.colour(scheme[0])
      : { ...acts, ...own }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}
