// The picture of a state on the canvas.
import { LEVELS, particles, pressure, property, rgb, theme } from "./colours.js";

const FRESH = { x: 0, y: 0, zoom: 1 };
const [DROPLET, OPEN, AREA, HOLE] = [0, 1, 2, 3];
/** Number of arrows about a droplet. */
const ARROWS = 24;

/** Shapes of a flat list: kind, number of points, then x, y and concentration of each. */
export function shapesOf(list) {
  const shapes = [];
  for (let at = 0; at < list.length;) {
    const [kind, count] = [list[at], list[at + 1]];
    const points = list.subarray(at + 2, at + 2 + 3 * count);
    shapes.push({ kind, count, points });
    at += 2 + 3 * count;
  }
  return shapes;
}

function middle({ points, count }) {
  let [x, y] = [0, 0];
  for (let k = 0; k < count; k += 1) {
    x += points[3 * k] / count;
    y += points[3 * k + 1] / count;
  }
  return [x, y];
}

/** Shapes between two states, part of the way. */
function between(before, after, part) {
  if (!before || before.length !== after.length) return after;
  return after.map((shape, number) => {
    const other = before[number];
    if (other.count !== shape.count || shape.kind > OPEN) return shape;
    const points = new Float32Array(shape.points.length);
    for (let k = 0; k < points.length; k += 1)
      points[k] = other.points[k] + part * (shape.points[k] - other.points[k]);
    const gradient = shape.gradient?.map((value, k) => value + (1 - part) * ((other.gradient?.[k] ?? value) - value));
    return { ...shape, points, gradient };
  });
}

