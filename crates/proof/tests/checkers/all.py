"""What lcpcheck.py says of pairs of a problem and a proof: JSON lines of two texts in, a word each out."""
import importlib.util, json, sys
from pathlib import Path

checker, pairs = map(Path, sys.argv[1:])
specification = importlib.util.spec_from_file_location("lcpcheck", checker)
lcpcheck = importlib.util.module_from_spec(specification)
specification.loader.exec_module(lcpcheck)


def verdict(problem, proof):
    try:
        problem = lcpcheck.Problem(lcpcheck.read(problem))
    except lcpcheck.WRONG:
        return "unreadable"
    try:
        lcpcheck.check(problem, lcpcheck.read(proof))
        return "proved"
    except lcpcheck.WRONG:
        return "rejected"


for line in pairs.read_text(encoding="utf-8").split("\n")[:-1]:
    print(verdict(*json.loads(line)))
