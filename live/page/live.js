"use strict";

const find = (name) => document.querySelector(name);

// The module, unpacked; then ask(question) answers at once.
const opened = (async () => {
  const text = atob(find("#module").textContent.trim());
  const packed = Uint8Array.from(text, (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const bytes = await new Response(stream).arrayBuffer();
  const { instance } = await WebAssembly.instantiate(bytes);
  const { room, ask, back, memory } = instance.exports;
  const encoder = new TextEncoder(), decoder = new TextDecoder();
  return (question) => {
    const given = encoder.encode(JSON.stringify(question)), place = room(given.length);
    new Uint8Array(memory.buffer, place, given.length).set(given);
    const answer = ask(place, given.length);
    const length = new DataView(memory.buffer).getUint32(answer, true);
    const told = decoder.decode(new Uint8Array(memory.buffer, answer + 4, length));
    back(answer, length);
    if (window.asked) window.asked.push([JSON.stringify(question), told]); // for those who compare
    return JSON.parse(told);
  };
})();

// What a page shows stands in its address, so that it can be sent to others.
function stateOf(usual) {
  const state = { ...usual };
  for (const [key, text] of new URLSearchParams(location.hash.slice(1) || document.documentElement.dataset.state)) {
    if (!(key in usual)) continue;
    const value = typeof usual[key] === "number" ? Number(text) : Array.isArray(usual[key]) ? text.split(",").map(Number)
      : typeof usual[key] === "boolean" ? text === "true" : text;
    if (![value].flat().some(Number.isNaN)) state[key] = value;
  }
  return state;
}
let keeping; // browsers allow few changes of the address a second, and dragging makes many
function keep(state, usual) {
  clearTimeout(keeping);
  keeping = setTimeout(() => keepNow(state, usual), 200);
}
function keepNow(state, usual) {
  if (location.protocol === "about:") return; // in another page
  const changed = Object.entries(state).filter(([key, value]) => String(value) !== String(usual[key]));
  const text = changed.map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%2C", ",")}`).join("&");
  history.replaceState(null, "", text ? `#${text}` : location.pathname + location.search);
}

// SVG from text; numbers short.
const svg = (name, attributes, text = "") =>
  `<${name} ${Object.entries(attributes).map(([key, value]) => `${key}="${value}"`).join(" ")}>${text}</${name}>`;
const short = (value, digits = 4) => {
  if (typeof value !== "number") return value === "inf" ? "∞" : value === "-inf" ? "−∞" : String(value);
  const text = Math.abs(value) >= 1e5 || (value !== 0 && Math.abs(value) < 1e-3) ? value.toExponential(2) : String(Number(value.toPrecision(digits)));
  return text.replace("-", "−").replace(/e([+−-]?)(\d+)/, (_, sign, power) => `×10${[...(sign === "-" || sign === "−" ? "−" : "") + power].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"["0123456789−".indexOf(c)]).join("")}`);
};
const number = (value) => (value === "inf" ? Infinity : value === "-inf" ? -Infinity : value);

// A handle that is dragged by pointer and by arrow keys; moved(dx, dy) is told in the picture's own units.
function draggable(handle, picture, moved, step) {
  handle.setAttribute("tabindex", "0");
  const place = (event) => {
    const box = picture.getBoundingClientRect(), view = picture.viewBox.baseVal;
    return [view.x + (event.clientX - box.x) / box.width * view.width, view.y + (event.clientY - box.y) / box.height * view.height];
  };
  handle.addEventListener("pointerdown", (event) => {
    picture.setPointerCapture(event.pointerId);
    const drag = (event) => moved(...place(event));
    const end = () => { picture.removeEventListener("pointermove", drag); picture.removeEventListener("pointerup", end); };
    picture.addEventListener("pointermove", drag);
    picture.addEventListener("pointerup", end);
    event.preventDefault();
  });
  handle.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!by) return;
    event.preventDefault();
    step(...by);
  });
}
