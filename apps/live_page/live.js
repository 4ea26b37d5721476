// Shows a live run: asks for its state again and again, and for its curves when they are others.
"use strict";

const LivePage = (() => {
  const STEP = 400; // ms from question to question
  const PATIENCE = 3; // questions without an answer before the page says so
  const GROWTH = 1.2; // the view is fitted again where the curves have grown so much

  const byId = (id) => document.getElementById(id);
  const grouped = (x) => Math.round(x).toString().replace(/\B(?=(\d{3})+$)/g, ",");
  const percent = (share) => `${Math.round(100 * share)} %`;

  function element(name, attributes, ...content) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes || {})) {
      if (key === "onclick") made.addEventListener("click", value);
      else made.setAttribute(key, value);
    }
    made.append(...content.filter((part) => part !== null && part !== undefined));
    return made;
  }

  const PHASES = {
    waiting: ["Waiting for the first frame", "Start the camera."],
    scanning: ["Scanning", ""],
    reconstructing: ["Reconstructing the whole scan", "The capture has ended. What is shown below is the last snapshot."],
    done: ["Done", "The result lies in the output folder: open its report.html."],
  };

  const page = { state: null, curves: null, viewer: null, chosen: null, center: null, fitted: 0,
                 turned: false, unanswered: 0 };

  // The share of the length that is known, a curve with half of the evidence counting half.
  function knownShare() {
    const figures = page.curves ? page.curves.figures : [];
    const length = figures.reduce((sum, f) => sum + f.length_mm, 0);
    return length > 0 ? figures.reduce((sum, f) => sum + f.length_mm * f.evidence, 0) / length : null;
  }

  function advice() {
    if (page.state.phase !== "scanning") return PHASES[page.state.phase][1];
    if (!page.curves) return "The first curves appear after a second of scanning.";
    const hints = page.curves.hints.length;
    const ends = page.state.snapshot.free_ends;
    if (hints) return "Go where the arrows come from: these curves were seen from few sides.";
    if (ends) return `Look at the free ends (${ends}): does the wire go on there?`;
    return "Everything that was found has enough evidence.";
  }

  function showHead() {
    const { state } = page;
    byId("phase").textContent = PHASES[state.phase][0];
    document.title = `${PHASES[state.phase][0]} – CurveFusion live`;
    byId("what-to-do").textContent = advice();
    const known = knownShare();
    const { frames, snapshot } = state;
    const figures = [
      ["Frames a second", state.frame_rate.toFixed(1), ""],
      ["Frames", grouped(frames.arrived), ""],
      ["Dropped", grouped(frames.dropped), ""],
      frames.lost ? ["Camera lost in", grouped(frames.lost), "frames"] : null,
      ["Snapshot behind", snapshot.number ? snapshot.seconds_behind.toFixed(1) : "–", "s"],
      ["Curves", grouped(snapshot.curves), ""],
      ["Length in all", grouped(1000 * snapshot.length), "mm"],
      ["Free ends", grouped(snapshot.free_ends), ""],
      ["Evidence", known === null ? "–" : percent(known), ""],
    ].filter((figure) => figure);
    byId("key-figures").replaceChildren(...figures.map(([what, value, unit]) =>
      element("div", {}, element("dt", {}, what),
              element("dd", {}, value, unit ? element("small", {}, ` ${unit}`) : null))));
  }

  function describe() {
    const { chosen, curves } = page;
    const figures = curves && chosen !== null ? curves.figures[chosen] : null;
    if (!figures) {
      byId("selection").replaceChildren();
      return;
    }
    const ends = figures.free_ends.filter((free) => free).length;
    const facts = [
      ["Evidence", percent(figures.evidence)],
      ["Images that saw it", `${grouped(figures.frames)} of those looked at`],
      ["Seen from sides", `${figures.spread_degrees} degrees apart`],
      ["Length", `${grouped(figures.length_mm)} mm`],
      ["Free ends", String(ends)],
    ];
    byId("selection").replaceChildren(
      element("h3", {}, `Curve ${chosen}`),
      element("dl", { class: "facts" }, ...facts.flatMap(([what, value]) =>
        [element("dt", {}, what), element("dd", {}, value)])));
  }

  function select(index) {
    page.chosen = index;
    if (page.viewer) page.viewer.select(index);
    describe();
  }

  function showHints() {
    const hints = page.curves ? page.curves.hints : [];
    byId("hints-heading").hidden = hints.length === 0;
    byId("hints").replaceChildren(...hints.map((hint) => {
      const figures = page.curves.figures[hint.curve];
      return element("li", {}, element("button", {
        type: "button",
        onclick: () => {
          select(hint.curve);
          page.turned = true;
          if (page.viewer) page.viewer.follow(hint);
        },
      }, `Curve ${hint.curve}, ${grouped(figures.length_mm)} mm: sides ${figures.spread_degrees}° apart`));
    }));
  }

  // Around the middle of the first curves, so that what is shown stays where it is.
  function centerOf(curves) {
    const numbers = curves.edges.flatMap((edge) => edge.points);
    const middle = (axis) => {
      const values = numbers.filter((_, i) => i % 3 === axis);
      return (Math.min(...values) + Math.max(...values)) / 2;
    };
    return numbers.length ? [0, 1, 2].map(middle) : null;
  }

  function extentOf(curves) {
    let extent = 0;
    for (const { points } of curves.edges) {
      for (let i = 0; i < points.length; i += 3) {
        extent = Math.max(extent, Math.hypot(...page.center.map((c, k) => points[i + k] - c)));
      }
    }
    return extent;
  }

  function showView() {
    const { curves, state, viewer } = page;
    if (!viewer || !curves || !curves.curves.edges.length) return;
    if (!page.turned) page.center = centerOf(curves.curves);
    viewer.show({ ...curves, center: page.center, frames: state.camera ? [state.camera] : [] });
    const extent = extentOf(curves.curves);
    if (!page.turned && (extent > GROWTH * page.fitted || page.fitted > GROWTH * extent)) {
      page.fitted = extent;
      viewer.reset();
    }
  }

  function show() {
    showHead();
    showView();
    showHints();
    if (page.chosen !== null && page.curves && page.chosen >= page.curves.figures.length) select(null);
    describe();
  }

  async function ask(file) {
    const answer = await fetch(file, { cache: "no-store" });
    if (!answer.ok) throw new Error(`${file}: ${answer.status}`);
    return answer.json();
  }

  function showGone() {
    const done = page.state && page.state.phase === "done";
    byId("gone").hidden = done || page.unanswered < PATIENCE;
    byId("gone").textContent = "The program does not answer any more: it has ended. What it found lies in its " +
      "output folder.";
  }

  async function update() {
    try {
      page.state = await ask("state.json");
      const number = page.curves ? page.curves.number : 0;
      if (page.state.snapshot.number !== number) page.curves = await ask("curves.json");
      page.unanswered = 0;
      show();
    } catch (error) {
      if (!(error instanceof TypeError)) throw error; // a fetch that found nobody
      ++page.unanswered;
    }
    showGone();
    if (!page.state || page.state.phase !== "done") setTimeout(update, STEP);
  }

  function start() {
    const ramp = CurveViewer.ramps.evidence.map(CurveViewer.css).join(",");
    byId("ramp").style.background = `linear-gradient(90deg, ${ramp})`;
    page.viewer = CurveViewer.create(byId("canvas"), { selected: select });
    byId("no-view").hidden = page.viewer !== null;
    document.querySelectorAll(".controls input").forEach((input) => {
      input.addEventListener("change", () => page.viewer && page.viewer.set({ [input.name]: input.checked }));
    });
    byId("reset").addEventListener("click", () => {
      page.turned = false;
      page.fitted = 0;
      if (page.curves) showView();
    });
    const turnTo = (button, view) => byId(button).addEventListener("click", () => {
      if (!page.viewer || !page.curves || !page.state.camera) return;
      page.turned = true;
      view();
    });
    turnTo("fit-cameras", () => page.viewer.fitCameraPath());
    turnTo("from-camera", () => page.viewer.lookFrom(page.state.camera));
    for (const touch of ["pointerdown", "wheel", "keydown"]) {
      byId("canvas").addEventListener(touch, () => { page.turned = true; });
    }
    byId("canvas").addEventListener("keydown", (event) => {
      if (event.key === "Escape") select(null);
    });
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      if (page.viewer) page.viewer.restyle();
    });
    update();
  }

  return { start, page };
})();

LivePage.start();
