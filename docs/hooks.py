"""Shows files of the project in pages, so that no example and no figure stands in two places.

A line of its own in a page,

    {{ file examples/c/drop.c }}
    {{ file examples/concepts.cpp part direction }}
    {{ rivals bench/results/rivals/rivals.csv }}
    {{ table bench/results/rigid/rigid.csv | bodies that turn; poses / vertices | threads=1 }}

becomes the file, or what stands between the two lines in it that hold `[part direction]`, as a block of code; or a table of what
tact and the fastest rival took; or these columns of a table, of the rows with that value. A page that names a file, a part, a
column or a value that is not there does not build.
"""

import csv
import pathlib
import re
import textwrap

PROJECT = pathlib.Path(__file__).resolve().parent.parent
LANGUAGES = {".cpp": "cpp", ".h": "cpp", ".c": "c", ".py": "python", ".pyi": "python", ".mjs": "js", ".sh": "sh"}
RIVALS = re.compile(r"^\{\{ rivals (\S+) \}\}$", re.MULTILINE)
TABLE = re.compile(r"^\{\{ table (\S+) \| (.+?)(?: \| ([^|]+?)=([^|]+?))? \}\}$", re.MULTILINE)
LINE = re.compile(r"^( *)\{\{ file (\S+?)(?: part (\S+))? \}\}$", re.MULTILINE)


def part_of(text, part, path):
    lines = text.splitlines()
    marks = [i for i, line in enumerate(lines) if f"[part {part}]" in line]
    if len(marks) != 2:
        raise ValueError(f"{path}: the part {part} has {len(marks)} marks, not 2")
    return "\n".join(lines[marks[0] + 1 : marks[1]])


def shown(match):
    indent, path, part = match.groups()
    file = PROJECT / path
    text = file.read_text().rstrip("\n")
    text = textwrap.dedent(part_of(text, part, path)) if part else text
    language = LANGUAGES.get(file.suffix) or ("cmake" if file.name == "CMakeLists.txt" else "text")
    block = f'``` {{ .{language} title="{path if part else file.name}" }}\n{text}\n```'
    return textwrap.indent(block, indent)


def rivals(match):
    rows = [row for row in csv.DictReader((PROJECT / match.group(1)).open()) if row["threads"] == "1"]
    lines = ["| workload | facet pairs | tact, ms | fastest rival | ms | times |", "|---|---:|---:|---|---:|---:|"]
    for workload in dict.fromkeys(row["workload"] for row in rows):
        of_it = [row for row in rows if row["workload"] == workload]
        ours = next(row for row in of_it if row["contestant"] == "tact")
        exact = [row for row in of_it if row is not ours and float(row["pairs_found"]) == 1]
        best = min(exact, key=lambda row: float(row["ms"]))
        times = float(best["ms"]) / float(ours["ms"])
        lines.append(
            f"| {workload} | {ours['facet_pairs']} | {float(ours['ms']):.3g} | {best['contestant']} | {float(best['ms']):.3g} | {times:.1f} |"
        )
    return "\n".join(lines)


def table(match):
    path, columns, filtered, value = match.groups()
    names = [name.strip() for name in columns.split(";")]
    rows = [row for row in csv.DictReader((PROJECT / path).open()) if filtered is None or row[filtered] == value]
    if not rows:
        raise ValueError(f"{path}: no row has {filtered} = {value}")
    if missing := [name for name in names if name not in rows[0]]:
        raise ValueError(f"{path}: there is no column {', '.join(missing)}")
    cells = [[row[name] for name in names] for row in rows]
    header = [f"| {' | '.join(names)} |", f"|---|{'---:|' * (len(names) - 1)}"]
    return "\n".join(header + [f"| {' | '.join(line)} |" for line in cells])


def on_page_markdown(markdown, page, config, files):
    markdown = TABLE.sub(table, RIVALS.sub(rivals, LINE.sub(shown, markdown)))
    if left := re.search(r"^ *\{\{ .*$", markdown, re.MULTILINE):
        raise ValueError(f"{page.file.src_path}: nobody knows what to show for {left.group()}")
    return markdown
