'use strict';
// Common script of all pages: values under the pointer in charts and plans, pictures that enlarge.
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const element = (name, parent, text = '') => {
    const e = document.createElement(name);
    e.textContent = text;
    parent.append(e);
    return e;
  };
  const written = value => value === null ? '-' :
      Math.abs(value) >= 1000             ? value.toFixed(0) :
                                            String(Number(value.toPrecision(4)));

  // ---- charts: a common cursor ----

  // Index of the value nearest to x in the ascending `xs`.
  function nearest(xs, x) {
    let low = 0, high = xs.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (xs[middle] < x)
        low = middle;
      else
        high = middle;
    }
    return Math.abs(xs[low] - x) <= Math.abs(xs[high] - x) ? low : high;
  }

  class Chart {
    constructor(root) {
      this.root = root;
      this.data = JSON.parse(root.dataset.chart);
      this.plot = root.querySelector('.plot');
      this.output = element('output', root.querySelector('.name'));
      this.cursor = element('i', this.plot);
      this.cursor.className = 'cursor';
      this.cursor.hidden = true;
    }
    timeAt(clientX) {
      const box = this.plot.getBoundingClientRect(), [low, high] = this.data.range;
      return low + Math.max(0, Math.min(1, (clientX - box.left) / box.width)) * (high - low);
    }
    show(time) {
      const {x, range, series} = this.data;
      this.cursor.hidden = time === null || x.length === 0;
      this.output.replaceChildren();
      if (this.cursor.hidden) return;
      this.at = nearest(x, time);
      this.cursor.style.left = 100 * (x[this.at] - range[0]) / (range[1] - range[0]) + '%';
      element('span', this.output, written(x[this.at]) + ' s');
      for (const s of series) {
        element('i', this.output).style.background = s.color;
        element('span', this.output, (series.length > 1 ? s.name + ' ' : '') + written(s.y[this.at]));
      }
    }
    // The time `steps` values after the current one.
    timeAfter(steps) {
      const {x} = this.data, at = this.at === undefined ? 0 : this.at + steps;
      return x[Math.max(0, Math.min(x.length - 1, at))];
    }
  }

  const charts = all('[data-chart]').map(root => new Chart(root));
  function showTime(time) {
    for (const chart of charts) chart.show(time);
    dispatchEvent(new CustomEvent('edgevo-time', {detail: time}));
  }
  for (const chart of charts) {
    const follow = e => showTime(chart.timeAt(e.clientX));
    chart.plot.addEventListener('pointermove', follow);
    chart.plot.addEventListener('pointerdown', follow);
    chart.plot.addEventListener('pointerleave', e => {
      if (e.pointerType === 'mouse') showTime(null);
    });
    chart.root.addEventListener('keydown', e => {
      const steps = {ArrowLeft: -1, ArrowRight: 1, PageUp: -20, PageDown: 20, Home: -1e9, End: 1e9}[e.key];
      if (e.key === 'Escape') showTime(null);
      if (steps === undefined || chart.data.x.length === 0) return;
      e.preventDefault();
      showTime(chart.timeAfter(steps));
    });
  }

  // ---- plans: position on the ground ----

  for (const root of all('[data-plan]')) {
    const {left, forward, unit} = JSON.parse(root.dataset.plan), plot = root.querySelector('.plot');
    const output = element('output', root.querySelector('.name'));
    const between = ([from, to], share) => (from + share * (to - from)).toFixed(2);
    plot.addEventListener('pointermove', e => {
      const box = plot.getBoundingClientRect();
      output.textContent = 'forward ' + between(forward, (e.clientY - box.top) / box.height) + ', left ' +
          between(left, (e.clientX - box.left) / box.width) + ' ' + unit;
    });
    plot.addEventListener('pointerleave', () => {
      output.textContent = '';
    });
  }

  // ---- pictures ----

  const pictures = all('figure img');
  function enlarge(first) {
    let at = first;
    const dialog = element('dialog', document.body), image = element('img', dialog),
          text = element('p', dialog);
    const show = step => {
      at = (at + step + pictures.length) % pictures.length;
      image.src = pictures[at].src;
      image.alt = pictures[at].alt;
      text.textContent = pictures[at].closest('figure').textContent.trim() +
          (pictures.length > 1 ? ' (arrow keys: the others)' : '');
    };
    dialog.addEventListener('click', () => dialog.close());
    dialog.addEventListener('close', () => dialog.remove());
    dialog.addEventListener('keydown', e => {
      if (e.key === 'ArrowRight') show(1);
      if (e.key === 'ArrowLeft') show(-1);
    });
    show(0);
    dialog.showModal();
  }
  pictures.forEach((image, i) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'enlarge';
    button.setAttribute('aria-label', 'enlarge: ' + image.alt);
    image.replaceWith(button);
    button.append(image);
    button.addEventListener('click', () => enlarge(i));
  });
})();
