// The page of `skelgen view`: reads the bodies that it holds and shows them side by side.
import * as THREE from "three";
import { JointDrag } from "./drag.mjs";
import { Figure } from "./figure.mjs";
import { Labels } from "./labels.mjs";
import { EditingPanel } from "./editing_panel.mjs";
import { Poses } from "./poses.mjs";
import { Stage } from "./stage.mjs";

const gap = 0.25; // metres between bodies
const caption = 0.35; // and below those of a row, for their names

/// Figures one after the other, cut into so many rows of about the same width.
function in_rows(figures, count) {
  const rows = [];
  const all = figures.reduce((sum, { width }) => sum + width, 0);
  let before = 0;
  for (const figure of figures) {
    const row = Math.min(Math.floor(((before + figure.width / 2) / all) * count), count - 1);
    (rows[row] ??= []).push(figure);
    before += figure.width;
  }
  return rows.filter((row) => row);
}

/// The rows in which figures are seen as large as can be; one where more are not half as good again.
function best_rows(figures, aspect) {
  const height_of_view = (rows) => {
    const width = Math.max(...rows.map((row) => row.reduce((sum, { width }) => sum + width, 0)));
    return Math.max(width / aspect, rows.reduce((sum, row) => sum + Math.max(...row.map(({ height }) => height)), 0));
  };
  const choices = figures.map((_, i) => in_rows(figures, i + 1));
  const best = choices.reduce((a, b) => (height_of_view(b) < height_of_view(a) ? b : a));
  return height_of_view(choices[0]) > 1.5 * height_of_view(best) ? best : choices[0];
}

/// The joints of all bodies, each name once: not all show the same digits.
const all_joints = (figures) =>
  [...new Map(figures.flatMap(({ data }) => data.joints ?? []).reverse().map((joint) => [joint.name, joint])).values()].reverse();

/// What is shown of the bodies and how they are held; every change ends in a new picture.
class Viewer {
  constructor(figures) {
    this.figures = figures;
    this.poses = new Poses(figures);
    this.joints = all_joints(figures);
    this.has_looks = figures.some((figure) => figure.data.has_looks);
    this.shown = { body: true, skeleton: true, floor: true, curve: false, sections: false, frame: false, names: false };
    this.scheme = this.has_looks ? "looks" : "plain";
    this.opacity = this.has_looks ? 1 : 0.6;
    this.joint = 0;
    this.current = figures.find((figure) => figure.data.joints); // whose joints are moved
    this.stage = new Stage(document.getElementById("canvas"), (seconds) => this.before_frame(seconds));
    this.box = this.line_up();
    this.labels = new Labels(document.getElementById("labels"), document.getElementById("tip"), figures);
    this.drag = new JointDrag(this.stage, {
      find: (event) => this.find(event),
      begin: () => (this.poses.clip !== null || this.poses.bends.size > 0) && this.poses.rest(),
      taken: (figure, joint) => this.choose(figure, joint),
      changed: () => this.changed(),
    });
    this.panel = new EditingPanel(this);
    this.follow_pointer();
    for (const layer of Object.keys(this.shown)) this.apply_layer(layer);
    this.select(this.joint);
    this.recolour();
    this.see_all();
    if (!window.matchMedia("(prefers-reduced-motion: reduce)").matches) this.play();
  }

  /// Side by side along x, the first on the viewer's left; many in rows, one above the other. \returns the box of all.
  line_up() {
    const all = new THREE.Box3();
    const { canvas } = this.stage;
    const slots = this.figures.map((figure) => {
      const { min, max } = figure.box;
      figure.slot = max.x - min.x + gap;
      return { figure, width: figure.slot, height: max.y - min.y + caption };
    });
    let y = 0;
    for (const row of best_rows(slots, canvas.clientWidth / canvas.clientHeight).reverse()) {
      let x = 0;
      for (const { figure: { root, box }, width } of row) {
        root.position.set(x - box.min.x, y, 0);
        x += width;
        root.updateMatrixWorld(true);
        this.stage.scene.add(root);
        all.union(box.clone().translate(root.position));
      }
      y += Math.max(...row.map(({ height }) => height));
    }
    return all;
  }

  before_frame(seconds) {
    const moving = this.poses.advance(seconds);
    if (moving) this.panel.show_time();
    this.labels.update(this.stage, this.shown.names, this.shown.frame);
    return moving;
  }

  /// Of the chosen joint.
  get name() {
    return this.joints[this.joint]?.name;
  }

