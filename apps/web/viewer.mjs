// What is shown of the body, how it is held, and joints that are dragged. The panel of apps/view asks it for what it shows.
import * as THREE from "three";
import { sides } from "../view/colours.mjs";
import { Labels } from "../view/labels.mjs";
import { Panel, element } from "../view/panel.mjs";
import { Poses } from "../view/poses.mjs";

const unsure = new THREE.Color(0xd0432e), middling = new THREE.Color(0xe8a33d), sure = new THREE.Color(0x2b9a78);

/// From 0, red, by amber to 1, green.
export function confidence_colour(confidence) {
  const colour = new THREE.Color();
  return confidence < 0.5 ? colour.lerpColors(unsure, middling, 2 * confidence) : colour.lerpColors(middling, sure, 2 * confidence - 1);
}

export class Viewer {
  /// `moved(name, place)` is called when a joint was dragged to a place in the rig's coordinates.
  constructor(stage, figure, { state = {}, moved, chosen, is_first }) {
    Object.assign(this, { stage, figure, moved, chosen });
    this.figures = [figure];
    this.poses = new Poses(this.figures);
    this.joints = figure.data.joints ?? [];
    this.has_looks = Boolean(figure.data.has_looks);
    this.shown = { body: true, skeleton: true, names: false, ...state.shown };
    this.scheme = state.scheme ?? "sides"; // its own looks would hide the skeleton
    if (this.scheme === "looks" && !this.has_looks) this.scheme = "sides";
    this.opacity = state.opacity ?? 0.6;
    this.joint = Math.max(0, this.joints.findIndex(({ name }) => name === state.joint));
    this.by_confidence = state.by_confidence ?? false;
    this.correcting = state.correcting ?? false;
    stage.scene.add(figure.root);
    element("labels").replaceChildren();
    this.labels = new Labels(element("labels"), element("tip"), this.joints.length > 0 ? this.figures : []);
    this.labels.tell(null);
    if (this.joints.length > 0) {
      this.panel = new Panel(this, { keys_from: new EventTarget(), is_folded: false }); // the page hears keys
      for (const layer of Object.keys(this.shown)) this.apply_layer(layer);
      this.select(this.joint);
    }
    this.recolour();
    if (is_first) this.see_all();
    else this.stage.invalidate();
    this.listening = new AbortController();
    this.follow_pointer(this.listening.signal);
  }

  /// What the next viewer is to begin with.
  state() {
    const { shown, scheme, opacity, by_confidence, correcting } = this;
    return { shown, scheme, opacity, by_confidence, correcting, joint: this.joints[this.joint]?.name };
  }

  dispose() {
    this.listening.abort();
    this.poses.stop();
    this.figure.dispose();
    element("labels").replaceChildren();
    this.stage.invalidate();
  }

  before_frame(seconds) {
    const moving = this.poses.advance(seconds);
    if (moving) this.panel.show_time();
    this.labels.update(this.stage, this.shown.names, false);
    return moving;
  }

  changed() {
    this.panel?.update();
    this.stage.invalidate();
  }

  apply_layer(layer) {
    if (layer !== "names") this.figure.show(layer, this.shown[layer]);
  }
  toggle(layer) {
    this.shown[layer] = !this.shown[layer];
    this.apply_layer(layer);
    this.changed();
  }
  recolour() {
    this.figure.colour(this.joints.length > 0 ? this.scheme : "plain", this.joint);
    this.set_opacity(this.opacity);
  }
  colour(scheme) {
    this.scheme = scheme;
    this.recolour();
  }
  set_opacity(opacity) {
    this.opacity = opacity;
    this.figure.fade(this.joints.length > 0 ? opacity : 1);
    this.changed();
  }

  select(joint) {
    if (this.joints.length === 0) return;
    this.joint = (joint + this.joints.length) % this.joints.length;
    this.figure.select(this.joint);
    this.colour_joints();
    if (this.scheme === "weights") this.recolour();
    this.changed();
    this.chosen(this.joints[this.joint]);
  }
  show_confidence(by_confidence) {
    this.by_confidence = by_confidence;
    this.select(this.joint);
  }
  colour_joints() {
    if (!this.by_confidence) return;
    this.figure.balls.forEach((ball, j) => j !== this.joint && ball.material.color.copy(confidence_colour(this.joints[j].confidence)));
  }

