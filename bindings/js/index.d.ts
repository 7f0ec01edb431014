/** tact for JavaScript: finds where many deformable bodies touch. Lengths are metres. Enums are words, as "sheet". Whole numbers
 *  that do not fit are an "invalid_argument"; bits, as of layers and masks, may have a sign, ~0 say. */

/** Loads tact. Everything else comes after it. */
export function ready(): Promise<void>;
/** The version of tact. */
export function version(): string;

/** What is wrong with a call; nothing has changed. */
export class TactError extends Error {
  /** One of tact's codes, such as "stale_body", or "stale_report". */
  readonly code: string;
  constructor(code: string, message: string);
}

/** Numbers one after the other, or in rows of one length. */
type Numbers = ArrayLike<number> | number[][];
/** Three numbers a vertex. Float64Array and Float32Array in tact's memory (SharedArray) are read where they are. */
export type Positions = Float64Array | Float32Array | SharedArray<Float64Array> | SharedArray<Float32Array> | Numbers;
/** Vertices of facets, three each, or of edges, two each. */
export type Indices = Int32Array | Uint32Array | Uint16Array | Numbers;
export type Vector = [number, number, number];

type TypedArray = Float64Array | Float32Array | Int32Array | Uint32Array | Uint16Array | Uint8Array;
/** A typed array in tact's memory, which is read there without a copy. */
export class SharedArray<Kind extends TypedArray = TypedArray> {
  constructor(kind: { new (length: number): Kind; BYTES_PER_ELEMENT: number }, length: number);
  /** The numbers. Take it anew after every call of tact: memory that grew moves. */
  readonly array: Kind;
  free(): void;
}

/** Names a body of one world. The same object wherever tact gives it out. */
export interface Body {
  readonly index: number;
  readonly generation: number;
  readonly world: number;
}

export type Accuracy = "hulls" | "paper" | "exact";
export type DirectionPolicy = "carried" | "smallest";
export type Surface = "closed" | "sheet";
export type Motion = "deformable" | "fixed" | "rigid";
export type Impacts = "all" | "first_of_pair" | "first";
/** The features of bodies a and b, by name; in arrays the index of the name. */
export type FeaturePair = "vertex_facet" | "facet_vertex" | "edge_edge" | "vertex_edge" | "edge_vertex" | "vertex_vertex" | "vertex_plane" | "plane_vertex";

export interface Message {
  kind: "direction_limit" | "gjk_limit" | "point_limit" | "open_surface" | "inside_out";
  a: Body | null;
  b: Body | null;
  /** A sentence with the names of the bodies. */
  text: string;
}

/** How a world works; what is left out has its default. */
export interface Settings {
  /** What a report promises of its pairs. By default "exact". */
  accuracy?: Accuracy;
  /** Where the contact direction of a pair comes from. By default "carried". */
  direction?: DirectionPolicy;
  /** The relative gap at which GJK stops, 1e-15 to 0.1. */
  gjkTolerance?: number;
  /** Shifted calls of GJK a pair and step, at least 1. */
  iterationLimit?: number;
  zones?: boolean;
  patches?: boolean;
  /** Contact points. */
  points?: boolean;
  curves?: boolean;
  /** Every pair of features nearer than the sum of the margins, for barriers. */
  withinReach?: boolean;
  trace?: boolean;
  /** Called for each limit that a step reached, and for each body that was added as closed and is not; must not call the world.
   *  What it throws comes out of the call: detect() has made its step then, and addBody() adds no body. */
  onMessage?: (message: Message) => void;
  /** WebAssembly has one thread. */
  threads?: number;
}

