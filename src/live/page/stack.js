const USUAL = { masses: [1, 1, 1, 1, 100], solver: "pgs", omega: 1.3, sweeps: 10, backward: false, warm: true, at: 0 };
const SWEEPS = ["pgs", "jacobi", "sor"], DT = 0.01, SIZE = 0.2, MOST = 8, MIDDLE = 100;
const OWN = { masses: list(MOST, 0.1, 1000), sweeps: integer(1, 60), at: count };

let state = USUAL, ask, problem, exact, trace, moves, animation, timer;
const isSweep = () => SWEEPS.includes(state.solver);

function solve() {
  problem = ask({ ask: "column", masses: state.masses, dt: DT }).problem;
  exact = ask({ ask: "trace", problem, solver: "dantzig" }).x;
  const omega = state.solver === "sor" ? state.omega : 1;
  trace = ask({ ask: "trace", problem, solver: state.solver, omega, backward: state.backward, sweeps: isSweep() ? 60 : null });
  // Every row of every sweep, or every pivot, is a move.
  moves = [{ x: trace.steps[0].x, step: 0, words: "All impulses are 0." }];
  trace.steps.forEach(({ x, w, rows, event }, step) => {
    if (step === 0) return;
    const before = [...trace.steps[step - 1].x];
    for (const update of rows) {
      before[update.row] = update.after;
      moves.push({ x: [...before], step: rows.indexOf(update) === rows.length - 1 ? step : step - 1, words: arithmetic(update, before), row: update.row });
    }
    if (rows.length === 0) moves.push({ x, step, words: `${event}\nx = (${x.map((v) => short(v)).join(", ")})\nw = (${w.map((v) => short(v)).join(", ")})` });
  });
  state.at = Math.max(0, Math.min(state.at, moves.length - 1));
}

function arithmetic({ row, w, diagonal, before, unclamped, after }, x) {
  const sum = problem.A.dense[row].map((a, j) => [a, j]).filter(([a]) => a !== 0).map(([a, j]) => `${short(a)}·${short(j === row ? before : x[j])}`).join(" + ");
  const omega = state.solver === "sor" ? `${state.omega}·` : "";
  return `contact ${row}: w = ${sum} + (${short(problem.b[row])}) = ${short(w)} m/s\nx ← ${short(before)} − ${omega}(${short(w)})/${short(diagonal)} = ${short(unclamped)}${after === unclamped ? "" : `, clamped to ${short(after)}`} N s`;
}

// How large a mass is drawn, and the mass that a drawing means.
const width = (mass) => 60 + 30 * Math.log10(mass / 0.1), massOf = (wide) => 0.1 * 10 ** ((wide - 60) / 30);
const tidy = (mass) => { const unit = 10 ** Math.floor(Math.log10(mass)) / 10; return Math.max(0.1, Math.min(1000, Number((Math.round(mass / unit) * unit).toPrecision(2)))); };

