// A character as its GLB file says it is, without any engine: where its matrices put each vertex, and what covers which
// pixel. Engines are compared with this.

const kinds = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const columns = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };

/// a * b for 4 x 4 matrices, columns one after the other as in glTF.
function product(a, b) {
  const out = new Array(16).fill(0);
  for (let c = 0; c < 4; ++c)
    for (let r = 0; r < 4; ++r) for (let k = 0; k < 4; ++k) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  return out;
}

function matrix({ translation: [x, y, z] = [0, 0, 0], rotation: [i, j, k, w] = [0, 0, 0, 1] }) {
  return [1 - 2 * (j * j + k * k), 2 * (i * j + k * w), 2 * (i * k - j * w), 0,
    2 * (i * j - k * w), 1 - 2 * (i * i + k * k), 2 * (j * k + i * w), 0,
    2 * (i * k + j * w), 2 * (j * k - i * w), 1 - 2 * (i * i + j * j), 0, x, y, z, 1];
}

const turn_about_x = (angle) =>
  [1, 0, 0, 0, 0, Math.cos(angle), Math.sin(angle), 0, 0, -Math.sin(angle), Math.cos(angle), 0, 0, 0, 0, 1];

export class RigFile {
  constructor(bytes) {
    const json_length = bytes.readUInt32LE(12);
    this.json = JSON.parse(bytes.subarray(20, 20 + json_length).toString());
    const data = bytes.subarray(28 + json_length);
    const numbers = (index) => {
      const { bufferView, byteOffset = 0, componentType, count, type } = this.json.accessors[index];
      const Kind = kinds[componentType], length = count * columns[type];
      const start = (this.json.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
      return new Kind(Uint8Array.prototype.slice.call(data, start, start + length * Kind.BYTES_PER_ELEMENT).buffer);
    };
    const skin = this.json.skins[0];
    this.nodes = skin.joints;
    this.names = skin.joints.map((node) => this.json.nodes[node].name);
    this.parents = skin.joints.map((node) => skin.joints.findIndex((one) => this.json.nodes[one].children?.includes(node)));
    const inverses = numbers(skin.inverseBindMatrices);
    this.inverses = skin.joints.map((_, j) => [...inverses.subarray(16 * j, 16 * j + 16)]);
    this.primitives = this.json.meshes.flatMap(({ primitives }) => primitives).map(({ attributes, indices }) => ({
      positions: numbers(attributes.POSITION),
      joints: numbers(attributes.JOINTS_0),
      weights: numbers(attributes.WEIGHTS_0),
      corners: numbers(indices),
    }));
  }

  /// Which vertices follow a joint or those behind it: an array for each primitive.
  followers(name) {
    const behind = this.names.map((one, j) => {
      for (; j >= 0; j = this.parents[j]) if (this.names[j] === name) return true;
      return false;
    });
    return this.primitives.map(({ positions, joints, weights }) => Array.from({ length: positions.length / 3 }, (_, v) =>
      [0, 1, 2, 3].some((k) => weights[4 * v + k] > 0 && behind[joints[4 * v + k]])));
  }

  /// The box of the body at rest, or of those vertices: its middle, and three quarters of its diagonal.
  extent(of = null) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    this.primitives.forEach(({ positions }, part) => positions.forEach((x, i) => {
      if (of && !of[part][Math.floor(i / 3)]) return;
      low[i % 3] = Math.min(low[i % 3], x);
      high[i % 3] = Math.max(high[i % 3], x);
    }));
    const middle = low.map((x, axis) => (x + high[axis]) / 2);
    return { middle, reach: 0.75 * Math.hypot(...high.map((x, axis) => x - low[axis])) };
  }

  /// Where each vertex is when a joint is turned about its own x: an array for each primitive. No joint: at rest.
  posed(bent, angle) {
    const places = [];
    this.nodes.forEach((node, j) => {
      let own = matrix(this.json.nodes[node]);
      if (this.names[j] === bent) own = product(own, turn_about_x(angle));
      places.push(this.parents[j] < 0 ? own : product(places[this.parents[j]], own));
    });
    const moves = places.map((place, j) => product(place, this.inverses[j]));
    return this.primitives.map(({ positions, joints, weights }) => positions.map((_, i) => {
      const v = Math.floor(i / 3), row = i % 3;
      let sum = 0;
      for (let k = 0; k < 4; ++k) {
        const m = moves[joints[4 * v + k]], at = 3 * v;
        sum += weights[4 * v + k] *
          (m[row] * positions[at] + m[4 + row] * positions[at + 1] + m[8 + row] * positions[at + 2] + m[12 + row]);
      }
      return sum;
    }));
  }
}

/// Where all pictures are taken from: in parallel, from the body's left, above and front.
export const view_direction = [2 / 3, 1 / 3, 2 / 3];

/// Which pixels of a square picture, as far as `reach` around `middle`, the faces cover: size x size of 0 and 1, the
/// uppermost row first.
export function silhouette(rig, places, size, { middle, reach }) {
  const [x, y, z] = view_direction, level = Math.hypot(x, z);
  const right = [z / level, 0, -x / level], up = [(-x * y) / level, level, (-y * z) / level];
  const dot = (d, p, at) => d[0] * (p[at] - middle[0]) + d[1] * (p[at + 1] - middle[1]) + d[2] * (p[at + 2] - middle[2]);
  const out = new Uint8Array(size * size);
  rig.primitives.forEach(({ corners }, i) => {
    for (let f = 0; f < corners.length; f += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => {
        const at = 3 * corners[f + k];
        return [((dot(right, places[i], at) / reach + 1) / 2) * size, ((1 - dot(up, places[i], at) / reach) / 2) * size];
      });
      fill(out, size, a, b, c);
    }
  });
  return out;
}

/// Sets the pixels whose centres lie in a triangle.
function fill(out, size, a, b, c) {
  const side = (p, q, x, y) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
  const range = (axis) => [Math.max(0, Math.floor(Math.min(a[axis], b[axis], c[axis]))),
    Math.min(size - 1, Math.ceil(Math.max(a[axis], b[axis], c[axis])))];
  const [left, right] = range(0), [top, bottom] = range(1);
  for (let row = top; row <= bottom; ++row)
    for (let column = left; column <= right; ++column) {
      const x = column + 0.5, y = row + 0.5;
      const s = side(a, b, x, y), t = side(b, c, x, y), u = side(c, a, x, y);
      if ((s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0)) out[size * row + column] = 1;
    }
}