export interface BodyDefinition {
  positions: Positions;
  facets?: Indices;
  /** Ropes and hair: two vertices each. */
  edges?: Indices;
  /** Grains: vertices that stand alone. */
  points?: ArrayLike<number>;
  /** By default "closed": a solid's surface, facets counter-clockwise seen from outside. */
  surface?: Surface;
  motion?: Motion;
  layer?: number;
  mask?: number;
  /** For messages, without a zero character; by default "body <index>". */
  name?: string;
  /** The program's own number, 0 to 2^64 - 1; as a number at most Number.MAX_SAFE_INTEGER. */
  externalId?: number | bigint;
  /** How far ahead of the surface contact points are seen, metres. */
  margin?: number;
  /** What the body adds to the distance that surfaces keep, metres, 0 to the margin; by default the margin, whatever that becomes. */
  restOffset?: number;
  selfContact?: boolean;
  group?: number;
  /** The order of bodies in all answers, 0 to 2^64 - 1; by default the index. */
  key?: number | bigint;
}
export interface PlaneDefinition {
  /** Out of what is solid, of length 1 to 1e-9. */
  normal?: Vector;
  /** How far the plane is from the origin along `normal`, metres. */
  offset?: number;
  name?: string;
  layer?: number;
  mask?: number;
  group?: number;
  externalId?: number | bigint;
  key?: number | bigint;
  margin?: number;
  restOffset?: number;
}
/** Settings of single vertices and facets of a body. An empty array, or none, sets nothing. */
export interface FeatureSettings {
  /** What each vertex adds to the distance that surfaces keep, metres, 0 to the margin. */
  restOffsets?: ArrayLike<number>;
  /** The program's own numbers. */
  vertexLabels?: ArrayLike<number>;
  facetLabels?: ArrayLike<number>;
  /** The layers that each is on, and is tested against, a bit each; by default those of the body. */
  vertexLayers?: ArrayLike<number>;
  vertexMasks?: ArrayLike<number>;
  facetLayers?: ArrayLike<number>;
  facetMasks?: ArrayLike<number>;
  /** How far ahead of each vertex contact points are seen, metres, 0 to the margin of the body. */
  margins?: ArrayLike<number>;
}
/** The labels of a vertex, an edge or a facet; 0 where there is none. */
export interface FeatureLabels {
  vertices: number[];
  /** That of the facet, or of the first facet that has the vertex or the edge. */
  facet: number;
}
/** A label of one body and a label of another, or of the same. */
export interface LabelPair {
  a: Body;
  labelA: number;
  b: Body;
  labelB: number;
  /** By default "facet": facets, and edges and vertices that only such facets have; "vertex": vertices, and the edges and facets that have any of them. */
  kind?: "facet" | "vertex";
}
/** Which features of a body that is tested against itself are too near to each other to be tested. */
export interface SelfContactFilter {
  /** Features with vertices at most so many edges apart are left out, 0 to 16; 0 leaves out those with a common vertex alone. */
  rings?: number;
  /** Features with vertices at most so far apart at rest are left out, metres; 0 leaves out none. */
  restDistance?: number;
  /** Where vertices are at rest; by default where they are when the filter is set. */
  restPositions?: Positions;
}
export interface Pose {
  body: Body;
  /** Nine numbers, row by row, of determinant +1. */
  rotation: Numbers;
  translation: ArrayLike<number>;
}

