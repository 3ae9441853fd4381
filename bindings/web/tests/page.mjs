// The page in Chromium: `node tests/page.mjs FOLDER [SCREENSHOTS]`; CHROMIUM names the browser.
import { mkdirSync, readFileSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { packed } from "../site/link.js";
import { FLAGS, serve } from "./serve.mjs";

const [folder, shots] = process.argv.slice(2);
const WAIT = 120_000;

function check(truth, words) {
  if (!truth) throw new Error(words);
}

const { server, address, asked, missing } = await serve(folder);
/** The part of the module that is not loaded before it is needed. */
const rest = join(folder, "motile_rest.wasm");
const executablePath = process.env.CHROMIUM;
check(executablePath, "CHROMIUM does not say where the browser is");
const browser = await chromium.launch({ executablePath, args: FLAGS });
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** Waits until something is true on the page, which works at its own pace: nothing here is looked at only once. */
async function until(page, words, truth, given) {
  try {
    await page.waitForFunction(truth, given);
  } catch (error) {
    throw new Error(words, { cause: error });
  }
}

/** Waits for a picture of more than twenty colours. */
const drawn = (page, name) =>
  until(page, `${name}: the picture is blank`, () => {
    const canvas = document.getElementById("canvas");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const seen = new Set();
    for (let k = 0; k < data.length; k += 4 * 37) seen.add((data[k] << 16) | (data[k + 1] << 8) | data[k + 2]);
    return seen.size > 20;
  });

const plays = (page, name, label) =>
  until(
    page,
    `${name}: the button does not say ${label}`,
    (label) => document.getElementById("play").getAttribute("aria-label") === label,
    label,
  );

const steps = (page, least) =>
  until(
    page,
    `no ${least} steps`,
    (least) => Number(document.documentElement.dataset.steps) >= least,
    least,
  );

async function visit({ width, height, touch, scheme, path = "" }) {
  const context = await browser.newContext({
    viewport: { width, height },
    hasTouch: touch,
    isMobile: touch,
    colorScheme: scheme,
    acceptDownloads: true,
    deviceScaleFactor: touch ? 2 : 1,
  });
  context.setDefaultTimeout(WAIT);
  const page = await context.newPage();
  const problems = [];
  page.on("console", (message) => {
    if (message.type() === "error") problems.push(message.text());
  });
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("response", (response) => {
    if (response.status() >= 400) problems.push(`${response.status()} ${response.url()}`);
  });
  asked.clear();
  await page.goto(address + path);
  await until(page, "no droplet is drawn", () => document.documentElement.dataset.first);
  return { context, page, problems, press: (selector) => (touch ? page.tap(selector) : page.click(selector)) };
}

async function accessible(page) {
  // The policy of the page lets no script in but its own: this one comes by the debugger.
  await page.evaluate(`(() => { ${axe}; window.axe = axe; })()`);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  const bad = violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
  const told = bad.map(({ id, nodes }) => `${id}: ${nodes.map((node) => `${node.target} ${node.failureSummary}`)}`);
  check(bad.length === 0, `axe-core: ${told.join("\n")}`);
}

async function shot(page, name) {
  if (!shots) return;
  mkdirSync(shots, { recursive: true });
  await page.screenshot({ path: join(shots, `${name}.png`) });
}

async function whole({ name, ...view }) {
  const visited = await visit(view);
  const { context, page, problems, press } = visited;
  await steps(page, 100);
  await drawn(page, name);
  await until(page, `${name}: no steps a second`, () =>
    document.getElementById("rate").textContent.includes("steps a second"),
  );
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  check(width <= view.width, `${name}: the page is ${width} pixels wide`);
  await shot(page, name);
  await accessible(page);

  // A slider acts while it runs.
  const slider = page.locator("#knob-activity");
  await slider.scrollIntoViewIfNeeded();
  const box = await slider.boundingBox();
  const position = { x: 0.25 * box.width, y: 0.5 * box.height };
  await (view.touch ? slider.tap({ position }) : slider.click({ position }));
  await until(page, `${name}: the slider does nothing`, () =>
    /activity = -[56]/.test(document.getElementById("scene").value),
  );
  const now = await page.evaluate(() => Number(document.documentElement.dataset.steps));
  await steps(page, now + 10);

  // Pause, a step, drag.
  await press("#play");
  await plays(page, name, "Play");
  const before = await page.evaluate(() => window.motile.ask("steps"));
  await press("#step");
  check((await page.evaluate(() => window.motile.ask("steps"))) === before + 1, `${name}: a step is no step`);
  await press("#reset");
  await until(page, `${name}: no start again`, () => document.getElementById("time").textContent === "t = 0.00");
  check(
    (await page.evaluate(() => window.motile.ask("droplet_at", 0.0, -0.8))) === 0,
    `${name}: the droplet is not at the start`,
  );
  await page.locator("#canvas").scrollIntoViewIfNeeded();
  const picture = await page.locator("#canvas").boundingBox();
  const middle = [picture.x + picture.width / 2, picture.y + picture.height / 2];
  const isLoose = () => document.getElementById("canvas").dataset.held === "0";
  const held = () => until(page, `${name}: no droplet is held`, isLoose);
  if (view.touch) {
    const touch = await context.newCDPSession(page);
    const send = (type, y) =>
      touch.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchEnd" ? [] : [{ x: middle[0], y }] });
    await send("touchStart", middle[1]);
    await held();
    for (let k = 1; k <= 6; k += 1) await send("touchMove", middle[1] - 8 * k);
    await send("touchEnd", 0);
  } else {
    await page.mouse.move(...middle);
    await page.mouse.down();
    await held();
    for (let k = 1; k <= 6; k += 1) await page.mouse.move(middle[0], middle[1] - 20 * k);
    await page.mouse.up();
  }
  await until(
    page,
    `${name}: the droplet cannot be dragged`,
    async () => (await window.motile.ask("droplet_at", 0.0, -0.8)) === -1,
  );

  // Downloads.
  const download = async (kind, tries = 3) => {
    // A tap that ends a movement of the browser's own, as after a drag, is no click: the next one is.
    const file = page.waitForEvent("download", { timeout: tries > 1 ? WAIT / 6 : WAIT });
    await press(`[data-save="${kind}"]`);
    try {
      return await (await file).path();
    } catch (error) {
      if (tries === 1) throw error;
      return download(kind, tries - 1);
    }
  };
  const text = readFileSync(await download("csv"), "utf8");
  check(/^time,x,y,/.test(text) && text.split("\n").length >= 2, `${name}: the CSV file has no rows`);
  check(statSync(await download("png")).size > 10_000, `${name}: the PNG file is empty`);
  check(!asked.has(rest), `${name}: the rest of the module is loaded at once`);
  check(readFileSync(await download("svg"), "utf8").startsWith("<svg"), `${name}: no SVG file`);
  check(asked.has(rest), `${name}: pictures are not of the rest of the module`);

  // A link brings the same scene, and its text is what the library reads.
  await press("#link");
  await until(page, `${name}: no link`, () => location.hash.startsWith("#s="));
  const hash = await page.evaluate(() => location.hash);
  check(hash.length < 2000, `${name}: the link has ${hash.length} letters`);
  const scene = await page.evaluate(() => window.motile.ask("scene"));
  const other = await visit({ ...view, path: hash });
  const again = await other.page.evaluate(() => window.motile.ask("scene"));
  check(again === scene && /activity = -[56]/.test(again), `${name}: the link holds\n${again}\nnot\n${scene}`);
  check(other.problems.length === 0, `${name}, by its link: ${other.problems.join("\n")}`);
  await other.context.close();

  // The library's errors, and what runs the scene elsewhere.
  await page.fill("#scene", "viscosity = -1.0\n");
  await press("#run");
  await until(page, `${name}: no error`, () =>
    document.getElementById("problem").textContent.includes("viscosity = -1"),
  );
  await press('[data-way="python"]');
  await until(page, `${name}: no Python`, () =>
    document.getElementById("code").textContent.startsWith("import motile"),
  );
  check(problems.length === 0, `${name}: ${problems.join("\n")}`);
  const first = await page.evaluate(() => document.documentElement.dataset.first);
  await context.close();
  return first;
}

try {
  const wide = await whole({ name: "wide", width: 1400, height: 900, touch: false, scheme: "light" });
  const narrow = await whole({ name: "narrow", width: 390, height: 844, touch: true, scheme: "dark" });
  const pale = await visit({ width: 390, height: 844, touch: true, scheme: "light" });
  await drawn(pale.page, "narrow and light");
  await shot(pale.page, "narrow-light");
  await accessible(pale.page);
  await pale.context.close();
  // By the keyboard alone: every scene runs, the view of the other theme is readable too.
  const { context, page, problems } = await visit({ width: 1400, height: 900, touch: false, scheme: "dark" });
  const presets = await page.locator("#presets button").count();
  check(presets === 7, `${presets} presets`);
  const choose = async (k) => {
    await page.keyboard.press(String(k));
    await until(
      page,
      `key ${k} chooses nothing`,
      (k) => document.querySelectorAll("#presets button")[k - 1].getAttribute("aria-pressed") === "true",
      k,
    );
    await steps(page, 2);
    await drawn(page, `preset ${k}`);
  };
  for (const k of [4, 3, 2]) await choose(k);
  check(!asked.has(rest), "the first presets need the rest of the module");
  for (const k of [7, 6, 5, 1]) await choose(k);
  check(asked.has(rest), "no preset needs the rest of the module");
  await plays(page, "keyboard", "Pause");
  await page.keyboard.press(" ");
  await plays(page, "keyboard", "Play");
  await until(page, "no map of speeds", () => Number(document.documentElement.dataset.map) > 12);
  await accessible(page);
  await shot(page, "wide-dark");
  check(problems.length === 0, problems.join("\n"));
  await context.close();
  const unknown = await visit({ width: 390, height: 844, touch: false, scheme: "light", path: "#scene-of-old" });
  await until(unknown.page, "no word of a link to nothing", () =>
    document.getElementById("note").textContent.startsWith("The link names no scene"),
  );
  await unknown.context.close();
  // A link that was cut says so, and one that the library does not understand shows its text.
  const cut = await visit({ width: 390, height: 844, touch: false, scheme: "light", path: "#s=%AAAA" });
  await until(cut.page, "no word of the link", () =>
    document.getElementById("note").textContent.startsWith("The link is not complete"),
  );
  await cut.page.evaluate((hash) => (location.hash = hash), await packed("viscosty = 1.0\n"));
  await until(cut.page, "no text of a link that is not understood", () =>
    document.getElementById("scene").value.startsWith("viscosty"),
  );
  await cut.context.close();
  // Where the rest of the module does not come, the page says so and goes on.
  missing.add(rest);
  const poor = await visit({ width: 390, height: 844, touch: false, scheme: "light" });
  await poor.page.click('[data-save="svg"]');
  await until(poor.page, "no word of the missing rest", () =>
    document.getElementById("note").textContent.includes("the rest of the page is missing"),
  );
  await poor.page.keyboard.press("2");
  await steps(poor.page, 2);
  missing.clear();
  const late = poor.page.waitForEvent("download");
  await poor.page.click('[data-save="svg"]');
  await late;
  await poor.context.close();
  console.log(
    `page in Chromium ${browser.version()}: first droplet after ${wide} ms (1400 pixels), ${narrow} ms (390 pixels)`,
  );
} finally {
  await browser.close();
  server.close();
}
