"""``python -m fmu_build``: from its first import on it can be interrupted, and says what it needs that is not there."""

import sys


def main() -> int:
    """Run the command line and return its exit status, see ``cli.main``."""
    try:
        from .cli import main as fmu_build

        return fmu_build()
    except KeyboardInterrupt:
        return 130
    except ModuleNotFoundError as error:
        print(f"fmu_build: needs {error.name}: pip install 'overrun-hitch[build]'", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
