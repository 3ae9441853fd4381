// The page: buttons, sliders, drag and drop of droplets, links and downloads around a simulation in a worker.
import { Picture } from "./draw.js";
import { ActivityMap, Plots, clock, short } from "./plots.js";
import { doubt, plain } from "./problem.js";
import { packed, unpacked } from "./link.js";

const $ = (id) => document.getElementById(id);
const worker = new Worker("worker.js", { type: "module" });
const picture = new Picture($("canvas"));
const plots = new Plots($("plots"), $("more"));
const map = new ActivityMap($("map"));

let about = null;
// Numbers of the newest scene that was asked for, and of the one that the worker has; the presets that they are.
let number = 0;
let loaded = 0;
let preset = null;
let before = null;
// The request for a scene that the worker is at, and the newest one after it.
let begun = null;
let queued = null;
let presets = [];
let playing = false;
let droplets = 0;
let last = null;
let touched = 0;
let changed = true;
let scene = "";
let asked = 0;
const answers = new Map();

function send(message) {
  worker.postMessage({ ...message, number });
}

/** Asks for a scene. One at a time is begun, and after it the newest. */
function request(message) {
  number += 1;
  queued = { ...message, id: number };
  // What is still on its way to the scene before is not for this one.
  if (turning) turning.next = null;
  if (moving) moving = { x: 0, y: 0 };
  drag = null;
  $("knobs").inert = true;
  $("view").classList.add("stale");
  if (!begun) begin();
}

function begin() {
  begun = queued;
  queued = null;
  if (begun) worker.postMessage(begun);
}

/** Answer of the worker to a question. */
function ask(message) {
  asked += 1;
  const id = `q${asked}`;
  const promise = new Promise((resolve, reject) => answers.set(id, { resolve, reject }));
  send({ ...message, id });
  return promise;
}

let noteTimer = 0;
function note(text, bad = false) {
  clearTimeout(noteTimer);
  $("note").textContent = text;
  $("note").classList.toggle("bad", bad);
  if (text && !bad) noteTimer = setTimeout(() => note(""), 3500);
}

/** Questions about the scenes, with their answers. */
const lessons = fetch("lessons.json").then((found) => found.json());
async function showLesson() {
  const lesson = (await lessons)[preset];
  $("lesson").hidden = !lesson;
  $("answer").hidden = true;
  $("reveal").setAttribute("aria-expanded", "false");
  $("reveal").textContent = "Show the answer";
  if (lesson) [$("question").textContent, $("answer").textContent] = [lesson.question, lesson.answer];
}
$("reveal").addEventListener("click", () => {
  const shown = $("answer").hidden;
  $("answer").hidden = !shown;
  $("reveal").setAttribute("aria-expanded", String(shown));
  $("reveal").textContent = shown ? "Hide the answer" : "Show the answer";
});

// ---------------------------------------------------------------------------------------------------- scenes

function setPreset(name) {
  preset = name;
  showLesson();
  for (const button of $("presets").children)
    button.setAttribute("aria-pressed", String(button.dataset.name === name));
}

function load(text, { name = null, play = false } = {}) {
  setPreset(name);
  wanted = { play, text };
  document.documentElement.dataset.steps = "0";
  note("");
  $("problem").textContent = "";
  setPlaying(false);
  request({ kind: "load", scene: text, name });
}
let wanted = { play: false, text: "" };

function showPresets() {
  presets.forEach(({ name, title, about: words }, k) => {
    const button = document.createElement("button");
    button.type = "button";
    button.dataset.name = name;
    button.title = `${words} (${k + 1})`;
    button.setAttribute("aria-pressed", "false");
    const image = document.createElement("img");
    image.src = `thumbnails/${name}.webp`;
    image.alt = "";
    image.width = 144;
    image.height = 96;
    button.append(image, title);
    button.addEventListener("click", () => choose(name));
    $("presets").append(button);
  });
}

function choose(name) {
  const found = presets.find((one) => one.name === name) ?? presets[0];
  history.replaceState(null, "", location.pathname + location.search);
  load(found.scene, { name: found.name, play: true });
}

