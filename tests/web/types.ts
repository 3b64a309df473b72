// Compiled alone: what the package's types allow, and what they do not.
import { extract, load, rig, SkelgenError, type Body, type Refusal, type Segmentation } from "skelgen";
import { SkelgenWorker } from "skelgen/remote";

export async function use(bytes: Uint8Array, file: File): Promise<number> {
  const body: Body = await extract({ name: "scan.ply", bytes }, { fingers: "auto", hints: { head: [0, 1, 0] } });
  const parts: Segmentation = body.segment({ parts: "body" });
  const glb: Uint8Array = await rig(body, { format: "glb", names: "mixamo", rest: "t-pose" });
  const engine = await load({ wasm: new URL("https://example.org/skelgen.wasm") });
  const { positions } = await engine.read(file);
  const worker = new SkelgenWorker();
  const remote = await worker.extract(file, { onProgress: ({ spent, budget }) => console.log(spent / budget) });
  await (await remote.rig({ rest: "a-pose" })).file("fbx");
  // @ts-expect-error: there is no such format
  body.rig().file("doc");
  // @ts-expect-error: no such rest pose
  body.rig({ rest: "sitting" });
  // @ts-expect-error: a mesh is an object
  await extract(7);
  body.delete();
  return parts.vertexPart.length + glb.length + positions.length;
}

export function why(error: unknown): Refusal | null {
  return error instanceof SkelgenError && error.code === "no_skeleton" ? error.refusal : null;
}