export class Picture {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.tile = document.createElement("canvas");
    this.camera = { ...FRESH };
    this.about = null;
    this.frames = [];
    this.trails = [];
    this.look = { tracers: true, streamlines: false, pressure: false, trail: true, arrows: false };
    this.held = false;
    this.restyle();
  }

  /** Takes the colours of the theme. */
  restyle() {
    this.name = theme();
    this.colours = Object.fromEntries(
      ["fluid", "wall", "ink", "line", "soft", "accent"].map((name) => [name, property("--" + name)]),
    );
    this.rgb = { drop: property("--drop"), dust: property("--dust") };
    this.scale = Array.from({ length: LEVELS }, (_, k) => rgb(particles(k / (LEVELS - 1), this.name)));
    this.flowChanged = true;
  }

  /** A new scene. */
  begin(about) {
    this.about = about;
    this.frames = [];
    this.trails = [];
    this.flow = null;
    this.centre = null;
    this.top = null;
    this.range = NaN;
    this.steepest = 0;
    this.camera = { ...FRESH };
    this.held = false;
  }

  add(message) {
    const frame = { time: message.time, tilt: message.tilt, shapes: shapesOf(message.shapes), dust: message.dust };
    const drops = frame.shapes.filter(({ kind }) => kind === DROPLET);
    frame.middles = drops.map(middle);
    // Derivatives of the tension at the points of each droplet.
    let from = 0;
    for (const drop of message.gradients ? drops : []) {
      drop.gradient = message.gradients.subarray(from, from + drop.count);
      from += drop.count;
      for (const value of drop.gradient) this.steepest = Math.max(this.steepest, Math.abs(value));
    }
    // A step back in time, or a state that was moved by hand, does not connect.
    const last = this.frames.at(-1);
    if (last && frame.time <= last.time) this.frames = [];
    this.frames.push(frame);
    if (this.frames.length > 24) this.frames.shift();
    if (this.shown === undefined || this.shown < this.frames[0].time || this.frames.length === 1)
      this.shown = this.frames[0].time;
    let most = 0;
    for (const { points } of drops) for (let k = 2; k < points.length; k += 3) if (points[k] > most) most = points[k];
    const unit = this.about?.concentration ?? (most || 1);
    const wanted = Math.max(1.5, Math.ceil((2 * most) / unit) / 2);
    this.top = this.top && wanted < this.top && wanted > 0.6 * this.top ? this.top : wanted;
    this.unit = unit;
    if (message.flow) {
      this.flow = { list: message.flow, streamlines: message.streamlines };
      this.flowChanged = true;
    }
    frame.middles.forEach(([x, y], k) => {
      const trail = (this.trails[k] ??= []);
      const end = trail.at(-1);
      if (!end || (end[0] - x) ** 2 + (end[1] - y) ** 2 > 0.0016) trail.push([x, y]);
      if (trail.length > 700) trail.shift();
    });
  }

  /** Lets the shown time follow that of the run, at a pace (time a second); true while there is more to show. */
  follow(seconds, pace) {
    const [first, last] = [this.frames[0], this.frames.at(-1)];
    if (!last) return false;
    if (!Number.isFinite(pace)) this.shown = last.time;
    else {
      // Keeps some way behind the newest state, so that there is one ahead.
      const behind = last.time - this.shown;
      const speed = pace * (behind > 0.25 * pace ? 1.25 : behind < 0.08 * pace ? 0.85 : 1);
      this.shown = Math.min(Math.max(this.shown + seconds * speed, first.time), last.time);
    }
    while (this.frames.length > 2 && this.frames[1].time <= this.shown) this.frames.shift();
    return this.shown < last.time;
  }

  catchUp() {
    const last = this.frames.at(-1);
    if (!last) return;
    this.frames = [last];
    this.shown = last.time;
  }

  state() {
    const [a, b] = this.frames;
    if (!b) return a;
    const part = (this.shown - a.time) / (b.time - a.time);
    return { ...b, time: this.shown, shapes: between(a.shapes, b.shapes, Math.min(Math.max(part, 0), 1)) };
  }

  /** Distance of two droplets, the nearest images of them (length); not a number for other counts. */
  gap() {
    const frame = this.frames.at(-1);
    if (frame?.middles.length !== 2) return NaN;
    if (frame.gap === undefined) {
      const [a, b] = frame.shapes.filter(({ kind }) => kind === DROPLET);
      const [x, y] = [0, 1].map((axis) => {
        const [period, way] = [this.about.periods[axis], frame.middles[1][axis] - frame.middles[0][axis]];
        return period ? period * Math.round(way / period) : 0;
      });
      let least = Infinity;
      for (let j = 0; j < a.points.length; j += 3)
        for (let k = 0; k < b.points.length; k += 3)
          least = Math.min(
            least,
            (b.points[k] - x - a.points[j]) ** 2 + (b.points[k + 1] - y - a.points[j + 1]) ** 2,
          );
      frame.gap = Math.sqrt(least);
    }
    return frame.gap;
  }

  /** Middle of the picture and its extent (length) before the camera moves. */
  extent(state) {
    const { periods, walls, origin } = this.about;
    const drops = state.shapes.filter(({ kind }) => kind === DROPLET);
    let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const { points } of drops.length ? drops : state.shapes) {
      for (let k = 0; k < points.length; k += 3) {
        left = Math.min(left, points[k]);
        right = Math.max(right, points[k]);
        low = Math.min(low, points[k + 1]);
        high = Math.max(high, points[k + 1]);
      }
    }
    if (left > right) [left, right, low, high] = [-1, 1, -1, 1];
    const size = [
      periods[0] ?? right - left + 4.2,
      periods[1] ?? (walls ? walls[1] - walls[0] + 0.5 : high - low + 4.2),
    ];
    const target = [
      periods[0] ? origin[0] + 0.5 * periods[0] : 0.5 * (left + right),
      walls ? 0.5 * (walls[0] + walls[1]) : periods[1] ? origin[1] + 0.5 * periods[1] : 0.5 * (low + high),
    ];
    return { size, target };
  }

  /** Rectangle that the canvas shows (length). */
  rectangle(state = this.state()) {
    const [width, height] = [this.canvas.clientWidth || 1, this.canvas.clientHeight || 1];
    const { size, target } = this.extent(state);
    this.centre ??= target;
    const scale = Math.min(width / size[0], height / size[1]) * this.camera.zoom;
    const [x, y] = [this.centre[0] + this.camera.x, this.centre[1] + this.camera.y];
    return {
      left: x - width / 2 / scale,
      right: x + width / 2 / scale,
      low: y - height / 2 / scale,
      high: y + height / 2 / scale,
      scale,
    };
  }

  /** Place (length) under a point of the canvas (pixels). */
  place(x, y) {
    const view = this.rectangle();
    return [view.left + x / view.scale, view.high - y / view.scale];
  }

  /** Shifts by periods for which a box from low to high (length) is seen. */
  shifts([left, low], [right, high], view, tilt = 0) {
    const [px, py] = this.about.periods;
    const list = [];
    const range = (period, from, to, a, b) =>
      period ? [Math.ceil((a - to) / period), Math.floor((b - from) / period)] : [0, 0];
    const [j0, j1] = range(py, low, high, view.low, view.high);
    for (let j = j0; j <= j1; j += 1) {
      const aside = j * tilt;
      const [i0, i1] = range(px, left + aside, right + aside, view.left, view.right);
      for (let i = i0; i <= i1; i += 1) list.push([i * (px ?? 0) + aside, j * (py ?? 0)]);
    }
    return list;
  }

  /** Lets the middle follow the droplets, unless one is held; true while it has some way to go. */
  followTarget(state) {
    if (this.held || !this.centre) return false;
    const { target } = this.extent(state);
    const way = [target[0] - this.centre[0], target[1] - this.centre[1]];
    this.centre = [this.centre[0] + 0.15 * way[0], this.centre[1] + 0.15 * way[1]];
    return Math.hypot(...way) > 0.01;
  }

  /** Draws the state at the shown time; true where the view is still on its way. */
  draw() {
    const { canvas, context } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    const state = this.state();
    if (!state || !this.about) return false;
    const going = this.followTarget(state);
    const view = this.rectangle(state);
    this.view = view;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = this.colours.fluid;
    context.fillRect(0, 0, width, height);
    const scale = view.scale * ratio;
    context.setTransform(scale, 0, 0, -scale, -view.left * scale, view.high * scale);
    context.lineJoin = context.lineCap = "round";
    const pixel = 1 / view.scale;
    if (this.look.pressure) this.drawPressure(view, state);
    if (this.look.streamlines) this.drawStreamlines(view, pixel);
    if (this.look.tracers && state.dust) this.drawDust(state.dust, view, pixel);
    if (this.look.trail) this.drawTrails(view, pixel, state);
    this.drawBounds(view, pixel);
    this.drawShapes(state, view, pixel);
    this.drawScaleBar(view, pixel);
    return going;
  }

  drawPressure(view, state) {
    if (!this.flow) return;
    const [x, y, width, height, nx, ny] = this.flow.list;
    const tile = this.tile;
    if (this.flowChanged) {
      this.flowChanged = false;
      [tile.width, tile.height] = [nx, ny];
      const values = this.flow.list.subarray(6, 6 + nx * ny);
      const sorted = Float32Array.from(values).sort();
      const mean = sorted[Math.floor(sorted.length / 2)];
      const most =
        Math.max(
          Math.abs(sorted[Math.floor(0.97 * (sorted.length - 1))] - mean),
          Math.abs(sorted[Math.floor(0.03 * sorted.length)] - mean),
        ) || 1;
      this.range = most;
      const context = tile.getContext("2d");
      const image = context.createImageData(nx, ny);
      for (let j = 0; j < ny; j += 1) {
        for (let i = 0; i < nx; i += 1) {
          const colour = pressure((values[j * nx + i] - mean) / most, this.name);
          image.data.set([...colour, 235], 4 * ((ny - 1 - j) * nx + i));
        }
      }
      context.putImageData(image, 0, 0);
    }
    const { context } = this;
    for (const [dx, dy] of this.shifts([x, y], [x + width, y + height], view, state.tilt)) {
      context.save();
      context.translate(x + dx, y + dy + height);
      context.scale(1, -1);
      context.imageSmoothingEnabled = true;
      context.drawImage(tile, 0, 0, nx, ny, 0, 0, width, height);
      context.restore();
    }
  }

  drawStreamlines(view, pixel) {
    if (!this.flow?.streamlines) return;
    const [x, y, width, height, nx, ny] = this.flow.list;
    const lines = this.flow.list.subarray(6 + nx * ny);
    const { context } = this;
    context.strokeStyle = `rgba(${this.rgb.dust},.42)`;
    context.lineWidth = 1.2 * pixel;
    context.beginPath();
    for (const [dx, dy] of this.shifts([x, y], [x + width, y + height], view)) {
      for (let at = 0; at < lines.length; at += 1 + 2 * lines[at]) {
        for (let k = 0; k < lines[at]; k += 1) {
          const [px, py] = [lines[at + 1 + 2 * k] + dx, lines[at + 2 + 2 * k] + dy];
          if (k === 0) context.moveTo(px, py);
          else context.lineTo(px, py);
        }
      }
    }
    context.stroke();
  }

  drawDust(dust, view, pixel) {
    const { context } = this;
    // Streaks are as long as a tracer goes in a while, but not longer than some pixels.
    const streak = 0.9;
    const longest = 22 * pixel;
    context.lineWidth = 1.5 * pixel;
    for (const [strength, faint] of [
      [0.5, 0],
      [0.26, 1],
    ]) {
      context.strokeStyle = `rgba(${this.rgb.dust},${strength})`;
      context.beginPath();
      for (let k = 0; k < dust.length; k += 4) {
        if ((k / 4) % 2 !== faint) continue;
        const [x, y, u, v] = [dust[k], dust[k + 1], dust[k + 2], dust[k + 3]];
        const length = Math.hypot(u, v) * streak;
        const part = length > longest ? longest / length : 1;
        context.moveTo(x - u * streak * part, y - v * streak * part);
        context.lineTo(x + 0.02 * pixel, y);
      }
      context.stroke();
    }
  }

  drawTrails(view, pixel, state) {
    const { context } = this;
    this.trails.forEach((trail, number) => {
      const end = state.middles[number];
      if (!end || trail.length < 2) return;
      let [low, high] = [[...trail[0]], [...trail[0]]];
      for (const [x, y] of trail) {
        low = [Math.min(low[0], x), Math.min(low[1], y)];
        high = [Math.max(high[0], x), Math.max(high[1], y)];
      }
      for (const [dx, dy] of this.shifts(low, high, view)) {
        const parts = 6;
        for (let part = 0; part < parts; part += 1) {
          const from = Math.floor((part * (trail.length - 1)) / parts);
          const to = Math.floor(((part + 1) * (trail.length - 1)) / parts);
          context.strokeStyle = `rgba(${this.rgb.drop},${(0.1 + 0.5 * ((part + 1) / parts)).toFixed(2)})`;
          context.lineWidth = 2 * pixel;
          context.setLineDash([0.1 * pixel, 5 * pixel]);
          context.beginPath();
          for (let k = from; k <= to; k += 1) context.lineTo(trail[k][0] + dx, trail[k][1] + dy);
          context.stroke();
        }
      }
    });
    context.setLineDash([]);
  }

  drawBounds(view, pixel) {
    const { context } = this;
    const { walls, periods, origin } = this.about;
    if (walls) {
      context.fillStyle = this.colours.wall;
      context.fillRect(view.left, walls[1], view.right - view.left, Math.max(view.high - walls[1], 0));
      context.fillRect(view.left, view.low, view.right - view.left, Math.max(walls[0] - view.low, 0));
    }
    context.strokeStyle = this.colours.soft;
    context.lineWidth = pixel;
    context.globalAlpha = 0.4;
    context.setLineDash([5 * pixel, 5 * pixel]);
    const [width, height] = [periods[0], periods[1] ?? (walls ? walls[1] - walls[0] : null)];
    if (width && periods[1]) context.strokeRect(origin[0], origin[1], width, height);
    else if (width) {
      context.beginPath();
      for (const x of [origin[0], origin[0] + width]) {
        context.moveTo(x, walls ? walls[0] : view.low);
        context.lineTo(x, walls ? walls[1] : view.high);
      }
      context.stroke();
    }
    context.setLineDash([]);
    context.globalAlpha = 1;
  }

  trace({ points, count }, open = false) {
    const { context } = this;
    for (let k = 0; k < count; k += 1) {
      if (k === 0) context.moveTo(points[0], points[1]);
      else context.lineTo(points[3 * k], points[3 * k + 1]);
    }
    if (!open) context.closePath();
  }

  drawShapes(state, view, pixel) {
    const { context } = this;
    const thick = Math.max(0.085, 2.6 * pixel);
    let droplets = 0;
    for (let number = 0; number < state.shapes.length; number += 1) {
      const shape = state.shapes[number];
      if (shape.kind === HOLE) continue;
      if (shape.kind === DROPLET) droplets += 1;
      let [low, high] = [
        [Infinity, Infinity],
        [-Infinity, -Infinity],
      ];
      for (let k = 0; k < shape.points.length; k += 3) {
        low = [Math.min(low[0], shape.points[k]), Math.min(low[1], shape.points[k + 1])];
        high = [Math.max(high[0], shape.points[k]), Math.max(high[1], shape.points[k + 1])];
      }
      for (const [dx, dy] of this.shifts(low, high, view, state.tilt)) {
        context.save();
        context.translate(dx, dy);
        if (shape.kind === AREA) {
          context.beginPath();
          this.trace(shape);
          for (let next = number + 1; state.shapes[next]?.kind === HOLE; next += 1) this.trace(state.shapes[next]);
          context.fillStyle = this.colours.wall;
          context.fill("evenodd");
          context.strokeStyle = this.colours.soft;
          context.lineWidth = 1.3 * pixel;
          context.stroke();
        } else if (shape.kind === DROPLET) {
          this.drawDroplet(shape, low, high, thick);
          if (state.middles.length > 1) this.write(droplets, middle(shape), pixel);
        }
        else if (shape.kind === OPEN) this.drawCarrier(shape, thick, true);
        else {
          context.beginPath();
          this.trace(shape, true);
          context.strokeStyle = this.colours.soft;
          context.lineWidth = 1.3 * pixel;
          context.stroke();
        }
        context.restore();
      }
    }
  }

  drawDroplet(shape, low, high, thick) {
    const { context } = this;
    const [x, y] = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
    const radius = 0.5 * Math.max(high[0] - low[0], high[1] - low[1]);
    const inside = context.createRadialGradient(
      x - 0.3 * radius,
      y + 0.35 * radius,
      0.1 * radius,
      x,
      y,
      1.1 * radius,
    );
    inside.addColorStop(0, `rgba(${this.rgb.drop},.10)`);
    inside.addColorStop(1, `rgba(${this.rgb.drop},.30)`);
    context.beginPath();
    this.trace(shape);
    context.fillStyle = inside;
    context.fill();
    this.drawCarrier(shape, thick, false);
    if (this.look.arrows && shape.gradient) this.drawArrows(shape);
  }

  /** The pull of the interface on the fluid along it: arrows outside of it, towards higher tension. */
  drawArrows({ points, count, gradient }) {
    const { context } = this;
    const at = (k) => [points[3 * ((k + count) % count)], points[3 * ((k + count) % count) + 1]];
    context.strokeStyle = context.fillStyle = this.colours.ink;
    context.lineWidth = 0.035;
    for (let arrow = 0; arrow < ARROWS; arrow += 1) {
      const k = Math.floor((arrow * count) / ARROWS);
      const part = gradient[k] / (this.steepest || 1);
      if (Math.abs(part) < 0.02) continue;
      const [[ax, ay], [bx, by], [x, y]] = [at(k - 1), at(k + 1), at(k)];
      const size = Math.hypot(bx - ax, by - ay) || 1;
      const [tx, ty] = [(bx - ax) / size, (by - ay) / size];
      // Lengths grow as the square root, so that weak pulls are seen too.
      const length = Math.sign(part) * (0.1 + 0.24 * Math.sqrt(Math.abs(part)));
      const head = 0.11 * Math.sign(part);
      const [px, py] = [x + 0.13 * ty - 0.5 * length * tx, y - 0.13 * tx - 0.5 * length * ty];
      const [qx, qy] = [px + length * tx, py + length * ty];
      context.beginPath();
      context.moveTo(px, py);
      context.lineTo(qx - 0.7 * head * tx, qy - 0.7 * head * ty);
      context.stroke();
      context.beginPath();
      context.moveTo(qx, qy);
      for (const side of [-1, 1])
        context.lineTo(qx - head * tx + 0.5 * side * head * ty, qy - head * ty - 0.5 * side * head * tx);
      context.fill();
    }
  }

  /** A bar of a round length in micrometres, at the lower left. */
  drawScaleBar(view, pixel) {
    const unit = this.about.units.length;
    const most = 0.25 * (view.right - view.left) * unit;
    const power = 10 ** Math.floor(Math.log10(most));
    const size = [5, 2, 1].find((step) => step * power <= most) * power;
    const { context } = this;
    const [x, y] = [view.left + 14 * pixel, view.low + 14 * pixel];
    context.strokeStyle = context.fillStyle = this.colours.ink;
    context.lineWidth = 2.5 * pixel;
    context.lineCap = "butt";
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + size / unit, y);
    context.stroke();
    this.write(`${size} µm`, [x, y + 6 * pixel], pixel);
  }

  /** Words from a place on. */
  write(words, [x, y], pixel) {
    const { context } = this;
    context.save();
    context.translate(x, y);
    context.scale(pixel, -pixel);
    context.fillStyle = this.colours.ink;
    context.font = "12px system-ui, sans-serif";
    context.fillText(words, 0, 0);
    context.restore();
  }

  /** The interface, coloured by its particles: neighbours of one colour are one line. */
  drawCarrier({ points, count }, thick, open) {
    const { context } = this;
    context.lineWidth = thick;
    const level = (k) => {
      const c = points[3 * k + 2];
      return Number.isNaN(c) ? -1 : Math.min(Math.floor((c / this.unit / this.top) * LEVELS), LEVELS - 1);
    };
    const end = open ? count - 1 : count;
    let start = 0;
    while (start < end) {
      const colour = level(start);
      context.beginPath();
      context.moveTo(points[3 * start], points[3 * start + 1]);
      let k = start;
      do {
        k += 1;
        context.lineTo(points[3 * (k % count)], points[3 * (k % count) + 1]);
      } while (k < end && level(k) === colour);
      context.strokeStyle = colour < 0 ? `rgba(${this.rgb.drop},1)` : this.scale[colour];
      context.stroke();
      start = k;
    }
  }

  /** Scales of the particles and of the pressure. */
  drawScales(canvases) {
    canvases.forEach((canvas, pressures) => {
      const context = canvas.getContext("2d");
      for (let x = 0; x < canvas.width; x += 1) {
        const part = x / (canvas.width - 1);
        context.fillStyle = rgb(pressures ? pressure(2 * part - 1, this.name) : particles(part, this.name));
        context.fillRect(x, 0, 1, canvas.height);
      }
    });
  }
}
