# SPDX-License-Identifier: BSD-3-Clause
"""The raw layer agrees with what clang reads in the header, and planted mistakes are found."""
import pathlib
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "tools"), str(HERE)]

import check_raw  # noqa: E402
import support  # noqa: E402


class AgainstClang(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        clang = check_raw.find_clang()
        if clang is None:
            raise unittest.SkipTest("clang is not installed")
        cls.header = check_raw.read_header(clang, check_raw.HEADER)
        cls.text = check_raw.RAW.read_text(encoding="utf-8")

    def differences(self, text):
        return check_raw.compare(check_raw.load(text), self.header)

    def test_the_committed_file_agrees(self):
        self.assertEqual(self.differences(self.text), [])
        self.assertGreater(len(self.header[0]), 90)

    def test_planted_mistakes_are_found(self):
        for what, old, new, words in (
                ("a changed type", '("body_a", c_int32)', '("body_a", c_int64)', "body_a"),
                ("a lost pointer", '("node_count", POINTER(c_int64))', '("node_count", c_int64)', "node_count"),
                ("another handle", '"delam_law_check": (c_int32, (("law", POINTER(delam_law)),)',
                 '"delam_law_check": (c_int32, (("law", POINTER(delam_mesh)),)', "delam_law_check"),
                ("a dropped argument", '("dissipated", POINTER(c_double)), ', "", "delam_solver_jump: takes"),
                ("exchanged arguments", '("young", c_double), ("poisson", c_double)',
                 '("poisson", c_double), ("young", c_double)', "'young', here 'poisson'"),
                ("a renamed function", '"delam_solver_commit"', '"delam_solver_comit"', "delam_solver_comit"),
                ("a changed result", '"delam_version": (c_char_p', '"delam_version": (c_void_p',
                 "delam_version: returns"),
                ("an int for int64_t", '"delam_option_count": (c_int64', '"delam_option_count": (c_int32',
                 "option_count"),
                ("a changed callback", "CFUNCTYPE(None, c_int32, c_char_p, c_void_p)",
                 "CFUNCTYPE(None, c_int64, c_char_p, c_void_p)", "delam_log_callback"),
                ("a changed constant", "DELAM_LIMIT = 3", "DELAM_LIMIT = 4", "DELAM_LIMIT"),
                ("a lost constant", "DELAM_HEX20 = 9\n", "", "DELAM_HEX20"),
                ("text for handles", '("subject", POINTER(c_char_p))', '("subject", c_char_p)', "subject")):
            with self.subTest(what):
                self.assertTrue(old in self.text, f"{old} is not in raw.py any more: give another example")
                found = self.differences(self.text.replace(old, new, 1))
                self.assertTrue(any(words in line for line in found), f"{what} passed: {found}")


if __name__ == "__main__":
    support.main()
