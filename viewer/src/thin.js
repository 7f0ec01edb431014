// What has no facets: ropes as lines, grains as points, planes as grids.
import * as THREE from "three";

const kCells = 24; // of a plane's grid, along a side

/** A grid in the plane z = 0, 1 wide. */
function gridLines() {
  const segments = [];
  for (let i = 0; i <= kCells; ++i) {
    const t = i / kCells - 0.5;
    segments.push(t, -0.5, 0, t, 0.5, 0, -0.5, t, 0, 0.5, t, 0);
  }
  return new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(segments, 3));
}

export class Thin {
  /** `size`: how wide planes are drawn, `center`: what the scene is drawn around. */
  constructor(run, surface, size, center) {
    this.surface = surface;
    this.group = new THREE.Group();
    this.bodies = run.bodies.flatMap((body, i) => (body.edges || body.points || body.plane ? [this.make(body, i, size, center)] : []));
  }

  make(body, number, size, center) {
    const one = { number, body, parts: [] };
    const add = (made) => {
      made.frustumCulled = false;
      made.material.transparent = true;
      one.parts.push(made);
      this.group.add(made);
    };
    const moving = (vertices) => new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(3 * vertices.length, 3));
    if (body.edges) add(new THREE.LineSegments(moving(body.edges), new THREE.LineBasicMaterial()));
    if (body.points) add(new THREE.Points(moving(body.points), new THREE.PointsMaterial({ size: 7, sizeAttenuation: false })));
    if (body.plane) {
      const [x, y, z, offset] = body.plane, normal = new THREE.Vector3(x, y, z);
      const grid = new THREE.LineSegments(gridLines(), new THREE.LineBasicMaterial());
      grid.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
      grid.position.copy(normal).multiplyScalar(offset - normal.dot(new THREE.Vector3(...center)));
      grid.scale.setScalar(size);
      add(grid);
    }
    return one;
  }

  /** Where the surfaces' vertices were placed last. */
  place() {
    const at = new THREE.Vector3();
    for (const { number, body, parts } of this.bodies) {
      parts.forEach((part) => {
        const vertices = part.isPoints ? body.points : body.plane ? [] : body.edges, to = part.geometry.attributes.position;
        vertices.forEach((v, i) => to.setXYZ(i, ...this.surface.vertex(number, v, at).toArray()));
        to.needsUpdate = true;
      });
    }
  }

  look(colors, opacities) {
    for (const { number, body, parts } of this.bodies) {
      for (const part of parts) {
        part.material.color.setRGB(...colors[number], THREE.SRGBColorSpace);
        part.material.opacity = (body.plane ? 0.5 : 1) * opacities[number];
        part.visible = opacities[number] > 0.01;
      }
    }
  }
}
