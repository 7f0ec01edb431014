"""Does what a page of the manual tells its reader, word by word, and compares what is printed.

usage: try_page.py PAGE...     for example docs/pages/start/cpp.md

Blocks with a title are files in a new folder. Blocks with data-run="tact" are commands in the folder of tact, those with
data-run="new" in the new folder, with TACT set. A block with data-output is what the commands before it print at last.
It installs, as the page does: meant for a bare machine.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

import hooks

BLOCK = re.compile(r"^``` \{([^}]*)\}\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def attribute(attributes, name):
    found = re.search(rf'\b{name}="([^"]*)"', attributes)
    return found and found.group(1)


def run(commands, folder):
    print("".join(f"$ {line}\n" for line in commands.splitlines()), end="", flush=True)
    shell = subprocess.Popen(
        ["bash", "-euc", commands], cwd=folder, env=os.environ | {"TACT": str(hooks.PROJECT)}, stdout=subprocess.PIPE, text=True
    )
    printed = shell.stdout.read()
    print(printed, end="", flush=True)
    if shell.wait() != 0:
        sys.exit(f"status {shell.returncode}")
    return printed


def try_page(page):
    text = hooks.LINE.sub(hooks.shown, page.read_text())
    printed, blocks = "", BLOCK.findall(text)
    if not any("data-output" in attributes for attributes, _ in blocks):
        sys.exit(f"{page}: nothing on it is compared")
    with tempfile.TemporaryDirectory() as new:
        for attributes, body in blocks:
            where, title = attribute(attributes, "data-run"), attribute(attributes, "title")
            if where:
                printed = run(body, hooks.PROJECT if where == "tact" else new)
            elif title:
                (pathlib.Path(new) / title).write_text(body)
            elif "data-output" in attributes and not printed.endswith(body):
                sys.exit(f"{page}: it was to print\n{body}")
    print(f"{page}: as the page says")


if __name__ == "__main__":
    for page in sys.argv[1:]:
        try_page(pathlib.Path(page))
