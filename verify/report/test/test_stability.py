# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the harness's table of hard cases, altered one by one: each must be seen by the page that judges it again."""
import copy
import sys
import unittest

import planted
import case as c

sys.path.insert(0, str(planted.REPORT / "cases"))
import d_stability as d  # noqa: E402

COLUMNS = ["subject", "parameter", "value", "realisation", "reference", "error", "limit", "kkt", "ledger", "defect", "damage", "active_set", "krylov",
           "alternations", "status", "expected", "verdict", "message"]
RIGHT = "right to 1e-10"


def row(who="condensed", value=10.0, **altered):
    sound = dict(subject="bar", parameter="k, N/m3", value=value, realisation=who, reference="closed form", error=1e-12, limit=1e-10, kkt=1e-13, ledger=1e-14,
                 defect=1e-15, damage=0.0, active_set=2.0, krylov=0.0, alternations=3.0, status="converged", expected=RIGHT, verdict="pass", message="")
    return [{**sound, **altered}[name] for name in COLUMNS]


class Judged(unittest.TestCase):
    def setUp(self):
        self.subject = d.Subject("bar", "bar", "k", "N/m3", defect=1e-10)

    def judged(self, *rows, subject=None):
        """The checks that fail, by the last words of their names, with the reasons given."""
        checks, answered = d.judged(subject or self.subject, c.Rows({"table": "stability", "columns": COLUMNS, "rows": list(rows)}))
        self.answered = answered
        return {x["what"].split(": ", 1)[1]: x["why"] for x in checks if not (x["value"] <= x["limit"] if x["sense"] == "<=" else x["value"] >= x["limit"])}

    def test_sound_rows_pass(self):
        self.assertEqual(self.judged(row(), row("FETI"), row("direct", expected="accepted")), {})
        self.assertTrue(self.answered)

    def silent(self, check=None, subject=None, **altered):
        """One altered row among sound ones is named as a silent wrong answer, and fails the check of its kind."""
        for who in ("condensed", "FETI"):
            failed = self.judged(row("FETI" if who == "condensed" else "condensed"), row(who, 20.0, **altered), subject=subject)
            self.assertIn(f"{who} at 20", failed.get("silent wrong answers", ""))
            self.assertEqual(set(failed), {"silent wrong answers", *([check] if check else [])})

    def test_error_beyond_its_limit(self):
        self.silent("error over its limit", error=1.1e-10)

    def test_error_where_none_is_allowed(self):
        self.silent("error over its limit", error=5e-324, limit=0.0)

    def test_kkt_beyond_its_limit(self):
        self.silent("primal KKT over its limit", kkt=1.1e-9)

    def test_kkt_judged_apart_from_the_verdict(self):
        # The harness would have let it pass: the page has a limit of its own.
        self.silent("primal KKT over its limit", kkt=2e-9, verdict="pass")
        self.assertEqual(self.judged(row(kkt=2e-9), subject=d.Subject("bar", "bar", "k", acceptance=5e-9)), {})

    def test_ledger_beyond_its_limit(self):
        self.silent("ledger over its limit", ledger=1.1e-9)

    def test_limit_as_a_function_of_the_parameter(self):
        subject = d.Subject("bar", "bar", "k", acceptance=lambda value: 1e-12 * value, accepts="1e-12 k")
        self.assertEqual(self.judged(row(kkt=1e-11, value=20.0), subject=subject), {})
        self.silent("primal KKT over its limit", subject=subject, kkt=3e-11)

    def test_rounding_of_the_matrices_raises_limits_only_where_the_row_says_so(self):
        raised = dict(limit=1e-6, kkt=1e-7, ledger=1e-7)
        self.assertEqual(self.judged(row(expected=f"right to 1e-06 ({d.BY_ROUNDING})", **raised)), {})
        self.assertIn("primal KKT over its limit", self.judged(row(expected=RIGHT, **raised)))

    def test_damage_by_the_verdict(self):
        self.silent(damage=0.5, verdict="fail: damage")

    def test_defect_of_the_balance(self):
        failed = self.judged(row(), row("FETI", defect=1e-6))
        self.assertEqual(set(failed), {"defect of the balance"})
        # Where it falls with the steps it is no fault.
        self.assertEqual(self.judged(row(defect=0.3), subject=d.Subject("bar", "bar", "k")), {})

    def test_not_converged_without_being_expected(self):
        ends = "rows that end otherwise than expected"
        for status in (d.SAID, "DELAM_LIMIT", "failed"):
            self.assertIn(status, self.judged(row(), row("FETI", 20.0, status=status))[ends])
        said = RIGHT + ", or says that it is not"
        self.assertEqual(self.judged(row(), row("FETI", 20.0, status=d.SAID, expected=said)), {})
        # Only that it did not converge may be said.
        self.assertIn("failed", self.judged(row(), row("FETI", 20.0, status="failed", expected=said))[ends])

    def test_a_wrong_answer_is_not_excused_by_what_it_might_have_said(self):
        self.silent("error over its limit", error=1e-3, expected=RIGHT + ", or says that it is not")

    def test_missing_number(self):
        for name in ("error", "limit", "kkt", "ledger", "defect", "damage"):
            for hole in (None, "nan", float("nan"), float("inf"), "", True):
                with self.subTest(name=name, hole=hole), self.assertRaisesRegex(c.Failed, name):
                    self.judged(row(), row("FETI", **{name: hole}))

    def test_refusals(self):
        refused, ends = "refused: no equilibrium", "rows that end otherwise than expected"
        said = dict(status="DELAM_LIMIT", expected=refused)
        self.assertEqual(self.judged(row(message="no equilibrium: a dead force", **said)), {})
        self.assertFalse(self.answered)
        self.assertIn(ends, self.judged(row(message="other words", **said)))
        self.assertIn(ends, self.judged(row(message="no equilibrium", status="converged", expected=refused)))

    def test_left_out_without_a_reason(self):
        ends, left = "rows that end otherwise than expected", dict(status="left out", error="nan")
        self.assertEqual(self.judged(row(), row("FETI", message="14 GB", **left)), {})
        self.assertIn("FETI at 10", self.judged(row(), row("FETI", message="", **left))[ends])

    def test_missing_column(self):
        table = {"table": "stability", "columns": [n for n in COLUMNS if n != "kkt"], "rows": [r[:7] + r[8:] for r in [row()]]}
        with self.assertRaises(KeyError):
            d.judged(self.subject, c.Rows(table))


