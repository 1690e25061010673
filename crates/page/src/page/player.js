// Plays animations: the simulated poses, drawn like the strips of frames.
function play(root) {
  const animation = JSON.parse(root.querySelector("script").textContent);
  animation.bodies = animation.bodies.map((parts) => parts.map(directed));
  const find = (name) => root.querySelector(name);
  const [range, clock, button] = [find(".scrub"), find(".clock"), find(".play")];
  const last = animation.times.length - 1;
  const stages = [...root.querySelectorAll(".pane")].map((pane, k) => stage(animation, animation.recordings[k], pane, k > 0 && animation.recordings[0]));
  const charts = [...root.querySelectorAll(".chart")].map((svg, m) => chart(animation, m, svg));
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  let now = 0, running = 0;
  let isFresh = true; // the telling instant that is shown first is no place to play from

  const show = (k) => {
    isFresh &&= k === animation.start;
    now = Math.max(0, Math.min(last, Math.round(k)));
    for (const draw of [...stages, ...charts]) draw(now);
    clock.textContent = `${animation.times[now].toFixed(3)} s · step ${animation.steps[now]}`;
    range.value = now;
    range.setAttribute("aria-valuetext", clock.textContent);
  };
  const halt = () => {
    cancelAnimationFrame(running);
    clearInterval(running);
    running = 0;
    root.classList.remove("playing");
    button.setAttribute("aria-label", "Play");
  };
  const go = () => {
    if (now === last || isFresh) show(0);
    isFresh = false;
    root.classList.add("playing");
    button.setAttribute("aria-label", "Pause");
    if (calm.matches) { // a picture a second instead of motion
      const stride = Math.max(1, Math.round(last / 10));
      running = setInterval(() => (now === last ? halt() : show(now + stride)), 1000);
      return;
    }
    let at = animation.times[now], before = performance.now();
    const tick = (time) => {
      at += (Math.max(0, time - before) / 1000) * Number(find(".speed").value);
      before = time;
      let k = now;
      while (k < last && animation.times[k + 1] <= at) k++;
      if (k !== now) show(k);
      if (now === last) return halt();
      running = requestAnimationFrame(tick);
    };
    running = requestAnimationFrame(tick);
  };
  const toggle = () => (running ? halt() : go());
  const step = (by) => { halt(); show(now + by); };

  const camera = turnable(animation, [...root.querySelectorAll(".stage")], find(".untilt"), () => show(now));

  button.addEventListener("click", toggle);
  find(".back").addEventListener("click", () => step(-1));
  find(".on").addEventListener("click", () => step(1));
  range.addEventListener("input", () => { halt(); show(Number(range.value)); });
  find(".arrows").addEventListener("change", (event) => root.classList.toggle("bare", !event.target.checked));
  find(".screen").addEventListener("keydown", (event) => {
    if (event.target.matches("input, select") || event.ctrlKey || event.metaKey || event.altKey) return;
    const keys = event.shiftKey
      ? { ArrowLeft: () => camera(-0.1, 0), ArrowRight: () => camera(0.1, 0), ArrowUp: () => camera(0, 0.1), ArrowDown: () => camera(0, -0.1) }
      : { ArrowLeft: () => step(-1), ArrowRight: () => step(1), Home: () => step(-last), End: () => step(last) };
    if (event.key === " " && !event.target.matches("button")) keys[" "] = toggle;
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
  for (const svg of root.querySelectorAll(".chart")) {
    const [left, right] = animation.plot;
    const seek = (event) => {
      const box = svg.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * svg.viewBox.baseVal.width;
      const time = ((x - left) / (right - left)) * animation.end;
      const apart = animation.times.map((t) => Math.abs(t - time));
      halt();
      show(apart.indexOf(Math.min(...apart)));
    };
    svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); seek(event); });
    svg.addEventListener("pointermove", (event) => event.buttons && seek(event));
  }
  const tabs = [...root.querySelectorAll(".tabs button")], plots = [...root.querySelectorAll(".chart-of")];
  const pick = (chosen) => tabs.forEach((tab, k) => {
    tab.setAttribute("aria-pressed", k === chosen);
    plots[k].hidden = k !== chosen;
  });
  tabs.forEach((tab, k) => tab.addEventListener("click", () => pick(k)));
  const jump = () => { // #frame=12 shows instant 12 of every animation
    const asked = /(?:^#|&)frame=(\d+)/.exec(location.hash);
    if (asked) step(Number(asked[1]) - now);
  };
  addEventListener("hashchange", jump);

  root.classList.add("live");
  find(".screen").hidden = false;
  find(".tabs").hidden = tabs.length < 1;
  find(".toggle").hidden = animation.recordings.every((recording) => recording.forces.every((list) => list.length === 0));
  pick(0);
  show(animation.start);
  jump();
}

