// What visitors do first, in node: `node rehearsal.mjs SCRIPT PLACE` with a module that notes in its memory, from a
// place on, which of its functions are called. Writes these bytes as letters, 0 or 1. What is called here is what the
// page loads first; anything else is loaded when it is called.
import { readFileSync } from "node:fs";

/** Presets that need no more than the first part. */
const FIRST = ["swimmer", "meeting", "channel", "nucleus"];

const [script, place] = process.argv.slice(2);
// By its text: old versions of node take files of this name for modules of another kind.
const address = `data:text/javascript,${encodeURIComponent(readFileSync(script, "utf8"))}`;
const { default: init, Engine, presets, branch_of } = await import(address);
const { memory } = await init({ module_or_path: readFileSync(script.replace(/\.js$/, "_bg.wasm")) });

/** Runs to a time and sees what the page shows, of the table what is new, which may be nothing. */
function run(engine, until) {
  let seen = 0;
  for (let step = 0; engine.step(until); step += 1) {
    for (const what of ["time", "steps", "tilt", "shapes"]) engine[what]();
    if (step % 10 === 0) engine.flow(step % 20 === 0);
    engine.drift(-3, -3, 3, 3);
    engine.series(seen);
    seen = engine.records();
  }
}

const known = JSON.parse(presets());
for (const { scene } of FIRST.map((name) => known.find((preset) => preset.name === name))) {
  const engine = new Engine(scene);
  run(engine, 3);
  for (const { name, least, most, value } of JSON.parse(engine.about()).knobs) {
    for (const part of [-1, -0.05, 0.05, 1]) {
      try {
        engine.turn(name, Math.min(Math.max(value + part * (most - least), least), most));
        engine.step(NaN);
      } catch {
        // Refused, as it may be where someone turns it.
      }
    }
    engine.turn(name, value);
  }
  for (let k = 0; k < 5; k += 1) {
    try {
      engine.drag(Math.max(0, engine.droplet_at(0, 0)), 0.02, -0.2);
      engine.flow(true);
    } catch {
      // There is no room.
    }
  }
  run(engine, 4);
  // A slider that is moved while it runs, and what follows.
  for (const { name, least, value } of JSON.parse(engine.about()).knobs.filter(({ name }) => name === "activity")) {
    try {
      engine.turn(name, Math.max(least, 2 * value));
      run(engine, engine.time() + 2);
    } catch {
      // Films may become too thin.
    }
    engine.warnings();
    engine.turn(name, value);
  }
  engine.speed(0);
  const text = engine.scene();
  for (const way of ["command", "python", "rust"]) engine.code(way, 20);
  for (const what of ["csv", "warnings"]) engine[what]();
  new Engine(text).free();
  let points = 0;
  if (JSON.parse(engine.about()).map) branch_of(scene, () => (points += 1) < 8 || scene === known[0].scene);
  engine.free();
}
for (const wrong of ["viscosity = -1.0", "no scene", "[[droplets]]\nradius = 1"]) {
  try {
    new Engine(wrong);
  } catch {
    // That is what it is here for.
  }
}
process.stdout.write(Array.from(new Uint8Array(memory.buffer, Number(place), 65536), String).join(""));
