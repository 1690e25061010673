// The picture of the first page: two stacks that fall, drawn from recorded poses.
const runs = JSON.parse(document.getElementById("runs").textContent), exact = runs[runs.length - 1];
const figure = document.querySelector(".stacks"), play = document.getElementById("play"), said = document.getElementById("said");
const half = [-0.5, 0.5], corners = half.flatMap((i) => half.flatMap((j) => half.map((k) => [i, j, k])));
const turn = ([ox, oy], [ax, ay], [bx, by]) => (ax - ox) * (by - oy) - (ay - oy) * (bx - ox);
const frameTime = 40; // ms: as long as the steps between two poses take

function hull(points) {
  const chain = (ordered) => {
    const line = [];
    for (const p of ordered) {
      while (line.length > 1 && turn(line.at(-2), line.at(-1), p) <= 1e-9) line.pop();
      line.push(p);
    }
    return line.slice(0, -1);
  };
  points.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  return [...chain(points), ...chain([...points].reverse())];
}

/** The outline of a unit cube seen from the front; z points up, on the screen y points down. */
function outline([px, , pz, w, x, y, z]) {
  const across = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)];
  const up = [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const points = hull(corners.map((c) => [px + dot(across, c), -pz - dot(up, c)]));
  return `M${points.map(([u, v]) => `${u.toFixed(3)} ${v.toFixed(3)}`).join("L")}z`;
}

function draw(id, boxes) {
  const svg = document.getElementById(id);
  svg.querySelectorAll(".box").forEach((path, k) => path.setAttribute("d", outline(boxes[k])));
  svg.querySelectorAll("text").forEach((text, k) => {
    text.setAttribute("x", boxes[k][0]);
    text.setAttribute("y", -boxes[k][2]);
  });
}

const chosen = () => runs[Number(figure.querySelector("input:checked").value)];
let running = 0;

function show(from) {
  cancelAnimationFrame(running);
  const left = chosen(), last = left.poses.length - 1;
  let start;
  const tick = (now) => {
    start ??= now;
    const k = Math.min(last, from + Math.floor((now - start) / frameTime));
    draw("left", left.poses[k]);
    draw("right", exact.poses[k]);
    if (k < last) running = requestAnimationFrame(tick);
  };
  running = requestAnimationFrame(tick);
}

function tell() {
  const { name, sunk, accepted, of } = chosen(), span = document.createElement("span"), bold = document.createElement("b");
  bold.textContent = name;
  span.className = accepted === of ? "good" : "bad";
  span.textContent = `${accepted} of ${of} steps accepted`;
  said.replaceChildren(bold, sunk > 0 ? `: the top box sinks ${sunk / 10} cm.` : ": the top box does not sink.", document.createElement("br"), span);
}

figure.querySelector("fieldset").hidden = false;
play.addEventListener("click", () => show(0));
figure.addEventListener("change", () => { tell(); show(0); });
if (!matchMedia("(prefers-reduced-motion: reduce)").matches) show(0);
