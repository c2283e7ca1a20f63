/** The page in a browser without a window. What it shows and hands out goes to OUT, for tests/web/test_page.py. */
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import axe from "axe.source";
import { chromium, type Browser, type BrowserContextOptions, type Page } from "playwright-core";
import { SPANS } from "../src/knobs.js";
import { PAPER } from "../src/paper.js";

const address = process.env["SERVED"]!; // by `hitch live`
const file = pathToFileURL(process.env["PAGE"]!).href;
const out = process.env["OUT"]!;
const told: string[] = []; // by the console, and asked for outside: nothing is expected
let browser: Browser;

before(async () => {
  browser = await chromium.launch({ executablePath: process.env["BROWSER"]!, args: ["--no-sandbox"] });
});
after(async () => {
  await browser.close();
  assert.deepEqual(told, []);
});

async function opened(link = "", options: BrowserContextOptions = {}): Promise<Page> {
  const page = await (await browser.newContext({ reducedMotion: "reduce", ...options })).newPage();
  page.on("console", (message) => told.push(message.text()));
  page.on("pageerror", (error) => told.push(String(error)));
  page.on("dialog", (dialog) => told.push(`a dialog: ${dialog.message()}`));
  page.on("request", (request) => {
    if (request.url().split("#")[0] !== address && !/^(file|blob|data):/.test(request.url())) {
      told.push(`asked for ${request.url()}`);
    }
  });
  await page.goto(`${address}#${link}`);
  await quiet(page);
  return page;
}

/** Until numbers and link have followed. */
async function quiet(page: Page): Promise<void> {
  await page.waitForTimeout(250);
}

async function mapped(page: Page): Promise<void> {
  await quiet(page);
  await page.waitForFunction(() => document.getElementById("map")!.getAttribute("aria-busy") === "false");
}

async function download(page: Page, id: string, name: string): Promise<void> {
  const [file] = await Promise.all([page.waitForEvent("download"), page.click(`#${id}`)]);
  await file.saveAs(join(out, name));
}

function fields(page: Page): Promise<Record<string, string>> {
  return page.$$eval(".knob input[type=text]", (all) =>
    Object.fromEntries(all.map((field) => [field.id, (field as HTMLInputElement).value])),
  );
}

/** Downloads and texts of what is shown, under a name. */
async function taken(page: Page, name: string): Promise<object> {
  await quiet(page);
  await download(page, "csv", `${name}.csv`);
  await download(page, "toml", `${name}.toml`);
  return {
    rows: await page.$$eval("#numbers tr", (rows) => rows.map((row) => row.textContent)),
    reasons: await page.textContent("#reasons"),
    python: await page.textContent("#python"),
    link: await page.evaluate(() => location.hash),
  };
}

test("figures and cases by the list of presets, other values by a link", async () => {
  const page = await opened();
  const shown: Record<string, object> = {};
  for (const [word, table] of [["Figure", PAPER.figures], ["Case", PAPER.cases]] as const) {
    for (const name of Object.keys(table)) {
      await page.selectOption("#preset", `${word} ${name}`);
      shown[`${word} ${name}`] = await taken(page, `${word} ${name}`);
    }
  }
  await download(page, "svg", "run.svg");
  await page.goto(`${address}#${process.env["LINK"]!}`);
  shown["Link"] = await taken(page, "Link");
  writeFileSync(join(out, "shown.json"), JSON.stringify(shown));
});

test("the drawing moves at real time or slower, until it is held", async () => {
  const page = await opened("", { reducedMotion: "no-preference" });
  const shown = () => page.evaluate(() => document.getElementById("trailer-drawn")!.getAttribute("transform"));
  const time = async () => Number(await page.inputValue("#time"));
  await page.selectOption("#slowness", "2");
  const [began, from] = [Date.now(), await time()];
  const first = await shown();
  await page.waitForTimeout(600);
  const [passed, to] = [(Date.now() - began) / 1000, await time()];
  assert(to > from && to - from < passed / 2 + 0.1, `${to - from} s are shown in ${passed} s`);
  assert.notEqual(await shown(), first);
  await page.click("#play");
  const held = await time();
  await page.waitForTimeout(300);
  assert.equal(await time(), held);
  assert.equal(await page.textContent("#play"), "Play");
});

