const USUAL = { a00: 2, a01: -1, a10: -1, a11: 2, symmetric: true, b0: -1, b1: -2, bounds: "contacts", solver: "pgs", omega: 1.3, x0: 0, x1: 0, step: 0 };
const OWN = { x0: within(-4, 4), x1: within(-4, 4), step: count };
const SLIDERS = ["a00", "a01", "a10", "a11", "b0", "b1", "omega"];
const SWEEPS = ["pgs", "jacobi", "sor"];
const SPAN = 5, MIDDLE = [1.5, 1.5]; // the plane of x is this wide, around this point
const toPlane = ([x, y]) => [(x - MIDDLE[0]) / SPAN * 420 + 210, 210 - (y - MIDDLE[1]) / SPAN * 420];
const fromPlane = (px, py) => [(px - 210) / 420 * SPAN + MIDDLE[0], (210 - py) / 420 * SPAN + MIDDLE[1]];
const toCones = ([x, y]) => [210 + x * 42, 210 - y * 42];

let state = USUAL, ask, trace, timer;

function problem() {
  const bounds = { contacts: { lo: [0, 0], hi: ["inf", "inf"] }, box: { lo: [0, 0], hi: [2, 2] }, free: { lo: ["-inf", "-inf"], hi: ["inf", "inf"] } };
  return { A: { dense: [[state.a00, state.a01], [state.a10, state.a11]] }, b: [state.b0, state.b1], ...bounds[state.bounds] };
}

function solve() {
  const isSweep = SWEEPS.includes(state.solver);
  trace = ask({ ask: "trace", problem: problem(), solver: state.solver, omega: state.solver === "sor" ? state.omega : 1, start: isSweep ? [state.x0, state.x1] : null, sweeps: isSweep ? 30 : null });
  trace.all = ask({ ask: "solutions", problem: problem() }).solutions ?? null;
  if (trace.steps === undefined) trace.steps = [];
  state.step = Math.min(state.step, Math.max(trace.steps.length - 1, 0));
}

// Lines between neighbours of a grid where a function has a value: marching squares.
function contours(f, levels) {
  const n = 56, at = (k) => k * 420 / n, lines = [];
  const values = Array.from({ length: n + 1 }, (_, i) => Array.from({ length: n + 1 }, (_, j) => f(...fromPlane(at(i), at(j)))));
  for (const level of levels) {
    let d = "";
    for (let i = 0; i < n; i++) {
      for (let j = 0; j < n; j++) {
        const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]], ends = [];
        corners.forEach(([p, q], k) => {
          const [r, s] = corners[(k + 1) % 4], u = values[p][q] - level, v = values[r][s] - level;
          if ((u < 0) !== (v < 0)) { const t = u / (u - v); ends.push([at(p) + t * (at(r) - at(p)), at(q) + t * (at(s) - at(q))]); }
        });
        for (let k = 0; k + 1 < ends.length; k += 2) d += `M${ends[k].map((v) => v.toFixed(1))}L${ends[k + 1].map((v) => v.toFixed(1))}`;
      }
    }
    lines.push(svg("path", { d, class: "contour" }));
  }
  return lines.join("");
}

// The line a x + b y + c = 0, as long as the picture.
function line(a, b, c, name) {
  const size = Math.hypot(a, b);
  if (size < 1e-12) return "";
  const foot = [-a * c / size ** 2, -b * c / size ** 2], along = [-b / size * 30, a / size * 30];
  const [p, q] = [toPlane([foot[0] - along[0], foot[1] - along[1]]), toPlane([foot[0] + along[0], foot[1] + along[1]])];
  return svg("line", { x1: p[0], y1: p[1], x2: q[0], y2: q[1], class: name });
}

