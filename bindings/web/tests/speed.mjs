// Steps a second of scenes of 1, 4 and 16 droplets in Chromium, as `examples/steps.rs` measures them on the host:
// `node tests/speed.mjs FOLDER`; CHROMIUM names the browser.
import { chromium } from "playwright-core";
import { FLAGS, serve } from "./serve.mjs";

const { server, address } = await serve(process.argv[2]);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM, args: FLAGS });
const page = await browser.newPage();
const began = Date.now();
await page.goto(address);
await page.waitForFunction(() => document.documentElement.dataset.first);
console.log(
  `first droplet after ${await page.evaluate(() => document.documentElement.dataset.first)} ms,`,
  `${Date.now() - began} from outside`,
);
for (const [count, side] of [
  [1, "6.0"],
  [4, "8.0"],
  [16, "13.0"],
]) {
  const scene =
    `region.box.lengths = [${side}, ${side}]\nmethod.integral = { nodes = 32, elements = 96 }\n` +
    `repulsion = { strength = 1000.0, range = 0.26 }\n[[suspension]]\ncount = ${count}\nactivity = -3.0\n`;
  await page.evaluate((scene) => window.motile.load(scene), scene);
  await page.evaluate(() => window.motile.go({ steps: 20 }));
  const { taken, seconds, speed } = await page.evaluate((steps) => window.motile.go({ steps }), 1600 / count);
  console.log(`${count} droplets: ${Math.round(taken / seconds)} steps a second, speed ${speed}`);
}
await page.evaluate(() => window.motile.load("method.integral = { nodes = 48, elements = 192 }\n[[droplets]]\n"));
console.log(`default scene at t = 5: speed ${(await page.evaluate(() => window.motile.go({ time: 5 }))).speed}`);
await browser.close();
server.close();
