const EXAMPLES = {
  "three boxes, the middle one moving down": { name: "Figure 7", A: { dense: [[1, -1, 0], [-1, 2, -1], [0, -1, 2]] }, b: [-1, -1, 1] },
  "a chain of ten": { name: "a chain of ten", A: { dense: Array.from({ length: 10 }, (_, i) => Array.from({ length: 10 }, (_, j) => (i === j ? 2 : Math.abs(i - j) === 1 ? -1 : 0))) }, b: Array(10).fill(-1) },
  "a contact with friction, pushed": { name: "a contact with friction", A: { dense: [[2, 0, 0.5], [0, 1, 0], [0.5, 0, 1]] }, b: [-2, -1.5, -0.5], friction_index: [-1, 0, 0], mu: [0, 0.5, 0.5] },
  "two solutions": { name: "two solutions", A: { dense: [[2, -3], [-3, 2]] }, b: [1, 1.5] },
  "no solution": { name: "no solution", A: { dense: [[1, -1], [-1, 1]] }, b: [-1, 0] },
};
const CLAIMS = { "no-solution": "no solution", unique: "exactly one solution", "not-unique": "two solutions", solution: "an exact solution" };
const USUAL = { example: Object.keys(EXAMPLES)[0], solver: "", step: Infinity, lines: 0, problem: "" };

let state = USUAL, ask, problem, solved, timer;
const compact = (value) => JSON.stringify(value, null, 1).replace(/\n\s*/g, " ").replace(/\[ /g, "[").replace(/ \]/g, "]");

const ten = (power) => `10${[...String(power)].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"["0123456789-".indexOf(c)]).join("")}`;

// A text whose lines wrap with a hanging indent.
function setLines(node, text) {
  node.replaceChildren(...text.trimEnd().split("\n").map((line) => {
    const own = document.createElement("span");
    own.textContent = `${line}\n`;
    return own;
  }));
}

const escaped = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;");
const paragraphs = (texts) => texts.filter(Boolean).map((text) => svg("p", {}, escaped(text))).join("");
const cells = (row, numeric, name = "td") => svg("tr", {}, row.map((text, c) => svg(name, numeric[c] ? {} : { class: "words" }, escaped(text))).join(""));

// The judge's verdict, unless the page states it above; what it measured; remarks.
function setVerdict({ error, verdict, measured = [], remarks = "" }, isStated) {
  const typeset = (value) => value.replace(/e(-?\d+)$/, (_, power) => `×${ten(power)}`);
  const zeros = measured.every(([, value]) => value === "0") && measured.length ? `All ${measured.length} kinds of residual are 0.` : "";
  const table = zeros ? "" : svg("table", {}, measured.map(([name, value, meaning]) => cells([name, typeset(value), meaning], [false, true])).join(""));
  find("#judge").innerHTML = paragraphs([error ?? (isStated ? "" : verdict), zeros]) + table + paragraphs(remarks.split("\n"));
}

function parse(text) {
  try { return JSON.parse(text); } catch (cause) { return { error: cause.message }; }
}

function solve() {
  const text = find("#text").value, read = parse(text);
  solved = read === null || typeof read !== "object" || read.error ? { error: read?.error ? `Not valid JSON: ${read.error}` : "The problem must be a JSON object" } : ask({ ask: "solve", problem: read, ...(state.solver ? { solver: state.solver } : {}) });
  problem = read;
  if (solved.error) return;
  state.step = Math.min(state.step, solved.steps.length - 1);
  find("#x").value = JSON.stringify(solved.answer.x);
  setVerdict(solved.judge, true);
  find("#solver").value = state.solver;
}

// Residuals over the steps, on a logarithmic axis; 0 has a row of its own below it.
function drawChart() {
  const values = solved.error ? [] : solved.steps.map(({ residual }) => number(residual)), good = values.filter((v) => v > 0 && Number.isFinite(v));
  const high = Math.ceil(Math.log10(Math.max(1e-3, ...good))), low = Math.min(high - 2, Math.max(-16, Math.floor(Math.log10(Math.min(1, ...good)))));
  const bottom = values.includes(0) ? 164 : 200;
  const place = (v, k) => [44 + (values.length > 1 ? k / (values.length - 1) : 0) * 366, v === 0 ? 212 : 12 + (high - Math.max(low, Math.min(high, v > 0 ? Math.log10(v) : low))) / (high - low) * bottom];
  let picture = "";
  for (let power = high; power >= low; power -= Math.ceil((high - low) / 5)) {
    const y = place(10 ** power, 0)[1];
    picture += svg("line", { x1: 44, x2: 410, y1: y, y2: y, class: "contour" }) + svg("text", { x: 38, y: y + 4, class: "faint", "text-anchor": "end" }, ten(power));
  }
  if (values.includes(0)) {
    picture += svg("line", { x1: 44, x2: 410, y1: 212, y2: 212, class: "contour" }) + svg("text", { x: 38, y: 216, class: "faint", "text-anchor": "end" }, "0");
    picture += svg("path", { d: "M14 196l7 -5l7 5l7 -5", class: "contour" }); // the axis is broken
  }
  picture += svg("polyline", { points: values.map((v, k) => place(v, k).map((u) => u.toFixed(1)).join(",")).join(" "), class: "path" });
  const last = values.length - 1, every = [1, 2, 5, 10, 20, 50, 100, 200, 500].find((n) => last <= 10 * n);
  values.forEach((v, k) => {
    const [cx, cy] = place(v, k);
    if (v === 0 || last <= 20) picture += svg("circle", { cx, cy, ...(v === 0 ? { r: 5, class: "solution" } : { r: 3, class: "dot" }) });
    if (k % every === 0) picture += svg("text", { x: cx, y: 234, class: "faint", "text-anchor": "middle" }, k);
  });
  if (values.length) { const [cx, cy] = place(values[state.step], state.step); picture += svg("circle", { cx, cy, r: 5, class: "here" }); }
  find("#chart").innerHTML = picture;
}