function drawPlane() {
  const { a00, a01, a10, a11, b0, b1 } = state, [ox, oy] = toPlane([0, 0]);
  const allowed = { contacts: [ox, 0, 420 - ox, oy], box: [ox, oy - 168, 168, 168], free: [0, 0, 420, 420] }[state.bounds];
  let picture = svg("rect", { x: allowed[0], y: allowed[1], width: allowed[2], height: allowed[3], class: "allowed" });
  if (a01 === a10) {
    const f = (x, y) => 0.5 * (a00 * x * x + 2 * a01 * x * y + a11 * y * y) + b0 * x + b1 * y;
    const values = trace.all?.length ? trace.all.map(({ x }) => f(...x)) : [0], low = Math.min(...values);
    picture += contours(f, [0.05, 0.2, 0.5, 1, 2, 4, 8, 14].flatMap((d) => (trace.all?.length && a00 > 0 && a11 > 0 && a00 * a11 > a01 * a01 ? [low + d] : [low + d, low - d])));
  }
  picture += svg("line", { x1: 0, y1: oy, x2: 420, y2: oy, class: "axis" }) + svg("line", { x1: ox, y1: 0, x2: ox, y2: 420, class: "axis" });
  picture += svg("text", { x: 400, y: oy - 6 }, "x₀") + svg("text", { x: ox + 6, y: 14 }, "x₁");
  for (const k of [1, 2, 3]) {
    picture += svg("text", { x: toPlane([k, 0])[0] - 4, y: oy + 16, class: "faint" }, k) + svg("text", { x: ox - 14, y: toPlane([0, k])[1] + 4, class: "faint" }, k);
  }
  picture += line(a00, a01, b0, "w0") + line(a10, a11, b1, "w1");
  // Sweeps move along one axis after the other; the corner between them is drawn too.
  const points = [];
  trace.steps.slice(0, state.step + 1).forEach(({ x, rows }, k) => {
    if (k > 0 && rows.length === 2 && state.solver !== "jacobi") points.push([rows[0].after, trace.steps[k - 1].x[1]]);
    points.push(x);
  });
  const finite = points.filter((x) => x.every((v) => typeof v === "number" && Math.abs(v) < 1e6)).map(toPlane);
  if (finite.length) picture += svg("polyline", { points: finite.map((p) => p.map((v) => v.toFixed(2))).join(" "), class: "path" });
  trace.steps.slice(0, state.step + 1).forEach(({ x }) => {
    if (x.every((v) => typeof v === "number" && Math.abs(v) < 1e6)) { const [cx, cy] = toPlane(x); picture += svg("circle", { cx, cy, r: 3, class: "dot" }); }
  });
  for (const { x } of trace.all ?? []) { const [cx, cy] = toPlane(x); picture += svg("circle", { cx, cy, r: 8, class: "solution" }); }
  if (SWEEPS.includes(state.solver)) { const [cx, cy] = toPlane([state.x0, state.x1]); picture += svg("circle", { cx, cy, r: 9, class: "handle", id: "start" }); }
  paint(find("#plane"), picture);
  if (find("#start")) draggable(find("#start"), find("#plane"), (px, py) => change({ x0: round(fromPlane(px, py)[0]), x1: round(fromPlane(px, py)[1]), step: state.step }), (dx, dy) => change({ x0: round(state.x0 + 0.1 * dx), x1: round(state.x1 - 0.1 * dy) }));
}
const round = (v) => Math.round(10 * Math.max(-4, Math.min(4, v))) / 10;

// The cone of two directions, as a triangle that is longer than the picture; and whether a point lies in it.
function cone(p, q, point) {
  const far = ([x, y]) => { const size = Math.hypot(x, y) || 1; return toCones([x / size * 200, y / size * 200]); };
  const determinant = p[0] * q[1] - p[1] * q[0];
  const isIn = Math.abs(determinant) > 1e-9 && (point[0] * q[1] - point[1] * q[0]) / determinant >= -1e-12 && (p[0] * point[1] - p[1] * point[0]) / determinant >= -1e-12;
  const d = [toCones([0, 0]), far(p), far(q)].map((v) => v.map((u) => u.toFixed(1))).join(" ");
  return [isIn, svg("polygon", { points: d, class: isIn ? "cone in" : "cone" })];
}

