"""`python -m overrun_hitch` is `hitch`."""

import sys

from overrun_hitch.cli import main

if __name__ == "__main__":
    sys.exit(main())
