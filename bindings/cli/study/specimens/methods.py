# SPDX-License-Identifier: BSD-3-Clause
"""Energy release rates of the standards, from load, displacement and crack length. All in SI; h is one arm, b the
width, L half of the span, c the lever.

A method that is calibrated returns the rate as a function of displacement, load and crack length, its numbers, and how far
each length lies off its line: what was misread, if all else is right."""
import numpy as np


def beam_offset(crack, compliance, sheet):
    """By how much the crack of a clamped arm is longer: where the line of the cube roots of the compliances meets the
    axis (ISO 15024; the modified beam theory of ASTM D5528). Not negative, unless its chance is asked for (OfMarks). And
    how far each length is off this line."""
    slope, at_zero = np.polyfit(crack, np.cbrt(compliance), 1)
    return max(sheet.get("least offset", 0.0), float(at_zero / slope)), crack - (np.cbrt(compliance) - at_zero) / slope


def large_displacement(displacement, crack):
    """The factor F of ISO 15024 for hinges without blocks."""
    return 1 - 0.3 * (displacement / crack) ** 2


def block_factor(displacement, crack, height, length):
    """The factor N of ISO 15024 for blocks: from the arm's middle to the pin, l1, and half of the block's length, l2."""
    share = length / crack
    return (1 - share ** 3 - 9 / 8 * (1 - share ** 2) * displacement * height / crack ** 2
            - 9 / 35 * (displacement / crack) ** 2)


def corrected_beam_theory(displacement, load, crack, sheet):
    """CBT of ISO 15024: (3 P d / 2 b (a + offset)) F / N."""
    pin, half_block = sheet.get("block-pin", 0.0), 0.5 * sheet.get("block-length", 0.0)
    blocks = pin > 0 or half_block > 0

    def stiffer(d, a):
        return block_factor(d, a, pin, half_block) if blocks else np.ones_like(a)

    offset, misread = beam_offset(crack, displacement / load / stiffer(displacement, crack), sheet)

    def rate(d, p, a):
        f = large_displacement(d, a) - 1.5 * d * pin / a ** 2
        return 1.5 * p * d / (sheet["width"] * (a + offset)) * f / stiffer(d, a)
    return rate, {"offset": offset}, misread


def modified_beam_theory(displacement, load, crack, sheet):
    """MBT of ASTM D5528: 3 P d / 2 b (a + offset)."""
    offset, misread = beam_offset(crack, displacement / load, sheet)
    return lambda d, p, a: 1.5 * p * d / (sheet["width"] * (a + offset)), {"offset": offset}, misread


def compliance_calibration(displacement, load, crack, sheet):
    """CC of ASTM D5528 (Berry): n P d / 2 b a, n the slope of log C over log a."""
    n, at_one = np.polyfit(np.log(crack), np.log(displacement / load), 1)
    misread = crack - np.exp((np.log(displacement / load) - at_one) / n)
    return lambda d, p, a: 0.5 * n * p * d / (sheet["width"] * a), {"n": float(n)}, misread


def modified_compliance_calibration(displacement, load, crack, sheet):
    """MCC of ASTM D5528: 3 P^2 C^(2/3) / 2 A1 b (2 h), A1 the slope of a / 2h over the cube root of C."""
    roots, whole = np.cbrt(displacement / load), 2 * sheet["arm"]
    a1, at_zero = np.polyfit(roots, crack / whole, 1)
    return (lambda d, p, a: 1.5 * p ** 2 * np.cbrt(d / p) ** 2 / (a1 * sheet["width"] * whole), {"A1": float(a1)},
            crack - whole * (a1 * roots + at_zero))


def chi(e1, e2, g13):
    """By how many arms the crack is longer because the arms rotate at its tip (ASTM D6671)."""
    gamma = 1.18 * np.sqrt(e1 * e2) / g13
    return float(np.sqrt(e1 / (11 * g13) * (3 - 2 * (gamma / (1 + gamma)) ** 2)))


def _bending_modulus(sheet, of_offset):
    """The modulus that the initial compliance has, of_offset(x) with a crack that is x arms longer, and this x. It follows
    from E1 where that is given, else from the modulus itself; without E2 and G13 it is 0."""
    if not {"E2", "G13"} <= sheet.keys():
        return of_offset(0.0), 0.0
    modulus = sheet.get("E1") or of_offset(0.0)
    # The offset depends on the root of the modulus and moves it by a tenth: each turn leaves a twentieth of the error.
    for _ in range(20):
        longer = chi(sheet.get("E1") or modulus, sheet["E2"], sheet["G13"])
        modulus = of_offset(longer)
    return modulus, longer


def dcb_modulus(first, sheet):
    """Of C = 8 (a + chi h)^3 / (b h^3 E) at the notch: E, and chi."""
    h = sheet["arm"]
    return _bending_modulus(sheet, lambda x: 8 * (sheet["notch"] + x * h) ** 3 / (sheet["width"] * h ** 3 * first))