// The camera of all recordings: a drag turns it about the pivot, two clicks turn it back. Returns what turns it by angles in rad.
function turnable(animation, stages, back, redraw) {
  const first = animation.camera, middle = animation.middle, soils = stages.map((svg) => svg.querySelector(".soil"));
  const ground = soils.map((soil) => soil.innerHTML);
  const start = [Math.atan2(first[1][0], first[0][0]), Math.asin(first[2][2])];
  let [azimuth, elevation] = start;
  const reset = () => {
    [azimuth, elevation] = start;
    Object.assign(animation, { camera: first, middle });
    soils.forEach((soil, k) => { soil.innerHTML = ground[k]; });
    back.hidden = true;
    redraw();
  };
  const turn = (right, up) => {
    azimuth += right;
    elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, elevation + up));
    const across = [Math.cos(azimuth), Math.sin(azimuth), 0];
    const eye = [across[1] * Math.cos(elevation), -across[0] * Math.cos(elevation), Math.sin(elevation)];
    const upward = cross(eye, across);
    animation.camera = [0, 1, 2].map((k) => [across[k], upward[k], eye[k]]);
    animation.middle = [0, 0];
    animation.middle = seen(animation, animation.pivot).slice(0, 2);
    soils.forEach((soil) => { soil.innerHTML = soilOf(animation); });
    back.hidden = false;
    redraw();
  };
  for (const svg of stages) {
    let from = null;
    svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); from = [event.clientX, event.clientY]; });
    svg.addEventListener("pointermove", (event) => {
      if (!event.buttons || !from) return;
      const [dx, dy] = [event.clientX - from[0], event.clientY - from[1]];
      if (dx === 0 && dy === 0) return;
      from = [event.clientX, event.clientY];
      turn(-0.01 * dx, 0.01 * dy);
    });
    svg.addEventListener("dblclick", reset);
  }
  back.addEventListener("click", reset);
  return turn;
}

// The ground as the camera sees it, in tenths of a px: only its grid from behind.
function soilOf(animation) {
  const at = (p) => place(animation, p).map((px) => Math.round(10 * px)).join(" ");
  return animation.ground.map(({ normal, corners, lines }) => {
    const plane = seen(animation, normal)[2] > 0.02 ? `<path stroke="none" fill="#eef0f3" d="M${corners.map(at).join("L")}z"/>` : "";
    return `${plane}<path fill="none" stroke="#ced1d6" stroke-width="9" d="${lines.map((line) => `M${line.map(at).join("L")}`).join("")}"/>`;
  }).join("");
}

// One measure's cursor and a dot on each curve.
function chart(animation, measure, svg) {
  const [left, right, top, bottom] = animation.plot, [lo, hi] = animation.measures[measure].range;
  const make = (name) => svg.appendChild(document.createElementNS("http://www.w3.org/2000/svg", name));
  const line = make("path");
  line.setAttribute("class", "cursor");
  const colors = [...svg.querySelectorAll(".curve")].map((curve) => curve.getAttribute("style"));
  const dots = animation.recordings.map((_, k) => {
    const dot = make("circle");
    dot.setAttribute("r", 3.6);
    dot.setAttribute("style", colors[k]);
    return dot;
  });
  return (now) => {
    const x = left + (animation.times[now] / animation.end) * (right - left);
    line.setAttribute("d", `M${x.toFixed(1)} ${top}V${bottom}`);
    dots.forEach((dot, k) => {
      const value = animation.recordings[k].measures[measure][now];
      const y = bottom - ((value - lo) / (hi - lo)) * (bottom - top);
      const seen = y >= top - 1 && y <= bottom + 1;
      dot.setAttribute("visibility", seen ? "visible" : "hidden");
      if (seen) { dot.setAttribute("cx", x.toFixed(1)); dot.setAttribute("cy", y.toFixed(1)); }
    });
  };
}

