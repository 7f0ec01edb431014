import { World, ready } from "tact";

await ready();  // loads the WebAssembly, once

// A tetrahedron: three numbers a vertex, metres; three a facet, counter-clockwise seen from outside.
const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
const facets = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];
const moved = (x) => Float64Array.from(positions, (value, i) => (i % 3 === 0 ? value + x : value));

const world = new World();
world.addBody({ positions, facets, name: "left" });
const right = world.addBody({ positions: moved(0.75), facets, name: "right" });

for (let step = 0; step < 4; ++step) {
  const { contacts } = world.detect();
  console.log(`step ${step}: ${contacts.length} contacts`);
  for (const contact of contacts) {
    const names = [contact.a, contact.b].map((body) => world.nameOf(body)).join(" and ");
    console.log(`  ${names}, ${contact.depth.toFixed(2)} m deep, ${contact.facetPairs.length / 2} facet pairs`);
  }
  world.setPositions(right, moved(0.85 + 0.1 * step));  // your program moves the vertices as it likes
}
