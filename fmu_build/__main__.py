"""``python -m fmu_build``: from its first import on it can be interrupted."""

import sys


def main() -> int:
    """Run the command line and return its exit status, see ``cli.main``."""
    try:
        from .cli import main as fmu_build

        return fmu_build()
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
