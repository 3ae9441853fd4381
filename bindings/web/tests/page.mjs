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

const { server, address, missing } = await serve(folder);
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
    document.getElementById("rate").textContent.includes("steps per second"),
  );
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  check(width <= view.width, `${name}: the page is ${width} pixels wide`);
  await shot(page, name);
  await accessible(page);

  // Units of a cell stand next to the numbers.
  const knob = await page.textContent(".knob output");
  check(knob === "−3 −300 pN", `${name}: the activity is ${knob}`);
  await until(page, `${name}: no speed in micrometres`, () =>
    /^0\.\d+ µm\/s$/.test(document.querySelector(".plot output").textContent),
  );
  const [time, seconds] = await page.evaluate(() =>
    ["time", "seconds"].map((id) => parseFloat(document.getElementById(id).textContent.replace(/[^\d.]/g, ""))),
  );
  check(Math.abs(seconds - 10 * time) <= 0.5, `${name}: ${seconds} s at t = ${time}`);
  // The stresslet is folded away; sliders are seen without scrolling.
  check(!(await page.isVisible("#more canvas")), `${name}: the stresslet is shown at once`);
  for (const knob of await page.locator(".knob input").all()) {
    const { y, height } = await knob.boundingBox();
    check(y >= 0 && y + height <= view.height, `${name}: a slider ends at ${y + height} of ${view.height} pixels`);
  }

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

  // Arrows of the tension are drawn on the droplet at rest in the picture.
  const ink = (beyond) => {
    const shown = document.getElementById("canvas");
    const { data } = shown.getContext("2d").getImageData(0, 0, shown.width, shown.height);
    const dark = document.documentElement.dataset.theme === "dark";
    let count = 0;
    for (let k = 0; k < data.length; k += 4)
      if (dark ? data[k] > 200 && data[k + 2] > 200 : data[k] < 60 && data[k + 2] < 80) count += 1;
    return beyond === undefined ? count : count > beyond;
  };
  const without = await page.evaluate(ink);
  // A tap that ends a movement of the browser's own, as after a drag, is no click: the next one is.
  const chosen = () => page.getAttribute('[data-look="arrows"]', "aria-pressed");
  for (let tries = 0; tries < 3 && (await chosen()) !== "true"; tries += 1) await press('[data-look="arrows"]');
  await until(page, `${name}: no arrows`, ink, without + 200);
  await press('[data-look="arrows"]');

  // The picture fills the window, and shrinks again.
  const small = (await page.locator("#view").boundingBox()).height;
  await press("#full");
  const height = (least) => document.getElementById("view").clientHeight > least;
  await until(page, `${name}: the picture does not grow`, height, small + 40);
  await press("#full");
  await until(
    page,
    `${name}: the picture does not shrink`,
    (most) => document.getElementById("view").clientHeight < most,
    small + 20,
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
  check(readFileSync(await download("svg"), "utf8").startsWith("<svg"), `${name}: no SVG file`);

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
    document.getElementById("problem").textContent.includes("“viscosity = -1” is not possible. Use a positive"),
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

/** What readers stumbled over once. */
async function faults() {
  const { context, page, problems } = await visit({ width: 1280, height: 800, touch: false, scheme: "light" });
  const note = (words, name) =>
    until(page, `${name}: no note of ${words}`, (words) => document.getElementById("note").textContent.includes(words), words);
  const box = () => page.inputValue("#scene");
  const set = (name, value) =>
    page.evaluate(
      ([name, value]) => {
        const slider = document.getElementById(`knob-${name}`);
        slider.value = value;
        slider.dispatchEvent(new Event("input"));
      },
      [name, value],
    );
  const value = (name, text) =>
    until(
      page,
      `${name} is not ${text}`,
      ([name, text]) => document.querySelector(`output[for=knob-${name}]`).textContent.startsWith(text),
      [name, text],
    );

  // Of many scenes in a row, the last one is begun, and none is shown under the name of another.
  await page.evaluate(() => {
    const { postMessage } = Worker.prototype;
    window.begun = [];
    Worker.prototype.postMessage = function (message, ...rest) {
      if (message.kind === "load") window.begun.push(message.scene);
      return postMessage.call(this, message, ...rest);
    };
    window.mixed = [];
    const look = () => {
      const { preset, droplets, stale } = window.motile.shown();
      if (!stale && droplets !== ({ meeting: 2, sixteen: 16 }[preset] ?? 1)) window.mixed.push([preset, droplets]);
      requestAnimationFrame(look);
    };
    look();
    const buttons = document.querySelectorAll("#presets button");
    for (let k = 0; k < 21; k += 1) buttons[(k * 3) % 7].click();
  });
  await page.click("[data-name=meeting]");
  await until(page, "no scene after many", () => {
    const { preset, stale, droplets } = window.motile.shown();
    return preset === "meeting" && !stale && droplets === 2;
  });
  const begun = await page.evaluate(() => window.begun);
  check(begun.length <= 3 && begun.at(-1).includes("# Two droplets"), `${begun.length} scenes were begun`);
  const mixed = await page.evaluate(() => window.mixed);
  check(mixed.length === 0, `scenes are mixed: ${JSON.stringify(mixed.slice(0, 3))}`);

  // Two droplets: both speeds, and the gap between them.
  await page.evaluate(() => window.motile.go({ time: 3 }));
  await until(page, "the speeds of two are not shown", () =>
    /^1: 0\.19\d, 2: 0\.09\d µm\/s$/.test(document.querySelector(".plot output").textContent),
  );
  await until(page, "no gap", () => /1 and 2\d\.\d+ \(\d+\.\d+ µm\)$/.test(document.getElementById("gap").textContent));
  await shot(page, "two");

  // A link to a changed scene brings its question.
  await set("activity", -70);
  await value("activity", "−3.5");
  await page.click("#run");
  await until(page, "the scene does not run", () => !window.motile.shown().stale);
  check(await page.isVisible("#question"), "a changed scene has lost its question");
  await page.click("#link");
  await until(page, "no link with a question", () => /^#s=.*&p=meeting$/.test(location.hash));
  const other = await visit({
    width: 1280,
    height: 800,
    touch: false,
    scheme: "light",
    path: await page.evaluate(() => location.hash),
  });
  await until(other.page, "the link brings no question", () =>
    document.getElementById("question").textContent.includes("five times as viscous"),
  );
  await other.context.close();
  await page.evaluate(() => (location.hash = "#p=tube"));
  await until(page, "a link to a preset brings no question", () =>
    document.getElementById("question").textContent.includes("tube radius"),
  );
  await until(page, "the tube is not there", () => !window.motile.shown().stale);

  await page.click('nav a[href="#story"]');
  await page.waitForTimeout(300);
  check((await page.evaluate(() => window.motile.shown().preset)) === "tube", "a link within the page changes the scene");

  // Steps of sliders, and the text that the reader typed.
  await set("size", 25);
  await value("size", "1.25");
  await until(page, "no radius in the text", () => document.getElementById("scene").value.includes("radius = 1.25\n"));
  check((await box()).startsWith("# Three dimensions"), `the comment is lost: ${await box()}`);
  await set("viscosity-ratio", 700);
  await value("viscosity-ratio", "2.51");
  await until(page, "no viscosity in the text", () => document.getElementById("scene").value.includes("viscosity = 251.0\n"));
  await page.fill("#scene", (await box()) + "# mine\n");
  await set("activity", -40);
  await value("activity", "−2");
  await until(page, "no activity in the text", () => document.getElementById("scene").value.includes("activity = -2.0\n"));
  check((await box()).includes("# mine"), "the reader's text is lost");
  await page.fill("#scene", "no scene");
  await set("activity", -30);
  await note("but not on your text below", "a text with a mistake");
  check((await box()) === "no scene", "the reader's text is lost");
  await page.fill("#scene", " \n# nothing\n");
  await page.click("#run");
  await until(page, "an empty text runs", () =>
    document.getElementById("problem").textContent.startsWith("There is no scene in the box."),
  );
  // Behind a scene that is still beginning: that one is shown.
  await page.fill("#scene", "viscosity = 2.0");
  await page.evaluate(() => {
    const text = document.getElementById("scene").value;
    document.querySelector("[data-name=sixteen]").click();
    document.getElementById("scene").value = text;
    document.getElementById("run").click();
  });
  await until(page, "a scene without droplets runs", () =>
    document.getElementById("problem").textContent.includes("has no droplet. Add a line"),
  );
  await until(page, "the scene before is not shown", () => {
    const { preset, droplets, stale, text } = window.motile.shown();
    return preset === "sixteen" && droplets === 16 && !stale && text.startsWith("viscosity = 2.0");
  });

  // Times to stop at.
  await page.click("[data-name=swimmer]");
  await steps(page, 50);
  const time = async (text, words) => {
    await page.fill("#until", text);
    await page.press("#until", "Enter");
    if (words) await note(words, text);
    check(words ? (await page.inputValue("#until")) === "" : true, `${text} is taken`);
  };
  await time("-3", "Times begin at 0");
  await time("0.001", "Give a later time, or press R");
  await plays(page, "stop", "Pause");
  await time("6");
  await note("The run has reached t = 6.00 (60 s). To continue, clear", "stop");
  await page.fill("#until", "");
  await page.press("#until", "Enter");

  // Pressures have a key.
  check(!(await page.isVisible("#high")), "a key without pressures");
  await page.click("[data-look=pressure]");
  await until(page, "no key of pressures", () => /^[\d.]+ Pa$/.test(document.getElementById("high").textContent));
  check(await page.isVisible("#low"), "the key of pressures is not shown");
  await shot(page, "pressure");

  // An activity that weakens at once: a doubt that goes by itself.
  await set("activity", -120);
  await value("activity", "−6");
  await page.evaluate(() => window.motile.go({ time: 12 }));
  await set("activity", 0);
  await value("activity", "0");
  await page.evaluate(() => window.motile.go({ time: 12.12 }));
  await until(page, "no doubt about a crowd", () =>
    document.getElementById("warnings").textContent.includes("push its surface apart. Its shape is uncertain until"),
  );
  await page.evaluate(() => window.motile.go({ time: 30 }));
  await until(
    page,
    "the doubt does not go",
    () =>
      document.getElementById("warnings").textContent === "" &&
      document.getElementById("past").textContent.startsWith("Up to t = 2"),
  );
  await set("activity", -20);
  await value("activity", "−1");
  await until(page, "the doubt is still there", () => document.getElementById("past").textContent === "");

  // The whole screen has sliders.
  for (const [width, height] of [
    [1280, 800],
    [390, 844],
  ]) {
    await page.setViewportSize({ width, height });
    await page.click("#full");
    for (const name of ["activity", "diffusion"]) {
      const slider = await page.locator(`#stage #knob-${name}`).boundingBox();
      check(
        slider.width > 80 && slider.x >= 0 && slider.x + slider.width <= width && slider.y + slider.height <= height,
        `${width}: no slider on the whole screen: ${JSON.stringify(slider)}`,
      );
    }
    await shot(page, `full-${width}`);
    await accessible(page);
    await page.click("#full");
    check(await page.isVisible("aside #knob-activity"), "the sliders do not come back");
  }

  // At rest speeds are round-off.
  await page.evaluate(() => window.motile.load("[[droplets]]\nparticles.activity = 0.0\nparticles.start = 'uniform'\n"));
  await until(page, "no rest", () => document.querySelector(".plot output").textContent === "0 µm/s");
  check(problems.length === 0, problems.join("\n"));
  await context.close();
}

try {
  const wide = await whole({ name: "wide", width: 1400, height: 900, touch: false, scheme: "light" });
  const narrow = await whole({ name: "narrow", width: 390, height: 844, touch: true, scheme: "dark" });
  const pale = await visit({ width: 360, height: 640, touch: true, scheme: "light" });
  await drawn(pale.page, "narrow and light");
  await shot(pale.page, "narrow-light");
  for (const knob of await pale.page.locator(".knob input").all()) {
    const { y, height } = await knob.boundingBox();
    check(y + height <= 640, `a slider ends at ${y + height} of 640 pixels`);
  }
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
  for (const k of [7, 6, 5, 4, 3, 2, 1]) {
    await choose(k);
    check((await page.textContent("#warnings")) === "", `preset ${k} warns`);
    await page.click("#reveal");
    check((await page.textContent("#answer")).length > 50, `preset ${k} has no answer`);
    check((await page.textContent("#question")).includes("?"), `preset ${k} has no question`);
    await page.focus("#canvas");
  }
  await plays(page, "keyboard", "Pause");
  await page.keyboard.press(" ");
  await plays(page, "keyboard", "Play");
  await until(page, "no map of speeds", () => Number(document.documentElement.dataset.map) > 12);
  await accessible(page);
  await shot(page, "wide-dark");
  check(problems.length === 0, problems.join("\n"));
  await context.close();
  await faults();
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
  // If the module does not come, the page says so.
  missing.add(join(folder, "motile_bg.wasm"));
  const poor = await browser.newPage();
  await poor.goto(address);
  await until(poor, "no word of the missing module", () =>
    document.getElementById("loading").textContent.includes("could not load its program"),
  );
  missing.clear();
  await poor.close();
  console.log(
    `page in Chromium ${browser.version()}: first droplet after ${wide} ms (1400 pixels), ${narrow} ms (390 pixels)`,
  );
} finally {
  await browser.close();
  server.close();
}
