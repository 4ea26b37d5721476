// Chromium, driven through a pipe by its debugging protocol: needs nothing but Node.js.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const kPatience = 200000; // ms for one answer: machines that do much else take long

export async function openBrowser(program, switches = []) {
  const profile = mkdtempSync(join(tmpdir(), "curvefusion_chromium_"));
  const child = spawn(
    program,
    ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
     "--enable-unsafe-swiftshader", "--no-first-run", "--disable-component-update",
     "--disable-background-networking", "--hide-scrollbars", "--force-color-profile=srgb",
     `--user-data-dir=${profile}`, "--remote-debugging-pipe", ...switches, "about:blank"],
    { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const ended = new Promise((resolve) => child.on("exit", resolve));
  const [, , , write, read] = child.stdio;
  const answers = new Map();
  const listeners = [];
  let buffer = "";
  let id = 0;

  read.setEncoding("utf8");
  read.on("data", (text) => {
    const messages = (buffer + text).split("\0");
    buffer = messages.pop();
    for (const message of messages.map((m) => JSON.parse(m))) {
      if (answers.has(message.id)) {
        const { resolve, reject } = answers.get(message.id);
        answers.delete(message.id);
        if (message.error) reject(new Error(JSON.stringify(message.error)));
        else resolve(message.result);
      } else {
        for (const listener of listeners) listener(message);
      }
    }
  });

  function send(method, params = {}, sessionId = undefined) {
    ++id;
    const answer = new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`${method}: no answer`)), kPatience);
      answers.set(id, {
        resolve: (result) => { clearTimeout(timer); resolve(result); },
        reject: (error) => { clearTimeout(timer); reject(error); },
      });
    });
    write.write(JSON.stringify({ id, method, params, sessionId }) + "\0");
    return answer;
  }

  // A page of a size in pixels; without any network unless `offline` is false. `problems` collects
  // what goes wrong in it.
  async function openPage(url, { width, height, dark = false, offline = true }) {
    const { targetId } = await send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
    const problems = [];
    const requests = [];
    let loaded;
    const load = new Promise((resolve) => { loaded = resolve; });
    listeners.push((message) => {
      if (message.sessionId !== sessionId) return;
      const { method, params } = message;
      if (method === "Runtime.exceptionThrown") {
        problems.push(params.exceptionDetails.exception?.description || params.exceptionDetails.text);
      }
      if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type)) {
        problems.push(params.args.map((arg) => arg.value ?? arg.description).join(" "));
      }
      if (method === "Log.entryAdded" && params.entry.level === "error") problems.push(params.entry.text);
      if (method === "Network.requestWillBeSent") requests.push(params.request.url);
      if (method === "Page.loadEventFired") loaded();
    });
    const call = (method, params) => send(method, params, sessionId);
    for (const domain of ["Runtime", "Log", "Network", "Page"]) await call(`${domain}.enable`);
    await call("Network.emulateNetworkConditions",
               { offline, latency: 0, downloadThroughput: offline ? 0 : -1, uploadThroughput: offline ? 0 : -1 });
    await call("Emulation.setDeviceMetricsOverride",
               { width, height, deviceScaleFactor: 1, mobile: false });
    await call("Emulation.setEmulatedMedia",
               { features: [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }] });
    const start = Date.now();
    await call("Page.navigate", { url });
    await Promise.race([load, new Promise((_, reject) =>
      setTimeout(() => reject(new Error(`${url}: does not load`)), kPatience).unref())]);
    const load_ms = Date.now() - start;

    // The value of an expression or of the promise that it is.
    async function evaluate(expression) {
      const { result, exceptionDetails } = await call("Runtime.evaluate",
        { expression, awaitPromise: true, returnByValue: true });
      if (exceptionDetails) {
        throw new Error(`${expression}: ${exceptionDetails.exception?.description || exceptionDetails.text}`);
      }
      return result.value;
    }

    // Until what was changed is on the screen.
    const settle = () => evaluate(
      "new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(r, 60))))");

    // A PNG, as base64, of what is visible, or of a part of the page.
    async function screenshot(clip) {
      await settle();
      const options = clip ? { clip: { ...clip, scale: 1 }, captureBeyondViewport: true } : {};
      return (await call("Page.captureScreenshot", { format: "png", ...options })).data;
    }

    async function click(x, y) {
      for (const type of ["mousePressed", "mouseReleased"]) {
        await call("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: 1, clickCount: 1 });
      }
      await settle();
    }

    async function press(key) {
      for (const type of ["keyDown", "keyUp"]) await call("Input.dispatchKeyEvent", { type, key });
      await settle();
    }

    await settle();
    return { evaluate, screenshot, click, press, problems, requests, load_ms, settle,
             close: () => send("Target.closeTarget", { targetId }) };
  }

  async function close() {
    await send("Browser.close").catch(() => {});
    await ended;
    rmSync(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  }

  return { openPage, close };
}