/** The layers that a query is on and considers. */
export interface QueryFilter {
  layer?: number;
  mask?: number;
}
export interface Ray extends QueryFilter {
  from: ArrayLike<number>;
  to: ArrayLike<number>;
}
export interface RayHit {
  body: Body;
  facet: number;
  /** The place on the ray: from + fraction * (to - from). */
  fraction: number;
  barycentric: number[];
}
export interface PointQuery extends QueryFilter {
  point: ArrayLike<number>;
  /** How far the answer may be away, metres. */
  within?: number;
}
export interface ClosestPoint {
  body: Body;
  facet: number;
  distance: number;
  barycentric: number[];
}
/** Two bodies, and how far they may be apart. */
export interface DistanceQuery {
  a: Body;
  b: Body;
  /** Metres: what is farther is not looked for. */
  within?: number;
}
export interface NearestBodiesQuery extends QueryFilter {
  body: Body;
  /** How many at most; by default 1. */
  count?: number;
  within?: number;
}
export type Containment = "none" | "a_in_b" | "b_in_a";
/** The least distance of the surfaces of two bodies, and where it is. */
export interface BodyDistance {
  a: Body;
  b: Body;
  /** Metres; zero exactly where the surfaces share a point; Infinity where they are farther apart than requested. */
  distance: number;
  /** Negative where they are farther apart than requested. */
  aFacet: number;
  bFacet: number;
  /** Weights of the corners; zero on a plane. */
  aBarycentric: number[];
  bBarycentric: number[];
  /** Whether one lies wholly inside the other, whose surfaces are apart. */
  containment: Containment;
}
/** A way of a body as a whole: it goes straight and turns at the same time, both evenly. */
export interface Sweep extends QueryFilter {
  body: Body;
  /** How far it goes, metres. */
  way?: ArrayLike<number>;
  /** What it turns about, of any length but zero; by default z. */
  axis?: ArrayLike<number>;
  /** A point of the axis where the way begins, metres. */
  center?: ArrayLike<number>;
  /** Radians, counter-clockwise about `axis`. */
  angle?: number;
}
export interface SweepHit {
  /** The body that is met. */
  body: Body;
  /** Of the swept body. */
  facet: number;
  /** The facet of `body` that it meets. */
  other: number;
  /** The part of the way, 0 to 1, that is free: never later than the true one. */
  fraction: number;
  /** From `facet` to `other`; zero if they meet at once. */
  normal: number[];
  barycentric: number[];
  otherBarycentric: number[];
}
export interface BoxQuery extends QueryFilter {
  lower: ArrayLike<number>;
  upper: ArrayLike<number>;
}
export interface FacetOfBody {
  body: Body;
  facet: number;
}
export interface SurfaceFault {
  kind: "border_edge" | "branching_edge" | "turned_facet" | "inside_out_component" | "crossing" | "repeated_facet" | "repeated_vertex" | "sliver" | "unused_vertex";
  first: number;
  /** The other one, or -1. */
  second: number;
}
type Color = [number, number, number, number?];
type DebugDrawOptions = Record<string, boolean | Color>;
export interface DebugDrawer {
  line?(from: number[], to: number[], color: number[]): void;
  triangle?(p: number[], q: number[], r: number[], color: number[]): void;
  text?(at: number[], words: string, color: number[]): void;
}

/** A set of bodies and the contacts among them. Every function throws a TactError for bad data, and the world is as it was. */
export class World {
  constructor(settings?: Settings);
  /** Frees the world's memory now. */
  destroy(): void;
  readonly handle: bigint;
  readonly settings: Required<Omit<Settings, "onMessage">>;
  /** Sets the settings for the next step, which looks at every pair again. */
  setSettings(settings: Settings): void;

  /** Adds a body; copies its mesh and groups the facets into clusters. */
  addBody(definition: BodyDefinition): Body;
  /** Adds a half-space, which is fixed and has no vertices. */
  addPlane(definition: PlaneDefinition): Body;
  removeBody(body: Body): void;
  /** Copies new positions of a body; equal ones do not move it. */
  setPositions(body: Body, positions: Positions): void;
  /** Copies new positions of many bodies, all or none. */
  setPositionsOfMany(updates: { body: Body; positions: Positions }[]): void;
  /** Gives a body other vertices, facets, edges and points; `vertexMap` tells of each new vertex which old one it was, or -1,
   *  `facetMap` of each facet the old one whose label, layer and mask it has. */
  setFacets(body: Body, positions: Positions, facets: Indices, vertexMap: ArrayLike<number>,
    rest?: { edges?: Indices; points?: ArrayLike<number>; facetMap?: ArrayLike<number> }): void;
  /** Places a rigid body: a vertex added at p stands at rotation * p + translation. */
  setPose(body: Body, rotation: Numbers, translation: ArrayLike<number>): void;
  /** Places many rigid bodies, all or none. */
  setPoses(updates: Pose[]): void;
  setLayers(body: Body, layer: number, mask: number): void;
  setGroup(body: Body, group: number): void;
  /** Sets whether two bodies are excluded from tests, whatever their layers. */
  setExcluded(a: Body, b: Body, excluded: boolean): void;
  setMotion(body: Body, motion: Motion): void;
  setMargin(body: Body, margin: number): void;
  /** Sets what a body adds to the distance that surfaces keep, metres; null takes the margin, whatever that becomes. */
  setRestOffset(body: Body, restOffset: number | null): void;
  /** Replaces the settings of single vertices and facets of a body. */
  setFeatureSettings(body: Body, settings: FeatureSettings): void;
  setSelfContact(body: Body, wanted: boolean): void;
  /** Sets which features of a body are too near to each other to be tested against each other; nothing: none. */
  setSelfContactFilter(body: Body, filter?: SelfContactFilter): void;
  /** Sets whether features of two labels are excluded from tests: a collar and what it is sewn to, say. */
  setExcludedLabels(labels: LabelPair, excluded: boolean): void;

