"use strict";

const find = (name) => document.querySelector(name);

// An open document inside holds back the page's load event until the first picture is drawn, so that
// a page that is printed at once is complete.
const unfinished = document.body.appendChild(document.createElement("iframe"));
unfinished.hidden = true;
unfinished.contentDocument?.open();

// The module, unpacked; then ask(question) answers at once.
const opened = (async () => {
  const text = atob(find("#module").textContent.trim());
  // Uint8Array.from takes twenty times as long.
  const packed = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) packed[k] = text.charCodeAt(k);
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
    const reply = decoder.decode(new Uint8Array(memory.buffer, answer + 4, length));
    back(answer, length);
    if (window.asked) window.asked.push([JSON.stringify(question), reply]); // for those who compare
    return JSON.parse(reply);
  };
})();

// The value that the text of a key stands for, undefined where it stands for none; and what it may
// be, in words.
const numeral = (text) => (/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text) ? Number(text) : NaN);
const between = (low, high) => (text) => [numeral(text)].find((v) => v >= low && v <= high);
const within = (low, high) => ({ words: `a number from ${low} to ${high}`, value: between(low, high) });
const integer = (low, high) => ({ words: `a whole number from ${low} to ${high}`, value: (text) => [between(low, high)(text)].find(Number.isInteger) });
const count = { words: "a whole number", value: (text) => [numeral(text)].find((v) => Number.isInteger(v) && v >= 0) };
const list = (most, low, high) => ({
  words: `a list of 1 to ${most} numbers from ${low} to ${high}`,
  value: (text) => [text.split(",").map(between(low, high))].find((values) => values.length <= most && !values.includes(undefined)),
});
const anything = { words: "a text", value: (text) => text };
// The rule of a key that has a control of its own: what the control can be set to.
function ruleOf(key, usual) {
  const { type, min, max, options } = find(`#${key}`);
  if (type === "checkbox") return { words: "true or false", value: (text) => [true, false].find((own) => String(own) === text) };
  if (type === "range") return within(Number(min), Number(max));
  const names = [...options].map((option) => option.value), typed = (name) => (typeof usual === "number" ? Number(name) : name);
  return { words: `one of ${names.join(", ")}`, value: (text) => names.filter((name) => name === text).map(typed)[0] };
}

// What a page shows stands in its address, so that it can be sent to others. An address that means
// nothing is answered by a sentence and by the page's usual state. `own` are the rules of the keys
// without a control.
function stateOf(usual, own) {
  const given = {}, address = location.hash.slice(1) || document.documentElement.dataset.state || "";
  for (const [key, text] of new URLSearchParams(address)) {
    if (!Object.hasOwn(usual, key)) return { reason: `The address has an unknown key: ${brief(key)}` };
    if (Object.hasOwn(given, key)) return { reason: `The address gives ${key} twice` };
    const { words, value } = own[key] ?? ruleOf(key, usual[key]);
    given[key] = value(text);
    if (given[key] === undefined) return { reason: `The address sets ${key} = ${brief(text)}, but ${key} must be ${words}` };
  }
  return { given };
}
const brief = (text) => (text === "" ? "nothing" : text.length > 40 ? `${text.slice(0, 40)}…` : text);
// Shows the state of the address by `show`, now and whenever another address is typed. `show` may
// change a value that does not go with the others, such as a step beyond the last one.
function follow(usual, own, show) {
  const begin = () => {
    let { given = {}, reason } = stateOf(usual, own);
    state = { ...usual, ...given };
    show();
    const changed = Object.keys(given).find((key) => String(state[key]) !== String(given[key]));
    if (changed) {
      reason = `The address sets ${changed} = ${given[changed]}, which does not fit its other values`;
      state = { ...usual };
      show();
    }
    find("#address").hidden = !reason;
    find("#address").textContent = reason ? `${reason}. The page uses its default settings.` : "";
  };
  addEventListener("hashchange", begin);
  begin();
  document.documentElement.dataset.ready = "yes";
  unfinished.contentDocument?.close();
  unfinished.remove();
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

// Draws a picture anew; a handle in it keeps the focus.
function paint(picture, content) {
  const focus = document.activeElement?.id;
  picture.innerHTML = content;
  if (focus) queueMicrotask(() => picture.querySelector(`#${focus}`)?.focus()); // once it can be dragged again
}

// A handle that is dragged by pointer and by arrow keys; moved(dx, dy) is given in the picture's own units.
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
