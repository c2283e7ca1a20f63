"""`hitch`, also as `python -m overrun_hitch`: from its first import on it can be interrupted."""

import os
import sys


def main() -> int:
    """Run the command line and return its exit status, see cli.main."""
    try:
        from overrun_hitch.threads import ONE_THREAD

        os.environ.update({**ONE_THREAD, **os.environ})
        from overrun_hitch.cli import main as hitch

        return hitch()
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
