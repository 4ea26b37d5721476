// Turning, zooming and moving a camera around a point, by pointer, wheel, touch and keys.
"use strict";

const Orbit = (() => {
  const STEEPEST = 1.55; // radians from the horizon: at the pole left and right would swap
  const TURN = 0.006; // radians a pixel
  const KEY_TURN = 0.12; // radians a key press
  const KEY_MOVE = 0.06; // of the distance a key press
  const ZOOM = 1.2; // a key press or a notch of the wheel

  // Turns `camera` around a point. `changed` is called after every change, `clicked(x, y)` with
  // pixels of the element where a pointer went down and up at one place.
  function create(camera, element, { changed, clicked }) {
    const state = { target: new THREE.Vector3(), distance: 1, yaw: 0, pitch: 0.3 };
    const axes = {
      up: new THREE.Vector3(0, 0, 1),
      front: new THREE.Vector3(0, -1, 0),
      right: new THREE.Vector3(1, 0, 0),
    };
    const limits = { nearest: 1, farthest: 1e5 };
    let home = null;

    function apply() {
      state.pitch = Math.min(STEEPEST, Math.max(-STEEPEST, state.pitch));
      state.distance = Math.min(limits.farthest, Math.max(limits.nearest, state.distance));
      const level = Math.cos(state.pitch) * state.distance;
      camera.position
        .copy(state.target)
        .addScaledVector(axes.front, level * Math.cos(state.yaw))
        .addScaledVector(axes.right, level * Math.sin(state.yaw))
        .addScaledVector(axes.up, Math.sin(state.pitch) * state.distance);
      camera.up.copy(axes.up);
      camera.near = Math.max(state.distance / 100, limits.nearest / 10);
      camera.far = state.distance + 4 * limits.farthest;
      camera.lookAt(state.target);
      camera.updateProjectionMatrix();
      camera.updateMatrixWorld();
      changed();
    }

    function turn(dx, dy) {
      state.yaw -= dx;
      state.pitch += dy;
      apply();
    }

    function zoom(factor) {
      state.distance /= factor;
      apply();
    }

    // Moves what is seen by shares of the distance, to the right and up.
    function move(right, up) {
      const matrix = camera.matrixWorld;
      const x = new THREE.Vector3().setFromMatrixColumn(matrix, 0);
      const y = new THREE.Vector3().setFromMatrixColumn(matrix, 1);
      state.target.addScaledVector(x, -right * state.distance);
      state.target.addScaledVector(y, -up * state.distance);
      apply();
    }

    function movePixels(dx, dy) {
      const visible = 2 * Math.tan((camera.fov * Math.PI) / 360) / element.clientHeight;
      move(dx * visible, -dy * visible);
    }

    const pointers = new Map();
    let travelled = 0;

    function spread() {
      const [a, b] = [...pointers.values()];
      return Math.hypot(a.x - b.x, a.y - b.y);
    }

    element.addEventListener("pointerdown", (event) => {
      element.setPointerCapture(event.pointerId);
      if (pointers.size === 0) travelled = 0;
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    });

    element.addEventListener("pointermove", (event) => {
      const pointer = pointers.get(event.pointerId);
      if (!pointer) return;
      const dx = event.clientX - pointer.x;
      const dy = event.clientY - pointer.y;
      const before = pointers.size === 2 ? spread() : 0;
      pointer.x = event.clientX;
      pointer.y = event.clientY;
      travelled += Math.abs(dx) + Math.abs(dy);
      if (pointers.size === 2) {
        movePixels(dx / 2, dy / 2);
        if (before > 0) zoom(spread() / before);
      } else if (event.shiftKey || event.buttons & 6) {
        movePixels(dx, dy);
      } else {
        turn(dx * TURN, dy * TURN);
      }
    });

    function release(event) {
      const lone = pointers.size === 1;
      if (!pointers.delete(event.pointerId)) return;
      if (event.type !== "pointerup" || !lone || travelled > 4 || event.button !== 0) return;
      const box = element.getBoundingClientRect();
      clicked(event.clientX - box.left, event.clientY - box.top);
    }
    element.addEventListener("pointerup", release);
    element.addEventListener("pointercancel", release);
    element.addEventListener("contextmenu", (event) => event.preventDefault());

    element.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const notch = event.deltaMode === 0 ? 100 : 3; // pixels, or lines
        zoom(Math.pow(ZOOM, Math.max(-3, Math.min(3, -event.deltaY / notch))));
      },
      { passive: false }
    );

    const keys = {
      ArrowLeft: () => turn(KEY_TURN, 0),
      ArrowRight: () => turn(-KEY_TURN, 0),
      ArrowUp: () => turn(0, KEY_TURN),
      ArrowDown: () => turn(0, -KEY_TURN),
      "+": () => zoom(ZOOM),
      "=": () => zoom(ZOOM),
      "-": () => zoom(1 / ZOOM),
      Home: () => reset(),
    };
    const shiftedKeys = {
      ArrowLeft: () => move(-KEY_MOVE, 0),
      ArrowRight: () => move(KEY_MOVE, 0),
      ArrowUp: () => move(0, KEY_MOVE),
      ArrowDown: () => move(0, -KEY_MOVE),
    };
    element.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const action = (event.shiftKey && shiftedKeys[event.key]) || keys[event.key];
      if (!action) return;
      event.preventDefault();
      action();
    });

    // How far off a sphere fills the view.
    function distanceTo(radius) {
      const half = (camera.fov * Math.PI) / 360;
      const narrowest = Math.atan(Math.tan(half) * Math.min(1, camera.aspect));
      return (1.05 * radius) / Math.sin(narrowest);
    }

    function fit(center, radius) {
      state.target.copy(center);
      state.distance = distanceTo(radius);
      apply();
    }

    function reset() {
      if (!home) return;
      Object.assign(state, { yaw: 0.35, pitch: 0.3 });
      fit(home.target, home.radius);
    }

    return {
      // What stays upright, and from where things are seen at first; both of unit length.
      setAxes(up, towards) {
        axes.up.copy(up);
        axes.front.copy(towards).addScaledVector(up, -towards.dot(up)).normalize();
        axes.right.crossVectors(up, axes.front).normalize();
      },
      // A sphere that fills the view from the start.
      setHome(center, radius) {
        limits.nearest = radius / 100;
        limits.farthest = radius * 40;
        home = { target: center.clone(), radius };
      },
      // Looks from a place towards a direction, at things about as far off as the home target.
      lookFrom(position, direction) {
        const ahead = home ? home.target.clone().sub(position).dot(direction) : 0;
        state.distance = Math.max(ahead, limits.nearest);
        state.target.copy(position).addScaledVector(direction, state.distance);
        state.pitch = Math.asin(Math.max(-1, Math.min(1, -direction.dot(axes.up))));
        state.yaw = Math.atan2(-direction.dot(axes.right), -direction.dot(axes.front));
        apply();
      },
      fit,
      reset,
    };
  }

  return { create };
})();
