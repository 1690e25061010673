const USUAL = { press: 3, mu: 0.5, directions: 4, angle: 30, size: 3 };
const SLIDERS = ["press", "mu", "angle", "size"], SPAN = 5, SPEED = 3, G = 9.81;
const UNITS = { press: " N s", mu: "", angle: "°", size: " N s" };
const NAMES = ["coupled-box", "polygon", "coulomb-cone"], CLASSES = ["box", "polygon", "disk"];
const toPlane = ([x, y]) => [210 + x / SPAN * 420 * 0.55, 210 - y / SPAN * 420 * 0.55];
const fromPlane = (px, py) => [(px - 210) / 420 * SPAN / 0.55, (210 - py) / 420 * SPAN / 0.55];

let state = USUAL, ask, answers, paths;
const radians = () => state.angle * Math.PI / 180;
const wanted = () => [state.size * Math.cos(radians()), state.size * Math.sin(radians())];

function solve() {
  const directions = Number(state.directions);
  answers = ask({ ask: "friction", press: state.press, mu: state.mu, wanted: wanted(), directions }).models;
  const speed = [SPEED * Math.cos(radians()), SPEED * Math.sin(radians())], rub = Math.max(state.mu, 0.05);
  paths = ask({ ask: "slide", mu: state.mu, speed, directions, dt: 0.01, steps: Math.ceil(SPEED / (rub * G) / 0.01) + 60 }).models;
}

function drawFigures() {
  const reach = state.mu * state.press, k = Number(state.directions);
  const corners = (count, turn) => Array.from({ length: count }, (_, j) => toPlane([reach * Math.cos(2 * Math.PI * j / count + turn), reach * Math.sin(2 * Math.PI * j / count + turn)]).map((v) => v.toFixed(1)).join(",")).join(" ");
  const [ox, oy] = toPlane([0, 0]), radius = toPlane([reach, 0])[0] - ox;
  let picture = svg("line", { x1: 0, x2: 420, y1: oy, y2: oy, class: "axis" }) + svg("line", { x1: ox, x2: ox, y1: 0, y2: 420, class: "axis" });
  picture += svg("text", { x: 346, y: oy - 6 }, "xₜ₁ (N s)") + svg("text", { x: ox + 6, y: 14 }, "xₜ₂ (N s)");
  for (const at of [-4, -2, 2, 4]) {
    const [x, y] = toPlane([at, at]), name = short(at);
    picture += svg("line", { x1: x, x2: x, y1: oy, y2: oy + 5, class: "axis" }) + svg("text", { x, y: oy + 20, "text-anchor": "middle", class: "faint" }, name);
    picture += svg("line", { x1: ox - 5, x2: ox, y1: y, y2: y, class: "axis" }) + svg("text", { x: ox - 9, y: y + 5, "text-anchor": "end", class: "faint" }, name);
  }
  picture += svg("rect", { x: ox - radius, y: oy - radius, width: 2 * radius, height: 2 * radius, class: "figure box" });
  picture += svg("circle", { cx: ox, cy: oy, r: radius, class: "figure disk" });
  picture += svg("polygon", { points: corners(k, 0), class: "figure polygon" });
  const [wx, wy] = toPlane(wanted());
  NAMES.forEach((_, i) => {
    const [px, py] = toPlane(answers[i].x.slice(1));
    picture += svg("line", { x1: wx, y1: wy, x2: px, y2: py, class: `reach ${CLASSES[i]}` }) + svg("circle", { cx: px, cy: py, r: 5, class: `answer ${CLASSES[i]}` });
  });
  picture += svg("circle", { cx: wx, cy: wy, r: 9, class: "handle", id: "wanted" });
  paint(find("#figures"), picture);
  draggable(find("#wanted"), find("#figures"), (px, py) => {
    const [x, y] = fromPlane(px, py), angle = Math.atan2(y, x) * 180 / Math.PI;
    change({ angle: Math.round((angle + 360) % 360), size: Math.round(20 * Math.min(4, Math.hypot(x, y))) / 20 });
  }, (dx, dy) => change({ angle: (state.angle + 5 * dx + 360) % 360, size: Math.max(0, Math.min(4, Math.round(20 * (state.size - 0.1 * dy)) / 20)) }));
}

