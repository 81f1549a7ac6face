# SPDX-License-Identifier: BSD-3-Clause
"""Meshes, fields and histories in the forms of other packages, each of which is imported when a call needs it."""