function drawStack() {
  const n = state.masses.length, height = Math.min(50, 400 / n), scale = height / SIZE, ground = n * height + 14;
  find("#stack").setAttribute("viewBox", `0 0 420 ${ground + 6}`);
  const sunk = animation ? animation.frames[animation.at].z : state.masses.map(() => 0), x = animation ? animation.frames[animation.at].x : moves[state.at].x;
  const most = Math.max(...exact, ...x.filter((v) => typeof v === "number" && Math.abs(v) < 1e3)) || 1;
  let picture = svg("rect", { x: 0, y: ground, width: 420, height: 6, style: "fill:var(--faint)" });
  state.masses.forEach((mass, i) => {
    const wide = width(mass), y = ground - (i + 1) * height - sunk[i] * scale;
    picture += svg("rect", { x: MIDDLE - wide / 2, y: y + 1, width: wide, height: height - 2, rx: 3, style: "fill:var(--box);fill-opacity:0.8;stroke:var(--faint)" });
    picture += svg("text", { x: MIDDLE, y: y + height / 2 + 5, "text-anchor": "middle" }, `${mass} kg`);
    picture += svg("circle", { cx: MIDDLE + wide / 2, cy: y + height / 2, r: 9, class: "handle", id: `mass${i}`, role: "slider", "aria-label": `mass of box ${i}`, "aria-valuenow": mass, "aria-valuemin": 0.1, "aria-valuemax": 1000 });
  });
  state.masses.forEach((_, i) => {
    const y = ground - i * height - 16 - (i > 0 ? sunk[i - 1] * scale : 0), long = (v) => Math.max(0, Math.min(1.2, v / most)) * 90;
    const isLast = !animation && moves[state.at].row === i;
    picture += svg("rect", { x: 256, y, width: long(x[i]), height: 12, style: `fill:${isLast ? "var(--two)" : "var(--one)"}` });
    picture += svg("rect", { x: 256, y, width: long(exact[i]), height: 12, style: "fill:none;stroke:var(--ink)" });
    picture += svg("text", { x: 250, y: y + 11, "text-anchor": "end", class: "faint" }, short(x[i], 3));
    picture += svg("text", { x: 262 + Math.max(long(x[i]), long(exact[i])), y: y + 11 }, short(exact[i], 3));
  });
  if (sunk.at(-1) < -n * SIZE) picture += svg("text", { x: MIDDLE, y: ground - 16, "text-anchor": "middle", class: "faint" }, "↓ below the floor");
  paint(find("#stack"), picture);
  state.masses.forEach((mass, i) => {
    const set = (value) => { stop(); change({ masses: state.masses.map((own, k) => (k === i ? tidy(value) : own)), at: 0 }); };
    draggable(find(`#mass${i}`), find("#stack"), (px) => set(massOf(2 * (px - MIDDLE))), (dx, dy) => set(mass * 10 ** (0.1 * (dx - dy))));
  });
}

function drawPlot() {
  const step = moves[state.at].step, residuals = trace.steps.map(({ residual }) => number(residual)), last = Math.max(10, isSweep() ? 60 : trace.steps.length - 1);
  // As many decades as the residuals have, two to ten.
  const decades = Math.min(10, Math.max(2, Math.ceil(-Math.log10(Math.max(Math.min(...residuals), 1e-12)))));
  const px = (k) => 46 + k / last * 360, py = (r) => 16 + Math.min(decades, Math.max(0, -Math.log10(Math.max(r, 1e-12)))) * 250 / decades;
  let picture = "";
  for (let power = 0; power <= decades; power += decades > 4 ? 2 : 1) {
    picture += svg("line", { x1: 46, x2: 406, y1: py(10 ** -power), y2: py(10 ** -power), class: "contour" });
    picture += svg("text", { x: 40, y: py(10 ** -power) + 4, "text-anchor": "end", class: "faint" }, power === 0 ? "1" : `10⁻${"⁰¹²³⁴⁵⁶⁷⁸⁹"[power] ?? "¹⁰"}`);
  }
  picture += svg("text", { x: 406, y: 12, "text-anchor": "end" }, "scaled residual");
  for (const k of [0, last / 2, last]) picture += svg("text", { x: px(k), y: 292, "text-anchor": "middle", class: "faint" }, Math.round(k));
  picture += svg("text", { x: 406, y: 312, "text-anchor": "end" }, isSweep() ? "sweeps" : "pivots");
  if (typeof trace.rate === "number" && trace.rate > 0) {
    const anchor = residuals.findLastIndex((r) => r > 1e-10), level = residuals[anchor] / trace.rate ** anchor;
    picture += svg("polyline", { points: Array.from({ length: last + 1 }, (_, k) => `${px(k).toFixed(1)},${py(level * trace.rate ** k).toFixed(1)}`).join(" "), class: "w1", fill: "none" });
  }
  residuals.forEach((r, k) => { picture += svg("circle", { cx: px(k), cy: py(r), ...(k === step && !animation ? { r: 6, class: "here" } : { r: 3, class: "dot" }) }); });
  find("#plot").innerHTML = picture;
}