async function fromAddress() {
  let problem = "";
  const named = /[#&]p=([a-z]+)/.exec(location.hash)?.[1];
  const found = presets.find((one) => one.name === named);
  try {
    const text = await unpacked(location.hash);
    if (text !== null) {
      load(text, { name: found?.name, play: true });
      return;
    }
  } catch {
    problem = "The link is not complete: it holds no scene. Ask for it again, or copy it as a whole.";
  }
  const known = found || location.hash.length < 2 || $(location.hash.slice(1));
  // A link within the page leaves the scene as it is.
  if (about && known && !found && !problem) return;
  if (!problem && !known) problem = "The link names no scene that this page has: this is the first of its scenes.";
  const shown = found ?? presets[0];
  load(shown.scene, { name: shown.name, play: true });
  if (problem) note(problem, true);
}

const knobs = new Map();

function showAbout(message) {
  const fresh = message.number !== picture.number;
  about = message.about;
  plots.units = about.units;
  $("knobs").inert = false;
  map.unit = about.units.length / about.units.time;
  scene = message.scene;
  if (fresh) {
    picture.begin(about);
    picture.number = message.number;
    plots.begin();
    touched = 0;
    $("scene").value = wanted.text.trimEnd() + "\n";
  } else {
    picture.about = about;
    const { typed, box, kept } = message;
    if (box && box !== typed && $("scene").value === typed) $("scene").value = box;
    $("problem").textContent = kept ? plain(kept) : "";
    if (kept) note("The slider acts on the droplets, but not on your text below, which has a mistake.", true);
    else note("");
  }
  showKnobs();
  showCode();
  $("quality").textContent =
    about.error === null
      ? "We have not measured the error of these settings for a scene like this one."
      : `With these settings, the speed of a steady swimmer has an error of at most ${(100 * about.error).toPrecision(1)} %.`;
  followBranch();
  changed = true;
}

function showKnobs() {
  const box = $("knobs");
  const names = about.knobs.map((knob) => knob.name).join();
  if (box.dataset.names !== names) {
    box.replaceChildren();
    knobs.clear();
    box.dataset.names = names;
    for (const { name } of about.knobs) {
      const row = document.createElement("div");
      row.className = "knob";
      const label = document.createElement("label");
      label.htmlFor = `knob-${name}`;
      const output = document.createElement("output");
      output.htmlFor = `knob-${name}`;
      const input = document.createElement("input");
      Object.assign(input, { type: "range", id: `knob-${name}`, step: 1 });
      row.append(label, output, input);
      box.append(row);
      input.addEventListener("input", () => turn(name, fromSlider(knobs.get(name).knob, Number(input.value))));
      knobs.set(name, { label, output, input, knob: null });
    }
  }
  for (const knob of about.knobs) {
    const row = knobs.get(knob.name);
    row.knob = knob;
    row.label.textContent = knob.label;
    const { least, most, step } = knob;
    row.input.min = step ? Math.ceil(least / step - 1e-6) : 0;
    row.input.max = step ? Math.floor(most / step + 1e-6) : 1000;
    if (!row.busy) row.input.value = toSlider(knob, knob.value);
    showValue(row, row.busy ? fromSlider(knob, Number(row.input.value)) : knob.value);
  }
}

/** A number without zeros at its end. */
const brief = (value) =>
  short(value)
    .replace(/(\.\d*?)0+$/, "$1")
    .replace(/\.$/, "");

/** A value of a parameter in the units of a cell; nothing for ratios. */
function inUnits(name, value) {
  const { length, time, activity } = about.units;
  const [factor, unit] =
    {
      activity: [activity, "pN"],
      diffusion: [length ** 2 / time, "µm²/s"],
      size: [length, "µm"],
    }[name] ?? [];
  return unit ? `${brief(factor * value)} ${unit}` : "";
}

function showValue(row, value) {
  const units = document.createElement("small");
  units.textContent = inUnits(row.knob.name, value);
  row.output.replaceChildren(brief(value), " ", units);
  row.input.setAttribute("aria-valuetext", row.output.textContent.trim());
}

/** Steps of a value, or thousandths of a logarithmic scale. */
function toSlider({ least, most, step }, value) {
  return Math.round(step ? value / step : (1000 * Math.log(value / least)) / Math.log(most / least));
}

function fromSlider({ least, most, step }, at) {
  return Number((step ? at * step : least * (most / least) ** (at / 1000)).toPrecision(3));
}

let turning = null;
function turn(name, value) {
  const row = knobs.get(name);
  if (!row) return;
  row.busy = true;
  clearTimeout(row.timer);
  row.timer = setTimeout(() => {
    row.busy = false;
  }, 300);
  showValue(row, value);
  // Of many values on the way one at a time is taken.
  if (turning) {
    turning.next = [name, value];
    return;
  }
  turning = { next: null };
  send({ kind: "turn", knob: name, value, typed: $("scene").value });
  setTimeout(() => {
    const next = turning?.next;
    turning = null;
    if (next) turn(...next);
  }, 60);
}

// ---------------------------------------------------------------------------------------------------- run

const ICONS = { play: "M5 3l12 7-12 7z", pause: "M4 3h4.500v14h-4.500zM11.500 3h4.500v14h-4.500z" };

function setPlaying(value) {
  playing = value;
  $("play").setAttribute("aria-label", value ? "Pause" : "Play");
  $("play")
    .querySelector("path")
    .setAttribute("d", value ? ICONS.pause : ICONS.play);
  if (!value) $("rate").textContent = "";
}

function play() {
  note("");
  setPlaying(!playing);
  if (begun) wanted.play = playing;
  send({ kind: playing ? "play" : "pause" });
  if (!playing) picture.catchUp();
  changed = true;
}

function step() {
  setPlaying(false);
  send({ kind: "step" });
}

function reset() {
  setPlaying(false);
  wanted.play = false;
  // A scene that is about to begin does so at its start.
  if (!about || begun) return;
  wanted.text = $("scene").value;
  request({ kind: "reset", name: preset });
}

function pace() {
  return Number($("pace").value);
}

function take(message) {
  last = message;
  $("view").classList.remove("stale");
  droplets = message.shapes ? countDroplets(message) : droplets;
  picture.add(message);
  plots.add(message.series, droplets, message.all);
  if (!playing) picture.catchUp();
  map.here = { activity: about?.activity, speed: plots.last(0, 0) };
  changed = true;
  if (!firstFrame) {
    firstFrame = performance.now();
    document.documentElement.dataset.first = String(Math.round(firstFrame));
    $("loading").hidden = true;
  }
  document.documentElement.dataset.steps = String(message.steps);
  send({ kind: "shown" });
}
let firstFrame = 0;

function countDroplets(message) {
  let count = 0;
  for (let at = 0; at < message.shapes.length; at += 2 + 3 * message.shapes[at + 1])
    if (message.shapes[at] === 0) count += 1;
  return count;
}

function showRun() {
  const state = picture.state();
  if (!state) return;
  $("time").textContent = `t = ${state.time.toFixed(2)}`;
  $("seconds").textContent = `(${clock(state.time * about.units.time)})`;
  const rate = $("rate");
  if (playing && last?.rate) {
    const slow = Number.isFinite(pace()) && last.pace > 0 && last.pace < 0.85 * pace();
    rate.textContent =
      `${Math.round(last.rate)} steps per second` +
      (slow ? `; this device manages ${(last.pace * about.units.time).toFixed(0)}× real` : "");
  }
}

worker.onmessage = ({ data }) => {
  if (data.kind === "ready") {
    presets = data.presets;
    showPresets();
    sendLook();
    fromAddress();
    return;
  }
  if (data.kind === "answer") {
    answers.get(data.id)?.resolve(data.answer);
    answers.delete(data.id);
    return;
  }
  if (data.kind === "error") {
    complain(data);
    return;
  }
  if (data.kind === "about" && data.number === begun?.id) {
    loaded = data.number;
    before = begun.name;
    begin();
  }
  if (data.number !== number) {
    if (data.kind === "frame") send({ kind: "shown" });
    return;
  }
  if (data.kind === "about") {
    showAbout(data);
    if (wanted.play) {
      wanted.play = false;
      setPlaying(true);
      send({ kind: "play" });
    }
  } else if (data.kind === "grabbed") grabbed(data.droplet);
  else if (data.kind === "frame") take(data);
  else if (data.kind === "ended") {
    setPlaying(false);
    note(
      `The run has reached t = ${data.time.toFixed(2)} (${clock(data.time * about.units.time)}).` +
        (until ? " To continue, clear “Stop at t”, or give a later time." : ""),
    );
  }
};

function loadingFailed() {
  $("loading").hidden = false;
  $("loading").firstElementChild.textContent =
    "The page could not load its program (motile_bg.wasm). Check the connection, then load the page again. " +
    "The page needs a browser from 2023 or later.";
}
worker.onerror = loadingFailed;

function complain({ error, place, id, number: of }) {
  if (answers.has(id)) {
    answers.get(id).reject(new Error(error.message));
    answers.delete(id);
    return;
  }
  if (id && id === begun?.id) {
    begin();
    if (begun) return;
    // The scene before is still there.
    number = loaded;
    setPreset(before);
    if (loaded && picture.number !== loaded) send({ kind: "tell" });
    $("knobs").inert = false;
    $("view").classList.remove("stale");
    // That of a link is not in the box yet.
    $("scene").value = wanted.text;
    $("problem").textContent = plain(error);
    note("This scene cannot run. The text box below says why and what to do.", true);
    $("loading").hidden = true;
  } else if (of !== number && place !== "init") {
    // It is about a scene that has gone.
  } else if (place === "drag") note("There is no room for the droplet there: it would overlap a wall or another body.");
  else if (place === "turn") {
    note(plain(error), true);
    for (const row of knobs.values()) row.busy = false;
    if (about) showKnobs();
  } else if (place === "init") loadingFailed();
  else {
    setPlaying(false);
    note(plain(error, place === "run" || place === "step", droplets), true);
  }
}

// ---------------------------------------------------------------------------------------------------- pictures

let drawnAt = performance.now();
let sentView = "";
function tick(now) {
  const seconds = Math.min((now - drawnAt) / 1000, 0.1);
  drawnAt = now;
  if (playing && picture.follow(seconds, last?.pace > 0 ? Math.min(pace(), 1.05 * last.pace) : pace()))
    changed = true;
  if (about && picture.frames.length && changed && !document.hidden) {
    changed = false;
    if (picture.draw()) changed = true;
    showRun();
    plots.draw();
    if (about.map) map.draw();
    $("scale-top").textContent = picture.top ? `${picture.top}× mean` : "";
    const pressures = brief(Number((about.units.pressure * picture.range).toPrecision(2)));
    $("legend").classList.toggle("pressure", picture.look.pressure && pressures !== "–");
    $("low").textContent = `pressure −${pressures}`;
    $("high").textContent = `${pressures} Pa`;
    const gap = picture.gap();
    $("gap").hidden = Number.isNaN(gap);
    const value = document.createElement("b");
    value.textContent = `${short(gap)} (${short(gap * about.units.length)} µm)`;
    $("gap").replaceChildren("Gap between 1 and 2", value);
    const view = picture.view;
    if (view) {
      const key = [view.left, view.low, view.right, view.high].map((value) => value.toFixed(2)).join();
      if (key !== sentView) {
        sentView = key;
        send({ kind: "look", look: { view: [view.left, view.low, view.right, view.high] } });
      }
    }
    describe();
  }
  requestAnimationFrame(tick);
}

let later = 0;
let again = false;
async function warn() {
  try {
    const list = JSON.parse(await ask({ kind: "ask", what: "warnings" }));
    const past = list.filter(({ present }) => !present).map(({ until }) => until);
    $("warnings").textContent = list
      .filter(({ present }) => present)
      .map((one) => doubt(one, about.activity, droplets))
      .join("\n");
    $("past").textContent = past.length
      ? `Up to t = ${Math.max(...past).toFixed(1)}, results may have been less accurate.`
      : "";
  } catch {
    // Another scene has come in between.
  }
}

function describe() {
  // At times, and once more after the last change.
  again = later > 0;
  if (again) return;
  later = setTimeout(() => {
    later = 0;
    if (again) changed = true;
  }, 1500);
  warn();
  const speed = plots.told(0, about.units.length / about.units.time);
  const count = droplets === 1 ? "One droplet" : `${droplets} droplets`;
  $("canvas").setAttribute(
    "aria-label",
    `${count} at time ${picture.state().time.toFixed(1)}; speed ${speed} micrometres per second`,
  );
  $("map").setAttribute(
    "aria-label",
    `Steady speeds over the activity; the droplet has activity ${short(about.activity ?? NaN)} and speed ${speed}`,
  );
}

function sendLook() {
  send({ kind: "look", look: { ...picture.look }, fresh: true });
}

for (const button of $("look").querySelectorAll("[data-look]")) {
  button.addEventListener("click", () => {
    const on = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(on));
    picture.look[button.dataset.look] = on;
    if (on && button.dataset.look === "pressure") picture.flowChanged = true;
    sendLook();
    changed = true;
  });
}