  /** Takes one step: finds the contacts of the current positions. */
  detect(): Report;
  /** Finds what meets between the positions of the last detect() and the current ones, every vertex moving straight. */
  detectMotion(options?: { wanted?: Impacts; distance?: number; bounds?: boolean }): MotionReport;
  /** Gives all that later answers depend on as bytes. */
  save(): Uint8Array;
  /** Goes back to the state of `bytes`, of this world or another. */
  restore(bytes: Uint8Array): void;

  contains(body: Body): boolean;
  readonly bodyCount: number;
  /** The bodies in the order of their index. */
  bodies(): Body[];
  /** The body whose index stands in an array of a report. */
  bodyAt(index: number): Body | null;
  bodyOf(body: Body): Body | null;
  nameOf(body: Body): string;
  surfaceOf(body: Body): Surface;
  motionOf(body: Body): Motion;
  groupOf(body: Body): number;
  layerOf(body: Body): number;
  maskOf(body: Body): number;
  externalIdOf(body: Body): bigint;
  keyOf(body: Body): bigint;
  marginOf(body: Body): number;
  /** The rest offset of a body, or its margin, metres. */
  restOffsetOf(body: Body): number;
  /** Copies of the settings of single vertices and facets; empty where they are not set. */
  featureSettingsOf(body: Body): Record<"restOffsets" | "margins", Float64Array> &
    Record<"vertexLabels" | "facetLabels" | "vertexLayers" | "vertexMasks" | "facetLayers" | "facetMasks", Uint32Array>;
  /** The labels of a feature, whose three vertices are named as in a point, a pair or an impact; -1 fills up. */
  labelsOf(body: Body, vertices: ArrayLike<number>): FeatureLabels;
  selfContactOf(body: Body): boolean;
  selfContactFilterOf(body: Body): { rings: number; restDistance: number; restPositions: Float64Array };
  areExcludedLabels(labels: LabelPair): boolean;
  isExcluded(a: Body, b: Body): boolean;
  vertexCountOf(body: Body): number;
  facetCountOf(body: Body): number;
  edgeCountOf(body: Body): number;
  pointCountOf(body: Body): number;
  planeOf(body: Body): { normal: number[]; offset: number } | null;
  /** The box of a body with its margin. */
  boundsOf(body: Body): { lower: number[]; upper: number[] };
  positionsOf(body: Body): Float64Array;
  facetsOf(body: Body): Int32Array;
  edgesOf(body: Body): Int32Array;
  pointsOf(body: Body): Int32Array;
  /** Checks what a body's surface is; a sliver's height is at most `sliver` times its longest side. */
  checkSurface(body: Body, sliver?: number): { solid: boolean; faults: SurfaceFault[] };

