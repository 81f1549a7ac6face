# SPDX-License-Identifier: BSD-3-Clause
"""Kept results are read: `run --resume` finds each complete and of its scene, `view` makes a page of the one that has
its fields, and these are today's."""
import os
import pathlib
import shutil
import tempfile
import unittest

import h5py
import numpy as np

import changes
import support
from compare import FRONT_TOLERANCE, Difference
from support import MADE, scenes

DELAM = os.environ["DELAM"]


def datasets(path):
    """Arrays of a file of fields by their paths. Fields of pairs depend, like fronts, on few pairs."""
    out = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: out.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return out


def unlike(kept, found):
    if kept.shape != found.shape:
        return f"shape {kept.shape} kept, {found.shape} today"
    if not np.issubdtype(kept.dtype, np.number):
        return None if np.array_equal(kept, found) else "another text"
    difference = float(np.abs(kept.astype(float) - found.astype(float)).max(initial=0.0))
    size = float(np.abs(kept).max(initial=0.0))
    return None if difference <= FRONT_TOLERANCE * size else f"differs by {difference:g}, largest {size:g}"


class Results(support.Kept):
    def test_complete(self):
        for made in MADE:
            for scene in scenes(made):
                with (self.subTest(made=made.name, scene=scene.stem),
                      tempfile.TemporaryDirectory(dir=support.MEMORY) as name):
                    out = pathlib.Path(name) / "result"
                    shutil.copytree(made / "results" / scene.stem, out)
                    code, said, error = support.run([DELAM, "run", scene, "--out", out, "--resume"])
                    named = changes.of(made.name, f"scenes/{scene.stem}/result", changes.entries())
                    if "scene_content_hash" in named:  # a file that makes another scene today
                        self.assertEqual((code, "not the one of the result" in error), (2, True), said + error)
                    else:
                        self.assertEqual((code, "complete already" in said), (0, True), said + error)

    def test_view(self):
        for fields in (path for made in MADE for path in made.glob("results/*/fields.h5")):
            with self.subTest(fields=fields), tempfile.TemporaryDirectory() as name:
                page = pathlib.Path(name) / "page.html"
                code, _, error = support.run([DELAM, "view", fields.parent, "--out", page])
                self.assertEqual(code, 0, error)
                self.assertGreater(page.stat().st_size, fields.stat().st_size // 4)

    def test_fields(self):
        for made in MADE:
            for fields in made.glob("results/*/fields.h5"):
                scene = next(path for path in scenes(made) if path.stem == fields.parent.name)
                with self.subTest(fields=fields), tempfile.TemporaryDirectory() as out:
                    code, _, error = support.run([DELAM, "run", scene, "--out", out])
                    self.assertEqual(code, 0, error)
                    kept, found = datasets(fields), datasets(pathlib.Path(out) / "fields.h5")
                    self.assertEqual(kept.keys() - found.keys(), set(), "lost")
                    texts = {key: unlike(kept[key], found[key]) for key in kept}
                    self.expect_named(made, f"scenes/{scene.stem}/fields",
                                      [Difference(key, text) for key, text in texts.items() if text])


if __name__ == "__main__":
    unittest.main()