function restyle() {
  picture.restyle();
  picture.drawScales([...$("legend").querySelectorAll("canvas")]);
  changed = true;
}
const dark = matchMedia("(prefers-color-scheme: dark)");
function setTheme(name) {
  document.documentElement.dataset.theme = name;
  restyle();
}
setTheme(dark.matches ? "dark" : "light");
dark.addEventListener("change", () => setTheme(dark.matches ? "dark" : "light"));
$("theme").addEventListener("click", () =>
  setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"),
);
new ResizeObserver(() => {
  changed = true;
}).observe($("view"));

// ---------------------------------------------------------------------------------------------------- map

let branchWorker = null;
let branchKey = "";
let branchScene = 0;
function followBranch() {
  $("mapcard").hidden = !about.map;
  if (!about.map) return;
  // The branch does not depend on where along it the droplet is.
  const key = scene
    .split("\n")
    .filter((line) => !/activity|centre|angle|start/.test(line))
    .join("\n");
  if (key === branchKey) return;
  branchKey = key;
  branchScene += 1;
  map.begin();
  clearTimeout(followBranch.timer);
  followBranch.timer = setTimeout(() => {
    branchWorker?.terminate();
    branchWorker = new Worker("branch.js", { type: "module" });
    const id = branchScene;
    branchWorker.onmessage = ({ data }) => {
      if (data.id !== branchScene) return;
      if (data.done) {
        branchWorker.terminate();
        branchWorker = null;
        document.documentElement.dataset.map = String(map.points.flat().length);
      } else map.add(data);
      changed = true;
    };
    branchWorker.postMessage({ scene, id });
  }, 900);
}

