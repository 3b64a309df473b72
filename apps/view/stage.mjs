// Where the bodies stand: camera, light, and a picture whenever something has changed.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

export class Stage {
  /// `before` is called with the seconds since the last frame; it returns whether another one is to follow.
  constructor(canvas, before) {
    this.canvas = canvas;
    this.before = before;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2)); // more costs phones time and shows nothing
    this.scene = new THREE.Scene();
    const sky = new THREE.HemisphereLight(0xffffff, 0x8a8378, 1.6);
    this.lamp = new THREE.DirectionalLight(0xffffff, 1.6); // from over the viewer's shoulder
    this.scene.add(sky, this.lamp);
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.01, 1000);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.invalidate());
    this.wanted = false;
    this.last = 0;
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    if (this.box) this.frame(this.box);
    this.invalidate();
  }

  /// Shows all of a box, from where the viewer looks.
  frame(box, direction = this.camera.position.clone().sub(this.controls.target)) {
    this.box = box;
    const size = box.getSize(new THREE.Vector3());
    const half = Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
    const width = Math.max(size.x, size.z) / this.camera.aspect;
    const distance = (0.58 * Math.max(size.y, width)) / half + size.z / 2;
    const centre = box.getCenter(new THREE.Vector3());
    this.camera.position.copy(centre).addScaledVector(direction.normalize(), distance);
    this.camera.near = distance / 100;
    this.camera.far = distance * 20;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(centre);
    this.controls.update();
    this.invalidate();
  }

  front(box) {
    this.frame(box, new THREE.Vector3(0.25, 0.1, 1));
  }

  /// Turns the camera around the bodies, in radians.
  orbit(across, up) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const place = new THREE.Spherical().setFromVector3(offset);
    place.theta += across;
    place.phi = THREE.MathUtils.clamp(place.phi + up, 0.05, Math.PI - 0.05);
    this.camera.position.copy(this.controls.target).add(offset.setFromSpherical(place));
    this.controls.update();
    this.invalidate();
  }

  zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.invalidate();
  }

  invalidate() {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame((now) => this.draw(now));
  }

  draw(now) {
    this.wanted = false;
    const seconds = Math.min((now - this.last) / 1000, 0.1); // a page that was hidden does not leap
    this.last = now;
    const goes_on = this.before(seconds);
    this.lamp.position.copy(this.camera.position);
    this.renderer.render(this.scene, this.camera);
    if (goes_on) this.invalidate();
  }

  /// Where a point of the scene is on the canvas, in pixels from its upper left; null behind the viewer.
  project(point) {
    const p = point.clone().project(this.camera);
    if (p.z > 1) return null;
    return { x: ((p.x + 1) / 2) * this.canvas.clientWidth, y: ((1 - p.y) / 2) * this.canvas.clientHeight };
  }
}
