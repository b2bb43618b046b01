'use strict';
// The map in 3D: its drawing. The loops below draw points and lines into a picture in memory with a depth buffer,
// without a graphics card. Path, cameras and grid are canvas strokes above and below it.
const MapDrawing = (() => {
  const {kPoint, kJoint} = MapData;
  const kHalfView = Math.tan(25 * Math.PI / 180);  // half of the view's shorter side, at distance 1
  const kNearest = 0.002;                          // share of the view's distance; nothing nearer is drawn
  const kFewPoints = 40000;                        // up to so many points are drawn larger

  // ---- the view ----

  // Looks at `target` from `distance`, turned by `azimuth` about z and raised by `elevation`.
  function axesOf(view) {
    const ca = Math.cos(view.azimuth), sa = Math.sin(view.azimuth), ce = Math.cos(view.elevation),
          se = Math.sin(view.elevation);
    const ahead = [-ce * ca, -ce * sa, -se];
    return {
      right: [-sa, ca, 0],
      up: [-se * ca, -se * sa, ce],
      ahead,
      eye: view.target.map((t, i) => t - view.distance * ahead[i])
    };
  }

  // From the map to pixels: x right, y down, depth along the view.
  function projection(view, width, height) {
    const {right, up, ahead, eye} = axesOf(view), f = 0.5 * Math.min(width, height) / kHalfView,
                             nearest = kNearest * view.distance;
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
      if (steps > 4 * (w + h)) return;  // the line passes through the eye
      if (size === 1)
        return this.thinLine(x0, y0, near0, dx / steps, dy / steps, (near1 - near0) / steps, steps, color);
      for (let k = 0; k <= steps; ++k) {
        const s = k / steps;
        this.dot(x0 + s * dx, y0 + s * dy, near0 + s * (near1 - near0), size, color);
      }
    }
    // A line one pixel wide from (x, y) in steps of (dx, dy), as most lines of a large map are.
    thinLine(x, y, nearness, dx, dy, dn, steps, color) {
      const {width, height, pixels} = this, all = this.nearness;
      for (let k = 0; k <= steps; ++k, x += dx, y += dy, nearness += dn) {
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        const at = (y | 0) * width + (x | 0);
        if (nearness > all[at]) all[at] = nearness, pixels[at] = color;
      }
    }
  }

  // Draws every `step`-th vertex, and the one before it for a line. The projection is inlined: a call for each
  // vertex would cost more than everything else.
  function drawMap(picture, map, colors, view, step, sharp) {
    const {right, up, ahead, eye} = axesOf(view), {xyz, kind, count} = map, w = picture.width,
                             h = picture.height;
    const f = 0.5 * Math.min(w, h) / kHalfView, cx = 0.5 * w, cy = 0.5 * h,
          nearest = kNearest * view.distance;
    const [ex, ey, ez] = eye, [rx, ry] = right, [ux, uy, uz] = up, [ax, ay, az] = ahead;
    const sizeAt = 0.0014 * view.extent * f;  // pixels of a point at depth 1
    const least = Math.round(sharp * (count < kFewPoints ? 2 : 1)), most = Math.round(4 * sharp);
    let px = 0, py = 0, pn = 0, last = -2;
    const project = i => {
      const x = xyz[3 * i] - ex, y = xyz[3 * i + 1] - ey, z = xyz[3 * i + 2] - ez,
            depth = ax * x + ay * y + az * z;
      last = i;
      if (depth < nearest) return void (pn = 0);
      pn = 1 / depth;
      px = cx + f * (rx * x + ry * y) * pn;
      py = cy - f * (ux * x + uy * y + uz * z) * pn;
    };
    const sizeOf = nearness => Math.max(least, Math.min(most, Math.round(sizeAt * nearness)));
    for (let i = 0; i < count; i += step) {
      if (kind[i] === kJoint) {
        if (last !== i - 1) project(i - 1);
        const x0 = px, y0 = py, n0 = pn;
        project(i);
        if (n0 > 0 && pn > 0) picture.line(x0, y0, n0, px, py, pn, least, colors[i]);
      } else {
        project(i);
        if (kind[i] === kPoint && pn > 0) picture.dot(px, py, pn, sizeOf(pn), colors[i]);
      }
    }
  }

  // ---- lines over and under the picture ----

  function strokePath(context, path, project) {
    const p = {}, n = path.length / 3;
    let drawing = false;
    context.beginPath();
    for (let i = 0; i < n; ++i) {
      const there = isFinite(path[3 * i]) && project(path[3 * i], path[3 * i + 1], path[3 * i + 2], p);
      if (there) drawing ? context.lineTo(p.x, p.y) : context.moveTo(p.x, p.y);
      drawing = there;
    }
    context.stroke();
  }

  const rotated = ([x, y, z, w], [a, b, c]) => {
    const u = [y * c - z * b, z * a - x * c, x * b - y * a];
    return [
      a + 2 * (w * u[0] + y * u[2] - z * u[1]), b + 2 * (w * u[1] + z * u[0] - x * u[2]),
      c + 2 * (w * u[2] + x * u[1] - y * u[0])
    ];
  };

  // The view frustum of a camera, as a pyramid.
  function strokeCamera(context, pose, size, project) {
    const at = (x, y, z) => {
      const v = rotated(pose.slice(3), [size * x, size * y, size * z]), p = {};
      return project(pose[0] + v[0], pose[1] + v[1], pose[2] + v[2], p) ? p : null;
    };
    const eye = at(0, 0, 0),
          corners = [at(-0.6, -0.4, 1), at(0.6, -0.4, 1), at(0.6, 0.4, 1), at(-0.6, 0.4, 1)];
    if (!eye || corners.includes(null)) return;
    corners.forEach((c, i) => {
      const next = corners[(i + 1) % 4];
      context.moveTo(eye.x, eye.y), context.lineTo(c.x, c.y), context.lineTo(next.x, next.y);
    });
  }

  function strokeKeyframes(context, map, size, project) {
    const n = map.frames.length, step = Math.max(1, Math.ceil(n / 400));
    context.beginPath();
    for (let i = 0; i < n; i += step)
      strokeCamera(context, Array.from(map.keyframes.subarray(7 * i, 7 * i + 7)), size, project);
    context.stroke();
  }

  // 1, 2 or 5 times a power of ten, at least `length`.
  function roundLength(length) {
    const power = Math.pow(10, Math.floor(Math.log10(length)));
    return [1, 2, 5, 10].map(f => f * power).find(v => v >= 0.999 * length);
  }

  // A square grid on the ground around the target. Lines are split into pieces, since only a part of a line may be
  // in front of the eye.
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
        const from = step * half * (2 * k / kPieces - 1), to = step * half * (2 * (k + 1) / kPieces - 1),
              at = i * step;
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

  return {
    kHalfView,
    axesOf,
    projection,
    Picture,
    drawMap,
    strokePath,
    strokeKeyframes,
    strokeGrid,
    roundLength,
    circle
  };
})();
