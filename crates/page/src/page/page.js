"use strict";
// Light and dark, the contents list, and tables sorted by a column; the page reads the same without.
const root = document.documentElement;
root.classList.add("live");
const remembered = (use) => { try { return use(localStorage); } catch { return null; } }; // a browser may forbid it

{ // The button turns the colors, for all pages of lcplab at this address; until then the reader's own preference holds.
  const kept = remembered((store) => store.getItem("lcplab-theme"));
  if (kept) root.dataset.theme = kept;
  const button = document.querySelector(".theme"), prefers = matchMedia("(prefers-color-scheme: dark)");
  const dark = () => (root.dataset.theme ?? (prefers.matches ? "dark" : "light")) === "dark";
  const announce = () => button.setAttribute("aria-pressed", dark());
  button.addEventListener("click", () => {
    root.dataset.theme = dark() ? "light" : "dark";
    remembered((store) => store.setItem("lcplab-theme", root.dataset.theme));
    announce();
  });
  prefers.addEventListener("change", announce);
  button.hidden = false;
  announce();
}

{ // Beside the text if there is room, else folded; the section being read is marked.
  const list = document.querySelector(".rail details"), room = matchMedia("(min-width: 75rem)");
  const fold = () => { list.open = room.matches; };
  const links = new Map([...list.querySelectorAll("a")].map((a) => [a.getAttribute("href").slice(1), a]));
  room.addEventListener("change", fold);
  fold();
  list.addEventListener("click", (event) => { if (event.target.closest("a") && !room.matches) fold(); });
  list.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || room.matches) return;
    fold();
    list.querySelector("summary").focus();
  });
  const seen = new Set();
  const watch = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) seen[isIntersecting ? "add" : "delete"](target.id);
    const now = [...links.keys()].find((id) => seen.has(id));
    for (const [id, a] of links) id === now ? a.setAttribute("aria-current", "true") : a.removeAttribute("aria-current");
  }, { rootMargin: "-15% 0px -60% 0px" });
  for (const section of document.querySelectorAll("main > section")) watch.observe(section);
}

{ // What can be scrolled to one side shows it there, and the keyboard can scroll it.
  const frames = document.querySelectorAll(".scroll, .equation, p:has(> .parts), pre");
  const marked = (frame) => {
    const rest = frame.scrollWidth - frame.clientWidth - frame.scrollLeft;
    frame.classList.toggle("more-left", frame.scrollLeft > 1);
    frame.classList.toggle("more-right", rest > 1);
    if (rest > 1 && frame.tabIndex < 0) frame.tabIndex = 0;
  };
  const watch = new ResizeObserver((entries) => entries.forEach(({ target }) => marked(target)));
  for (const frame of frames) {
    watch.observe(frame);
    frame.addEventListener("scroll", () => marked(frame), { passive: true });
  }
}

for (const table of document.querySelectorAll("figure.table table")) {
  const heads = [...table.tHead.rows[0].cells];
  const key = (row, column) => {
    const cell = row.cells[column];
    return "value" in cell.dataset ? Number(cell.dataset.value) : cell.textContent;
  };
  const compare = (a, b) => {
    if (typeof a === "number" && typeof b === "number") {
      return Number.isNaN(a) - Number.isNaN(b) || a - b || 0;
    }
    if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
    return a.localeCompare(b, "en", { numeric: true });
  };
  heads.forEach((head, column) => {
    // No <button>: its words would be missing where print repeats the heads.
    const button = document.createElement("span");
    for (const [name, value] of [["role", "button"], ["tabindex", 0], ["title", "Sort by this column"]]) button.setAttribute(name, value);
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      button.click();
    });
    button.addEventListener("click", () => {
      const up = head.getAttribute("aria-sort") !== "ascending";
      for (const other of heads) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      const rows = [...table.tBodies[0].rows];
      rows.sort((a, b) => (up ? 1 : -1) * compare(key(a, column), key(b, column)));
      table.tBodies[0].append(...rows);
    });
  });
}

// One choice of the language holds for the whole page, and for the pages opened later.
const switches = document.querySelectorAll(".switch button");
const speak = (language) => {
  root.dataset.language = language;
  for (const button of switches) button.setAttribute("aria-pressed", button.dataset.language === language);
};
if (switches.length && remembered((store) => store.getItem("language")) === "rust") speak("rust");
for (const button of switches) {
  button.addEventListener("click", () => {
    const before = button.getBoundingClientRect().top;
    speak(button.dataset.language);
    remembered((store) => store.setItem("language", button.dataset.language));
    scrollBy({ top: button.getBoundingClientRect().top - before, behavior: "instant" });
  });
}
