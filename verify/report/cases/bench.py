# SPDX-License-Identifier: BSD-3-Clause
"""What the chapters (c), (f) and (g) share: tables of delam_bench and outcomes of ctest, each as JSON or rows."""
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import xml.etree.ElementTree

from case import Failed, Skip, environment

COSTS = ("an analysis: all load steps of a scene, from the mesh in memory to the last; a linear solve: CHOLMOD's analysis, factor and one solve of the "
         "assembled, undamaged system of the same scene")
MACHINE_WHY = "ratios of one run whose measurements take turns; times themselves are of this machine and judged by nothing"


def bench(context, table, *arguments, **variables):
    """The JSON of one table of delam_bench; variables are added to its environment. What it printed is in the log."""
    program = context.program("delam_bench")
    folder = context.out / "raw"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"bench-{table}-{os.getpid()}.json"
    words = [*arguments, table]
    context.commands.append(" ".join([*(f"{k}={v}" for k, v in variables.items()), shlex.join(["delam_bench", "--json", "FILE", *words])]))
    env = {**environment(context.library, timing=True), **variables}
    if "DELAM_BENCH_AS_SHIPPED" in variables:
        env = {k: v for k, v in env.items() if not k.startswith("OMP_")}
    run = subprocess.run([str(program), "--json", str(path), *words], cwd=context.root, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                         check=False, env=env)
    print(run.stdout, run.stderr, sep="\n", flush=True)
    if run.returncode != 0:
        raise Failed(f"delam_bench {shlex.join(words)} ended with status {run.returncode}: " + " / ".join(run.stderr.strip().splitlines()[-2:]))
    data = json.loads(path.read_text(encoding="utf-8"))
    path.unlink()
    return data["result"]


def middle(spread):
    return spread["median"] if isinstance(spread, dict) else spread


def tests(context, pattern, long=None):
    """Outcomes of the tests of the build whose names match: {"name", "outcome", "seconds", "says"}. The long tier is listed, not run, but for
    the tests whose names match `long`; ctest's own files stay out of the build folder."""
    if shutil.which("ctest") is None:
        raise Skip("ctest is not there (Debian: cmake)")
    rows = ran(context, ["-R", pattern, "-LE", "long"])
    if long:
        rows += ran(context, ["-R", long, "-L", "long"])
    later = subprocess.run([*ctest(context), "-R", pattern, "-L", "long", "-N"], text=True, capture_output=True, check=False, env=environment(context.library)).stdout
    done = {r["name"] for r in rows}
    rows += [{"name": name, "outcome": "skipped", "seconds": 0.0, "says": "of the long tier: bash verify/run.sh --all", "output": []}
             for name in re.findall(r"Test\s+#\d+: (\S+)", later) if name not in done]
    if not rows:
        raise Skip(f"the build has no tests {pattern}")
    return rows


def ctest(context):
    folder = context.out / "raw" / f"ctest-{os.getpid()}"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "CTestTestfile.cmake").write_text(f'subdirs("{context.build}")\n', encoding="utf-8")
    return ["ctest", "--test-dir", str(folder)]


def ran(context, selection):
    """Outcomes of the tests that ctest selects, run."""
    base = ctest(context)
    result = pathlib.Path(base[-1]) / "junit.xml"
    result.unlink(missing_ok=True)
    context.commands.append(shlex.join(["ctest", "--test-dir", "BUILD", *selection, "--output-junit", "FILE"]))
    run = subprocess.run([*base, *selection, "--test-output-size-passed", "200000", "--test-output-size-failed", "200000", "--output-junit", str(result)], text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, env=environment(context.library))
    print(run.stdout, flush=True)
    if not result.is_file():
        raise Failed(f"ctest left no results for {selection[1]}: " + " / ".join(run.stdout.strip().splitlines()[-2:]))
    rows = []
    for entry in xml.etree.ElementTree.parse(result).getroot().iter("testcase"):
        output = (entry.findtext("system-out") or "").strip().splitlines()
        status, skipped = entry.get("status"), entry.find("skipped")
        # The last line that names no file: those are progress.
        last = clean(next((line for line in reversed(output) if line.strip() and "/" not in line), output[-1])) if output else ""
        if skipped is not None or status in ("notrun", "disabled"):
            said = next((clean(line) for line in output if "skip" in line.lower()), last)
            outcome, says = "skipped", said.removeprefix("skipped: ") or clean(skipped.get("message") if skipped is not None else "") or "no reason given"
        else:
            outcome, says = ("passed", last) if status == "run" else ("failed", last)
        rows.append({"name": entry.get("name"), "outcome": outcome, "seconds": float(entry.get("time") or 0.0), "says": says, "output": output})
    return rows


def clean(text):
    """One line that names no place of this machine."""
    return re.sub(r"(/[\w.+-]+){2,}/", "", (text or "").strip())[:160]
