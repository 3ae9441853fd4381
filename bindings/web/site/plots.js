// Plots of observables over time, and the map of speeds over activities.
import { property } from "./colours.js";

function fitted(canvas) {
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.font = "11px system-ui, sans-serif";
  return [context, width, height];
}

/** A round number of about this size. */
function round(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].find((step) => step * power >= value) * power;
}

/** A number at a tick of an axis whose ticks are this far apart. */
function tick(value, step) {
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return (Math.abs(value) < 1e-9 * step ? 0 : value).toFixed(digits).replace("-", "−");
}

/** Size below which a value is round-off. */
const NONE = 1e-9;

export function short(value) {
  if (!Number.isFinite(value)) return "–";
  if (Math.abs(value) < NONE) return "0";
  const size = Math.abs(value);
  const text =
    size !== 0 && size < 0.0095 ? value.toExponential(1) : value.toFixed(size < 1 ? 3 : size < 100 ? 2 : 0);
  return text.replace("-", "−");
}

/** A time in seconds, in words. */
export function clock(seconds) {
  return seconds < 600 ? `${Math.round(seconds)} s` : `${Math.round(seconds / 60)} min`;
}

const KINDS = [
  { title: "Speed", unit: "µm/s", zero: true },
  { title: "Aspect ratio", unit: "along over across", zero: false },
  { title: "Stresslet, xx", unit: "force × length", zero: false },
];

export class Plots {
  /** The last plot is in a box of its own. */
  constructor(box, more) {
    this.rows = [];
    this.units = { length: 1, time: 1 };
    this.plots = KINDS.map((kind, number) => {
      const section = document.createElement("div");
      section.className = "plot";
      const head = document.createElement("h3");
      const name = document.createElement("span");
      name.textContent = kind.zero ? kind.title : `${kind.title} (${kind.unit})`;
      const output = document.createElement("output");
      const canvas = document.createElement("canvas");
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", `${kind.title} over time`);
      head.append(name, output);
      section.append(head, canvas);
      (number === KINDS.length - 1 ? more : box).append(section);
      return { ...kind, output, canvas };
    });
  }

  begin() {
    this.rows = [];
  }

  /** New records: time, then three values of each droplet. */
  add(series, droplets, all) {
    if (all) this.rows = [];
    const width = 1 + 3 * droplets;
    const values = series.map((value) => (Math.abs(value) < NONE ? 0 : value));
    for (let at = 0; at + width <= values.length; at += width) this.rows.push(values.subarray(at, at + width));
    // What is older is in the table for download.
    if (this.rows.length > 6000) this.rows = this.rows.filter((_, k) => k % 2 === 0);
  }

  last(kind, droplet = 0) {
    return this.rows.at(-1)?.[1 + 3 * droplet + kind] ?? NaN;
  }

  /** The last values of all droplets in words: each of two, the mean of more. */
  told(kind, unit = 1) {
    const list = (this.rows.at(-1) ?? []).slice(1).filter((_, k) => k % KINDS.length === kind);
    if (list.length === 2) return [...list].map((value, k) => `${k + 1}: ${short(unit * value)}`).join(", ");
    if (list.length < 2) return short(unit * (list[0] ?? NaN));
    return `mean ${short((unit * list.reduce((sum, value) => sum + value, 0)) / list.length)}`;
  }

  draw() {
    // What is folded away has no width.
    this.plots.forEach((plot, number) => plot.canvas.clientWidth && this.drawOne(plot, number));
  }

