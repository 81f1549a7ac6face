# SPDX-License-Identifier: BSD-3-Clause
"""The library as Python calls it, and what all modules share: errors, arrays, records, protocols of objects."""
