// Plays films: poses as they were simulated, drawn as the strips of frames are.
function play(root) {
  const film = JSON.parse(root.querySelector("script").textContent);
  const find = (name) => root.querySelector(name);
  const [range, clock, button] = [find(".scrub"), find(".clock"), find(".play")];
  const last = film.times.length - 1;
  const stages = [...root.querySelectorAll(".pane")].map((pane, k) => stage(film, film.takes[k], pane));
  const charts = [...root.querySelectorAll(".chart")].map((svg, m) => chart(film, m, svg));
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  let now = 0, running = 0;
  let isFresh = true; // the telling instant that is shown first is no place to play from

  const show = (k) => {
    isFresh &&= k === film.start;
    now = Math.max(0, Math.min(last, Math.round(k)));
    for (const draw of [...stages, ...charts]) draw(now);
    clock.textContent = `${film.times[now].toFixed(3)} s · step ${film.steps[now]}`;
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
    let at = film.times[now], before = performance.now();
    const tick = (time) => {
      at += (Math.max(0, time - before) / 1000) * Number(find(".speed").value);
      before = time;
      let k = now;
      while (k < last && film.times[k + 1] <= at) k++;
      if (k !== now) show(k);
      if (now === last) return halt();
      running = requestAnimationFrame(tick);
    };
    running = requestAnimationFrame(tick);
  };
  const toggle = () => (running ? halt() : go());
  const step = (by) => { halt(); show(now + by); };

  button.addEventListener("click", toggle);
  find(".back").addEventListener("click", () => step(-1));
  find(".on").addEventListener("click", () => step(1));
  range.addEventListener("input", () => { halt(); show(Number(range.value)); });
  find(".arrows").addEventListener("change", (event) => root.classList.toggle("bare", !event.target.checked));
  find(".screen").addEventListener("keydown", (event) => {
    if (event.target.matches("input, select") || event.ctrlKey || event.metaKey || event.altKey) return;
    const keys = { ArrowLeft: () => step(-1), ArrowRight: () => step(1), Home: () => step(-last), End: () => step(last) };
    if (event.key === " " && !event.target.matches("button")) keys[" "] = toggle;
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
  for (const svg of root.querySelectorAll(".chart")) {
    const [left, right] = film.plot;
    const seek = (event) => {
      const box = svg.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * svg.viewBox.baseVal.width;
      const time = ((x - left) / (right - left)) * film.end;
      const apart = film.times.map((t) => Math.abs(t - time));
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
  const jump = () => { // #frame=12 shows instant 12 of every film
    const asked = /(?:^#|&)frame=(\d+)/.exec(location.hash);
    if (asked) step(Number(asked[1]) - now);
  };
  addEventListener("hashchange", jump);

  root.classList.add("live");
  find(".screen").hidden = false;
  find(".tabs").hidden = tabs.length < 1;
  find(".toggle").hidden = film.takes.every((take) => take.forces.every((list) => list.length === 0));
  pick(0);
  show(film.start);
  jump();
}

// One measure's cursor and a dot on each curve.
function chart(film, measure, svg) {
  const [left, right, top, bottom] = film.plot, [lo, hi] = film.measures[measure].range;
  const make = (name) => svg.appendChild(document.createElementNS("http://www.w3.org/2000/svg", name));
  const line = make("path");
  line.setAttribute("class", "cursor");
  const colors = [...svg.querySelectorAll(".curve")].map((curve) => curve.getAttribute("style"));
  const dots = film.takes.map((_, k) => {
    const dot = make("circle");
    dot.setAttribute("r", 3.6);
    dot.setAttribute("style", colors[k]);
    return dot;
  });
  return (now) => {
    const x = left + (film.times[now] / film.end) * (right - left);
    line.setAttribute("d", `M${x.toFixed(1)} ${top}V${bottom}`);
    dots.forEach((dot, k) => {
      const value = film.takes[k].measures[measure][now];
      const y = bottom - ((value - lo) / (hi - lo)) * (bottom - top);
      const seen = y >= top - 1 && y <= bottom + 1;
      dot.setAttribute("visibility", seen ? "visible" : "hidden");
      if (seen) { dot.setAttribute("cx", x.toFixed(1)); dot.setAttribute("cy", y.toFixed(1)); }
    });
  };
}

// One take in its pane.
function stage(film, take, pane) {
  const [bodies, forces, values] = [".bodies", ".acting", ".values"].map((name) => pane.querySelector(name));
  const count = take.order.length;
  const grown = (list) => {
    let sum = 0;
    return Array.from({ length: count }, (_, k) => (sum += list[k] || 0));
  };
  const poses = take.poses.map((channels) => channels.map(grown));
  const heats = take.heat.map(grown);
  // The parts of a body, as red as it is if colour says how much.
  const parts = (k, now) => heats.length > 0
    ? film.bodies[k].map((part) => part.fixed ? part : { ...part, color: film.heat[heats[k][now]], plain: false })
    : film.bodies[k];
  const orders = take.order.map((order, k) => { while (take.order[k] === 0) k--; return take.order[k]; });
  const pose = (body, now) => {
    if (body === null) return { p: [0, 0, 0], q: [1, 0, 0, 0] };
    const at = poses[body].map((channel) => channel[now]);
    const q = at.length > 3 ? at.slice(3).map((x) => x * film.turn) : [1, 0, 0, 0];
    const length = Math.hypot(...q);
    return { p: at.slice(0, 3).map((x) => x * film.unit), q: q.map((x) => x / length) };
  };
  const raised = (digits) => digits.replace(/./g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));
  const number = (x) => {
    const small = x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e5);
    const [digits, power] = small ? x.toExponential(1).split("e") : [x === 0 ? "0" : `${Number(x.toPrecision(3))}`];
    return digits.replace("-", "−") + (power ? `×10${raised(power.replace("+", ""))}` : "");
  };
  return (asked) => {
    const now = Math.min(asked, count - 1);
    const places = film.bodies.map((_, k) => pose(k, now));
    const world = (body, point) => {
      const { p, q } = body === null ? pose(null) : places[body];
      return plus(p, turned(q, point));
    };
    const ends = film.joints.map((joint) => joint && joint.ends.map((end, side) => world(joint.bodies[side], end)));
    bodies.innerHTML = orders[now].map((k) => k < film.bodies.length
      ? solids(film, parts(k, now), places[k])
      : rod(film, ends[k - film.bodies.length])).join("") + marks(film, ends);
    forces.innerHTML = arrows(take.forces[now]);
    const shown = film.measures.map((measure, m) =>
      `<span>${measure.name} <b>${number(take.measures[m][now])}</b> ${measure.unit}</span>`);
    values.innerHTML = shown.join("");
    if (take.ending && asked >= count - 1) {
      const end = document.createElement("span");
      end.className = "end";
      end.textContent = take.ending;
      values.append(end);
    }
  };
}

const plus = (a, b) => a.map((x, i) => x + b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
// q v q*, for a unit quaternion w + v.
const turned = ([w, ...v], p) => {
  const t = cross(v, p).map((x) => 2 * x);
  return plus(plus(p, t.map((x) => w * x)), cross(v, t));
};
// To the right, up, towards the viewer.
const seen = (film, p) => [0, 1, 2].map((i) => dot(film.camera.map((axis) => axis[i]), p));
const place = (film, p) => {
  const [x, y] = seen(film, p), far = (px) => Math.max(-1e5, Math.min(1e5, px));
  return [far(film.size[0] / 2 + (x - film.middle[0]) * film.scale), far(film.size[1] / 2 - (y - film.middle[1]) * film.scale)];
};
const shade = (color, light) => `rgb(${color.map((c) => Math.round(Math.min(255, c * light))).join()})`;
const fine = (x) => x.toFixed(1);
const joined = (points) => points.map(([x, y]) => `${fine(x)} ${fine(y)}`).join("L");

// The parts of a body, the farthest first.
function solids(film, parts, { p, q }) {
  const far = (part) => {
    const sum = part.corners.reduce(plus, [0, 0, 0]).map((x) => x / part.corners.length);
    return seen(film, plus(p, turned(q, sum)))[2];
  };
  const drawn = parts.length > 1 ? [...parts].sort((a, b) => far(a) - far(b)) : parts;
  return drawn.map((part) => solid(film, part, { p, q })).join("");
}

function solid(film, body, { p, q }) {
  const corners = body.corners.map((corner) => plus(p, turned(q, corner)));
  const radius = body.radius * film.scale;
  if (body.faces.length > 0) return faces(film, body, corners);
  const [start, end] = corners.map((corner) => place(film, corner));
  return end ? capsule(film, body.color, radius, [start, end]) : ball(film, body, q, start, radius);
}

function faces(film, body, corners) {
  return body.faces.map((face) => {
    const [a, b, c] = face.map((k) => corners[k]);
    const minus = (x, y) => x.map((e, i) => e - y[i]);
    const n = cross(minus(b, a), minus(c, b)), length = Math.hypot(...n);
    const normal = seen(film, n.map((x) => x / length));
    if (!(normal[2] > 1e-4)) return "";
    const light = film.face[0] + film.face[1] * Math.max(0, dot(normal, film.light));
    return `<path fill="${shade(body.color, light)}" d="M${joined(face.map((k) => place(film, corners[k])))}z"/>`;
  }).join("");
}

const disc = ([x, y], r, rest) => `<circle cx="${fine(x)}" cy="${fine(y)}" r="${r.toFixed(2)}" ${rest}/>`;

function ball(film, body, q, [x, y], radius) {
  if (body.plain || radius < film.plain) return disc([x, y], radius, `stroke="none" fill="${shade(body.color, 1)}"`);
  const discs = film.lit.map(([light, aside, size]) =>
    disc([x + aside * radius * film.light[0], y - aside * radius * film.light[1]], size * radius,
      `stroke="none" fill="${shade(body.color, light)}"`));
  const circles = [[0, 0, 1], [0, 1, 0]].map((axis) => {
    const m = seen(film, turned(q, axis)), flat = Math.hypot(m[0], m[1]);
    if (flat < 1e-6) return "";
    const [ax, ay] = [(radius * m[1]) / flat, (radius * m[0]) / flat];
    const angle = (Math.atan2(ay, ax) * 180) / Math.PI, width = Math.max(0.7, Math.min(2, 0.06 * radius));
    return `<path fill="none" stroke="${shade(body.color, 0.5)}" stroke-width="${fine(width)}" d="M${fine(x - ax)} ${fine(y - ay)}` +
      `A${fine(radius)} ${fine(radius * Math.abs(m[2]))} ${fine(angle)} 0 ${m[2] < 0 ? 1 : 0} ${fine(x + ax)} ${fine(y + ay)}"/>`;
  });
  return discs.join("") + circles.join("") + disc([x, y], radius, 'fill="none"');
}

const stroke = (colour, width, ends) =>
  `<path fill="none" stroke-linecap="round" stroke="${colour}" stroke-width="${width.toFixed(2)}" d="M${joined(ends)}"/>`;

function capsule(film, color, radius, ends) {
  const inner = Math.max(radius - 0.7, 0.5 * radius);
  return stroke(shade(color, 0.35), 2 * radius, ends) + film.lit.map(([light, aside, size]) => {
    const move = [aside * radius * film.light[0], -aside * radius * film.light[1]];
    return stroke(shade(color, light), 2 * size * inner, ends.map(([x, y]) => [x + move[0], y + move[1]]));
  }).join("");
}

const rod = (film, ends) => stroke("#5c626c", 2 * film.rod, ends.map((end) => place(film, end)));

function marks(film, ends) {
  return film.joints.map((joint, k) => joint && joint.marks.map((mark, side) => {
    const [x, y] = place(film, ends[k][side]), r = film.mark;
    if (mark === 1) return disc([x, y], r, 'fill="#22262d" stroke="#ffffff"');
    return mark === 2 ? `<path stroke="none" fill="#22262d" d="M${fine(x - r)} ${fine(y - r)}h${2 * r}v${2 * r}h${-2 * r}z"/>` : "";
  }).join("")).join("");
}

function arrows(list) {
  const kinds = ["normal", "friction", "constraint"].map(() => ["", ""]);
  for (let k = 0; k < list.length; k += 5) {
    const [kind, ...tenths] = list.slice(k, k + 5), [x, y, dx, dy] = tenths.map((t) => t / 10);
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