$("map").addEventListener("click", (event) => {
  const value = Math.round(20 * map.activity(event.offsetX)) / 20;
  turn("activity", value);
});

// ---------------------------------------------------------------------------------------------------- pointers

const canvas = $("canvas");
const pointers = new Map();
let drag = null;
let pinch = null;

function at(event) {
  const box = canvas.getBoundingClientRect();
  return picture.place(event.clientX - box.left, event.clientY - box.top);
}

canvas.addEventListener("pointerdown", (event) => {
  if (!about) return;
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, [event.clientX, event.clientY]);
  if (pointers.size === 2) {
    drag = null;
    const [a, b] = [...pointers.values()];
    pinch = { distance: Math.hypot(a[0] - b[0], a[1] - b[1]), zoom: picture.camera.zoom };
    return;
  }
  const place = at(event);
  drag = {
    droplet: null,
    place,
    from: [event.clientX, event.clientY],
    camera: { ...picture.camera },
    scale: picture.view.scale,
  };
  canvas.classList.add("holding");
  send({ kind: "grab", x: place[0], y: place[1] });
});

function grabbed(droplet) {
  if (!drag) return;
  drag.droplet = droplet;
  canvas.dataset.held = String(droplet);
  if (droplet >= 0) {
    touched = droplet;
    picture.held = true;
  }
}