// The problem, and x and w after the step; rows that are not solved yet are red.
function drawRows() {
  if (solved.error) { find("#rows").innerHTML = ""; return; }
  const { A, b } = solved, { x, w, bounds, open, event } = solved.steps[state.step];
  const label = (i) => escaped(problem.rows?.[i]?.label ?? i);
  const row = (i) => [...(A?.[i] ?? []), b[i], bounds[i][0], x[i], bounds[i][1], w[i]].map((v) => svg("td", {}, short(v))).join("");
  const rows = x.map((_, i) => svg("tr", open.includes(i) ? { class: "bad" } : {}, svg("th", { scope: "row" }, label(i)) + row(i)));
  const head = [["row", 1], ["A", A?.[0]?.length ?? 0], ["b", 1], ["lo", 1], ["x", 1], ["hi", 1], ["w", 1]].filter(([, span]) => span > 0);
  const words = `Step ${state.step}: ${event}; ${open.length ? `${open.length} of ${x.length} rows are not solved yet (red)` : "every row is solved"}`;
  find("#rows").innerHTML = svg("caption", {}, words) + svg("tr", {}, head.map(([name, colspan]) => svg("th", { colspan }, name)).join("")) + rows.join("");
}

function drawSays() {
  const { error, answer, warnings, steps } = solved, last = steps?.length - 1;
  find("#says").textContent = error ?? [`${answer.solver} ${answer.message === "solved" ? `solved it in ${last} step${last === 1 ? "" : "s"}` : `stopped: ${answer.message}`}; ${solved.judge.verdict}`, ...warnings].join(". ");
  find("#says").className = `says ${error || answer.verdict === "not_a_solution" ? "bad" : answer.verdict === "proved" ? "good" : "caution"}`;
}

// A formula as MathML.
function typeset(pieces) {
  const atom = (text) => svg(/^[\d.,−×∞⁰¹²³⁴-⁹⁻/]+$/.test(text) ? "mn" : /^[=+−≤≥<>·∓±]+$/.test(text) ? "mo" : "mi", {}, escaped(text));
  // −A_FF⁻¹, has a sign, a name, a subscript, an inverse and a comma.
  const word = (text) => {
    const [, sign, name, low, inverse, comma] = text.match(/^(−(?=\p{L}))?(.*?)(?:_(\w+))?(⁻¹)?(,?)$/u);
    const indexed = low ? svg("msub", {}, atom(name) + atom(low)) : name && atom(name);
    return (sign ? "<mo>−</mo>" : "") + (inverse ? svg("msup", {}, svg("mrow", {}, indexed) + "<mn>−1</mn>") : indexed) + (comma && "<mo>,</mo><mspace width='1em'></mspace>");
  };
  const line = (cells) => svg("mtr", {}, cells.map((cell) => svg("mtd", {}, word(cell))).join(""));
  return svg("math", {}, pieces.map((piece) => (Array.isArray(piece) ? svg("mtable", {}, piece.map(line).join("")) : piece.split(" ").filter(Boolean).map(word).join(""))).join(""));
}
const framed = (html) => svg("div", { class: "wide", tabindex: 0 }, html);
function block({ heading, text, formula, remark, table, columns, numeric, rows, left_out }) {
  if (heading) return svg("h3", {}, escaped(heading));
  if (formula) return framed(`${typeset(formula)} ${escaped(remark)}`);
  if (!columns) return paragraphs([text]);
  return framed(svg("table", {}, svg("caption", {}, escaped(table)) + cells(columns, numeric, "th") + rows.map((row) => cells(row, numeric)).join(""))) + paragraphs([left_out && `and ${left_out} more`]);
}

