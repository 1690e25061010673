// Plots that say what a point is, and whose curves are shown and hidden in the legend. What it needs
// stands in the attributes of the picture: frame, axes and points of each panel.
{
  const tip = document.createElement("div");
  tip.className = "tip";
  tip.hidden = true;
  document.body.append(tip);
  const REACH = 48; // px of the picture within which a point answers the pointer

  const make = (parent, name, attributes) => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    parent.append(node);
    return node;
  };
  const within = (value, lo, hi) => value >= lo - 1 && value <= hi + 1;

  // 1.234×10⁻⁵, as the rest of the page writes numbers.
  const readable = (value) => {
    if (value === 0) return "0";
    const [digits, power] = value.toExponential(3).split("e").map(Number);
    if (power >= 3 && power < 5) return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, ",").replace("-", "−");
    if (power >= -3 && power < 3) return String(Number(value.toPrecision(4))).replace("-", "−");
    const raised = String(power).replace(/./g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));
    return `${digits === 1 ? "" : `${digits}×`}10${raised}`.replace("-", "−");
  };

  // The axis called x or y: its words, and the place in px of a value between two edges.
  const axis = (panel, name, from, to) => {
    const [scale, lo, hi] = panel.dataset[name].split(" ");
    const [kind, power] = scale.split(":");
    const position = (value) => {
      if (kind === "symmetric") return Math.sign(value) * Math.log10(1 + Math.abs(value) / 10 ** power);
      return kind === "log" ? Math.log10(value) : value;
    };
    const place = (value) => from + ((position(value) - lo) / (hi - lo)) * (to - from);
    return { name: panel.dataset[`${name}Name`], unit: panel.dataset[`${name}Unit`], place };
  };

  const read = (panel) => {
    const [left, right, top, bottom] = panel.dataset.frame.split(" ").map(Number);
    const x = axis(panel, "x", left, right), y = axis(panel, "y", bottom, top);
    const curve = (group) => {
      const numbers = group.dataset.points.split(" ").map(Number), points = [];
      for (let k = 0; k + 1 < numbers.length; k += 2) {
        const [a, b] = [numbers[k], numbers[k + 1]], down = y.place(b);
        // An exact zero that a logarithmic axis has no place for is drawn on the frame.
        const at = [x.place(a), down === Infinity ? bottom - 6 : down];
        if (at.every(Number.isFinite)) points.push({ values: [a, b], at });
      }
      return { name: group.dataset.series, group, points };
    };
    const curves = [...panel.querySelectorAll("[data-points]")].map(curve).filter(({ points }) => points.length > 0);
    return { panel, frame: { left, right, top, bottom }, x, y, curves };
  };

  // The words of a point: its curve, then a line an axis.
  const words = ({ x, y }, { name, points }, k) => {
    const line = (of, value) => (of.name === undefined ? [] : [`${of.name} ${readable(value)}${of.unit && ` ${of.unit}`}`]);
    return [name, ...line(x, points[k].values[0]), ...line(y, points[k].values[1])];
  };

  const enliven = (svg) => {
    const plots = [...svg.querySelectorAll(".panel")].map(read).filter(({ curves }) => curves.length > 0);
    const ring = make(svg, "circle", { class: "here", r: 6.5, visibility: "hidden" });
    let shown = null;

    const show = (plot, curve, k) => {
      shown = { plot, curve, k };
      const [x, y] = curve.points[k].at, lines = words(plot, curve, k);
      ring.setAttribute("cx", x);
      ring.setAttribute("cy", y);
      ring.setAttribute("visibility", "visible");
      tip.replaceChildren(...lines.map((text, i) => {
        const line = document.createElement(i ? "span" : "b");
        line.textContent = text;
        return line;
      }));
      tip.hidden = false;
      const spot = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM());
      const { width, height } = tip.getBoundingClientRect();
      const left = spot.x + 14 + width > root.clientWidth ? spot.x - 14 - width : spot.x + 14;
      tip.style.left = `${Math.max(4, left)}px`;
      tip.style.top = `${Math.max(4, spot.y - height - 10)}px`;
      plot.field.setAttribute("aria-valuemax", curve.points.length - 1);
      plot.field.setAttribute("aria-valuenow", k);
      plot.field.setAttribute("aria-valuetext", lines.join(", "));
    };
    const hide = () => {
      ring.setAttribute("visibility", "hidden");
      tip.hidden = true;
      shown = null;
    };

    const visible = ({ curves }) => curves.filter(({ group }) => !group.classList.contains("off"));
    const point = (event) => {
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
      const plot = plots.find(({ frame }) => within(at.x, frame.left, frame.right) && within(at.y, frame.top, frame.bottom));
      let nearest = null, least = REACH;
      for (const curve of plot ? visible(plot) : []) {
        curve.points.forEach((point, k) => {
          // A bar answers all along.
          const across = plot.y.name === undefined ? 0 : point.at[0] - at.x;
          const far = Math.hypot(across, point.at[1] - at.y);
          if (far < least) { least = far; nearest = [plot, curve, k]; }
        });
      }
      nearest ? show(...nearest) : hide();
    };
    svg.addEventListener("pointermove", point);
    svg.addEventListener("pointerdown", point);
    svg.addEventListener("pointerleave", hide);

    // Arrow keys: along a curve, and from curve to curve.
    const step = (plot, key) => {
      const curves = visible(plot), on = shown?.plot === plot ? curves.indexOf(shown.curve) : -1;
      if (key === "Escape" || curves.length === 0) return hide();
      if (on < 0) return show(plot, curves[0], 0);
      const { curve, k } = shown, last = curve.points.length - 1;
      const along = { ArrowRight: k + 1, ArrowLeft: k - 1, PageDown: k + 10, PageUp: k - 10, Home: 0, End: last }[key];
      if (along !== undefined && last > 0) return show(plot, curve, Math.min(last, Math.max(0, along)));
      const by = ["ArrowDown", "ArrowRight"].includes(key) ? 1 : -1;
      const next = curves[(on + by + curves.length) % curves.length];
      const away = next.points.map((point) => Math.abs(point.at[0] - curve.points[k].at[0]));
      show(plot, next, away.indexOf(Math.min(...away)));
    };
    const keys = ["ArrowRight", "ArrowLeft", "ArrowUp", "ArrowDown", "PageUp", "PageDown", "Home", "End", "Escape"];
    for (const plot of plots) {
      const { left, right, top, bottom } = plot.frame;
      plot.field = make(svg, "rect", {
        class: "field", x: left, y: top, width: right - left, height: bottom - top, tabindex: 0, role: "slider",
        "aria-label": `points, ${plot.y.name ?? plot.x.name}`, "aria-valuemin": 0, "aria-valuemax": plot.curves[0].points.length - 1,
        "aria-valuenow": 0, "aria-valuetext": words(plot, plot.curves[0], 0).join(", "),
      });
      plot.field.addEventListener("focus", () => plot.field.matches(":focus-visible") && !shown && step(plot, "Home"));
      plot.field.addEventListener("blur", hide);
      plot.field.addEventListener("keydown", (event) => {
        if (!keys.includes(event.key) || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        step(plot, event.key);
      });
    }
    addEventListener("scroll", () => shown && hide(), { passive: true, capture: true });

    // The legend's entries are switches; the theory and the variants of a curve go with it.
    const entries = [...svg.querySelectorAll(".entry")];
    const turn = (entry, on) => {
      entry.setAttribute("aria-pressed", on);
      for (const group of svg.querySelectorAll(".series")) {
        const { series, of } = group.dataset;
        if ([series, of, series.split(", ")[0]].includes(entry.dataset.series)) group.classList.toggle("off", !on);
      }
    };
    for (const entry of entries) {
      const { x, y, width, height } = entry.getBBox();
      const pad = make(entry, "rect", { class: "pad", x: x - 3, y: y - 3, width: width + 6, height: height + 6, rx: 4 });
      entry.prepend(pad);
      for (const [name, value] of [["role", "button"], ["tabindex", 0], ["aria-pressed", true]]) entry.setAttribute(name, value);
      const toggle = () => { turn(entry, entry.getAttribute("aria-pressed") !== "true"); hide(); };
      entry.addEventListener("click", toggle);
      entry.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        toggle();
      });
    }

    // What is inside can be reached now; the picture's own titles would cover the tips.
    svg.setAttribute("role", "group");
    for (const title of svg.querySelectorAll(".series > title")) title.remove();
    const title = svg.querySelector(":scope > title"), words_of = svg.querySelector(":scope > desc");
    svg.removeAttribute("aria-labelledby");
    svg.setAttribute("aria-label", title.textContent);
    svg.setAttribute("aria-describedby", words_of.id);
    title.remove();
  };
  // A block of a matrix: the bodies that its rows share.
  for (const pair of document.querySelectorAll(".plot .pair")) {
    const bodies = pair.dataset.bodies.split(" ").flatMap((body) => [...pair.closest("svg").querySelectorAll(`[data-body="${body}"]`)]);
    const light = (on) => [pair, ...bodies].forEach((node) => node.classList.toggle("lit", on));
    pair.addEventListener("pointerenter", () => light(true));
    pair.addEventListener("pointerleave", () => light(false));
  }

  // Of a wide and a narrow picture one is on the page; the other is prepared when it is shown. A
  // picture that is put into the page later is prepared at the next resize event.
  const prepared = new WeakSet();
  const prepare = () => {
    for (const svg of document.querySelectorAll("figure.plot svg")) {
      if (prepared.has(svg) || !svg.querySelector("[data-points]")) continue;
      if (getComputedStyle(svg.parentElement).display === "none") continue;
      prepared.add(svg);
      enliven(svg);
    }
  };
  prepare();
  addEventListener("resize", prepare);
}
