"""Runs a notebook in a kernel, as a reader does, and looks at what its cells show.

usage: run_kernel.py FILE TEXT...   Leaves with status 77 if nbclient is not here, 1 if a cell fails or a text is not shown.
"""

import sys

try:
    import nbclient
    import nbformat
    from jupyter_client.kernelspec import KernelSpecManager

    KernelSpecManager().get_kernel_spec("python3")
except Exception as missing:
    print(f"no notebook can be run here (scripts/setup.sh notebook): {missing}")
    sys.exit(77)

notebook = nbformat.read(sys.argv[1], as_version=4)
nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
shown = "\n".join(output.get("text", "") + "".join(str(text) for text in output.get("data", {}).values()) for output in outputs)
for text in sys.argv[2:]:
    if text not in shown:
        sys.exit(f"no cell shows {text!r}; they show\n{shown[:2000]}")
print(f"{len(outputs)} outputs, as expected")
