# SPDX-License-Identifier: BSD-3-Clause
"""junit.py FILE: the outcome of a run of ctest, from the file of its --output-junit.

Prints a line `ran PASSED FAILED`, then `failed NAME` for each test that failed and `left out NAME: REASON` for each that
was skipped, with the last line that it printed.
"""
import sys
import xml.etree.ElementTree as tree


def reason(case):
    """The last line that a skipped test printed, or what ctest says."""
    said = [line.strip() for line in (case.findtext("system-out") or "").splitlines() if line.strip()]
    if said:
        return said[-1].removeprefix("skipped: ")
    skipped = case.find("skipped")
    return (skipped.get("message") if skipped is not None else "") or "it gave no reason"


def main():
    cases = tree.parse(sys.argv[1]).getroot().findall("testcase")
    left_out = [case for case in cases if case.get("status") in ("notrun", "disabled")]
    failed = [case.get("name") for case in cases if case.get("status") == "fail"]
    print("ran", len(cases) - len(left_out) - len(failed), len(failed))
    for name in failed:
        print("failed", name)
    for case in left_out:
        print(f"left out {case.get('name')}: {reason(case)}")


if __name__ == "__main__":
    main()
