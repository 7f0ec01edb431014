"""The page of `tact view` in a notebook's cell, without a server."""

import html
import os

from . import _tact


class Page:
    """A page for the browser that plays steps and shows of every facet why it was kept or dropped."""

    __slots__ = ("html", "height")

    def __init__(self, text, height):
        self.html, self.height = text, height

    def save(self, path):
        """writes the page to a file, which needs no network"""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.html)

    def _repr_html_(self):
        text = html.escape(self.html)
        return f'<iframe sandbox="allow-scripts" style="width:100%;height:{self.height}px;border:0" srcdoc="{text}"></iframe>'

    def __repr__(self):
        return f"<tact.Page of {len(self.html) / 1e6:.1f} MB>"


def view(what, *, title=None, height=640, every=1, start=0, stop=None, few_points=False, points=False, curves=False):
    """The page that `tact view` writes, of a world as it stands or of a recording, for a notebook's cell.

    A World is copied and stepped once: it stays as it is. A recording is a path that World.record() or check(record=...)
    wrote; of its steps the page shows every `every`th from `start` to `stop`. Errors: ValueError, OSError, Error.
    """
    if isinstance(what, _tact.World):
        if every != 1 or start != 0 or stop is not None or few_points or points or curves:
            raise TypeError("every, start, stop, few_points, points and curves are for recordings: a world shows its one step as its settings are")
        text = _tact._page_of_world(what, title or "world")
    else:
        os.stat(what)
        text = _tact._page_of_recording(what, every=every, start=start, stop=stop, few_points=few_points, points=points, curves=curves)
    return Page(text, height)
