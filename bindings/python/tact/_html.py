"""Short HTML of reports, contacts and checks, for notebooks."""

import html

from . import _tact
from ._check import CheckFrame, CheckResult

MOST_ROWS = 20


def _table(caption, head, rows):
    def cells(tag, row):
        return "<tr>" + "".join(f"<{tag}>{html.escape(str(one))}</{tag}>" for one in row) + "</tr>"

    more = len(rows) - MOST_ROWS
    body = "".join(cells("td", row) for row in rows[:MOST_ROWS])
    end = f'<tr><td colspan="{len(head)}">{more} more</td></tr>' if more > 0 else ""
    return f"<table><caption>{html.escape(caption)}</caption><thead>{cells('th', head)}</thead><tbody>{body}{end}</tbody></table>"


def _metres(value):
    return "" if value is None else f"{value:.4g} m"


def _least(points):
    return float(points.gaps.min()) if len(points) else None


def _vector(values):
    return "(" + ", ".join(f"{value:.3f}" for value in values) + ")"


def _report(report):
    contacts = report.contacts
    rows = [(c.a.index, c.b.index, _metres(c.depth), len(c.facet_pairs), len(c.points), _metres(_least(c.points))) for c in contacts[:MOST_ROWS]]
    rows += [None] * (len(contacts) - len(rows))  # those that are not shown are counted
    return _table(f"tact.Report: {len(contacts)} contacts", ("a", "b", "depth", "facet pairs", "points", "least gap"), rows)


def _contact(contact):
    rows = [
        ("depth", _metres(contact.depth)),
        ("direction", _vector(contact.direction)),
        ("facet pairs", len(contact.facet_pairs)),
        ("points", len(contact.points)),
        ("least gap", _metres(_least(contact.points))),
    ]
    return _table(f"tact.Contact of bodies {contact.a.index} and {contact.b.index}", ("", ""), rows)


def _frame(frame):
    rows = []
    for number, (a, b) in enumerate(frame.bodies[:MOST_ROWS].tolist()):
        gaps = frame.points.gaps[frame.points.contacts == number]
        pairs = int((frame.facet_pairs.contacts == number).sum())
        rows.append((a, b, _metres(frame.depths[number]), pairs, len(gaps), _metres(float(gaps.min()) if len(gaps) else None)))
    rows += [None] * (len(frame.bodies) - len(rows))  # those that are not shown are counted
    return _table(f"frame {frame.number}", ("a", "b", "depth", "facet pairs", "points", "least gap"), rows)


def _result(result):
    rows = []
    for frame in result.frames:
        impacts = "" if frame.impacts is None else len(frame.impacts)
        rows.append((frame.number, "" if frame.time is None else f"{frame.time:g} s", len(frame.facet_pairs), len(frame.points), _metres(frame.least_gap), impacts))
    names = ", ".join(body.name for body in result.bodies)
    return _table(f"tact.check of {names}", ("frame", "time", "facet pairs", "points", "least gap", "impacts"), rows)


_tact.Report._repr_html_ = _report
_tact.Contact._repr_html_ = _contact
CheckFrame._repr_html_ = _frame
CheckResult._repr_html_ = _result
