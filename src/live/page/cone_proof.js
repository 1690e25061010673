const USUAL = { press: 2, mu: 0.6, angle: 30, size: 1.8, distance: -1.3, toward: 150, width: -0.8 };
const OWN = { toward: within(0, 360) };
const SLIDERS = ["press", "mu", "angle", "size", "distance", "width"], LOGARITHMIC = ["distance", "width"];
const UNITS = { press: " N s", mu: "", angle: "°", size: " N s", distance: " N s", width: " N s" };
const SCALE = 95, REACH = 120; // px per N s, and most px per half-width of X
const NAMES = { open: "open", sticks: "sticking", slides: "sliding" };
const CONDITIONS = {
  open: ["x = 0", "wₙ ≥ 0"],
  sticks: ["wₙ = wₜ₁ = wₜ₂ = 0", "|xₜ| ≤ μ xₙ"],
  slides: ["wₙ = 0, |xₜ|² = μ² xₙ², xₜ₁ wₜ₂ = xₜ₂ wₜ₁", "xₙ > 0, xₜ·wₜ ≤ 0"],
};

let state = USUAL, ask, found;
const turned = (size, angle) => [Math.cos(angle * Math.PI / 180), Math.sin(angle * Math.PI / 180)].map((v) => size * v);
const push = () => turned(state.size, state.angle);
const clamp = (value, low, high) => Math.max(low, Math.min(high, value));
const direction = (x, y) => (Math.round(Math.atan2(y, x) * 180 / Math.PI) + 360) % 360;
const tenth = (value, low, high) => clamp(Math.round(10 * value) / 10, low, high);
const widest = (box) => Math.max(...box.radius);

function solve() {
  const [p1, p2] = push();
  found = ask({ ask: "enclose", a: [1, 0, 0, 0, 1, 0, 0, 0, 1], b: [-state.press, -p1, -p2], mu: state.mu, error: [0, ...turned(10 ** state.distance, state.toward)], radius: 10 ** state.width });
  if (found.state === "open") found.x = found.solution; // as in every box
}

// A row of K(X) reaches shift + spread from x, and spread grows with the square of r.
const rows = ([box, image]) => box.radius.map((r, i) => ({ r, shift: Math.abs(image.center[i] - box.center[i]), spread: image.radius[i] })).filter(({ r }) => r > 0);
const isInside = () => rows(found.boxes).every(({ r, shift, spread }) => shift + spread < r);

// Why X proves the solution or not: the class of the sentence, and the sentence.
function verdict() {
  const { state: name, solution, w, boxes: [box, image], reason } = found, slip = Math.hypot(w[1], w[2]);
  if (!reason && name === "open") return ["good", `Proved: the contact is open. The block leaves the floor at ${short(w[0])} m/s, so x = 0.`];
  const proved = `Proved: K(X) lies inside X, so X contains exactly one solution. The contact is ${NAMES[name]}.`;
  if (!reason && widest(image) === 0) return ["good", `${proved} The equations of this state are linear, so K(X) is already a point: the solution.`];
  if (!reason) return ["good", `${proved} Further images shrink to ±${short(widest(found.boxes.at(-1)))} N s.`];
  const not = `Not proved (the contact is ${NAMES[name]}):`;
  if (!box) return ["bad", `${not} x is too far from the solution. Where xₜ = 0, the friction has no direction and F′ has no inverse.`];
  const outside = rows(found.boxes).filter(({ r, shift, spread }) => shift + spread >= r);
  if (outside.some(({ r, shift, spread }) => 4 * spread / r * shift >= r)) return ["bad", `${not} x is too far from the solution. No box with equal sides around this x is mapped into itself.`];
  if (outside.some(({ r, spread }) => 2 * spread > r)) return ["bad", `${not} X is too wide. The equations bend too much over it, so K(X) reaches beyond X.`];
  if (outside.length > 0) return ["bad", `${not} x is too far from the solution for so narrow a box. K(X) is narrower than X, but not inside it.`];
  if (box.radius[0] >= solution[0]) return ["bad", `${not} X is too wide. It also contains xₙ ≤ 0, where the contact is open.`];
  const margin = name === "sticks" ? state.mu * solution[0] - Math.hypot(solution[1], solution[2]) : slip;
  if (margin === 0) return ["caution", "No box can prove this contact: it lies exactly between sticking and sliding, so every box around x also contains points of the other state. (Here x is a fraction, which lcplab proves directly.)"];
  return ["bad", `${not} X is too wide. K(X) lies inside X, but X also contains points of the other state, which is ${short(margin, 2)} ${name === "sticks" ? "N s" : "m/s of slip"} away.`];
}

