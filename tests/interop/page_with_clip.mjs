// A page of `skelgen view` whose first body has a clip that waves: what any program may have put into a GLB.

const element = /(<script id="bodies" type="application\/json">)([^]*?)(<\/script>)/;

/// The GLB with a clip of two seconds in which a joint bends by a right angle and back.
function glb_with_clip(glb, clip, joint) {
  const json_length = glb.readUInt32LE(12);
  const json = JSON.parse(glb.subarray(20, 20 + json_length).toString());
  const data = glb.subarray(20 + json_length + 8);
  const node = json.nodes.findIndex(({ name }) => name === joint);
  const [x, y, z, w] = json.nodes[node].rotation;
  const half = Math.SQRT1_2; // of a right angle's half: sine and cosine
  const bent = [x * half + w * half, y * half + z * half, z * half - y * half, w * half - x * half];
  const added = Buffer.from(new Float32Array([0, 1, 2, x, y, z, w, ...bent, x, y, z, w]).buffer);
  const view = json.bufferViews.push(
    { buffer: 0, byteOffset: data.length, byteLength: 12 },
    { buffer: 0, byteOffset: data.length + 12, byteLength: 48 }) - 2;
  const accessor = json.accessors.push(
    { bufferView: view, componentType: 5126, count: 3, type: "SCALAR", min: [0], max: [2] },
    { bufferView: view + 1, componentType: 5126, count: 3, type: "VEC4" }) - 2;
  json.animations = [{
    name: clip,
    samplers: [{ input: accessor, output: accessor + 1 }],
    channels: [{ sampler: 0, target: { node, path: "rotation" } }],
  }];
  json.buffers[0].byteLength = data.length + added.length;
  let text = Buffer.from(JSON.stringify(json));
  text = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, " ")]);
  const header = Buffer.alloc(20), chunk = Buffer.alloc(8);
  header.write("glTF");
  header.writeUInt32LE(2, 4);
  header.writeUInt32LE(28 + text.length + data.length + added.length, 8);
  header.writeUInt32LE(text.length, 12);
  header.write("JSON", 16);
  chunk.writeUInt32LE(data.length + added.length, 0);
  chunk.write("BIN\0", 4);
  return Buffer.concat([header, text, chunk, data, added]);
}

export function with_clip(page, clip, joint) {
  return page.replace(element, (_, begin, text, end) => {
    const bodies = JSON.parse(text);
    const body = bodies.find(({ joints }) => joints);
    body.glb = glb_with_clip(Buffer.from(body.glb, "base64"), clip, joint).toString("base64");
    return begin + JSON.stringify(bodies).replaceAll("<", "\\u003c") + end;
  });
}
