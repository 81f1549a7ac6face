# SPDX-License-Identifier: BSD-3-Clause
"""Chapter (f): does the binary interface stand still, what was run in which language, what a call costs through each, and what became of the
library when things around it went wrong. Outcomes of the build's own tests; what was skipped stays in the tables with its reason."""
import re
import shutil
import subprocess
import sys

from bench import clean, tests
from case import Case, Failed, Skip, axis, check, column, environment, figure, plot, reference, result, series, table

WHERE = dict(geometry="small scenes, see the tests", materials="as the tests say", supports="as the tests say", units="counts; SI")
SKIPPED = 77


def outcome_table(title, rows, note=""):
    return table(title, [column("test", key=True), column("outcome", may=True), column("time", "s", past="free"), column("what it said last", may=True)],
                 [[r["name"], r["outcome"], r["seconds"], r["says"]] for r in rows], note)


def outcome_counts(rows):
    """What skips depends on the machine; the others have a past."""
    of = [sum(r["outcome"] == word for r in rows) for word in ("passed", "failed", "skipped")]
    return table("Tests by outcome", [column("of", key=True), column("passed", past="count"), column("failed", past="count"), column("skipped", past="free")], [["all", *of]])


def judged(rows, least=1):
    """Checks and warnings of a group of tests. Skipped ones are neither passed nor failed, and a group that only skips is skipped."""
    here = [r for r in rows if r["outcome"] != "skipped"]
    skipped = [r for r in rows if r["outcome"] == "skipped"]
    if not here:
        raise Skip("; ".join(f"{r['name']}: {r['says']}" for r in skipped)[:400])
    failed = [r["name"] for r in here if r["outcome"] == "failed"]
    checks = [check("tests that failed" + (f": {', '.join(failed)}" if failed else ""), len(failed), 0, "each states its own limits"),
              check("tests that ran", len(here), least, "fewer would be no evidence", ">=")]
    reasons = {}
    for r in skipped:
        reasons.setdefault(r["says"], []).append(r["name"])
    return checks, [f"Skipped, {why}: {', '.join(names)}." for why, names in reasons.items()]


def said(rows, name, pattern):
    """Numbers that a test printed: every match of `pattern` in what it said, as integers."""
    for r in rows:
        if r["name"] == name and r["outcome"] == "passed":
            return [tuple(int(v) for v in m.groups()) for line in r["output"] for m in [re.search(pattern, line)] if m]
    return []


def gate(context, what, *arguments):
    """One check of verify/abi/gate.py: (outcome, what it said)."""
    command = [sys.executable, str(context.root / "verify" / "abi" / "gate.py"), "--header", str(context.root / "include" / "delam" / "delam.h"),
               "--list", str(context.root / "verify" / "abi" / "symbols.txt"), what, *arguments]
    context.commands.append(f"verify/abi/gate.py --header include/delam/delam.h --list verify/abi/symbols.txt {what}" + (" --library LIBRARY" if "--library" in arguments else ""))
    run = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, env=environment(context.library))
    lines = [clean(line) for line in run.stdout.strip().splitlines()]
    print(run.stdout, flush=True)
    return "passed" if run.returncode == 0 else "skipped" if run.returncode == SKIPPED else "failed", lines