// The boxes, the last one on top, by a map of points and the size of a pixel.
function drawBoxes(boxes, to, scale) {
  const rect = ({ center, radius: [, r1, r2] }, name) => {
    const [cx, cy] = to(center.slice(1)), size = (r) => Math.max(1.5, r * scale);
    if (Math.max(r1, r2) * scale > 1e4) return svg("rect", { x: -10, y: -10, width: 440, height: 440, class: name });
    return svg("rect", { x: cx - size(r1), y: cy - size(r2), width: 2 * size(r1), height: 2 * size(r2), class: name });
  };
  return boxes.map((box, k) => (k === 0 ? "" : rect(box, !found.reason ? "cone in" : isInside() ? "two" : "none")) + rect(box, `figure ${k === 0 ? "polygon" : found.reason ? "contour" : "box"}`)).join("");
}

function drawPlane() {
  const to = ([x, y]) => [210 + SCALE * x, 210 - SCALE * y], from = (px, py) => [(px - 210) / SCALE, (210 - py) / SCALE];
  const [wx, wy] = to(push()), [cx, cy] = to(found.x.slice(1)), r = Math.max(0, state.mu * found.solution[0]) * SCALE;
  let picture = svg("circle", { cx: 210, cy: 210, r, class: "allowed" }) + svg("circle", { cx: 210, cy: 210, r, class: "figure disk" });
  picture += svg("line", { x1: 0, x2: 420, y1: 210, y2: 210, class: "axis" }) + svg("line", { x1: 210, x2: 210, y1: 0, y2: 420, class: "axis" });
  picture += svg("text", { x: 414, y: 204, "text-anchor": "end" }, "xₜ₁ (N s)") + svg("text", { x: 216, y: 14 }, "xₜ₂ (N s)");
  picture += svg("line", { x1: 210, y1: 210, x2: wx, y2: wy, class: "push slip" }) + svg("circle", { cx: wx, cy: wy, r: 11, class: "handle", id: "push" }, "<title>holding impulse</title>");
  picture += drawBoxes(found.boxes.slice(0, 2), to, SCALE) + svg("circle", { cx, cy, r: 4, class: "dot" });
  picture += svg("circle", { cx, cy, r: 7, fill: "none", "pointer-events": "all", style: "cursor: grab", id: "start" }, "<title>x</title>");
  paint(find("#plane"), picture);
  draggable(find("#push"), find("#plane"), (px, py) => {
    const [x, y] = from(px, py);
    change({ angle: direction(x, y), size: clamp(Math.round(20 * Math.hypot(x, y)) / 20, 0, 2) });
  }, (dx, dy) => change({ angle: (state.angle + 5 * dx + 360) % 360, size: clamp(Math.round(20 * state.size - dy) / 20, 0, 2) }));
  draggable(find("#start"), find("#plane"), (px, py) => {
    const [x, y] = from(px, py).map((v, i) => v - found.solution[i + 1]);
    change({ toward: direction(x, y), distance: tenth(Math.log10(Math.hypot(x, y) || 1e-9), -9, 0) });
  }, (dx, dy) => change({ toward: (state.toward + 5 * dx + 360) % 360, distance: tenth(state.distance - dy / 10, -9, 0) }));
}

function drawClose() {
  const [x1, x2] = found.x.slice(1), most = found.boxes.length > 0 ? Math.max(1, ...rows(found.boxes).slice(-2).map(({ r, shift, spread }) => (shift + spread) / r)) : 1;
  const reach = Math.max(12, Math.min(REACH, 190 / most)), scale = reach / 10 ** state.width, to = ([x, y]) => [210 + scale * (x - x1), 210 - scale * (y - x2)];
  // The edge of the disk near x: s px along its tangent, in a frame that turns with x.
  const limit = Math.max(0, state.mu * found.solution[0]), angle = Math.atan2(x2, x1), edge = scale * (limit - Math.hypot(x1, x2)), round = Math.min(scale * limit, 1e7);
  const point = (out, along) => [210 + out * Math.cos(angle) - along * Math.sin(angle), 210 - out * Math.sin(angle) - along * Math.cos(angle)];
  const corners = Array.from({ length: 181 }, (_, k) => {
    const turn = (k - 90) / 90 * (round < 500 ? Math.PI : Math.min(Math.PI, 900 / round));
    return point(edge - 2 * round * Math.sin(turn / 2) ** 2, round * Math.sin(turn));
  });
  if (round >= 500) corners.push(point(edge - 2000, 900), point(edge - 2000, -900));
  const points = corners.map((p) => p.map((v) => clamp(v, -1e5, 1e5).toFixed(1)).join(",")).join(" ");
  let picture = round > 0 ? svg("polygon", { points, class: "allowed" }) + svg("polygon", { points, class: "figure disk" }) : "";
  picture += drawBoxes(found.boxes, to, scale) + svg("circle", { cx: 210, cy: 210, r: 4, class: "dot" }) + svg("text", { x: 202, y: 224, "text-anchor": "end" }, "x");
  const [sx, sy] = to(found.solution.slice(1));
  picture += svg("circle", { cx: clamp(sx, -99, 999), cy: clamp(sy, -99, 999), r: 6, class: "solution" });
  if (found.boxes.length > 0 && found.state !== "open") {
    picture += svg("text", { x: 210 - reach + 4, y: 210 + reach + 16 }, `X = x ± ${short(10 ** state.width, 3)} N s`);
    const [kx, ky] = to(found.boxes[1].center.slice(1)), [w, h] = found.boxes[1].radius.slice(1).map((r) => r * scale);
    picture += svg("text", { x: clamp(kx - Math.min(w, 999) + 4, 8, 360), y: clamp(ky + Math.min(h, 999) + (h > 20 ? -6 : 16), 20, 412) }, "K(X)");
  }
  find("#close").innerHTML = picture;
}