  /** Gives the first facet that a ray meets, or any; null if none. */
  castRay(ray: Ray, wanted?: "first" | "any"): RayHit | null;
  castRays(rays: Ray[], wanted?: "first" | "any"): (RayHit | null)[];
  /** Gives all facets that a ray meets, sorted by fraction, body and facet. */
  castRayAll(ray: Ray): RayHit[];
  /** Gives the nearest place of all surfaces to a point; null if none is within reach. */
  closestPoint(query: PointQuery): ClosestPoint | null;
  closestPoints(queries: PointQuery[]): (ClosestPoint | null)[];
  /** Gives the nearest surface of closed bodies and planes; its distance is minus the depth where one contains the point. */
  signedDistance(query: PointQuery): ClosestPoint | null;
  signedDistances(queries: PointQuery[]): (ClosestPoint | null)[];
  /** Gives the least distance of two bodies. */
  distance(query: DistanceQuery): BodyDistance;
  distances(queries: DistanceQuery[]): BodyDistance[];
  /** Gives the bodies nearest to one, sorted by distance and body. */
  nearestBodies(query: NearestBodiesQuery): BodyDistance[];
  /** Gives what a body meets first when it is moved straight or turned, all others standing still; null if nothing. */
  sweep(sweep: Sweep): SweepHit | null;
  sweeps(sweeps: Sweep[]): (SweepHit | null)[];
  /** Gives volume and surface of what two closed bodies that do not cross themselves have in common. */
  overlap(a: Body, b: Body): { volume: number; area: number };
  /** Gives the facets that share a point with a box, decided exactly. */
  overlapBox(box: BoxQuery): FacetOfBody[];
  overlapBoxes(boxes: BoxQuery[]): FacetOfBody[][];
  /** Gives the closed bodies that contain a point or have it on their surface, decided exactly. */
  bodiesContaining(query: PointQuery): Body[];
  bodiesContainingEach(queries: PointQuery[]): Body[][];
  /** Draws what the last step found; options are those of tact_debug_draw_options, such as facetPairs; colours [red, green, blue, alpha]. */
  debugDraw(drawer: DebugDrawer, options?: DebugDrawOptions): void;
  /** Draws distances: a line between the two places, and its length. Those farther apart than requested are left out. */
  debugDrawDistances(distances: BodyDistance[], drawer: DebugDrawer, options?: DebugDrawOptions): void;
  /** Draws each patch of the last step as a circle of its area across its normal, and forces as arrows. */
  debugDrawSums(impulses: PointImpulse[], drawer: DebugDrawer, options?: DebugDrawOptions): void;
}

export interface ContactPoint {
  kind: FeaturePair;
  /** The number of its patch. */
  patch: number;
  /** Vertices of the smallest feature that holds the point; -1 fills up. */
  aVertices: number[];
  bVertices: number[];
  aWeights: number[];
  bWeights: number[];
  /** From the point of a to that of b. */
  normal: number[];
  /** Metres; negative where the surfaces have crossed. */
  gap: number;
  /** The same in every step in which these features are near. */
  id: bigint;
  minimum: boolean;
}
export interface Patch {
  point: number[];
  direction: number[];
  depth: number;
  area: number;
  id: bigint;
  /** Indices of facet pairs, of points. */
  facetPairs: Int32Array;
  points: Int32Array;
  spanning: number[];
}
export interface CurvePoint {
  position: number[];
  fraction: number;
  edge: number[];
  facet: number;
  facetPair: number;
  edgeOfB: boolean;
}
export interface ReachPair {
  kind: FeaturePair;
  aVertices: number[];
  bVertices: number[];
  aWeights: number[];
  bWeights: number[];
  normal: number[];
  distance: number;
}
export interface ZoneDisk {
  center: number[];
  /** Negative where no zone is computed or it is empty. */
  radius: number;
}
/** Two bodies whose convex hulls overlap or touch, or are nearer than the sum of the margins. */
export interface Contact {
  readonly a: Body;
  readonly b: Body;
  /** Unit vector from a to b: moving b by depth * direction separates the hulls. */
  readonly direction: number[];
  readonly depth: number;
  readonly source: "carried" | "fresh" | "smallest";
  readonly iterations: number;
  readonly limitReached: boolean;
  readonly touching: boolean;
  readonly planeA: number;
  readonly planeB: number;
  readonly zoneA: ZoneDisk;
  readonly zoneB: ZoneDisk;
  readonly keptFacetsA: number;
  readonly keptFacetsB: number;
  readonly containment: Containment;
  readonly pointLimitReached: boolean;
  /** Facet of a, facet of b, for each pair that meets; sorted. */
  readonly facetPairs: Int32Array;
  readonly points: ContactPoint[];
  readonly withinReach: ReachPair[];
  readonly patches: Patch[];
  readonly curves: { closed: boolean; points: CurvePoint[] }[];
  readonly hash: bigint;
}
export interface PointArrays {
  count: number;
  /** Index of body a, of body b; 2 a point. */
  bodies: Uint32Array;
  contacts: Int32Array;
  kinds: Uint8Array;
  aVertices: Int32Array;
  bVertices: Int32Array;
  aWeights: Float64Array;
  bWeights: Float64Array;
  normals: Float64Array;
  gaps: Float64Array;
  ids: BigUint64Array;
  patchIds: BigUint64Array;
  minima: Uint8Array;
}
/** The labels of what points name; 0 where there is none. */
export interface PointLabelArrays {
  count: number;
  /** That of a's facet, or of the first that has the vertex or the edge. */
  aFacets: Uint32Array;
  bFacets: Uint32Array;
  /** Those of a's vertices, 3 a point. */
  aVertices: Uint32Array;
  bVertices: Uint32Array;
}
export interface ReachPairArrays {
  count: number;
  bodies: Uint32Array;
  contacts: Int32Array;
  kinds: Uint8Array;
  aVertices: Int32Array;
  bVertices: Int32Array;
  aWeights: Float64Array;
  bWeights: Float64Array;
  normals: Float64Array;
  distances: Float64Array;
}
export interface FacetPairArrays {
  count: number;
  bodies: Uint32Array;
  contacts: Int32Array;
  facets: Int32Array;
}
/** What a solver did at a contact point: N s on b, or N. */
export interface PointImpulse {
  id: bigint;
  impulse: ArrayLike<number>;
}
export interface ContactSum {
  kind: "contact" | "patch" | "body";
  a: Body;
  b: Body | null;
  patch: bigint;
  points: number;
  area: number;
  deepestGap: number;
  meanGap: number;
  center: number[];
  normal: number[];
  force: number[];
  torque: number[];
  vertices: { body: Body; vertex: number }[];
}

