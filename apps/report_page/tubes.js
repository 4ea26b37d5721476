// Triangles of tubes around curves, with round ends, so that the tubes of a junction close it.
"use strict";

const Tubes = (() => {
  const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
  ];
  const unit = (a) => {
    const length = Math.hypot(a[0], a[1], a[2]) || 1;
    return [a[0] / length, a[1] / length, a[2] / length];
  };

  // Any direction across a tangent.
  function across(tangent) {
    const least = tangent.map(Math.abs);
    const axis = least.indexOf(Math.min(...least));
    return unit(cross(tangent, [axis === 0 ? 1 : 0, axis === 1 ? 1 : 0, axis === 2 ? 1 : 0]));
  }

  function tangentsOf(points) {
    return points.map((_, i) =>
      unit(subtract(points[Math.min(i + 1, points.length - 1)], points[Math.max(i - 1, 0)]))
    );
  }

  // A ring of corners: centre, radius, and how far its normals lean along the tangent.
  function ringsOf(points, radii, tangents) {
    const rings = points.map((p, i) => ({ p, tangent: tangents[i], radius: radii[i], lean: 0 }));
    const first = rings[0];
    const last = rings[rings.length - 1];
    for (const lean of [0.7071, 1]) {
      const cap = (end, sign) => ({
        p: end.p.map((x, k) => x + sign * lean * end.radius * end.tangent[k]),
        tangent: end.tangent,
        radius: end.radius * Math.sqrt(1 - lean * lean),
        lean: sign * lean,
      });
      rings.unshift(cap(first, -1));
      rings.push(cap(last, 1));
    }
    return rings;
  }

  function appendTube(mesh, points, radii, sides) {
    const start = mesh.positions.length / 3;
    let side = null;
    for (const ring of ringsOf(points, radii, tangentsOf(points))) {
      const t = ring.tangent;
      // The direction of the ring before, turned into this ring's plane: tubes do not twist.
      const carried = side && subtract(side, t.map((x) => x * dot(side, t)));
      side = carried && dot(carried, carried) > 1e-6 ? unit(carried) : across(t);
      const other = cross(t, side);
      const level = Math.sqrt(1 - ring.lean * ring.lean);
      for (let k = 0; k < sides; ++k) {
        const angle = (2 * Math.PI * k) / sides;
        const c = Math.cos(angle);
        const s = Math.sin(angle);
        for (let axis = 0; axis < 3; ++axis) {
          const outwards = c * side[axis] + s * other[axis];
          mesh.positions.push(ring.p[axis] + ring.radius * outwards);
          mesh.normals.push(level * outwards + ring.lean * t[axis]);
        }
      }
    }
    const rings = (mesh.positions.length / 3 - start) / sides;
    for (let r = 0; r + 1 < rings; ++r) {
      for (let k = 0; k < sides; ++k) {
        const a = start + r * sides + k;
        const b = start + r * sides + ((k + 1) % sides);
        mesh.indices.push(a, b, a + sides, b, b + sides, a + sides);
      }
    }
    return { start, count: rings * sides };
  }

  // Corners around a curve, so that large results stay below a few million triangles.
  function sidesFor(point_count) {
    return point_count > 60000 ? 4 : point_count > 20000 ? 6 : 10;
  }

  // One mesh of all curves ({points: [[x, y, z], ...], radii: one a point}), and which of its
  // vertices belong to which curve.
  function build(curves, sides) {
    const mesh = { positions: [], normals: [], indices: [] };
    const ranges = curves.map((curve) => appendTube(mesh, curve.points, curve.radii, sides));
    const geometry = new THREE.BufferGeometry();
    const colours = new Float32Array(mesh.positions.length).fill(0.6);
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(mesh.indices), 1));
    const attribute = (values) => new THREE.BufferAttribute(new Float32Array(values), 3);
    geometry.setAttribute("position", attribute(mesh.positions));
    geometry.setAttribute("normal", attribute(mesh.normals));
    geometry.setAttribute("color", attribute(colours));
    return { geometry, ranges };
  }

  return { build, sidesFor };
})();
