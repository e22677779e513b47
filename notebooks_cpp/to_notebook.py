#!/usr/bin/python3
"""Turns a program in cells into a Jupyter notebook: to_notebook.py PROGRAM.cpp > NOTEBOOK.ipynb

Cells begin with `// %%`, text cells with `// %% [markdown]`. A cell tagged "program" (the frame of main) is left out; the lines
of a cell tagged "notebook" lose their comment marks.
"""
import json
import re
import sys


def read_cells(lines):
    """Yields (heading, lines) of each cell; indentation of the first line is taken away."""
    heading, body = None, []
    for line in lines:
        match = re.match(r"\s*// %%(.*)", line)
        if match:
            if heading is not None:
                yield heading, body
            heading, body = match.group(1).strip(), []
        elif heading is not None:
            body.append(line.rstrip("\n"))
    if heading is not None:
        yield heading, body


def without_margin(lines):
    margin = min((len(line) - len(line.lstrip()) for line in lines if line.strip()), default=0)
    return "\n".join(line[margin:] for line in lines).strip("\n")


def uncommented(text):
    return "\n".join(re.sub(r"^// ?", "", line) for line in text.split("\n"))


def notebook(lines):
    cells = []
    for heading, body in read_cells(lines):
        text = without_margin(body)
        if '"program"' in heading or not text:
            continue
        if heading == "[markdown]":
            cells.append({"cell_type": "markdown", "metadata": {}, "source": uncommented(text)})
            continue
        source = uncommented(text) if '"notebook"' in heading else text
        cells.append({"cell_type": "code", "metadata": {}, "source": source, "execution_count": None, "outputs": []})
    kernel = {"name": "radiosity-cpp", "display_name": "C++ (radiosity)", "language": "c++"}
    return {"nbformat": 4, "nbformat_minor": 4, "metadata": {"kernelspec": kernel}, "cells": cells}


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as program:
        json.dump(notebook(program), sys.stdout, indent=1)
    print()
