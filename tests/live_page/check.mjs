// node check.mjs CHROMIUM ADDRESS SECONDS PNG: looks at the page of a live run that has just begun.
// With a PNG it only draws a picture of the page after so many seconds of scanning.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { openBrowser } from "../report_page/browser.mjs";

const [chromium, address, seconds, png] = process.argv.slice(2);
const kPatience = 300000; // ms

const browser = await openBrowser(chromium);
const page = await browser.openPage(address, { width: 1280, height: 1000, offline: false });
const text = (selector) => page.evaluate(`document.querySelector(${JSON.stringify(selector)}).innerText`);
const state = () => page.evaluate("LivePage.page.state");

async function until(what, condition) {
  const start = Date.now();
  while (!(await page.evaluate(condition))) {
    assert.ok(Date.now() - start < kPatience, `${what}: waited for in vain`);
    await new Promise((resolve) => setTimeout(resolve, 150));
  }
}

// How many pixels of the view differ from its first one.
async function ink() {
  const box = await page.evaluate(`(() => {
    const b = document.querySelector("#canvas").getBoundingClientRect();
    return { x: b.x + scrollX, y: b.y + scrollY, width: b.width, height: b.height };
  })()`);
  const picture = await page.screenshot(box);
  return page.evaluate(`new Promise((resolve) => {
    const image = new Image();
    image.onload = () => {
      const canvas = document.createElement("canvas");
      canvas.width = image.width;
      canvas.height = image.height;
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      const data = context.getImageData(0, 0, image.width, image.height).data;
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        const off = Math.abs(data[i] - data[0]) + Math.abs(data[i + 1] - data[1]) + Math.abs(data[i + 2] - data[2]);
        if (off > 60) ++count;
      }
      resolve(count);
    };
    image.src = "data:image/png;base64,${picture}";
  })`);
}

async function draw() {
  await until("the scan", `LivePage.page.state && LivePage.page.state.seconds >= ${seconds} && LivePage.page.curves`);
  await page.evaluate(`document.querySelector("#reset").click()`);
  writeFileSync(png, Buffer.from(await page.screenshot(), "base64"));
}

async function look() {
  await until("the first snapshot", "LivePage.page.curves !== null && LivePage.page.curves.curves.edges.length > 0");
  assert.equal(await text("#phase"), "Scanning");
  const first = await state();
  assert.ok(first.frames.arrived >= 30);
  const drawn = await ink();
  // Parts of a cube's wires cross a view of some 800 x 600 pixels.
  assert.ok(drawn > 2000, `only ${drawn} pixels are drawn`);
  assert.match(await text("#key-figures"), /Frames a second\s+[\d.]+/);
  assert.match(await text("#what-to-do"), /\w/);

  const hints = await page.evaluate(`document.querySelectorAll("#hints button").length`);
  assert.equal(hints, await page.evaluate("LivePage.page.curves.hints.length"));
  assert.ok(hints > 0, "after a second nothing was seen from all sides");
  await page.evaluate(`document.querySelector("#hints button").click()`);
  assert.match(await text("#selection"), /Evidence\s+\d+ %/);
  assert.ok((await ink()) > 500, "looking from a hint shows nothing");

  for (const button of ["#fit-cameras", "#from-camera"]) {
    await page.evaluate(`document.querySelector("${button}").click()`);
    assert.ok((await ink()) > 200, `${button} shows nothing`);
  }

  await until("another snapshot", `LivePage.page.state.snapshot.number > ${first.snapshot.number} &&
                                   LivePage.page.curves.number === LivePage.page.state.snapshot.number`);
  const later = await state();
  assert.ok(later.frames.arrived > first.frames.arrived);
  await page.evaluate(`document.querySelector("#reset").click()`);
  await until("the reconstruction", `LivePage.page.state.phase !== "scanning"`);
  await until("the end", `LivePage.page.state.phase === "done"`);
  assert.match(await text("#what-to-do"), /report\.html/);
}

try {
  await (png ? draw() : look());
  assert.deepEqual(page.problems, [], "the console has errors");
  const others = page.requests.filter((request) => !request.startsWith(address) && !request.startsWith("data:"));
  assert.deepEqual(others, [], "the page asks for others than the program");
  console.log("the page of a live run is as it should be");
} finally {
  await browser.close();
}