  drawOne({ canvas, output, zero }, number) {
    const [context, width, height] = fitted(canvas);
    const { rows } = this;
    const unit = zero ? this.units.length / this.units.time : 1;
    output.textContent = this.told(number, unit) + (zero ? " µm/s" : "");
    if (rows.length === 0) return;
    const droplets = (rows[0].length - 1) / 3;
    const span = Math.max(rows.at(-1)[0], 5);
    const begin = rows[0][0];
    const stride = Math.max(1, Math.floor(rows.length / width));
    let [low, high] = [zero ? 0 : Infinity, -Infinity];
    for (let k = 0; k < rows.length; k += stride) {
      for (let d = 0; d < droplets; d += 1) {
        const value = unit * rows[k][1 + 3 * d + number];
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    if (!(high > low)) [low, high] = Number.isFinite(high) ? [zero ? 0 : low - 0.5, high + 0.5] : [0, 1];
    if (!zero && high - low < 0.002 * Math.abs(high))
      [low, high] = [low - 0.001 * Math.abs(high), high + 0.001 * Math.abs(high)];
    const margin = 0.08 * (high - low);
    if (!zero) low -= margin;
    high += margin;
    const [left, right, top, bottom] = [44, width - 6, 6, height - 16];
    const x = (time) => left + ((time - begin) / (span - begin)) * (right - left);
    const y = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
    context.strokeStyle = property("--line");
    context.fillStyle = property("--soft");
    context.lineWidth = 1;
    const step = round((high - low) / 2.2);
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (let value = Math.ceil(low / step) * step; value <= high; value += step) {
      context.beginPath();
      context.moveTo(left, y(value));
      context.lineTo(right, y(value));
      context.stroke();
      context.fillText(tick(value, step), left - 6, y(value));
    }
    context.textBaseline = "alphabetic";
    context.fillText(`t = ${short(span)} (${clock(span * this.units.time)})`, right, height - 3);
    context.textAlign = "left";
    context.fillText(short(begin).replace(/\.0+$/, ""), left, height - 3);
    context.strokeStyle = property("--accent");
    context.lineJoin = "round";
    for (let d = droplets - 1; d >= 0; d -= 1) {
      context.globalAlpha = d === 0 ? 1 : droplets === 2 ? 0.8 : 0.35;
      context.lineWidth = d === 0 ? 1.8 : 1;
      context.setLineDash(droplets === 2 && d === 1 ? [4, 3] : []);
      context.beginPath();
      for (let k = 0; k < rows.length; k += stride) context.lineTo(x(rows[k][0]), y(unit * rows[k][1 + 3 * d + number]));
      context.stroke();
    }
    context.globalAlpha = 1;
  }
}

export class ActivityMap {
  constructor(canvas) {
    this.canvas = canvas;
    this.unit = 1;
    this.begin();
    this.here = null;
  }

  /** Points of three lines: swimmers to stronger and to weaker activities, droplets at rest. */
  begin() {
    this.points = [[], [], []];
  }

  add({ activity, speed, stable, line }) {
    this.points[line].push({ activity, speed, stable });
  }

  /** Activity at a place of the canvas (pixels). */
  activity(x) {
    const { left, right } = this.frame();
    return Math.min(Math.max(-8 + ((x - left) / (right - left)) * 8, -8), 0);
  }

  frame() {
    return { left: 40, right: this.canvas.clientWidth - 10, top: 8, bottom: this.canvas.clientHeight - 30 };
  }

  draw() {
    const [context, width, height] = fitted(this.canvas);
    const { left, right, top, bottom } = this.frame();
    const [stronger, weaker, rest] = this.points;
    const swimmers = [...stronger.toReversed(), ...weaker];
    const most = Math.max(0.1, ...swimmers.map(({ speed }) => speed), this.here ? this.here.speed : 0) * 1.08;
    const x = (activity) => left + ((activity + 8) / 8) * (right - left);
    const y = (speed) => bottom - (speed / most) * (bottom - top);
    context.strokeStyle = property("--line");
    context.fillStyle = property("--soft");
    context.lineWidth = 1;
    context.textAlign = "center";
    for (let activity = -8; activity <= 0; activity += 2) {
      context.beginPath();
      context.moveTo(x(activity), top);
      context.lineTo(x(activity), bottom);
      context.stroke();
      context.fillText(String(activity).replace("-", "−"), x(activity), bottom + 14);
    }
    context.fillText("activity", 0.5 * (left + right), height - 3);
    context.textAlign = "right";
    const step = round(most / 3);
    for (let speed = 0; speed <= most; speed += step) {
      context.beginPath();
      context.moveTo(left, y(speed));
      context.lineTo(right, y(speed));
      context.stroke();
      context.fillText(tick(speed, step), left - 6, y(speed) + 4);
    }
    context.strokeStyle = context.fillStyle = property("--accent");
    context.lineWidth = 2;
    context.lineJoin = "round";
    for (const line of [swimmers, rest]) {
      for (let k = 1; k < line.length; k += 1) {
        const [a, b] = [line[k - 1], line[k]];
        // Pieces may be shorter than dashes, whose places are told from the axis.
        context.setLineDash(a.stable && b.stable ? [] : [5, 4]);
        context.lineDashOffset = x(a.activity);
        context.beginPath();
        context.moveTo(x(a.activity), y(a.speed));
        context.lineTo(x(b.activity), y(b.speed));
        context.stroke();
      }
    }
    context.setLineDash([]);
    if (this.here && Number.isFinite(this.here.speed) && Number.isFinite(this.here.activity)) {
      context.fillStyle = property("--ink");
      context.strokeStyle = property("--card");
      context.beginPath();
      context.arc(x(this.here.activity), y(this.here.speed), 6, 0, 7);
      context.fill();
      context.stroke();
    }
  }
}
