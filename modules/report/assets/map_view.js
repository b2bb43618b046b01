'use strict';
// The map in 3D on the page: view, navigation and picking. While the view moves, only every n-th vertex is drawn,
// with n such that a picture takes kMovingMs; at rest all are.
(() => {
  const {spread, digits, length} = MapData;
  const {axesOf, projection, circle} = MapDrawing;
  // Time for a picture while the view moves: 30 to 60 pictures a second, including the browser's overhead.
  const kMovingMs = 22;
  const kRestMs = 160;  // without a movement until all vertices are drawn
  const kTurn = 0.008;  // radians a pixel of dragging
  const kPickPx = 9;    // pixels within which the pointer hits a point

  // ---- initial view ----

  function startOf(map) {
    const paths = [map.xyz, map.path].filter(v => v.length > 0), box = [0, 1, 2].map(k => {
      const parts = paths.map(v => spread(v, 3, k, v === map.xyz ? 0.07 : 0, v === map.xyz ? 0.93 : 1));
      return [Math.min(...parts.map(p => p[0])), Math.max(...parts.map(p => p[1]))];
    });
    const extent = Math.max(1e-6, Math.hypot(...box.map(([low, high]) => high - low)));
    // A scene that is long in x is viewed from the side and behind.
    const long = box[0][1] - box[0][0] >= box[1][1] - box[1][0];
    return {
      target: box.map(([low, high]) => 0.5 * (low + high)),
      extent,
      distance: 0.95 * extent,
      azimuth: (long ? 235 : 200) * Math.PI / 180,
      elevation: 38 * Math.PI / 180,
      ground: box[2][0]
    };
  }

  // ---- one map on the page ----

  class MapView {
    constructor(root) {
      this.root = root;
      this.canvas = root.querySelector('canvas');
      this.context = this.canvas.getContext('2d');
      this.map = MapData.unpacked(JSON.parse(root.querySelector('script').textContent));
      this.quantities = MapData.quantities(this.map);
      this.picture = new MapDrawing.Picture();
      this.start = startOf(this.map);
      this.layers = {map: true, path: true, truth: true, keyframes: true, grid: true};
      this.step = 1, this.picked = -1, this.time = -1, this.moved = -1e9, this.requested = false;
      this.goTo({});
      this.paintWith('height');
      for (const e of root.querySelectorAll('[data-needs=truth]')) e.hidden = this.map.truth.length === 0;
      this.listen();
    }
    role(name) { return this.root.querySelector(`[data-role=${name}]`); }
    ink(name) { return getComputedStyle(this.canvas).getPropertyValue('--scene-' + name) || '#888'; }

    paintWith(name) {
      const q = this.quantities[name];
      this.quantity = q;
      this.colors = MapData.colorsOf(this.map, name, q);
      const shown = Array.from(MapData.rampColors(this.map, name)).filter((_, i) => i % 15 === 0);
      const css = shown.map(c => `rgb(${c & 255},${c >> 8 & 255},${c >> 16 & 255})`);
      this.role('ramp').style.background = `linear-gradient(to right,${css})`;
      this.role('low').textContent = q.text(q.range[0]);
      this.role('what').textContent = q.what;
      this.role('high').textContent = q.text(q.range[1]);
      this.request();
    }

    // Goes to the initial view, with the changes in `change`.
    goTo(change) {
      this.view = {...this.start, target: [...this.start.target], ...change};
      this.request();
    }

    // Requests a picture; all changes until it is drawn go into the same one.
    request() {
      if (this.requested) return;
      this.requested = true;
      requestAnimationFrame(() => {
        this.requested = false;
        this.draw();
      });
    }
    move(change) {
      this.moved = performance.now();
      change(this.view);
      clearTimeout(this.rest);
      this.rest = setTimeout(() => this.request(), kRestMs);
      this.request();
    }
    moving() { return performance.now() - this.moved < kRestMs - 10; }

    draw() {
      const began = performance.now(), moving = this.moving();
      const sharp = moving ? 1 : Math.min(2, devicePixelRatio || 1);
      const width = Math.max(1, Math.round(this.canvas.clientWidth * sharp)),
            height = Math.max(1, Math.round(this.canvas.clientHeight * sharp));
      if (this.canvas.width !== width || this.canvas.height !== height)
        this.canvas.width = width, this.canvas.height = height;
      this.picture.resize(width, height);
      this.picture.clear();
      if (this.layers.map)
        MapDrawing.drawMap(this.picture, this.map, this.colors, this.view, moving ? this.step : 1, sharp);
      this.context.putImageData(this.picture.image, 0, 0);
      this.drawLines(width, height, sharp);
      if (moving) this.pace(performance.now() - began);
      this.canvas.dataset.step = moving ? this.step : 1;
    }
    // Adapts the number of vertices of the next picture during a movement.
    pace(ms) {
      const slower = Math.min(2, Math.max(0.7, ms / kMovingMs)), step = Math.round(this.step * slower);
      const next = ms > kMovingMs ? Math.max(step, this.step + 1) : step;
      this.step = Math.min(64, Math.max(1, next));
    }

    drawLines(width, height, sharp) {
      const {context, map, view, layers} = this, project = projection(view, width, height), p = {};
      context.lineJoin = 'round';
      const stroke = (ink, thick, draw) => {
        context.strokeStyle = this.ink(ink), context.lineWidth = thick * sharp, draw();
      };
      if (layers.keyframes)
        stroke(
            'keyframes', 0.8, () => MapDrawing.strokeKeyframes(context, map, 0.012 * view.extent, project));
      if (layers.truth) stroke('truth', 3.5, () => MapDrawing.strokePath(context, map.truth, project));
      if (layers.path) stroke('path', 1.8, () => MapDrawing.strokePath(context, map.path, project));
      if (this.time >= 0 && project(...map.path.subarray(3 * this.time, 3 * this.time + 3), p))
        stroke('picked', 3, () => circle(context, p, 7 * sharp));
      if (this.picked >= 0 && project(...map.xyz.subarray(3 * this.picked, 3 * this.picked + 3), p))
        stroke('picked', 2, () => circle(context, p, 8 * sharp));
      this.drawGrid(project, sharp);
    }
    // Drawn below everything else.
    drawGrid(project, sharp) {
      const step = MapDrawing.roundLength(this.view.distance / 12);
      this.role('grid').textContent =
          this.layers.grid ? 'grid ' + (step >= 1 ? step : step.toPrecision(1)) + ' ' + this.map.unit : '';
      if (!this.layers.grid) return;
      this.context.globalCompositeOperation = 'destination-over';
      this.context.strokeStyle = this.ink('grid'), this.context.lineWidth = sharp;
      MapDrawing.strokeGrid(this.context, this.view, step, project);
      this.context.globalCompositeOperation = 'source-over';
    }

    // ---- movements ----

    turn(dx, dy) {
      this.move(v => {
        v.azimuth -= kTurn * dx;
        v.elevation = Math.max(-1.57, Math.min(1.57, v.elevation + kTurn * dy));
      });
    }
    // Moves by pixels: the point at the target follows the pointer.
    shift(dx, dy) {
      this.move(v => {
        const {right, up} = axesOf(v), side = Math.min(this.canvas.clientWidth, this.canvas.clientHeight);
        const unit = 2 * MapDrawing.kHalfView * v.distance / Math.max(1, side);
        v.target = v.target.map((t, i) => t + unit * (dy * up[i] - dx * right[i]));
      });
    }
    zoom(factor) {
      this.move(v => {
        v.distance = Math.max(1e-3 * v.extent, Math.min(20 * v.extent, v.distance * factor));
      });
    }

    // ---- picking ----

    // The point under the pointer that is nearest to the eye; x and y in CSS pixels of the canvas.
    pick(x, y) {
      const {map, canvas} = this, project = projection(this.view, canvas.clientWidth, canvas.clientHeight),
                  p = {};
      let found = -1, nearest = Infinity;
      for (let i = 0; this.layers.map && i < map.count; ++i) {
        if (!project(map.xyz[3 * i], map.xyz[3 * i + 1], map.xyz[3 * i + 2], p) || p.depth >= nearest)
          continue;
        if (Math.hypot(p.x - x, p.y - y) <= kPickPx) found = i, nearest = p.depth;
      }
      this.picked = found;
      this.role('picked').textContent = found < 0 ? 'No point is there.' : this.words(found);
      this.request();
    }
    words(i) {
      const {map, quantity} = this, at = k => map.xyz[3 * i + k].toFixed(digits(map.xyz[3 * i + k])),
                  k = map.host[i];
      const sigma =
          map.sigma[i] > 0 ? `± ${length(map.sigma[i], map.unit)} along the ray` : 'uncertainty not known';
      const host = k >= 0 ? `keyframe ${k} (frame ${map.frames[k]})` : 'no keyframe';
      return `x ${at(0)}, y ${at(1)}, z ${at(2)} ${map.unit} (forward, left, up); ${sigma}; gray ${
                 map.gray[i]}; ${host}; ` +
          `colour: ${quantity.what.split(' (')[0]} ${quantity.text(quantity.of(i))}`;
    }

    // ---- events ----

    listen() {
      this.role('color').addEventListener('change', e => this.paintWith(e.target.value));
      for (const box of this.root.querySelectorAll('[data-layer]'))
        box.addEventListener('change', () => {
          this.layers[box.dataset.layer] = box.checked, this.request();
        });
      for (const button of this.root.querySelectorAll('[data-do]'))
        button.addEventListener('click', () => this.act(button.dataset.do));
      this.canvas.addEventListener('keydown', e => this.onKey(e));
      this.canvas.addEventListener('contextmenu', e => e.preventDefault());
      this.canvas.addEventListener('wheel', e => this.onWheel(e), {passive: false});
      this.listenToPointers();
      new ResizeObserver(() => this.request()).observe(this.canvas);
      for (const query of ['(prefers-color-scheme: dark)', 'print'])
        matchMedia(query).addEventListener('change', () => this.draw());
      addEventListener('edgevo-time', e => this.showTime(e.detail));
    }
    act(what) {
      const actions = {
        start: () => this.goTo({}),
        above: () => this.goTo({azimuth: Math.PI, elevation: Math.PI / 2}),
        side: () => this.goTo({elevation: 0.12}),
        closer: () => this.zoom(0.8),
        farther: () => this.zoom(1.25),
        full: () => document.fullscreenElement ? document.exitFullscreen() : this.root.requestFullscreen(),
      };
      actions[what]();
    }
    onKey(e) {
      const step = 24,
            steps = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]};
      const move = steps[e.key], keys = {'+': 'closer', '=': 'closer', '-': 'farther', '0': 'start'};
      if (e.ctrlKey || e.altKey || e.metaKey) return;
      if (move)
        e.shiftKey ? this.shift(...move) : this.turn(-move[0], -move[1]);
      else if (keys[e.key])
        this.act(keys[e.key]);
      else if (e.key === 'Enter')
        this.pick(0.5 * this.canvas.clientWidth, 0.5 * this.canvas.clientHeight);
      else
        return;
      e.preventDefault();
    }
    // The page scrolls over a map that has not been clicked.
    onWheel(e) {
      if (document.activeElement !== this.canvas) return;
      e.preventDefault();
      this.zoom(Math.exp(0.0015 * Math.max(-300, Math.min(300, e.deltaY))));
    }
    listenToPointers() {
      const down = new Map();  // pressed pointer -> its position
      let travel = 0;
      this.canvas.addEventListener('pointerdown', e => {
        this.canvas.focus({preventScroll: true});
        this.canvas.setPointerCapture(e.pointerId);
        if (down.size === 0) travel = 0;
        down.set(e.pointerId, {x: e.clientX, y: e.clientY});
      });
      this.canvas.addEventListener('pointermove', e => {
        const before = down.get(e.pointerId);
        if (!before) return;
        const now = {x: e.clientX, y: e.clientY};
        travel += Math.hypot(now.x - before.x, now.y - before.y);
        if (down.size === 1 && travel > 3)
          e.buttons&2 || e.shiftKey ? this.shift(now.x - before.x, now.y - before.y) :
                                      this.turn(now.x - before.x, now.y - before.y);
        if (down.size === 2)
          this.pinch([...down.entries()].find(([id]) => id !== e.pointerId)[1], before, now);
        down.set(e.pointerId, now);
      });
      const up = e => {
        const was = down.delete(e.pointerId);
        if (!was || e.type !== 'pointerup' || travel > 3 || down.size > 0) return;
        const box = this.canvas.getBoundingClientRect();
        this.pick(e.clientX - box.left, e.clientY - box.top);
      };
      this.canvas.addEventListener('pointerup', up);
      this.canvas.addEventListener('pointercancel', up);
    }
    // Handles the movement of one of two fingers.
    pinch(other, before, now) {
      const span = p => Math.max(20, Math.hypot(p.x - other.x, p.y - other.y));
      this.zoom(span(before) / span(now));
      this.shift(0.5 * (now.x - before.x), 0.5 * (now.y - before.y));
    }
    // Shows the frame that is nearest in time to the pointer in a chart; null: none.
    showTime(seconds) {
      const all = this.map.seconds;
      let low = 0, high = all.length - 1;
      while (low < high) {
        const middle = (low + high) >> 1;
        if (all[middle] < seconds)
          low = middle + 1;
        else
          high = middle;
      }
      this.time = seconds === null || all.length === 0 ? -1 : low;
      this.request();
    }
  }

  for (const root of document.querySelectorAll('.map3d')) root.view = new MapView(root);
})();
