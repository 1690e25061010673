// The search page: results of the index that pagefind wrote.
const field = document.querySelector("main input"), list = document.getElementById("results"), state = document.getElementById("state");
const most = 12;
const fillers = new Set("a an and are at be by can do does for from had has have how i if in is it its me my of on or our that the there this to was we what when where which who why with you your".split(" "));
const base = new URL("pagefind/", import.meta.url);
const pagefind = await import(new URL("pagefind.js", base)).catch(() => null);
await pagefind?.options({ ranking: { metaWeights: { title: 8, about: 4, section: 0 } } });

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
  item.append(link(found.url, found.meta.title), where);
  if (found.meta.about) {
    const about = document.createElement("p");
    about.textContent = found.meta.about;
    item.append(about);
  }
  item.append(marked(document.createElement("p"), found.excerpt));
  const parts = found.sub_results.filter((part) => part.url !== found.url && part.url.includes("#") && part.title !== found.meta.title).slice(0, 3);
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

/** Pages with all the words but fillers; if they do not fill the list, then those with some of the words, by how much they have of each. */
async function pagesWith(words) {
  const telling = words.toLowerCase().split(/[\s?!,]+/).filter((word) => word && !fillers.has(word));
  const all = (await pagefind.search(telling.join(" ") || words)).results;
  if (all.length >= most || telling.length < 2) return { all, some: [] };
  const shares = new Map();
  for (const word of telling) {
    const { results } = await pagefind.search(word);
    for (const result of results) {
      const before = shares.get(result.id)?.share ?? 0;
      shares.set(result.id, { result, share: before + 1 + result.score / results[0].score });
    }
  }
  all.forEach((result) => shares.delete(result.id));
  const some = [...shares.values()].sort((a, b) => b.share - a.share).map(({ result }) => result);
  return { all, some };
}

let asked = 0;

async function search(words) {
  if (!pagefind) {
    state.textContent = "The search needs a web server: python3 -m http.server in the folder of this site.";
    return;
  }
  const mine = ++asked;
  if (words) state.textContent = "Searching …";
  const { all, some } = words.trim() ? await pagesWith(words) : { all: [], some: [] };
  const found = await Promise.all([...all, ...some].slice(0, most).map((result) => result.data()));
  if (mine !== asked) return; // a later one is on its way
  list.replaceChildren(...found.map(entry));
  const pages = (count) => `${count} page${count === 1 ? "" : "s"}`;
  const more = some.length ? ` with all of these words, ${some.length} with some` : "";
  state.textContent = !words ? "" : found.length ? pages(all.length) + more : `Nothing was found for “${words}”.`;
  document.body.dataset.searched = words;
}

let pause;

field.value = new URLSearchParams(location.search).get("q") ?? "";
field.addEventListener("input", () => {
  history.replaceState(null, "", field.value ? `?q=${encodeURIComponent(field.value)}` : location.pathname);
  clearTimeout(pause);
  pause = setTimeout(() => search(field.value), 150);
});
document.querySelector("main form").addEventListener("submit", (event) => event.preventDefault());
if (field.value) search(field.value);
