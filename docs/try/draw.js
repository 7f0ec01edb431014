// Draws with WebGL 2: surfaces with the shade of their facets and a shadow on the floor, segments and dots of some pixels.

const SURFACE = [`#version 300 es
uniform mat4 view; uniform float shadow;
in vec3 position; in vec3 color;
out vec3 at, tint;
void main() {
  at = position; tint = color;
  vec3 p = position;
  if (shadow > 0.0) p = vec3(p.xy - p.z * vec2(0.25, -0.15), 0.001);
  gl_Position = view * vec4(p, 1.0);
}`, `#version 300 es
precision highp float;
uniform float shadow; uniform vec3 eye;
in vec3 at, tint; out vec4 pixel;
void main() {
  if (shadow > 0.0) { pixel = vec4(0.03, 0.04, 0.07, 0.35); return; }
  vec3 n = normalize(cross(dFdx(at), dFdy(at))), to_eye = normalize(eye - at);
  if (dot(n, to_eye) < 0.0) n = -n;
  vec3 light = normalize(vec3(0.45, -0.25, 0.9));
  float lit = 0.38 + 0.5 * max(dot(n, light), 0.0) + 0.16 * max(dot(n, normalize(vec3(-0.7, 0.5, 0.1))), 0.0);
  float gloss = pow(max(dot(n, normalize(light + to_eye)), 0.0), 40.0) * 0.18;
  pixel = vec4(tint * lit + gloss, 1.0);
}`];
const FLOOR = [`#version 300 es
uniform mat4 view; in vec3 position; out vec3 at;
void main() { at = position; gl_Position = view * vec4(position, 1.0); }`, `#version 300 es
precision highp float;
in vec3 at; out vec4 pixel;
void main() {
  vec2 cell = abs(fract(at.xy * 4.0 - 0.5) - 0.5) / fwidth(at.xy * 4.0);
  float line = 1.0 - min(min(cell.x, cell.y), 1.0), far = smoothstep(3.2, 0.6, length(at.xy));
  pixel = vec4(mix(vec3(0.165, 0.2, 0.28), vec3(0.26, 0.31, 0.42), line * 0.55), far);
}`];
// An instance is a segment from p to q, or a dot where both are equal: a square as wide as `width` pixels.
const SEGMENT = [`#version 300 es
uniform mat4 view; uniform vec2 size;
in vec2 corner; in vec3 p; in vec3 q; in vec4 color; in float width;
out vec4 tint; out vec2 across; flat out float dot_;
void main() {
  vec4 a = view * vec4(p, 1.0), b = view * vec4(q, 1.0);
  a.z -= 0.004 * a.w; b.z -= 0.004 * b.w;
  vec2 way = (b.xy / b.w - a.xy / a.w) * size;
  dot_ = dot(way, way) < 1e-6 ? 1.0 : 0.0;
  vec2 along = dot_ > 0.0 ? vec2(1.0, 0.0) : normalize(way), side = vec2(-along.y, along.x);
  vec4 at = corner.x < 0.0 ? a : b;
  at.xy += (side * corner.y + along * corner.x) * width / size * at.w;
  gl_Position = at; tint = color; across = corner;
}`, `#version 300 es
precision highp float;
in vec4 tint; in vec2 across; flat in float dot_; out vec4 pixel;
void main() {
  float edge = dot_ > 0.0 ? length(across) : abs(across.y), soft = fwidth(edge);
  pixel = vec4(tint.rgb, tint.a * (1.0 - smoothstep(1.0 - soft, 1.0, edge)));
}`];

const SEGMENT_FLOATS = 11;

function program(gl, [vertex, fragment]) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  return made;
}

/** What turns and moves the view: angles and distance about a point. */
export class Camera {
  yaw = -0.75; pitch = 0.42; distance = 3.1; target = [0, 0, 0.42];
  eye() {
    const { yaw, pitch, distance, target: [x, y, z] } = this;
    return [x + distance * Math.cos(pitch) * Math.sin(yaw), y - distance * Math.cos(pitch) * Math.cos(yaw), z + distance * Math.sin(pitch)];
  }
  /** Right, up and forwards. */
  axes() {
    const { yaw, pitch } = this, s = Math.sin, c = Math.cos;
    return [[c(yaw), s(yaw), 0], [-s(yaw) * s(pitch), c(yaw) * s(pitch), c(pitch)], [-s(yaw) * c(pitch), c(yaw) * c(pitch), -s(pitch)]];
  }
  matrix(aspect) {
    const [r, u, f] = this.axes(), e = this.eye(), near = 0.05, far = 30, h = 1 / Math.tan(0.36) / Math.max(1, 0.9 / aspect), w = h / aspect;
    const dot = (a) => -(a[0] * e[0] + a[1] * e[1] + a[2] * e[2]), k = (far + near) / (far - near), m = (2 * far * near) / (far - near);
    return [w * r[0], h * u[0], k * f[0], f[0], w * r[1], h * u[1], k * f[1], f[1], w * r[2], h * u[2], k * f[2], f[2],
      w * dot(r), h * dot(u), k * dot(f) - m, dot(f)];
  }
  /** The way through a place of the picture, each -1 to 1. */
  ray(x, y, aspect) {
    const [r, u, f] = this.axes(), wide = Math.tan(0.36) * Math.max(1, 0.9 / aspect);
    return [0, 1, 2].map((k) => f[k] + wide * (x * aspect * r[k] + y * u[k]));
  }
}