class Told(unittest.TestCase):
    def told(self, *rows, **subject):
        return d.told(d.Subject("bar", "bar", "k", **subject), c.Rows({"table": "stability", "columns": COLUMNS, "rows": copy.deepcopy(list(rows))}))

    def test_nothing_to_tell(self):
        self.assertEqual(self.told(row(), row("FETI")), [])

    def test_accepted_kkt_is_told_with_its_bound(self):
        told, = self.told(row(), row(value=1000.0, kkt=2.6e-5), acceptance=lambda ratio: 2e-16 * ratio ** 4, accepts="2e-16 (l/t)^4")
        for words in ("condensed", "2.6e-05", "1000", "2.0e-04", "2e-16 (l/t)^4"):
            self.assertIn(words, told)

    def test_errors_beyond_one_percent_are_told_with_their_reason(self):
        told, = self.told(row(error=0.129, limit=0.15), wide="shear of thick arms")
        for words in ("12.9 %", "15.0 %", "shear of thick arms"):
            self.assertIn(words, told)

    def test_two_states_are_told(self):
        apart = (row(defect=0.01), row("FETI", defect=0.05))
        told, = self.told(*apart)
        self.assertIn("different critical states", told)
        self.assertEqual(self.told(*apart, apart=lambda _: 0.1), [])

    def test_left_out_and_not_converged_are_told(self):
        told = self.told(row(), row("FETI", status=d.SAID), row("direct", status="left out", message="it floats"))
        self.assertEqual(len(told), 2)
        self.assertIn("FETI does not converge", told[0])
        self.assertIn("it floats", told[1])


if __name__ == "__main__":
    unittest.main()