function drawSays() {
  const says = [];
  if (animation) {
    const { z, missing } = animation.frames[animation.at], sunk = Math.abs(z.at(-1)) < 1e-8 ? 0 : -100 * z.at(-1), way = isSweep() ? `${state.sweeps} sweeps per step${state.warm ? ", warm start" : ""}` : "pivoting";
    says.push(`${((animation.at + 1) * DT).toFixed(2)} s, ${way}: the top box has sunk ${short(sunk, 2)} cm. In this step the ground supports ${short(100 * (1 - missing), 3)}\u00a0% of the weight.`);
  } else {
    const { step, x } = moves[state.at], carried = x[0] / exact[0];
    says.push(`After ${step} ${isSweep() ? (step === 1 ? "sweep" : "sweeps") : (step === 1 ? "pivot" : "pivots")} the ground supports ${short(100 * carried, 3)}\u00a0% of the weight.`);
    if (typeof trace.rate === "number") says.push(`In the long run each sweep multiplies the error by ${short(trace.rate, 5)}: about ${short(Math.ceil(Math.log(10) / -Math.log(trace.rate)), 2)} sweeps per digit.`);
    if (!isSweep()) says.push(`${trace.status}; verdict: ${trace.verdict}.`);
  }
  find("#says").textContent = says.join(" ");
  find("#words").textContent = animation ? "" : moves[state.at].words;
}

function drawControls() {
  for (const id of ["omega", "sweeps"]) { const slider = find(`#${id}`); slider.value = state[id]; slider.nextElementSibling.textContent = short(state[id]); }
  find("#solver").value = state.solver;
  for (const id of ["backward", "warm"]) find(`#${id}`).checked = state[id];
  find("#omega").disabled = state.solver !== "sor";
  find("#sweeps").disabled = find("#backward").disabled = find("#warm").disabled = !isSweep();
  [find("#fewer").disabled, find("#more").disabled] = [state.masses.length <= 1, state.masses.length >= MOST];
  find("#first").disabled = state.at === 0 && !animation;
  find("#row").disabled = find("#sweep").disabled = find("#all").disabled = state.at >= moves.length - 1 && !animation;
  find("#row").textContent = isSweep() && state.solver !== "jacobi" ? "Next row" : isSweep() ? "Next sweep" : "Next pivot";
  find("#sweep").hidden = !isSweep() || state.solver === "jacobi";
  find("#all").textContent = isSweep() ? "All 60 sweeps" : "Solve";
  find("#motion").textContent = timer ? "Stop" : "Simulate 2 s";
}

function stop() { clearInterval(timer); timer = undefined; animation = undefined; }
function change(changes) { state = { ...state, ...changes }; draw(); }
function draw() {
  solve();
  drawStack();
  drawPlot();
  drawSays();
  drawControls();
  keep(state, USUAL);
}

function play() {
  if (timer) { stop(); return draw(); }
  const { masses, solver, sweeps, backward, warm } = state;
  const answer = ask({ ask: "motion", masses, dt: DT, steps: 200, solver, omega: solver === "sor" ? state.omega : 1, sweeps: isSweep() ? sweeps : null, backward, warm });
  animation = { frames: answer.frames, at: 0 };
  drawPlot();
  timer = setInterval(() => {
    animation.at = Math.min(animation.at + 2, animation.frames.length - 1);
    if (animation.at === animation.frames.length - 1) { clearInterval(timer); timer = undefined; }
    drawStack();
    drawSays();
    drawControls();
  }, 20);
  drawControls();
}

opened.then((answering) => {
  ask = answering;
  for (const id of ["omega", "sweeps"]) find(`#${id}`).addEventListener("input", (event) => { stop(); change({ [id]: Number(event.target.value) }); });
  for (const id of ["backward", "warm"]) find(`#${id}`).addEventListener("change", (event) => { stop(); change({ [id]: event.target.checked }); });
  find("#solver").addEventListener("change", (event) => { stop(); change({ solver: event.target.value, at: 0 }); });
  find("#fewer").addEventListener("click", () => { stop(); change({ masses: state.masses.slice(0, -1), at: 0 }); });
  find("#more").addEventListener("click", () => { stop(); change({ masses: [...state.masses, 1], at: 0 }); });
  find("#first").addEventListener("click", () => { stop(); change({ at: 0 }); });
  find("#row").addEventListener("click", () => { stop(); change({ at: state.at + 1 }); });
  find("#sweep").addEventListener("click", () => { stop(); change({ at: moves.findIndex(({ step }, k) => k > state.at && step > moves[state.at].step) }); });
  find("#all").addEventListener("click", () => { stop(); change({ at: moves.length - 1 }); });
  find("#motion").addEventListener("click", play);
  follow(USUAL, OWN, () => {
    stop();
    // Before the first sweep there is nothing to see; the usual state is that after the sweeps of a step.
    if (Object.keys(USUAL).every((key) => String(state[key]) === String(USUAL[key]))) state.at = state.masses.length * state.sweeps;
    draw();
  });
});
