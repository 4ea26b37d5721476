// node check.mjs CHROMIUM FOLDER NAME: looks at FOLDER/result/report.html, of a scan called NAME,
// and at FOLDER/nothing/report.html, of a run that found nothing. Ends with 1 where one fails.
import assert from "node:assert/strict";
import { existsSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { openBrowser } from "./browser.mjs";

const [chromium, folder, scan_name] = process.argv.slice(2);
const result_page = join(folder, "result", "report.html");
const report = JSON.parse(readFileSync(join(folder, "result", "report.json")));
const desktop = { width: 1280, height: 900 };
const phone = { width: 420, height: 800 };

// How many pixels of a picture differ from its first one, which is background, and a sum that
// changes with the picture.
function countInk(page, png) {
  return page.evaluate(`new Promise((resolve) => {
    const image = new Image();
    image.onload = () => {
      const canvas = document.createElement("canvas");
      canvas.width = image.width;
      canvas.height = image.height;
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      const data = context.getImageData(0, 0, image.width, image.height).data;
      let ink = 0, hash = 0;
      for (let i = 0; i < data.length; i += 4) {
        const off = Math.abs(data[i] - data[0]) + Math.abs(data[i + 1] - data[1]) + Math.abs(data[i + 2] - data[2]);
        if (off > 60) ++ink;
        hash = (hash * 31 + data[i] + 7 * data[i + 1] + 13 * data[i + 2]) % 1000003;
      }
      resolve({ ink, hash });
    };
    image.src = "data:image/png;base64,${png}";
  })`);
}

async function pictureOfView(page) {
  const box = await page.evaluate(`(() => {
    const b = document.querySelector("#canvas").getBoundingClientRect();
    return { x: b.x + scrollX, y: b.y + scrollY, width: b.width, height: b.height };
  })()`);
  return countInk(page, await page.screenshot(box));
}

const text = (page, selector) => page.evaluate(`document.querySelector(${JSON.stringify(selector)}).innerText`);
const isShown = (page, selector) =>
  page.evaluate(`document.querySelector(${JSON.stringify(selector)}).checkVisibility()`);

function assertUntroubled(page, url) {
  assert.deepEqual(page.problems, [], "the console has errors");
  const others = page.requests.filter((request) => request !== url && !request.startsWith("data:"));
  assert.deepEqual(others, [], "the page asks for other files");
}

async function withPage(browser, file, view, look) {
  const url = pathToFileURL(file).href;
  const page = await browser.openPage(url + (view.hash || ""), view);
  await look(page);
  assertUntroubled(page, url);
  await page.close();
}

const checks = {
  "the page shows the figures of report.json and has one file for all": (browser) =>
    withPage(browser, result_page, desktop, async (page) => {
      assert.ok(statSync(result_page).size < 8e6);
      assert.equal(await text(page, "#title"), scan_name);
      const figures = await text(page, "#key-figures");
      assert.match(figures, new RegExp(`Curves\\s+${report.skeleton.edges}\\b`));
      assert.match(figures, new RegExp(`Junctions\\s+${report.skeleton.junctions}\\b`));
      assert.equal(await page.evaluate(`document.querySelectorAll("#curves tbody tr").length`),
                   report.skeleton.edges);
      assert.match(await text(page, "#settings"), /radius\.max_frames\s+25 frames\s+30 frames/);
      assert.equal(await page.evaluate(`document.querySelectorAll("#frames canvas").length`), 6);
      assert.equal(await page.evaluate(`document.querySelectorAll("h1 b").length`), 0);
    }),

  "links lead to files that are there": (browser) =>
    withPage(browser, result_page, desktop, async (page) => {
      const names = await page.evaluate(
        `[...document.querySelectorAll("#files a")].map((a) => a.getAttribute("href"))`);
      for (const name of ["skeleton.json", "mesh.ply", "report.json", "config.toml"]) {
        assert.ok(names.includes(name), `no link to ${name}`);
      }
      for (const name of names) assert.ok(existsSync(join(folder, "result", name)), name);
    }),

  "the view draws, turns, and follows its controls": (browser) =>
    withPage(browser, result_page, desktop, async (page) => {
      const first = await pictureOfView(page);
      // The cube's 13 wires cross a view of some 800 x 500 pixels, several pixels wide.
      assert.ok(first.ink > 5000, `only ${first.ink} pixels are drawn`);
      let before = first;
      const expectChange = async (what) => {
        const now = await pictureOfView(page);
        assert.notEqual(now.hash, before.hash, `${what} changes nothing`);
        assert.ok(now.ink > 500, `${what} leaves ${now.ink} pixels`);
        before = now;
      };
      for (const control of ["[name=colour][value=diameter]", "[name=colour][value=curve]",
                             "[name=shape][value=lines]", "[name=nodes]"]) {
        await page.evaluate(`document.querySelector("${control}").click()`);
        await expectChange(control);
      }
      await page.evaluate(`document.querySelector("#canvas").focus()`);
      for (const key of ["ArrowLeft", "ArrowUp", "+"]) {
        await page.press(key);
        await expectChange(key);
      }
      await page.evaluate(`document.querySelector("#fit-camera").click()`);
      await expectChange("the camera's path");
    }),

  "a click on a curve shows its figures": (browser) =>
    withPage(browser, result_page, desktop, async (page) => {
      let hits = 0;
      for (let i = 0; i < report.skeleton.edges; ++i) {
        const at = await page.evaluate(`(() => {
          const box = document.querySelector("#canvas").getBoundingClientRect();
          const p = ReportPage.viewer().pixelOf(${i});
          return { x: box.x + p.x, y: box.y + p.y };
        })()`);
        await page.evaluate(`ReportPage.select(null)`);
        await page.click(at.x, at.y);
        const shown = await text(page, "#selection");
        if (!shown.includes(`Curve ${i}\n`)) continue;
        ++hits;
        const edge = report.skeleton.per_edge[i];
        assert.ok(shown.includes(`${edge.diameter_mm.toFixed(2)} mm`), shown);
        assert.ok(shown.includes(`${Math.round(1000 * edge.length)} mm`), shown);
        assert.ok(shown.includes(`${edge.images.seen} of ${edge.images.looked} images`), shown);
        assert.ok(await page.evaluate(
          `document.querySelectorAll("#curves tbody tr")[${i}].classList.contains("chosen")`));
      }
      // Some of a cube's wires are hidden by others where they are in the middle.
      assert.ok(hits >= 0.7 * report.skeleton.edges, `${hits} of ${report.skeleton.edges} were hit`);
      const empty = await page.evaluate(`(() => {
        const box = document.querySelector("#canvas").getBoundingClientRect();
        return { x: box.x + 5, y: box.y + 5 };
      })()`);
      await page.click(empty.x, empty.y);
      assert.doesNotMatch(await text(page, "#selection"), /Diameter/);
    }),

  "keys go from curve to curve, addresses name one": (browser) =>
    withPage(browser, result_page, { ...desktop, hash: "#curve=3" }, async (page) => {
      assert.match(await text(page, "#selection"), /^Curve 3\n/);
      await page.evaluate(`document.querySelector("#canvas").focus()`);
      await page.press("n");
      assert.match(await text(page, "#selection"), /^Curve 4\n/);
      await page.press("p");
      await page.press("p");
      assert.match(await text(page, "#selection"), /^Curve 2\n/);
      await page.press("Escape");
      assert.doesNotMatch(await text(page, "#selection"), /^Curve/);
    }),

  "a chosen curve shows in the images of the scan": (browser) =>
    withPage(browser, result_page, desktop, async (page) => {
      const chosen_pixels = `[...document.querySelectorAll("#frames canvas")].map((canvas) => {
        const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
        let count = 0;
        for (let i = 0; i < data.length; i += 4) {
          if (Math.abs(data[i] - 226) + data[i + 1] + Math.abs(data[i + 2] - 122) < 12) ++count;
        }
        return count;
      }).reduce((a, b) => a + b)`;
      assert.equal(await page.evaluate(chosen_pixels), 0);
      await page.evaluate(`ReportPage.select(0)`);
      assert.ok(await page.evaluate(chosen_pixels) > 100);
    }),

  "the table sorts by its headings": (browser) =>
    withPage(browser, result_page, desktop, async (page) => {
      const lengths = () => page.evaluate(
        `[...document.querySelectorAll("#curves tbody td:nth-child(2)")].map((td) => Number(td.innerText.replace(",", "")))`);
      await page.evaluate(`document.querySelectorAll("#curves th button")[1].click()`);
      const falling = await lengths();
      assert.deepEqual(falling, [...falling].sort((a, b) => b - a));
      assert.ok(falling[0] > falling.at(-1));
      await page.evaluate(`document.querySelectorAll("#curves th button")[1].click()`);
      assert.deepEqual(await lengths(), [...falling].reverse());
    }),

  "show() takes other data later": (browser) =>
    withPage(browser, result_page, desktop, async (page) => {
      const before = await pictureOfView(page);
      await page.evaluate(`(() => {
        const data = JSON.parse(document.getElementById("data").textContent);
        data.curves.edges.length = 2;
        data.report.skeleton.per_edge.length = 2;
        data.report.skeleton.edges = 2;
        data.report.warnings = ["</script><img src=x onerror=alert(1)>"];
        ReportPage.show(data);
      })()`);
      assert.match(await text(page, "#key-figures"), /Curves\s+2\b/);
      assert.match(await text(page, "#warnings"), /<img src=x/);
      assert.ok((await pictureOfView(page)).ink < before.ink);
    }),

  "narrow and dark, nothing is cut off": async (browser) => {
    for (const view of [phone, { ...desktop, dark: true }, { ...phone, dark: true }]) {
      await withPage(browser, result_page, view, async (page) => {
        assert.ok(await page.evaluate("document.documentElement.scrollWidth") <= view.width);
        const paper = await page.evaluate(
          "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)[0]");
        assert.equal(paper < 80, Boolean(view.dark));
        assert.ok((await pictureOfView(page)).ink > 1000);
      });
    }
  },

  "a run that found nothing tells what took the candidates": (browser) =>
    withPage(browser, join(folder, "nothing", "report.html"), desktop, async (page) => {
      const why = await text(page, "#nothing");
      assert.match(why, /Nothing thin was found/);
      assert.match(why, /The main reason: .{20}/);
      assert.equal(await isShown(page, "#key-figures"), false);
      assert.match(await text(page, "#funnel"), /candidates from these pixels\s+[\d,]+/);
      const names = await page.evaluate(
        `[...document.querySelectorAll("#files a")].map((a) => a.getAttribute("href"))`);
      for (const name of names) assert.ok(existsSync(join(folder, "nothing", name)), name);
    }),
};

const checks_without_webgl = {
  "without WebGL a picture takes the place of the view": (browser) =>
    withPage(browser, result_page, desktop, async (page) => {
      assert.match(await text(page, "#no-view"), /WebGL is off/);
      assert.equal(await isShown(page, "#viewer"), false);
      assert.ok(await page.evaluate(`document.querySelector("#preview").naturalWidth`) > 500);
      assert.equal(await page.evaluate(`document.querySelectorAll("#curves tbody tr").length`),
                   report.skeleton.edges);
      await page.evaluate(`document.querySelector("#curves tbody button").click()`);
      assert.equal(await page.evaluate(
        `document.querySelectorAll("#curves tbody tr")[0].classList.contains("chosen")`), true);
    }),
};

let failures = 0;
for (const [all, switches] of [[checks, []], [checks_without_webgl, ["--disable-3d-apis"]]]) {
  const browser = await openBrowser(chromium, switches);
  for (const [name, check] of Object.entries(all)) {
    try {
      await check(browser);
      console.log(`passed: ${name}`);
    } catch (error) {
      ++failures;
      console.log(`FAILED: ${name}\n  ${error.stack}`);
    }
  }
  await browser.close();
}
process.exit(failures ? 1 : 0);