  changed() {
    this.panel.update();
    this.stage.invalidate();
  }

  apply_layer(layer) {
    if (layer !== "names") for (const figure of this.figures) figure.show(layer, this.shown[layer]);
  }

  toggle(layer) {
    this.shown[layer] = !this.shown[layer];
    this.apply_layer(layer);
    this.changed();
  }

  recolour() {
    for (const figure of this.figures) figure.colour(this.scheme, figure.index(this.name));
    this.set_opacity(this.opacity);
  }

  colour(scheme) {
    this.scheme = scheme;
    this.recolour();
  }

  set_opacity(opacity) {
    this.opacity = opacity;
    for (const figure of this.figures) figure.fade(opacity);
    this.changed();
  }

  select(joint) {
    if (this.joints.length === 0) return;
    this.joint = (joint + this.joints.length) % this.joints.length;
    for (const figure of this.figures) figure.select(figure.index(this.name));
    if (this.scheme === "weights") this.recolour();
    this.changed();
  }

  choose(figure, joint) {
    this.current = figure;
    this.select(this.joints.findIndex(({ name }) => name === figure.data.joints[joint].name));
  }

  edit() {
    if (!this.current) return;
    this.drag.on = !this.drag.on;
    this.stage.canvas.classList.toggle("editing", this.drag.on);
    if (this.drag.on) this.poses.rest(); // the skeleton is put right where it was found
    this.changed();
  }

  mirror() {
    if (this.drag.on) this.drag.mirror(this.current, this.current.index(this.name));
  }

  hide(figure, hidden) {
    figure.hidden = hidden;
    figure.root.visible = !hidden;
    this.changed();
  }

  /// One body, as large as can be; what hides it is undone.
  focus(figure) {
    this.focused = figure;
    if (figure.data.joints) this.current = figure;
    this.stage.front(figure.box.clone().translate(figure.root.position));
    this.hide(figure, false);
  }

  bend(turns) {
    this.poses.bend(this.name, turns);
    this.changed();
  }

  curl(digits, angle) {
    this.poses.curl(digits, angle);
    this.changed();
  }

  rest() {
    this.poses.rest();
    this.changed();
  }

  choose_clip(name) {
    this.poses.choose(name);
    this.changed();
  }

  scrub(part) {
    this.poses.scrub(part, document.getElementById("clip").value);
    this.changed();
  }

  play() {
    this.poses.play(document.getElementById("clip").value);
    this.changed();
  }

  see_all() {
    this.focused = null;
    this.stage.front(this.box);
    this.changed();
  }

  /// The joint under a mouse, or near a finger.
  find(event) {
    const { left, top } = this.stage.canvas.getBoundingClientRect();
    return this.labels.pick(this.stage, event.clientX - left, event.clientY - top, event.pointerType === "touch" ? 28 : 14);
  }

  /// A mouse finds joints by passing, a finger by touching; both choose by a click.
  follow_pointer() {
    const { canvas } = this.stage;
    canvas.addEventListener("pointermove", (event) => event.buttons === 0 && this.labels.tell(this.find(event)));
    canvas.addEventListener("pointerleave", (event) => event.pointerType !== "touch" && this.labels.tell(null)); // a lifted finger leaves, too
    let pressed = null;
    canvas.addEventListener("pointerdown", (event) => { pressed = { x: event.clientX, y: event.clientY }; });
    canvas.addEventListener("pointerup", (event) => {
      if (!pressed || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > 6) return; // it was a turn
      const found = this.find(event);
      this.labels.tell(found);
      if (found) this.choose(found.figure, found.joint);
    });
  }
}

const problem = (text) => {
  const element = document.createElement("p");
  element.className = "failure";
  element.textContent = text;
  document.getElementById("labels").append(element);
};

try {
  const bodies = JSON.parse(document.getElementById("bodies").textContent);
  document.title = bodies.length === 1 ? bodies[0].name : `${bodies.length} bodies`;
  // What a browser cannot show of one body costs that one alone.
  const load = (body) => Figure.load(body).catch(({ message }) =>
    Figure.load({ name: body.name, faces: body.faces, failure: `cannot be shown: ${message}` }));
  Promise.all(bodies.map(load))
    .then((figures) => new Viewer(figures))
    .then(() => { document.body.dataset.state = "ready"; })
    .catch((error) => problem(`The bodies cannot be shown: ${error.message}`));
} catch (error) {
  problem(`The page is damaged: ${error.message}`);
}
