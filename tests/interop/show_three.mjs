// What runs in the browser: three.js, with three-vrm, shows a character as the tests ask for it.
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { VRMLoaderPlugin } from "@pixiv/three-vrm";
import { packed } from "./packed.mjs";

let renderer, gltf, scene, meshes, bones, rests;

window.engine = {
  /// Loads a character. \returns the bones' names, and how many of a humanoid's VRM has found.
  async load(url, size) {
    if (!renderer) {
      renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
      document.body.append(renderer.domElement);
    }
    renderer.setSize(size, size);
    const loader = new GLTFLoader();
    loader.register((parser) => new VRMLoaderPlugin(parser));
    gltf = await loader.loadAsync(url);
    scene = new THREE.Scene();
    scene.add(gltf.scene);
    scene.overrideMaterial = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide });
    meshes = [];
    gltf.scene.traverse((node) => node.isSkinnedMesh && meshes.push(node));
    for (const mesh of meshes) mesh.frustumCulled = false;
    bones = meshes[0].skeleton.bones;
    rests = bones.map((bone) => bone.quaternion.clone());
    const human_bones = gltf.userData.vrm?.humanoid?.humanBones;
    return {
      bones: bones.map(({ name }) => name),
      humanoid: human_bones ? Object.entries(human_bones).filter(([, bone]) => bone?.node).map(([name]) => name) : null,
    };
  },

  /// Turns a bone about its own x, at rest none. \returns where each mesh's vertices are, and the picture.
  async show(bent, angle, { middle, reach, depth, direction }) {
    bones.forEach((bone, j) => {
      bone.quaternion.copy(rests[j]);
      if (bone.name === bent) bone.rotateX(angle);
    });
    scene.updateMatrixWorld(true);
    const place = new THREE.Vector3();
    const places = meshes.map((mesh) => {
      const out = new Float32Array(3 * mesh.geometry.attributes.position.count);
      for (let i = 0; i < out.length / 3; ++i)
        mesh.getVertexPosition(i, place).applyMatrix4(mesh.matrixWorld).toArray(out, 3 * i);
      return packed(out);
    });
    const camera = new THREE.OrthographicCamera(-reach, reach, reach, -reach, 0, 4 * depth);
    camera.position.set(...middle).addScaledVector(new THREE.Vector3(...direction), 2 * depth);
    camera.lookAt(...middle);
    renderer.render(scene, camera);
    const { width, height } = renderer.domElement;
    const pixels = new Uint8Array(4 * width * height);
    const gl = renderer.getContext();
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return { places, pixels: packed(pixels) };
  },
};
