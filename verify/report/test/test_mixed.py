# SPDX-License-Identifier: BSD-3-Clause
"""Analyses of mixed-mode bending as theory has them, spoilt one by one: the claims of chapter (h) must see each."""
import copy
import sys
import types
import unittest
from unittest import mock

import planted

sys.path.insert(0, str(planted.REPORT / "cases"))
import bending  # noqa: E402
import case  # noqa: E402
import h_mixed  # noqa: E402

ELASTIC = 5.6e-8  # m/(N/m) of the notch, G_II/G = 0.8
HIGH = "peak over that of beam theory, over what is allowed"
LOW = "peak below that of beam theory, over what is allowed"
RECORDED = "dissipated per new crack, off its softening zone"
LEDGER = "stored + dissipated + released - work, over what is dissipated"
UNNAMED = "falls of the load without a recorded jump"


def exact(steps, second=bending.MODE_II):
    """The local analysis by beam theory: elastic up to the peak, then the crack whose growth needs this displacement. What
    the jump neither stores nor dissipates is released, and recorded."""
    specimen = bending.SPECIMENS["0.8"]
    with mock.patch.object(bending, "MODE_II", second):
        down, load, crack = specimen.envelope(ELASTIC, 4000)
    spent = [0.0]
    with mock.patch.object(bending, "MODE_II", second):
        for a, b in zip(crack, crack[1:]):
            spent.append(spent[-1] + (b - a) * specimen.criterion(0.5 * (a + b)))
    end = down[-1]
    out = types.SimpleNamespace(specimen=specimen, h=1e-4, steps=steps, open=0, jumps=[], shear=bending.TURON)
    at = {name: [0.0] for name in ("load:press", "reaction:press", "stored_bulk", "stored_interface", "dissipated",
                                   "work", "released", "popped", "crack_length", "lower", "increment", "increment_lower",
                                   "upper")}
    at["crack_length"] = [bending.NOTCH]
    i = 0
    for k in range(1, steps + 1):
        u, before = k * end / steps, i
        if u > down[0]:
            i = next(n for n in range(max(i, down.index(min(down))), len(down)) if down[n] >= u - 1e-12)
        p = u / ELASTIC if i == 0 else load[i]
        stored, work = 0.5 * p * u, at["work"][-1] + 0.5 * (p + at["reaction:press"][-1]) * (u - at["load:press"][-1])
        rest = stored + spent[i] - at["stored_bulk"][-1] - spent[before]
        jumped = before == 0 and i > 0
        if jumped:
            begin = 0.5 * (at["reaction:press"][-1] + load[0]) * (down[0] - at["load:press"][-1])
            landing = next(load[n] for n in range(down.index(min(down)), len(down)) if down[n] >= down[0])
            work = at["work"][-1] + begin + 0.5 * (landing + p) * (u - down[0])
            out.jumps.append({"step": k, "released": work - at["work"][-1] - rest, "at": down[0], "before": load[0],
                              "after": landing})
        released = out.jumps[-1]["released"] if jumped else 0.0
        for name, value in (("load:press", u), ("reaction:press", p), ("stored_bulk", stored), ("dissipated", spent[i]),
                            ("work", at["work"][-1] + rest + released), ("released", released),
                            ("crack_length", crack[i])):
            at[name].append(value)
        for name in ("stored_interface", "popped", "lower", "increment", "increment_lower", "upper"):
            at[name].append(0.0)
    out.zones = [[(0.1 * k, specimen.mixity(a)) for k in range(1, 10)] for a in at["crack_length"]]
    out.at, out.down, out.load, out.crack = at, at["load:press"], at["reaction:press"], at["crack_length"]
    return out


def failed(checks):
    return {c["what"] for c in checks
            if not (c["value"] <= c["limit"] if c["sense"] == "<=" else c["value"] >= c["limit"])}