def dcb_effective(first, sheet, offset=0.0):
    """Beam theory at the crack that the compliance has, the rotation at the tip included: G = P^2 a^2 / (b E I), with the
    bending stiffness of E1 if that is given, else of the initial compliance at the notch (de Moura, Morais, Dourado, Eng.
    Fract. Mech. 75, 2008). offset: by how much marks of the crack say that it is longer. Returns functions of
    displacement and load: the length of the crack, and the rate."""
    h, b = sheet["arm"], sheet["width"]
    modulus, longer = dcb_modulus(first, sheet)
    longer *= h
    if longer == 0 and offset > 0:
        longer, modulus = offset, 8 * (sheet["notch"] + offset) ** 3 / (b * h ** 3 * first)
    bending = sheet.get("E1", modulus) * b * h ** 3 / 12

    def effective(d, p):
        return np.cbrt(1.5 * bending * d / p)
    return lambda d, p: effective(d, p) - longer, lambda d, p: p ** 2 * effective(d, p) ** 2 / (b * bending)


def _sheared(sheet):
    """The compliance of the shear of a beam on two supports; 0 without G13."""
    return 0.15 * sheet["span"] / (sheet["G13"] * sheet["width"] * sheet["arm"]) if "G13" in sheet else 0.0


def enf_modulus(first, sheet):
    """Of C = (3 (a + 0.42 chi h)^3 + 2 L^3) / (8 b h^3 E) + 3 L / (10 b h G13) at the notch: E, and 0.42 chi."""
    half, h = 0.5 * sheet["span"], sheet["arm"]
    modulus, longer = _bending_modulus(sheet, lambda x: (3 * (sheet["notch"] + 0.42 * x * h) ** 3 + 2 * half ** 3) / (
        8 * sheet["width"] * h ** 3 * (first - _sheared(sheet))))
    return modulus, 0.42 * longer


def enf_effective(first, sheet):
    """The same for end-notched flexure, G = 9 a^2 P^2 / (16 b^2 h^3 E). E is that of the initial compliance:
    a^3 is a small difference of large numbers, which an error of E1 would upset. Without G13 it is E1, if that is given."""
    half, h, b = 0.5 * sheet["span"], sheet["arm"], sheet["width"]
    modulus, longer = enf_modulus(first, sheet)
    longer *= h
    if "G13" not in sheet:
        modulus = sheet.get("E1", modulus)

    def effective(d, p):
        cube = (8 * b * h ** 3 * modulus * (d / p - _sheared(sheet)) - 2 * half ** 3) / 3
        return np.cbrt(np.maximum(cube, 0.0))
    return (lambda d, p: effective(d, p) - longer,
            lambda d, p: 9 * effective(d, p) ** 2 * p ** 2 / (16 * b ** 2 * h ** 3 * modulus))


def enf_calibration(cracks, compliances):
    """C = A + m a^3 of the compliance calibration of ASTM D7905: A, m, and the standard error of m over m, from how far the
    compliances are off the line."""
    cubes = np.asarray(cracks) ** 3
    m, a = np.polyfit(cubes, compliances, 1)
    off = compliances - (a + m * cubes)
    error = np.sqrt(off @ off / max(len(cubes) - 2, 1) / np.sum((cubes - np.mean(cubes)) ** 2))
    return float(a), float(m), float(error / abs(m))


def enf_calibrated(load, m, sheet):
    """3 m P^2 a0^2 / 2 b of the compliance calibration of ASTM D7905."""
    return 1.5 * m * load ** 2 * sheet["notch"] ** 2 / sheet["width"]


def mmb_modulus(compliance, chi, sheet):
    """The bending modulus of ASTM D6671 from the compliance at the point of load."""
    half, lever, h, notch = 0.5 * sheet["span"], sheet["lever"], sheet["arm"], sheet["notch"]
    return ((8 * (notch + chi * h) ** 3 * (3 * lever - half) ** 2
             + (6 * (notch + 0.42 * chi * h) ** 3 + 4 * half ** 3) * (lever + half) ** 2)
            / (16 * half ** 2 * sheet["width"] * h ** 3 * compliance))


def mixed_mode_bending(load, crack, chi, modulus, sheet):
    """The rates of both modes of ASTM D6671."""
    half, lever, b, h = 0.5 * sheet["span"], sheet["lever"], sheet["width"], sheet["arm"]
    common = load ** 2 / (16 * b ** 2 * h ** 3 * half ** 2 * modulus)
    return (12 * common * (3 * lever - half) ** 2 * (crack + chi * h) ** 2,
            9 * common * (lever + half) ** 2 * (crack + 0.42 * chi * h) ** 2)


def mmb_effective(first, chi, sheet):
    """Both modes together at the crack that the compliance has, with the modulus that the initial compliance has once the
    shear of the beam is taken off, which the modulus of ASTM D6671 counts as bending. Returns functions of displacement and
    load: the length of the crack, and the rate."""
    half, lever = 0.5 * sheet["span"], sheet["lever"]
    shear = ((lever + half) / half) ** 2 * _sheared(sheet)
    modulus = mmb_modulus(first - shear, chi, sheet)

    def effective(d, p):
        wanted = np.maximum(d / p - shear, 1e-3 * first)
        low, high = np.zeros_like(wanted), np.full_like(wanted, 10 * half)
        for _ in range(50):
            middle = 0.5 * (low + high)
            longer = mmb_modulus(wanted, chi, {**sheet, "notch": middle}) < modulus
            low, high = np.where(longer, middle, low), np.where(longer, high, middle)
        return 0.5 * (low + high)
    return effective, lambda d, p: sum(mixed_mode_bending(p, effective(d, p), chi, modulus, sheet))
