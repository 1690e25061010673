
{ // Python cells can be changed and run: all of a page in one interpreter, in a worker that is loaded at the first run.
  const LIMIT = 60, MOST = 100000; // seconds of a cell, characters of its output
  const element = (kind, name, text) => Object.assign(document.createElement(kind), { className: name, textContent: text ?? "" });
  const containers = [...document.querySelectorAll("div.python")];
  let worker = null, timer = 0, running = null, executed = []; // the cell that was asked for; the texts that the interpreter has run

  const cells = containers.map((box, k) => {
    const imports = box.querySelector("details.imports pre"), code = [...box.querySelectorAll(".language-python")].at(-1).parentElement;
    if (imports) {
      code.firstChild.prepend(...imports.firstChild.childNodes, "\n\n");
      imports.parentElement.remove();
    }
    const output = code.nextElementSibling ?? box.appendChild(element("pre", "", ""));
    if (!output.firstChild) output.append(element("code", "language-text"));
    const cell = { box, code, original: code.innerHTML, output: output.firstChild, status: element("span", "status"), name: `Run cell ${k + 1}` };
    output.hidden = !output.textContent;
    cell.run = element("button", "run", cell.name);
    cell.reset = element("button", "", "Reset to the original");
    cell.status.setAttribute("role", "status");
    const bar = element("div", "bar");
    bar.append(cell.run, cell.reset, cell.status);
    code.after(bar);
    for (const button of [cell.run, cell.reset]) button.type = "button";
    cell.run.title = "Runs the cells above it first. Keys in the cell: Shift + Enter";
    cell.reset.hidden = true;
    return cell;
  });

  const text = (cell) => (cell.code.innerText || cell.code.textContent).replace(/\n*$/, "\n"); // the first is empty in a closed fold
  const setStatus = (cell, words) => { cell.status.textContent = words; };

  const addOutput = (cell, words, isFirst) => {
    cell.output.parentElement.hidden = false;
    cell.output.textContent = (isFirst ? "" : cell.output.textContent) + words;
  };

  const setRunning = (k) => { // for this cell, whose button stops it, or for none
    running = k;
    cells.forEach((cell, i) => {
      cell.run.textContent = i === k ? "Stop" : cell.name;
      cell.run.disabled = k !== null && i !== k;
    });
  };

  const finish = () => { clearTimeout(timer); setRunning(null); };

  const stop = (words) => { // only the end of its worker ends a cell
    if (worker) worker.onmessage = worker.onerror = null; // what it has sent already is not wanted
    worker?.terminate();
    worker = null;
    executed = [];
    if (running !== null) setStatus(cells[running], `${words} Python starts again at the next run.`);
    finish();
  };

  const onMessage = ({ data }) => {
    if (data.broken) return stop(`Python could not be loaded: ${data.broken}.`);
    const cell = cells[data.cell];
    if (data.begins) {
      cell.printed = 0;
      cell.output.parentElement.classList.remove("failed");
      setStatus(cells[running], `Running cell ${data.cell + 1} …`);
      clearTimeout(timer);
      timer = setTimeout(() => stop(`Stopped: cell ${data.cell + 1} ran for ${LIMIT} s.`), LIMIT * 1000);
    } else if ("text" in data) {
      addOutput(cell, data.text, cell.printed === 0);
      cell.printed += data.text.length;
      if (cell.printed > MOST) stop(`Stopped: cell ${data.cell + 1} printed more than ${MOST} characters.`);
    } else if ("seconds" in data) {
      if (cell.printed === 0) cell.output.parentElement.hidden = true;
      cell.output.parentElement.classList.toggle("failed", data.failed);
      setStatus(cells[running], data.failed ? `Error in cell ${data.cell + 1}` : `Done in ${data.seconds.toFixed(data.seconds < 1 ? 2 : 1)} s`);
      if (!data.failed) executed[data.cell] = cell.sent;
      if (data.failed || data.cell === running) finish();
    }
  };

  const run = (k) => {
    if (running === k) return stop("Stopped.");
    if (running !== null) return;
    if (!worker) {
      worker = new Worker("python/worker.js", { type: "module" });
      worker.onmessage = onMessage;
      worker.onerror = (event) => { event.preventDefault(); stop("Python could not be loaded."); };
      setStatus(cells[k], "Loading Python …");
    }
    for (const cell of cells) cell.sent = text(cell);
    // The first cell that the interpreter has not run as it is now, or the one that was asked for.
    const first = cells.findIndex((cell, i) => i === k || executed[i] !== cell.sent);
    executed.length = Math.min(executed.length, first);
    setRunning(k);
    worker.postMessage({ cells: cells.slice(0, k + 1).map((cell) => cell.sent), first });
  };

  const editable = (cell, k) => {
    cell.code.contentEditable = "true";
    try { cell.code.contentEditable = "plaintext-only"; } catch { } // some browsers of 2023 and 2024
    cell.code.spellcheck = false;
    for (const [name, value] of [["role", "textbox"], ["aria-multiline", true], ["aria-label", `Python cell ${k + 1}`]]) cell.code.setAttribute(name, value);
    cell.code.addEventListener("input", () => {
      cell.code.classList.add("changed"); // the colors are those of the original
      cell.reset.hidden = false;
    });
    cell.code.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      if (event.shiftKey || event.ctrlKey || event.metaKey) return run(k);
      const line = getSelection().toString() ? "" : before(cell.code).split("\n").at(-1);
      document.execCommand("insertText", false, `\n${line.match(/^ */)[0]}${line.trimEnd().endsWith(":") ? "    " : ""}`);
    });
    cell.run.addEventListener("click", () => run(k));
    cell.reset.addEventListener("click", () => {
      cell.code.innerHTML = cell.original;
      cell.code.classList.remove("changed");
      cell.reset.hidden = true;
      cell.code.focus();
    });
  };

  const before = (code) => { // the text before the caret
    const range = getSelection().getRangeAt(0).cloneRange();
    range.setStart(code, 0);
    return range.toString();
  };

  if (location.protocol === "file:") {
    for (const { box } of cells) box.querySelector(".bar").remove();
    containers[0]?.append(element("p", "hint", "To run and change the cells, serve this folder: python3 -m http.server, then open http://localhost:8000."));
  } else {
    cells.forEach(editable);
  }
}