class Judged(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.sound = {f"{n} steps": exact(n) for n in (100, 400)}

    def judged(self, **spoilt):
        analyses = {name: copy.deepcopy(m) for name, m in self.sound.items()}
        for name, spoil in spoilt.items():
            spoil(analyses[name.strip("_") + " steps"])
        return failed(h_mixed.judged("0.8", analyses, jumps=True))

    def test_sound_analyses_pass(self):
        self.assertEqual(self.judged(), set())

    def test_a_wrong_toughness_in_one_mode(self):
        for factor, side in ((1.2, HIGH), (0.8, LOW)):
            wrong = {f"{n} steps": exact(n, factor * bending.MODE_II) for n in (100, 400)}
            self.assertEqual(failed(h_mixed.judged("0.8", wrong, jumps=True)), {side, RECORDED})

    @staticmethod
    def cut(of, share=0.2, hidden=False):
        """The jump records less than its path dissipates; hidden: what is missing is called released."""
        k = of.jumps[0]["step"]
        missing = share * (of.at["dissipated"][k] - of.at["dissipated"][k - 1])
        for i in range(k, len(of.load)):
            of.at["dissipated"][i] -= missing
        if hidden:
            of.at["released"][k] += missing

    def test_a_path_cut_short(self):
        self.assertEqual(self.judged(_400=self.cut), {RECORDED, LEDGER})

    def test_a_path_cut_short_and_recorded_as_released(self):
        self.assertEqual(self.judged(_100=lambda m: self.cut(m, hidden=True)), {RECORDED})

    def test_a_mixity_held_too_long(self):
        def later(of):  # the elastic line goes on for three steps
            k = of.jumps[0]["step"]
            for i in range(k, k + 3):
                of.load[i] = of.down[i] / ELASTIC
        seen = self.judged(_100=later)
        self.assertIn("loads of analyses with different steps, apart", seen)
        self.assertIn(HIGH, seen)

    def test_a_jump_without_a_record(self):
        for name in ("_100", "_400"):
            self.assertEqual(self.judged(**{name: lambda m: m.jumps.clear()}), {UNNAMED})

    def test_an_energy_without_a_place(self):
        def lost(of):
            of.at["released"] = [0.0] * len(of.load)
        self.assertEqual(self.judged(_400=lost), {LEDGER})

    def test_a_jump_that_theory_does_not_have(self):
        self.assertEqual(failed(h_mixed.judged("0.8", self.sound, jumps=False)),
                         {"jumps of a mesh in its analysis of most steps, at most"})


class Analyses(unittest.TestCase):
    def test_smooth_falls_of_long_steps_are_no_jumps(self):
        coarse, fine = exact(20), exact(400)
        self.assertGreater(len(bending.drops(coarse.load)), 1)
        self.assertEqual(len(bending.drops(fine.load)), 1)
        self.assertEqual(bending.at_once([coarse, fine]), [[m.jumps[0]["step"]] for m in (coarse, fine)])
        # The analysis of more steps tells that they shrink.
        middle, jump = exact(40), coarse.jumps[0]["step"]
        self.assertGreater(len(bending.drops(middle.load)), 1)
        self.assertEqual(bending.at_once([coarse, middle]), [[jump], [middle.jumps[0]["step"]]])

    def test_published_loads(self):
        for name, load in h_mixed.PUBLISHED.items():
            specimen = bending.SPECIMENS[name]
            self.assertAlmostEqual(h_mixed.newtons(specimen.critical(bending.NOTCH)) / load, 1.0, delta=5e-4)
            self.assertAlmostEqual(specimen.mixity(bending.NOTCH), float(name), delta=0.01)

    def test_the_ledger_counts_what_is_released(self):
        ledger = case.ledger_of({"analysis": exact(100).at}, "J/m")
        of = dict(zip([c["name"] for c in ledger["columns"]], ledger["rows"][0]))
        self.assertGreater(of["released"], 5e-3 * of["work"])
        self.assertLess(abs(of["defect"]), 1e-9 * of["work"])


if __name__ == "__main__":
    unittest.main()
