# SPDX-License-Identifier: BSD-3-Clause
"""Energy release rates of the standards, from load, displacement and crack length. All in SI; h is one arm, b the
width, L half of the span, c the lever."""
import numpy as np


def beam_offset(crack, compliance):
    """By how much the crack of a clamped arm is longer: where the line of the cube roots of the compliances meets the
    axis (ISO 15024, 10.2; ASTM D5528, 12.1.1). Not negative."""
    slope, at_zero = np.polyfit(crack, np.cbrt(compliance), 1)
    return max(0.0, float(at_zero / slope))


def large_displacement(displacement, crack):
    """The factor F of ISO 15024 for hinges without blocks."""
    return 1 - 0.3 * (displacement / crack) ** 2


def block_factor(displacement, crack, height, length):
    """The factor N of ISO 15024 for blocks: from the arm's middle to the pin, and half of the block's length."""
    share = length / crack
    return (1 - share ** 3 - 9 / 8 * (1 - share ** 2) * displacement * height / crack ** 2
            - 9 / 35 * (displacement / crack) ** 2)


def corrected_beam_theory(displacement, load, crack, sheet):
    """CBT of ISO 15024: (3 P d / 2 b (a + offset)) F / N."""
    blocks = sheet.get("block")
    n = block_factor(displacement, crack, *blocks) if blocks else np.ones_like(crack)
    f = large_displacement(displacement, crack)
    if blocks:
        f = f - 1.5 * displacement * blocks[0] / crack ** 2
    offset = beam_offset(crack, displacement / load / n)
    return 1.5 * load * displacement / (sheet["width"] * (crack + offset)) * f / n, {"offset": offset}


def modified_beam_theory(displacement, load, crack, sheet):
    """MBT of ASTM D5528: 3 P d / 2 b (a + offset)."""
    offset = beam_offset(crack, displacement / load)
    return 1.5 * load * displacement / (sheet["width"] * (crack + offset)), {"offset": offset}


def compliance_calibration(displacement, load, crack, sheet):
    """CC of ASTM D5528 (Berry): n P d / 2 b a, n the slope of log C over log a."""
    n = float(np.polyfit(np.log(crack), np.log(displacement / load), 1)[0])
    return 0.5 * n * load * displacement / (sheet["width"] * crack), {"n": n}


def modified_compliance_calibration(displacement, load, crack, sheet):
    """MCC of ASTM D5528: 3 P^2 C^(2/3) / 2 A1 b (2 h), A1 the slope of a / 2h over the cube root of C."""
    root = np.cbrt(displacement / load)
    a1 = float(np.polyfit(root, crack / (2 * sheet["arm"]), 1)[0])
    return 1.5 * load ** 2 * root ** 2 / (a1 * sheet["width"] * 2 * sheet["arm"]), {"A1": a1}


def dcb_effective_crack(compliance, first, sheet):
    """Lengths of the crack from the compliance, and the bending stiffness per arm: of E1 if it is given, else of the
    initial compliance at the notch (de Moura, Morais, Dourado, Eng. Fract. Mech. 75, 2008)."""
    if "E1" in sheet:
        bending = sheet["E1"] * sheet["width"] * sheet["arm"] ** 3 / 12
        return np.cbrt(1.5 * bending * compliance), bending
    return sheet["notch"] * np.cbrt(compliance / first), 2 * sheet["notch"] ** 3 / (3 * first)


def dcb_effective(displacement, load, first, sheet):
    """Beam theory at the crack that the compliance has: P^2 a^2 / (b E I). Lengths of the crack, and rates."""
    crack, bending = dcb_effective_crack(displacement / load, first, sheet)
    return crack, load ** 2 * crack ** 2 / (sheet["width"] * bending)


def enf_effective(displacement, load, first, sheet):
    """The same for end-notched flexure: C = (3 a^3 + 2 L^3) / (8 b h^3 E), G = 9 a^2 P^2 / (16 b^2 h^3 E)."""
    half, notch = 0.5 * sheet["span"], sheet["notch"]
    modulus = sheet.get("E1") or (3 * notch ** 3 + 2 * half ** 3) / (8 * sheet["width"] * sheet["arm"] ** 3 * first)
    cube = (8 * sheet["width"] * sheet["arm"] ** 3 * modulus * displacement / load - 2 * half ** 3) / 3
    crack = np.cbrt(np.maximum(cube, 0.0))
    return crack, 9 * crack ** 2 * load ** 2 / (16 * sheet["width"] ** 2 * sheet["arm"] ** 3 * modulus)


def enf_calibration(cracks, compliances):
    """C = A + m a^3 of ASTM D7905 (11.3): A, m."""
    m, a = np.polyfit(np.asarray(cracks) ** 3, compliances, 1)
    return float(a), float(m)


def enf_calibrated(load, m, sheet):
    """3 m P^2 a0^2 / 2 b of ASTM D7905 (11.5)."""
    return 1.5 * m * load ** 2 * sheet["notch"] ** 2 / sheet["width"]


def mmb_modulus(compliance, chi, sheet):
    """The bending modulus of ASTM D6671, eq. 8, from the compliance at the point of load."""
    half, lever, h, notch = 0.5 * sheet["span"], sheet["lever"], sheet["arm"], sheet["notch"]
    return ((8 * (notch + chi * h) ** 3 * (3 * lever - half) ** 2
             + (6 * (notch + 0.42 * chi * h) ** 3 + 4 * half ** 3) * (lever + half) ** 2)
            / (16 * half ** 2 * sheet["width"] * h ** 3 * compliance))


def crack_correction(sheet):
    """chi of ASTM D6671, eqs. 4 and 5; of E1, E2 and G13."""
    gamma = 1.18 * np.sqrt(sheet["E1"] * sheet["E2"]) / sheet["G13"]
    return float(np.sqrt(sheet["E1"] / (11 * sheet["G13"]) * (3 - 2 * (gamma / (1 + gamma)) ** 2)))


def mixed_mode_bending(load, crack, chi, modulus, sheet):
    """The rates of both modes of ASTM D6671, eqs. 9 and 10."""
    half, lever, b, h = 0.5 * sheet["span"], sheet["lever"], sheet["width"], sheet["arm"]
    common = load ** 2 / (16 * b ** 2 * h ** 3 * half ** 2 * modulus)
    return (12 * common * (3 * lever - half) ** 2 * (crack + chi * h) ** 2,
            9 * common * (lever + half) ** 2 * (crack + 0.42 * chi * h) ** 2)
