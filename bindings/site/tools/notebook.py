# SPDX-License-Identifier: BSD-3-Clause
"""Executes a notebook and writes it as a page with its outputs."""
import base64
import json
import os
import re

ANSI = re.compile(r"\x1b\[[0-9;]*m")


def execute(path, environment):
    """The cells with their outputs, from a kernel of Debian's Python."""
    import nbclient
    import nbformat
    notebook = nbformat.read(path, as_version=4)
    os.environ.update(environment, MPLBACKEND="module://matplotlib_inline.backend_inline", OPENBLAS_NUM_THREADS="1",
                      PYDEVD_DISABLE_FILE_VALIDATION="1")
    nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute(cwd=str(path.parent))
    return notebook.cells


def output_text(output, folder, name):
    """Markdown of one output."""
    if output.output_type == "stream":
        text = output.text
    elif "image/png" in output.data:
        (folder / name).write_bytes(base64.b64decode(output.data["image/png"]))
        return f"![{name}]({name})\n"
    else:
        text = output.data.get("text/plain", "")
    text = ANSI.sub("", text).split("\r")[-1].rstrip()
    return f"```text\n{text}\n```\n" if text else ""


def convert(path, folder, build, environment):
    """Writes folder/NAME.md and its pictures; the folder of the build is none of the reader's business."""
    folder.mkdir(parents=True, exist_ok=True)
    parts, pictures = [], 0
    for cell in execute(path, environment):
        if cell.cell_type == "markdown":
            parts.append(cell.source + "\n")
            continue
        parts.append(f"```python\n{cell.source}\n```\n")
        for output in cell.outputs:
            if output.output_type == "error":
                raise RuntimeError(json.dumps(output))
            pictures += 1
            parts.append(output_text(output, folder, f"{path.stem}-{pictures}.png"))
    text = "\n".join(parts).replace(str(build), "build")
    (folder / f"{path.stem}.md").write_text(text, encoding="utf-8")
