// The 3D view: curves as tubes or centre lines, junctions, free ends, the camera's path. It knows
// nothing of the page around it; show(data) may be called again whenever there is more to show.
"use strict";

const CurveViewer = (() => {
  const FIELD_OF_VIEW = 35; // degrees
  const PICK_RADIUS = 9; // pixels beside a curve that still hit it

  const ramps = {
    evidence: [[200, 62, 77], [237, 174, 73], [88, 164, 132], [16, 110, 128]],
    diameter: [[82, 50, 140], [57, 96, 160], [31, 150, 139], [115, 200, 86], [222, 196, 40]],
  };
  // Curves take these in turn.
  const palette = [
    [214, 39, 40], [31, 119, 180], [44, 160, 44], [255, 127, 14], [148, 103, 189],
    [0, 158, 158], [227, 119, 194], [140, 86, 75], [160, 160, 20], [60, 60, 200],
  ];
  const GREY = [150, 154, 160];
  const SELECTED = [226, 0, 122];
  const HINT = [216, 100, 0];

  // The colour at a share of a ramp from 0 to 1.
  function rampColour(ramp, share) {
    const place = Math.max(0, Math.min(1, share)) * (ramp.length - 1);
    const i = Math.min(Math.floor(place), ramp.length - 2);
    return ramp[i].map((from, k) => from + (place - i) * (ramp[i + 1][k] - from));
  }

  function median(values) {
    const sorted = [...values].sort((a, b) => a - b);
    return sorted.length ? sorted[Math.floor(sorted.length / 2)] : 0;
  }

  function pointsOf(edge) {
    const points = [];
    for (let i = 0; i < edge.points.length; i += 3) points.push(edge.points.slice(i, i + 3));
    return points;
  }

  const vector = (p) => new THREE.Vector3(p[0], p[1], p[2]);
  const css = (rgb) => `rgb(${rgb.map(Math.round).join(",")})`;

  function openContext(canvas) {
    const attributes = { alpha: true, antialias: true, powerPreference: "low-power" };
    return canvas.getContext("webgl", attributes) || canvas.getContext("webgl2", attributes);
  }

  // Dots of so many pixels that lie on the surface of what they mark. A ring has a hole.
  function dotMaterial(size, ring) {
    return new THREE.ShaderMaterial({
      uniforms: {
        size: { value: size },
        lift: { value: 0 },
        ink: { value: new THREE.Color() },
        paper: { value: new THREE.Color() },
      },
      vertexShader: `
        uniform float size;
        uniform float lift;
        void main() {
          vec4 p = modelViewMatrix * vec4(position, 1.0);
          vec4 nearer = projectionMatrix * (p + vec4(0.0, 0.0, lift, 0.0));
          gl_Position = projectionMatrix * p;
          gl_Position.z = nearer.z / nearer.w * gl_Position.w;
          gl_PointSize = size;
        }`,
      fragmentShader: `
        uniform vec3 ink;
        uniform vec3 paper;
        void main() {
          float r = 2.0 * length(gl_PointCoord - 0.5);
          if (r > 1.0) discard;
          gl_FragColor = vec4(${ring ? "r < 0.55 ? paper : ink" : "r > 0.78 ? paper : ink"}, 1.0);
        }`,
    });
  }

  // Returns null where the browser has no WebGL, or the page no three.js. `selected(index)` hears of
  // every curve that is picked, and of null; uncertain curves count on after the others.
  function create(parent, { selected }) {
    if (typeof THREE === "undefined") return null;
    const canvas = document.createElement("canvas");
    const context = openContext(canvas);
    if (!context) return null;
    parent.appendChild(canvas);

    const renderer = new THREE.WebGLRenderer({ canvas, context, antialias: true, alpha: true });
    renderer.setClearColor(0, 0);
    renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    const scene = new THREE.Scene();
    const camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, 1, 1e5);
    const headlight = new THREE.DirectionalLight(0xffffff, 0.62);
    headlight.position.set(0.4, 0.7, 1);
    camera.add(headlight, new THREE.AmbientLight(0xffffff, 0.5));
    scene.add(camera);

    const options = {
      colour: "evidence",
      shape: "tubes",
      uncertain: true,
      nodes: true,
      cameras: true,
      hints: true,
    };
    let content = null; // what show() was given, prepared
    let chosen = null;
    let waiting = false;

    function render() {
      waiting = false;
      renderer.render(scene, camera);
    }
    function requestRender() {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(render);
    }

    const orbit = Orbit.create(camera, parent, { changed: requestRender, clicked: pickAt });
    const layers = new THREE.Group();
    const mark = new THREE.Group(); // around the chosen curve
    scene.add(layers, mark);

    function resize() {
      const width = Math.max(1, parent.clientWidth);
      const height = Math.max(1, parent.clientHeight);
      renderer.setSize(width, height, false);
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
      requestRender();
    }
    new ResizeObserver(resize).observe(parent);
    canvas.addEventListener("webglcontextrestored", requestRender);

    function clear(group) {
      for (const child of [...group.children]) {
        group.remove(child);
        child.geometry.dispose();
        child.material.dispose();
      }
    }

    // Curves around the middle of all, as numbers of single precision are fine there only.
    function prepare(data) {
      const all = [...data.curves.edges, ...data.uncertain.edges];
      const shown = data.curves.edges.length ? data.curves.edges : all;
      const box = new THREE.Box3();
      for (const edge of shown) for (const p of pointsOf(edge)) box.expandByPoint(vector(p));
      if (box.isEmpty()) box.setFromCenterAndSize(new THREE.Vector3(), vector([100, 100, 100]));
      const center = data.center ? vector(data.center) : box.getCenter(new THREE.Vector3());
      let radius = 5;
      for (const edge of shown) {
        for (const p of pointsOf(edge)) radius = Math.max(radius, vector(p).distanceTo(center));
      }
      const known = all.filter((edge) => edge.radii.length).map((edge) => edge.radii[0]);
      const typical = known.length ? median(known) : radius / 150;
      const curves = all.map((edge) => {
        const points = pointsOf(edge).map((p) => [p[0] - center.x, p[1] - center.y, p[2] - center.z]);
        const radii = points.map((_, i) => edge.radii[i] || edge.radii[0] || typical);
        return { points, radii, nodes: edge.nodes };
      });
      return { data, curves, center, radius, typical, proven: data.curves.edges.length };
    }

    const figuresOf = (index) => (content.data.figures || [])[index] || {};

    function diameterRange() {
      const known = (content.data.figures || []).map((f) => f.diameter).filter((d) => d > 0);
      return known.length ? [Math.min(...known), Math.max(...known)] : null;
    }

    function colourOf(index) {
      if (options.colour === "curve") return palette[index % palette.length];
      const value = figuresOf(index)[options.colour];
      if (value === null || value === undefined) return GREY;
      if (options.colour === "evidence") return rampColour(ramps.evidence, value);
      const [least, most] = diameterRange();
      return rampColour(ramps.diameter, most - least > 0.05 ? (value - least) / (most - least) : 0.5);
    }

    function paint(geometry, ranges) {
      const colours = geometry.getAttribute("color");
      ranges.forEach(({ start, count }, index) => {
        const rgb = colourOf(index).map((x) => x / 255);
        for (let v = start; v < start + count; ++v) colours.setXYZ(v, rgb[0], rgb[1], rgb[2]);
      });
      colours.needsUpdate = true;
    }

    // Curves with the thickness they are drawn with, of at least a share of the whole view.
    function drawn(curves, least = 0, factor = 1) {
      const line = content.radius / 450;
      const thickness = (r) => (options.shape === "tubes" ? Math.max(r, least * content.radius) : line);
      return curves.map((curve) => ({
        points: curve.points,
        radii: curve.radii.map((r) => factor * thickness(r)),
      }));
    }

    function addMesh(curves, material, group = layers) {
      const count = content.curves.reduce((sum, curve) => sum + curve.points.length, 0);
      const built = Tubes.build(curves, Tubes.sidesFor(count));
      const mesh = new THREE.Mesh(built.geometry, material);
      group.add(mesh);
      return { mesh, ranges: built.ranges };
    }

    function addProven() {
      const curves = drawn(content.curves.slice(0, content.proven));
      if (!curves.length) return;
      const material = new THREE.MeshLambertMaterial({ vertexColors: THREE.VertexColors });
      const { mesh, ranges } = addMesh(curves, material);
      paint(mesh.geometry, ranges);
    }

    function addUncertain() {
      const curves = drawn(content.curves.slice(content.proven), 1 / 700);
      if (!curves.length || !options.uncertain) return;
      addMesh(curves, new THREE.MeshLambertMaterial({
        color: new THREE.Color(css(GREY)), transparent: true, opacity: 0.55,
      }));
    }

    function addDots(positions, size, ring) {
      if (!positions.length) return;
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute(
        "position", new THREE.BufferAttribute(new Float32Array(positions.flat()), 3));
      const material = dotMaterial(size * renderer.getPixelRatio(), ring);
      const thickest = Math.max(content.typical, ...content.data.curves.edges.map(
        (edge) => Math.max(0, ...edge.radii)));
      material.uniforms.lift.value = 2.5 * thickest;
      const style = getComputedStyle(parent);
      material.uniforms.ink.value.set(style.getPropertyValue("--dot").trim() || "#222222");
      material.uniforms.paper.value.set(style.getPropertyValue("--dot-paper").trim() || "#ffffff");
      layers.add(new THREE.Points(geometry, material));
    }

    function addNodes() {
      if (!options.nodes) return;
      const degree = content.data.curves.nodes.map(() => 0);
      for (const edge of content.data.curves.edges) for (const node of edge.nodes) ++degree[node];
      const placed = (wanted) =>
        content.data.curves.nodes
          .filter((_, node) => wanted(degree[node]))
          .map((p) => vector(p).sub(content.center).toArray());
      addDots(placed((d) => d >= 3), 8, false);
      addDots(placed((d) => d === 1), 11, true);
    }

    // Position, right, down and forward of a frame's camera.
    function poseOf(frame) {
      const rows = frame.T_camera_world;
      const axis = (i) => vector(rows[i]);
      const position = new THREE.Vector3();
      for (let i = 0; i < 3; ++i) position.addScaledVector(axis(i), -rows[i][3]);
      return { position: position.sub(content.center), axes: [axis(0), axis(1), axis(2)] };
    }

    function addLines(positions, type, colour, opacity) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(positions), 3));
      const material = new THREE.LineBasicMaterial({ color: colour, transparent: true, opacity });
      layers.add(new type(geometry, material));
    }

    function addCameras() {
      if (!options.cameras) return;
      const path = content.data.camera_path || [];
      const c = content.center.toArray();
      if (path.length > 3) addLines(path.map((x, i) => x - c[i % 3]), THREE.Line, 0x4a7bd0, 0.9);
      const lines = [];
      const reach = content.radius / 7;
      for (const frame of content.data.frames || []) {
        const { position, axes } = poseOf(frame);
        const corner = (u, v) => position.clone()
          .addScaledVector(axes[0], (reach * (u - frame.cx)) / frame.fx)
          .addScaledVector(axes[1], (reach * (v - frame.cy)) / frame.fy)
          .addScaledVector(axes[2], reach).toArray();
        const corners = [corner(0, 0), corner(frame.width, 0), corner(frame.width, frame.height),
                         corner(0, frame.height)];
        corners.forEach((p, i) => lines.push(...position.toArray(), ...p, ...p, ...corners[(i + 1) % 4]));
      }
      if (lines.length) addLines(lines, THREE.LineSegments, 0x4a7bd0, 0.7);
    }

    // Arrows towards places, from where more is to be seen of them.
    function addHints() {
      if (!options.hints) return;
      const stem = content.radius / 3;
      const head = content.radius / 14;
      const colour = new THREE.Color(css(HINT));
      const lines = [];
      for (const hint of content.data.hints || []) {
        const at = vector(hint.at).sub(content.center);
        const from = vector(hint.from);
        const along = (distance) => at.clone().addScaledVector(from, distance);
        lines.push(...along(head).toArray(), ...along(stem).toArray());
        const cone = new THREE.Mesh(new THREE.ConeBufferGeometry(head / 3, head, 12),
                                    new THREE.MeshLambertMaterial({ color: colour }));
        cone.quaternion.setFromUnitVectors(new THREE.Vector3(0, -1, 0), from);
        cone.position.copy(along(0.8 * head));
        layers.add(cone);
      }
      if (lines.length) addLines(lines, THREE.LineSegments, colour, 1);
    }

    // What is chosen shines through what is before it, faintly.
    function markChosen() {
      clear(mark);
      requestRender();
      if (chosen === null) return;
      const curve = drawn([content.curves[chosen]], 1 / 500, 1.3);
      const colour = new THREE.Color(css(SELECTED));
      addMesh(curve, new THREE.MeshBasicMaterial({ color: colour }), mark);
      addMesh(curve, new THREE.MeshBasicMaterial({
        color: colour, depthTest: false, transparent: true, opacity: 0.3,
      }), mark).mesh.renderOrder = 1;
    }

    function rebuild() {
      if (!content) return;
      clear(layers);
      for (const add of [addProven, addUncertain, addNodes, addCameras, addHints]) add();
      markChosen();
    }

    // Pixel of a point, and its distance from the camera.
    function project(p) {
      const v = vector(p).applyMatrix4(camera.matrixWorldInverse);
      const far = -v.z;
      v.applyMatrix4(camera.projectionMatrix);
      return {
        x: ((v.x + 1) / 2) * parent.clientWidth,
        y: ((1 - v.y) / 2) * parent.clientHeight,
        far,
      };
    }

    // How far a pixel is from a stretch of a curve, and how far that is from the camera.
    function distanceTo(x, y, a, b) {
      const dx = b.x - a.x;
      const dy = b.y - a.y;
      const squared = dx * dx + dy * dy;
      const t = squared > 0 ? Math.max(0, Math.min(1, ((x - a.x) * dx + (y - a.y) * dy) / squared)) : 0;
      return { off: Math.hypot(a.x + t * dx - x, a.y + t * dy - y), far: a.far + t * (b.far - a.far) };
    }

    // The nearest of the curves that are drawn under a pixel, otherwise the one that runs nearest
    // beside it.
    function curveAt(x, y) {
      const focal = parent.clientHeight / (2 * Math.tan((FIELD_OF_VIEW * Math.PI) / 360));
      let best = null;
      content.curves.forEach((curve, index) => {
        if (index >= content.proven && !options.uncertain) return;
        let a = project(curve.points[0]);
        for (let i = 1; i < curve.points.length; ++i) {
          const b = project(curve.points[i]);
          if (a.far > 0 && b.far > 0) {
            const { off, far } = distanceTo(x, y, a, b);
            const under = off <= Math.max(2, (curve.radii[i] * focal) / far);
            const better = !best || (under && !best.under) ||
              (under === best.under && (under ? far < best.far : off < best.off));
            if (off <= PICK_RADIUS && better) best = { index, off, far, under };
          }
          a = b;
        }
      });
      return best ? best.index : null;
    }

    function pickAt(x, y) {
      if (content) selected(curveAt(x, y));
    }

    return {
      // `data`: curves and uncertain (nodes, edges), figures (evidence from 0 to 1 and diameter of
      // each curve), up, towards_viewer, camera_path, frames; millimetres. Of a scan that grows also
      // center, around which all is drawn while that stays the same, and hints (at, from: a place
      // and the direction from which to look at it).
      show(data) {
        const first = content === null;
        content = prepare(data);
        if (chosen !== null && chosen >= content.curves.length) chosen = null;
        resize();
        orbit.setAxes(vector(data.up), vector(data.towards_viewer));
        orbit.setHome(new THREE.Vector3(), content.radius);
        if (first) orbit.reset();
        rebuild();
      },
      set(changes) {
        Object.assign(options, changes);
        rebuild();
      },
      select(index) {
        chosen = index;
        if (content) markChosen();
      },
      lookFrom(frame) {
        const { position, axes } = poseOf(frame);
        orbit.lookFrom(position, axes[2].normalize());
      },
      // Looks at a place as a hint asks to.
      follow(hint) {
        const from = vector(hint.from);
        const at = vector(hint.at).sub(content.center);
        orbit.lookFrom(at.addScaledVector(from, 3 * content.radius), from.negate());
      },
      // Where the middle of a curve is drawn, in pixels of the view.
      pixelOf(index) {
        const points = content.curves[index].points;
        const i = Math.floor((points.length - 1) / 2);
        return project(points[i].map((x, k) => (x + points[i + 1][k]) / 2));
      },
      fitCameraPath() {
        const box = new THREE.Box3(vector([-1, -1, -1]), vector([1, 1, 1]));
        box.expandByScalar(content.radius / 2);
        const path = content.data.camera_path;
        for (let i = 0; i < path.length; i += 3) {
          box.expandByPoint(vector(path.slice(i, i + 3)).sub(content.center));
        }
        orbit.fit(box.getCenter(new THREE.Vector3()), box.getSize(new THREE.Vector3()).length() / 2);
      },
      diameterRange,
      reset: orbit.reset,
      restyle: rebuild,
    };
  }

  return { create, ramps, palette, css, GREY, SELECTED, HINT };
})();
