"""Checks a built site: links, reach, policies and, with Chromium and npm's axe-core, pages as they are seen.

`python3 site/check.py FOLDER [MODULES]`, where MODULES holds axe-core and playwright-core, and lighthouse if pages are
rated too."""

import functools
import gzip
import http.server
import io
import json
import re
import subprocess
import sys
import threading
from collections import deque
from pathlib import Path
from urllib.parse import urljoin, urlsplit

HERE = Path(__file__).resolve().parent

# A page of each kind, as patterns; not every site has every report.
SEEN = [
    "index.html",
    "search.html",
    "guide/index.html",
    "guide/overview.html",
    "guide/commands.html",
    "learn/*_sweeping.html",
    "learn/errata.html",
    "learn/live/two_rows.html",
    "learn/live/stack.html",
    "learn/live/problem.html",
    "problems/set.html",
    "problems/cards/040_*.html",
    "reports/standard/index.html",
    "reports/engines/index.html",
    "reports/receipts/index.html",
    "reference/python.html",
    "reference/options.html",
]

# Pages of which Lighthouse rates the speed and the accessibility: the first one, and one of each kind.
RATED = [
    "index.html",
    "guide/commands.html",
    "learn/*_sweeping.html",
    "learn/live/stack.html",
    "problems/cards/040_*.html",
    "reports/engines/index.html",
]


def main() -> None:
    site = Path(sys.argv[1]).resolve()
    links(site)
    reach(site)
    policies(site)
    if len(sys.argv) > 2:
        seen(site, Path(sys.argv[2]).resolve())


def links(site: Path) -> None:
    """Every link leads to a file, every fragment to an anchor; the state of a live page is no anchor."""
    command = ["lychee", "--offline", "--include-fragments", "--no-progress", "--root-dir", str(site)]
    command += ["--exclude", "/live/[a-z_]+[.]html#", "--exclude-path", "reference/rust", str(site)]
    done = subprocess.run(command, capture_output=True, text=True)
    print(done.stdout.strip().splitlines()[-1])
    if done.returncode:
        sys.exit(done.stdout + done.stderr)


def pages(site: Path) -> list[Path]:
    return [page for page in sorted(site.rglob("*.html")) if "reference/rust/" not in page.as_posix()]


def reach(site: Path) -> None:
    """Every page is at most two clicks from the first one."""
    clicks = {"index.html": 0}
    queue = deque(clicks)
    while queue:
        page = queue.popleft()
        text = (site / page).read_text(encoding="utf-8")
        for target in re.findall(r'<a [^>]*href="([^"#]+)', text):
            path = urlsplit(urljoin(f"http://site/{page}", target))
            name = path.path.removeprefix("/")
            if path.netloc == "site" and name.endswith(".html") and name not in clicks:
                clicks[name] = clicks[page] + 1
                if "reference/rust/" not in name:
                    queue.append(name)
    # Files of the repository, which only the text that mentions them leads to, may be one click farther.
    far = [
        name
        for page in pages(site)
        if clicks.get(name := page.relative_to(site).as_posix(), 9) > 2 + name.startswith("files/")
    ]
    if far:
        sys.exit(f"more than two clicks away: {far}")
    print(f"{len(pages(site))} pages, each at most two clicks away")


def policies(site: Path) -> None:
    """Every page states a policy that names no other host, and loads nothing from one."""
    for page in pages(site):
        text = page.read_text(encoding="utf-8")
        policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', text)
        if not policy or "default-src 'none'" not in policy[1] or re.search(r"https?:|\*", policy[1]):
            sys.exit(f"{page}: its Content-Security-Policy is missing or names another host")
        if loaded := re.search(r'<(?:script|img|link|iframe)[^>]* (?:src|href)="(https?:[^"]*)"', text):
            sys.exit(f"{page}: loads {loaded[1]}")


def seen(site: Path, modules: Path) -> None:
    """What Chromium shows: accessibility, width, requests, errors, the answers of the search, and Lighthouse's scores."""
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Server, directory=str(site))) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        base = f"http://127.0.0.1:{server.server_address[1]}/"

        def passes(script: str, kinds: list[str], *arguments: str) -> bool:
            addresses = [page.relative_to(site).as_posix() for kind in kinds for page in site.glob(kind)]
            command = ["node", str(HERE / script), str(modules), base, json.dumps(addresses), *arguments]
            return subprocess.run(command).returncode == 0

        good = passes("look.mjs", SEEN, str(HERE / "questions.json"))
        if (modules / "node_modules/lighthouse").exists():
            good &= passes("lighthouse.mjs", RATED)
        server.shutdown()
    sys.exit(not good)


class Server(http.server.SimpleHTTPRequestHandler):
    """Compresses text, as servers do."""

    def send_head(self) -> io.BufferedIOBase | None:
        path = Path(self.translate_path(self.path))
        if not path.is_file() or path.suffix not in {".html", ".css", ".js", ".mjs", ".svg", ".json"}:
            return super().send_head()
        data = gzip.compress(path.read_bytes())
        self.send_response(200)
        self.send_header("Content-Type", self.guess_type(path))
        self.send_header("Content-Encoding", "gzip")
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        return io.BytesIO(data)

    def handle(self) -> None:
        try:
            super().handle()
        except (BrokenPipeError, ConnectionResetError):
            pass  # the browser has closed the page

    def log_message(self, *_: object) -> None:
        """Requests are not worth a line each."""


if __name__ == "__main__":
    main()
