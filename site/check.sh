#!/usr/bin/env bash
# Builds the site with what CI has built already, and checks it. Reports that take minutes are left out;
# `site/check.sh full` builds all of it, with the release program, as it is published, and lets Lighthouse rate pages.
set -euo pipefail
cd "$(dirname "$0")/.."

python3 -m venv target/site-tools
target/site-tools/bin/pip install --quiet --disable-pip-version-check -r site/requirements.txt
export PATH="$PWD/target/site-tools/bin:$PATH"

rm -rf target/site target/public
mkdir -p target/site
if [ -e target/set/index.csv ]; then cp -r target/set target/site/set; fi
if [ -e target/doc/lcplab/index.html ]; then rustdoc=(--rustdoc target/doc); else rustdoc=(); fi
if [ "${1:-}" = full ]; then program=(--lcplab target/release/lcplab); else program=(--lcplab target/debug/lcplab --quick); fi
if [ -e target/pyodide/node_modules/pyodide ]; then pyodide=(--pyodide target/pyodide/node_modules/pyodide); else pyodide=(); fi
python site/build.py --out target/public "${program[@]}" "${rustdoc[@]}" "${pyodide[@]}"

# What a page looks like is checked where there are npm and Chromium.
if command -v npm >/dev/null && command -v chromium >/dev/null; then
    modules=(axe-core@4 playwright-core@1)
    rm -rf target/site-modules
    [ "${1:-}" != full ] || modules+=(lighthouse@12)
    npm install --silent --no-fund --no-audit --prefix target/site-modules "${modules[@]}"
    python site/check.py target/public target/site-modules
else
    echo "skipped: no npm or no chromium here, so pages are not checked"
    python site/check.py target/public
fi