let moving = null;
function moveDroplet(droplet, x, y) {
  if (moving) {
    moving.x += x;
    moving.y += y;
    return;
  }
  moving = { x: 0, y: 0 };
  send({ kind: "drag", droplet, x, y });
  setTimeout(() => {
    const rest = moving;
    moving = null;
    if (rest && (rest.x !== 0 || rest.y !== 0)) moveDroplet(droplet, rest.x, rest.y);
  }, 33);
}

canvas.addEventListener("pointermove", (event) => {
  if (!pointers.has(event.pointerId)) return;
  pointers.set(event.pointerId, [event.clientX, event.clientY]);
  if (pinch && pointers.size === 2) {
    const [a, b] = [...pointers.values()];
    zoomTo((pinch.zoom * Math.hypot(a[0] - b[0], a[1] - b[1])) / pinch.distance);
    return;
  }
  if (!drag || drag.droplet === null) return;
  if (drag.droplet >= 0) {
    const place = at(event);
    const [x, y] = [place[0] - drag.place[0], place[1] - drag.place[1]];
    if (Math.hypot(x, y) * drag.scale < 1) return;
    drag.place = place;
    // The picture of an unbounded region goes along.
    moveDroplet(drag.droplet, x, y);
  } else {
    picture.camera.x = drag.camera.x - (event.clientX - drag.from[0]) / drag.scale;
    picture.camera.y = drag.camera.y + (event.clientY - drag.from[1]) / drag.scale;
    changed = true;
  }
});

