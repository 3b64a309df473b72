// One body: its surface, skeleton, curve, sections and frame, as objects that move together.
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import * as colours from "./colours.mjs";
import { is_digit } from "./digits.mjs";

const usual_height = 1.7; // of what is in no known unit, beside bodies in metres
const in_front = 5; // the order in which what is not surface is drawn: behind all surfaces

/// A GLB file, which pages hold as base64 and programs as bytes.
function buffer_of(glb) {
  const bytes = typeof glb === "string" ? Uint8Array.from(atob(glb), (character) => character.charCodeAt(0)) : glb;
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
}

function dispose_material(material) {
  for (const value of Object.values(material)) if (value?.isTexture) (value.dispose(), value.source.data?.close?.());
  material.dispose();
}

function segments(places, colour, width) {
  const lines = new LineSegments2(
    new LineSegmentsGeometry().setPositions(places),
    new LineMaterial({ color: colour, linewidth: width, transparent: true }),
  );
  lines.renderOrder = in_front;
  lines.frustumCulled = false; // they move with the pose
  return lines;
}

/// What is drawn before all that is in front, and does no more than forget how far away the surfaces are.
function curtain() {
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(1, 1),
    new THREE.MeshBasicMaterial({ colorWrite: false, depthWrite: false, depthTest: false, transparent: true }));
  mesh.renderOrder = in_front - 1;
  mesh.frustumCulled = false;
  mesh.onBeforeRender = (renderer) => renderer.clearDepth();
  return mesh;
}

/// A round floor that fades towards its edge; from below it is not there.
function round_floor(radius) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 256;
  const context = canvas.getContext("2d"), light = context.createRadialGradient(128, 128, 0, 128, 128, 128);
  for (const [place, alpha] of [[0, 0.3], [0.35, 0.14], [0.97, 0.07], [0.975, 0.22], [0.99, 0.22], [1, 0]])
    light.addColorStop(place, `rgba(70, 80, 100, ${alpha})`);
  context.fillStyle = light;
  context.fillRect(0, 0, 256, 256);
  const floor = new THREE.Mesh(new THREE.PlaneGeometry(2 * radius, 2 * radius).rotateX(-Math.PI / 2),
    new THREE.MeshBasicMaterial({ map: new THREE.CanvasTexture(canvas), transparent: true, depthWrite: false }));
  floor.renderOrder = -1;
  return floor;
}

export class Figure {
  /// `data` is one body of the page. The returned figure stands on y = 0, its middle above the origin.
  static async load(data) {
    const figure = new Figure(data);
    if (data.glb) await figure.add_surface();
    if (data.joints) {
      figure.add_skeleton();
      if (data.curve) figure.add_curve();
      if (data.sections) figure.add_sections();
      if (data.frame) figure.add_frame();
      figure.inner.add(curtain());
    }
    figure.settle();
    return figure;
  }

  constructor(data) {
    this.data = data;
    this.root = new THREE.Group();
    this.hidden = false;
    this.meshes = [];
    this.bones = [];
    this.clips = [];
    this.layers = { body: [], skeleton: [], curve: [], sections: [], frame: [], floor: [] };
  }