function drawCones() {
  const { a00, a01, a10, a11, b0, b1 } = state, A = [[a00, a10], [a01, a11]], I = [[-1, 0], [0, -1]], point = [-b0, -b1];
  let picture = "";
  let labels = "";
  ["neither pushes", "only row 0", "only row 1", "both push"].forEach((text, set) => {
    const [p, q] = [set & 1 ? A[0] : I[0], set & 2 ? A[1] : I[1]], unit = (v) => v.map((u) => u / (Math.hypot(...v) || 1));
    picture += cone(p, q, point)[1];
    const middle = unit([unit(p)[0] + unit(q)[0], unit(p)[1] + unit(q)[1]]), far = [4, 3.3, 3.3, 2.5][set], near = Math.hypot(...middle.map((v, i) => far * v - point[i])) < 1.2, [x, y] = toCones(middle.map((v) => (near ? far - 1.6 : far) * v));
    if (Math.hypot(...middle) > 0) labels += svg("text", { x, y, class: "faint", "text-anchor": "middle" }, text);
  });
  picture += labels + svg("path", { d: "M0 210H210V420", class: "axis", fill: "none" }) + svg("text", { x: 4, y: 204 }, "−e₀") + svg("text", { x: 216, y: 412 }, "−e₁");
  const arrow = (v, name, text) => {
    const [x, y] = toCones(v), size = Math.hypot(...v) || 1;
    const [tx, ty] = toCones([v[0] + v[0] / size * 0.35, v[1] + v[1] / size * 0.35]);
    return svg("line", { x1: 210, y1: 210, x2: x, y2: y, class: name, style: "stroke-dasharray:none" }) + svg("text", { x: tx - (v[0] < -0.9 * size ? 14 : 8), y: ty + 4 }, text);
  };
  picture += arrow(A[0], "w0", "A₀") + arrow(A[1], "w1", "A₁");
  const [cx, cy] = toCones(point);
  picture += svg("circle", { cx, cy, r: 9, class: "handle", id: "minus-b" }) + svg("text", { x: cx + 12, y: cy - 8 }, "−b");
  paint(find("#cones"), picture);
  draggable(find("#minus-b"), find("#cones"), (px, py) => change({ b0: round((210 - px) / 42), b1: round((py - 210) / 42) }), (dx, dy) => change({ b0: round(state.b0 - 0.1 * dx), b1: round(state.b1 + 0.1 * dy) }));
}

function drawWords() {
  const here = trace.steps[state.step], of = (i) => "₀₁"[i], A = [[state.a00, state.a01], [state.a10, state.a11]], b = [state.b0, state.b1];
  const signed = (v) => (v < 0 ? `(${short(v)})` : short(v));
  const lines = [];
  if (trace.error) lines.push(trace.error);
  if (here) {
    lines.push(`${state.step === 0 ? "start" : `step ${state.step}: ${here.event}`}`);
    const x = state.step === 0 ? here.x : [...trace.steps[state.step - 1].x];
    for (const { row, w, diagonal, before, unclamped, after } of here.rows) {
      lines.push(`w${of(row)} = ${A[row].map((a, j) => `${signed(a)}·${signed(x[j])}`).join(" + ")} + ${signed(b[row])} = ${short(w)}`);
      lines.push(`x${of(row)} ← ${signed(before)} − ${state.solver === "sor" ? `${state.omega}·` : ""}${signed(w)}/${signed(diagonal)} = ${short(unclamped)}${after === unclamped ? "" : `, clamped to ${short(after)}`}`);
      if (state.solver !== "jacobi") x[row] = after;
    }
    lines.push(`x = (${here.x.map((v) => short(v)).join(", ")})   w = (${here.w.map((v) => short(v)).join(", ")})   scaled residual ${short(here.residual, 2)}`);
  }
  find("#words").textContent = lines.join("\n");
}

// Whether a solution can be moved along a null vector of A and stays one: then there are infinitely many.
function freeDirection(x) {
  const { a00, a01, a10, a11, b0, b1, bounds } = state, high = { contacts: Infinity, box: 2, free: Infinity }[bounds], low = bounds === "free" ? -Infinity : 0;
  if (Math.abs(a00 * a11 - a01 * a10) > 1e-12) return undefined;
  const solves = (y) => [[a00, a01, b0], [a10, a11, b1]].every(([p, q, b], i) => {
    const w = p * y[0] + q * y[1] + b;
    return y[i] >= low && y[i] <= high && (Math.abs(w) < 1e-9 || (w > 0 && y[i] === low) || (w < 0 && y[i] === high));
  });
  const nulls = [[a01, -a00], [a11, -a10]].filter((z) => Math.hypot(...z) > 0).flatMap((z) => [z, z.map((v) => -v)]);
  return nulls.find((z) => Math.abs(a00 * z[0] + a01 * z[1]) + Math.abs(a10 * z[0] + a11 * z[1]) < 1e-12 && solves([x[0] + 1e-3 * z[0], x[1] + 1e-3 * z[1]]));
}

