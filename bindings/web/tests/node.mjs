// The compiled page in node against native numbers, and against the command line's of a scene that the tests of the
// Python package compare with the same command: `node tests/node.mjs FOLDER NUMBERS SCENE SUMMARY`.
import { existsSync, readFileSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, numbers, scene, summary] = process.argv.slice(2);
const bytes = (name) => readFileSync(join(folder, name));
/** What `rest.js` asks of a browser, of files. */
globalThis.XMLHttpRequest = class {
  open(_method, address) {
    this.name = basename(address.pathname);
  }
  overrideMimeType() {}
  send() {
    [this.status, this.responseText] = [200, bytes(this.name).toString("latin1")];
  }
};
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
