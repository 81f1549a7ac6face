# SPDX-License-Identifier: BSD-3-Clause
"""A strip on a foot that is held: two layers, glued but for a notch at the left end, where loads lift the upper one."""

HEAD = """
schema = 1
[geometry]
dimension = 2
length = 0.03
divisions = 60
[[materials]]
name = "arm"
young = 70e9
poisson = 0.3
[[layers]]
name = "lower"
thickness = 0.001
divisions = 2
material = "arm"
[[layers]]
name = "upper"
thickness = 0.001
divisions = 2
material = "arm"
"""
FOOT = """
[[interfaces]]
lower = "lower"
upper = "upper"
law = "glue"
notch = [{ from = 0.0, to = 0.0055 }]
[[supports]]
box = { lower = [0.0, 0.0], upper = [0.03, 0.0] }
fix = ["x", "y"]
"""


def strip(law, loads, more):
    """A scene; law: the keys of the law "glue", loads: patterns and loads, more: the other tables."""
    return f"{HEAD}[[laws]]\nname = \"glue\"\n{law}{FOOT}{loads}{more}"
