# SPDX-License-Identifier: BSD-3-Clause
"""The raw layer is what the generator makes of the header, and what the loaded functions are given."""
import pathlib
import re
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "tools"), str(HERE)]

import check_raw  # noqa: E402
import generate_raw  # noqa: E402
import support  # noqa: E402


class Generated(unittest.TestCase):
    def test_regenerating_gives_the_committed_file(self):
        text = generate_raw.python_text(generate_raw.public_header.read(generate_raw.HEADER))
        self.assertEqual(text, check_raw.RAW.read_text(encoding="utf-8"),
                         "run bindings/python/tools/generate_raw.py --out bindings/python/src/delam/_base/raw.py")


class Bound(unittest.TestCase):
    def test_functions_have_the_types(self):
        from delam._base import raw
        from delam._base.library import library
        for name, (result, arguments) in raw.FUNCTIONS.items():
            function = getattr(library, name)
            self.assertIs(function.restype, result, name)
            self.assertEqual(function.argtypes, [kind for _, kind in arguments], name)

    def test_the_package_reaches_every_function(self):
        from delam._base import raw
        sources = [path.read_text(encoding="utf-8") for path in check_raw.RAW.parents[1].rglob("*.py")
                   if path != check_raw.RAW]
        for name in raw.FUNCTIONS:
            self.assertTrue(any(re.search(rf"\b{name}\b", text) for text in sources), name)

    def test_a_library_that_lacks_functions_is_told(self):
        from delam._base import raw

        class Empty:
            pass

        self.assertEqual(raw.bind(Empty()), list(raw.FUNCTIONS))


if __name__ == "__main__":
    support.main()