def symbols(context):
    library = str(context.library / "libdelam.so")
    asked = {"symbols": ("--library", library, "--experimental", str(context.root / "include" / "delam" / "experimental.h"), "--cholmod"),
             "baseline": (), "abidiff": ("--library", library)}
    rows, warnings, wrong = [], [], 0
    for what, arguments in asked.items():
        outcome, lines = gate(context, what, *arguments)
        rows.append([what, outcome, lines[-1] if lines else ""])
        if outcome == "skipped":
            warnings.append(f"Skipped: {what}: {lines[-1] if lines else 'no reason given'}")
        if outcome == "failed":
            wrong += max(len(lines), 1)
            warnings += [f"{what}: {line}" for line in lines[:8]]
    since = {}
    for line in (context.root / "verify" / "abi" / "symbols.txt").read_text(encoding="utf-8").splitlines():
        words = line.split("#")[0].split()
        if len(words) == 2:
            since[words[0]] = words[1]
    families = {}
    for name, version in since.items():
        families.setdefault((name.split("_")[1], version), []).append(name.removeprefix("delam_"))
    checks = [check("breaks of the promise", wrong, 0, "exported = declared = listed, one version node, SONAME of DELAM_ABI, of CHOLMOD the LGPL modules alone; declarations and "
                    "debug information as in the baseline"),
              check("checks that ran", sum(r[1] != "skipped" for r in rows), 2, "abidiff may be missing, the others need binutils alone", ">="),
              check("functions that are promised", len(since), 1, "an empty list promises nothing", ">=")]
    return result(
        reference("own past", "verify/abi/baseline: header and debug information of the last accepted interface; verify/abi/symbols.txt", "none: names and types are compared as they are"),
        checks=checks, warnings=warnings,
        tables=[table("The gate", [column("check", key=True), column("outcome", may=True), column("what it said", may=True)], rows),
                table("Promised functions and the version that brought them", [column("about", key=True), column("since", key=True), column("functions", past="count"), column("names")],
                      [[family, version, len(names), ", ".join(names)] for (family, version), names in sorted(families.items())], "Names without delam_.")],
        figures=[figure("abi_functions", len(since), "", "Functions of the binary interface, exported = declared = listed", past="count")])


def abi(context):
    rows = tests(context, "^abi/", "^abi/long_planted$")
    checks, warnings = judged(rows, 6)
    planted = said(rows, "abi/long_planted", r"(\d+) planted checks, (\d+) failures")
    figures = []
    if planted:
        made, missed = planted[-1]
        checks += [check("planted breaks that passed the gate", missed, 0, "a gate that lets nothing through is only seen at a break"),
                   check("planted breaks that were tried", made, 60, "of symbols, types, header, contract, reference", ">=")]
        figures.append(figure("abi_planted", made, "", "Planted breaks of the binary interface and its contract, all refused by name", past="count"))
    return result(reference("own past", "verify/abi: baseline, contract of every function (unit, null, owns, status, thread), and breaks planted in copies of it",
                            "none: a planted break is found or not"),
                  tables=[outcome_counts(rows), outcome_table("Tests of the interface", rows)], checks=checks, warnings=warnings, figures=figures)


# What stands for each word. Parsed: its own compiler or parser reads it. Checked: compared with the public header. Run: over this library.
LANGUAGES = {
    "C": {"parsed": ["abi/headers_gcc", "abi/headers_clang"], "checked": ["abi/contract", "abi/baseline"], "run": ["abi/host", "example/enf_c", "example/dcb-host-law_c"]},
    "C++": {"parsed": ["abi/headers_gcc", "abi/headers_clang", "cpp/clang"], "checked": ["cpp/delam_17", "cpp/delam_20"],
            "run": ["cpp/delam_17", "cpp/host_17", "cpp/delam_20", "cpp/host_20", "example/enf_cpp", "example/dcb-host-law_cpp"]},
    "Fortran": {"parsed": ["fortran/module"], "checked": ["fortran/raw"], "run": ["fortran/module", "fortran/host", "fortran/stop", "example/enf_fortran", "example/dcb-host-law_fortran"]},
    "Python": {"parsed": ["python/raw"], "checked": ["python/raw", "python/clang"],
               "run": ["python/mesh", "python/law", "python/problem", "python/solver", "python/host", "python/interrupt", "python/lifetime", "python/threads", "example/enf_python",
                       "example/dcb-host-law_python"]},
    "Julia": {"parsed": ["julia/check"], "checked": ["julia/check"], "run": ["julia/package", "example/enf_julia", "example/dcb-host-law_julia"]},
}


