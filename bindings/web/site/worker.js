// The simulation: a scene of the library in a thread of its own, which answers the page's messages.
import init, { Engine, presets, turned } from "./motile.js";

/** Time that a turn may take before messages are read (ms). */
const TURN = 24;
/** Part of the turns' time for the flow between droplets. */
const FLOW_SHARE = 0.25;
/** Time that the run may be ahead of the picture (s). */
const AHEAD = 0.12;

let engine = null;
let number = 0;
let text = "";
let playing = false;
let waiting = false;
let pace = 3;
let until = NaN;
let started = { at: 0, time: 0 };
let look = { tracers: true, streamlines: false, pressure: false, arrows: false, view: [-3, -3, 3, 3] };
let sent = { records: 0, flow: -Infinity, cost: 0, shapes: -1 };
let meter = { at: 0, steps: 0, time: 0, rate: 0, pace: 0 };

const now = () => performance.now();

function problem(error) {
  try {
    return JSON.parse(typeof error === "string" ? error : "x");
  } catch {
    return { message: String(error?.message ?? error) };
  }
}

function rebase() {
  started = { at: now(), time: engine ? engine.time() : 0 };
  meter = { ...meter, at: now(), steps: engine ? engine.steps() : 0, time: started.time };
}

function load(scene, id) {
  const made = new Engine(scene);
  engine?.free();
  [engine, text, number] = [made, scene, id];
  sent = { records: 0, flow: -Infinity, cost: 0, shapes: -1 };
  meter = { at: now(), steps: 0, time: 0, rate: 0, pace: 0 };
  rebase();
  tell();
  frame(true);
}

/** What does not change from step to step; a slider adds what becomes of the text that the reader typed. */
function tell(text = {}) {
  postMessage({ kind: "about", number, about: JSON.parse(engine.about()), scene: engine.scene(), ...text });
}

/** The present state. */
function frame(fresh) {
  const message = {
    kind: "frame",
    number,
    time: engine.time(),
    steps: engine.steps(),
    tilt: engine.tilt(),
    rate: meter.rate,
    pace: meter.pace,
    playing,
    shapes: engine.shapes(),
  };
  const lists = [message.shapes.buffer];
  if (look.arrows) {
    message.gradients = engine.tension_gradients();
    lists.push(message.gradients.buffer);
  }
  const wanted = look.tracers || look.streamlines || look.pressure;
  const began = now();
  if (wanted && (fresh || (engine.time() !== sent.time && sent.cost < FLOW_SHARE * (began - sent.flow)))) {
    const flow = engine.flow(look.streamlines);
    sent.flow = now();
    sent.cost = sent.flow - began;
    sent.time = engine.time();
    message.flow = flow;
    message.streamlines = look.streamlines;
    lists.push(flow.buffer);
  }
  if (look.tracers) {
    message.dust = engine.drift(...look.view);
    lists.push(message.dust.buffer);
  }
  const records = engine.records();
  // The table is thinned out when it is long: then all of it is new.
  if (records < sent.records) message.all = true;
  message.series = engine.series(message.all ? 0 : sent.records);
  lists.push(message.series.buffer);
  sent.records = records;
  postMessage(message, lists);
  waiting = true;
}

function advance() {
  const end = now() + TURN;
  let moved = true;
  while (now() < end && moved) {
    const target = started.time + (pace * (now() - started.at)) / 1000 + AHEAD * pace;
    if (engine.time() > target) break;
    moved = engine.step(until);
  }
  const span = now() - meter.at;
  if (span > 400) {
    meter = {
      at: now(),
      steps: engine.steps(),
      time: engine.time(),
      rate: ((engine.steps() - meter.steps) * 1000) / span,
      pace: ((engine.time() - meter.time) * 1000) / span,
    };
  }
  // What could not be kept up with is not caught up with.
  const due = started.time + (pace * (now() - started.at)) / 1000;
  if (engine.time() < due) started = { at: now(), time: engine.time() };
  return moved;
}

const channel = new MessageChannel();
let scheduled = false;
function schedule(delay = 0) {
  if (scheduled) return;
  scheduled = true;
  if (delay > 0) setTimeout(() => channel.port2.postMessage(0), delay);
  else channel.port2.postMessage(0);
}
channel.port1.onmessage = () => {
  scheduled = false;
  if (!playing || !engine) return;
  try {
    const before = engine.steps();
    const moved = advance();
    if (!moved) {
      playing = false;
      postMessage({ kind: "ended", number, time: engine.time() });
    }
    if (!waiting || !moved) frame(!moved);
    if (playing) schedule(engine.steps() === before ? 8 : 0);
  } catch (error) {
    playing = false;
    postMessage({ kind: "error", number, error: problem(error), place: "run" });
    try {
      frame(true);
    } catch {
      // Its state cannot be shown either.
    }
  }
};

const acts = {
  load: ({ scene, id }) => {
    playing = false;
    load(scene, id);
  },
  shown: () => {
    waiting = false;
  },
  play: () => {
    playing = true;
    rebase();
    schedule();
  },
  pause: () => {
    playing = false;
    frame(true);
  },
  step: () => {
    playing = false;
    engine.step(until);
    frame(true);
  },
  reset: ({ id }) => {
    playing = false;
    load(text, id);
  },
  tell: () => {
    tell();
    frame(true);
  },
  pace: (message) => {
    pace = message.pace;
    rebase();
  },
  until: (message) => {
    until = message.until;
  },
  look: (message) => {
    look = { ...look, ...message.look };
    if (message.fresh && engine && !playing) frame(true);
  },
  turn: ({ knob, value, typed }) => {
    engine.turn(knob, value);
    text = engine.scene();
    try {
      tell({ typed, box: turned(typed, knob, value) });
    } catch (error) {
      tell({ typed, kept: problem(error) });
    }
    if (!playing) frame(true);
  },
  grab: ({ x, y }) => postMessage({ kind: "grabbed", number, droplet: engine.droplet_at(x, y) }),
  drag: ({ droplet, x, y }) => {
    engine.drag(droplet, x, y);
    if (!playing) frame(true);
  },
  /** Runs so many steps, or to a time, at once. */
  go: ({ steps, time, id }) => {
    playing = false;
    const began = now();
    let taken = 0;
    while (taken < (steps ?? Infinity) && engine.step(time ?? until)) taken += 1;
    const seconds = (now() - began) / 1000;
    frame(true);
    const speed = engine.speed(0);
    postMessage({
      kind: "answer",
      id,
      answer: { taken, seconds, time: engine.time(), steps: engine.steps(), speed },
    });
  },
  ask: ({ what, id, arguments: given = [] }) => {
    postMessage({ kind: "answer", id, answer: engine[what](...given) });
  },
};

const ready = init().then(
  () => postMessage({ kind: "ready", presets: JSON.parse(presets()) }),
  (error) => postMessage({ kind: "error", error: problem(error), place: "init" }),
);
/** Messages that are not about one scene. */
const FREE = ["load", "reset", "pace", "until", "look", "shown"];
onmessage = async ({ data }) => {
  await ready;
  try {
    // What is meant for another scene than the present one is left out.
    if (FREE.includes(data.kind) || (engine && data.number === number)) acts[data.kind](data);
    else if (data.id) throw new Error("The scene is not there yet. Try again.");
  } catch (error) {
    postMessage({ kind: "error", number: data.id ?? number, error: problem(error), place: data.kind, id: data.id });
  }
};
