// The three-dimensional picture: camera, light, the surfaces, and what is drawn over them.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Surface } from "./surface.js";
import { Thin } from "./thin.js";

function boxOfBody(run, frame, i) {
  const body = run.bodies[i], positions = frame.positions[i], box = new THREE.Box3(), p = new THREE.Vector3();
  if (positions === null || !(body.facets > 0 || body.edges || body.points)) return box;
  for (let k = 0; k < positions.length; k += 3) {
    box.expandByPoint(p.set(positions[k], positions[k + 1], positions[k + 2]));
  }
  const origin = new THREE.Vector3(...body.origin);
  box.min.multiplyScalar(body.step).add(origin);
  box.max.multiplyScalar(body.step).add(origin);
  return box;
}

const diagonal = (box) => box.getSize(new THREE.Vector3()).length();

// All bodies that can be seen; and of these what matters: where bodies touch, a large one only beside one not much smaller.
function boxesOfFrame(run, frame) {
  const boxes = run.bodies.map((_, i) => boxOfBody(run, frame, i)), all = new THREE.Box3(), focus = new THREE.Box3();
  const seen = (i) => run.bodies[i].opacity >= 0.2 && !boxes[i].isEmpty();
  boxes.forEach((box, i) => seen(i) && all.union(box));
  if (all.isEmpty()) for (const box of boxes) all.union(box);
  const kMuchLarger = 3;
  for (const { a, b } of frame.contacts) {
    const smaller = Math.min(diagonal(boxes[a]), diagonal(boxes[b]));
    for (const i of [a, b]) if (seen(i) && diagonal(boxes[i]) <= kMuchLarger * smaller) focus.union(boxes[i]);
  }
  return { all, focus: focus.isEmpty() ? all : focus };
}

export class Stage {
  /** `frame`: what the camera looks at to begin with. */
  constructor(run, frame, element) {
    this.element = element;
    const { all, focus } = boxesOfFrame(run, frame);
    this.center = focus.isEmpty() ? [0, 0, 0] : focus.getCenter(new THREE.Vector3()).toArray();
    this.size = focus.isEmpty() ? 1 : Math.max(diagonal(focus), 1e-9);
    const reach = Math.max(all.isEmpty() ? 0 : diagonal(all), this.size);
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    element.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(32, 1, this.size / 200, Math.max(this.size * 30, reach * 4));
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.surface = new Surface(run);
    this.marks = new THREE.Group();
    this.thin = new Thin(run, this.surface, 2 * Math.max(this.size, all.isEmpty() ? 0 : diagonal(all)), this.center);
    this.scene.add(this.surface.opaque, this.surface.transparent, this.surface.behind, this.thin.group, this.marks);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x445066, 2.2));
    if (!run.bodies.some((body) => body.plane)) this.addGround(all);
    this.numbers = new THREE.WebGLRenderTarget(1, 1);
    this.numberScene = new THREE.Scene();
    this.numberScene.add(this.surface.numbered);
    this.home();
    new ResizeObserver(() => this.resize()).observe(element);
    this.resize();
  }

  addGround(box) {
    if (box.isEmpty()) return;
    const cells = 20, size = Math.max(this.size, diagonal(box)) * 2;
    const grid = new THREE.GridHelper(size, cells, 0x46506a, 0x2c3448);
    grid.rotation.x = Math.PI / 2;
    grid.position.z = box.min.z - this.center[2] - 1e-3 * this.size;
    grid.material.transparent = true;
    grid.material.opacity = 0.55;
    this.scene.add(grid);
  }

  home() {
    const away = 0.95 * this.size / Math.tan((this.camera.fov * Math.PI) / 360);
    this.controls.target.set(0, 0, 0);
    this.camera.position.set(0.55, -0.75, 0.42).normalize().multiplyScalar(away * 0.54);
    this.controls.update();
  }

  /** Moves the camera, without turning it, so that a ball of this radius fills much of the picture. */
  frame(center, radius) {
    const away = this.camera.position.clone().sub(this.controls.target).normalize();
    const distance = (1.9 * Math.max(radius, 1e-3 * this.size)) / Math.tan((this.camera.fov * Math.PI) / 360);
    this.controls.target.copy(center);
    this.camera.position.copy(center).addScaledVector(away, distance);
    this.controls.update();
    this.draw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.drawNow();
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    this.waiting = false;
    this.camera.updateMatrixWorld();
    this.surface.shared.up.value.set(0, 0, 1).transformDirection(this.camera.matrixWorldInverse);
    this.renderer.render(this.scene, this.camera);
    this.onDraw?.();
  }

  /** Where a point is in the picture, in pixels of the page; null if behind the camera. */
  project(point) {
    const p = point.clone().project(this.camera);
    if (p.z > 1) return null;
    const { left, top, width, height } = this.renderer.domElement.getBoundingClientRect();
    return { x: left + ((p.x + 1) / 2) * width, y: top + ((1 - p.y) / 2) * height };
  }

  /** The number of the facet at a place of the page, over all bodies; null if there is none. */
  facetAt(x, y) {
    const { left, top, width, height } = this.renderer.domElement.getBoundingClientRect();
    this.camera.setViewOffset(width, height, x - left, y - top, 1, 1);
    const background = this.renderer.getClearColor(new THREE.Color()), alpha = this.renderer.getClearAlpha();
    this.renderer.setRenderTarget(this.numbers);
    this.renderer.setClearColor(0, 0);
    this.renderer.clear();
    this.renderer.render(this.numberScene, this.camera);
    const pixel = new Uint8Array(4);
    this.renderer.readRenderTargetPixels(this.numbers, 0, 0, 1, 1, pixel);
    this.renderer.setRenderTarget(null);
    this.renderer.setClearColor(background, alpha);
    this.camera.clearViewOffset();
    const number = pixel[0] + 256 * pixel[1] + 65536 * pixel[2] + 16777216 * pixel[3];
    return number === 0 ? null : number - 1;
  }

  /** Position, target: for a link. */
  view() {
    const round = (v) => v.toArray().map((x) => Number((x / this.size).toPrecision(4)));
    return [...round(this.camera.position), ...round(this.controls.target)];
  }

  setView(numbers) {
    if (numbers.length !== 6 || !numbers.every(Number.isFinite)) return;
    this.camera.position.fromArray(numbers).multiplyScalar(this.size);
    this.controls.target.fromArray(numbers, 3).multiplyScalar(this.size);
    this.controls.update();
  }
}
