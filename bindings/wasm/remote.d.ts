import type {
  ArraysInput, Curve, FileInput, FileOptions, FindOptions, FitOptions, JointNames, Measures, MeshArrays, RigFormat, RigJoint, RigOptions,
  Segmentation, Skeleton, Tried,
} from "./skelgen.js";
export { SkelgenError } from "./skelgen.js";

export type RemoteInput = FileInput | ArraysInput | Blob;

export interface CallOptions {
  /** Ends the search, or where memory cannot be shared the worker: then all that it has is gone. */
  signal?: AbortSignal;
}
export interface RemoteExtractOptions extends FindOptions, CallOptions {
  onProgress?: (progress: { spent: number; budget: number }) => void;
}

/** A mesh in the worker. */
export class RemoteMesh {
  private constructor();
  readonly name: string;
  readonly positions: Float64Array;
  readonly faces: Uint32Array;
  readonly glb: Uint8Array | null;
  delete(): void;
}

export class RemoteRig {
  private constructor();
  readonly joints: RigJoint[];
  readonly metresPerUnit: number;
  readonly unitIsKnown: boolean;
  readonly hasLooks: boolean;
  readonly warnings: string[];
  file(format: RigFormat, options?: FileOptions): Promise<Uint8Array>;
  skin(): Promise<MeshArrays & { skinJoints: Uint16Array; skinWeights: Float32Array }>;
  follow(clip: string | Uint8Array | Blob, name?: string): Promise<void>;
  delete(): void;
}

export class RemoteBody {
  private constructor();
  readonly name: string;
  readonly skeleton: Skeleton;
  readonly joints: Skeleton["joints"];
  readonly frame: Skeleton["frame"];
  readonly quality: Skeleton["quality"];
  readonly trail: Tried[];
  readonly repairs: string[];
  curve(): Promise<Curve>;
  segment(options?: { parts?: "bones" | "body" }): Promise<Segmentation>;
  measure(): Promise<Measures>;
  rig(options?: RigOptions): Promise<RemoteRig>;
  fit(skeleton: Skeleton | string, options?: FitOptions): Promise<RemoteBody>;
  delete(): void;
}

/** skelgen in a worker of its own, which is started by the first call. */
export class SkelgenWorker {
  constructor(options?: { worker?: string | URL; wasm?: string });
  readonly version: string;
  readonly jointNames: JointNames[];
  start(): Promise<this>;
  open(input: RemoteInput, options?: CallOptions & { glb?: boolean }): Promise<RemoteMesh>;
  read(input: RemoteInput, options?: CallOptions): Promise<MeshArrays>;
  extract(input: RemoteInput | RemoteMesh, options?: RemoteExtractOptions): Promise<RemoteBody>;
  rig(input: RemoteInput, options?: RemoteExtractOptions & RigOptions & { format?: RigFormat; names?: JointNames }): Promise<Uint8Array>;
  segment(input: RemoteInput, options?: RemoteExtractOptions & { parts?: "bones" | "body" }): Promise<Segmentation>;
  measure(input: RemoteInput, options?: RemoteExtractOptions): Promise<Measures>;
  /** Ends the worker, at whatever it is. */
  stop(): void;
  delete(): void;
}