def languages(context):
    rows = tests(context, "^(fortran|cpp|python|julia|example)/|^abi/(headers_gcc|headers_clang|contract|baseline|host)$")
    checks, warnings = judged(rows, 10)
    at = {r["name"]: r for r in rows}
    listed, losses, ran = [], [], 0
    for language, words in LANGUAGES.items():
        cells = []
        for word, names in words.items():
            known = [at[n] for n in names if n in at]
            good = [r for r in known if r["outcome"] == "passed"]
            if any(r["outcome"] == "failed" for r in known):
                cells.append("no: a test failed")
            elif good:
                cells.append("yes, " + (f"{len(good)} of " if len(good) < len(names) else "") + (f"{len(names)} tests" if len(names) > 1 else "1 test"))
            else:
                why = known[0]["says"] if known else "not in this build"
                cells.append(f"not here: {why}")
                losses.append(f"{language} was not {word}: {why}")
            ran += word == "run" and bool(good) and cells[-1].startswith("yes")
        listed.append([language, *cells])
    groups = []
    for group in ("cpp", "fortran", "python", "julia", "example"):
        of = [r for r in rows if r["name"].startswith(group + "/")]
        if of:
            groups.append(outcome_table(f"Tests: {group}", of))
    checks.append(check("languages that ran over this library", ran, 1, "C at least; the others where their tools are", ">="))
    return result(
        reference("other code", "the example scenes in C, Fortran, C++, Python and Julia against one table of reference values; raw layers against the public header, read by another parser",
                  "the reference values of the examples are met to the digits that are written"),
        tables=[table("What was done in which language", [column("language", key=True), *(column(w, may=True) for w in ("parsed", "checked", "run"))], listed,
                      "Parsed: its own compiler or parser reads it. Checked: compared with the public header. Run: over this library."), outcome_counts(rows), *groups],
        checks=checks, warnings=warnings, losses=losses, figures=[figure("languages_run", ran, "of 5", "Languages that ran over this library", past="free")])


def group_case(case_id, title, pattern, requirement, source, quick, expected, counted=(), quick_pattern="", long=None):
    def run(context):
        rows = tests(context, quick_pattern if context.quick and quick_pattern else pattern, long)
        checks, warnings = judged(rows)
        figures, numbers = [], []
        for name, expression, what, key in counted:
            found = said(rows, name, expression)
            if found:
                numbers.append([name, what, sum(v[0] for v in found)])
        for key, text in dict.fromkeys((c[3], c[2]) for c in counted):
            total = sum(n[2] for n in numbers if n[1] == text)
            if total:
                figures.append(figure(key, total, "", f"{title}: {text}", past="count"))
        counts = [table("Counts that the tests give", [column("test", key=True), column("what", key=True), column("number", past="count")], numbers)] if numbers else []
        return result(reference("physics", source, "none: bits, statuses and texts are compared"), tables=[*counts, outcome_counts(rows), outcome_table("Tests", rows)], checks=checks,
                      warnings=warnings, figures=figures)

    return Case(id=case_id, chapter="f", title=title, requirement=requirement, **WHERE, run=run, quick=quick, seconds=1200, expected=expected)


LINE = re.compile(r"^(c|cpp|fortran|python|julia)" + 4 * r"\s+(-?\d+) \((-?\d+) to (-?\d+)\)" + r"\s*$")
VALUES = re.compile(r"^values: (c|cpp|fortran|python|julia): (\d+) numbers in (\d+) rounds, (\d+) not the bits of C, relative difference (\S+), (\d+) pairs partly damaged$")
TITLES = {"c": "C", "cpp": "C++", "fortran": "Fortran", "python": "Python", "julia": "Julia"}
# Nanoseconds over C that a step may cost: a hundredth of the shortest steps that are worth an analysis, 10 ms, for Python; scatter for the others.
STEP_LIMIT = {"cpp": 5e3, "fortran": 5e3, "python": 1e5, "julia": 1e5}


