const USUAL = { mu: 2, theta: 63, omega: 0, dt: 0.01, step: 1 };
const SLIDERS = ["mu", "theta", "omega", "step"], MOST_MU = 3, SLIP = 1;
const FRAMES = 400, STILL = 0.01; // slower is not visible
const toMap = (mu, theta) => [40 + mu / MOST_MU * 370, 390 - theta / 90 * 370];
const fromMap = (px, py) => [(px - 40) / 370 * MOST_MU, (390 - py) / 370 * 90];
const radians = (degrees) => degrees * Math.PI / 180;
const clamp = (value, low, high) => Math.max(low, Math.min(high, value));
const critical = (theta) => (4 + Math.tan(radians(theta)) ** 2) / (3 * Math.tan(radians(theta)));

let state = USUAL, ask, rod, frames, timer;

function solve() {
  const { mu, theta, omega } = state;
  rod = ask({ ask: "rod", mu, theta, omega });
  frames = ask({ ask: "run", mu, theta, omega, slip: SLIP, dt: Number(state.dt), steps: FRAMES }).frames;
}

function drawMap() {
  const [left, bottom] = toMap(0, 0), [right, top] = toMap(MOST_MU, 90);
  const lift = Math.abs(state.omega) > 1 ? Math.asin(1 / state.omega ** 2) * 180 / Math.PI : 90;
  // The angles between which the critical friction is on the map: 3 μ tan θ = 4 + tan²θ.
  const root = Math.sqrt(9 * MOST_MU ** 2 - 16), [flat, steep] = [-1, 1].map((sign) => Math.atan((3 * MOST_MU + sign * root) / 2) * 180 / Math.PI);
  const curve = (from, to) => Array.from({ length: 121 }, (_, k) => from + (to - from) * k / 120).map((theta) => [critical(theta), theta]);
  const area = (low, high, name) => {
    const from = Math.max(low, flat), to = Math.min(high, steep);
    if (from >= to) return "";
    const edge = curve(from, to).map(([mu, theta]) => toMap(mu, theta)), end = [toMap(MOST_MU, to), toMap(MOST_MU, from)];
    return svg("polygon", { points: [...edge, ...end].map((p) => p.map((v) => v.toFixed(1)).join(",")).join(" "), class: name });
  };
  let picture = svg("rect", { x: left, y: top, width: right - left, height: bottom - top, class: "one" });
  picture += area(0, lift, "none") + area(lift, 90, "two");
  picture += svg("polyline", { points: curve(flat, steep).map((p) => toMap(...p).map((v) => v.toFixed(1)).join(",")).join(" "), class: "path" });
  if (lift < 90) { const y = toMap(0, lift)[1]; picture += svg("line", { x1: left, x2: right, y1: y, y2: y, class: "law" }); }
  const word = (mu, theta, text) => { const [x, y] = toMap(mu, theta); return svg("text", { x, y, "text-anchor": "middle" }, text); };
  picture += word(0.6, 45, "one solution");
  if (lift > 55) picture += word(2.45, Math.min(63, (lift + 40) / 2), "no solution");
  if (lift < 75) picture += word(2.45, (lift + 80) / 2, "two solutions");
  for (const mu of [0, 1, 2, 3]) picture += svg("text", { x: toMap(mu, 0)[0] - 4, y: bottom + 18, class: "faint" }, mu);
  for (const theta of [30, 60, 90]) picture += svg("text", { x: 10, y: toMap(0, theta)[1] + 5, class: "faint" }, `${theta}°`);
  picture += svg("text", { x: right - 6, y: bottom - 8, "text-anchor": "end" }, "friction μ") + svg("text", { x: left + 6, y: top + 16 }, "angle θ");
  const [cx, cy] = toMap(state.mu, state.theta);
  picture += svg("circle", { cx, cy, r: 9, class: "handle", id: "here" }) + svg("text", { x: clamp(cx, 100, 350), y: cy - 16, "text-anchor": "middle" }, `μ = ${short(state.mu)}, θ = ${short(state.theta)}°`);
  paint(find("#map"), picture);
  const to = (mu, theta) => change({ mu: Math.round(20 * clamp(mu, 0, MOST_MU)) / 20, theta: Math.round(clamp(theta, 5, 85)), step: USUAL.step });
  draggable(find("#here"), find("#map"), (px, py) => to(...fromMap(px, py)), (dx, dy) => to(state.mu + 0.05 * dx, state.theta - dy));
}

