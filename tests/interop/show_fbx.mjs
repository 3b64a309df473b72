// What runs in the browser: three.js' FBXLoader reads a character and poses it as the tests ask for it.
import * as THREE from "three";
import { FBXLoader } from "three/addons/loaders/FBXLoader.js";
import { packed } from "./packed.mjs";

let character, meshes, mixer, metres;

/// `weights`: of the morph targets, by name; the loader leaves all at 0.
/// \returns the bones' names, and how many morph targets all meshes have.
window.load = async (url, weights) => {
  character = await new FBXLoader().loadAsync(url);
  meshes = [];
  character.traverse((node) => node.isSkinnedMesh && meshes.push(node));
  for (const { morphTargetDictionary, morphTargetInfluences } of meshes)
    for (const [name, i] of Object.entries(morphTargetDictionary ?? {})) morphTargetInfluences[i] = weights[name] ?? 0;
  metres = (character.userData.unitScaleFactor ?? 1) / 100;
  mixer = new THREE.AnimationMixer(character);
  mixer.clipAction(character.animations[0]).setLoop(THREE.LoopOnce).play();
  return {
    bones: [...new Set(meshes.flatMap(({ skeleton }) => skeleton.bones.map(({ name }) => name)))],
    morphs: meshes.reduce((sum, { geometry }) => sum + (geometry.morphAttributes.position?.length ?? 0), 0),
  };
};

/// \returns where all triangles have their corners, in metres, so many seconds from the beginning.
window.pose = (time) => {
  mixer.setTime(time);
  character.updateMatrixWorld(true);
  const place = new THREE.Vector3(), out = [];
  for (const mesh of meshes) {
    const { position } = mesh.geometry.attributes;
    for (let i = 0; i < position.count; ++i) {
      mesh.getVertexPosition(i, place).applyMatrix4(mesh.matrixWorld).multiplyScalar(metres);
      out.push(place.x, place.y, place.z);
    }
  }
  return packed(new Float32Array(out));
};
