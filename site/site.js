// The theme, which is remembered, and the contents of a section, which are closed on a narrow screen. It stands before
// the text, so that nothing moves when it runs.
const root = document.documentElement, button = document.querySelector(".theme"), key = "lcplab-theme";
const prefers = matchMedia("(prefers-color-scheme: dark)");
const stored = () => { try { return localStorage.getItem(key); } catch { return null; } };
const keep = (theme) => { try { localStorage.setItem(key, theme); } catch { /* a page from a file may have no storage */ } };
const dark = () => (root.dataset.theme ?? (prefers.matches ? "dark" : "light")) === "dark";
const announce = () => button.setAttribute("aria-pressed", String(dark()));

if (stored()) root.dataset.theme = stored();
button.hidden = false;
button.addEventListener("click", () => {
  root.dataset.theme = dark() ? "light" : "dark";
  keep(root.dataset.theme);
  announce();
});
prefers.addEventListener("change", announce);
announce();

const side = document.querySelector(".side details");
if (side && matchMedia("(max-width: 61.99rem)").matches) side.open = false;