  async add_surface() {
    const gltf = await new GLTFLoader().parseAsync(buffer_of(this.data.glb), "");
    this.clips = gltf.animations;
    this.inner = gltf.scene;
    this.root.add(gltf.scene);
    gltf.scene.traverse((node) => node.isMesh && this.meshes.push(node));
    for (const mesh of this.meshes) {
      if (!mesh.geometry.attributes.normal) mesh.geometry.computeVertexNormals();
      // Depth first, so that of a translucent body the nearest surface alone is seen.
      const depth = mesh.clone();
      if (depth.isSkinnedMesh) depth.bind(mesh.skeleton, mesh.bindMatrix);
      depth.material = new THREE.MeshBasicMaterial({ colorWrite: false });
      depth.frustumCulled = mesh.frustumCulled = false; // poses leave the box of the rest
      depth.renderOrder = 1;
      mesh.renderOrder = 2;
      const plain = new THREE.MeshLambertMaterial({ vertexColors: true, transparent: true });
      mesh.userData = {
        looks: mesh.material, faded: mesh.material.clone(), plain, depth, colours: mesh.geometry.attributes.color,
        is_solid: !mesh.material.transparent && mesh.material.alphaTest === 0,
      };
      mesh.parent.add(depth);
      this.layers.body.push(mesh, depth);
    }
    const skinned = this.meshes.find((mesh) => mesh.isSkinnedMesh);
    if (!skinned) return;
    this.bones = skinned.skeleton.bones;
    this.rest = this.bones.map((bone) => bone.quaternion.clone());
    this.rest_places = this.bones.map((bone) => bone.position.clone());
    gltf.scene.updateMatrixWorld(true);
    this.to_bone = this.bones.map((bone) => bone.matrixWorld.clone().invert());
    this.joints_moved = new Set();
  }

  /// Of the joint with that name; -1 where it has none.
  index(name) {
    return this.data.joints?.findIndex((joint) => joint.name === name) ?? -1;
  }

  /// A point of the rig in steps, as the page's data have them.
  point(steps) {
    return new THREE.Vector3(...steps).multiplyScalar(this.data.step);
  }

  /// Of all that is shown, as no pose and no scale has changed it.
  size() {
    const box = new THREE.Box3();
    for (const mesh of this.meshes) box.union(new THREE.Box3().setFromObject(mesh));
    return box.getSize(new THREE.Vector3()).length();
  }

