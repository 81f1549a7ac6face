# SPDX-License-Identifier: BSD-3-Clause
"""What is planted must be caught: by the reference, by the past, or by the schema."""
import copy
import json
import math
import pathlib
import tempfile
import unittest

import planted
import case as c
import judge
import orders
import schema
import words


class Judged(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.past = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def judge(self, data):
        return judge.judge(data, self.past, quick=False)

    def fails(self, data, *words):
        judged = self.judge(data)
        self.assertEqual(judged["status"], "failed")
        for word in words:
            self.assertIn(word, judged["reason"])
        schema.check(judged)

    def test_a_sound_case_passes(self):
        judged = self.judge(planted.sound())
        self.assertEqual((judged["status"], judged["judgement"]["past"]["verdict"]), ("passed", "new"))
        schema.check(judged)

    # Against the reference: a bar whose end must move by 2; the error is formed as the cases do.
    def bar(self, moved):
        return planted.sound(checks=[c.check("displacement of the end", abs(moved / 2.0 - 1.0), 1e-9, "closed form")], orders=[])

    def test_a_past_has_a_line_for_each_row(self):
        data = planted.sound()
        self.judge(data)
        judge.accept(data, self.past, False, "2026-01-01")
        text = judge.past_path(self.past, data["id"]).read_text(encoding="utf-8")
        rows = json.loads(text)["full"]["numbers"]
        self.assertEqual(judge.by_name(rows), {name: found[0] for name, found in judge.numbers(data).items() if found})
        for row in rows:
            self.assertEqual(sum(line.strip().startswith(json.dumps(row) + ":") for line in text.splitlines()), 1, row)
        self.assertEqual(judge.by_name(judge.by_row({"alone": 1.0, "a | b | c": 2.0})), {"alone": 1.0, "a | b | c": 2.0})

    def test_wrong_sign(self):
        self.assertEqual(self.judge(self.bar(2.0))["status"], "passed")
        self.fails(self.bar(-2.0), "displacement of the end")

    def test_wrong_factor(self):
        for factor in (0.5, 2.0, 1.0 + 1e-6):
            self.fails(self.bar(2.0 * factor), "displacement of the end")

    def test_wrong_order(self):
        errors = list(planted.SIZES)
        fitted = orders.fit(planted.SIZES, errors)
        self.fails(planted.sound(orders=[c.order("error", "h", fitted, 2.0, 0.1, planted.SIZES, errors)]), "order of error")
        # Faster than expected is fine only where the case says so.
        errors = [h**3 for h in planted.SIZES]
        fitted = orders.fit(planted.SIZES, errors)
        self.fails(planted.sound(orders=[c.order("error", "h", fitted, 2.0, 0.1, planted.SIZES, errors)]))
        at_least = c.order("error", "h", fitted, 2.0, 0.1, planted.SIZES, errors, "at least")
        self.assertEqual(self.judge(planted.sound(orders=[at_least]))["status"], "passed")

    def test_diverging_errors(self):
        errors = [1.0 / h for h in planted.SIZES]
        o = c.order("error", "h", orders.fit(planted.SIZES, errors), 1.0, 0.1, planted.SIZES, errors, "at least")
        self.fails(planted.sound(orders=[o]))

    def test_an_order_that_its_data_do_not_have(self):
        data = planted.sound()
        data["orders"][0]["errors"][-1] *= 3.0
        self.fails(data, "its data have")

    def test_not_converged(self):
        data = planted.sound()
        data["tables"][0]["rows"][2][4] = 3
        self.fails(data, "not converged", "row 3")
        data["tables"][0]["columns"][4]["may"] = True
        self.assertEqual(self.judge(data)["status"], "passed")

    def test_limit_and_failure_in_words(self):
        for word in ("limit", "failed: singular"):
            data = planted.sound()
            data["tables"][0]["rows"][1][1] = word
            self.fails(data, "not converged", word)

    def test_case_without_reference(self):
        data = planted.sound()
        data["reference"] = {"kind": "", "source": "", "uncertainty": ""}
        self.fails(data, "no evidence", "names no reference")

    def test_case_that_compares_nothing(self):
        self.fails(planted.sound(checks=[], orders=[]), "no evidence", "compares nothing")

    def test_refusal(self):
        judged = self.judge(planted.sound(checks=[], orders=[], refused="poisson must be below 0.5"))
        self.assertEqual(judged["status"], "refused as expected")
        schema.check(judged)

    def test_the_worst_check_decides(self):
        checks = [c.check("good", 1e-12, 1e-3, "x"), c.check("bad", 2.0, 1.0, "x"), c.check("at least", 5.0, 3.0, "x", ">=")]
        self.fails(planted.sound(checks=checks), "bad")
        self.fails(planted.sound(checks=[c.check("at least", 0.0, 1.0, "x", ">=")]), "at least")
        self.fails(planted.sound(checks=[c.check("none", 1e-300, 0.0, "x")]), "none")
        self.assertEqual(self.judge(planted.sound(checks=[c.check("none", 0.0, 0.0, "x")]))["status"], "passed")

    def test_an_upper_bound_decides_and_its_sense_is_said(self):
        checks = [c.check("ran", 8, 8, "x", ">="), c.check("off", 1e-6, 1e-3, "x")]
        found = self.judge(planted.sound(checks=checks))["judgement"]["reference"]
        self.assertEqual((found["value"], words.bound(found)), (1e-6, "≤ 0.001"))
        self.assertIn("off: 1e-06 <= 0.001", found["why"])
        # A lower bound that does not hold comes first, and one alone decides.
        checks[0]["limit"] = 9
        self.fails(planted.sound(checks=checks), "ran: 8 >= 9 does not hold")
        found = self.judge(planted.sound(checks=[c.check("ran", 8, 8, "x", ">=")]))["judgement"]["reference"]
        self.assertEqual(words.bound(found), "≥ 8")

    def test_an_order_that_may_be_higher_says_so(self):
        found = c.order("error", "h", 3.0, 2.0, 0.1, sense="at least")
        self.assertEqual(words.expected(found), "at least 2")
        judged = self.judge(planted.sound(checks=[], orders=[found]))
        self.assertIn("3.000, expected at least 2 within 0.1", judged["judgement"]["reference"]["why"])
        self.assertEqual(words.expected(c.order("error", "h", 2.0, 2.0, 0.1)), "2")

    # Against the past.
    def accepted(self):
        judge.accept(self.judge(planted.sound()), self.past, False, "2000-01-01")
        return planted.sound()

    def test_the_same_numbers(self):
        judged = self.judge(self.accepted())
        self.assertEqual(judged["judgement"]["past"]["verdict"], "pass")
        self.assertEqual(judged["judgement"]["past"]["worst"], 0.0)

    def test_a_number_that_moved(self):
        for change, verdict in ((1e-9, "pass"), (1e-5, "fail"), (-1e-5, "fail")):
            data = self.accepted()
            data["tables"][0]["rows"][1][1] *= 1.0 + change
            self.assertEqual(self.judge(data)["judgement"]["past"]["verdict"], verdict, change)
        data = self.accepted()
        data["figures"][0]["value"] *= -1.0
        self.fails(data, "own past", "bar_error")

    def test_other_kernels_of_blas(self):
        data = self.accepted()
        data["kernels"] = "Other"
        self.assertEqual(self.judge(data)["judgement"]["past"]["verdict"], "pass")
        data["tables"][0]["rows"][1][1] *= 1.0 + 1e-5
        self.assertEqual(self.judge(data)["judgement"]["past"]["verdict"], "elsewhere")
        self.assertEqual(data["status"], "passed")
        self.assertIn("Other", data["judgement"]["past"]["why"])

    def test_counts_have_a_band(self):
        for count, verdict in ((110, "pass"), (125, "fail"), (85, "pass"), (70, "fail")):
            data = self.accepted()
            data["tables"][0]["rows"][0][3] = count
            self.assertEqual(self.judge(data)["judgement"]["past"]["verdict"], verdict, count)

    def test_values_of_rounding(self):
        def data(value):
            table = c.table("Rounding", [c.column("difference", "", past="rounding")], [[value]])
            return planted.sound(tables=[table])
        judge.accept(self.judge(data(1e-11)), self.past, False, "2000-01-01")
        for value, verdict in ((0.0, "pass"), (3e-13, "pass"), (5e-11, "pass"), (2e-10, "fail")):
            self.assertEqual(self.judge(data(value))["judgement"]["past"]["verdict"], verdict, value)

    def test_one_value_of_rounding_may_be_small_by_chance(self):
        def data(one, other):
            columns = [c.column("time", "", key=True), c.column("operator", "", key=True), c.column("difference", "", past="rounding")]
            rows = [[0.1, "dense", 2e-12], [1.0, "dense", one], [0.1, "iterated", 3e-10], [1.0, "iterated", other]]
            return planted.sound(tables=[c.table("Rounding", columns, rows)])
        judge.accept(self.judge(data(6e-16, 1e-13)), self.past, False, "2000-01-01")
        for one, other, verdict in ((2e-11, 3e-9, "pass"), (2.1e-11, 1e-13, "fail"), (6e-16, 3.1e-9, "fail")):
            self.assertEqual(self.judge(data(one, other))["judgement"]["past"]["verdict"], verdict, (one, other))

    def test_a_column_or_row_that_is_gone(self):
        data = self.accepted()
        data["tables"][0]["columns"][1]["name"] = "other"
        self.fails(data, "missing", "error")
        data = self.accepted()
        del data["tables"][0]["rows"][0]
        self.fails(data, "missing")

    def test_what_a_cap_on_the_time_cut_off(self):
        def data(value, **more):
            table = c.table("Counts", [c.column("method", key=True), c.column("count", optional=True, past="count", **more)], [["a", 7], ["b", value]])
            return planted.sound(tables=[table])
        judge.accept(self.judge(data(20, capped=True)), self.past, False, "2000-01-01")
        for value, verdict in ((20, "pass"), (None, "pass"), (40, "fail")):
            self.assertEqual(self.judge(data(value, capped=True))["judgement"]["past"]["verdict"], verdict, value)
        self.fails(data(None), "missing")

    def test_new_rows_and_columns_are_no_difference(self):
        data = self.accepted()
        data["tables"][0]["rows"].append([0.025, 3.0 * 0.025**2, 2.0, 104, 0])
        self.assertEqual(self.judge(data)["judgement"]["past"]["verdict"], "pass")

    def test_free_columns(self):
        data = self.accepted()
        data["tables"][0]["rows"][1][2] = 17.0
        self.assertEqual(self.judge(data)["judgement"]["past"]["verdict"], "pass")

    def test_quick_and_full_are_apart(self):
        self.accepted()
        self.assertEqual(judge.judge(planted.sound(), self.past, quick=True)["judgement"]["past"]["verdict"], "new")


class Sound(unittest.TestCase):
    def invalid(self, data, *words):
        with self.assertRaises(schema.Invalid) as caught:
            schema.check(data)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def data(self):
        return judge.judge(planted.sound(), pathlib.Path("/nonexistent"), quick=False)

    def test_nan(self):
        for value in (math.nan, math.inf):
            data = self.data()
            data["tables"][0]["rows"][1][1] = value
            self.invalid(data, "Levels", "row 1", "error")
            data = self.data()
            data["checks"][0]["value"] = value
            self.invalid(data, "error at the finest level")
            data = self.data()
            data["figures"][0]["value"] = value
            self.invalid(data, "bar_error")
            data = self.data()
            data["plots"][0]["series"][0]["y"][0] = value
            self.invalid(data, "Error")
            data = self.data()
            data["orders"][0]["fitted"] = value
            self.invalid(data, "order of error")

    def test_holes(self):
        data = self.data()
        data["tables"][0]["rows"][1][1] = None
        self.invalid(data, "not optional")
        data["tables"][0]["columns"][1]["optional"] = True
        schema.check(data)

    def test_missing_column(self):
        data = self.data()
        del data["tables"][0]["rows"][1][1]
        self.invalid(data, "row 1", "4 cells for 5 columns")
        with self.assertRaises(c.Failed) as caught:
            c.Rows({"table": "balance", "columns": ["a"], "rows": [[1.0]]}).column("b")
        self.assertIn('no column "b"', str(caught.exception))

    def test_ledger(self):
        analysis = {"stored_bulk": [0.0, 3.0, 2.0], "stored_interface": [0.0, 0.5, 0.5], "dissipated": [0.0, 0.0, 1.25],
                 "work": [0.0, 3.5, 3.75], "lower": [0.0, 3.0, 0.2], "increment": [0.0, 3.5, 0.25],
                 "upper": [0.0, 4.0, 0.3], "increment_lower": [0.0, 3.5, 0.25]}

        def row(**changed):
            of = c.ledger_of({"one": {**analysis, **changed}}, "J/m")
            schema.check({**self.data(), "ledger": of})
            self.assertEqual({x["unit"] for x in of["columns"][1:-1]}, {"J/m"})
            return dict(zip((x["name"] for x in of["columns"]), of["rows"][0]))

        self.assertEqual(row()["defect"], 0.0)
        self.assertEqual(row()["beyond a bound"], 0)
        # A wrong sign of the dissipated energy, and an increment beyond either bound.
        self.assertEqual(row(dissipated=[0.0, 0.0, -1.25])["defect"], -2.5)
        self.assertEqual(row(increment=[0.0, 3.5, 0.31])["beyond a bound"], 1)
        self.assertEqual(row(increment_lower=[0.0, 2.9, 0.19])["beyond a bound"], 2)
        for empty in (" ", {**c.ledger_of({"one": analysis}, "J/m"), "rows": []}):
            self.invalid({**self.data(), "ledger": empty}, "ledger")
        schema.check({**self.data(), "ledger": "None: nothing is analysed."})

    def test_missing_keys(self):
        for key in self.data():
            if key in ("refused",):
                continue
            data = copy.deepcopy(self.data())
            del data[key]
            self.invalid(data)

    def test_a_verdict_that_does_not_fit_its_status(self):
        data = self.data()
        data["judgement"]["reference"]["verdict"] = "fail"
        self.invalid(data, "passed")
        self.invalid({**self.data(), "status": "skipped"}, "without a reason")
        self.invalid({**self.data(), "status": "fine"}, "fine")

    def test_reference_needs_a_kind_and_an_uncertainty(self):
        data = self.data()
        data["reference"]["kind"] = "trust me"
        self.invalid(data, "trust me")
        data = self.data()
        data["reference"]["uncertainty"] = ""
        self.invalid(data, "uncertainty")

    def test_programs_words_for_no_number(self):
        self.assertEqual([c.number(v) for v in ("nan", "-", 1.0, "quad4", "none", "")], [None, None, 1.0, "quad4", "none", ""])
        with self.assertRaises(c.Failed):
            c.largest([None, "x"])


if __name__ == "__main__":
    unittest.main()
