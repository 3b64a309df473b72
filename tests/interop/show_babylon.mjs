// What runs in the browser: Babylon.js shows a character as the tests ask for it.
import { packed } from "./packed.mjs";

const canvas = document.createElement("canvas");
document.body.append(canvas);
let engine, scene, meshes, nodes, rests;

window.engine = {
  /// Loads a character. \returns the bones' names. VRM is GLB to it.
  async load(url, size) {
    canvas.width = canvas.height = size;
    engine ??= new BABYLON.Engine(canvas, false, { preserveDrawingBuffer: true });
    engine.setSize(size, size);
    scene?.dispose();
    scene = new BABYLON.Scene(engine);
    scene.useRightHandedSystem = true; // as glTF
    scene.clearColor = new BABYLON.Color4(0, 0, 0, 1);
    const loaded = await BABYLON.ImportMeshAsync(url, scene, { pluginExtension: ".glb" });
    loaded.animationGroups.forEach((group) => group.stop());
    meshes = loaded.meshes.filter((mesh) => mesh.skeleton);
    const white = new BABYLON.StandardMaterial("white", scene);
    white.emissiveColor = BABYLON.Color3.White();
    white.disableLighting = true;
    white.backFaceCulling = false;
    for (const mesh of meshes) {
      mesh.material = white;
      mesh.alwaysSelectAsActiveMesh = true;
    }
    nodes = meshes[0].skeleton.bones.map((bone) => bone.getTransformNode());
    rests = nodes.map((node) => node.rotationQuaternion.clone());
    return { bones: meshes[0].skeleton.bones.map(({ name }) => name), humanoid: null };
  },

  /// Turns a bone about its own x, at rest none. \returns where each mesh's vertices are, and the picture.
  async show(bent, angle, { middle, reach, depth, direction }) {
    nodes.forEach((node, j) => {
      const turn = BABYLON.Quaternion.RotationAxis(BABYLON.Axis.X, node.name === bent ? angle : 0);
      node.rotationQuaternion = rests[j].multiply(turn);
    });
    const target = new BABYLON.Vector3(...middle);
    const camera = new BABYLON.TargetCamera("camera", target.add(new BABYLON.Vector3(...direction).scale(2 * depth)), scene);
    camera.setTarget(target);
    camera.mode = BABYLON.Camera.ORTHOGRAPHIC_CAMERA;
    [camera.orthoLeft, camera.orthoRight, camera.orthoBottom, camera.orthoTop] = [-reach, reach, -reach, reach];
    [camera.minZ, camera.maxZ] = [0.01 * reach, 4 * depth];
    scene.activeCamera = camera;
    await scene.whenReadyAsync();
    scene.render();
    const place = new BABYLON.Vector3();
    const places = meshes.map((mesh) => {
      const out = new Float32Array(mesh.getPositionData(true, false));
      for (let i = 0; i < out.length; i += 3) {
        BABYLON.Vector3.TransformCoordinatesFromFloatsToRef(out[i], out[i + 1], out[i + 2], mesh.getWorldMatrix(), place);
        place.toArray(out, i);
      }
      return packed(out);
    });
    const pixels = await engine.readPixels(0, 0, canvas.width, canvas.height);
    camera.dispose();
    return { places, pixels: packed(pixels) };
  },
};
