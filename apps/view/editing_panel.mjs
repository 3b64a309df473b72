// The controls of `skelgen view`: many bodies, and joints that are put right.
import { is_digit } from "./digits.mjs";
import { Panel, add, element, on_click } from "./panel.mjs";

const by_finger = window.matchMedia("(pointer: coarse)").matches;
const hints = {
  look: by_finger ? "Drag to turn, two fingers to zoom and move, tap a joint to choose it"
    : "Drag to turn, wheel to zoom, right button to move, click a joint to choose it",
  edit: by_finger ? "Drag a joint to where it belongs; drag beside it to turn"
    : "Drag a joint to where it belongs, or move it by the arrow keys; drag beside it to turn",
};

export class EditingPanel extends Panel {
  constructor(viewer) {
    super(viewer);
    element("joints").hidden = viewer.joints.length === 0;
    element("clip").hidden = viewer.poses.clips().length < 2;
    on_click("edit", () => viewer.edit());
    on_click("undo", () => viewer.drag.undo());
    on_click("redo", () => viewer.drag.redo());
    on_click("mirror", () => viewer.mirror());
    on_click("save", () => viewer.drag.save(viewer.current));
    this.rows = viewer.figures.map((figure) => this.list(figure));
  }

  keys() {
    return [...super.keys(), ["e", "move joints"], ["arrows", "move the joint, where joints are moved"],
      ["k", "mirror the joint"], ["ctrl z", "undo; with shift redo"]];
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

  update() {
    super.update();
    const { viewer } = this, { drag } = viewer;
    document.querySelector('output[for="opacity"]').textContent = `${Math.round(100 * viewer.opacity)} %`;
    for (const { figure, item, name, eye } of this.rows) {
      item.classList.toggle("hidden", figure.hidden);
      name.setAttribute("aria-current", String(this.rows.length > 1 && figure === viewer.focused));
      eye.textContent = figure.hidden ? "Show" : "Hide";
      eye.setAttribute("aria-label", `${eye.textContent} ${figure.data.name}`);
    }
    element("hint").textContent = drag.on ? hints.edit : hints.look;
    element("edit").setAttribute("aria-pressed", String(drag.on));
    element("editing").hidden = !drag.on;
    if (drag.on) this.show_moves();
  }

  show_moves() {
    const { drag, current, joints, joint, figures } = this.viewer;
    const moved = current.joints_moved.size, of = figures.length > 1 ? ` of ${current.data.name}` : "";
    element("moved").textContent = `${moved === 0 ? "No joint" : moved === 1 ? "1 joint" : `${moved} joints`}${of} moved`;
    element("undo").disabled = drag.done.length === 0;
    element("redo").disabled = drag.undone.length === 0;
    element("mirror").disabled = joints[joint].side === "none" || is_digit(joints[joint].name);
    element("save").disabled = !current.data.skeleton;
  }

  step(right, up, is_large) {
    const { viewer } = this;
    if (!viewer.drag.on) return super.step(right, up);
    const length = is_large ? 0.02 : 0.004; // of the picture's height
    viewer.drag.nudge(viewer.current, viewer.current.index(viewer.name), right * length, up * length);
  }

  acts() {
    return { ...super.acts(), e: () => this.viewer.edit(), k: () => this.viewer.mirror() };
  }

  key(event) {
    const { drag } = this.viewer;
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z" || !drag.on) return super.key(event);
    event.preventDefault();
    if (event.shiftKey) drag.redo();
    else drag.undo();
  }
}
