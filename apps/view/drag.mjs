// Joints put right by hand: dragged or nudged in the plane of the screen, copied to the other side, undone, saved.
import * as THREE from "three";
import { is_digit } from "./digits.mjs";

const mirrored = (name) =>
  name.startsWith("left_") ? name.replace("left_", "right_") : name.startsWith("right_") ? name.replace("right_", "left_") : null;

/// Digits are found anew by what takes the skeleton.
const is_moved = (figure, joint) => figure.data.joints !== undefined && !is_digit(figure.data.joints[joint].name);

/// Rows of three with a shift behind them, as a page's data have them.
function to_matrix(rows) {
  return new THREE.Matrix4().set(...rows.flat(), 0, 0, 0, 1);
}

export class JointDrag {
  /// `find(event)` is the joint under the pointer as { figure, joint }, or null; `begin()` is called before a joint is moved,
  /// so that bodies are at rest; `taken(figure, joint)` when one is dragged; `changed()` after all that changes something.
  constructor(stage, { find, begin, taken, changed }) {
    this.stage = stage;
    this.begin = begin;
    this.taken = taken;
    this.changed = changed;
    this.on = false;
    this.done = []; // each a list of { figure, joint, from, to }
    this.undone = [];
    this.held = null;
    const { canvas } = stage;
    // Before the camera's own controls hear of it.
    canvas.addEventListener("pointerdown", (event) => {
      const found = this.on && event.button === 0 && !this.held ? find(event) : null;
      if (found && is_moved(found.figure, found.joint)) this.take(found, event);
    }, { capture: true });
    canvas.addEventListener("pointermove", (event) => event.pointerId === this.held?.id && this.pull(event));
    for (const type of ["pointerup", "pointercancel"])
      canvas.addEventListener(type, (event) => event.pointerId === this.held?.id && this.leave());
  }

  take({ figure, joint }, event) {
    this.begin();
    this.taken(figure, joint);
    const from = figure.joint_place(joint);
    this.held = { figure, joint, from, id: event.pointerId };
    this.grip = figure.inner.localToWorld(from.clone()).sub(this.at(event, figure.inner.localToWorld(from.clone())));
    this.stage.controls.enabled = false;
    this.stage.canvas.setPointerCapture(event.pointerId);
  }

  /// Where the pointer is in the plane through a point that faces the viewer.
  at(event, through) {
    const { camera, canvas } = this.stage, { left, top, width, height } = canvas.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera(
      new THREE.Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height), camera);
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(camera.getWorldDirection(new THREE.Vector3()), through);
    return ray.ray.intersectPlane(plane, new THREE.Vector3()) ?? through.clone();
  }

  pull(event) {
    const { figure, joint, from } = this.held;
    const world = this.at(event, figure.inner.localToWorld(from.clone())).add(this.grip);
    this.put({ figure, joint, to: figure.inner.worldToLocal(world) });
  }

  leave() {
    const { figure, joint, from } = this.held;
    this.held = null;
    this.stage.controls.enabled = true;
    const to = figure.joint_place(joint);
    if (to.distanceTo(from) > 0) this.keep([{ figure, joint, from, to }]);
  }

  put({ figure, joint, to }) {
    figure.move_joint(joint, to);
    this.changed();
  }

  keep(moves) {
    this.done.push(moves);
    this.undone = [];
    this.count();
    this.changed();
  }

  /// Moves joints from where they are, as one step.
  move(figure, all_places) {
    const places = all_places.filter(([joint]) => is_moved(figure, joint));
    if (places.length === 0) return;
    this.begin();
    const moves = places.map(([joint, to]) => ({ figure, joint, from: figure.joint_place(joint), to }));
    moves.forEach((move) => this.put(move));
    this.keep(moves);
  }

  /// Moves a joint on the screen by parts of the picture's height.
  nudge(figure, joint, right, up) {
    const { camera, controls } = this.stage;
    const height = 2 * Math.tan(THREE.MathUtils.degToRad(camera.fov / 2)) * camera.position.distanceTo(controls.target);
    const world = figure.inner.localToWorld(figure.joint_place(joint));
    for (const [axis, part] of [[0, right], [1, up]])
      world.addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, axis), part * height);
    this.move(figure, [[joint, figure.inner.worldToLocal(world)]]);
  }

  /// Puts the other side's joint, and those behind it, where this side's are in a mirror through the hips. \returns whether
  /// the joint has another side.
  mirror(figure, joint) {
    const { joints } = figure.data, of_other = (j) => joints.findIndex(({ name }) => name === mirrored(joints[j].name));
    if (of_other(joint) < 0) return false;
    const normal = new THREE.Vector3(...figure.data.frame.left).normalize();
    const hips = ["left_hip", "right_hip"].map((name) => joints.findIndex((one) => one.name === name)).filter((j) => j >= 0);
    const middle = new THREE.Vector3();
    for (const j of hips) middle.addScaledVector(figure.joint_place(j), 1 / hips.length);
    const places = [];
    const add = (j) => {
      const place = figure.joint_place(j);
      if (of_other(j) >= 0) places.push([of_other(j), place.addScaledVector(normal, -2 * place.clone().sub(middle).dot(normal))]);
      for (const child of figure.bones[j].children) if (child.isBone) add(figure.bones.indexOf(child));
    };
    add(joint);
    this.move(figure, places);
    return true;
  }

  undo() {
    this.step(this.done, this.undone, "from");
  }

  redo() {
    this.step(this.undone, this.done, "to");
  }

  step(source, goal, end) {
    const moves = source.pop();
    if (!moves) return;
    goal.push(moves);
    this.begin();
    for (const { figure, joint, [end]: to } of moves) this.put({ figure, joint, to });
    this.count();
    this.changed();
  }

  /// Which joints of which figure are not where they were found.
  count() {
    for (const { figure } of [...this.done, ...this.undone].flat()) figure.joints_moved.clear();
    for (const { figure, joint } of this.done.flat()) figure.joints_moved.add(joint);
  }

  /// The skeleton file of a figure, as `extract` writes it: what was not moved has the very numbers that were found.
  file(figure) {
    const skeleton = structuredClone(figure.data.skeleton), to_input = to_matrix(figure.data.to_input);
    for (const j of figure.joints_moved) {
      const position = figure.joint_place(j).applyMatrix4(to_input).toArray();
      Object.assign(skeleton.joints[j], { position, confidence: 1 });
      if (j === 0) skeleton.frame.origin = position;
    }
    return `${JSON.stringify(skeleton, null, 1)}\n`;
  }

  /// As a download of the browser.
  save(figure) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.file(figure)], { type: "application/json" }));
    link.download = `${figure.data.name.replace(/^.*[\\/]/, "").replace(/\.[^.]*$/, "")}.json`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  }
}
