// The colours of surfaces, bones and joints.
import * as THREE from "three";

export const sides = {
  left: new THREE.Color(0x2e7fd1),
  right: new THREE.Color(0xe0a526),
  none: new THREE.Color(0x8b9096),
};
export const curve = new THREE.Color(0xd2452f);
export const section = new THREE.Color(0x3b7d4f);
export const selected = new THREE.Color(0xe8327c);
export const frame = { left: new THREE.Color(0x2e7fd1), up: new THREE.Color(0x3b9b56), forward: new THREE.Color(0xc9362c) };
const skin = new THREE.Color(0xd9b9a0);
const refused = new THREE.Color(0xb9a3a3);

// From weight 0 to 1: grey, violet, orange, yellow. Lightness rises all the way, so that it reads without hue, too.
const ramp = [0x3d4350, 0x6a3d9a, 0xd9653b, 0xf8e45c].map((hex) => new THREE.Color(hex));

function ramp_colour(weight, out) {
  const place = THREE.MathUtils.clamp(weight, 0, 1) * (ramp.length - 1);
  const below = Math.min(Math.floor(place), ramp.length - 2);
  return out.lerpColors(ramp[below], ramp[below + 1], place - below);
}

/// Fills a geometry's colours by a function of each vertex's joints and weights.
function paint(geometry, colour_of) {
  const { position, skinIndex, skinWeight } = geometry.attributes;
  if (!geometry.userData.painted) // one buffer for all colourings
    geometry.userData.painted = new THREE.BufferAttribute(new Float32Array(3 * position.count), 3);
  const { painted } = geometry.userData;
  const colour = new THREE.Color();
  for (let v = 0; v < position.count; ++v) colour_of(skinIndex, skinWeight, v, colour).toArray(painted.array, 3 * v);
  painted.needsUpdate = true;
  geometry.setAttribute("color", painted);
}

/// How much of a vertex's weight is on joints that `counts` names.
function share(skin_index, skin_weight, v, counts) {
  let sum = 0;
  for (let k = 0; k < 4; ++k) if (counts[skin_index.getComponent(v, k)]) sum += skin_weight.getComponent(v, k);
  return sum;
}

export function paint_plain(geometry) {
  const colour = geometry.attributes.skinIndex ? skin : refused;
  paint(geometry, (_index, _weight, _v, out) => out.copy(colour));
}

/// Left, right and middle by whose joints move a vertex.
export function paint_sides(geometry, joints) {
  const left = joints.map((joint) => joint.side === "left"), right = joints.map((joint) => joint.side === "right");
  const pale = (colour) => colour.clone().lerp(new THREE.Color(1, 1, 1), 0.25);
  const colours = { left: pale(sides.left), right: pale(sides.right), none: pale(sides.none) };
  paint(geometry, (index, weight, v, out) => {
    const l = share(index, weight, v, left), r = share(index, weight, v, right);
    return out.setRGB(0, 0, 0).add(scaled(colours.left, l)).add(scaled(colours.right, r)).add(scaled(colours.none, 1 - l - r));
  });
}

const scratch = new THREE.Color();
const scaled = (colour, factor) => scratch.copy(colour).multiplyScalar(factor);

/// How much one joint moves each vertex.
export function paint_weights(geometry, joint, joints) {
  const only = joints.map((_, j) => j === joint);
  paint(geometry, (index, weight, v, out) => ramp_colour(share(index, weight, v, only), out));
}