// The running sums of a list of changes, one for each instant.
function grown(list, count) {
  let sum = 0;
  return Array.from({ length: count }, (_, k) => (sum += list[k] || 0));
}

// Position and rotation of each body of a recording at an instant; null is the world.
function posed(animation, recording) {
  const count = recording.forces.length;
  const poses = recording.poses.map((channels) => channels.map((list) => grown(list, count)));
  return (body, asked) => {
    if (body === null) return { p: [0, 0, 0], q: [1, 0, 0, 0] };
    const at = poses[body].map((channel) => channel[Math.min(asked, count - 1)]);
    const q = at.length > 3 ? at.slice(3).map((x) => x * animation.turn) : [1, 0, 0, 0];
    const length = Math.hypot(...q);
    return { p: at.slice(0, 3).map((x) => x * animation.unit), q: q.map((x) => x / length) };
  };
}

// One recording in its pane, with the outlines of another one's bodies where they differ visibly.
function stage(animation, recording, pane, other) {
  const [bodies, ghosts, forces, pins, values] = [".bodies", ".ghosts", ".acting", ".pins", ".values"].map((name) => pane.querySelector(name));
  const count = recording.forces.length;
  const pose = posed(animation, recording), elsewhere = other && posed(animation, other);
  const heats = recording.heat.map((list) => grown(list, count));
  // The parts of a body, as red as it is if color says how much.
  const parts = (k, now) => heats.length > 0
    ? animation.bodies[k].map((part) => part.fixed ? part : { ...part, color: animation.heat[heats[k][now]], plain: false })
    : animation.bodies[k];
  const raised = (digits) => digits.replace(/./g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));
  const number = (x) => {
    const small = x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e5);
    const [digits, power] = small ? x.toExponential(1).split("e") : [x === 0 ? "0" : `${Number(x.toPrecision(3))}`];
    return digits.replace("-", "−").replace(/\B(?=(\d{3})+$)/, Math.abs(x) < 1000 ? "" : ",") + (power ? `×10${raised(power.replace("+", ""))}` : "");
  };
  return (asked) => {
    const now = Math.min(asked, count - 1);
    const places = animation.bodies.map((_, k) => pose(k, now));
    const world = (body, point) => {
      const { p, q } = body === null ? pose(null) : places[body];
      return plus(p, turned(q, point));
    };
    const ends = animation.joints.map((joint) => joint && joint.ends.map((end, side) => world(joint.bodies[side], end)));
    const moved = (k) => parts(k, now).map((part) => {
      const turn = (v) => turned(places[k].q, v);
      const corners = part.corners.map((corner) => plus(places[k].p, turn(corner)));
      const draw = () => solid(animation, part, places[k].q, corners);
      return { ...part, body: k, corners, normals: part.normals.map(turn), edges: part.edges.map(turn), draw };
    });
    const rods = animation.joints.flatMap((joint, k) => joint
      ? [{ corners: ends[k], normals: [], edges: [unit(minus(ends[k][1], ends[k][0]))], radius: animation.rod / animation.scale,
          rod: joint.bodies, draw: () => rod(animation, ends[k]) }]
      : []);
    const solids = animation.bodies.flatMap((_, k) => moved(k)).concat(rods);
    bodies.innerHTML = painted(animation, solids).map((own) => own.draw()).join("");
    pins.innerHTML = marks(animation, ends);
    ghosts.innerHTML = elsewhere ? animation.bodies.map((_, k) => ghost(animation, k, places[k], elsewhere(k, asked))).join("") : "";
    forces.innerHTML = arrows(animation, recording.forces[now]);
    const shown = animation.measures.map((measure, m) =>
      `<span>${measure.name} <b>${number(recording.measures[m][now])}</b> ${measure.unit}</span>`);
    const away = outside(animation, places);
    if (away > 0) shown.push(`<span>outside the picture <b>${away}</b> of ${animation.bodies.filter(moves).length}</span>`);
    values.innerHTML = shown.join("");
    if (recording.ending && asked >= count - 1) {
      const end = document.createElement("span");
      end.className = "end";
      end.textContent = recording.ending;
      values.append(end);
    }
  };
}