def same_values(lines, spoken):
    """Table, checks: what the analyses of all languages ended with, bit by bit beside C."""
    found = {m.group(1): m.groups()[1:] for m in map(VALUES.match, lines) if m}
    lost = [TITLES[n] for n in spoken if n not in found]
    if lost:
        raise Failed("calls.py printed no values of " + ", ".join(lost))
    rows = [[TITLES[n], int(found[n][0]), int(found[n][1]), int(found[n][2]), float(found[n][3])] for n in spoken]
    checks = [check(f"{TITLES[n]}: numbers that are not those of C in every bit", int(found[n][2]), 0, "the same library does the same operations; a language only hands numbers over")
              for n in spoken if n != "c"]
    checks += [check("numbers that every language hands over", min(r[1] for r in rows), 7, "reaction, energies and a field; a build of before prints the reaction alone", ">="),
               check("pairs that are partly damaged at the end", int(found["c"][4]), 1, "else nothing but zeros and ones would be compared in the field", ">=")]
    return table("What the analyses end with, beside C", [column("language", key=True), column("numbers"), column("rounds", past="free"), column("other bits"), column("largest difference", "relative")],
                 rows, "After the timed steps ten more that do damage: reaction, stored, dissipated energies, work, adhesion of all pairs, printed with 17 digits."), checks


def overheads(title, label, unit, scale, at, place, caption):
    """Bars of what a language adds to C: the median over the rounds, and its quartiles."""
    of = [n for n in at if n != "c"]
    middle, low, high = ([scale * at[n][place + i] for n in of] for i in range(3))
    return plot(title, axis("", bars=[TITLES[n] for n in of]), axis(label, unit), [series("median, quartiles", "first", list(range(len(of))), middle, low=low, high=high)], caption=caption)


def calls(context):
    rounds, steps = ("2", "100") if context.quick else ("15", "2000")
    words = ["--rounds", rounds, "--calls", "5000" if context.quick else "200000", "--steps", steps]
    context.commands.append("verify/bench/calls/calls.py --build BUILD " + " ".join(words))
    run = subprocess.run([sys.executable, str(context.root / "verify" / "bench" / "calls" / "calls.py"), "--build", str(context.build), *words], text=True, stdout=subprocess.PIPE,
                         stderr=subprocess.PIPE, check=False, env=environment(context.library))
    print(run.stdout, run.stderr, flush=True)
    lines = run.stdout.splitlines()
    # Status 1 with its table: values that differ, which the checks judge.
    if run.returncode not in (0, 1) or not any(line.startswith("values:") for line in lines):
        raise Failed("calls.py: " + " / ".join(run.stderr.strip().splitlines()[-2:]))
    warnings = [clean(line).capitalize() for line in lines if line.startswith("left out") and "julia" not in line]
    if not shutil.which("julia"):
        warnings.append("Julia: not compared. Debian 12 has none; the package is parsed and its signatures are checked against the header (f-languages), it was not run.")
    if context.quick:
        warnings.append("The quick report judges no time here: its few rounds give the table, its judgement is of the bits.")
    at = {m.group(1): [float(v) for v in m.groups()[1:]] for m in map(LINE.match, lines) if m}
    if "c" not in at or len(at) < 2:
        raise Failed("calls.py printed no table")
    values, checks = same_values(lines, at)
    rows, losses = [], []
    key_c, step_c = at["c"][0], at["c"][6]
    for language, n in at.items():
        (key, _, _, key_over, _, _, step, _, _, step_over, low, high), name = n, TITLES[language]
        rows.append([name, key, key_over, key / key_c, step, step_over, low, high, step / step_c])
        if language == "c":
            continue
        if not context.quick:
            checks.append(check(f"{name}: a step over that in C, lower quartile", low, STEP_LIMIT[language], "ns; the wrapper must be nothing beside a step of milliseconds; what other programs take is in the upper half of the rounds"))
        # Beyond the scatter: the lower quartile of the differences is above nothing.
        if low > 0 and step_over > 0.1 * step_c:
            losses.append(f"a step through {name} takes {step_over * 1e-3:.2g} us more than in C, on a step of {1e-3 * step_c:.2g} us")
        if key > 1.5 * key_c:
            losses.append(f"a value by its key through {name} takes {key / key_c:.2g} times as long as in C")
    return result(
        reference("other code", "the same calls in C, in the same round; what the analyses end with is compared bit by bit", "values: none; times: the quartiles of the rounds, ns of processor time "
                  "(Julia: of the wall clock)"),
        checks=checks, losses=losses, warnings=warnings,
        tables=[values, table("What a call costs", [column("language", key=True), column("value by key", "ns", past="free"), column("over C", "ns", past="free"), column("to C", "", past="free"),
                      column("step", "ns", past="free"), column("step over C", "ns", past="free"), column("lower quartile", "ns", past="free"), column("upper quartile", "ns", past="free"),
                      column("step to C", "", past="free")], rows,
                      "Medians over the rounds, quartiles of the step over C; a step is advance and commit, on a scene of 84 nodes that nothing damages.")],
        plots=[overheads("What a step costs more than in C", "step over C", "us", 1e-3, at, 9,
                         f"Median of the differences within a round, with quartiles; the step itself takes {1e-3 * step_c:.2g} us in C. Below nothing: scatter of the step."),
               overheads("What a value by its key costs more than in C", "value over C", "ns", 1.0, at, 3, f"Median of the differences within a round, with quartiles; {key_c:.0f} ns in C.")],
        figures=[figure(f"call_{n}", at[n][9] * 1e-3, "us", f"A step through {TITLES[n]} over one in C", past="free") for n in at if n == "python"])


