// What runs in the browser: loads a character with three.js, draws it, bends it, and tells what came of it.
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { VRMLoaderPlugin } from "@pixiv/three-vrm";

const size = 256;
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(size, size);
document.body.append(renderer.domElement);

/// How much of the picture is not background, and the picture itself.
function draw(scene, camera) {
  renderer.render(scene, camera);
  const pixels = new Uint8Array(size * size * 4);
  const gl = renderer.getContext();
  gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let covered = 0;
  for (let i = 0; i < pixels.length; i += 4) if (pixels[i] + pixels[i + 1] + pixels[i + 2] > 0) ++covered;
  return { pixels, covered: covered / (size * size) };
}

function changed(a, b) {
  let count = 0;
  for (let i = 0; i < a.length; i += 4) if (Math.abs(a[i] - b[i]) > 8) ++count;
  return count / (size * size);
}

/// Where each vertex is, as the GPU would put it.
function skinned(mesh) {
  const place = new THREE.Vector3();
  const out = [];
  for (let i = 0; i < mesh.geometry.attributes.position.count; ++i) {
    mesh.getVertexPosition(i, place);
    out.push(place.x, place.y, place.z);
  }
  return out;
}

window.inspect = async (url) => {
  const loader = new GLTFLoader();
  loader.register((parser) => new VRMLoaderPlugin(parser));
  const gltf = await loader.loadAsync(url);
  const meshes = [];
  gltf.scene.traverse((node) => node.isSkinnedMesh && meshes.push(node));
  const bones = meshes[0].skeleton.bones;
  const scene = new THREE.Scene();
  scene.add(gltf.scene, new THREE.AmbientLight(0xffffff, 1), new THREE.DirectionalLight(0xffffff, 2));
  const box = new THREE.Box3().setFromObject(gltf.scene);
  const middle = box.getCenter(new THREE.Vector3());
  const reach = 0.75 * box.getSize(new THREE.Vector3()).length();
  const camera = new THREE.OrthographicCamera(-reach, reach, reach, -reach, 0, 4 * reach);
  camera.position.set(middle.x + reach, middle.y + reach / 2, middle.z + reach);
  camera.lookAt(middle);

  const still = draw(scene, camera);
  const places = meshes.map(skinned);
  const bends = {};
  for (const [joint, vrm] of [["left_elbow", "leftLowerArm"], ["right_knee", "rightLowerLeg"], ["neck", "neck"]]) {
    const bone = bones.find((b) => b.name === joint || b.name === vrm);
    const at = bone.getWorldPosition(new THREE.Vector3());
    const rest = bone.quaternion.clone();
    bone.rotateX(1);
    gltf.scene.updateMatrixWorld(true);
    let moved = 0, rigid = 0, count = 0;
    meshes.forEach((mesh, m) => {
      const now = skinned(mesh), was = places[m];
      for (let i = 0; i < now.length; i += 3) {
        const d = Math.hypot(now[i] - was[i], now[i + 1] - was[i + 1], now[i + 2] - was[i + 2]);
        const r = Math.hypot(was[i] - at.x, was[i + 1] - at.y, was[i + 2] - at.z);
        if (d > 5e-3 * reach) ++moved;
        if (d > 2 * Math.sin(0.5) * r * 1.01 + 1e-4 * reach) ++rigid; // farther than a turn about the joint takes it
        ++count;
      }
    });
    bends[vrm] = { moved: moved / count, beyond: rigid, picture: changed(still.pixels, draw(scene, camera).pixels) };
    bone.quaternion.copy(rest);
    gltf.scene.updateMatrixWorld(true);
  }
  const humanoid = gltf.userData.vrm?.humanoid;
  return {
    bones: bones.length,
    covered: still.covered,
    bends,
    humanoid: humanoid ? Object.values(humanoid.humanBones).filter((bone) => bone?.node).length : null,
  };
};
window.ready = true;
