// The search page: results of the index that pagefind wrote.
const field = document.querySelector("main input"), list = document.getElementById("results"), state = document.getElementById("state");
const most = 12;
const base = new URL("pagefind/", import.meta.url);
const pagefind = await import(new URL("pagefind.js", base)).catch(() => null);

/** Text in which pagefind marked the words that were found; nothing else of it is markup. */
function marked(node, excerpt) {
  excerpt.split(/<\/?mark>/).forEach((part, k) => {
    const piece = document.createElement(k % 2 ? "mark" : "span"), decoder = document.createElement("textarea");
    decoder.innerHTML = part;
    piece.textContent = decoder.value;
    node.append(piece);
  });
  return node;
}

function link(url, title) {
  const a = document.createElement("a");
  a.href = url;
  a.textContent = title;
  return a;
}

function entry(found) {
  const item = document.createElement("li"), where = document.createElement("span");
  where.className = "where";
  where.textContent = found.meta.section ?? "";
  item.append(link(found.url, found.meta.title), where, marked(document.createElement("p"), found.excerpt));
  const parts = found.sub_results.filter((part) => part.url !== found.url && part.url.includes("#")).slice(0, 3);
  if (parts.length) {
    const inside = document.createElement("ul");
    for (const part of parts) {
      const line = document.createElement("li");
      line.append(link(part.url, part.title));
      inside.append(line);
    }
    item.append(inside);
  }
  return item;
}

async function search(words) {
  if (!pagefind) {
    state.textContent = "The search needs a web server: python3 -m http.server in the folder of this site.";
    return;
  }
  if (words) state.textContent = "Searching …";
  const answer = await pagefind.debouncedSearch(words, {}, 150);
  if (!answer) return; // a later one is on its way
  const found = await Promise.all(answer.results.slice(0, most).map((result) => result.data()));
  list.replaceChildren(...found.map(entry));
  const { length } = answer.results;
  state.textContent = !words ? "" : length ? `${length} page${length > 1 ? "s" : ""}` : `Nothing was found for “${words}”.`;
  document.body.dataset.searched = words;
}

field.value = new URLSearchParams(location.search).get("q") ?? "";
field.addEventListener("input", () => {
  history.replaceState(null, "", field.value ? `?q=${encodeURIComponent(field.value)}` : location.pathname);
  search(field.value);
});
document.querySelector("main form").addEventListener("submit", (event) => event.preventDefault());
if (field.value) search(field.value);
