#!/usr/bin/python3
"""A Jupyter kernel that runs C++ cells in clang-repl, with the libraries of this project loaded.

  clang_repl_kernel.py install BUILD   registers the kernel for the shared libraries in the folder BUILD
  clang_repl_kernel.py run NOTEBOOK    runs the cells of a notebook and prints what they print (no Jupyter needed)

Jupyter starts it by itself with the arguments `serve CONNECTION_FILE`. RADIOSITY_BUILD names the folder BUILD in the last two.
"""
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["foundation", "kernels", "factorizations", "compression", "scene", "form_factors", "operators", "solvers", "gpu",
           "render", "frame", "experiments"]
MARK = "end-of-cell-7f3a"
NUMBERS = itertools.count()


def statements(text):
    """Splits C++ without comments and directives into top-level statements."""
    depth, start, quote = 0, 0, None
    for at, character in enumerate(text):
        if quote:
            if character == quote and text[at - 1] != "\\":
                quote = None
        elif character == '"' or (character == "'" and not text[at - 1].isalnum()):
            quote = character
        elif character in "([{":
            depth += 1
        elif character in ")]}":
            depth -= 1
        ends = quote is None and depth == 0 and (
            character == ";" or (character == "}" and not re.match(r"\s*([;,).\[]|else|catch|while)", text[at + 1:])))
        if ends:
            yield text[start:at + 1].strip()
            start = at + 1
    if text[start:].strip():
        yield text[start:].strip()


def inputs(cell):
    """What clang-repl is to read: it takes a line at a time, a directive or one statement, and loops only in a function."""
    directives, rest = [], []
    for line in cell.split("\n"):
        line = re.sub(r"(^|\s)//.*$", "", line).rstrip()
        (directives if line.lstrip().startswith("#") else rest).append(line)
    lines = directives
    for part in statements(" ".join(rest)):
        if re.match(r"(for|if|while|do|switch)\b", part):
            function = f"cell_function_{next(NUMBERS)}"
            lines += [f"void {function}() {{ {part} }}", f"{function}();"]
        else:
            lines.append(part)
    return lines


class Session:
    """A running clang-repl."""

    def __init__(self, build):
        build = pathlib.Path(build).resolve()
        includes = [SOURCE, "/usr/include/eigen3", "/usr/include/x86_64-linux-gnu/openblas-pthread"]
        flags = ["-std=c++20", "-O1", "-DFMT_SHARED"] + [f"-I{folder}" for folder in includes]
        self.process = subprocess.Popen(["clang-repl-19"] + ["--Xcc=" + flag for flag in flags], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, bufsize=1)
        for library in ["libfmt.so.9", "libtbb.so.12", "liblapacke.so.3"]:
            self._send(f"%lib {library}")
        for folder in FOLDERS:
            self._send(f"%lib {build / folder}/libradiosity_{folder}.so")
        self.run("#include <cstdio>")

    def _send(self, line):
        self.process.stdin.write(line + "\n")

    def run(self, cell):
        """Runs a cell; returns what it printed, errors of the compiler included."""
        for line in inputs(cell):
            self._send(line)
        self._send(f'std::printf("\\n{MARK}\\n"); std::fflush(stdout);')
        self.process.stdin.flush()
        output = []
        for line in self.process.stdout:
            line = line.replace("clang-repl> ", "")
            if line.strip() == MARK:
                break
            output.append(line)
        return "".join(output).strip("\n")


def install(build):
    from jupyter_client.kernelspec import KernelSpecManager

    spec = {"argv": [sys.executable, str(pathlib.Path(__file__).resolve()), "serve", "{connection_file}"],
            "display_name": "C++ (radiosity)", "language": "c++", "env": {"RADIOSITY_BUILD": str(pathlib.Path(build).resolve())}}
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "kernel.json").write_text(json.dumps(spec))
        KernelSpecManager().install_kernel_spec(folder, "radiosity-cpp", user=True)


def serve(connection_file):
    from ipykernel.kernelapp import IPKernelApp
    from ipykernel.kernelbase import Kernel

    class ClangReplKernel(Kernel):
        implementation = "clang-repl"
        implementation_version = "1"
        language_info = {"name": "c++", "mimetype": "text/x-c++src", "file_extension": ".cpp"}
        banner = "C++ in clang-repl, with the radiosity libraries"
        repl = None

        def do_execute(self, code, silent, *arguments, **options):
            if self.repl is None:
                self.repl = Session(os.environ.get("RADIOSITY_BUILD", SOURCE / "build/shared"))
            text = self.repl.run(code)
            if text and not silent:
                self.send_response(self.iopub_socket, "stream", {"name": "stdout", "text": text + "\n"})
            return {"status": "ok", "execution_count": self.execution_count, "payload": [], "user_expressions": {}}

    IPKernelApp.launch_instance(kernel_class=ClangReplKernel, argv=["-f", connection_file])


def run_notebook(file):
    session = Session(os.environ.get("RADIOSITY_BUILD", SOURCE / "build/shared"))
    for cell in json.loads(pathlib.Path(file).read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            print(session.run(cell["source"]))


if __name__ == "__main__":
    commands = {"install": install, "serve": serve, "run": run_notebook}
    if len(sys.argv) != 3 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    commands[sys.argv[1]](sys.argv[2])