function drawRod() {
  const { at: [x, z, angle], x: push, slip } = frames[state.step], scale = 90, ground = 250;
  const middle = clamp(265 + scale * (x - frames[0].at[0]), 100, 265) - scale * x; // the rod stays in the picture
  const to = (px, pz) => [middle + scale * px, ground - scale * pz];
  const along = [Math.cos(angle), Math.sin(angle)], low = to(x - along[0], z - along[1]), high = to(x + along[0], z + along[1]);
  let picture = svg("line", { x1: 0, x2: 420, y1: ground, y2: ground, class: "axis" });
  picture += svg("line", { x1: low[0], y1: low[1], x2: high[0], y2: high[1], class: "body" });
  const [cx, cy] = to(x, z);
  picture += svg("circle", { cx, cy, r: 4, class: "dot" });
  // A step of the weight, 1 dt, is drawn 45 long, or all arrows are shortened alike.
  const arrow = ([px, py], dx, dy, name, word) => {
    const size = Math.hypot(dx, dy);
    if (size < 2) return "";
    const ex = px + dx, ey = py + dy, u = [dx / size, dy / size], out = dx || px - cx; // its label is not under the rod
    const label = svg("text", { ...(dx ? { x: px + 4 * u[0], y: py + 18 } : { x: px + 8 * Math.sign(out), y: (py + ey) / 2 }), "text-anchor": out > 0 ? "start" : "end", class: "faint" }, word);
    return label + svg("line", { x1: px, y1: py, x2: ex, y2: ey, class: name }) + svg("path", { d: `M${ex} ${ey}l${-9 * u[0] - 4 * u[1]} ${-9 * u[1] + 4 * u[0]}M${ex} ${ey}l${-9 * u[0] + 4 * u[1]} ${-9 * u[1] - 4 * u[0]}`, class: name });
  };
  const unit = Math.min(45 / Number(state.dt), 120 / Math.max(...push.map(Math.abs)));
  [[low, push[0], push[1]], [high, push[2], push[3]]].forEach(([end, normal, friction]) => {
    picture += arrow(end, 0, -unit * normal, "push normal", "normal") + arrow(end, unit * friction, 0, "push friction", "friction");
  });
  if (state.step <= 1 && Math.abs(slip) > STILL) picture += arrow([low[0], low[1] + 14], 40 * slip, 0, "push slip", "slides");
  find("#rod").innerHTML = picture;
  drawSlip();
}

// The speed at which the lower end slides to the left, over time.
function drawSlip() {
  const [left, right, top, bottom] = [44, 410, 24, 94], speeds = frames.map(({ slip }) => (Math.abs(slip) < STILL ? 0 : -slip));
  const most = Math.max(0.1, ...speeds), least = Math.min(0, ...speeds), zero = top + (bottom - top) * most / (most - least);
  const at = (k) => [left + k / FRAMES * (right - left), zero - speeds[k] / most * (zero - top)];
  let chart = svg("line", { x1: left, x2: right, y1: zero, y2: zero, class: "axis" });
  chart += svg("text", { x: left - 8, y: top + 5, "text-anchor": "end", class: "faint" }, short(most, 2)) + svg("text", { x: left - 8, y: zero + 5, "text-anchor": "end", class: "faint" }, "0");
  for (const part of [0.25, 0.5, 0.75, 1]) {
    const x = left + part * (right - left), time = short(part * FRAMES * Number(state.dt));
    chart += svg("line", { x1: x, x2: x, y1: zero, y2: zero + 5, class: "axis" }) + svg("text", { x, y: zero + 20, "text-anchor": "middle", class: "faint" }, time);
  }
  chart += svg("text", { x: left + 0.875 * (right - left), y: zero + 20, "text-anchor": "middle" }, "time");
  chart += svg("polyline", { points: frames.map((_, k) => at(k).map((v) => v.toFixed(1)).join(",")).join(" "), class: "path" });
  const again = speeds.findIndex((speed, k) => speed > STILL && speeds.indexOf(0, 1) > 0 && k > speeds.indexOf(0, 1)), landing = frames.findIndex(({ x }) => x[2] > 0);
  // Before it slides again the curve is 0; above the curve there is space for the other label.
  if (again > 0) chart += svg("text", { x: at(again)[0] - 6, y: zero - 8, "text-anchor": "end", class: "faint" }, "slides again");
  if (landing > 0) {
    const x = at(landing)[0];
    chart += svg("line", { x1: x, x2: x, y1: 18, y2: zero, class: "contour" });
    chart += svg("text", { x: Math.max(left + 200, Math.min(right - 50, x)), y: 14, "text-anchor": "middle", class: "faint" }, "upper end lands");
  }
  const [cx, cy] = at(state.step);
  chart += svg("circle", { cx, cy, r: 5, class: "here" }) + svg("text", { x: left, y: 14 }, `sliding speed: ${short(speeds[state.step], 3)}`);
  find("#slip").innerHTML = chart;
}