  /// Joints as balls and bones as spindles, each a child of the node that moves it.
  add_skeleton() {
    this.radius = 0.006 * this.size();
    const ball = new THREE.SphereGeometry(this.radius, 16, 12);
    const spindle = new THREE.CylinderGeometry(0.25 * this.radius, 0.8 * this.radius, 1, 10).translate(0, 0.5, 0);
    const part = (bone, geometry, { name, side }) => {
      const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: colours.sides[side], transparent: true }));
      mesh.renderOrder = in_front;
      mesh.frustumCulled = false;
      mesh.userData.width = is_digit(name) ? 0.4 : 1;
      mesh.scale.setScalar(mesh.userData.width);
      bone.add(mesh);
      this.layers.skeleton.push(mesh);
      return mesh;
    };
    this.balls = this.bones.map((bone, j) => part(bone, ball, this.data.joints[j]));
    this.spindles = this.bones.flatMap((bone, j) => {
      const children = bone.children.filter((child) => child.isBone).map((child) => this.bones.indexOf(child));
      return (children.length > 0 ? children : [null]).map((child) =>
        ({ joint: j, child, mesh: part(bone, spindle, this.data.joints[child ?? j]) }));
    });
    this.lay_spindles();
  }

  /// From each joint to the next ones, or to the limb's end.
  lay_spindles() {
    for (const { joint, child, mesh } of this.spindles) {
      const end = child === null ? this.point(this.data.joints[joint].end).applyMatrix4(this.to_bone[joint])
        : this.rest_places[child].clone();
      const length = end.length();
      mesh.scale.setY(Math.max(length, this.radius / 10));
      mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), end.divideScalar(length || 1));
    }
  }

  /// Where a joint is at rest, in the rig's coordinates.
  joint_place(j) {
    return new THREE.Vector3().setFromMatrixPosition(this.to_bone[j].clone().invert());
  }

  /// Puts a joint elsewhere: the surface and all other joints stay where they are. In the pose at rest.
  move_joint(j, place) {
    const bone = this.bones[j], before = this.to_bone[j].clone();
    const rest = before.clone().invert().setPosition(place);
    const shift = new THREE.Vector3().setFromMatrixPosition(before.clone().multiply(rest)).negate();
    this.to_bone[j] = rest.clone().invert();
    const to_parent = this.to_bone[this.bones.indexOf(bone.parent)] ?? new THREE.Matrix4();
    this.rest_places[j] = place.clone().applyMatrix4(to_parent);
    this.bones.forEach((child, k) => child.parent === bone && this.rest_places[k].add(shift));
    const change = this.to_bone[j].clone().multiply(before.invert());
    for (const skeleton of new Set(this.meshes.filter((mesh) => mesh.isSkinnedMesh).map((mesh) => mesh.skeleton)))
      skeleton.boneInverses[skeleton.bones.indexOf(bone)].premultiply(change);
    for (const line of this.layers.sections) if (line.parent === bone) line.position.add(shift);
    this.lay_spindles();
    this.bend([]);
  }

  add_curve() {
    const { nodes, edges } = this.data.curve;
    this.curve_rest = nodes.map((node) => this.point(node));
    this.curve = segments(new Float32Array(6 * edges.length), colours.curve, 2.5);
    this.inner.add(this.curve);
    this.layers.curve.push(this.curve);
    this.bend_curve();
  }

  /// The curve is skinned here: lines know no bones, and it has a few hundred nodes.
  bend_curve() {
    const { edges, joints, weights } = this.data.curve;
    const moves = this.bones.map((bone, j) =>
      new THREE.Matrix4().copy(this.inner.matrixWorld).invert().multiply(bone.matrixWorld).multiply(this.to_bone[j]));
    const moved = new THREE.Vector3();
    const places = this.curve_rest.map((rest, i) => {
      const place = new THREE.Vector3();
      for (let k = 0; k < 4; ++k)
        if (weights[i][k] > 0) place.addScaledVector(moved.copy(rest).applyMatrix4(moves[joints[i][k]]), weights[i][k]);
      return place;
    });
    const buffer = this.curve.geometry.attributes.instanceStart.data;
    edges.forEach(([a, b], e) => {
      places[a].toArray(buffer.array, 6 * e);
      places[b].toArray(buffer.array, 6 * e + 3);
    });
    buffer.needsUpdate = true;
  }

  add_sections() {
    for (const { joint, points } of this.data.sections) {
      const places = points.map((point) => this.point(point).applyMatrix4(this.to_bone[joint]));
      const line = segments(
        places.flatMap((place, i) => [...place, ...places[(i + 1) % places.length]]), colours.section, 1.5);
      this.bones[joint].add(line);
      this.layers.sections.push(line);
    }
  }

  /// The person's own directions, fixed to the root.
  add_frame() {
    const length = 0.2 * this.size();
    const turn = new THREE.Matrix3().setFromMatrix4(this.to_bone[0]);
    this.arrows = Object.entries(this.data.frame).map(([name, direction]) => {
      const arrow = new THREE.ArrowHelper(
        new THREE.Vector3(...direction).applyMatrix3(turn).normalize(), new THREE.Vector3(), length,
        colours.frame[name], 0.25 * length, 0.12 * length);
      for (const part of [arrow.line, arrow.cone]) {
        part.material.transparent = true;
        part.renderOrder = in_front;
      }
      this.bones[0].add(arrow);
      this.layers.frame.push(arrow);
      return { name, arrow, tip: new THREE.Object3D() };
    });
    for (const { arrow, tip } of this.arrows) {
      tip.position.set(0, length, 0);
      arrow.add(tip);
    }
  }

  /// On the floor, above the origin, in metres or of a person's height.
  settle() {
    if (this.meshes.length === 0) {
      this.box = new THREE.Box3(new THREE.Vector3(-0.4, 0, -0.1), new THREE.Vector3(0.4, usual_height, 0.1));
      return;
    }
    const box = new THREE.Box3();
    for (const mesh of this.meshes) box.expandByObject(mesh);
    const size = box.getSize(new THREE.Vector3()), middle = box.getCenter(new THREE.Vector3());
    const scale = this.data.in_metres ? 1 : usual_height / Math.max(size.x, size.y, size.z);
    this.inner.position.set(-middle.x, -box.min.y, -middle.z).multiplyScalar(scale);
    this.inner.scale.setScalar(scale);
    this.box = new THREE.Box3(
      new THREE.Vector3(-size.x / 2, 0, -size.z / 2), new THREE.Vector3(size.x / 2, size.y, size.z / 2));
    this.box.min.multiplyScalar(scale);
    this.box.max.multiplyScalar(scale);
    // Where the root goes in the clips, there is a floor, too.
    const ways = this.clips.flatMap(({ tracks }) => tracks.filter(({ name }) => name === `${this.bones[0]?.name}.position`));
    const way = Math.max(0, ...ways.map(({ values }) => {
      let far = 0;
      for (let i = 0; i < values.length; i += 3)
        far = Math.max(far, Math.hypot(values[i] - values[0], values[i + 2] - values[2]));
      return far * scale;
    }));
    const floor = round_floor(Math.max(0.3 * size.y, 0.6 * Math.max(size.x, size.z)) * scale + way);
    this.root.add(floor);
    this.layers.floor.push(floor);
    this.root.updateMatrixWorld(true);
  }

  /// `scheme`: plain, sides, weights (of `joint`) or looks (the file's own).
  colour(scheme, joint) {
    this.scheme = scheme;
    for (const mesh of this.meshes) {
      const own = scheme === "looks" && this.data.has_looks;
      if (own && mesh.userData.colours) mesh.geometry.setAttribute("color", mesh.userData.colours);
      if (own) continue;
      if (!mesh.isSkinnedMesh || scheme === "plain" || scheme === "looks") colours.paint_plain(mesh.geometry);
      else if (scheme === "sides") colours.paint_sides(mesh.geometry, this.data.joints);
      else colours.paint_weights(mesh.geometry, joint, this.data.joints);
    }
  }

  /// The surface alone: what is in front of it stays as it is. Of a solid one no more than the nearest place is seen.
  fade(opacity) {
    for (const mesh of this.meshes) {
      const { looks, faded, plain, depth, is_solid } = mesh.userData;
      const own = this.scheme === "looks" && this.data.has_looks;
      plain.opacity = opacity;
      faded.opacity = looks.opacity * opacity;
      faded.transparent = true;
      mesh.material = !own ? plain : opacity < 1 ? faded : looks;
      depth.material.visible = !own || (is_solid && opacity < 1);
    }
  }

  select(joint) {
    this.balls?.forEach((ball, j) => {
      ball.material.color.copy(j === joint ? colours.selected : colours.sides[this.data.joints[j].side]);
      ball.scale.setScalar((j === joint ? 1.5 : 1) * ball.userData.width);
    });
  }

  show(layer, visible) {
    for (const object of this.layers[layer]) object.visible = visible;
  }

  /// Bends the joints from where they are at rest: `bends[j]` are turns about x, y and z in radians.
  bend(bends) {
    this.bones.forEach((bone, j) => {
      bone.position.copy(this.rest_places[j]);
      bone.quaternion.copy(this.rest[j]);
      if (bends[j]) bone.quaternion.multiply(new THREE.Quaternion().setFromEuler(new THREE.Euler(...bends[j], "XZY")));
    });
    this.follow();
  }

  /// Lets go of what the graphics card holds; the figure is not shown any longer.
  dispose() {
    this.root.removeFromParent();
    this.root.traverse(({ geometry, material, skeleton }) => {
      geometry?.dispose();
      skeleton?.dispose();
      if (material) dispose_material(material);
    });
    for (const { userData } of this.meshes) for (const material of [userData.looks, userData.plain]) dispose_material(material);
  }

  /// What the GPU does not move goes where the bones are.
  follow() {
    this.root.updateMatrixWorld(true);
    if (this.curve) this.bend_curve();
  }
}
