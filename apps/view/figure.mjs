// One body: its surface, skeleton, curve, sections and frame, as objects that move together.
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import * as colours from "./colours.mjs";

const usual_height = 1.7; // of what is in no known unit, beside bodies in metres

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
    new LineMaterial({ color: colour, linewidth: width }),
  );
  lines.frustumCulled = false; // they move with the pose
  return lines;
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
    }
    figure.settle();
    return figure;
  }

  constructor(data) {
    this.data = data;
    this.root = new THREE.Group();
    this.meshes = [];
    this.bones = [];
    this.clips = [];
    this.layers = { body: [], skeleton: [], curve: [], sections: [], frame: [] };
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
      mesh.userData = { looks: mesh.material, plain, depth, colours: mesh.geometry.attributes.color };
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
  }

  /// A point of the rig in steps, as the page's data have them.
  point(steps) {
    return new THREE.Vector3(...steps).multiplyScalar(this.data.step);
  }

  size() {
    return new THREE.Box3().setFromObject(this.meshes[0]).getSize(new THREE.Vector3()).length();
  }

  /// Joints as balls and bones as spindles, each a child of the node that moves it.
  add_skeleton() {
    const radius = 0.006 * this.size();
    const ball = new THREE.SphereGeometry(radius, 16, 12);
    this.balls = this.bones.map((bone, j) => {
      const side = this.data.joints[j].side;
      const mesh = new THREE.Mesh(ball, new THREE.MeshBasicMaterial({ color: colours.sides[side] }));
      bone.add(mesh);
      this.layers.skeleton.push(mesh);
      return mesh;
    });
    this.bones.forEach((bone, j) => {
      const children = bone.children.filter((child) => child.isBone);
      const ends = children.map((child) => [child.position, this.data.joints[this.bones.indexOf(child)].side]);
      if (ends.length === 0)
        ends.push([this.point(this.data.joints[j].end).applyMatrix4(this.to_bone[j]), this.data.joints[j].side]);
      for (const [end, side] of ends) {
        const length = end.length();
        if (length < radius / 10) continue;
        const spindle = new THREE.Mesh(
          new THREE.CylinderGeometry(0.25 * radius, 0.8 * radius, length, 10).translate(0, length / 2, 0),
          new THREE.MeshBasicMaterial({ color: colours.sides[side] }),
        );
        spindle.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), end.clone().normalize());
        bone.add(spindle);
        this.layers.skeleton.push(spindle);
      }
    });
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
    this.root.updateMatrixWorld(true);
  }

  /// `scheme`: plain, sides, weights (of `joint`) or looks (the file's own).
  colour(scheme, joint) {
    this.scheme = scheme;
    for (const mesh of this.meshes) {
      const own = scheme === "looks" && this.data.has_looks;
      mesh.material = own ? mesh.userData.looks : mesh.userData.plain;
      mesh.userData.depth.material.visible = !own;
      if (own && mesh.userData.colours) mesh.geometry.setAttribute("color", mesh.userData.colours);
      if (own) continue;
      if (!mesh.isSkinnedMesh || scheme === "plain" || scheme === "looks") colours.paint_plain(mesh.geometry);
      else if (scheme === "sides") colours.paint_sides(mesh.geometry, this.data.joints);
      else colours.paint_weights(mesh.geometry, joint, this.data.joints);
    }
  }

  /// Colours that say something do not get as faint as the plain one.
  fade(opacity) {
    for (const { userData } of this.meshes)
      userData.plain.opacity = this.scheme === "plain" ? opacity : Math.max(opacity, 0.75);
  }

  select(joint) {
    this.balls?.forEach((ball, j) => {
      ball.material.color.copy(j === joint ? colours.selected : colours.sides[this.data.joints[j].side]);
      ball.scale.setScalar(j === joint ? 1.5 : 1);
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
