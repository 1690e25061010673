// Looks at pages of the site in Chromium: accessibility (axe), width, requests, errors; and asks the search.
// node look.mjs MODULES BASE PAGES QUESTIONS, where MODULES holds axe-core and playwright-core.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const [modules, base, pages, questions] = process.argv.slice(2);
const load = createRequire(`${modules}/package.json`);
const { chromium } = load("playwright-core");
const axe = readFileSync(load.resolve("axe-core/axe.min.js"), "utf8");
const widths = [1280, 768, 390];
const first = 5; // results among which an answer has to be

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const wrong = [];

/** Opens a page, does `inspect` with it, and notes what it complains of and what it asks for elsewhere. */
async function opened(address, width, settings, inspect) {
  const context = await browser.newContext({ viewport: { width, height: 900 }, ...settings });
  const page = await context.newPage();
  const say = (text) => wrong.push(`${address}: ${text}`);
  page.on("console", (message) => message.type() === "error" && say(message.text()));
  page.on("pageerror", (error) => say(error.message));
  page.on("request", (request) => /^https?:/.test(request.url()) && !request.url().startsWith(base) && say(`asks for ${request.url()}`));
  await page.goto(base + address, { waitUntil: "load" });
  await page.waitForFunction(() => [...document.querySelectorAll("[data-later]")].every((place) => place.innerHTML));
  await inspect(page, say);
  await context.close();
}

async function widthOf(page, say) {
  for (const width of widths) {
    await page.setViewportSize({ width, height: 900 });
    const needed = await page.evaluate(() => document.documentElement.scrollWidth);
    if (needed > width) say(`needs ${needed} px where there are ${width}`);
  }
}

async function accessible(page, say) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run());
  violations.forEach(({ id, nodes }) => say(`axe: ${id}: ${nodes.map((node) => node.target).join("; ")}`));
}

for (const address of JSON.parse(pages)) {
  await opened(address, 1280, {}, widthOf);
  // Without its policy, which refuses the script that axe is.
  await opened(address, 1280, { bypassCSP: true }, accessible);
  await opened(address, 390, { bypassCSP: true, colorScheme: "dark" }, accessible);
}

const page = await browser.newPage();

/** The first pages that the search finds; of lessons without their numbers. */
async function found(words) {
  await page.goto(`${base}search.html?q=${encodeURIComponent(words)}`);
  await page.waitForFunction((searched) => document.body.dataset.searched === searched, words, { timeout: 20000 });
  const links = await page.$$eval("#results > li > a", (list) => list.map((link) => link.href));
  const address = (url) => url.slice(base.length).replace(/#.*/, "").replace(/\/$/, "/index.html");
  return links.slice(0, first).map((url) => address(url).replace(/^learn\/\d+_/, "learn/"));
}
for (const { question, searches, pages: answers } of JSON.parse(readFileSync(questions, "utf8"))) {
  const results = [];
  for (const words of searches) results.push(...(await found(words)));
  if (!results.some((address) => answers.includes(address))) wrong.push(`${question} ${searches} lead to ${results}`);
}
await browser.close();
console.log(wrong.length ? wrong.join("\n") : "pages and search: good");
process.exitCode = wrong.length ? 1 : 0;
