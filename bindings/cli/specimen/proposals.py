# SPDX-License-Identifier: BSD-3-Clause
"""What `delam new` puts into a scene although the sheet does not have it: a sentence for each kind of proposal, with the reason
and what to do. The scene has them as comments, and the terminal says them."""
import textwrap

WIDTH = 120  # of lines in scenes and on the terminal
SYMBOLS = {"nu12": "nu12", "nu23": "nu23", "poisson": "poisson", "eta": "exponent eta"}


def option(key):
    return "--" + key


def assumed(of, given):
    """Usual values of what the sheet leaves out."""
    sheet, out = given["sheet"], []
    elastic = () if of.kind == "fibre" else ("poisson",) if of.young is not None else ("nu12", "nu23")
    for key in elastic + (("eta",) if of.both_modes else ()):
        if key not in sheet:
            out.append((option(key), f"{SYMBOLS[key]} = {getattr(of, key):g}"))
    for key, name, other in (("GIc", "mode I", "mode II"), ("GIIc", "mode II", "mode I")):
        if key not in sheet:
            out.append((option(key), f"the toughness of {name} is that of {other}, {of.gic:g} N/mm"))
    if not out:
        return ""
    values = ", ".join(text for _, text in out)
    return f"{values}: not in the sheet ({', '.join(key for key, _ in out)})"


def strengths(of, given):
    """Why the strengths are what they are, where the sheet has none or one of both."""
    missing = [option(key) for key in ("normal-strength", "shear-strength") if key not in given["sheet"]]
    if not missing:
        return ""
    opening, shear = f"{of.normal_strength:g} MPa in opening", f"{of.shear_strength:g} MPa in shear"
    if len(missing) == 1:
        return (f"{shear if 'shear' in missing[0] else opening}: not in the sheet, but the strength at which both modes soften alike "
                f"({missing[0]})")
    if of.normal_strength >= of.highest and of.kind != "laminate":
        return (f"{opening}, {shear}: not in the sheet, but the largest that a resin has; the cells resolve its process zone "
                f"({', '.join(missing)})")
    if of.kind != "laminate":
        return (f"{opening}, {shear}: not in the sheet, but those at which the process zone has {of.zone_pairs:g} pairs of the mesh "
                f"({', '.join(missing)})")
    text = (f"strengths of {opening} and {shear} are proposed, because the sheet has none: at them the process zone is long enough "
            f"for cells of {of.cell:g} mm. Resins have tens of MPa, and delamination of edges without a flaw begins at a load that "
            "depends on the strengths")
    if of.normal_strength >= of.highest:
        return text + f". Give them ({', '.join(missing)})"
    cell = float(f"{of.highest_zone / of.zone_pairs:.2g}")
    more = (of.cell / cell) ** 2
    return (text + f". Give them, and cells that resolve their zone, for example {missing[0]} {of.highest:g}MPa {missing[1]} "
            f"{of.highest * of.ratio:.3g}MPa --cell {cell:g}mm, which has {more:.2g} times as many cells")


def warnings(of, given):
    """Proposals on which the load of the first damage depends: only tests with a notch do without strengths."""
    text = strengths(of, given) if of.kind == "laminate" else ""
    return [text] if text else []


def sentences(of, given):
    """For the scene, all of them."""
    return [text for text in (assumed(of, given), strengths(of, given)) if text]


def lines(of, given):
    """(name, sentence) of each proposal that is no warning."""
    found = [("assumed", assumed(of, given)), ("strengths", strengths(of, given) if of.kind != "laminate" else "")]
    return [(name, text) for name, text in found if text]


def wrapped(text, first, then):
    return "\n".join(textwrap.wrap(text, WIDTH, initial_indent=first, subsequent_indent=then, break_on_hyphens=False))


def comments(of):
    """Lines of comments in a scene."""
    return "".join(wrapped(f"Proposed by `delam new`: {text}.", "# ", "# ") + "\n" for text in of.proposals)