test("fifty values of a slider, and the map: how long they take", async () => {
  const page = await opened();
  await mapped(page);
  const each = await page.evaluate(async () => {
    const slider = document.querySelector<HTMLInputElement>("#knobs input[type=range]")!;
    const begin = performance.now();
    for (let i = 0; i < 50; i++) {
      slider.value = String(500 + 5 * i);
      slider.dispatchEvent(new Event("input"));
      await null; // uPlot draws once the event is over
    }
    return (performance.now() - begin) / 50;
  });
  await mapped(page);
  const begin = Date.now();
  await page.fill("#knob-k", "6000");
  await mapped(page);
  const map = Date.now() - begin;
  assert.equal(await page.locator("#map svg g[aria-label=rect] rect").count(), 600);
  await page.reload();
  const paint = await page.waitForFunction(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime);
  const first = (await paint.jsonValue()) as number;
  console.log(`${each.toFixed(1)} ms a value of the slider, ${map} ms a map, first picture in ${first.toFixed(0)} ms`);
});

const WRONG = ["much", "", "  ", "1,5", "5 kN", "-1", "1e300", "NaN", "Infinity", "<img src=x onerror=alert(1)>"];

test("a wrong value says what is allowed, and nothing is lost", async () => {
  const page = await opened("C=100");
  const before = await page.evaluate(() => location.hash);
  for (const name of Object.keys(SPANS)) {
    for (const text of name === "V_0" ? WRONG.filter((value) => value !== "-1") : WRONG) {
      await page.fill(`#knob-${name}`, text);
      const message = (await page.textContent(`#told-${name}`))!;
      // An input has no upper end; what is too much for a step the unit says in other words.
      const words = `${name} = .* is not allowed: its range is .* to .*`;
      const is = text === "1e300" && name === "brake_torque" ? "no step can be made" : words;
      assert.match(message, new RegExp(`^${is}`), `${name}: ${text}`);
      assert.equal(await page.getAttribute(`#knob-${name}`, "aria-invalid"), "true");
    }
  }
  await page.fill("#knob-V_0", "-1");
  assert.match((await page.textContent("#told-V_0"))!, /^V_0 = -1 m\/s is not allowed: .* starts at 0\.1 m\/s/);
  assert.equal(await page.inputValue("#knob-k"), WRONG.at(-1));
  await quiet(page);
  assert.equal(await page.evaluate(() => location.hash), before);
  await page.fill("#knob-C", "250 N.s/m");
  assert.equal(await page.textContent("#told-C"), "");
  await quiet(page);
  assert.match(await page.evaluate(() => location.hash), /^#C=250&/);
  assert.equal(await page.inputValue("#knob-k"), WRONG.at(-1)); // which waits to be mended
  await page.selectOption("#preset", "Figure 8");
  assert.equal(await page.inputValue("#knob-k"), "5480");
});

test("links lead to the state that they tell, whatever else is in them", async () => {
  const hostile = "<img src=x onerror=alert(1)>";
  const page = await opened();
  for (const [link, expected] of [
    ["C=20&k_t=5480&M_t=750.5&x=eps&y=M_t&show=jerk", "#M_t=750.5&k_t=5480&C=20&x=eps&y=M_t&show=jerk"],
    ["C_kt=160000&mu=0.81&brake_torque=800", "#C_kt=160000&mu=0.81&brake_torque=800&x=C&y=V_0&show=growth"],
    [`C=${hostile}&eps=0.05&${hostile}=1&x=${hostile}&y=C&show=${hostile}`, "#eps=0.05&x=C&y=V_0&show=growth"],
    ["C=-5&V_0=nan&mu=nought&constructor=1&__proto__=2&x=__proto__", "#x=C&y=V_0&show=growth"],
    ["", "#x=C&y=V_0&show=growth"],
  ] as const) {
    await page.goto("about:blank");
    await page.goto(`${address}#${new URLSearchParams(link)}`);
    await quiet(page);
    const first = { hash: await page.evaluate(() => location.hash), fields: await fields(page) };
    assert.equal(first.hash, expected);
    assert.equal(await page.locator("img").count(), 0);
    await page.goto("about:blank");
    await page.goto(`${address}${expected}`);
    await quiet(page);
    assert.equal(await page.evaluate(() => location.hash), expected);
    if (!/[<-]/.test(link)) {
      assert.deepEqual(await fields(page), first.fields);
    }
  }
  await page.goto(`${address}#C=-5&mu=nought&sugar=1`);
  await quiet(page);
  assert.match((await page.textContent("#told-C"))!, /^C = -5 N\.s\/m is not allowed: its range is 0/);
  assert.match((await page.textContent("#alert"))!, /no sugar=1.*mu = nought is not allowed/);
});

test("the keyboard alone turns a knob, and walks on the map", async () => {
  const page = await opened();
  await mapped(page);
  const visited = new Set<string>();
  for (let i = 0; i < 60; i++) {
    await page.keyboard.press("Tab");
    visited.add(await page.evaluate(() => document.activeElement!.id));
  }
  const fields = Object.keys(SPANS).map((name) => `knob-${name}`);
  for (const id of ["preset", ...fields, "play", "time", "csv", "svg", "toml", "map", "x", "y", "show", "slowness"]) {
    assert(visited.has(id), `Tab does not reach ${id}`);
  }
  await page.focus("#knobs input[type=range]");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.inputValue("#knob-C"), "505");
  const outline = await page.evaluate(() => getComputedStyle(document.activeElement!).outlineStyle);
  assert.equal(outline, "solid");
  await page.focus("#map");
  await page.keyboard.press("ArrowRight");
  await quiet(page);
  assert.match(await page.evaluate(() => location.hash), /^#C=608&x/);
  assert.match((await page.getAttribute("#map", "aria-label"))!, /^Map over C and V_0.*growth of the swing/);
});

test("the page works from the disk as well", async () => {
  const page = await opened();
  await page.goto(`${file}#C=100&eps=0.1`);
  await mapped(page);
  assert.equal(await page.inputValue("#preset"), "Figure 9");
  assert.equal(await page.locator("#map svg g[aria-label=rect] rect").count(), 600);
});

test("a click on the map takes its values, which are those that it shows", async () => {
  const page = await opened("show=jerk&x=C&y=M_t");
  await mapped(page);
  await page.locator("#map svg g[aria-label=rect] rect").nth(30 * 15 + 20).click({ force: true });
  await quiet(page);
  assert.match(await page.evaluate(() => location.hash), /^#M_t=1570&C=1400&/);
  await download(page, "csv", "clicked.csv");
  const rows = readFileSync(join(out, "clicked.csv"), "utf8").trim().split("\r\n").slice(1);
  const a_car = rows.map((row) => Number(row.split(",")[3]));
  const jerks = a_car.slice(11).map((a, i) => Math.abs(a - a_car[i + 10]!) / 0.01); // from 0.1 s on
  const label = (await page.getAttribute("#map", "aria-label"))!;
  assert.equal(label.match(/peak jerk .*: ([\d.]+)/)![1], Math.max(...jerks).toPrecision(3));
});

for (const [name, options] of Object.entries({
  desktop: { viewport: { width: 1400, height: 900 } },
  dark: { viewport: { width: 1400, height: 900 }, colorScheme: "dark" },
  phone: { viewport: { width: 390, height: 844 } },
} as Record<string, BrowserContextOptions>)) {
  test(`every control has a name, every text contrast, and nothing is cut off: ${name}`, async () => {
    const page = await opened("C=-1&eps=0.1&sigma=0.3", options);
    await mapped(page);
    await page.click("summary");
    await page.addScriptTag({ content: axe });
    const { violations } = await page.evaluate(() => (globalThis as any).axe.run());
    assert.deepEqual(violations.map(({ id, nodes }: any) => [id, ...nodes.map(({ html }: any) => html)]), []);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), options.viewport!.width);
    await page.screenshot({ path: join(out, `${name}.png`), fullPage: true });
  });
}
