// Pictures of the presets: `node tests/thumbnails.mjs PAGE FOLDER`.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { FLAGS, serve } from "./serve.mjs";

const [folder, out] = process.argv.slice(2);
/** Time at which each is drawn. */
const TIMES = { swimmer: 8, meeting: 5.5, channel: 9, nucleus: 12, sixteen: 3, constriction: 22, tube: 6 };
mkdirSync(out, { recursive: true });
const { server, address } = await serve(folder);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM, args: FLAGS });
const page = await browser.newPage({ viewport: { width: 1400, height: 900 }, colorScheme: "light" });
await page.goto(address);
await page.waitForFunction(() => document.documentElement.dataset.first);
// Tracers are dust at this size.
await page.click("[data-look=tracers]");
for (const [name, time] of Object.entries(TIMES)) {
  await page.click(`[data-name=${name}]`);
  await page.waitForFunction(() => Number(document.documentElement.dataset.steps) > 0);
  await page.evaluate((time) => window.motile.go({ time }), time);
  await page.waitForTimeout(300);
  const data = await page.evaluate(() => {
    const canvas = document.getElementById("canvas");
    const small = document.createElement("canvas");
    [small.width, small.height] = [288, 192];
    const width = Math.min(canvas.width, canvas.height * 1.5);
    const height = width / 1.5;
    const context = small.getContext("2d");
    context.imageSmoothingQuality = "high";
    context.drawImage(
      canvas,
      (canvas.width - width) / 2,
      (canvas.height - height) / 2,
      width,
      height,
      0,
      0,
      288,
      192,
    );
    return small.toDataURL("image/webp", 0.6);
  });
  writeFileSync(join(out, `${name}.webp`), Buffer.from(data.split(",")[1], "base64"));
}
await browser.close();
server.close();
