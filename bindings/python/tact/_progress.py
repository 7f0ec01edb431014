"""Progress by tqdm, where it is installed and somebody looks."""

import contextlib
import sys


class _Silent:
    """What tqdm is asked for, without it."""

    def __init__(self, items):
        self.items, self.n, self.total = items, 0, None

    def __iter__(self):
        return iter(self.items)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def update(self, count):
        self.n += count


def _in_notebook():
    shell = sys.modules.get("IPython")
    shell = shell.get_ipython() if shell is not None else None
    return shell is not None and hasattr(shell, "kernel")


def progress_over(items, what, unit, wanted):
    """The items, with a line that tells how far they are; to be updated by hand if there are none."""
    seen = wanted and (_in_notebook() or (hasattr(sys.stderr, "isatty") and sys.stderr.isatty()))
    if not seen or (items is not None and len(items) < 2):
        return _Silent(items)
    try:
        with contextlib.suppress(ImportError):
            import ipywidgets  # noqa: F401  without it, tqdm.auto warns

            from tqdm.auto import tqdm

            return tqdm(items, desc=what, unit=unit)
        from tqdm import tqdm

        return tqdm(items, desc=what, unit=unit, delay=1.0)
    except ImportError:
        return _Silent(items)