const plus = (a, b) => a.map((x, i) => x + b[i]);
const minus = (a, b) => a.map((x, i) => x - b[i]);
const unit = (a) => { const length = Math.hypot(...a) || 1; return a.map((x) => x / length); };
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
// q v q*, for a unit quaternion w + v.
const turned = ([w, ...v], p) => {
  const t = cross(v, p).map((x) => 2 * x);
  return plus(plus(p, t.map((x) => w * x)), cross(v, t));
};
// A plane has no parts.
const moves = (parts) => parts.length > 0 && !parts.some((part) => part.fixed);
// How many moving bodies are outside the picture.
const outside = (animation, places) => animation.bodies.filter((parts, k) => moves(parts) && parts.every((part) =>
  part.corners.every((corner) => {
    const [x, y] = place(animation, plus(places[k].p, turned(places[k].q, corner))), r = part.radius * animation.scale;
    return x + r < 0 || x - r > animation.size[0] || y + r < 0 || y - r > animation.size[1];
  }))).length;
// To the right, up, towards the viewer.
const seen = (animation, p) => [0, 1, 2].map((i) => dot(animation.camera.map((axis) => axis[i]), p));
const place = (animation, p) => {
  const [x, y] = seen(animation, p), far = (px) => Math.max(-1e5, Math.min(1e5, px));
  return [far(animation.size[0] / 2 + (x - animation.middle[0]) * animation.scale), far(animation.size[1] / 2 - (y - animation.middle[1]) * animation.scale)];
};

// The directions of a solid's faces and of its edges, each once: planes between two solids are sought among them.
function directed(part) {
  const once = (list) => list.filter((v, k) => list.slice(0, k).every((w) => Math.hypot(...cross(v, w)) > 1e-6));
  const side = (face, k) => unit(minus(part.corners[face[(k + 1) % face.length]], part.corners[face[k]]));
  const sides = part.faces.flatMap((face) => face.map((_, k) => side(face, k)));
  const axis = part.faces.length === 0 && part.corners.length > 1 ? [unit(minus(part.corners[1], part.corners[0]))] : [];
  const normals = once(part.faces.map((face) => unit(cross(side(face, 0), side(face, 1)))));
  return { ...part, normals, edges: once([...sides, ...axis]) };
}

// Solids in the order of painting: between two of them that do not overlap is a plane, and the one on the viewer's side
// of it hides the other. What hides each other in a circle goes by depth.
function painted(animation, solids) {
  const mean = (corners) => corners.reduce(plus, [0, 0, 0]).map((x) => x / corners.length);
  for (const own of solids) {
    own.centre = mean(own.corners);
    const spots = own.corners.map((corner) => seen(animation, corner));
    own.depth = seen(animation, own.centre)[2];
    own.box = [0, 1].map((i) => [Math.min(...spots.map((p) => p[i])) - own.radius, Math.max(...spots.map((p) => p[i])) + own.radius]);
  }
  const meets = (a, b) => [0, 1].every((i) => a.box[i][0] < b.box[i][1] && b.box[i][0] < a.box[i][1]);
  const behind = solids.map(() => []);
  for (let j = 0; j < solids.length; j++) {
    for (let i = 0; i < j; i++) {
      if (!meets(solids[i], solids[j])) continue;
      const order = hides(animation, solids[i], solids[j]);
      if (order > 0) behind[i].push(j);
      if (order < 0) behind[j].push(i);
    }
  }
  const order = [], visited = new Set();
  const visit = (k) => {
    if (visited.has(k)) return;
    visited.add(k);
    behind[k].forEach(visit);
    order.push(solids[k]);
  };
  [...solids.keys()].sort((a, b) => solids[a].depth - solids[b].depth).forEach(visit);
  return order;
}

