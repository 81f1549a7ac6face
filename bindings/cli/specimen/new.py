# SPDX-License-Identifier: BSD-3-Clause
"""`delam new`: the scene of a test from the sheet of its specimen, which src/command/specimen.cpp has read. Argument: JSON
with numbers in mm, N, MPa and N/mm. The mesh and the interface follow from what `delam check` proposes."""
import json
import math
import os
import re
import shlex
import subprocess
import sys
import tempfile
import types

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "study")]

import command  # noqa: E402

if __name__ == "__main__":
    command.begin("delam: new")

import beams  # noqa: E402
import plausible  # noqa: E402
import proposals  # noqa: E402
import scenes  # noqa: E402
import standards  # noqa: E402
from specimens.thickness import taken_for_arm  # noqa: E402

# What a kind needs, and its title. The rest of a sheet has the defaults below.
PLY, BEAM = ("E1", "E2", "G12", "nu12", "nu23"), ("width", "arm", "notch")
KINDS = {
    "dcb": ("Double cantilever beam (mode I)", BEAM + ("GIc",)),
    "adcb": ("Asymmetric double cantilever beam", BEAM + ("lower-arm", "GIc", "GIIc")),
    "enf": ("End-notched flexure (mode II)", BEAM + ("half-span", "GIIc")),
    "4enf": ("Four-point end-notched flexure (mode II)", BEAM + ("span", "inner-span", "GIIc")),
    "mmb": ("Mixed-mode bending", BEAM + ("half-span", "lever", "GIc", "GIIc")),
    "slb": ("Single leg bending", BEAM + ("half-span", "GIc", "GIIc")),
    "fibre": ("", ("radius", "fraction", "young", "poisson", "fibre-young", "fibre-poisson", "GIc", "GIIc",
                   "normal-strength", "shear-strength", "strain")),
    "laminate": ("", ("ply", "width", "length", "GIc", "GIIc", "strain")),
}
# What a kind takes besides.
FLAW = ("flaw", "flaw-width", "flaw-at", "flaw-across", "flaw-interface")
ELASTIC, LAW = PLY + ("young", "poisson"), ("GIc", "GIIc", "eta", "normal-strength", "shear-strength")
TAKEN = {kind: ("eta",) if kind == "fibre" else ELASTIC + LAW + (FLAW + ("cell",) if kind == "laminate" else ("length", "growth"))
         for kind in KINDS}
DEFAULTS = {"nu12": 0.3, "nu23": 0.45, "eta": 2.0}
FACTORS = {"dcb": "The factor is the opening between both arms: the reaction is the force of the machine.",
           "adcb": "The factor is the opening between both arms: the reaction is the force of the machine.",
           "mmb": "The factor is the displacement of the load on the lever."}

# Pairs in the process zone, and the cells per length of the notch: peaks over corrected beam theory are 0.988 (dcb), 0.993
# (adcb), 0.969 (enf), 1.000 (4enf), 0.968 (mmb), 0.976 (slb). With half of the cells they change by 0.9 % at most (slb), with
# twice as many by 0.3 % (`test_specimen.py pairs`).
PAIRS, CELLS_PER_NOTCH = 8.0, 400.0
PAIRS_OF_LAMINATE = 4.0  # one more than `delam check` asks for (src/result/closing/resolution.cpp)
HIGHEST_STRENGTH = 60.0  # MPa: a resin has no more; with half of it the peak of a DCB sinks by 1 % (choosing.md)
SHEAR_RATIO = 5 / 3  # of the strengths where the sheet has the toughness of one mode alone, which then decides
STIFFNESS_FACTOR = 50.0  # E3 over the thickness of the layer next to the interface (A. Turon et al. 2007)
OVERHANG = 5.0  # mm beyond a roller: half and twice of it change no load, since nothing acts there
# A crack grows without --growth by at most this part of the way from the notch to the load in the middle, which counts for
# notches of more than 0.82 of the half span. Half of it shows less of the curve; at 1 the process zone would lie below
# the load.
NEAR = 0.9
PAST = 1.15  # of the displacement at the end of the growth: the analysis ends after it


option = proposals.option

# Names of standards for a number that a kind has by another name: kinds, name, what it is taken for, and the factor.
OTHER_NAMES = ((("enf", "mmb", "slb"), "span", "half-span", 0.5), (tuple(KINDS), "G13", "G12", 1.0),
               (("dcb", "enf", "4enf", "mmb", "slb"), "thickness", "arm", 0.5))


def one_name(given):
    """Replaces the other names of numbers in the sheet."""
    sheet = given["sheet"]
    for kinds, name, known, factor in OTHER_NAMES:
        if given["kind"] in kinds and name in sheet:
            value = factor * sheet.pop(name)
            if abs(sheet.get(known, value) / value - 1) > 1e-6:
                raise command.Trouble(f"{option(name)} {given['texts'][name]} and {option(known)} {given['texts'][known]} "
                                      f"contradict each other: {option(name)} is {1 / factor:g} times {option(known)}; give one")
            sheet[known] = value


