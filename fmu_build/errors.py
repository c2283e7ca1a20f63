"""The one exception that users of this package see."""


class BuildError(Exception):
    """An FMU could not be built. The message is one line that names the thing, the place and what is allowed."""
