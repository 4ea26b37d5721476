// node screenshot.mjs CHROMIUM PAGE PNG [WIDTH [HEIGHT [dark] [full]]]: a picture of a page.
import { writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { openBrowser } from "./browser.mjs";

const [chromium, page_file, png, width = "1280", height = "900", ...flags] = process.argv.slice(2);
const [file, hash] = page_file.split("#");
const browser = await openBrowser(chromium);
const page = await browser.openPage(pathToFileURL(file).href + (hash ? `#${hash}` : ""),
  { width: Number(width), height: Number(height), dark: flags.includes("dark") });
const full = await page.evaluate("document.documentElement.scrollHeight");
const clip = flags.includes("full") && { x: 0, y: 0, width: Number(width), height: full };
writeFileSync(png, Buffer.from(await page.screenshot(clip || undefined), "base64"));
console.log(`${png}: loaded in ${page.load_ms} ms`);
for (const problem of page.problems) console.log(`problem: ${problem}`);
await browser.close();
