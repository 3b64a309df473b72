// What runs beside a page: does what `remote.mjs` asks for, one thing after the other, and keeps what it made by number.
import { Skelgen, SkelgenError } from "./skelgen.mjs";

const isNode = typeof self === "undefined";
const port = isNode ? (await import(["node", "worker_threads"].join(":"))).parentPort : self;
const send = (message, moved = []) => port.postMessage(message, moved);

let skelgen = null;
const kept = new Map();
let last = 0;
const keep = (thing) => {
  kept.set(++last, thing);
  return last;
};
const find = (id) => kept.get(id) ?? (() => { throw new SkelgenError({ code: "usage", message: "it was deleted" }); })();

/// What a page wants to know of a body at once.
const told = (body) => ({ id: keep(body), name: body.name, skeleton: body.skeleton, trail: body.trail, repairs: body.repairs });

const acts = {
  async load({ wasm }) {
    skelgen = await Skelgen.load({ wasm });
    return { version: skelgen.version, jointNames: skelgen.jointNames };
  },
  async open({ input, glb }) {
    const { mesh, name } = await skelgen.mesh(input);
    const positions = mesh.ask("positions"), faces = mesh.ask("faces");
    return { id: keep({ mesh, name }), name, positions, faces, glb: glb ? mesh.glb : null };
  },
  extract({ mesh: id, options, flag }, call) {
    const { mesh, name } = find(id);
    const progress = (spent, budget) => void send({ call, progress: { spent, budget } });
    return told(skelgen.found(mesh, name, { ...options, flag, progress }));
  },
  fit: ({ body, skeleton, options }) => told(find(body).fit(skeleton, options)),
  segment: ({ body, options }) => find(body).segment(options),
  measure: ({ body }) => find(body).measure(),
  curve: ({ body }) => find(body).curve,
  rig({ body, options }) {
    const rig = find(body).rig(options);
    const { joints, metresPerUnit, unitIsKnown, hasLooks, warnings } = rig;
    return { id: keep(rig), joints, metresPerUnit, unitIsKnown, hasLooks, warnings };
  },
  skin: ({ rig: id }) => {
    const rig = find(id);
    return { positions: rig.positions, faces: rig.faces, skinJoints: rig.skinJoints, skinWeights: rig.skinWeights };
  },
  file: ({ rig, format, options }) => find(rig).file(format, options),
  follow: ({ rig, clip, name }) => find(rig).follow(clip, name),
  delete({ id }) {
    const thing = kept.get(id);
    kept.delete(id);
    if (thing?.mesh && thing.name && !thing.delete) thing.mesh.release();
    else thing?.delete();
  },
};

/// The memory that arrays have of their own goes with them.
const buffers = (value) =>
  ArrayBuffer.isView(value) ? [value.buffer]
  : value && typeof value === "object" && !Array.isArray(value) ? Object.values(value).flatMap(buffers) : [];

const queue = [];
let working = false;
async function work() {
  if (working) return;
  working = true;
  for (let next; (next = queue.shift()); ) {
    const { call, act, values } = next;
    try {
      const result = await acts[act](values, call);
      send({ call, result }, [...new Set(buffers(result))]);
    } catch (error) {
      const known = error instanceof SkelgenError;
      send({ call, error: {
        code: known ? error.code : "internal",
        message: known ? error.message : `a fault of skelgen's own, please report it: ${error?.message ?? error}`,
        refusal: error.refusal, trail: error.trail ? JSON.stringify({ tried: error.trail }) : undefined,
        crashed: skelgen?.crashed ?? false,
      } });
    }
  }
  working = false;
}
const take = (message) => {
  queue.push(message);
  work();
};
if (isNode) port.on("message", take);
else port.onmessage = ({ data }) => take(data);