function drawDerivation() {
  const sections = solved.derivation ?? [], all = sections.flatMap(({ title, blocks }) => blocks.map((own, k) => (k ? "" : svg("h2", {}, escaped(title))) + block(own)));
  find("#derivation").hidden = all.length === 0;
  const first = sections[0]?.blocks.length ?? 1; // what is to be solved
  state.lines = Math.max(first, Math.min(state.lines, all.length));
  find("#lines").innerHTML = all.map((html, k) => svg("div", k < state.lines ? {} : { class: "later" }, html)).join(""); // printed, but not shown yet
  find("#less").disabled = state.lines === first;
  find("#more").disabled = find("#whole").disabled = state.lines >= all.length;
}

function drawControls() {
  const last = solved.error ? 0 : solved.steps.length - 1, slider = find("#step");
  [slider.max, slider.value] = [last, state.step];
  slider.nextElementSibling.textContent = state.step;
  find("#back").disabled = state.step === 0;
  find("#next").disabled = state.step >= last;
  find("#prove").disabled = Boolean(solved.error);
}

function draw() {
  drawChart();
  drawRows();
  drawSays();
  drawDerivation();
  drawControls();
  const isLast = solved.error || state.step === solved.steps.length - 1;
  keep(isLast ? { ...state, step: USUAL.step } : state, USUAL);
}
// Another problem, or another method.
function renew() {
  find("#prove").hidden = false;
  find("#proof").hidden = find("#save").hidden = true;
  solve();
  draw();
}
function take(text, changes) {
  find("#text").value = text;
  // What fits into an address goes there.
  const own = state.example in EXAMPLES && text === compact(EXAMPLES[state.example]);
  state = { ...state, step: Infinity, lines: 0, ...changes, problem: own || text.length > 4000 ? "" : text };
  renew();
}
function judge() {
  const x = parse(find("#x").value);
  const verdict = Array.isArray(x) ? ask({ ask: "judge", problem, x: x.map(Number) }) : { error: `x: expected a list of numbers${x?.error ? ` (${x.error})` : ""}` };
  setVerdict(verdict);
  find("#prove").hidden = false;
  find("#proof").hidden = find("#save").hidden = true;
}
function prove() {
  const x = parse(find("#x").value), { error, proof, missing } = Array.isArray(x) ? ask({ ask: "prove", problem, x: x.map(Number) }) : { error: "x: expected a list of numbers" };
  const why = (missing ?? []).map(([kind, reason]) => `Not proved: ${CLAIMS[kind] ?? kind} (${reason})`);
  setLines(find("#proof"), error ?? [proof ? `Proved: ${proof.sentence}` : "Nothing could be proved.", ...why].join("\n"));
  find("#proof").hidden = false;
  find("#prove").hidden = !error;
  find("#save").hidden = !proof;
  if (proof) find("#save").href = `data:application/json,${encodeURIComponent(JSON.stringify(proof.file))}`;
}
function begin() {
  find("#example").value = state.example;
  find("#text").value = state.problem || compact(EXAMPLES[state.example] ?? EXAMPLES[USUAL.example]);
  renew();
}
async function load(file) {
  take(await file.text(), {});
}

opened.then((answering) => {
  ask = answering;
  find("#example").innerHTML = Object.keys(EXAMPLES).map((name) => svg("option", {}, name)).join("");
  find("#example").addEventListener("change", (event) => { state.example = event.target.value; take(compact(EXAMPLES[state.example]), {}); });
  find("#solver").addEventListener("change", (event) => { state = { ...state, solver: event.target.value, step: Infinity, lines: 0 }; renew(); });
  find("#text").addEventListener("input", (event) => { clearTimeout(timer); timer = setTimeout(() => take(event.target.value, {}), 300); });
  find("#file").addEventListener("change", (event) => event.target.files[0] && load(event.target.files[0]));
  document.body.addEventListener("dragover", (event) => event.preventDefault());
  document.body.addEventListener("drop", (event) => { event.preventDefault(); const file = event.dataTransfer.files[0]; if (file) load(file); });
  find("#x").addEventListener("change", judge);
  find("#prove").addEventListener("click", prove);
  const step = (to) => { state.step = to; draw(); };
  find("#back").addEventListener("click", () => step(state.step - 1));
  find("#next").addEventListener("click", () => step(state.step + 1));
  find("#step").addEventListener("input", (event) => step(Number(event.target.value)));
  const show = (lines) => { state.lines = lines; draw(); };
  find("#less").addEventListener("click", () => show(state.lines - 1));
  find("#more").addEventListener("click", () => show(state.lines + 1));
  find("#whole").addEventListener("click", () => show(Infinity));
  const { solvers } = ask({ ask: "solve", problem: EXAMPLES[USUAL.example] });
  find("#solver").innerHTML = svg("option", { value: "" }, "automatic") + solvers.map(([name, method]) => svg("option", { value: name, title: method.replace(/["<>&]/g, " ") }, name)).join("");
  follow(USUAL, { step: count, lines: count, problem: anything }, begin);
});