def cases():
    return [Case(id="f-symbols", chapter="f", title="Promised symbols", requirement="Exported functions are the declared ones are the listed ones; nothing promised has changed since the "
                 "baseline.", geometry="none", materials="none", supports="none", units="names", run=symbols, quick=True, seconds=120, expected=3),
            Case(id="f-abi", chapter="f", title="The interface and its contract", requirement="Header, contract and library agree; a host compiled against the baseline runs; every planted "
                 "break is found.", **WHERE, run=abi, seconds=900, expected=60),
            Case(id="f-languages", chapter="f", title="Languages", requirement="Each language is parsed, checked against the header and run, or the table says what was not done and why; what "
                 "ran gives the numbers of one table of reference values to its digits (bit by bit: f-calls).", **WHERE, run=languages, seconds=1500, expected=90),
            Case(id="f-calls", chapter="f", title="What a call costs", requirement="An analysis ends with the same numbers through each language, in every bit; a step costs at most 0.1 ms more than in C.",
                 geometry="two arms 100 mm x 2 mm, 84 nodes; nothing is damaged while it is timed", materials="E = 70 GPa, nu = 0.3; k = 1e12 N/m3, Go = 50, Gc = 250 J/m2", supports="three-point bending: corners on "
                 "points, midspan pressed by 1 um while it is timed, then by 4 mm", units="SI; ns of processor time", run=calls, quick=True, timing=True,
                 seconds=600, expected=25),
            group_case("f-fuzz", "Fuzzing, replayed", "^fuzz/replay", "Every committed input, and every input that was once a defect, ends with a listed status and nothing changed after an error.",
                       "the contract after every call (verify/fuzz): listed status, message, unchanged state", True, 20,
                       [(f"fuzz/replay_{n}", r"(\d+) inputs", "inputs replayed", "fuzz_inputs") for n in ("api_sequence", "saved_state", "mesh_arrays", "scene")]),
            group_case("f-faults", "Faults injected", "^fault/[^t]", "Cancelled at a poll, out of memory at an allocation, under other rounding modes, traps and locales: the promised status and "
                       "the state before, bit by bit.", "the undisturbed run of the same scene, bit by bit (verify/faults)", False, 90,
                       [("fault/long_cancel", r"(\d+) calls cancelled", "calls cancelled", "fault_cancelled"),
                        ("fault/long_memory", r"(\d+) (?:failed )?allocations", "allocations failed", "fault_allocations")], long="^fault/long_(cancel|memory)$"),
            group_case("f-threads", "Threads", "^(fault/threads|case/test_threads_host|python/threads)$", "Solvers in eight threads at once give the bits that each gives alone; handles are guarded as the "
                       "contract says.", "each analysis alone, bit by bit", True, 15, quick_pattern="^fault/threads$")]
