# SPDX-License-Identifier: BSD-3-Clause
"""RESULTS.md and the top README quote what the report measured, digit by digit."""
import json
import unittest

import planted
import readme
import schema  # noqa: F401  (the path)
import words


def report():
    good = planted.sound(status="passed")
    return {"date": "2000-01-01 00:00 UTC", "command": "bash verify/run.sh --report", "commit": "abc", "machine": {"processor": "P", "cores": 2},
            "cases": [good]}


def told():
    """Sentences as a full report gives them, each with the same figure."""
    data = {**report(), "quick": False}
    values = {f: 2.5 for _, words in readme.SENTENCES.values() for _, f, _, _ in readme.string.Formatter().parse(words) if f}
    data["cases"][0]["figures"] += [{"name": n, "value": v, "unit": "", "text": "t"} for n, v in values.items()]
    return readme.sentences(data)


def page(head, speed=None):
    """A page that has everything that headline.json has."""
    table = f"{readme.SPEED_BEGIN}\n{readme.BY_HAND}\n{readme.SPEED_END}" if speed is None else readme.speed_block(speed)
    return "\n".join([readme.block(head), table, *(readme.sentence_block(n, t) for n, t in head["sentences"].items())])


class Readme(unittest.TestCase):
    def head(self):
        return {**readme.gather(report(), ["bar_error"], []), "sentences": told()}

    def test_the_block_is_made_of_the_figures(self):
        block = readme.block(self.head())
        self.assertIn("| Error of the bar | 0.0075 m | t-one |", block)
        self.assertIn("1 passed, 0 failed", block)
        self.assertIn("2000-01-01 00:00 UTC", block)
        self.assertIn("bash verify/run.sh --report", block)
        self.assertEqual(readme.differences(f"text\n{page(self.head())}\nmore", self.head(), readme.ROOT), [])

    def test_a_changed_figure_is_seen(self):
        text = readme.block(self.head()).replace("0.0075", "0.0057")
        self.assertTrue(any("0.0057" in line for line in readme.differences(text, self.head(), readme.ROOT)))

    def test_an_added_figure_is_seen(self):
        text = readme.block(self.head()).replace(readme.END, "| Speed | 1000 | t-two |\n" + readme.END)
        self.assertTrue(readme.differences(text, self.head(), readme.ROOT))

    def test_a_missing_picture_is_seen(self):
        head = {**self.head(), "pictures": [{"file": "verify/report/pictures/none.svg", "title": "t", "caption": "c", "case": "t-one", "plot": 0}]}
        self.assertTrue(any("none.svg is missing" in line for line in readme.differences(readme.block(head), head, readme.ROOT)))

    def test_figures_of_failed_cases_are_refused(self):
        bad = report()
        bad["cases"][0]["status"] = "failed"
        with self.assertRaises(readme.Refused):
            readme.gather(bad, ["bar_error"], [])
        with self.assertRaises(readme.Refused):
            readme.gather(report(), ["no_such_figure"], [])
        with self.assertRaises(readme.Refused):
            readme.gather(report(), ["bar_error"], [("t-one", 4)])

    def test_sentences_have_the_figures(self):
        data = {**report(), "quick": False}
        values = {f: 2.5 for _, words in readme.SENTENCES.values() for _, f, _, _ in readme.string.Formatter().parse(words) if f}
        data["cases"][0]["figures"] += [{"name": n, "value": v, "unit": "", "text": "t"} for n, v in values.items()]
        told = readme.sentences(data)
        self.assertEqual(set(told), set(readme.SENTENCES))
        self.assertEqual(set(readme.sentences({**data, "quick": True})), {n for n, (full, _) in readme.SENTENCES.items() if not full})
        head = {**self.head(), "sentences": told}
        text = page(head)
        self.assertEqual(readme.differences(text, head, readme.ROOT), [])
        self.assertTrue(readme.differences(text.replace("2.50 mm (local)", "2.40 mm (local)"), head, readme.ROOT))
        data["cases"][0]["status"] = "failed"
        self.assertEqual(readme.sentences(data), {})

    def timed(self):
        data = report()
        data["cases"][0]["figures"] = [{"name": f"speed_{scene}_{key}", "value": 7.321, "unit": "", "text": "t"} for _, scene in readme.SPEED
                                       for _, key, _ in readme.SPEED_COLUMNS]
        data["cases"][0]["figures"] += [{"name": f"speed_{scene}_noise", "value": 0.03, "unit": "", "text": "t"} for _, scene in readme.SPEED]
        return data

    def test_the_table_of_speed_is_of_one_report(self):
        table = readme.speed(self.timed())
        block = readme.speed_block(table)
        self.assertIn("| 0.5 mm | 7.3 | 7.3 s | 7.3 | 7.3 times | 7.3 times |", block)
        for word in ("2000-01-01 00:00 UTC", "commit abc", "--only t-one", "P, 2 cores", "3 % at most"):
            self.assertIn(word, block)
        loss = self.timed()
        loss["cases"][0]["losses"] = ["it is slow"]
        block = readme.speed_block(readme.speed(loss))
        self.assertLess(block.index("it is slow"), block.index("| cells |"))
        self.assertIsNone(readme.speed({**self.timed(), "quick": True}))
        for lost in (0, -1):
            short = self.timed()
            short["cases"][0]["figures"].pop(lost)
            self.assertIsNone(readme.speed(short))
        busy = self.timed()
        busy["cases"][0]["figures"][-1]["value"] = 0.5
        self.assertIsNone(readme.speed(busy))
        failed = self.timed()
        failed["cases"][0]["status"] = "failed"
        self.assertIsNone(readme.speed(failed))

    def test_a_report_of_some_cases_leaves_the_block(self):
        self.assertFalse(readme.of_some_cases(report()))
        some = report()
        some["cases"].append({"status": "skipped", "reason": words.LEFT_OUT})
        self.assertTrue(readme.of_some_cases(some))
        some["cases"][-1]["reason"] = "GetFEM is not installed"
        self.assertFalse(readme.of_some_cases(some))

    def test_a_changed_speed_is_seen(self):
        head = {**self.head(), "speed": readme.speed(self.timed())}
        text = page(head, head["speed"])
        self.assertEqual(readme.differences(text, head, readme.ROOT), [])
        self.assertTrue(readme.differences(text.replace("7.3 s", "3.7 s"), head, readme.ROOT))
        self.assertTrue(readme.differences(readme.block(head), head, readme.ROOT))

    def test_removed_markers_and_sentences_are_seen(self):
        for head in (self.head(), {**self.head(), "speed": readme.speed(self.timed())}):
            text = page(head, head.get("speed"))
            self.assertEqual(readme.differences(text, head, readme.ROOT), [])
            marks = [(readme.SPEED_BEGIN, readme.SPEED_END), *map(readme.sentence_marks, readme.SENTENCES)]
            for pair in marks:
                for mark in pair:
                    self.assertTrue(any(mark in line for line in readme.differences(text.replace(mark, ""), head, readme.ROOT)), mark)
                begin, end = (text.index(mark) for mark in pair)
                self.assertTrue(readme.differences(text[:begin] + text[end + len(pair[1]):], head, readme.ROOT), pair[0])
            # Nor does it help to take them from headline.json as well.
            for name in readme.SENTENCES:
                short = {**head, "sentences": {n: t for n, t in head["sentences"].items() if n != name}}
                self.assertTrue(any(name in line for line in readme.differences(text, short, readme.ROOT)))

    def test_a_table_by_hand_says_so(self):
        text = page(self.head())
        self.assertTrue(readme.differences(text.replace(readme.BY_HAND, "| 0.5 mm | 7.3 |"), self.head(), readme.ROOT))

    def test_dates_are_of_the_cases(self):
        data = report()
        data["cases"][0]["date"] = "1999-12-31 10:00 UTC"
        head = readme.gather({**data, "command": "bash verify/run.sh --report --only t-two"}, ["bar_error"], [])
        self.assertEqual((head["date"], head["command"]), ("1999-12-31 10:00 UTC", "bash verify/run.sh --report"))

    def test_readme_without_markers(self):
        self.assertTrue(readme.differences("nothing", self.head(), readme.ROOT))

    def test_the_summary_has_the_counts(self):
        block = readme.summary_block(self.head())
        for word in ("2000-01-01", "commit abc", "1 passed, 0 failed", "verify/report/RESULTS.md"):
            self.assertIn(word, block)
        self.assertEqual(readme.top_differences(f"text\n{block}\nmore", self.head()), [])
        self.assertTrue(readme.top_differences(block.replace("1 passed", "2 passed"), self.head()))
        for mark in (readme.SUMMARY_BEGIN, readme.SUMMARY_END):
            self.assertTrue(any(mark in line for line in readme.top_differences(block.replace(mark, ""), self.head())), mark)

    def test_pictures_are_beside_the_page(self):
        head = {**self.head(), "pictures": [{"file": "verify/report/pictures/b.svg", "title": "t", "caption": "c", "case": "t-one", "plot": 0}]}
        self.assertIn("](pictures/b.svg)", readme.block(head))

    def test_the_pages_agree(self):
        head = json.loads((planted.REPORT / "headline.json").read_text(encoding="utf-8"))
        text = readme.PAGE.read_text(encoding="utf-8")
        self.assertEqual(readme.differences(text, head, readme.ROOT), [])
        self.assertEqual(readme.top_differences(readme.TOP.read_text(encoding="utf-8"), head), [])
        self.assertEqual([f["name"] for f in head["figures"]], readme.FIGURES)
        self.assertEqual([(p["case"], p["plot"]) for p in head["pictures"]], readme.PICTURES)


if __name__ == "__main__":
    unittest.main()
