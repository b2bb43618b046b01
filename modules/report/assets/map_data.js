'use strict';
// The map in 3D: its data as arrays, read from the output of map_packing.h, and the quantities shown as colours.
const MapData = (() => {
  // What is drawn at a vertex: a dot, a line from the vertex before, or nothing.
  const kPoint = 0, kJoint = 1, kLineStart = 2;

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
    return Float32Array.from(
        bytesOf(data.sigma), v => v === 0 ? 0 : data.sigma_low * Math.pow(ratio, (v - 1) / 254));
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
    for (let i = 0, at = 0; i < pairs.length; at += pairs[i], i += 2)
      hosts.fill(pairs[i + 1], at, at + pairs[i]);
    return hosts;
  }

  function unpacked(data) {
    const xyz = positionsOf(data), count = xyz.length / 3;
    return {
      unit: data.unit,
      count,
      xyz,
      sigma: sigmasOf(data),
      gray: bytesOf(data.gray),
      kind: kindsOf(data, count),
      host: hostsOf(data, count),
      path: floatsOf(data.path),
      truth: floatsOf(data.truth),
      seconds: floatsOf(data.seconds),
      keyframes: floatsOf(data.keyframes),
      frames: intsOf(data.frames),
      ramp: bytesOf(data.ramp)
    };
  }

  // ---- ranges and colours ----

  // The `low` and `high` quantiles of the finite values, estimated from a few thousand of them.
  function spread(values, stride, offset, low, high) {
    const count = values.length / stride, step = Math.max(1, Math.floor(count / 5000)), some = [];
    for (let i = 0; i < count; i += step)
      if (isFinite(values[stride * i + offset])) some.push(values[stride * i + offset]);
    if (some.length === 0) return [0, 1];
    some.sort((a, b) => a - b);
    return [some[Math.floor(low * (some.length - 1))], some[Math.ceil(high * (some.length - 1))]];
  }

  const digits = value => Math.abs(value) >= 100 ? 1 : Math.abs(value) >= 1 ? 2 : 3;
  const length = (value, unit) => value.toFixed(digits(value)) + ' ' + unit;

  // Quantities that a colour can show: the value of a vertex, and the labels of the legend.
  function quantities(map) {
    const some = map.sigma.filter(s => s > 0), sigma = spread(some.length ? some : [1], 1, 0, 0.02, 0.98);
    return {
      height: {
        what: 'height',
        of: i => map.xyz[3 * i + 2],
        range: spread(map.xyz, 3, 2, 0.02, 0.98),
        text: v => length(v, map.unit)
      },
      sigma: {
        what: 'uncertainty (one standard deviation, logarithmic)',
        of: i => Math.log(map.sigma[i] || NaN),
        range: sigma.map(Math.log),
        text: v => length(Math.exp(v), map.unit)
      },
      gray: {what: 'gray of the image', of: i => map.gray[i], range: [0, 255], text: v => v.toFixed(0)},
      time: {
        what: 'keyframe',
        of: i => map.host[i],
        range: [0, Math.max(1, map.frames.length - 1)],
        text: v => v.toFixed(0)
      },
    };
  }

  const packColor = (r, g, b) => (255 << 24 | b << 16 | g << 8 | r) >>> 0;  // in the byte order of the picture

  function rampColors(map, name) {
    const colors = new Uint32Array(256);
    for (let i = 0; i < 256; ++i) {
      const gray = 56 + Math.round(i * 199 / 255);  // black would not be visible on the dark background
      const light = k => 36 + Math.round(map.ramp[3 * i + k] * 219 / 255);
      colors[i] = name === 'gray' ? packColor(gray, gray, gray) : packColor(light(0), light(1), light(2));
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

  return {kPoint, kJoint, unpacked, spread, digits, length, quantities, rampColors, colorsOf};
})();
