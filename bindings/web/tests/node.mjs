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
const { doubt, plain } = await import(pathToFileURL(resolve(folder, "problem.js")));
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
  ["[[droplets]]\nparticles.activity = -30.0", "“particles.activity = -30” of droplet 1 is not possible."],
  ["viscosity = 2.0", "The scene has no droplet. Add a line to the text"],
]) {
  let told = "";
  try {
    new Engine(text);
  } catch (error) {
    told = plain(JSON.parse(error));
  }
  for (const word of words) if (!told.includes(word)) throw new Error(`the error of ${text} is ${told}, without ${word}`);
  if (/[\]{}|^`]/.test(told.replace(/\(.*?\)/, "").replace("[[droplets]]", ""))) throw new Error(`the error of ${text} has marks: ${told}`);
}
// What ends a run, and what is doubtful about it: no words of programmers, and what to do on the page.
const PROGRAMMERS = /marker|P[eé]clet|body \d|time step|grid|residual|iterations|interface|\d{6}|undefined|NaN/;
const clear = (told, word) => {
  if (!told.includes(word) || PROGRAMMERS.test(told)) throw new Error(`in other words than ${word}: ${told}`);
};
const coarse = (name) => known.find((one) => one.name === name).scene.replace(/nodes = .*\}/, "nodes = 24, elements = 64 }");
for (const [text, droplets, error, ...doubts] of [
  [
    coarse("meeting").replace(/repulsion.*/, "").replaceAll("-4.0", "-7.0"),
    2,
    "droplet 1 has crossed droplet 2 at (",
    "The edge of the crowd on droplet 1 is too sharp",
    "The gap between droplet 2 and droplet 1 is 0.",
    "The stresslet of droplet 1 is uncertain",
  ],
  [
    coarse("swimmer").replace("-3.0", "8.0"),
    1,
    ", the outline of the droplet crosses itself at (",
    "Choose an activity nearer to 0.",
    "The edge of the crowd on the droplet is too sharp",
  ],
]) {
  const failing = new Engine(text);
  let told = "";
  try {
    while (failing.step(60)) {
      // Until it fails.
    }
  } catch (thrown) {
    told = plain(JSON.parse(thrown), true, droplets);
  }
  clear(told, error);
  clear(told, "Press R to restart. Then move the slider “Activity” towards 0");
  const found = JSON.parse(failing.warnings()).map((one) => doubt(one, droplets === 1 ? 8 : -7, droplets));
  for (const word of doubts) clear(found.find((one) => one.includes(word)) ?? found.join(), word);
  failing.free();
}
// Messages of the library that its runs here do not give.
for (const [message, word] of [
  ["at time 3.2 droplet went wrong: marker coordinate number 3 is NaN. Use a smaller time step", "no longer made of numbers."],
  ["the position of marker 3 of body 0 is (NaN, 0), so the run has failed. Use a smaller time step", "outline of droplet 1"],
  ["a curve of body 1 has 8 points. Use a number from 16 to 4096", "A curve of the body inside has 8 points."],
  [
    "at time 1 the flow could not be computed: GMRES stopped at a relative residual of 1e-3 after 9 iterations, above " +
      "1e-9. If a gap has become too narrow, or a body is too slender for its nodes, use more nodes",
    "its equations have no accurate solution here.",
  ],
  [
    "at time 9.123456 the time step would have to fall to 1e-12, below the minimum of 1e-9. Use a larger tolerance, or " +
      "refine the grid and the markers",
    "At t = 9.12, the droplets change too fast to be followed.",
  ],
])
  clear(plain({ message }, true, 1), word);
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
