# SPDX-License-Identifier: BSD-3-Clause
"""What is possible for a laminate: of numbers that `delam new` is given, and of those that a test has."""

# J/m2: a tenth of the least and ten times of the largest that are usual, so that an odd material is not told and a factor of
# 1000 always is.
TOUGHNESS = (10, 2e4)

# Specimens usually have these lengths and this modulus, mm and GPa.
ARM, WIDTH, LENGTH, E1 = (0.4, 20), (5, 100), (10, 300), (10, 600)
