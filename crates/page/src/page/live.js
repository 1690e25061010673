
// A live page is opened where it is read. Its text stands in the page once, its state with each place.
for (const place of document.querySelectorAll("details.live")) {
  place.addEventListener("toggle", () => {
    if (!place.open || place.querySelector("iframe")) return;
    const { page, state } = place.dataset, frame = document.createElement("iframe");
    const text = JSON.parse(document.getElementById(`live-${page}`).textContent), escaped = document.createElement("div");
    escaped.textContent = state;
    frame.title = place.querySelector("summary").textContent;
    frame.srcdoc = text.replace("<html", () => `<html data-state="${escaped.innerHTML.replaceAll('"', "&quot;")}"`);
    frame.addEventListener("load", () => {
      const inside = frame.contentDocument.documentElement;
      const fit = () => { frame.style.height = `${inside.querySelector("body").offsetHeight + 40}px`; };
      new ResizeObserver(fit).observe(inside.querySelector("body"));
      fit();
    });
    place.append(frame);
  });
}