interface AnyReport {
  readonly world: World;
  /** Sorted by (a, b). */
  readonly contacts: Contact[];
  findContact(a: Body, b: Body): Contact | null;
  /** The number of points of all contacts. */
  readonly pointCount: number;
  /** The points of all contacts as arrays, or those arrays alone that are wanted. */
  points(): PointArrays;
  points<Name extends keyof PointArrays>(wanted: Name[]): Pick<PointArrays, Name | "count">;
  reachPairs(): ReachPairArrays;
  reachPairs<Name extends keyof ReachPairArrays>(wanted: Name[]): Pick<ReachPairArrays, Name | "count">;
  facetPairs(): FacetPairArrays;
  facetPairs<Name extends keyof FacetPairArrays>(wanted: Name[]): Pick<FacetPairArrays, Name | "count">;
  readonly candidatePairs: { a: Body; b: Body; hullsOverlap: boolean }[];
  /** Contacts that touch now and did not in the last step. */
  readonly began: { a: Body; b: Body }[];
  readonly ended: { a: Body; b: Body }[];
  readonly patchEvents: { a: Body; b: Body; kind: "began" | "split" | "merged" | "ended"; patch: bigint; other: bigint }[];
  /** Counts, and times in milliseconds, by name. */
  readonly statistics: Record<string, number>;
  readonly trace: { kind: number; thread: number; beginNs: number; endNs: number; a: Body | null; b: Body | null; count: number }[];
  /** Made from every bit of the answer. */
  readonly hash: bigint;
  /** The points for a solver; `firstRows`: by index of body the row of its first vertex. */
  stencils(firstRows: ArrayLike<number>): Stencils;
  /** The same of the pairs within reach. */
  stencilsWithinReach(firstRows: ArrayLike<number>): ReachStencils;
  /** Copies the report, which then stays. The memory of `kept` is used again, and what it was is stale. */
  keep(kept?: KeptReport | null): KeptReport;
}
/** What a step found. After the world's next step its functions throw "stale_report", after destroy() "invalid_handle"; arrays
 *  stay yours. A step that is refused, as one within a message or a drawer is, leaves it as it was. */
export interface Report extends AnyReport {
  /** The labels of what points() names, in its order. */
  pointLabels(): PointLabelArrays;
  pointLabels<Name extends keyof PointLabelArrays>(wanted: Name[]): Pick<PointLabelArrays, Name | "count">;
  /** For each of points() 1 if it is a minimum also of joined surfaces, else 0. Joined are facets of one body, bodies that are
   *  not tested against each other, and bodies on `layers`; `within` metres they are at one place. */
  joinedMinima(joined?: { within?: number; layers?: number }): Uint8Array;
  /** Adds up the points of contacts, patches and bodies. */
  sumContacts(impulses?: PointImpulse[]): ContactSum[];
}
/** A report with memory of its own, which stays while the world goes on, changes or is destroyed. */
export interface KeptReport extends AnyReport {
  /** Frees its memory now. */
  free(): void;
}