function release(event) {
  pointers.delete(event.pointerId);
  if (pointers.size < 2) pinch = null;
  drag = null;
  delete canvas.dataset.held;
  picture.held = false;
  changed = true;
  canvas.classList.remove("holding");
}
canvas.addEventListener("pointerup", release);
canvas.addEventListener("pointercancel", release);

function zoomTo(zoom) {
  picture.camera.zoom = Math.min(Math.max(zoom, 0.3), 8);
  changed = true;
}
canvas.addEventListener(
  "wheel",
  (event) => {
    event.preventDefault();
    zoomTo(picture.camera.zoom * 1.0016 ** -event.deltaY);
  },
  { passive: false },
);
canvas.addEventListener("dblclick", () => {
  picture.camera = { x: 0, y: 0, zoom: 1 };
  changed = true;
});

document.addEventListener("keydown", (event) => {
  const field = event.target.closest?.("input, textarea, select, [role=tab]");
  if (event.ctrlKey || event.metaKey || event.altKey || (field && field.type !== "range")) return;
  const onButton = event.target.closest?.("button, a");
  if (event.key === " " && !onButton) play();
  else if (event.key === ".") step();
  else if (event.key === "r" || event.key === "R") reset();
  else if (event.key === "+" || event.key === "=") zoomTo(picture.camera.zoom * 1.25);
  else if (event.key === "-") zoomTo(picture.camera.zoom / 1.25);
  else if (event.key === "f" || event.key === "F") fill();
  else if (/^[1-9]$/.test(event.key) && presets[event.key - 1]) choose(presets[event.key - 1].name);
  else if (event.target === canvas && event.key.startsWith("Arrow")) {
    const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    moveDroplet(touched, 0.1 * x, 0.1 * y);
  } else return;
  event.preventDefault();
});

// ---------------------------------------------------------------------------------------------------- text

/** Fills the screen with the picture and its buttons: the window, in browsers that fill the screen only with films. */
function fill() {
  const on = !$("stage").classList.contains("full");
  filled(on);
  if (on) $("stage").requestFullscreen?.().catch(() => {});
  else if (document.fullscreenElement) document.exitFullscreen();
}
function filled(on) {
  $("stage").classList.toggle("full", on);
  $("full").setAttribute("aria-pressed", String(on));
  // The sliders go along.
  if (on) $("view").after($("knobcard"));
  else document.querySelector("aside").prepend($("knobcard"));
  changed = true;
}
document.addEventListener("fullscreenchange", () => filled(Boolean(document.fullscreenElement)));
$("full").addEventListener("click", fill);
$("play").addEventListener("click", play);
$("step").addEventListener("click", step);
$("reset").addEventListener("click", reset);
$("pace").addEventListener("change", () => send({ kind: "pace", pace: pace() }));
let until = "";
$("until").addEventListener("change", () => {
  const field = $("until");
  const [text, time, now] = [field.value.trim(), Number(field.value), last?.time ?? 0];
  let bad = "";
  if (field.validity.badInput) bad = "Give “Stop at t” as a number.";
  else if (time < 0) bad = "Times begin at 0, so a run cannot stop at a negative one.";
  else if (text && time <= now)
    bad = `The run is at t = ${now.toFixed(2)} already. Give a later time, or press R to restart first.`;
  note(bad, true);
  if (bad) {
    field.value = until;
    return;
  }
  until = text;
  send({ kind: "until", until: text ? time : NaN });
  showCode();
});

