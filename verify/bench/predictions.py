#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the plan of a scene predicts, against what its analysis takes.

    predictions.py [--build FOLDER] [EXAMPLE ..]        EXAMPLE: a folder of examples; default: those of seconds

Prints for each scene the seconds (predicted at the plan's nominal rate; taken: processor time without output), the
alternations and the memory, and the quotients of predicted over taken. The plan assumes how much breaks: its line
`parts of the steps` says what. Alternations are counts, and do not depend on what else the machine does."""
import argparse
import json
import pathlib
import re
import subprocess
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHORT = ("mmb dcb-double laminate-thermal enf-ductile mmf-ductile mmf-ductile-converged enf-brittle-local laminate-enf laminate-dcb "
         "fibre dcb-alfano 4enf enf dcb-krueger").split()


def predicted(build, scene, steps):
    """Seconds, alternations and bytes of the plan."""
    said = subprocess.run([build / "bin/delam", "check", scene, "--json"], capture_output=True, text=True, check=True)
    found = json.loads(said.stdout)
    plan = "\n".join(found["plan"])
    parts = re.search(r"parts of the steps: used, predicted: (\d+)", plan)
    alternations = steps + int(parts[1]) if parts else 2 * steps
    return found["effort"]["seconds"], alternations, found["effort"]["bytes"]


def taken(build, scene, steps, cap):
    """The same of the analysis; none: it did not end within the cap."""
    with tempfile.TemporaryDirectory() as folder:
        record = pathlib.Path(folder, "record.json")
        subprocess.run([build / "verify/delam_bench", "--repeat", "1", "--cap", str(cap), "--json", record, "--scene", scene,
                        "--size", f"time.steps={steps}", "size"], capture_output=True, text=True, check=True)
        size = json.loads(record.read_text())
    row = next(row for row in rows(size) if "analysis_s" in row)
    return (row["analysis_s"], row["alternations"], 1e6 * row["peak_MB"]) if row["steps"] == steps else None


def rows(found):
    """All objects of a record."""
    if isinstance(found, dict):
        yield found
        found = list(found.values())
    for item in found if isinstance(found, list) else []:
        yield from rows(item)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--cap", type=float, default=60.0, help="seconds of an analysis")
    parser.add_argument("examples", nargs="*", default=SHORT)
    given = parser.parse_args()
    print("| scene | s predicted | taken | ratio | alternations predicted | taken | ratio | MiB predicted | taken | ratio |")
    print("|---|" + "---|" * 9)
    for name in given.examples:
        scene = ROOT / "examples" / name / f"{name}.toml"
        steps = tomllib.loads(scene.read_text())["time"]["steps"]
        plan, found = predicted(given.build, scene, steps), taken(given.build, scene, steps, given.cap)
        if found is None:
            print(f"| {name} | {plan[0]:.3g} | more than {given.cap:g} |" + " |" * 7)
            continue
        unit = (1.0, 1.0, 2.0**20)
        cells = [f"{p / u:.3g} | {t / u:.3g} | {p / t:.2f}" for p, t, u in zip(plan, found, unit)]
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