export interface Stencil {
  kind: "point_point" | "point_edge" | "point_facet" | "edge_edge";
  bFirst: boolean;
  vertices: number[];
  weights: number[];
  normal: number[];
  gap: number;
  id: bigint;
}
/** A number a stencil, 12 of the gradient and, if wanted, 144 of the Hessian. */
export interface Terms {
  values: Float64Array;
  gradients: Float64Array;
  hessians?: Float64Array;
}
/** Contact points, or impacts, by rows of a solver's system: see the page "A solver on tact" of the manual. Values of vertices
 *  are three numbers each: positions, ways, velocities. */
export interface Stencils {
  readonly count: number;
  readonly all: Stencil[];
  gaps(positions: Positions, options?: { hessians?: boolean }): Terms;
  barriers(positions: Positions, reach: number, options?: { rest?: Positions; hessians?: boolean }): Terms;
  penalties(positions: Positions, reach: number, options?: { hessians?: boolean }): Terms;
  friction(moved: Positions, limits: ArrayLike<number>, smoothing: number, options?: { hessians?: boolean }): Terms;
  /** How fast the gap of each grows at such velocities; where they are ways, by how much it grows. */
  gapRates(velocities: Positions): Float64Array;
  /** A colour for each; two of one colour share no vertex below `moving`. */
  colors(moving: number): Int32Array;
  /** Draws the edges of both features, a line from a to b, and the normal; by default in the colour of points. */
  debugDraw(positions: Positions, drawer: DebugDrawer, color?: Color): void;
}
/** Pairs within reach by rows of a solver's system. */
export interface ReachStencils {
  readonly count: number;
  /** With all vertices of both features. */
  readonly whole: Stencils;
  /** With those of the closest features alone. */
  readonly closest: Stencils;
  /** The barriers of the distances below `reach`, as terms of `whole`. */
  barriers(positions: Positions, reach: number, options?: { rest?: Positions; hessians?: boolean }): Terms;
}

export interface Impact {
  a: Body;
  b: Body;
  kind: FeaturePair;
  /** The part of the way, 0 to 1, at which they first meet; never later than the true time. */
  time: number;
  aVertices: number[];
  bVertices: number[];
  /** False if they touch and part, or slide along each other. */
  stops: boolean;
}
export interface ImpactArrays {
  count: number;
  bodies: Uint32Array;
  kinds: Uint8Array;
  times: Float64Array;
  aVertices: Int32Array;
  bVertices: Int32Array;
  stops: Uint8Array;
}
/** What detectMotion() found; valid until it is called again. */
export interface MotionReport {
  readonly world: World;
  /** The earliest time of an impact that stops, 0 to 1; Infinity if none does. */
  readonly firstTime: number;
  readonly impacts: Impact[];
  impactArrays(): ImpactArrays;
  impactArrays<Name extends keyof ImpactArrays>(wanted: Name[]): Pick<ImpactArrays, Name | "count">;
  readonly pairs: { a: Body; b: Body; firstTime: number; impacts: Impact[] }[];
  /** For each vertex how far along its way it may go, 0 to 1, if bounds were requested. */
  boundsOf(body: Body): Float64Array;
  /** The impacts that stop, for a solver; `begin` and `end` are the vertices of all bodies before and after the way. */
  stencils(firstRows: ArrayLike<number>, begin: Positions, end: Positions): Stencils;
  readonly statistics: Record<string, number>;
}

/** The rotation nearest to a matrix that is orthonormal to 1e-5, row by row. */
export function nearestRotation(matrix: Numbers): Float64Array;
/** The rotation of a quaternion x, y, z, w whose length is 1 to 1e-5. */
export function rotationOfQuaternion(quaternion: ArrayLike<number>): Float64Array;
/** Gives a mesh without the vertices that repeat an earlier position. */
export function weld(positions: Positions, facets: Indices): {
  positions: Float64Array;
  facets: Int32Array;
  vertexOf: Int32Array;
  mergedVertices: number;
  collapsedFacets: number;
};
