// SPDX-License-Identifier: BSD-3-Clause
// Mode mixity B = Y_t / (Y_n + Y_t) = psi^2/(1+psi^2) in [0,1], and the share S = Y_2/Y_t in [0,1] of the second shear
// in the energy of sliding, which counts for laws with two toughnesses in shear alone and is 0 for the others.
#pragma once

namespace delam {

struct Mixity {
    double shear = 0.0;   // B
    double second = 0.0;  // S

    Mixity() = default;
    Mixity(double b, double s = 0.0) : shear(b), second(s) {}  // a number is a B
    bool operator==(const Mixity&) const = default;
};

inline Mixity operator+(const Mixity& a, const Mixity& b) { return {a.shear + b.shear, a.second + b.second}; }
inline Mixity operator-(const Mixity& a, const Mixity& b) { return {a.shear - b.shear, a.second - b.second}; }
inline Mixity operator*(double factor, const Mixity& m) { return {factor * m.shear, factor * m.second}; }

// Zero jump means 0/0: mode I by convention. normal, tangential: Y_n, Y_t >= 0.
double mode_mixity(double normal, double tangential);
// The same for the share of Y_2 in Y_t; without sliding it is 0.
double second_share(double tangential, double second);

}  // namespace delam
