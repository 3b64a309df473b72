// Texts over the picture: the names of joints, directions and bodies, and what is under the pointer.
import * as THREE from "three";
import { is_digit } from "./digits.mjs";

const place = new THREE.Vector3();

function put(element, at, shift) {
  element.hidden = at === null;
  if (at) element.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px) ${shift}`;
}

function label(parent, kind, text) {
  const element = document.createElement("div");
  element.className = kind;
  element.textContent = text;
  parent.append(element);
  return element;
}

export class Labels {
  constructor(parent, tip, figures) {
    this.tip = tip;
    this.figures = figures;
    this.bodies = figures.map((figure) => {
      const element = label(parent, "body", "");
      label(element, "name", figure.data.name).classList.toggle("failure", "failure" in figure.data);
      if (figure.data.failure) label(element, "failure reason", figure.data.failure);
      return element;
    });
    this.joints = figures.flatMap((figure) => figure.bones.map((bone, j) => ({
      figure, object: bone, element: label(parent, "joint", figure.data.joints[j].name),
      order: is_digit(figure.data.joints[j].name) ? 1 : 0,
    })));
    this.directions = figures.flatMap((figure) => (figure.arrows ?? []).map(({ name, tip: end }) => ({
      figure, object: end, element: label(parent, "joint", name), order: 0,
    })));
  }

  /// Puts all texts where their objects are on the stage.
  update(stage, names, frame) {
    this.figures.forEach((figure, i) => {
      const { x, y, z } = figure.root.position;
      put(this.bodies[i], figure.hidden ? null : stage.project(place.set(x, y, z)), "translate(-50%, 14px)");
      if (this.figures.length > 1) this.fit(this.bodies[i], stage, figure);
    });
    const wanted = [...(names ? this.joints : []), ...(frame ? this.directions : [])];
    for (const one of [...this.joints, ...this.directions]) if (!wanted.includes(one)) one.element.hidden = true;
    this.lay(stage, wanted);
  }

  /// Each name beside its joint, away from the body's middle where no other is yet, or a little higher or lower; the nearest
  /// come first, digits last. Where there is no room for one, it is left out.
  lay(stage, labels) {
    const laid = [];
    for (const figure of this.figures)
      figure.middle = figure.bones.length > 0
        ? stage.project(place.setFromMatrixPosition(figure.bones[0].matrixWorld))?.x ?? null : null;
    const seen = labels.map((one) => {
      one.at = one.figure.hidden ? null : stage.project(place.setFromMatrixPosition(one.object.matrixWorld));
      one.element.hidden = one.at === null;
      one.far = stage.camera.position.distanceToSquared(place);
      return one;
    }).filter((one) => one.at).sort((a, b) => a.order - b.order || a.far - b.far);
    for (const one of seen) one.size ??= { x: one.element.offsetWidth, y: one.element.offsetHeight };
    for (const { figure, at, element, size } of seen) {
      const outward = figure.middle !== null && at.x < figure.middle ? [-6 - size.x, 6] : [6, -6 - size.x];
      const spots = [0, 1, -1, 2, -2].flatMap((row) => outward.map((x) =>
        ({ left: at.x + x, right: at.x + x + size.x, top: at.y + (row - 0.5) * size.y, bottom: at.y + (row + 0.5) * size.y })));
      const spot = spots.find((a) => !laid.some((b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom));
      [element.dataset.x, element.dataset.y] = [at.x.toFixed(1), at.y.toFixed(1)];
      element.hidden = !spot;
      if (!spot) continue;
      laid.push(spot);
      put(element, { x: spot.left, y: spot.top }, "");
    }
  }

  /// A body's text does not run into those beside it: names are cut short, and without room for a reason, the list has it.
  fit(element, stage, { root: { position }, slot }) {
    const [from, to] = [-0.5, 0.5].map((part) => stage.project(place.copy(position).setX(position.x + part * slot)));
    if (!from || !to) return;
    const room = Math.max(Math.round(Math.hypot(to.x - from.x, to.y - from.y)), 24);
    if (element.dataset.room === String(room)) return;
    element.dataset.room = String(room);
    element.style.maxWidth = `min(16em, ${room}px)`;
    element.classList.toggle("narrow", room < 80);
  }

  /// The joint nearest to a place on the canvas within `reach` pixels, in front of others at about the same place.
  pick(stage, x, y, reach) {
    let best = null;
    for (const figure of this.figures.filter(({ hidden }) => !hidden))
      figure.bones.forEach((bone, joint) => {
        const at = stage.project(place.setFromMatrixPosition(bone.matrixWorld));
        const distance = at ? Math.hypot(at.x - x, at.y - y) : Infinity;
        if (distance <= reach && (best === null || distance < best.distance)) best = { figure, joint, distance, at };
      });
    return best;
  }

  tell(picked) {
    this.tip.style.visibility = picked ? "visible" : "hidden";
    if (!picked) return;
    const { name, confidence } = picked.figure.data.joints[picked.joint];
    this.tip.textContent = `${name}: confidence ${confidence.toFixed(2)}`;
    put(this.tip, picked.at, "translate(12px, -120%)");
  }
}
