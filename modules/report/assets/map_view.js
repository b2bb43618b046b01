"use strict";
// The map in 3D. Points and lines are drawn into a picture in memory, with a depth for each pixel, by the loops below:
// no graphics card is asked. While the view moves only every n-th vertex is drawn, n such that a picture takes
// kMovingMs; once it rests, all are.
(() => {
const kMovingMs = 22;         // of a picture while the view moves: 30 to 60 pictures a second with what the browser adds
const kRestMs = 160;          // without a movement until all is drawn
const kHalfView = Math.tan(25 * Math.PI / 180);  // half of the view's shorter side, at distance 1
const kNearest = 0.002;       // of the view's distance: nothing nearer is drawn
const kTurn = 0.008;          // radians a pixel of dragging
const kFewPoints = 40000;     // so few are drawn larger
const kPickPx = 9;            // a pointer hits a point within so many pixels
const kPoint = 0, kJoint = 1, kLineStart = 2;  // what is drawn at a vertex: a dot, a line from the one before, nothing

// ---- the data, as map_packing.h writes it ----

function bytesOf(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
}
const floatsOf = text => new Float32Array(bytesOf(text).buffer);
const intsOf = text => new Int32Array(bytesOf(text).buffer);

function positionsOf(data) {
  const steps = new Uint16Array(bytesOf(data.positions).buffer), boxes = floatsOf(data.boxes);
  const xyz = new Float32Array(steps.length);
  for (let i = 0, n = steps.length / 3; i < n; ++i) {
    const box = 6 * Math.floor(i / data.block);
    for (let k = 0; k < 3; ++k) xyz[3 * i + k] = boxes[box + k] + steps[3 * i + k] * boxes[box + 3 + k];
  }
  return xyz;
}

function sigmasOf(data) {
  const ratio = data.sigma_low > 0 ? data.sigma_high / data.sigma_low : 1;
  return Float32Array.from(bytesOf(data.sigma), v => v === 0 ? 0 : data.sigma_low * Math.pow(ratio, (v - 1) / 254));
}

function kindsOf(data, count) {
  const bits = bytesOf(data.joined), kinds = new Uint8Array(count);
  const joined = i => i < count && (bits[i >> 3] >> (i & 7)) & 1;
  if (bits.length > 0)
    for (let i = 0; i < count; ++i) kinds[i] = joined(i) ? kJoint : joined(i + 1) ? kLineStart : kPoint;
  return kinds;
}

function hostsOf(data, count) {
  const pairs = intsOf(data.hosts), hosts = new Int32Array(count);
  for (let i = 0, at = 0; i < pairs.length; at += pairs[i], i += 2) hosts.fill(pairs[i + 1], at, at + pairs[i]);
  return hosts;
}

function unpacked(data) {
  const xyz = positionsOf(data), count = xyz.length / 3;
  return {unit: data.unit, count, xyz, sigma: sigmasOf(data), gray: bytesOf(data.gray), kind: kindsOf(data, count),
          host: hostsOf(data, count), path: floatsOf(data.path), truth: floatsOf(data.truth),
          seconds: floatsOf(data.seconds), keyframes: floatsOf(data.keyframes), frames: intsOf(data.frames),
          ramp: bytesOf(data.ramp)};
}

// ---- ranges and colours ----

// The values below which `low` and `high` of the finite ones lie; a few thousand of them tell.
function spread(values, stride, offset, low, high) {
  const count = values.length / stride, step = Math.max(1, Math.floor(count / 5000)), some = [];
  for (let i = 0; i < count; i += step) if (isFinite(values[stride * i + offset])) some.push(values[stride * i + offset]);
  if (some.length === 0) return [0, 1];
  some.sort((a, b) => a - b);
  return [some[Math.floor(low * (some.length - 1))], some[Math.ceil(high * (some.length - 1))]];
}

const digits = value => Math.abs(value) >= 100 ? 1 : Math.abs(value) >= 1 ? 2 : 3;
const length = (value, unit) => value.toFixed(digits(value)) + " " + unit;

// What a colour can tell: the value of a vertex, and the words at the ends of the legend.
function quantities(map) {
  const some = map.sigma.filter(s => s > 0), sigma = spread(some.length ? some : [1], 1, 0, 0.02, 0.98);
  return {
    height: {what: "height", of: i => map.xyz[3 * i + 2], range: spread(map.xyz, 3, 2, 0.02, 0.98),
             text: v => length(v, map.unit)},
    sigma: {what: "uncertainty (one standard deviation, logarithmic)", of: i => Math.log(map.sigma[i] || NaN),
            range: sigma.map(Math.log), text: v => length(Math.exp(v), map.unit)},
    gray: {what: "gray of the image", of: i => map.gray[i], range: [0, 255], text: v => v.toFixed(0)},
    time: {what: "keyframe", of: i => map.host[i], range: [0, Math.max(1, map.frames.length - 1)], text: v => v.toFixed(0)},
  };
}

const packColor = (r, g, b) => (255 << 24 | b << 16 | g << 8 | r) >>> 0;  // as the bytes lie in the picture

function rampColors(map, name) {
  const colors = new Uint32Array(256);
  for (let i = 0; i < 256; ++i) {
    const gray = 56 + Math.round(i * 199 / 255);  // black would not be seen before the dark
    const light = k => 36 + Math.round(map.ramp[3 * i + k] * 219 / 255);
    colors[i] = name === "gray" ? packColor(gray, gray, gray) : packColor(light(0), light(1), light(2));
  }
  return colors;
}

function colorsOf(map, name, quantity) {
  const ramp = rampColors(map, name), [low, high] = quantity.range, colors = new Uint32Array(map.count);
  const unknown = packColor(120, 128, 140);
  for (let i = 0; i < map.count; ++i) {
    const share = (quantity.of(i) - low) / Math.max(high - low, 1e-9);
    colors[i] = share === share ? ramp[Math.max(0, Math.min(255, Math.floor(255 * share)))] : unknown;
  }
  return colors;
}

// ---- the view ----

// Looks at `target` from `distance`, turned by `azimuth` about z and raised by `elevation`.
function axesOf(view) {
  const ca = Math.cos(view.azimuth), sa = Math.sin(view.azimuth), ce = Math.cos(view.elevation), se = Math.sin(view.elevation);
  const ahead = [-ce * ca, -ce * sa, -se];
  return {right: [-sa, ca, 0], up: [-se * ca, -se * sa, ce], ahead, eye: view.target.map((t, i) => t - view.distance * ahead[i])};
}

// From the map to pixels: x right, y down, depth along the view.
function projection(view, width, height) {
  const {right, up, ahead, eye} = axesOf(view), f = 0.5 * Math.min(width, height) / kHalfView, nearest = kNearest * view.distance;
  return (x, y, z, out) => {
    x -= eye[0], y -= eye[1], z -= eye[2];
    const depth = ahead[0] * x + ahead[1] * y + ahead[2] * z;
    out.depth = depth;
    if (!(depth > nearest)) return false;
    out.x = 0.5 * width + f * (right[0] * x + right[1] * y) / depth;
    out.y = 0.5 * height - f * (up[0] * x + up[1] * y + up[2] * z) / depth;
    return true;
  };
}

// ---- points and lines in memory ----

class Picture {
  resize(width, height) {
    if (this.width === width && this.height === height) return;
    this.width = width, this.height = height;
    this.image = new ImageData(width, height);
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.nearness = new Float32Array(width * height);  // 1 / depth of what is drawn there
  }
  clear() {
    this.pixels.fill(0);
    this.nearness.fill(0);
  }
  // A square of `size` pixels.
  dot(x, y, nearness, size, color) {
    const x0 = (x - 0.5 * (size - 1)) | 0, y0 = (y - 0.5 * (size - 1)) | 0;
    if (x0 < 0 || y0 < 0 || x0 + size > this.width || y0 + size > this.height) return;
    for (let row = y0; row < y0 + size; ++row)
      for (let at = row * this.width + x0, end = at + size; at < end; ++at)
        if (nearness > this.nearness[at]) this.nearness[at] = nearness, this.pixels[at] = color;
  }
  line(x0, y0, near0, x1, y1, near1, size, color) {
    const dx = x1 - x0, dy = y1 - y0, w = this.width, h = this.height;
    if ((x0 < 0 && x1 < 0) || (y0 < 0 && y1 < 0) || (x0 > w && x1 > w) || (y0 > h && y1 > h)) return;
    const steps = Math.max(1, Math.ceil(Math.max(Math.abs(dx), Math.abs(dy))));
    if (steps > 4 * (w + h)) return;  // through the eye
    for (let k = 0; k <= steps; ++k) {
      const s = k / steps;
      this.dot(x0 + s * dx, y0 + s * dy, near0 + s * (near1 - near0), size, color);
    }
  }
}

// Every `step`-th vertex; a line needs the one before, too. The loop knows the projection by heart: a call for each
// vertex would cost more than all else.
function drawMap(picture, map, colors, view, step) {
  const {right, up, ahead, eye} = axesOf(view), {xyz, kind, count} = map, w = picture.width, h = picture.height;
  const f = 0.5 * Math.min(w, h) / kHalfView, cx = 0.5 * w, cy = 0.5 * h, nearest = kNearest * view.distance;
  const [ex, ey, ez] = eye, [rx, ry] = right, [ux, uy, uz] = up, [ax, ay, az] = ahead;
  const sizeAt = 0.0014 * view.extent * f;  // pixels of a point at depth 1
  const least = count < kFewPoints ? 2 : 1;
  let px = 0, py = 0, pn = 0, last = -2;
  const project = i => {
    const x = xyz[3 * i] - ex, y = xyz[3 * i + 1] - ey, z = xyz[3 * i + 2] - ez, depth = ax * x + ay * y + az * z;
    last = i;
    if (depth < nearest) return void (pn = 0);
    pn = 1 / depth;
    px = cx + f * (rx * x + ry * y) * pn;
    py = cy - f * (ux * x + uy * y + uz * z) * pn;
  };
  const sizeOf = nearness => Math.max(least, Math.min(5, Math.round(sizeAt * nearness)));
  for (let i = 0; i < count; i += step) {
    if (kind[i] === kJoint) {
      if (last !== i - 1) project(i - 1);
      const x0 = px, y0 = py, n0 = pn;
      project(i);
      if (n0 > 0 && pn > 0) picture.line(x0, y0, n0, px, py, pn, Math.min(2, sizeOf(pn)), colors[i]);
    } else {
      project(i);
      if (kind[i] === kPoint && pn > 0) picture.dot(px, py, pn, sizeOf(pn), colors[i]);
    }
  }
}

// ---- lines over and under the picture ----

function strokeWay(context, way, project) {
  const p = {}, n = way.length / 3;
  let drawing = false;
  context.beginPath();
  for (let i = 0; i < n; ++i) {
    const there = isFinite(way[3 * i]) && project(way[3 * i], way[3 * i + 1], way[3 * i + 2], p);
    if (there) drawing ? context.lineTo(p.x, p.y) : context.moveTo(p.x, p.y);
    drawing = there;
  }
  context.stroke();
}

const rotated = ([x, y, z, w], [a, b, c]) => {
  const u = [y * c - z * b, z * a - x * c, x * b - y * a];
  return [a + 2 * (w * u[0] + y * u[2] - z * u[1]), b + 2 * (w * u[1] + z * u[0] - x * u[2]), c + 2 * (w * u[2] + x * u[1] - y * u[0])];
};

// The pyramid that a camera sees.
function strokeCamera(context, pose, size, project) {
  const at = (x, y, z) => {
    const v = rotated(pose.slice(3), [size * x, size * y, size * z]), p = {};
    return project(pose[0] + v[0], pose[1] + v[1], pose[2] + v[2], p) ? p : null;
  };
  const eye = at(0, 0, 0), corners = [at(-0.6, -0.4, 1), at(0.6, -0.4, 1), at(0.6, 0.4, 1), at(-0.6, 0.4, 1)];
  if (!eye || corners.includes(null)) return;
  corners.forEach((c, i) => {
    const next = corners[(i + 1) % 4];
    context.moveTo(eye.x, eye.y), context.lineTo(c.x, c.y), context.lineTo(next.x, next.y);
  });
}

function strokeKeyframes(context, map, size, project) {
  const n = map.frames.length, step = Math.max(1, Math.ceil(n / 400));
  context.beginPath();
  for (let i = 0; i < n; i += step) strokeCamera(context, Array.from(map.keyframes.subarray(7 * i, 7 * i + 7)), size, project);
  context.stroke();
}

// 1, 2 or 5 times a power of ten, at least `length`.
function roundLength(length) {
  const power = Math.pow(10, Math.floor(Math.log10(length)));
  return [1, 2, 5, 10].map(f => f * power).find(v => v >= 0.999 * length);
}

// A square grid on the ground around the target; a line is cut into pieces, since only a part of it may be before the eye.
function strokeGrid(context, view, step, project) {
  const half = 12, kPieces = 24, a = {}, b = {};
  const middle = [Math.round(view.target[0] / step) * step, Math.round(view.target[1] / step) * step];
  const piece = (x0, y0, x1, y1) => {
    if (!project(x0, y0, view.ground, a) || !project(x1, y1, view.ground, b)) return;
    context.moveTo(a.x, a.y), context.lineTo(b.x, b.y);
  };
  context.beginPath();
  for (let i = -half; i <= half; ++i)
    for (let k = 0; k < kPieces; ++k) {
      const from = step * half * (2 * k / kPieces - 1), to = step * half * (2 * (k + 1) / kPieces - 1), at = i * step;
      piece(middle[0] + at, middle[1] + from, middle[0] + at, middle[1] + to);
      piece(middle[0] + from, middle[1] + at, middle[0] + to, middle[1] + at);
    }
  context.stroke();
}

function circle(context, p, radius) {
  context.beginPath();
  context.arc(p.x, p.y, radius, 0, 2 * Math.PI);
  context.stroke();
}

// ---- where the view begins ----

function startOf(map) {
  const ways = [map.xyz, map.path].filter(v => v.length > 0), box = [0, 1, 2].map(k => {
    const parts = ways.map(v => spread(v, 3, k, v === map.xyz ? 0.07 : 0, v === map.xyz ? 0.93 : 1));
    return [Math.min(...parts.map(p => p[0])), Math.max(...parts.map(p => p[1]))];
  });
  const extent = Math.max(1e-6, Math.hypot(...box.map(([low, high]) => high - low)));
  const long = box[0][1] - box[0][0] >= box[1][1] - box[1][0];  // the way goes along x: from its side and behind
  return {target: box.map(([low, high]) => 0.5 * (low + high)), extent, distance: 0.95 * extent,
          azimuth: (long ? 235 : 200) * Math.PI / 180, elevation: 38 * Math.PI / 180, ground: box[2][0]};
}

// ---- one map on the page ----

class MapView {
  constructor(root) {
    this.root = root;
    this.canvas = root.querySelector("canvas");
    this.context = this.canvas.getContext("2d");
    this.map = unpacked(JSON.parse(root.querySelector("script").textContent));
    this.quantities = quantities(this.map);
    this.picture = new Picture();
    this.start = startOf(this.map);
    this.layers = {map: true, path: true, truth: true, keyframes: true, grid: true};
    this.step = 1, this.picked = -1, this.time = -1, this.moved = -1e9, this.asked = false;
    this.goTo({});
    this.paintWith("height");
    for (const e of root.querySelectorAll("[data-needs=truth]")) e.hidden = this.map.truth.length === 0;
    this.listen();
  }
  role(name) { return this.root.querySelector(`[data-role=${name}]`); }
  ink(name) { return getComputedStyle(this.canvas).getPropertyValue("--scene-" + name) || "#888"; }

  paintWith(name) {
    const q = this.quantities[name];
    this.quantity = q;
    this.colors = colorsOf(this.map, name, q);
    const stops = Array.from({length: 18}, (_, i) => 15 * i), ramp = this.map.ramp;
    this.role("ramp").style.background = name === "gray" ? "linear-gradient(to right,#383838,#fff)" :
        `linear-gradient(to right,${stops.map(i => `rgb(${ramp[3 * i]},${ramp[3 * i + 1]},${ramp[3 * i + 2]})`)})`;
    this.role("low").textContent = q.text(q.range[0]);
    this.role("what").textContent = q.what;
    this.role("high").textContent = q.text(q.range[1]);
    this.ask();
  }

  // The start, but for what `change` says.
  goTo(change) {
    this.view = {...this.start, target: [...this.start.target], ...change};
    this.ask();
  }

  // Asks for a picture; all that happens until it is drawn goes into one.
  ask() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => { this.asked = false; this.draw(); });
  }
  move(change) {
    this.moved = performance.now();
    change(this.view);
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.ask(), kRestMs);
    this.ask();
  }
  moving() { return performance.now() - this.moved < kRestMs - 10; }

  draw() {
    const began = performance.now(), moving = this.moving();
    const sharp = moving ? 1 : Math.min(2, devicePixelRatio || 1);
    const width = Math.max(1, Math.round(this.canvas.clientWidth * sharp)), height = Math.max(1, Math.round(this.canvas.clientHeight * sharp));
    if (this.canvas.width !== width || this.canvas.height !== height) this.canvas.width = width, this.canvas.height = height;
    this.picture.resize(width, height);
    this.picture.clear();
    if (this.layers.map) drawMap(this.picture, this.map, this.colors, this.view, moving ? this.step : 1);
    this.context.putImageData(this.picture.image, 0, 0);
    this.drawLines(width, height, sharp);
    if (moving) this.pace(performance.now() - began);
    this.canvas.dataset.step = moving ? this.step : 1;
  }
  // How many vertices the next picture of a movement may have.
  pace(ms) { this.step = Math.max(1, Math.min(64, Math.round(this.step * Math.min(2, Math.max(0.7, ms / kMovingMs)) + (ms > kMovingMs ? 0.5 : 0)))); }

  drawLines(width, height, sharp) {
    const {context, map, view, layers} = this, project = projection(view, width, height), p = {};
    context.lineJoin = "round";
    const stroke = (ink, thick, draw) => { context.strokeStyle = this.ink(ink), context.lineWidth = thick * sharp, draw(); };
    if (layers.keyframes) stroke("keyframes", 0.8, () => strokeKeyframes(context, map, 0.012 * view.extent, project));
    if (layers.truth) stroke("truth", 3.5, () => strokeWay(context, map.truth, project));
    if (layers.path) stroke("path", 1.8, () => strokeWay(context, map.path, project));
    if (this.time >= 0 && project(...map.path.subarray(3 * this.time, 3 * this.time + 3), p)) stroke("picked", 3, () => circle(context, p, 7 * sharp));
    if (this.picked >= 0 && project(...map.xyz.subarray(3 * this.picked, 3 * this.picked + 3), p)) stroke("picked", 2, () => circle(context, p, 8 * sharp));
    this.drawGrid(project, sharp);
  }
  // Under all else.
  drawGrid(project, sharp) {
    const step = roundLength(this.view.distance / 12);
    this.role("grid").textContent = this.layers.grid ? "grid " + (step >= 1 ? step : step.toPrecision(1)) + " " + this.map.unit : "";
    if (!this.layers.grid) return;
    this.context.globalCompositeOperation = "destination-over";
    this.context.strokeStyle = this.ink("grid"), this.context.lineWidth = sharp;
    strokeGrid(this.context, this.view, step, project);
    this.context.globalCompositeOperation = "source-over";
  }

  // ---- movements ----

  turn(dx, dy) {
    this.move(v => {
      v.azimuth -= kTurn * dx;
      v.elevation = Math.max(-1.57, Math.min(1.57, v.elevation + kTurn * dy));
    });
  }
  // By pixels: what is at the target follows the pointer.
  shift(dx, dy) {
    this.move(v => {
      const {right, up} = axesOf(v), side = Math.min(this.canvas.clientWidth, this.canvas.clientHeight);
      const unit = 2 * kHalfView * v.distance / Math.max(1, side);
      v.target = v.target.map((t, i) => t + unit * (dy * up[i] - dx * right[i]));
    });
  }
  zoom(factor) {
    this.move(v => { v.distance = Math.max(1e-3 * v.extent, Math.min(20 * v.extent, v.distance * factor)); });
  }

  // ---- picking ----

  // The nearest to the eye of the points under the pointer; x and y in CSS pixels of the canvas.
  pick(x, y) {
    const {map, canvas} = this, project = projection(this.view, canvas.clientWidth, canvas.clientHeight), p = {};
    let found = -1, nearest = Infinity;
    for (let i = 0; this.layers.map && i < map.count; ++i) {
      if (!project(map.xyz[3 * i], map.xyz[3 * i + 1], map.xyz[3 * i + 2], p) || p.depth >= nearest) continue;
      if (Math.hypot(p.x - x, p.y - y) <= kPickPx) found = i, nearest = p.depth;
    }
    this.picked = found;
    this.role("picked").textContent = found < 0 ? "No point is there." : this.words(found);
    this.ask();
  }
  words(i) {
    const {map, quantity} = this, at = k => map.xyz[3 * i + k].toFixed(digits(map.xyz[3 * i + k])), k = map.host[i];
    const sigma = map.sigma[i] > 0 ? `± ${length(map.sigma[i], map.unit)} along the ray` : "uncertainty not known";
    const host = k >= 0 ? `keyframe ${k} (frame ${map.frames[k]})` : "no keyframe";
    return `x ${at(0)}, y ${at(1)}, z ${at(2)} ${map.unit} (forward, left, up); ${sigma}; gray ${map.gray[i]}; ${host}; ` +
        `colour: ${quantity.what.split(" (")[0]} ${quantity.text(quantity.of(i))}`;
  }

  // ---- events ----

  listen() {
    this.role("color").addEventListener("change", e => this.paintWith(e.target.value));
    for (const box of this.root.querySelectorAll("[data-layer]"))
      box.addEventListener("change", () => { this.layers[box.dataset.layer] = box.checked, this.ask(); });
    for (const button of this.root.querySelectorAll("[data-do]")) button.addEventListener("click", () => this.act(button.dataset.do));
    this.canvas.addEventListener("keydown", e => this.onKey(e));
    this.canvas.addEventListener("contextmenu", e => e.preventDefault());
    this.canvas.addEventListener("wheel", e => this.onWheel(e), {passive: false});
    this.listenToPointers();
    new ResizeObserver(() => this.ask()).observe(this.canvas);
    for (const query of ["(prefers-color-scheme: dark)", "print"]) matchMedia(query).addEventListener("change", () => this.draw());
    addEventListener("edgevo-time", e => this.showTime(e.detail));
  }
  act(what) {
    const actions = {
      start: () => this.goTo({}), above: () => this.goTo({azimuth: Math.PI, elevation: Math.PI / 2}),
      side: () => this.goTo({elevation: 0.12}), closer: () => this.zoom(0.8), farther: () => this.zoom(1.25),
      full: () => document.fullscreenElement ? document.exitFullscreen() : this.root.requestFullscreen(),
    };
    actions[what]();
  }
  onKey(e) {
    const step = 24, ways = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]};
    const way = ways[e.key], keys = {"+": "closer", "=": "closer", "-": "farther", "0": "start"};
    if (e.ctrlKey || e.altKey || e.metaKey) return;
    if (way) e.shiftKey ? this.shift(...way) : this.turn(-way[0], -way[1]);
    else if (keys[e.key]) this.act(keys[e.key]);
    else if (e.key === "Enter") this.pick(0.5 * this.canvas.clientWidth, 0.5 * this.canvas.clientHeight);
    else return;
    e.preventDefault();
  }
  // The page scrolls over a map that nobody has clicked.
  onWheel(e) {
    if (document.activeElement !== this.canvas) return;
    e.preventDefault();
    this.zoom(Math.exp(0.0015 * Math.max(-300, Math.min(300, e.deltaY))));
  }
  listenToPointers() {
    const down = new Map();  // pointer -> where it is, from when it was pressed
    let travel = 0;
    this.canvas.addEventListener("pointerdown", e => {
      this.canvas.focus({preventScroll: true});
      this.canvas.setPointerCapture(e.pointerId);
      if (down.size === 0) travel = 0;
      down.set(e.pointerId, {x: e.clientX, y: e.clientY});
    });
    this.canvas.addEventListener("pointermove", e => {
      const before = down.get(e.pointerId);
      if (!before) return;
      const now = {x: e.clientX, y: e.clientY};
      travel += Math.hypot(now.x - before.x, now.y - before.y);
      if (down.size === 1 && travel > 3) e.buttons & 2 || e.shiftKey ? this.shift(now.x - before.x, now.y - before.y) : this.turn(now.x - before.x, now.y - before.y);
      if (down.size === 2) this.pinch([...down.entries()].find(([id]) => id !== e.pointerId)[1], before, now);
      down.set(e.pointerId, now);
    });
    const up = e => {
      const was = down.delete(e.pointerId);
      if (!was || e.type !== "pointerup" || travel > 3 || down.size > 0) return;
      const box = this.canvas.getBoundingClientRect();
      this.pick(e.clientX - box.left, e.clientY - box.top);
    };
    this.canvas.addEventListener("pointerup", up);
    this.canvas.addEventListener("pointercancel", up);
  }
  // One of two fingers moved.
  pinch(other, before, now) {
    const span = p => Math.max(20, Math.hypot(p.x - other.x, p.y - other.y));
    this.zoom(span(before) / span(now));
    this.shift(0.5 * (now.x - before.x), 0.5 * (now.y - before.y));
  }
  // The frame nearest in time to the pointer in a chart; null: none.
  showTime(seconds) {
    const all = this.map.seconds;
    let low = 0, high = all.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (all[middle] < seconds) low = middle + 1; else high = middle;
    }
    this.time = seconds === null || all.length === 0 ? -1 : low;
    this.ask();
  }
}

for (const root of document.querySelectorAll(".map3d")) root.view = new MapView(root);
})();