function drawWidths() {
  const boxes = found.state === "open" ? [] : found.boxes, [left, right, top, bottom] = [62, 396, 20, 376];
  const least = Math.min(-20, ...boxes.map(widest).filter((r) => r > 0).map(Math.log10)) * 1.04, most = Math.max(1, ...boxes.map((box) => Math.log10(widest(box))));
  const y = (r) => (r > 0 ? top + (bottom - top) * (most - Math.log10(r)) / (most - least) : bottom + 8), x = (k) => left + 20 + k * (right - left - 40) / 7;
  const step = least < -40 ? 20 : 10, power = (e) => (e === 0 ? "1" : short(10 ** e).replace("1.00×", ""));
  const late = boxes.length > 3 && widest(boxes[3]) > 1e-16; // the curve passes the line on the right
  let picture = "";
  for (let e = 0; e >= least; e -= step) picture += svg("line", { x1: left, x2: right, y1: y(10 ** e), y2: y(10 ** e), class: "contour" }) + svg("text", { x: left - 8, y: y(10 ** e) + 5, "text-anchor": "end", class: "faint" }, power(e));
  picture += svg("line", { x1: left, x2: right, y1: y(2 ** -53), y2: y(2 ** -53), class: "law" }) + svg("text", { x: late ? left + 4 : right, y: y(2 ** -53) - 6, "text-anchor": late ? "start" : "end", class: "faint" }, "rounding of double precision");
  picture += svg("polyline", { points: boxes.map((box, k) => `${x(k).toFixed(1)},${y(widest(box)).toFixed(1)}`).join(" "), class: "path" });
  if (boxes.some((box) => widest(box) === 0)) picture += svg("text", { x: left - 8, y: y(0) + 5, "text-anchor": "end", class: "faint" }, "0");
  boxes.forEach((box, k) => {
    picture += svg("circle", { cx: x(k), cy: y(widest(box)), r: 5, class: found.reason ? "here" : k === 0 ? "answer polygon" : "answer box" });
    picture += svg("text", { x: x(k), y: 408, "text-anchor": "middle", class: "faint" }, ["X", "K(X)", "K²", "K³", "K⁴", "K⁵", "K⁶", "K⁷"][k]);
  });
  picture += svg("text", { x: left + 4, y: 14, class: "faint" }, "N s");
  if (boxes.length === 0) picture += svg("text", { x: (left + right) / 2, y: 120, "text-anchor": "middle" }, found.state === "open" ? "x = 0 is given: no box is needed" : "K(X) does not exist");
  find("#widths").innerHTML = picture;
}

function drawWords([, sentence]) {
  const { state: name, x } = found, [equations, inequalities] = CONDITIONS[name];
  const lines = [`state: ${NAMES[name]}`, `equations F = 0: ${equations}`, `inequalities everywhere in X: ${inequalities}`, `x = (${x.map((v) => short(v, 6)).join(", ")}) N s`];
  find("#words").textContent = lines.join("\n");
  find("#says").textContent = sentence;
}

function change(changes) { state = { ...state, ...changes }; draw(); }
function draw() {
  solve();
  drawPlane();
  drawClose();
  drawWidths();
  const said = verdict();
  drawWords(said);
  find("#says").className = `says ${said[0]}`;
  for (const id of SLIDERS) { const slider = find(`#${id}`); slider.value = state[id]; slider.nextElementSibling.textContent = short(LOGARITHMIC.includes(id) ? 10 ** state[id] : state[id], 3) + UNITS[id]; }
  keep(state, USUAL);
}

opened.then((answering) => {
  ask = answering;
  for (const id of SLIDERS) find(`#${id}`).addEventListener("input", (event) => change({ [id]: Number(event.target.value) }));
  follow(USUAL, OWN, draw);
});