export class Drawing {
  #gl; #surface; #floor; #segment; #buffers = {}; #segments = new Float32Array(SEGMENT_FLOATS * 4096); #count = 0; #indices = 0;
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: true, stencil: true, alpha: false });
    if (!gl) throw new Error("This browser has no WebGL 2, by which this page draws.");
    this.#gl = gl;
    this.canvas = canvas;
    this.#surface = program(gl, SURFACE);
    this.#floor = program(gl, FLOOR);
    this.#segment = program(gl, SEGMENT);
    for (const name of ["position", "color", "index", "segment", "corner", "floor"]) this.#buffers[name] = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers.corner);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), gl.STATIC_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers.floor);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-4, -4, 0, 4, -4, 0, -4, 4, 0, 4, 4, 0]), gl.STATIC_DRAW);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** The facets and colours of vertices: when bodies come and go. */
  setMesh(indices, colors) {
    const gl = this.#gl;
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.#buffers.index);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers.color);
    gl.bufferData(gl.ARRAY_BUFFER, colors, gl.STATIC_DRAW);
    this.#indices = indices.length;
  }
  clear() { this.#count = 0; }
  segment(p, q, color, width) {
    if (SEGMENT_FLOATS * (this.#count + 1) > this.#segments.length) {
      const larger = new Float32Array(2 * this.#segments.length);
      larger.set(this.#segments);
      this.#segments = larger;
    }
    this.#segments.set([...p, ...q, ...color, width], SEGMENT_FLOATS * this.#count++);
  }
  dot(p, color, width) { this.segment(p, p, color, width); }

  #attribute(program_, name, buffer, size, stride = 0, offset = 0, divisor = 0) {
    const gl = this.#gl, at = gl.getAttribLocation(program_, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, gl.FLOAT, false, stride, offset);
    gl.vertexAttribDivisor(at, divisor);
    return at;
  }
  #use(program_, uniforms) {
    const gl = this.#gl;
    for (let at = 0; at < 8; ++at) gl.disableVertexAttribArray(at), gl.vertexAttribDivisor(at, 0);
    gl.useProgram(program_);
    for (const [name, value] of Object.entries(uniforms)) {
      const at = gl.getUniformLocation(program_, name);
      value.length === 16 ? gl.uniformMatrix4fv(at, false, value) : value.length === 3 ? gl.uniform3fv(at, value)
        : value.length === 2 ? gl.uniform2fv(at, value) : gl.uniform1f(at, value);
    }
  }

  draw(camera, positions) {
    const gl = this.#gl, { canvas } = this, scale = Math.min(globalThis.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * scale)), height = Math.max(1, Math.round(canvas.clientHeight * scale));
    if (canvas.width !== width || canvas.height !== height) canvas.width = width, canvas.height = height;
    gl.viewport(0, 0, width, height);
    gl.clearColor(0.075, 0.095, 0.14, 1);
    gl.clearStencil(0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    const view = camera.matrix(width / height);
    gl.enable(gl.BLEND);
    this.#use(this.#floor, { view });
    this.#attribute(this.#floor, "position", this.#buffers.floor, 3);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);

    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers.position);
    gl.bufferData(gl.ARRAY_BUFFER, positions, gl.DYNAMIC_DRAW);
    this.#use(this.#surface, { view, shadow: 1, eye: camera.eye() });
    this.#attribute(this.#surface, "position", this.#buffers.position, 3);
    this.#attribute(this.#surface, "color", this.#buffers.color, 3);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.#buffers.index);
    gl.enable(gl.STENCIL_TEST);  // each pixel is in the shadow once
    gl.stencilFunc(gl.EQUAL, 0, 255);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR);
    gl.drawElements(gl.TRIANGLES, this.#indices, gl.UNSIGNED_SHORT, 0);
    gl.disable(gl.STENCIL_TEST);
    gl.disable(gl.BLEND);
    gl.uniform1f(gl.getUniformLocation(this.#surface, "shadow"), 0);
    gl.drawElements(gl.TRIANGLES, this.#indices, gl.UNSIGNED_SHORT, 0);

    if (this.#count === 0) return;
    gl.enable(gl.BLEND);
    this.#use(this.#segment, { view, size: [width, height] });
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers.segment);
    gl.bufferData(gl.ARRAY_BUFFER, this.#segments.subarray(0, SEGMENT_FLOATS * this.#count), gl.DYNAMIC_DRAW);
    this.#attribute(this.#segment, "corner", this.#buffers.corner, 2);
    const stride = 4 * SEGMENT_FLOATS;
    for (const [name, size, offset] of [["p", 3, 0], ["q", 3, 12], ["color", 4, 24], ["width", 1, 40]]) {
      this.#attribute(this.#segment, name, this.#buffers.segment, size, stride, offset, 1);
    }
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.#count);
  }
}