function drawSays() {
  const count = trace.all === null ? null : trace.all.length, says = [];
  const written = ({ x, fractions }) => `(${fractions.map((text, i) => (text.length > 9 ? short(x[i], 6) : text)).join(", ")})`;
  const ways = (trace.all ?? []).map(({ x }) => freeDirection(x)).find(Boolean);
  if (ways) says.push(`Infinitely many solutions, from ${written(trace.all[0])} in the direction (${ways.map((v) => short(v)).join(", ")}).`);
  else says.push(count === 0 ? "No solution." : count === 1 ? `One solution: ${written(trace.all[0])}.` : count === null ? "" : `Solutions: ${trace.all.map(written).join(", ")}.`);
  if (trace.status !== undefined) {
    const sweeps = SWEEPS.includes(state.solver);
    if (sweeps && typeof trace.rate === "number") says.push(`In the long run each sweep multiplies the error by ${short(trace.rate, 3)}.`);
    if (!sweeps) says.push(`${trace.status}; verdict: ${trace.verdict}.`);
    else if (trace.steps.length && trace.steps.at(-1).residual <= 1e-8) says.push(`Within 10⁻⁸ after ${trace.steps.findIndex(({ residual }) => residual <= 1e-8)} sweeps.`);
    else says.push("Not converged after 30 sweeps.");
  }
  find("#says").textContent = says.join(" ");
  find("#says").className = `says ${count === 0 ? "bad" : count === 1 && !ways ? "good" : "caution"}`;
}

function drawControls() {
  for (const id of SLIDERS) {
    const slider = find(`#${id}`);
    slider.value = state[id];
    slider.nextElementSibling.textContent = short(state[id]);
  }
  for (const id of ["bounds", "solver"]) find(`#${id}`).value = state[id];
  find("#symmetric").checked = state.symmetric;
  find("#a10").disabled = state.symmetric;
  find("#omega").disabled = state.solver !== "sor";
  find("#back").disabled = find("#first").disabled = state.step === 0;
  find("#next").disabled = state.step >= trace.steps.length - 1;
  find("#run").textContent = timer ? "Stop" : "Run";
}

function change(changes) {
  state = { ...state, ...changes };
  if (state.symmetric) state.a10 = state.a01;
  draw();
}
function draw() {
  solve();
  drawPlane();
  drawCones();
  drawWords();
  drawSays();
  drawControls();
  keep(state, USUAL);
}
function stop() { clearInterval(timer); timer = undefined; }

opened.then((answering) => {
  ask = answering;
  for (const id of SLIDERS) find(`#${id}`).addEventListener("input", (event) => change({ [id]: Number(event.target.value) }));
  for (const id of ["bounds", "solver"]) find(`#${id}`).addEventListener("change", (event) => { stop(); change({ [id]: event.target.value, step: 0 }); });
  find("#symmetric").addEventListener("change", (event) => change({ symmetric: event.target.checked }));
  find("#first").addEventListener("click", () => { stop(); change({ step: 0 }); });
  find("#back").addEventListener("click", () => { stop(); change({ step: state.step - 1 }); });
  find("#next").addEventListener("click", () => { stop(); change({ step: state.step + 1 }); });
  find("#run").addEventListener("click", () => {
    if (timer) { stop(); return draw(); }
    timer = setInterval(() => (state.step < trace.steps.length - 1 ? change({ step: state.step + 1 }) : (stop(), draw())), 350);
    draw();
  });
  follow(USUAL, OWN, () => {
    stop();
    // The usual state begins with a part of the path.
    const isUsual = Object.keys(USUAL).every((key) => String(state[key]) === String(USUAL[key]));
    change(isUsual ? { step: 4 } : {});
  });
});
