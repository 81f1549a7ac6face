# SPDX-License-Identifier: BSD-3-Clause
"""Supports that begin or end within an analysis, in scenes and in decks: closed forms of a block that stays elastic,
runs that are interrupted, and what is refused."""
import csv
import os
import signal
import subprocess

from block_deck import deck, history
from deck_runs import close, imported
from support import DELAM, delam, expect, expect_error, finish, folder, write

FORCES = 0.02  # on each of the five nodes of the top, far below what breaks the interface
SECOND = "*Step\n*Static\n0.1, 1., 1e-5, 0.1\n{}*End step\n"
PULL = "Top, 2, 2, 0.002\n"


def pushed(*later, held="Bottom, 2\n1, 1\nTop, 1\n"):
    """A deck whose first step pulls the top by forces."""
    text = deck(held=held, loads="", after=f"*Cload\nTop, 2, {FORCES}\n")
    return text + "".join(SECOND.format(lines) for lines in later)


def stiffness():
    """The force on the top over its displacement."""
    rows, _ = history(deck(loads=PULL))
    return rows[-1]["reaction"] / 0.002


def check_begins():
    """A top that forces have moved is then prescribed: to a value, by a velocity, or back to zero."""
    spring, force = stiffness(), 5 * FORCES
    rows, said = history(pushed("*Boundary\n" + PULL))
    expect(len(rows) == 21, f"{len(rows)} instants")
    close("no force before it begins", rows[10]["reaction_displacement"] + 1, 1)
    for share, row in ((0.5, rows[15]), (1.0, rows[20])):
        close(f"on its way, {share}", row["reaction_displacement"], share * (spring * 0.002 - force), 1e-6)
    for row in rows:
        close("balance", row["defect"] + 1, 1)
    rows, _ = history(pushed("*Boundary, type=VELOCITY\n" + PULL))
    close("a velocity counts from where the top is", rows[-1]["reaction_displacement"], spring * 0.002, 1e-6)
    rows, _ = history(pushed("*Boundary\nTop, 2\n"))
    before = rows[10]["stored_bulk"]
    close("halfway to zero", rows[15]["stored_bulk"], 0.25 * before, 1e-6)
    close("at zero", rows[20]["stored_bulk"] + before, before, 1e-6)
    rows, _ = history(pushed("*Boundary, fixed\nTop, 2\n*Cload, op=NEW\n"))
    close("FIXED holds without the forces", rows[-1]["stored_bulk"], before, 1e-6)
    ramp = "*Amplitude, name=Ramp\n0., 0., 1., 1.\n"
    scene, said = imported(ramp + pushed("*Boundary, amplitude=Ramp\n" + PULL))
    expect("from = 1.0\nreached = 1.1\n" in scene and "over the first increment" in said, "an amplitude")


def check_ends():
    """OP=NEW frees the top, whose force falls to zero; a third step pulls it again."""
    kept = "*Boundary, op=NEW\nBottom, 2\n1, 1\nTop, 1\n"
    text = deck(loads=PULL) + SECOND.format(kept)
    rows, _ = history(text)
    before = rows[10]["stored_bulk"]
    for share, row in ((0.5, rows[15]), (0.0, rows[20])):
        close(f"a share of {share}", row["stored_bulk"] + before, (1 + share * share) * before, 1e-6)
        close("no support any more", row["reaction"] + 1, 1)
        close("balance", row["defect"] + 1, 1)
    rows, _ = history(text + SECOND.format("*Boundary\n" + PULL))
    close("pulled again", rows[-1]["stored_bulk"], before, 1e-6)
    # A support of the model that the first step frees never holds; a stage that holds nothing is told with its time.
    scene, _ = imported(deck(loads=PULL, held=kept.replace("*Boundary, op=NEW\n", "")).replace(
        "*Boundary\nBottom", "*Boundary, op=NEW\nBottom").replace("*Step", "*Boundary\nTop, 2\n*Step", 1))
    expect("until" not in scene, "freed by the first step")
    nothing = write(deck(loads=PULL) + SECOND.format("*Boundary, op=NEW\nTop, 1\n"), "deck.inp")
    expect_error(delam("check", nothing), 2, "from time 1 on, where supports begin or end: missing support")


def scene_of(text, name="scene.toml"):
    """The scene of a deck, in a folder with its mesh."""
    place = folder()
    path = write(text, "deck.inp", place)
    code, said, error = delam("import", path, "--out", os.path.join(place, name))
    expect(code == 0, f"import: {said} {error}")
    with open(os.path.join(place, name), encoding="utf-8") as file:
        return place, file.read()


def check_keys():
    place, text = scene_of(pushed("*Boundary\n" + PULL))
    expect("from = 1.0\nreached = 2.0\n" in text, "keys of a support that begins")

    def said(old, new, expected=0):
        expect(old in text, f"{old} is there")
        code, out, error = delam("check", write(text.replace(old, new), "changed.toml", place))
        expect(code == expected, f"{new}: exit {code} {error}")
        return out + error
    plan = said("from = 1.0", "from = 1.0")
    expect("supports that begin or end: used, at time 1" in plan.replace("\n  ", " "), plan[-500:])
    for new, words in (("from = 1.04", "from: 1.04 is no instant of [time]: a load step must end there; the nearest"),
                       ("from = 0.0", "an instant between 0 and 2, the first and the last"),
                       ("from = 2.0", "an instant between 0 and 2"),
                       ("until = 1.0\nfrom = 1.0", "until: 1 is not allowed: > 1 (from)"),
                       ("released = 1.0\nfrom = 1.0", "until is missing")):
        expect(words in said("from = 1.0", new, 2), f"{new}: {words}")
    expect("reached: 0.5 is not allowed: > 1 (from)" in said("reached = 2.0", "reached = 0.5", 2), "reached")
    expect("from is missing" in said("from = 1.0\n", "", 2), "reached without from")


def rows_of(path):
    with open(os.path.join(path, "history.csv"), newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def check_resumed():
    """A run that is stopped in either stage goes on with the same digits."""
    place, text = scene_of(deck(loads=PULL.replace("0.002", "0.009")) + SECOND.format(
        "*Boundary, op=NEW\nBottom, 2\n1, 1\nTop, 1\n") + SECOND.format("*Boundary\nTop, 2, 2, 0.03\n"))
    path = write(text, "scene.toml", place)
    whole = os.path.join(place, "whole")
    code, _, error = delam("run", path, "--out", whole)
    expect(code == 0, f"whole: {error}")
    end = dict(zip(*(rows_of(whole)[row] for row in (0, -1)), strict=True))
    close("the toughness of all faces", float(end["dissipated"]), 4 * 0.01, 1e-6)
    close("work of all loads, back and forth", float(end["work"]), 4 * 0.01, 1e-2)
    for step in (5, 10, 11, 14, 20, 25):
        out = os.path.join(place, f"out-{step}")
        with subprocess.Popen([DELAM, "run", path, "--out", out], stdout=subprocess.PIPE, text=True) as process:
            for line in process.stdout:
                if line.startswith(f"step {step}/"):
                    process.send_signal(signal.SIGKILL)
                    break
            process.communicate()
        code, said, error = delam("run", path, "--out", out, "--resume")
        expect(code == 0, f"resumed after {step}: {said} {error}")
        expect(rows_of(out) == rows_of(whole), f"resumed after step {step}: other digits")


if __name__ == "__main__":
    check_begins()
    check_ends()
    check_keys()
    check_resumed()
    finish()