def required(given):
    one_name(given)
    sheet, kind = given["sheet"], given["kind"]
    needed = list(KINDS[kind][1])
    if kind not in ("fibre",) and "young" not in sheet:
        needed += [key for key in PLY if key not in DEFAULTS]
    others = {known: name for kinds, name, known, _ in OTHER_NAMES if kind in kinds}
    missing = [option(key) + (f" (or {option(others[key])})" if key in others else "") for key in needed if key not in sheet]
    if kind == "laminate" and not given["layup"]:
        missing.append("--layup")
    if missing:
        raise command.Trouble(f"{kind} needs {', '.join(missing)} as well (`delam help new` explains them)")


def unused(given):
    """A sentence about the numbers that the kind does not take; nothing if it takes all."""
    kind = given["kind"]
    other = [option(key) for key in given["sheet"] if key not in KINDS[kind][1] + TAKEN[kind]]
    if given["layup"] and kind != "laminate":
        other.append("--layup")
    return [f"{kind} does not take {', '.join(other)}: not used"] if other else []


def warn(line):
    print(command.printable(f"warning: {line}"), file=sys.stderr)


def sheet_of(given):
    """All that scenes and theories read, by the names of Python; what the sheet leaves out is derived."""
    required(given)
    mistaken = taken_for_arm(given["kind"], given["sheet"].get("arm", 0.0), given["texts"])
    if mistaken:
        raise command.Trouble(mistaken)
    # At once: they may be the reason why no scene can be made.
    odd = plausible.warnings(given["kind"], given["sheet"], given["texts"])
    for line in odd:
        warn(line)
    numbers = {**DEFAULTS, **given["sheet"]}
    keys = ("width length arm lower-arm notch half-span span inner-span lever growth E1 E2 G12 nu12 nu23 young poisson GIc "
            "GIIc eta normal-strength shear-strength radius fraction fibre-young fibre-poisson ply strain cell").split() + list(FLAW)
    of = types.SimpleNamespace(**{key.lower().replace("-", "_"): numbers.get(key) for key in keys})
    of.kind, of.steps, of.layup = given["kind"], given["steps"], given["layup"]
    of.title, of.command = KINDS[of.kind][0], printable_command(given["command"])
    of.factor = FACTORS.get(of.kind, "The factor is the displacement of the load.")
    if of.young is not None:
        of.poisson = 0.3 if of.poisson is None else of.poisson
        of.e1 = of.e2 = of.young
        of.g12 = of.young / (2 * (1 + of.poisson))
    of.g13 = of.g12
    of.said, of.odd, of.proposals = [], odd, []  # warnings of the specimen; what the sheet does not have
    of.both_modes = of.gic is not None and of.giic is not None
    of.gic = of.giic if of.gic is None else of.gic
    of.giic = of.gic if of.giic is None else of.giic
    return of


def printable_command(text):
    return "delam " + command.printable(" ".join(text.split()[1:])).replace("\n", " ")


def size_beam(of):
    """Lengths of the specimen that the sheet leaves out, and the displacement in the end."""
    of.thickness = 2 * of.arm if of.kind != "adcb" else of.arm + of.lower_arm
    # Beam theory of the tests with a load in the middle, and their specimens, end there.
    middle = of.half_span if of.kind in ("enf", "mmb", "slb") else math.inf
    if not of.notch < middle:
        raise command.Trouble(f"--notch {of.notch:g} mm is not allowed: less than the half span of {middle:g} mm, at which the load is")
    of.growth = min(of.notch / 5, NEAR * (middle - of.notch)) if of.growth is None else of.growth
    if of.kind != "slb" and not of.notch + of.growth < middle:
        raise command.Trouble(f"--growth {of.growth:g} mm is not allowed: less than {middle - of.notch:g} mm, so that the crack of "
                              "the notch and its growth ends before the load in the middle")
    of.outside = (of.span - of.inner_span) / 2 if of.kind == "4enf" else 0.0
    of.inside = of.span - of.outside if of.kind == "4enf" else 0.0
    of.overhang = OVERHANG if of.kind in ("enf", "4enf") else 0.0
    if of.kind == "4enf" and not of.inner_span < of.span:
        raise command.Trouble(f"--inner-span {of.inner_span:g} mm is not allowed: less than --span, {of.span:g} mm")
    span = of.span if of.kind == "4enf" else 2 * of.half_span if of.half_span else 0.0
    # Beyond the last front: ten arms, so that the far end does not matter.
    least = of.overhang + span + OVERHANG if span else of.notch + of.growth + 10 * of.thickness
    of.least = math.ceil(least)
    of.length = of.length or of.least
    if not of.overhang + of.notch + of.growth < of.length or of.length < least - 1e-9 and span:
        raise command.Trouble(f"--length {of.length:g} mm is too short: it takes {least:g} mm at least, for a crack that "
                              f"grows from {of.notch:g} by {of.growth:g} mm")
    if of.kind == "mmb" and not of.lever > of.half_span / 3:
        raise command.Trouble(f"--lever {of.lever:g} mm is not allowed: more than a third of the half span, "
                              f"{of.half_span / 3:.4g} mm; a shorter one closes the notch")
    ends = [beams.growth(of, of.notch + part * of.growth)[1] for part in (0.0, 0.25, 0.5, 0.75, 1.0)]
    of.displacement = float(f"{PAST * max(ends):.3g}")


