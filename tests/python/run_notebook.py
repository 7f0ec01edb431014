"""Runs the code of a notebook and compares what it prints with what the notebook shows.

usage: run_notebook.py FILE. Leaves with status 77 if matplotlib is not here, 1 if a cell prints something else.
`python3 -m nbconvert --to notebook --execute --inplace FILE` (Debian: python3-nbconvert, python3-ipykernel) writes what it
shows, pictures included.
"""

import contextlib
import io
import json
import sys

try:
    import matplotlib
except ImportError:
    print("matplotlib is not here: the notebook is not run")
    sys.exit(77)
matplotlib.use("Agg")

names, ran = {}, 0
for number, cell in enumerate(json.load(open(sys.argv[1]))["cells"]):
    if cell["cell_type"] != "code":
        continue
    shown = "".join("".join(output["text"]) for output in cell["outputs"] if output["output_type"] == "stream")
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile("".join(cell["source"]), f"cell {number}", "exec"), names)
    ran += 1
    if printed.getvalue() != shown:
        sys.exit(f"cell {number} prints\n{printed.getvalue()}and the notebook shows\n{shown}")
if ran == 0:
    sys.exit("there is no code in it")
print(f"{ran} cells, as the notebook shows")
