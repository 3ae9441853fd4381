// The compiled page in node against native numbers, and against the command line's of a scene that the tests of the
// Python package compare with the same command: `node tests/node.mjs FOLDER NUMBERS SCENE SUMMARY`.
import { existsSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, numbers, scene, summary] = process.argv.slice(2);
const bytes = (name) => readFileSync(join(folder, name));
const { default: init, Engine, presets } = await import(pathToFileURL(resolve(folder, "motile.js")));
await init({ module_or_path: bytes("motile_bg.wasm") });
const expected = JSON.parse(readFileSync(numbers, "utf8"));
const known = JSON.parse(presets());
if (known.length !== expected.length) throw new Error(`${expected.length} scenes, ${known.length} presets`);
let largest = 0;
for (const [k, { name, time, speed }] of expected.entries()) {
  const engine = new Engine(known[k].scene);
  for (let step = 0; step < 12; step += 1) engine.step(NaN);
  for (const [what, here, there] of [
    ["time", engine.time(), time],
    ["speed", engine.speed(0), speed],
  ]) {
    const difference = Math.abs(here / there - 1);
    largest = Math.max(largest, difference);
    if (!(difference < 1e-10)) throw new Error(`${name}: ${what} ${here} in wasm, ${there} natively`);
  }
  engine.free();
}
const there = JSON.parse(readFileSync(summary, "utf8"));
const engine = new Engine(readFileSync(scene, "utf8"));
while (engine.step(there.time)) {
  // To the end.
}
const apart = Math.abs(engine.speed(0) / there.speed - 1);
if (!(apart < 1e-9)) throw new Error(`speed ${engine.speed(0)} on the page, ${there.speed} by the command line`);
try {
  new Engine("viscosity = -1.0");
  throw new Error("a negative viscosity was taken");
} catch (error) {
  const { key, remedy } = JSON.parse(error);
  if (key !== "viscosity" || !remedy) throw new Error(`an error without key and remedy: ${error}`);
}
// Errors in words for people: where, what, and what to do.
const { plain } = await import(pathToFileURL(resolve(folder, "problem.js")));
for (const [text, ...words] of [
  ["viscosity = -1.0", "“viscosity = -1” is not possible.", "Use a positive finite number."],
  ["viscosty = 1.0", "Line 1 (viscosty = 1.0)", "no key “viscosty”", "Did you mean “viscosity”?"],
  ["[[droplets]]\nradius = 1", "Line 2 (radius = 1)", "no key “radius”", "shape"],
  ["no scene", "Line 1 (no scene)", "A key needs a value. Write: key = value."],
  ["[[droplets]]\ncentre = [1", "Line 2", "is not closed. Close it."],
  ["[[droplets]]\nparticles.activity = 'a'", "Line 2", 'the text "a"', "Give a number instead."],
  ["mirror-symmetric = 3", "Line 1", "the number 3", "Give true or false instead."],
  ["method.integral.nodes = 1.5", "the number 1.5", "Give a whole number that is not negative instead."],
  ["region = 'spce'", "no choice “spce”", "Did you mean “space”?"],
  ["region.box.lengths = [1.5, 1.5]\n[[droplets]]", "Droplet 1", "does not fit", "enlarge the region"],
  ["[[droplets]]\n[[droplets]]", "Droplet 2 overlaps droplet 1"],
]) {
  let told = "";
  try {
    new Engine(text);
  } catch (error) {
    told = plain(JSON.parse(error));
  }
  for (const word of words) if (!told.includes(word)) throw new Error(`the error of ${text} is ${told}, without ${word}`);
  if (/[\[\]{}|^`]/.test(told.replace(/\(.*?\)/, ""))) throw new Error(`the error of ${text} has marks: ${told}`);
}
// Links of the page's own text, and links to scenes with what messages add, or cut.
const page = readFileSync(join(folder, "index.html"), "utf8");
for (const [, address] of page.matchAll(/(?:href|src)="([^"#][^"#]*)/g)) {
  if (!/^https?:/.test(address) && !existsSync(join(folder, address))) throw new Error(`no ${address} beside the page`);
}
const { packed, unpacked } = await import(pathToFileURL(resolve(folder, "link.js")));
for (const { name, scene: text } of known) {
  const link = `#${await packed(text)}`;
  const endings = ["", ".", ")", ",", '"', "%20", "&utm_source=mail", "%3D", "_", "__", "-", "*", "\u201d", "/", "'s"];
  for (const ending of endings) {
    for (const whole of [link, link.replace("=", "%3D"), link.replace("=", "%3d")]) {
      if ((await unpacked(whole + ending)) !== text) throw new Error(`${name}: the link is lost before ${ending}`);
    }
  }
  for (let length = 3; length < link.length; length += 1) {
    const found = await unpacked(link.slice(0, length)).catch(() => "refused");
    if (found !== "refused") throw new Error(`${name}: a link cut after ${length} letters gives ${found}`);
  }
}
console.log(
  `wasm in node: ${expected.length} scenes, largest difference from native ${largest.toExponential(1)},`,
  `from the command line ${apart.toExponential(1)}`,
);