function drawWords() {
  const { a, b, forces, steps } = rod, digits = (v) => short(Math.abs(v) < 1e-9 ? 0 : v, 4), lines = [];
  const known = forces.map(digits).join(" and ");
  lines.push(`Acceleration level: w = a x + b with a = 1 + 3cos²θ − 3μ sin θ cos θ = ${digits(a)} and b = ω² sin θ − 1 = ${digits(b)}.`);
  lines.push(forces.length === 0 ? "w < 0 for every x ≥ 0, so there is no solution." : `x = ${known}${forces.length > 1 ? ": the end leaves the floor, or stays on it." : "."}`);
  lines.push(`Velocity level, one step from a sliding speed of ${SLIP}; here friction can also stop the sliding. If there are several solutions, the solver returns one of them:`);
  for (const { dt, x, w } of steps) {
    const word = x[0] < 1e-12 ? "leaves the floor" : Math.abs(w[1]) < 1e-9 ? "sticks at once" : "keeps sliding";
    const parts = [`dt = ${dt}: x = (${x.map(digits).join(", ")})`, `x/dt = ${digits(x[0] / dt)}`, word]; // a phone breaks lines between them
    lines.push(parts.map((part) => part.replaceAll(" ", "\u00a0")).join(", "));
  }
  find("#words").textContent = lines.join("\n");
  const says = { 0: "There is no solution: no force keeps the end out of the floor, because friction turns it into the floor faster than the normal force lifts it.", 1: "There is one solution.", 2: "There are two solutions: the end leaves the floor, or stays on it." }[forces.length];
  find("#rod-title").textContent = forces.length ? "The rod" : `An impulse does exist${Math.abs(frames[1].slip) < STILL ? ": the end stops at once" : ""}`;
  find("#says").textContent = `${says} The critical friction coefficient at this angle is ${digits(rod.critical)}.`;
  find("#says").className = `says ${["bad", "good", "caution"][forces.length]}`;
}

function change(changes) { state = { ...state, ...changes }; draw(); }
function draw() {
  solve();
  state.step = Math.min(state.step, frames.length - 1);
  drawMap();
  drawFrame();
  drawWords();
}
// While the rod moves nothing else changes.
function drawFrame() {
  drawRod();
  for (const id of SLIDERS) {
    const slider = find(`#${id}`);
    slider.value = state[id];
    slider.nextElementSibling.textContent = id === "step" ? short(state.step * Number(state.dt)) : short(state[id]) + (id === "theta" ? "°" : "");
  }
  find("#dt").value = state.dt;
  find("#run").textContent = timer ? "Stop" : "Run";
  keep(state, USUAL);
}
function stop() { clearInterval(timer); timer = undefined; }

opened.then((answering) => {
  ask = answering;
  for (const id of ["mu", "theta", "omega"]) find(`#${id}`).addEventListener("input", (event) => { stop(); change({ [id]: Number(event.target.value), step: USUAL.step }); });
  find("#step").addEventListener("input", (event) => { stop(); state.step = Number(event.target.value); drawFrame(); });
  find("#dt").addEventListener("change", (event) => { stop(); change({ dt: Number(event.target.value), step: USUAL.step }); });
  find("#first").addEventListener("click", () => { stop(); state.step = 0; drawFrame(); });
  find("#run").addEventListener("click", () => {
    if (timer) { stop(); return drawFrame(); }
    if (state.step >= frames.length - 1) state.step = 0;
    timer = setInterval(() => { state.step < frames.length - 1 ? (state.step += 1) : stop(); drawFrame(); }, 25);
    drawFrame();
  });
  follow(USUAL, { step: integer(0, FRAMES) }, () => { stop(); draw(); });
});
