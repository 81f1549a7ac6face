# SPDX-License-Identifier: BSD-3-Clause
"""Closed forms and small independent evaluations, which share nothing with the library. Stresses and strains in the
order xx, yy, zz, xy, yz, zx, shear strains doubled."""
import math

PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))  # of the six components


def solve(matrix, right):
    """By elimination with pivots; right: a vector."""
    n = len(right)
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[p] = rows[p], rows[k]
        for i in range(k + 1, n):
            f = rows[i][k] / rows[k][k]
            if f:
                for j in range(k, n + 1):
                    rows[i][j] -= f * rows[k][j]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return x


def inverse(matrix):
    n = len(matrix)
    columns = [solve(matrix, [float(i == k) for i in range(n)]) for k in range(n)]
    return [[columns[j][i] for j in range(n)] for i in range(n)]


def times(matrix, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in matrix]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(vector):
    length = math.sqrt(dot(vector, vector))
    return [c / length for c in vector]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


# ---- elasticity ----
def orthotropic(e1, e2, e3, nu12, nu13, nu23, g12, g13, g23):
    """Stiffness [6][6] in material axes, the inverse of the compliance."""
    compliance = [[0.0] * 6 for _ in range(6)]
    compliance[0][0], compliance[1][1], compliance[2][2] = 1 / e1, 1 / e2, 1 / e3
    compliance[0][1] = compliance[1][0] = -nu12 / e1
    compliance[0][2] = compliance[2][0] = -nu13 / e1
    compliance[1][2] = compliance[2][1] = -nu23 / e2
    compliance[3][3], compliance[4][4], compliance[5][5] = 1 / g12, 1 / g23, 1 / g13
    return inverse(compliance)


def isotropic(young, poisson):
    return orthotropic(*[young] * 3, *[poisson] * 3, *[young / (2 * (1 + poisson))] * 3)


def tensor(six, doubled):
    full = [[0.0] * 3 for _ in range(3)]
    for value, (i, j) in zip(six, PAIRS):
        full[i][j] = full[j][i] = value / 2 if doubled and i != j else value
    return full


def six_of(full, doubled):
    return [full[i][j] * (2 if doubled and i != j else 1) for i, j in PAIRS]


def turned(full, axes):
    """The components along `axes` (rows)."""
    return [[sum(axes[a][i] * full[i][j] * axes[b][j] for i in range(3) for j in range(3)) for b in range(3)]
            for a in range(3)]


def transposed(matrix):
    return [list(column) for column in zip(*matrix)]


def stress(stiffness, strain, axes=None):
    """In space, of a strain in space; the stiffness is that in `axes` (rows)."""
    if axes is None:
        return times(stiffness, strain)
    inside = six_of(turned(tensor(strain, True), axes), True)
    return six_of(turned(tensor(times(stiffness, inside), False), transposed(axes)), False)


def axes_of(first, second):
    one = unit(first)
    two = unit([s - dot(second, one) * o for s, o in zip(second, one)])
    return [one, two, cross(one, two)]


def strain_of(gradient):
    """Six components, of a displacement gradient [3][3], d u_i / d x_j."""
    full = [[(gradient[i][j] + gradient[j][i]) / 2 for j in range(3)] for i in range(3)]
    return six_of(full, True)


def quad4_stiffness(width, height, stiffness):
    """The stiffness of a rectangle with corners counter-clockwise from the lower left, DOFs 2 corner + component, by 2 x 2 Gauss
    points; stiffness: [3][3] in xx, yy, xy."""
    total = [[0.0] * 8 for _ in range(8)]
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    for x in (-1, 1):
        for y in (-1, 1):
            x0, y0 = x / math.sqrt(3), y / math.sqrt(3)
            b = [[0.0] * 8 for _ in range(3)]
            for i, (a, c) in enumerate(corners):
                dx, dy = a * (1 + c * y0) / 4 * 2 / width, c * (1 + a * x0) / 4 * 2 / height
                b[0][2 * i], b[1][2 * i + 1], b[2][2 * i], b[2][2 * i + 1] = dx, dy, dy, dx
            for i in range(8):
                for j in range(8):
                    total[i][j] += width * height / 4 * sum(b[r][i] * stiffness[r][s] * b[s][j]
                                                            for r in range(3) for s in range(3))
    return total


# ---- laws ----
def toughness(normal, tangential, mixity, first=2.0, second=2.0):
    """Valoroso and Champaney: G of ((1-B) G/G_n)^p + (B G/G_t)^q = 1, by bisection unless p = q."""
    if first == second:
        return (((1 - mixity) / normal) ** first + (mixity / tangential) ** first) ** (-1 / first)
    low, high = 0.0, 1e3 * max(normal, tangential)
    for _ in range(60):
        middle = 0.5 * (low + high)
        if ((1 - mixity) * middle / normal) ** first + (mixity * middle / tangential) ** second > 1:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


def bilinear(onset, total, driving):
    """Adhesion on first loading: zeta Y + g is least, g = total onset (1 - zeta) / (onset + (total - onset) zeta)."""
    if driving <= onset:
        return 1.0
    return max(0.0, (total * math.sqrt(onset / driving) - onset) / (total - onset))


def bilinear_dissipated(onset, total, zeta):
    return total * onset * (1 - zeta) / (onset + (total - onset) * zeta)


def numbers(count, seed=1, low=-1.0, high=1.0):
    """That equal no others: of a small generator, the same everywhere."""
    found, state = [], seed * 2654435761 % 2**32
    for _ in range(count):
        state = (1664525 * state + 1013904223) % 2**32
        found.append(low + (high - low) * state / 2**32)
    return found