function drawFloor() {
  const far = state.mu > 0 ? SPEED ** 2 / (2 * state.mu * G) : Infinity;
  const length = Math.min(far, 20), tip = [length * Math.cos(radians()), length * Math.sin(radians())];
  const ends = paths.map(({ path }) => path.at(-1)), all = [[0, 0], ...(Number.isFinite(far) ? [tip] : []), ...paths.flatMap(({ path }) => path)];
  const [left, right, low, high] = [0, 0, 1, 1].map((i, k) => Math[k % 2 ? "max" : "min"](...all.map((p) => p[i])));
  const most = Math.max(0.1, right - left, high - low) * 0.6, middle = [(left + right) / 2, (low + high) / 2];
  const to = ([x, y]) => [210 + (x - middle[0]) / most * 200, 210 - (y - middle[1]) / most * 200].map((v) => v.toFixed(1));
  const [ox, oy] = to([0, 0]).map(Number);
  let picture = svg("line", { x1: 0, x2: 420, y1: oy, y2: oy, class: "axis" }) + svg("line", { x1: ox, x2: ox, y1: 0, y2: 420, class: "axis" });
  const [ex, ey] = to(tip);
  picture += svg("line", { x1: ox, y1: oy, x2: ex, y2: ey, class: "exact" });
  paths.forEach(({ path }, i) => {
    picture += svg("polyline", { points: path.map((p) => to(p).join(",")).join(" "), class: `way ${CLASSES[i]}` });
    const [cx, cy] = to(ends[i]);
    picture += svg("circle", { cx, cy, r: 5, class: `answer ${CLASSES[i]}` });
  });
  picture += svg("text", { x: 404, y: oy - 6 }, "t₁") + svg("text", { x: ox + 6, y: 14 }, "t₂");
  const bar = [1, 2, 5].map((digit) => digit * 10 ** Math.floor(Math.log10(most / 2))).findLast((length) => length <= most / 2);
  // The scale, away from the axis.
  const span = bar / most * 200, start = ox < 210 ? 410 - span : 10;
  picture += svg("line", { x1: start, x2: start + span, y1: 408, y2: 408, class: "axis" }) + svg("text", { x: start, y: 400, class: "faint" }, `${short(bar)} m`);
  find("#floor").innerHTML = picture;
}

function drawWords() {
  const signed = (v) => short(Math.abs(v) < 1e-9 ? 0 : v, 3), row = (cells, kind) => svg("tr", {}, cells.map((cell) => svg(kind, {}, cell)).join(""));
  let rows = row(["model", "x = (xₙ, xₜ₁, xₜ₂) (N s)", "|xₜ| / μ xₙ", "motion"], "th");
  for (const { model, x, w } of answers) {
    const slips = Math.hypot(w[1], w[2]) > 1e-6, rub = Math.hypot(x[1], x[2]) / (state.mu * x[0] || 1);
    const motion = `${slips ? `slips at ${signed(Math.hypot(w[1], w[2]))} m/s` : "sticks"}${Math.abs(w[0]) > 1e-6 ? `, lifts off at ${signed(w[0])} m/s` : ""}`;
    rows += row([model, `(${x.map(signed).join(", ")})`, signed(rub), motion], "td");
  }
  find("#words").innerHTML = rows;
  const holds = state.size <= state.mu * state.press, limit = state.mu * state.press;
  const boxed = limit > 0 ? Math.hypot(...answers[0].x.slice(1)) / limit : 0;
  find("#says").textContent = `By Coulomb's law the block ${holds ? "sticks" : "slides"}.${boxed > 1.0005 ? ` The box model gives ${short(boxed, 3)} times the largest friction that Coulomb's law allows.` : ""}`;
}

function change(changes) { state = { ...state, ...changes }; draw(); }
function draw() {
  solve();
  drawFigures();
  drawFloor();
  drawWords();
  for (const id of SLIDERS) { const slider = find(`#${id}`); slider.value = state[id]; slider.nextElementSibling.textContent = short(state[id]) + UNITS[id]; }
  find("#directions").value = state.directions;
  keep(state, USUAL);
}

opened.then((answering) => {
  ask = answering;
  for (const id of SLIDERS) find(`#${id}`).addEventListener("input", (event) => change({ [id]: Number(event.target.value) }));
  find("#directions").addEventListener("change", (event) => change({ directions: Number(event.target.value) }));
  follow(USUAL, {}, draw);
});
