// Puts the long parts of a page (see later.py) into their places after its text, and runs the page's own script.
const { first, own, rest } = document.currentScript.dataset;
const pause = () => new Promise((done) => setTimeout(done)); // in which the page answers its reader

function run(address) {
  return new Promise((done, failed) => {
    const script = document.createElement("script");
    Object.assign(script, { src: address, onload: done, onerror: failed });
    document.body.append(script);
  });
}

async function fill(address) {
  await run(address);
  for (const [key, part] of Object.entries(globalThis.parts)) {
    await pause();
    document.querySelector(`[data-later="${key}"]`).innerHTML = part;
  }
}

async function fillAll() {
  await fill(first);
  await pause();
  await run(own);
  if (location.hash) document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView();
  for (const address of rest.split(" ").filter(Boolean)) {
    await fill(address);
    await pause();
    dispatchEvent(new Event("resize")); // prepares figures that are new
  }
}

if (document.readyState === "complete") fillAll();
else addEventListener("load", fillAll);
