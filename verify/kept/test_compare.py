# SPDX-License-Identifier: BSD-3-Clause
"""The comparison itself: planted differences are found, a named change passes, and each entry of changes.json is of
kept data."""
import copy
import json
import re
import unittest

import changes
import compare
import support
from support import MADE, read

KEPT = read(MADE[0] / "results" / "mixed" / "history.csv")
SENTENCE = "The mode mixity of a front is that of the end of its step."


def changed(row, column, change, text=KEPT):
    """The text of the table with another number in one place."""
    found = compare.table(text)
    at = found.titles.index(column)
    found.rows[row][at] = change(found.rows[row][at])
    return written(found)


def written(found):
    return "\n".join(",".join(row) for row in [found.titles, *found.rows])


def with_digit(text, digit):
    """Another digit, counted from the first."""
    at = [m.start() for m in re.finditer(r"\d", text)][digit - 1]
    return text[:at] + str((int(text[at]) + 5) % 10) + text[at + 1:]


def times(factor):
    return lambda text: f"{float(text) * factor:.17g}"


def columns(text):
    return [column for column, _ in compare.differences(compare.table(KEPT), compare.table(text))]


class Tables(unittest.TestCase):
    def test_equal(self):
        self.assertEqual(columns(KEPT), [])

    def test_digit(self):
        titles = compare.table(KEPT).titles
        for column in ("reaction", "work"):
            self.assertEqual(columns(changed(-1, column, lambda text: with_digit(text, 4))), [column])
            self.assertEqual(columns(changed(-1, column, lambda text: with_digit(text, 9))), [], "rounding is none")
        for column in ("time", "load", "stored_bulk", "dissipated", "crack_length", "energy_release_rate",
                       "front_mixity"):
            self.assertEqual(columns(changed(-1, column, times(1.001))), [column])
            self.assertEqual(columns(changed(-1, column, times(1 + 1e-8))), [], "rounding is none")
        for column in ("contact_pairs", "process_zone_pairs", "jumps", "backtracks"):
            self.assertEqual(columns(changed(-1, column, lambda text: str(int(text) + 1))), [column])
        self.assertEqual(columns(changed(-1, "mixity_rule", lambda _: "frozen")), ["mixity_rule"])
        self.assertEqual(columns(changed(-1, "reaction", lambda _: "nan")), ["reaction"])
        self.assertEqual(columns(changed(-1, "am_iterations", lambda text: str(int(text) + 1))), [], "costs may change")
        compared = [t for t in titles if t not in compare.COSTS]
        every = [t for t in compared if columns(changed(-1, t, lambda _: "12345678.9")) == [t]]
        self.assertEqual(every, compared, "every other column is compared")

    def test_rows(self):
        self.assertEqual(columns(KEPT.rsplit("\n", 2)[0]), ["rows"])

    def test_order(self):
        kept = compare.table(KEPT)

        def moved(titles):
            return compare.moved_columns(kept, compare.Table(titles, []))

        def swapped(k):
            return [*kept.titles[:k], kept.titles[k + 1], kept.titles[k], *kept.titles[k + 2:]]

        self.assertEqual(moved([*kept.titles, "new"]), [], "new columns come last")
        for k in range(len(kept.titles) - 1):
            self.assertIn(f"column {k + 1} was {kept.titles[k]}", moved(swapped(k))[0])
            self.assertIn("new ones come last", moved([*kept.titles[:k], "new", *kept.titles[k:]])[0])
        self.assertIn("is missing", moved(kept.titles[:-1])[0])
        self.assertIn("is now other", moved([*kept.titles[:-1], "other"])[0])


class Results(unittest.TestCase):
    def test_keys(self):
        kept = json.loads(read(MADE[0] / "results" / "mixed" / "result.json"))
        self.assertEqual((compare.lost_keys(kept, kept), compare.told_differences(kept, kept)), ([], []))
        for path in ("concept.mixity_rule", "options.path_step", "scene_content_hash", "unknowns.dual"):
            other, inner = copy.deepcopy(kept), None
            inner = other
            *folders, last = path.split(".")
            for key in folders:
                inner = inner[key]
            inner[last] = "another"
            self.assertEqual([d.column for d in compare.told_differences(kept, other)], [path])
            del inner[last]
            self.assertEqual(compare.lost_keys(kept, other), [path])


class Changes(unittest.TestCase):
    entry = {"made": MADE[0].name, "data": "scenes/mixed", "column": "front_mixity", "sentence": SENTENCE}
    differing = [compare.Difference("front_mixity", "row 3: 0.5 kept, 0.4 today")]

    def judged(self, found, listed, log):
        return " ".join(changes.judge(MADE[0].name, "scenes/mixed", found, listed, log))

    def test_verdict(self):
        log = "- " + SENTENCE.replace(" end", "\n  end") + "\n"
        self.assertEqual(self.judged([], [], log), "")
        self.assertEqual(self.judged(self.differing, [self.entry], log), "")
        self.assertIn("no entry of changes.json", self.judged(self.differing, [], log))
        self.assertIn("CHANGELOG.md does not say", self.judged(self.differing, [self.entry], "- Something else."))
        self.assertIn("remove its entry", self.judged([], [self.entry], log))
        for member, value in (("made", "another"), ("data", "scenes/space"), ("column", "reaction")):
            self.assertIn("no entry", self.judged(self.differing, [{**self.entry, member: value}], log))
        self.assertIn("does not say", self.judged(self.differing, [{**self.entry, "sentence": " "}], log), "too short")

    def test_entries(self):
        """Each entry has its members and belongs to data that a test reads."""
        data = {(made.name, part) for made in MADE for part in kept_parts(made)}
        for entry in changes.entries():
            self.assertEqual([member for member in entry if member != "tie"], changes.MEMBERS)
            self.assertIn((entry["made"], entry["data"]), data)
            self.assertTrue(changes.named(entry["sentence"], changes.changelog()), entry["sentence"])


def kept_parts(made):
    for scene in support.scenes(made):
        yield from (f"scenes/{scene.stem}{part}" for part in ("", "/jumps", "/result", "/fields"))
    yield from (f"interrupted/{path.name}" for path in (made / "interrupted").iterdir())
    for host in made.glob("hosts/*.c"):
        yield from (f"hosts/{host.stem}", f"hosts/{host.stem}/state")


class Folders(unittest.TestCase):
    def test_size(self):
        """Small enough for every clone."""
        for made in MADE:
            sizes = [path.stat().st_size for path in made.rglob("*") if path.is_file()]
            self.assertLess(sum(sizes), 1 << 20)
            self.assertLess(max(sizes), 300000)


if __name__ == "__main__":
    unittest.main()
