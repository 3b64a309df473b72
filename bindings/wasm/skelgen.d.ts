/** A file: its name tells the format where its content does not. */
export interface FileInput {
  name?: string;
  bytes: Uint8Array | ArrayBuffer | Blob | string;
  /** What it refers to, by the names that it has for that: a glTF's .bin, an OBJ's .mtl and pictures. */
  files?: Record<string, Uint8Array | ArrayBuffer | Blob | string>;
}

/** Vertices and faces, three entries each. */
export interface ArraysInput {
  positions: Float64Array | Float32Array;
  faces: Uint32Array | Uint16Array | Int32Array;
  name?: string;
}

export type MeshInput = FileInput | ArraysInput | Blob | Body;

export interface MeshArrays {
  positions: Float64Array;
  faces: Uint32Array;
}

export type ErrorCode = "usage" | "bad_input" | "no_skeleton" | "not_written" | "internal" | "cancelled" | "out_of_memory";

export type Refusal =
  | "several_bodies" | "nothing_enclosed" | "too_compact" | "too_few_ends" | "too_many_ends"
  | "curve_in_pieces" | "flat_trunk" | "no_mirror" | "unlikely";

/** One thing that the search tried. */
export interface Tried {
  surface: string;
  opened: string;
  cuts: number;
  held: string;
  lacking: boolean;
  curve: string;
  outcome: string;
  probability: number;
  seconds: number;
}

export class SkelgenError extends Error {
  constructor(what: { code: ErrorCode; message: string; refusal?: Refusal | null; trail?: string });
  readonly code: ErrorCode;
  /** Why no skeleton was found, where `code` is no_skeleton. */
  readonly refusal: Refusal | null;
  readonly trail: Tried[];
}

export type Point = [number, number, number];
export type Side = "left" | "right" | "none";

export interface Joint {
  name: string;
  parent: string | null;
  /** In the mesh's own coordinates; not there where the limb is missing. */
  position?: Point;
  radius?: number;
  confidence?: number;
  present?: boolean;
  fused?: string[];
}

/** As the skeleton's file has it. */
export interface Skeleton {
  format: "skelgen-skeleton";
  version: number;
  template: string;
  joints: Joint[];
  end_points: Record<string, Point>;
  frame: { origin: Point; left: Point; forward: Point; up: Point };
  quality: { sides_confidence: number; matched_nodes: number; warnings: string[]; side_votes: Record<string, number> };
  mesh?: { file: string; vertices: number; faces: number; geodesic_diameter: number };
  timings_ms?: Record<string, number>;
}

export interface FitOptions {
  /** Joints of the fingers: none (as it is), all, or where the surface shows some. */
  fingers?: "off" | "auto" | "on";
  /** Joints of single toes, where the surface shows them (no). */
  toes?: boolean;
  /** Which of several bodies that stand apart; 1 is the largest. */
  component?: number;
}

export interface FindOptions extends FitOptions {
  template?: "human21" | "human51";
  /** Whether the curve skeleton comes out, too. */
  curve?: boolean;
  /** Where joints are, in the mesh's coordinates. */
  hints?: Record<string, Point>;
}

export interface ExtractOptions extends FindOptions {
  /** Called before each try, with what of the budget is spent; the search ends where it returns false. */
  progress?: (spent: number, budget: number) => boolean | void;
  signal?: AbortSignal;
  /** Of shared memory; the search ends when its first entry is not 0. */
  flag?: Int32Array;
}

export type RestPose = "as-is" | "t-pose" | "a-pose";
export type RigFormat = "glb" | "vrm" | "fbx" | "bvh";
export type JointNames = "skelgen" | "smpl" | "smplx" | "mixamo" | "vrm" | "unity" | "godot" | "unreal" | "rigify" | "mesh2motion-fox" | "mesh2motion-horse";

export interface RigOptions {
  rest?: RestPose;
  place?: "keep" | "centre" | "floor";
  fingers?: "off" | "auto" | "on";
  toes?: boolean;
  /** Metres in the mesh's unit (as the height tells). */
  metresPerUnit?: number;
  title?: string;
  author?: string;
  license?: string;
}

export interface FileOptions {
  names?: JointNames;
  /** Whether the motions that it follows are in the file (they are). */
  animations?: boolean;
}

export interface RigJoint {
  name: string;
  /** Index of another, or -1. */
  parent: number;
  side: Side;
  position: number[];
  end: number[];
  confidence: number;
  /** From the mesh, in metres, to the rig: a quaternion x, y, z, w and a translation; none for fingers. */
  motion: number[] | null;
}

export interface Segmentation {
  parts: string[];
  vertexPart: Int32Array;
  facePart: Int32Array;
}

export interface Curve {
  nodes: Float64Array;
  edges: Int32Array;
  radii: Float64Array;
}

export type Measures = Record<string, unknown>;

/** A mesh bound to joints. Holds memory until it is deleted. */
export class Rig {
  private constructor();
  readonly joints: RigJoint[];
  readonly positions: Float64Array;
  readonly faces: Uint32Array;
  /** Four for each vertex. */
  readonly skinJoints: Uint16Array;
  readonly skinWeights: Float32Array;
  readonly metresPerUnit: number;
  readonly unitIsKnown: boolean;
  readonly hasLooks: boolean;
  readonly warnings: string[];
  file(format: RigFormat, options?: FileOptions): Uint8Array;
  /** Has it move as the skeleton of a BVH file does. */
  follow(clip: string | Uint8Array | Blob, name?: string): Promise<void>;
  delete(): void;
}

/** A body that was found in a mesh. Holds memory until it is deleted. */
export class Body {
  private constructor();
  readonly name: string;
  readonly skeleton: Skeleton;
  readonly joints: Joint[];
  readonly frame: Skeleton["frame"];
  readonly quality: Skeleton["quality"];
  readonly trail: Tried[];
  readonly repairs: string[];
  readonly positions: Float64Array;
  readonly faces: Uint32Array;
  readonly curve: Curve;
  /** The text of the skeleton's file. */
  toJSONText(): string;
  segment(options?: { parts?: "bones" | "body" }): Segmentation;
  measure(): Measures;
  rig(options?: RigOptions): Rig;
  /** The same mesh with a skeleton that was put right. */
  fit(skeleton: Skeleton | string, options?: FitOptions): Body;
  delete(): void;
}

/** One WebAssembly with its memory. */
export class Skelgen {
  static load(options?: LoadOptions): Promise<Skelgen>;
  private constructor();
  readonly version: string;
  readonly jointNames: JointNames[];
  /** A fault has brought it to a halt: load another one. */
  readonly crashed: boolean;
  read(input: MeshInput): Promise<MeshArrays>;
  extract(input: MeshInput, options?: ExtractOptions): Promise<Body>;
  rig(input: MeshInput, options?: ExtractOptions & RigOptions & { format?: RigFormat; names?: JointNames }): Promise<Uint8Array>;
  segment(input: MeshInput, options?: ExtractOptions & { parts?: "bones" | "body" }): Promise<Segmentation>;
  measure(input: MeshInput, options?: ExtractOptions): Promise<Measures>;
}

export interface LoadOptions {
  /** Where the .wasm is, its bytes, or what it was compiled to; else it is beside the module. */
  wasm?: string | URL | ArrayBuffer | Uint8Array | WebAssembly.Module;
}

export function load(options?: LoadOptions): Promise<Skelgen>;
export const read: Skelgen["read"];
export const extract: Skelgen["extract"];
export const rig: Skelgen["rig"];
export const segment: Skelgen["segment"];
export const measure: Skelgen["measure"];
