"""The command ``lcplab``."""

import signal
import sys

from lcplab._lcplab import run
from lcplab._import import command as importing


def main() -> int:
    """Run the command line of ``sys.argv`` and return its exit code."""
    if sys.argv[1:2] == ["import"]:
        return importing.main(sys.argv[2:])
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # the program hears Ctrl-C itself
    code = run(["lcplab", *sys.argv[1:]])
    if sys.argv[1:] in (["--help"], ["-h"], ["help"]):
        print("\nThe Python package adds: lcplab import FILE, which writes an MJCF or URDF model as a scene.")
    return code


if __name__ == "__main__":
    sys.exit(main())
