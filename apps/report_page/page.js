// Fills the page of a result from its data: show(data). All texts go in as text, never as HTML.
"use strict";

const ReportPage = (() => {
  const SELECTED_LINE = "rgb(226, 0, 122)";
  const OVERLAY_LINE = "rgba(0, 140, 220, 0.75)";
  const MOST_ROWS = 1000; // of the table of curves
  const NEAREST = 50; // mm before a camera, below which nothing is drawn

  const byId = (id) => document.getElementById(id);
  const grouped = (x) => Math.round(x).toString().replace(/\B(?=(\d{3})+$)/g, ",");
  const isNumber = (x) => typeof x === "number";
  const number = (x, digits) => (isNumber(x) ? x.toFixed(digits) : "unknown");
  const percent = (share) => (isNumber(share) ? `${Math.round(100 * share)} %` : "unknown");
  const millimetres = (metres) => (isNumber(metres) ? `${grouped(1000 * metres)} mm` : "unknown");
  const counted = (n, noun) => `${grouped(n)} ${noun}${n === 1 ? "" : "s"}`;
  const seconds = (s) => (s < 10 ? `${s.toFixed(1)} s` : `${grouped(s)} s`);
  const megabytes = (bytes) => `${grouped(bytes / 1e6)} MB`;

  // element("td", {class: "number"}, "12", child, ...)
  function element(name, attributes, ...content) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes || {})) {
      if (key === "onclick") made.addEventListener("click", value);
      else made.setAttribute(key, value);
    }
    made.append(...content.filter((part) => part !== null && part !== undefined));
    return made;
  }

  function bar(share, lost) {
    const fill = element("i");
    fill.style.width = `${Math.max(0, Math.min(1, share || 0)) * 100}%`;
    return element("span", { class: lost ? "bar lost" : "bar", "aria-hidden": "true" }, fill);
  }

  function facts(list, pairs) {
    list.replaceChildren(
      ...pairs.filter(([, value]) => value).flatMap(([what, value]) => [
        element("dt", {}, what), element("dd", {}, value),
      ]));
  }

  function diameterRange(edges) {
    const known = edges.map((edge) => edge.diameter_mm).filter((d) => d > 0);
    if (!known.length) return null;
    return [Math.min(...known), Math.max(...known)].map((d) => d.toFixed(1));
  }

  function diameterText(edges) {
    const range = diameterRange(edges);
    if (!range) return "unknown";
    return range[0] === range[1] ? range[0] : `${range[0]}–${range[1]}`;
  }

  // The share of images with something at a curve, of those that looked there; null: not counted.
  function evidenceOf(edge) {
    return edge.images && edge.images.looked > 0 ? edge.images.seen / edge.images.looked : null;
  }

  function evidenceText(edge) {
    if (evidenceOf(edge) === null) return "not counted";
    return `${edge.images.seen} of ${edge.images.looked} images`;
  }

  // --- head ---

  function showHead(data) {
    const { report } = data;
    document.title = `${data.title}: reconstruction`;
    byId("title").textContent = data.title;
    const of = `${counted(report.sequence.frames, "image pair")} of depth and colour`;
    byId("summary").textContent = data.nothing_found
      ? `Nothing thin was found in ${of}.`
      : `Made from ${of}, in ${seconds(report.seconds)}.`;
    const { skeleton } = report;
    const figures = [
      ["Curves", grouped(skeleton.edges), ""],
      ["Length in all", grouped(1000 * skeleton.length), "mm"],
      ["Diameter", diameterText(skeleton.per_edge), "mm"],
      ["Junctions", grouped(skeleton.junctions), ""],
      ["Free ends", grouped(skeleton.free_ends), ""],
      ["Separate parts", grouped(skeleton.components), ""],
    ];
    byId("key-figures").hidden = Boolean(data.nothing_found);
    byId("key-figures").replaceChildren(...figures.map(([what, value, unit]) =>
      element("div", {}, element("dt", {}, what),
              element("dd", {}, value, unit && value !== "unknown" ? element("small", {}, ` ${unit}`) : null))));
  }

  function showNothing(data) {
    const box = byId("nothing");
    box.hidden = !data.nothing_found;
    if (!data.nothing_found) return;
    const left = data.uncertain.edges.length
      ? `What may be thin but could not be proven is drawn in grey below (${
        counted(data.uncertain.edges.length, "uncertain curve")}, in uncertain.json). If these are wires, “--set evidence.min_probability=0” keeps them.`
      : null;
    box.replaceChildren(
      element("h2", {}, "Nothing thin was found"),
      element("p", {}, `The main reason: ${data.nothing_found}.`),
      left ? element("p", {}, left) : "",
      element("p", {}, data.report.depth?.use === "none"
        ? "Without depth, wires show that stand out from all that is around them, in 40 sharp " +
          "images or more from 40 degrees around, with poses in metres that are exact to some " +
          "pixels."
        : "Thin parts show where they are 2 to 12 mm thick, 0.5 to 0.7 m away, some centimetres " +
          "in front of other things, and not black to the infrared camera. “curvefusion check” " +
          "tells whether the camera's poses and the unit of depth fit."));
  }

  function showWarnings(data) {
    const warnings = [...data.report.warnings];
    if (!data.nothing_found && !data.report.mesh) {
      warnings.unshift("The tubes could not be joined to one closed surface, so there is no mesh.");
    }
    byId("warnings").hidden = warnings.length === 0;
    byId("warnings").replaceChildren(
      element("h2", {}, warnings.length === 1 ? "Warning" : `${warnings.length} warnings`),
      element("ul", {}, ...warnings.map((warning) =>
        element("li", {}, warning.charAt(0).toUpperCase() + warning.slice(1)))));
  }

  // --- figures ---

  function showTrust(data) {
    const { trust } = data.report;
    byId("trust-section").hidden = Boolean(data.nothing_found);
    if (!trust) {
      byId("trust").replaceChildren(element("p", {}, "The paper's method does not judge its own " +
        "results. The default method (--profile best) does."));
      return;
    }
    const shares = [
      ["Likely wire", trust.wire_share,
       "of the length, by the probabilities of all curves. The rest may be edges of other things."],
      ["Seen in depth images", trust.depth_share,
       "of the length was measured in at least half of the depth images that looked there."],
      ["Seen in colour images", trust.colour_share,
       "of the length shows in the colour images as a band with two edges."],
      ["Diameter measured", trust.measured_diameter_share,
       "of the length has a diameter that was measured; the rest was given that of the thinnest wires."],
    ];
    const rows = shares.flatMap(([what, share, why]) => [
      element("span", { class: "what" }, what), element("span", { class: "number" }, percent(share)),
      bar(share), element("span", { class: "why" }, why),
    ]);
    const adjusted = trust.adjusted_to_colour
      ? `Curves now lie ${number(trust.residual_px, 2)} pixels beside the wires in the colour images (${
        number(trust.residual_before_px, 2)} before curves and poses were adjusted to them).`
      : "Curves and poses were not adjusted to the colour images.";
    const moved = `The camera's positions were corrected by ${number(trust.pose_shift_mm, 1)} mm and ${
      number(trust.pose_turn_degrees, 2)} degrees (median), at most by ${
      number(trust.max_pose_shift_mm, 1)} mm.`;
    const seen = `The camera saw the object from ${
      number(trust.view_angle_degrees, 0)} degrees of directions.`;
    byId("trust").replaceChildren(element("div", { class: "trust" }, ...rows),
                                  element("p", {}, adjusted, " ", moved, " ", seen));
  }

  function showFunnel(data) {
    const f = data.report.funnel;
    const rows = [];
    const part = (title) => rows.push(element("tr", { class: "part" },
      element("th", { colspan: "3", scope: "rowgroup" }, title)));
    const row = (what, value, share, lost) => rows.push(
      element("tr", { class: lost ? "lost" : "kept" }, element("th", { scope: "row" }, what),
              element("td", { class: "number" }, value),
              element("td", { class: "wide" }, bar(share, lost))));
    const lostRow = (what, value, total, text) => {
      if (value > 0) row(what, `− ${text(value)}`, value / total, true);
    };
    part("Pixels of the depth images");
    row("with a depth", grouped(f.depth_pixels), 1);
    row("in front of large surfaces", grouped(f.thin_pixels), f.thin_pixels / f.depth_pixels);
    row("of these not coloured like what is behind", grouped(f.thin_pixels_after_colour_gate),
        f.thin_pixels_after_colour_gate / f.depth_pixels);
    part("Points in space");
    row("candidates from these pixels", grouped(f.candidate_points), 1);
    const lostPoints = [
      ["seen in too few frames", "too_few_frames"],
      ["in clusters too small for a thin part", "small_clusters"],
      ["without edges in the colour images", "colour_unverified"],
      ["far from all others", "isolated"],
    ];
    for (const [what, key] of lostPoints) {
      lostRow(what, f.dropped_points[key], f.candidate_points, grouped);
    }
    row("kept", grouped(f.points), f.points / f.candidate_points);
    part("Length of curves");
    row("found in these points", millimetres(f.contracted_length), 1);
    const lostCurves = [
      ["edges of surfaces (to uncertain curves)", "surface_edge"],
      ["thicker than wires (to uncertain curves)", "thick"],
      ["depth images see what is behind (to uncertain curves)", "looked_past_by_depth"],
      ["too little evidence (to uncertain curves)", "unproven"],
      ["colour images see what is behind (dropped)", "looked_past"],
    ];
    const sum = lostCurves.reduce((total, [, key]) => total + f.dropped_length[key], 0);
    for (const [what, key] of lostCurves) {
      lostRow(what, f.dropped_length[key], f.contracted_length, millimetres);
    }
    const change = f.length - (f.contracted_length - sum);
    if (Math.abs(change) >= 0.0005) {
      row("by joining, smoothing and colour images",
          `${change > 0 ? "+" : "−"} ${millimetres(Math.abs(change))}`,
          Math.abs(change) / f.contracted_length);
    }
    row("in the result", millimetres(f.length), f.length / f.contracted_length);
    byId("funnel").replaceChildren(element("tbody", {}, ...rows));
  }

  function countText([name, value]) {
    return `${name} ${Number.isInteger(value) ? grouped(value) : Number(value.toPrecision(3))}`;
  }

  function showStages(data) {
    const { report } = data;
    const stages = report.stages.map((stage) => ({ ...stage }));
    if (report.mesh) {
      stages.push({ name: "tubes", seconds: report.mesh.seconds,
                    counts: { vertices: report.mesh.vertices, faces: report.mesh.faces } });
    }
    const longest = Math.max(...stages.map((stage) => stage.seconds), 1e-9);
    const rows = stages.map((stage) => element("tr", {},
      element("th", { scope: "row" }, stage.name),
      element("td", { class: "number" }, seconds(stage.seconds)),
      element("td", { class: "wide" }, bar(stage.seconds / longest)),
      element("td", {}, stage.remark ||
        Object.entries(stage.counts).map(countText).join(", "))));
    rows.push(element("tr", {}, element("th", { scope: "row" }, "the whole run"),
      element("td", { class: "number" }, seconds(report.seconds)), element("td", { class: "wide" }),
      element("td", {}, `${megabytes(report.peak_memory_bytes)} of memory at most`)));
    byId("stages").replaceChildren(
      element("thead", {}, element("tr", {}, ...["Stage", "Time", "", "Counts"].map((title, i) =>
        element("th", i === 2 ? { class: "wide", scope: "col" } :
          { scope: "col", class: i === 1 ? "number" : "" }, title)))),
      element("tbody", {}, ...rows));
  }

  function showSettings(data) {
    const { settings, report } = data;
    if (!settings.length) {
      byId("settings").replaceChildren(element("p", {},
        `Profile “${report.profile}”, with all settings as they are by default.`));
      return;
    }
    const rows = settings.map((s) => element("tr", {}, element("th", { scope: "row" }, s.name),
      element("td", { class: "number" }, `${s.value} ${s.unit}`.trim()),
      element("td", { class: "number" }, `${s.initial} ${s.unit}`.trim()),
      element("td", {}, s.description)));
    byId("settings").replaceChildren(
      element("p", {}, `Profile “${report.profile}”; these settings differ from its defaults:`),
      element("div", { class: "scroll" }, element("table", {},
        element("thead", {}, element("tr", {},
          ...["Setting", "Here", "Default", "Meaning"].map((title, i) => element("th",
            { scope: "col", class: i === 1 || i === 2 ? "number" : "" }, title)))),
        element("tbody", {}, ...rows))));
  }

  const cameraText = (camera) =>
    `${camera.width} × ${camera.height} pixels, focal length ${camera.fx.toFixed(1)} pixels`;

  function posesText(poses) {
    if (poses.from !== "tracking") return "given with the scan";
    return `tracked by CurveFusion, with ${counted(poses.keyframes, "keyframe")}` +
      (poses.lost.length ? `; ${counted(poses.lost.length, "frame")} could not be placed` : "");
  }

  const DEPTH_USES = {
    wires: "the curves",
    background: "surfaces and scale; curves come from colour",
    none: "nothing; curves come from colour, scale from the poses",
  };

  function showScan(data) {
    const { sequence, cameras, poses, depth } = data.report;
    const dropped = [
      [sequence.frames_without_pose, "without a pose"],
      [sequence.frames_without_partner, "with a colour or depth image only"],
    ].filter(([count]) => count > 0).map(([count, why]) => `${grouped(count)} ${why}`);
    facts(byId("scan"), [
      ["Folder", sequence.folder],
      ["Layout", sequence.format],
      ["Frames", grouped(sequence.frames) + (dropped.length ? `; left out: ${dropped.join(", ")}` : "")],
      ["Poses", posesText(poses)],
      ...(depth ? [["Depth used for", `${DEPTH_USES[depth.use]} (${depth.why})`]] : []),
      ["Depth camera", cameraText(cameras.depth)],
      ["Colour camera", cameraText(cameras.color) +
        (cameras.color_from === "fit" ? " (fitted to the images)" : "")],
    ]);
  }

  const FILE_MEANINGS = {
    "skeleton.json": "the curves with their junctions and diameters",
    "uncertain.json": "curves that may be thin but are no proven wires",
    "mesh.ply": "the tubes, each part a closed surface, in metres; for a printer: curvefusion mesh skeleton.json --for print -o wires.3mf",
    "hybrid.ply": "the tubes and the solid parts they are attached to, as one closed surface",
    "hybrid.stl": "the same in millimetres, for printing",
    "solid_parts.ply": "these parts without the tubes, for mesh --solids after edits of the skeleton",
    "preview.png": "a picture of the result",
    "trajectory.txt": "the camera's poses, as corrected",
    "report.json": "all figures of this page, for programs",
    "config.toml": "all settings of the run; use them again with --config",
    "report_nothing_found.json": "all figures of this page, for programs",
    "config_nothing_found.toml": "all settings of the run; use them again with --config",
  };

  function showFiles(data) {
    byId("files").replaceChildren(...data.files.map((name) => element("li", {},
      element("a", { href: encodeURIComponent(name) }, name),
      element("span", {}, `: ${FILE_MEANINGS[name] || "a file of the result"}`))));
  }

  // --- view, images and table of curves, which share the curve that is chosen ---

  let page = null; // data, viewer, chosen, order of the table

  function describe(index) {
    const { data } = page;
    const proven = data.curves.edges.length;
    const steps = element("div", { class: "steps" },
      element("button", { type: "button", onclick: () => step(-1) }, "Previous"),
      element("button", { type: "button", onclick: () => step(1) }, "Next"),
      index === null ? null :
        element("button", { type: "button", onclick: () => select(null) }, "None"));
    if (index === null) {
      byId("selection").replaceChildren(
        element("p", { class: "hint" }, "Click a curve in the view to see its diameter, its length " +
          "and on how many images it rests."), steps);
      return;
    }
    const list = element("dl", { class: "facts" });
    if (index >= proven) {
      facts(list, [
        ["Length", millimetres(lengthOf(data.uncertain.edges[index - proven]) / 1000)],
        ["What it is", "may be thin, but is no proven wire: it is in none of the figures and not in the mesh"],
      ]);
      byId("selection").replaceChildren(
        element("h3", {}, `Uncertain curve ${index - proven}`), list, steps);
      return;
    }
    const edge = data.report.skeleton.per_edge[index];
    facts(list, [
      ["Diameter", edge.diameter_mm ? `${number(edge.diameter_mm, 2)} mm` + (edge.diameter_error_mm
        ? ` ± ${number(edge.diameter_error_mm, 2)} mm` : "") : "unknown"],
      ["Length", millimetres(edge.length)],
      ["Seen in depth images", evidenceOf(edge) === null ? "not counted"
        : `${evidenceText(edge)} that looked there (${percent(evidenceOf(edge))})`],
      ["Diameter measured", edge.strips ? `at ${counted(edge.strips, "place")} in colour images`
        : edge.diameter_mm ? "nowhere on this curve; the diameter is an assumption" : "nowhere"],
      ["Ends", endsText(index)],
    ]);
    byId("selection").replaceChildren(element("h3", {}, `Curve ${index}`), list, steps);
  }

  function endsText(index) {
    const [a, b] = page.data.curves.edges[index].nodes;
    if (a === b && page.degree[a] === 2) return "none: it is closed";
    const kind = (node) => (page.degree[node] >= 3 ? `junction of ${page.degree[node]}` :
      page.degree[node] === 2 ? "joint" : "free end");
    return `${kind(a)}, ${kind(b)}`;
  }

  function lengthOf(edge) {
    let length = 0;
    for (let i = 3; i < edge.points.length; i += 3) {
      length += Math.hypot(...[0, 1, 2].map((k) => edge.points[i + k] - edge.points[i + k - 3]));
    }
    return length;
  }

  function select(index) {
    page.chosen = index;
    describe(index);
    if (page.viewer) page.viewer.select(index);
    page.images.forEach(markInImage);
    page.rows.forEach((row, i) => row.classList.toggle("chosen", i === index));
    const row = page.rows.get(index);
    if (row) {
      const box = row.closest(".scroll");
      box.scrollTop = Math.max(0, row.offsetTop - box.clientHeight / 2);
    }
  }

  function step(by) {
    const count = page.data.curves.edges.length || page.data.uncertain.edges.length;
    if (!count) return;
    const at = page.chosen === null || page.chosen >= count ? (by > 0 ? -1 : 0) : page.chosen;
    select((at + by + count) % count);
  }

  const CURVE_COLUMNS = [
    ["Curve", (edge, i) => i, (edge, i) => String(i)],
    ["Length, mm", (edge) => edge.length, (edge) => grouped(1000 * edge.length)],
    ["Diameter, mm", (edge) => edge.diameter_mm, (edge) => number(edge.diameter_mm, 2)],
    ["± mm", (edge) => edge.diameter_error_mm,
     (edge) => (edge.diameter_error_mm ? number(edge.diameter_error_mm, 2) : "assumed")],
    ["Seen in depth", (edge) => evidenceOf(edge), (edge) => evidenceText(edge)],
    ["Diameter measured at", (edge) => edge.strips, (edge) => counted(edge.strips, "place")],
  ];

  function rowOf(edge, index) {
    return element("tr", {}, ...CURVE_COLUMNS.map(([, , text], column) => {
      if (column > 0) return element("td", { class: "number" }, text(edge, index));
      return element("td", {}, element("button", {
        type: "button", "aria-label": `Choose curve ${index}`, onclick: () => select(index),
      }, text(edge, index)));
    }));
  }

  function showCurves(data) {
    const edges = data.report.skeleton.per_edge;
    byId("curves-section").hidden = edges.length === 0;
    const listed = edges.map((_, i) => i);
    if (listed.length > MOST_ROWS) {
      listed.sort((a, b) => edges[b].length - edges[a].length).length = MOST_ROWS;
      listed.sort((a, b) => a - b);
    }
    byId("curves-left-out").textContent = listed.length === edges.length ? ""
      : `These are the ${grouped(MOST_ROWS)} longest of ${grouped(edges.length)}; report.json lists all.`;
    page.rows = new Map(listed.map((i) => [i, rowOf(edges[i], i)]));
    const body = element("tbody", {}, ...page.rows.values());
    let sorted = { column: 0, descending: false };
    const heads = CURVE_COLUMNS.map(([title], column) => element("th", {
      scope: "col", class: column ? "number" : "" },
      element("button", { type: "button", onclick: () => sortBy(column) }, title)));
    function sortBy(column) {
      sorted = { column, descending: sorted.column === column ? !sorted.descending : column > 0 };
      const key = (i) => {
        const value = CURVE_COLUMNS[column][1](edges[i], i);
        return isNumber(value) ? value : -1;
      };
      const order = [...listed].sort((a, b) =>
        (sorted.descending ? key(b) - key(a) : key(a) - key(b)) || a - b);
      body.replaceChildren(...order.map((i) => page.rows.get(i)));
      markSorted();
    }
    function markSorted() {
      heads.forEach((head, column) => head.setAttribute("aria-sort",
        column !== sorted.column ? "none" : sorted.descending ? "descending" : "ascending"));
    }
    markSorted();
    byId("curves").replaceChildren(element("thead", {}, element("tr", {}, ...heads)), body);
  }

  // Pixel of a point (mm) in a frame's image; null behind the camera.
  function pixelIn(frame, x, y, z) {
    const [u, v, w] = frame.T_camera_world.map(
      (row) => row[0] * x + row[1] * y + row[2] * z + row[3]);
    if (w < NEAREST) return null;
    return { u: (frame.fx * u) / w + frame.cx, v: (frame.fy * v) / w + frame.cy, depth: w };
  }

  // As thick as the wire; a line begins anew where the thickness has changed by a sixth.
  function drawCurve(context, frame, edge, colour, extra) {
    let before = null;
    let width = 0;
    context.strokeStyle = colour;
    context.beginPath();
    for (let i = 0; i < edge.points.length; i += 3) {
      const at = pixelIn(frame, edge.points[i], edge.points[i + 1], edge.points[i + 2]);
      if (before && at) {
        const radius = edge.radii[i / 3] || edge.radii[0] || 0;
        const wanted = Math.max(1.6, (2 * radius * frame.fx) / at.depth) + extra;
        if (Math.abs(wanted - width) > wanted / 6) {
          context.stroke();
          context.beginPath();
          context.lineWidth = width = wanted;
        }
        // Pixel (0, 0) of a frame is the centre of its first pixel.
        context.moveTo(before.u + 0.5, before.v + 0.5);
        context.lineTo(at.u + 0.5, at.v + 0.5);
      }
      before = at;
    }
    context.stroke();
  }

  // An image with all curves, which stays as it is whatever curve is chosen.
  function drawAllCurves({ frame, image, drawn }) {
    const context = drawn.getContext("2d");
    context.drawImage(image, 0, 0, frame.width, frame.height);
    if (!byId("overlay").checked) return;
    for (const edge of page.data.curves.edges) drawCurve(context, frame, edge, OVERLAY_LINE, 0);
  }

  function markInImage({ frame, canvas, drawn }) {
    const { data, chosen } = page;
    const context = canvas.getContext("2d");
    context.drawImage(drawn, 0, 0);
    const proven = data.curves.edges.length;
    if (chosen === null) return;
    const edge = chosen < proven ? data.curves.edges[chosen] : data.uncertain.edges[chosen - proven];
    drawCurve(context, frame, edge, SELECTED_LINE, 2);
  }

  function redrawImages() {
    for (const shown of page.images) {
      drawAllCurves(shown);
      markInImage(shown);
    }
  }

  function showFrames(data) {
    byId("frames-section").hidden = data.frames.length === 0;
    const found = data.curves.edges.length > 0;
    byId("overlay-control").hidden = !found;
    byId("frames-heading").textContent =
      found ? "The curves in the images of the scan" : "What the camera saw";
    byId("frames-hint").textContent = found
      ? "Each curve should cover a wire, and each wire should be covered. Parts that something else hides are drawn all the same."
      : "Are the thin parts that you wanted in these images, near and sharp?";
    page.images = [];
    byId("frames").replaceChildren(...data.frames.map((frame) => {
      const canvas = element("canvas", { width: frame.width, height: frame.height, role: "img",
                                         "aria-label": `Frame ${frame.name} of the scan` });
      const image = new Image();
      image.onload = () => {
        const drawn = element("canvas", { width: frame.width, height: frame.height });
        const shown = { frame, canvas, image, drawn };
        page.images.push(shown);
        drawAllCurves(shown);
        markInImage(shown);
      };
      image.src = frame.image;
      const look = page.viewer && element("button", { type: "button", onclick: () => {
        page.viewer.lookFrom(frame);
        byId("canvas").scrollIntoView({ block: "center" });
      } }, "View from here");
      return element("figure", {}, canvas,
        element("figcaption", {}, `Frame ${frame.name}`, look || null));
    }));
  }

  function showLegend() {
    const { viewer, data } = page;
    const colour = document.querySelector("input[name=colour]:checked").value;
    const gradient = (ramp) => `linear-gradient(to right, ${ramp.map(CurveViewer.css).join(",")})`;
    const parts = [];
    const ramp = (title, colours, ends) => {
      const strip = element("div", { class: "ramp" });
      strip.style.background = gradient(colours);
      parts.push(element("p", {}, title), strip,
                 element("div", { class: "ends" }, ...ends.map((end) => element("span", {}, end))));
    };
    const found = data.curves.edges.length > 0;
    if (!found) {
      parts.push(element("p", {}, "Nothing of this is a proven wire"));
    } else if (colour === "evidence") {
      ramp("Seen in depth images (red: by few, which need not be wrong)", CurveViewer.ramps.evidence, ["0 %", "50 %", "100 %"]);
    } else if (colour === "diameter") {
      const range = viewer.diameterRange();
      if (range) ramp("Diameter", CurveViewer.ramps.diameter, range.map((d) => `${d.toFixed(1)} mm`));
      else parts.push(element("p", {}, "No diameter is known"));
    } else {
      parts.push(element("p", {}, "Every curve in a colour of its own"));
    }
    const key = (name, text, style) => {
      const mark = element("span", { class: `key ${name}` });
      if (style) mark.style.background = style;
      return element("span", {}, mark, text);
    };
    parts.push(element("div", { class: "keys" },
      found ? key("junction", "junction") : null, found ? key("end", "free end") : null,
      data.uncertain.edges.length ? key("", "uncertain", CurveViewer.css(CurveViewer.GREY)) : null,
      key("", "camera", "#4a7bd0")));
    byId("legend").replaceChildren(...parts);
  }

  const viewData = (data) => ({
    curves: data.curves, uncertain: data.uncertain, up: data.up, towards_viewer: data.towards_viewer,
    camera_path: data.camera_path, frames: data.frames,
    figures: data.report.skeleton.per_edge.map((edge) => ({
      evidence: evidenceOf(edge), diameter: edge.diameter_mm })),
  });

  function openViewer() {
    byId("viewer").hidden = false;
    const viewer = CurveViewer.create(byId("canvas"), { selected: select });
    byId("viewer").hidden = viewer === null;
    return viewer;
  }

  function showView(data) {
    const anything = data.curves.edges.length + data.uncertain.edges.length > 0;
    byId("view-section").hidden = !anything;
    if (!anything) return;
    if (!page.viewer) page.viewer = openViewer();
    const { viewer } = page;
    byId("no-view").hidden = viewer !== null;
    byId("preview").hidden = viewer !== null || !data.preview;
    if (viewer === null) {
      byId("no-view").textContent = (typeof THREE === "undefined"
        ? "This page was written by a program that was built without three.js, so it has no 3D view. "
        : "This browser shows no 3D graphics (WebGL is off), so there is no 3D view. ") +
        (data.preview ? "A picture of the result takes its place; all figures are below." :
          "All figures are below.");
      if (data.preview) byId("preview").src = data.preview;
      return;
    }
    const counted_evidence = data.report.skeleton.per_edge.some((edge) => evidenceOf(edge) !== null);
    const evidence = document.querySelector("input[name=colour][value=evidence]");
    evidence.disabled = !counted_evidence;
    if (evidence.disabled && evidence.checked) {
      document.querySelector("input[name=colour][value=diameter]").checked = true;
      viewer.set({ colour: "diameter" });
    }
    for (const control of ["colour-control", "nodes-control"]) {
      byId(control).hidden = data.curves.edges.length === 0;
    }
    byId("fit-camera").hidden = data.camera_path.length === 0;
    byId("uncertain-control").hidden = data.uncertain.edges.length === 0;
    byId("drawn").textContent = `Curves are drawn to within ${data.tolerance_mm} mm; skeleton.json ` +
      "holds them in full.";
    viewer.show(viewData(data));
    showLegend();
  }

  function wireControls() {
    document.querySelectorAll("#viewer input").forEach((input) =>
      input.addEventListener("change", () => {
        page.viewer.set({ [input.name]: input.type === "checkbox" ? input.checked : input.value });
        showLegend();
      }));
    byId("reset").addEventListener("click", () => page.viewer.reset());
    byId("fit-camera").addEventListener("click", () => page.viewer.fitCameraPath());
    byId("overlay").addEventListener("change", redrawImages);
    byId("canvas").addEventListener("keydown", (event) => {
      const actions = { n: () => step(1), p: () => step(-1), escape: () => select(null) };
      const action = actions[event.key.toLowerCase()];
      if (action && !event.ctrlKey && !event.metaKey && !event.altKey) action();
    });
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      if (page.viewer) page.viewer.restyle();
    });
    window.addEventListener("hashchange", selectByHash);
  }

  // report.html#curve=12 opens with that curve chosen.
  function selectByHash() {
    const wanted = /^#curve=(\d+)$/.exec(location.hash);
    if (wanted && Number(wanted[1]) < page.data.curves.edges.length) select(Number(wanted[1]));
  }

  // Shows a result in place of the one before, if there is one.
  function show(data) {
    if (page === null) {
      page = { viewer: null, chosen: null, rows: new Map(), images: [] };
      wireControls();
    }
    page.data = data;
    page.chosen = null;
    page.degree = data.curves.nodes.map(() => 0);
    for (const edge of data.curves.edges) for (const node of edge.nodes) ++page.degree[node];
    for (const part of [showHead, showNothing, showWarnings, showView, showTrust, showFrames,
                        showCurves, showFunnel, showStages, showSettings, showScan, showFiles]) {
      part(data);
    }
    describe(null);
    if (page.viewer) page.viewer.select(null);
    selectByHash();
  }

  return { show, viewer: () => page.viewer, select: (index) => select(index) };
})();

ReportPage.show(JSON.parse(document.getElementById("data").textContent));
