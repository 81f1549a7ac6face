# SPDX-License-Identifier: BSD-3-Clause
"""What chance may do: quantiles of Student's t, and errors of neighbours that are alike."""
import numpy as np

from command import loading


def student(level, freedom):
    """The factor on a standard error for an interval of this confidence, to either side."""
    with loading():
        from scipy.special import stdtrit  # here, for not every command needs it
    return float(stdtrit(max(freedom, 1), 0.5 + 0.5 * level))


def correlated(residual, starts):
    """By how much the variance of a mean of residuals is larger than that of independent ones: (1 + r) / (1 - r) for a
    correlation r of neighbours (Bayley, Hammersley, J. R. Stat. Soc. Suppl. 8, 1946), 1 where r may be chance. starts:
    where each curve begins."""
    pairs = np.ones(max(len(residual) - 1, 0), dtype=bool)
    pairs[[k - 1 for k in starts if k > 0]] = False
    square = residual @ residual
    if not square > 0 or not pairs.any():
        return 1.0
    r = min(0.95, np.sum((residual[:-1] * residual[1:])[pairs]) / square)
    return (1 + r) / (1 - r) if r > 2 / np.sqrt(len(residual)) else 1.0