def checked(of, *options):
    """What `delam check` finds out about the scene as it is now."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(scenes.scene(of))
        done = subprocess.run([os.environ["DELAM"], "check", path, "--json", *options], capture_output=True, text=True, check=False)
    found = json.loads(done.stdout) if done.stdout.startswith("{") else {"correct": False}
    if not found["correct"]:
        said = found.get("errors", [{"message": done.stderr.strip()}])[0]
        raise command.Trouble(f"no scene can be made of the sheet: {said.get('key', '')} {said['message']}")
    return found


def process_zone(of):
    """The shortest predicted one, mm."""
    lengths = [float(re.search(r"about ([\d.e+-]+)", text)[1]) for text in checked(of, "--no-plan")["process_zones"]]
    return min(lengths) if lengths else math.inf


def propose_interface(of, wanted):
    """Strengths at which the process zone has the length `wanted`, as far as the sheet leaves them out: the ratio of both
    is that at which both modes soften alike, and the zone follows a power of them, which the last two zones tell."""
    of.stiffness = float(f"{STIFFNESS_FACTOR * of.e2 / (of.ply if of.kind == 'laminate' else of.arm):.3g}")
    of.highest, of.ratio = HIGHEST_STRENGTH, math.sqrt(of.giic / of.gic) if of.both_modes else SHEAR_RATIO
    ratio = of.ratio
    of.proposed_strengths = of.normal_strength is None and of.shear_strength is None
    if of.proposed_strengths:
        strength, power, before = HIGHEST_STRENGTH, 2.0, None
        for _ in range(8):
            of.normal_strength, of.shear_strength = strength, strength * ratio
            zone = process_zone(of)
            of.highest_zone = zone if before is None else of.highest_zone
            if abs(zone / wanted - 1) < 0.05 or (strength == HIGHEST_STRENGTH and zone > wanted):
                break
            if before:
                power = min(4.0, max(0.3, -math.log(zone / before[1]) / math.log(strength / before[0])))
            before = strength, zone
            strength = min(HIGHEST_STRENGTH, strength * (zone / wanted) ** (1 / power))
        of.normal_strength, of.shear_strength = float(f"{of.normal_strength:.3g}"), float(f"{of.shear_strength:.3g}")
    of.normal_strength = of.normal_strength or float(f"{of.shear_strength / ratio:.3g}")
    of.shear_strength = of.shear_strength or float(f"{of.normal_strength * ratio:.3g}")


def divide(of, size, given):
    """Cells of at most this size. Where the sheet leaves the length free, the notch ends at a pair, and so do the rest."""
    if given:
        of.cells = math.ceil(of.length / size - 1e-9)
        return
    size = of.notch / math.ceil(of.notch / size - 1e-9)
    of.overhang = size * math.ceil(of.overhang / size - 1e-9)
    of.cells = math.ceil(of.least / size - 1e-9)
    of.length = of.cells * size


def mesh_beam(of, given):
    of.cells_across, of.zone_pairs = 4, PAIRS
    size = of.notch / CELLS_PER_NOTCH
    divide(of, size, given)
    propose_interface(of, PAIRS * size)
    divide(of, min(size, process_zone(of) / PAIRS), given)


def mesh_fibre(of):
    around = 2 * math.pi * of.radius
    of.e2, of.arm = of.young, of.radius
    of.cells, of.zone_pairs = 96, PAIRS
    propose_interface(of, math.inf)
    of.cells = min(1000, max(96, 8 * math.ceil(PAIRS * around / min(process_zone(of), around) / 8)))


def mesh_laminate(of):
    try:
        of.angles = [float(word) for word in of.layup.split("/")]
    except ValueError:
        raise command.Trouble(f"--layup {of.layup}: angles with / between them are expected, like 0/45/-45/90") from None
    if len(of.angles) < 2:
        raise command.Trouble(f"--layup {of.layup}: two plies at least are expected")
    size = of.cell = of.cell or of.ply
    of.zone_pairs = PAIRS_OF_LAMINATE
    place_flaw_between(of)
    of.cells, of.cells_width = max(4, round(of.length / size)), max(8, round(of.width / size))
    place_flaw(of)
    propose_interface(of, PAIRS_OF_LAMINATE * size)


def place_flaw_between(of):
    """The interface of the flaw, counted from 0."""
    given = [option(key) for key in FLAW[1:] if getattr(of, key.replace("-", "_")) is not None]
    if of.flaw is None and given:
        raise command.Trouble(f"{', '.join(given)}: without --flaw, the length of the flaw, there is none")
    most = len(of.angles) - 1
    which = of.flaw_interface or (most + 1) // 2
    if which != int(which) or not 1 <= which <= most:
        raise command.Trouble(f"--flaw-interface {which:g} is not allowed: one of the interfaces 1 to {most}, from the bottom up")
    of.flaw_between = int(which) - 1 if of.flaw is not None else None


def place_flaw(of):
    """Where the flaw begins and ends along x and y: at pairs of the mesh, and within the laminate."""
    of.flaw_from, of.flaw_to = [], []
    if of.flaw is None:
        return
    for name, place, size, whole, cells, option_of in (
            ("x", of.flaw_at, of.flaw, of.length, of.cells, "--flaw"),
            ("y", of.flaw_across, of.flaw_width or of.width, of.width, of.cells_width, "--flaw-width")):
        middle, pairs = whole / 2 if place is None else place, whole / cells
        ends = middle - size / 2, middle + size / 2
        if not (ends[0] < whole and ends[1] > 0):
            raise command.Trouble(f"the flaw lies from {name} = {ends[0]:g} to {ends[1]:g} mm, outside of the laminate, which ends at "
                                  f"{whole:g} mm")
        meant = max(0.0, ends[0]), min(whole, ends[1])
        if meant[1] - meant[0] < size - 1e-9 * whole:
            of.said.append(f"the flaw from {name} = {ends[0]:g} to {ends[1]:g} mm does not fit into the laminate, which ends at 0 and "
                           f"{whole:g} mm: it is cut off there")
        found = [pairs * round(end / pairs) for end in meant]
        if found[1] - found[0] < pairs / 2:
            raise command.Trouble(f"{option_of} {size:g} mm is too short: pairs are {pairs:g} mm apart along {name} (--cell)")
        if max(abs(a - b) for a, b in zip(found, meant)) > 1e-6 * pairs:
            of.said.append(f"the flaw from {name} = {meant[0]:g} to {meant[1]:g} mm ends between pairs, which are {pairs:g} mm apart: "
                           f"in the scene it lies from {found[0]:g} to {found[1]:g} mm")
        of.flaw_from.append(found[0])
        of.flaw_to.append(found[1])


def write(text, path, replace):
    if not path:
        sys.stdout.write(text)
        return
    if os.path.lexists(path) and not replace:
        raise command.Trouble(f"{path}: is there already; --replace overwrites it")
    beside = f"{path}.new-{os.getpid()}"
    try:
        with open(beside, "x", encoding="utf-8") as file:
            file.write(text)
        os.replace(beside, path)
    except OSError as error:
        raise command.Trouble(f"{path}: cannot be written: {error.strerror}", command.OUTPUT) from None


def main():
    given = json.loads(sys.argv[1])
    of = sheet_of(given)
    if of.kind == "fibre":
        mesh_fibre(of)
    elif of.kind == "laminate":
        mesh_laminate(of)
    else:
        size_beam(of)
        mesh_beam(of, "length" in given["sheet"])
    found = checked(of)
    of.proposals = proposals.sentences(of, given)
    write(scenes.scene(of), given["out"], given["replace"])
    said = standards.warnings(of) if of.kind in beams.THEORY else []
    # The program has chosen mm and N itself: other units are no hint, and an odd number of the sheet is told by its name.
    hints = [re.sub(r"; the numbers suggest .*", "", one) for one in found["warnings"] if not (of.odd and one.startswith("[units]"))]
    for line in unused(given) + proposals.warnings(of, given) + said + of.said + hints:
        warn(line)
    if given["out"]:
        print(f"zone      {'; '.join(found['process_zones'])}")
        print(f"mesh      {found['unknowns']['primal']} displacements, {of.steps} steps")
        for name, sentence in proposals.lines(of, given):
            print(proposals.wrapped(sentence, f"{name:<10}", 10 * " "))
        if of.kind in beams.THEORY:
            print(scenes.theory(of).replace("# ", "theory    ", 1).replace("# ", "          ").rstrip())
            if standards.remarks(of):
                print(proposals.wrapped(standards.remarks(of), "growth    ", 10 * " "))
        print(f"wrote     {given['out']}: read it, then run it with delam run {shlex.quote(given['out'])} --out FOLDER")
    return command.DONE


if __name__ == "__main__":
    command.run(main)