  bend(turns) {
    this.poses.bend(this.joints[this.joint].name, turns);
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
    this.poses.scrub(part, element("clip").value);
    this.changed();
  }
  play() {
    this.poses.play(element("clip").value);
    this.changed();
  }
  see_all() {
    this.stage.front(this.figure.box);
  }

  correct(correcting) {
    this.correcting = correcting;
    if (correcting) this.rest(); // a place is one of the body at rest
    this.stage.canvas.classList.toggle("correcting", correcting);
  }

  /// A joint's place, and where it would be after a step to the viewer's right, up and towards the viewer; in the rig's
  /// coordinates. Steps are parts of the body's height.
  stepped(joint, [right, up, near]) {
    const bone = this.figure.bones[joint];
    const place = new THREE.Vector3().setFromMatrixPosition(bone.matrixWorld);
    const { camera } = this.stage;
    const axes = [0, 1, 2].map((column) => new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, column));
    const { box: { max, min } } = this.figure;
    const length = 0.01 * (max.y - min.y);
    [right, up, near].forEach((steps, axis) => place.addScaledVector(axes[axis], steps * length));
    return this.figure.inner.worldToLocal(place).toArray();
  }

  /// A mouse finds joints by passing, a finger by touching; both choose by a click, and drag where joints are corrected.
  follow_pointer(signal) {
    const { canvas } = this.stage;
    const hear = (type, act) => canvas.addEventListener(type, act, { signal, capture: true });
    const place_of = (event) => {
      const { left, top } = canvas.getBoundingClientRect();
      return { x: event.clientX - left, y: event.clientY - top };
    };
    const find = (event) => {
      const { x, y } = place_of(event);
      return this.labels.pick(this.stage, x, y, event.pointerType === "touch" ? 28 : 14);
    };
    const ray = new THREE.Raycaster(), plane = new THREE.Plane(), target = new THREE.Vector3();
    let pressed = null, dragged = null;
    const follow = (event) => {
      const { x, y } = place_of(event);
      ray.setFromCamera(new THREE.Vector2((2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight), this.stage.camera);
      if (!ray.ray.intersectPlane(plane, target)) return;
      const ball = this.figure.balls[dragged.joint];
      ball.position.copy(ball.parent.worldToLocal(target.clone()));
      dragged.place = this.figure.inner.worldToLocal(target.clone()).toArray();
      this.stage.invalidate();
    };
    hear("pointermove", (event) => {
      if (dragged) {
        event.stopPropagation();
        return follow(event);
      }
      if (event.buttons === 0) this.labels.tell(find(event));
    });
    hear("pointerleave", (event) => event.pointerType !== "touch" && !dragged && this.labels.tell(null));
    hear("pointerdown", (event) => {
      pressed = { x: event.clientX, y: event.clientY };
      const found = this.correcting ? find(event) : null;
      if (!found || !this.joints[found.joint].motion) return;
      event.stopPropagation(); // the camera stays
      event.preventDefault();
      canvas.setPointerCapture(event.pointerId);
      dragged = { joint: found.joint };
      this.select(found.joint);
      const at = new THREE.Vector3().setFromMatrixPosition(this.figure.bones[found.joint].matrixWorld);
      plane.setFromNormalAndCoplanarPoint(this.stage.camera.getWorldDirection(new THREE.Vector3()), at);
    });
    hear("pointerup", (event) => {
      const was = dragged;
      dragged = null;
      if (was) {
        event.stopPropagation();
        if (was.place) this.moved(this.joints[was.joint].name, was.place);
        return;
      }
      if (!pressed || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > 6) return; // it was a turn
      const found = find(event);
      this.labels.tell(found);
      if (found) this.select(found.joint);
    });
  }
}

export const side_colours = { left: `#${sides.left.getHexString()}`, right: `#${sides.right.getHexString()}` };
