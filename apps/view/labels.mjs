// Texts over the picture: the names of joints, directions and bodies, and what is under the pointer.
import * as THREE from "three";

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
      object: bone, element: label(parent, "joint", figure.data.joints[j].name),
    })));
    this.directions = figures.flatMap((figure) => (figure.arrows ?? []).map(({ name, tip: end }) => ({
      object: end, element: label(parent, "joint", name),
    })));
  }

  /// Puts all texts where their objects are on the stage.
  update(stage, names, frame) {
    this.figures.forEach((figure, i) => {
      const { x, y, z } = figure.root.position;
      put(this.bodies[i], stage.project(place.set(x, y, z)), "translate(-50%, 14px)");
      if (this.figures.length > 1) this.fit(this.bodies[i], stage, figure);
    });
    const of = (labels, shown) => {
      for (const { object, element } of labels)
        put(element, shown ? stage.project(place.setFromMatrixPosition(object.matrixWorld)) : null, "translate(6px, -50%)");
    };
    of(this.joints, names);
    of(this.directions, frame);
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
    for (const figure of this.figures)
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
