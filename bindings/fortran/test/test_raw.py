#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""test_raw.py HEADER FORTRAN CC: delam_raw.f90 is what the header gives, fits it, and breaks of it are caught."""
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
TOOLS = os.path.join(HERE, "..", "tools")
RAW = os.path.join(HERE, "..", "src", "delam_raw.f90")
HEADER, FORTRAN, CC = sys.argv[1:4]

# In which procedure of the module, what becomes what.
BREAKS = [
    ("a width", "delam_mesh_nodes", r"integer\(c_int64_t\), value :: capacity",
     "integer(c_int32_t), value :: capacity"),
    ("what an array holds", "delam_mesh_cells", r"integer\(c_int32_t\)(.*:: types)", r"integer(c_int64_t)\1"),
    ("a real for an integer", "delam_mesh_add_cells", r"integer\(c_int64_t\)(.*:: connectivity)", r"real(c_double)\1"),
    ("single precision", "delam_law_set", r"real\(c_double\), value", "real(c_float), value"),
    ("a number by address", "delam_solver_advance", r"real\(c_double\), value", "real(c_double), intent(in)"),
    ("a handle by address", "delam_solver_commit", r"type\(c_ptr\), value :: solver",
     "type(c_ptr), intent(inout) :: solver"),
    ("a handle by value", "delam_mesh_destroy", r"type\(c_ptr\), intent\(inout\) :: mesh",
     "type(c_ptr), value :: mesh"),
    ("an output that is read only", "delam_solver_field", r"intent\(inout\), optional :: values",
     "intent(in), optional :: values"),
    ("an input that is written", "delam_solver_load", r"intent\(in\), optional :: bytes",
     "intent(inout), optional :: bytes"),
    ("a callback for data", "delam_context_set_log", r"type\(c_ptr\), value :: user", "type(c_funptr), value :: user"),
    ("data for a callback", "delam_law_create_host", r"type\(c_funptr\), value :: adhesion",
     "type(c_ptr), value :: adhesion"),
    ("a result", "delam_solver_rollback", r"integer\(c_int32_t\) :: status", "integer(c_int64_t) :: status"),
    ("an argument too few", "delam_law_toughness", r", toughness\)((?:.|\n)*?)\n.*:: toughness\(\*\)", r")\1"),
    ("two arguments exchanged", "delam_mesh_interface_pairs", r"nodes_b, weights", "weights, nodes_b"),
    ("a name", "delam_problem_check", r'"delam_problem_check"', '"delam_problem_chek"'),
    ("a callback's argument", "delam_progress_callback", r"integer\(c_int64_t\), value :: total",
     "integer(c_int32_t), value :: total"),
    ("a callback's output", "delam_adhesion_callback", r"real\(c_double\), intent\(inout\) :: slope",
     "real(c_double), value :: slope"),
]


def check(header, raw):
    command = [sys.executable, os.path.join(TOOLS, "check_raw.py"), header, raw, "--fortran", FORTRAN, "--cc", CC]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def compare(header):
    return subprocess.run([sys.executable, os.path.join(TOOLS, "make_raw.py"), header, "--compare", RAW],
                          capture_output=True, text=True, check=False)


def broken(text, procedure, pattern, replacement):
    """The module with one thing changed in one procedure; the same number of lines of every other one."""
    begin = re.search(rf"^ *(?:function|subroutine) {procedure}\(", text, flags=re.M).start()
    end = re.search(rf"^ *end (?:function|subroutine) {procedure}$", text, flags=re.M).start()
    part, count = re.subn(pattern, replacement, text[begin:end], count=1)
    assert count == 1, f"{procedure}: nothing there to break: {pattern}"
    part = part.replace("c_double\n", "c_double, c_float\n", 1) if "c_float" in replacement else part
    return text[:begin] + part + text[end:]


def main():
    failures = []
    made = compare(HEADER)
    print(made.stdout + made.stderr, end="")
    if made.returncode != 0:
        failures.append("the committed module is out of date")
    whole = check(HEADER, RAW)
    print(whole.stdout + whole.stderr, end="")
    if whole.returncode != 0:
        failures.append("the module does not fit the header")
    with open(RAW, encoding="utf-8") as file:
        text = file.read().replace("only: c_ptr, c_funptr, c_char,", "only: c_ptr, c_float, c_funptr, c_char,")
    with open(HEADER, encoding="utf-8") as file:
        header = file.read()
    with tempfile.TemporaryDirectory() as folder:
        raw, other = os.path.join(folder, "delam_raw.f90"), os.path.join(folder, "delam.h")

        def must_fail(what, header_file, raw_file, place):
            done = check(header_file, raw_file)
            # Refused because the two differ at that place, not because something could not be compiled.
            if done.returncode == 0 or "failed:" in done.stderr or place not in done.stdout:
                failures.append(f"not caught: {what}: {done.stdout}{done.stderr}")

        for what, procedure, pattern, replacement in BREAKS:
            with open(raw, "w", encoding="utf-8") as file:
                file.write(broken(text, procedure, pattern, replacement))
            must_fail(f"{what} ({procedure})", HEADER, raw, procedure)
        number = text.replace("DELAM_ERROR_STATE = -5", "DELAM_ERROR_STATE = -6")
        with open(raw, "w", encoding="utf-8") as file:
            file.write(number)
        must_fail("a number", HEADER, raw, "DELAM_ERROR_STATE")
        with open(other, "w", encoding="utf-8") as file:
            file.write(header.replace("DELAM_API int32_t delam_abi(void);",
                                      "DELAM_API int32_t delam_abi(void);\n"
                                      "DELAM_API int32_t delam_new_one(double of);"))
        must_fail("a function that the module lacks", other, RAW, "delam_new_one")
        # What a pointer means is no class: the generator reads it in the comments.
        for what, told in (("a number told as an array", "pending: 1"), ("a pointer told nothing of", "1")):
            sentence = "Returns *pending: 1"
            if sentence not in header:
                failures.append(f"the header no longer says '{sentence}'")
            with open(other, "w", encoding="utf-8") as file:
                file.write(header.replace(sentence, told))
            done = compare(other)
            if done.returncode == 0 or "pending" not in done.stdout + done.stderr:
                failures.append(f"not caught: {what}: {done.stdout}{done.stderr}")
    print(f"{len(BREAKS) + 4} breaks tried")
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
