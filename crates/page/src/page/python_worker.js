// Runs the Python cells of a page, in Pyodide. A message {cells, first} runs the cells from this one to the last; the
// answers are {ready}, {cell, text} for what a cell prints, and {cell, seconds, failed} at its end.
import { loadPyodide } from "./pyodide/pyodide.mjs";

// Before each cell the values of all names are kept, so that a changed cell runs as if for the first time.
const RUNNER = `
import copy, linecache, sys, traceback, types

try:
    import numpy
except ImportError:
    import arrays
    sys.modules["numpy"] = arrays

names, before = {"__name__": "__main__"}, []

def copies(values):
    copied, memo = {}, {}
    for name, value in values.items():
        try:
            copied[name] = copy.deepcopy(value, memo)
        except Exception:
            copied[name] = value  # modules and the like
    return copied

def run(k, code):
    """The traceback of cell k, or None."""
    if k < len(before):
        names.clear()
        names.update(before[k])
    before[k:] = [copies(names)]
    file = f"cell {k + 1}"
    linecache.cache[file] = len(code), None, code.splitlines(True), file
    try:
        exec(compile(code, file, "exec"), names)
    except BaseException as error:
        details = traceback.TracebackException.from_exception(error)
        own = [frame for frame in details.stack[1:] if not frame.filename.endswith("arrays.py")]
        details.stack = traceback.StackSummary.from_list(own)
        return "".join(details.format())
    finally:
        sys.stdout.flush()
`;

const at = (name) => new URL(name, import.meta.url).href;

// The memory of a Python that has just started is kept in the browser's cache: to start from it takes a fraction of the
// time. Without a cache, or if that memory is not of this version, Python starts as it did the first time.
async function interpreter() {
  const files = { indexURL: at("pyodide/"), packageBaseUrl: at("pyodide/") };
  const cache = await globalThis.caches?.open("lcplab").catch(() => undefined);
  const kept = await cache?.match(files.indexURL);
  if (kept) {
    try {
      return await loadPyodide({ ...files, _loadSnapshot: await kept.arrayBuffer() });
    } catch {} // of another version
  }
  const python = await loadPyodide({ ...files, _makeSnapshot: true });
  cache?.put(files.indexURL, new Response(python.makeMemorySnapshot())).catch(() => {}); // a full disk
  return python;
}

async function start() {
  const python = await interpreter();
  await python.loadPackagesFromImports("import numpy"); // does nothing where the distribution is without it
  for (const file of ["engine.py", "arrays.py"]) {
    const answer = await fetch(at(`../${file}`));
    if (!answer.ok) throw new Error(`${file}: ${answer.status} ${answer.statusText}`);
    python.FS.writeFile(file, await answer.text());
  }
  python.runPython(RUNNER);
  return python;
}

const started = start();
started.then(() => postMessage({ ready: true }), (reason) => postMessage({ broken: String(reason) }));

onmessage = async ({ data: { cells, first } }) => {
  const python = await started, run = python.globals.get("run");
  for (let cell = first; cell < cells.length; cell++) {
    postMessage({ cell, begins: true });
    const text = new TextDecoder();
    const write = (bytes) => { postMessage({ cell, text: text.decode(bytes, { stream: true }) }); return bytes.length; };
    python.setStdout({ write });
    python.setStderr({ write });
    const before = performance.now(), error = run(cell, cells[cell]);
    if (error) postMessage({ cell, text: error });
    postMessage({ cell, seconds: (performance.now() - before) / 1000, failed: Boolean(error) });
    if (error) return;
  }
};
