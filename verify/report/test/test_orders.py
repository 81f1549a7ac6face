# SPDX-License-Identifier: BSD-3-Clause
import math
import random
import unittest

import planted  # noqa: F401  (the path)
import orders


class Orders(unittest.TestCase):
    def test_data_of_known_order_are_fitted_to_it(self):
        sizes = [0.3, 0.2, 0.1, 0.04, 0.01]
        for p in (0.5, 1.0, 2.0, 3.0, 4.5):
            self.assertAlmostEqual(orders.fit(sizes, [7.0 * h**p for h in sizes]), p, places=12)

    def test_noise_moves_the_order_little(self):
        generator = random.Random(3)
        sizes = [2.0**-i for i in range(8)]
        errors = [h**2 * (1.0 + 0.05 * generator.uniform(-1, 1)) for h in sizes]
        self.assertAlmostEqual(orders.fit(sizes, errors), 2.0, delta=0.05)

    def test_growing_errors_have_a_negative_order(self):
        self.assertAlmostEqual(orders.fit([0.2, 0.1], [1.0, 2.0]), -1.0, places=12)

    def test_no_order_without_data(self):
        for sizes, errors in (([0.1], [1.0]), ([0.1, 0.1], [1.0, 2.0]), ([0.2, 0.1], [1.0, 0.0]), ([0.2, 0.1], [1.0, -1.0]),
                              ([0.2, 0.1], [1.0, math.nan]), ([0.2, 0.1], [1.0]), ([0.2, -0.1], [1.0, 1.0])):
            with self.assertRaises(ValueError):
                orders.fit(sizes, errors)

    def test_order_of_values_at_uneven_ratios(self):
        sizes = [0.3, 0.2, 0.07]
        for p in (0.5, 1.0, 2.0, 3.0):
            values = [5.0 - 2.0 * h**p for h in sizes]
            found = orders.observed(sizes, values)
            self.assertAlmostEqual(found, p, places=6)
            limit, step = orders.richardson(sizes, values, found)
            self.assertAlmostEqual(limit, 5.0, places=8)
            self.assertAlmostEqual(step, abs(5.0 - values[-1]), places=8)

    def test_oscillating_values_have_no_order(self):
        self.assertIsNone(orders.observed([0.4, 0.2, 0.1], [1.0, 2.0, 1.5]))
        self.assertIsNone(orders.observed([0.4, 0.2], [1.0, 2.0]))
        self.assertIsNone(orders.observed([0.4, 0.2, 0.1], [1.0, 2.0, 2.0]))

    def test_rates_and_floor(self):
        sizes = [0.4, 0.2, 0.1, 0.05]
        self.assertEqual(orders.rates(sizes, [1.6, 0.4, 0.1, 0.0])[0], None)
        self.assertAlmostEqual(orders.rates(sizes, [1.6, 0.4, 0.1, 0.0])[2], 2.0, places=12)
        self.assertIsNone(orders.rates(sizes, [1.6, 0.4, 0.1, 0.0])[3])
        self.assertEqual(orders.above_floor(sizes, [1.6, 0.4, 1e-13, 2e-12], 1e-12), ([0.4, 0.2], [1.6, 0.4]))


if __name__ == "__main__":
    unittest.main()