// 1 where a hides b, −1 where b hides a, 0 where they are side by side.
function hides(animation, a, b) {
  const ends = (rod, ball) => rod.rod && ball.radius > 0 && rod.rod.includes(ball.body); // a rod is behind the balls it ends in
  if (ends(a, b)) return -1;
  if (ends(b, a)) return 1;
  const span = (solid, n) => {
    const at = solid.corners.map((corner) => dot(corner, n));
    return [Math.min(...at) - solid.radius, Math.max(...at) + solid.radius];
  };
  const touch = 2 * animation.unit;
  let [widest, order] = [-Infinity, 0];
  for (const n of planes(animation, a, b)) {
    const [aLo, aHi] = span(a, n), [bLo, bHi] = span(b, n), gap = Math.max(bLo - aHi, aLo - bHi);
    const towards = seen(animation, n)[2];
    if (Math.abs(towards) < 1e-6) {
      if (gap >= -touch) return 0;
    } else if (gap > widest) {
      [widest, order] = [gap, (bLo - aHi >= aLo - bHi) === (towards > 0) ? -1 : 1];
      if (gap >= -touch) return order;
    }
  }
  return order;
}

// The normals of planes that may lie between two solids, the likely ones first.
function* planes(animation, a, b) {
  yield* a.normals;
  yield* b.normals;
  yield unit(minus(b.centre, a.centre));
  yield animation.camera.map((axis) => axis[2]);
  for (const e of a.edges) {
    for (const f of b.edges) {
      const n = cross(e, f);
      if (Math.hypot(...n) > 1e-6) yield unit(n);
    }
  }
}

// The outline of a body where another recording has it, if it is seen to be apart.
function ghost(animation, k, own, there) {
  return animation.bodies[k].map((part) => {
    const at = ({ p, q }) => part.corners.map((corner) => plus(p, turned(q, corner)));
    const corners = at(there), spots = corners.map((corner) => place(animation, corner));
    const apart = at(own).map((corner, i) => Math.hypot(...minus(place(animation, corner), spots[i])));
    if (part.fixed || Math.max(...apart) < GHOST_APART) return "";
    if (part.faces.length === 0) return spots.map((spot) => disc(spot, part.radius * animation.scale, 'fill="none"')).join("");
    return part.faces.map((face) => {
      const [a, b, c] = face.map((i) => corners[i]);
      const isSeen = seen(animation, cross(minus(b, a), minus(c, b)))[2] > 0;
      return isSeen ? `<path fill="none" d="M${joined(face.map((i) => spots[i]))}z"/>` : "";
    }).join("");
  }).join("");
}
const GHOST_APART = 2; // px

const shade = (color, light) => `rgb(${color.map((c) => Math.round(Math.min(255, c * light))).join()})`;
const fine = (x) => x.toFixed(1);
const joined = (points) => points.map(([x, y]) => `${fine(x)} ${fine(y)}`).join("L");

function solid(animation, body, q, corners) {
  const radius = body.radius * animation.scale;
  if (body.faces.length > 0) return faces(animation, body, corners);
  const [start, end] = corners.map((corner) => place(animation, corner));
  return end ? capsule(animation, body.color, radius, [start, end]) : ball(animation, body, q, start, radius);
}

function faces(animation, body, corners) {
  return body.faces.map((face) => {
    const [a, b, c] = face.map((k) => corners[k]);
    const n = cross(minus(b, a), minus(c, b)), length = Math.hypot(...n);
    const normal = seen(animation, n.map((x) => x / length));
    if (!(normal[2] > 1e-4)) return "";
    const light = animation.face[0] + animation.face[1] * Math.max(0, dot(normal, animation.light));
    return `<path fill="${shade(body.color, light)}" d="M${joined(face.map((k) => place(animation, corners[k])))}z"/>`;
  }).join("");
}

const disc = ([x, y], r, rest) => `<circle cx="${fine(x)}" cy="${fine(y)}" r="${r.toFixed(2)}" ${rest}/>`;