/** What a scene consists of: a preset is still the same one while only its values change. */
const parts = (text) =>
  (text.match(/^\s*(\[\[.*?\]\]|\[?region\W+[\w-]+)/gm) ?? []).map((part) => part.replace(/\W/g, "")).join();

$("run").addEventListener("click", () => {
  const text = $("scene").value;
  if (!text.replace(/#.*/g, "").trim()) {
    $("problem").textContent = "There is no scene in the box. Type one, or choose a scene above.";
    return;
  }
  const same = presets.some(({ name, scene }) => name === preset && parts(scene) === parts(text));
  load(text, { name: same ? preset : null, play: true });
});
$("scene").addEventListener("keydown", (event) => {
  if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) $("run").click();
});

let way = "command";
let codeTimer = 0;
function showCode() {
  clearTimeout(codeTimer);
  codeTimer = setTimeout(async () => {
    try {
      $("code").textContent = await ask({ kind: "ask", what: "code", arguments: [way, Number(until) || 20] });
    } catch (error) {
      if (!begun) note(error.message, true);
    }
  }, 120);
}
const tabs = [...$("ways").children];
tabs.forEach((tab, k) => {
  tab.addEventListener("click", () => {
    for (const other of tabs) {
      other.setAttribute("aria-selected", String(other === tab));
      other.tabIndex = other === tab ? 0 : -1;
    }
    $("code").setAttribute("aria-labelledby", tab.id);
    way = tab.dataset.way;
    showCode();
  });
  tab.addEventListener("keydown", (event) => {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by) return;
    const next = tabs[(k + by + tabs.length) % tabs.length];
    next.focus();
    next.click();
  });
});

async function copied(text, words) {
  try {
    await navigator.clipboard.writeText(text);
    note(words);
  } catch {
    note("The browser does not let the page copy: take it from the address line.");
  }
}
$("copy").addEventListener("click", () => copied($("code").textContent, "Copied."));
$("link").addEventListener("click", async () => {
  try {
    const text = await packed(await ask({ kind: "ask", what: "scene" }));
    history.replaceState(null, "", `#${text}${preset ? `&p=${preset}` : ""}`);
    await copied(location.href, "A link with the whole scene is copied.");
  } catch (error) {
    note(error.message, true);
  }
});
addEventListener("hashchange", fromAddress);

// ---------------------------------------------------------------------------------------------------- files

function save(blob, name) {
  const address = URL.createObjectURL(blob);
  const anchor = document.createElement("a");
  Object.assign(anchor, { href: address, download: name });
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

const files = {
  png: () => canvas.toBlob((blob) => save(blob, "motile.png"), "image/png"),
  svg: async () => save(new Blob([await ask({ kind: "ask", what: "svg" })], { type: "image/svg+xml" }), "motile.svg"),
  csv: async () => {
    const name = droplets > 1 ? "droplets.csv" : "trajectory.csv";
    save(new Blob([await ask({ kind: "ask", what: "csv" })], { type: "text/csv" }), name);
  },
};
for (const button of $("look").querySelectorAll("[data-save]")) {
  button.addEventListener("click", async () => {
    try {
      await files[button.dataset.save]();
    } catch (error) {
      note(error.message, true);
    }
  });
}

/** Length of a video (s). */
const FILM = 10;
let recorder = null;
$("film").addEventListener("click", () => {
  if (recorder) {
    recorder.stop();
    return;
  }
  if (!window.MediaRecorder || !canvas.captureStream) {
    note("This browser cannot record videos.", true);
    return;
  }
  const types = ["video/webm;codecs=vp9", "video/webm", "video/mp4"];
  const mimeType = types.find((type) => MediaRecorder.isTypeSupported(type));
  recorder = new MediaRecorder(canvas.captureStream(30), { mimeType, videoBitsPerSecond: 6e6 });
  const parts = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  recorder.onstop = () => {
    recorder = null;
    $("film").setAttribute("aria-pressed", "false");
    $("film").textContent = "Video";
    save(new Blob(parts, { type: mimeType }), mimeType.includes("mp4") ? "motile.mp4" : "motile.webm");
  };
  recorder.start();
  $("film").setAttribute("aria-pressed", "true");
  $("film").textContent = "Stop";
  note(`Records ${FILM} seconds; press again to end earlier.`);
  setTimeout(() => recorder?.stop(), 1000 * FILM);
});

// For tests and for consoles: a run at once, and its numbers.
window.motile = {
  go: (options) => {
    setPlaying(false);
    return ask({ kind: "go", ...options });
  },
  ask: (what, ...list) => ask({ kind: "ask", what, arguments: list }),
  load: (text) => load(text),
  shown: () => ({ preset, droplets, stale: $("view").classList.contains("stale"), text: $("scene").value }),
};
requestAnimationFrame(tick);