function ball(animation, body, q, [x, y], radius) {
  if (body.plain || radius < animation.plain) return disc([x, y], radius, `stroke="none" fill="${shade(body.color, 1)}"`);
  const discs = animation.lit.map(([light, aside, size]) =>
    disc([x + aside * radius * animation.light[0], y - aside * radius * animation.light[1]], size * radius,
      `stroke="none" fill="${shade(body.color, light)}"`));
  const circles = [[0, 0, 1], [0, 1, 0]].map((axis) => {
    const m = seen(animation, turned(q, axis)), flat = Math.hypot(m[0], m[1]);
    if (flat < 1e-6) return "";
    const [ax, ay] = [(radius * m[1]) / flat, (radius * m[0]) / flat];
    const angle = (Math.atan2(ay, ax) * 180) / Math.PI, width = Math.max(0.7, Math.min(2, 0.06 * radius));
    return `<path fill="none" stroke="${shade(body.color, 0.5)}" stroke-width="${fine(width)}" d="M${fine(x - ax)} ${fine(y - ay)}` +
      `A${fine(radius)} ${fine(radius * Math.abs(m[2]))} ${fine(angle)} 0 ${m[2] < 0 ? 1 : 0} ${fine(x + ax)} ${fine(y + ay)}"/>`;
  });
  return discs.join("") + circles.join("") + disc([x, y], radius, 'fill="none"');
}

const stroke = (color, width, ends) =>
  `<path fill="none" stroke-linecap="round" stroke="${color}" stroke-width="${width.toFixed(2)}" d="M${joined(ends)}"/>`;

function capsule(animation, color, radius, ends) {
  const inner = Math.max(radius - 0.7, 0.5 * radius);
  return stroke(shade(color, 0.35), 2 * radius, ends) + animation.lit.map(([light, aside, size]) => {
    const move = [aside * radius * animation.light[0], -aside * radius * animation.light[1]];
    return stroke(shade(color, light), 2 * size * inner, ends.map(([x, y]) => [x + move[0], y + move[1]]));
  }).join("");
}

const rod = (animation, ends) => stroke("#5c626c", 2 * animation.rod, ends.map((end) => place(animation, end)));

function marks(animation, ends) {
  return animation.joints.map((joint, k) => joint && joint.marks.map((mark, side) => {
    const [x, y] = place(animation, ends[k][side]), r = animation.mark;
    if (mark === 1) return disc([x, y], r, 'fill="#22262d" stroke="#ffffff"');
    return mark === 2 ? `<path stroke="none" fill="#22262d" d="M${fine(x - r)} ${fine(y - r)}h${2 * r}v${2 * r}h${-2 * r}z"/>` : "";
  }).join("")).join("");
}

function arrows(animation, list) {
  const kinds = ["normal", "friction", "constraint"].map(() => ["", ""]);
  for (let k = 0; k < list.length; k += 7) {
    const [kind, ...rest] = list.slice(k, k + 7), [x, y] = place(animation, rest.slice(0, 3).map((part) => part * animation.unit));
    const [dx, up] = seen(animation, rest.slice(3).map((tenths) => tenths / 10)), dy = -up;
    const length = Math.hypot(dx, dy), own = kinds[kind];
    if (kind === 0) own[1] += `M${fine(x - 2)} ${fine(y)}a2 2 0 1 0 4 0a2 2 0 1 0 -4 0z`;
    if (length < 2) continue;
    const [ux, uy] = [dx / length, dy / length], head = Math.min(6, 0.7 * length), half = 0.4 * head;
    const [nx, ny] = [x + dx - head * ux, y + dy - head * uy];
    own[0] += `M${joined([[x, y], [nx, ny]])}`;
    own[1] += `M${joined([[x + dx, y + dy], [nx - half * uy, ny + half * ux], [nx + half * uy, ny - half * ux]])}z`;
  }
  return kinds.map(([shafts, heads], k) => heads && `<g class="${["normal", "friction", "constraint"][k]}" stroke-linejoin="round">` +
    `<path fill="#ffffff" stroke="#ffffff" stroke-width="3.1" d="${shafts}${heads}"/>` +
    `<path fill="none" stroke-width="1.5" d="${shafts}"/><path stroke="none" d="${heads}"/></g>`).join("");
}

for (const root of document.querySelectorAll("figure.player")) play(root);
