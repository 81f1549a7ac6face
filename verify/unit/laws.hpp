// SPDX-License-Identifier: BSD-3-Clause
// Laws of every shape and criterion for tests.
#pragma once

#include <string>
#include <vector>

#include "../cases/host_bilinear.hpp"
#include "law/law.hpp"
#include "law/law_parameters.hpp"

namespace laws {

using delam::Law;

struct Named {
    std::string name;
    Law law;
};

// A mild law whose two toughnesses differ by mode; `ratio` = Gc/Go in opening, a third more in sliding.
inline Law law(const std::string& shape, delam::Criterion criterion, double ratio) {
    Law l;
    l.set_criterion(criterion);
    delam::softening_of(shape, l.softening);
    l.normal_stiffness = 125e9;
    l.tangential_stiffness = 60e9;
    l.normal_onset = 100.0;
    l.tangential_onset = 160.0;
    l.normal_toughness = 100.0 * ratio;
    l.tangential_toughness = 160.0 * ratio * 4.0 / 3.0;
    if (criterion == delam::Criterion::valoroso_champaney) {
        l.onset_exponent_1 = l.toughness_exponent_1 = 1.4;
        l.onset_exponent_2 = l.toughness_exponent_2 = 2.3;
    } else {
        set_parameter(l, "onset_exponent", 1.6);
        set_parameter(l, "toughness_exponent", 1.6);
    }
    return l;
}

inline std::vector<Named> shapes(delam::Criterion criterion, double ratio) {
    std::vector<Named> out;
    const auto add = [&](const std::string& name, Law l) {
        out.push_back({name + ", " + delam::name_of(criterion) + ", Gc/Go = " + std::to_string(ratio), std::move(l)});
    };
    const auto table = [&](std::vector<double> xi, std::vector<double> s) {
        Law l = law("tabulated", criterion, ratio);
        std::get<delam::TabulatedSoftening>(l.softening).set_table(xi, s);
        return l;
    };
    add("bilinear", law("piecewise-linear", criterion, ratio));
    add("exponential", law("exponential", criterion, ratio));
    for (const double plateau : {0.0, 0.5, 0.95}) {
        Law l = law("trapezoidal", criterion, ratio);
        set_parameter(l, "plateau", plateau);
        add("trapezium " + std::to_string(plateau), l);
    }
    add("table", table({0.0, 0.1, 0.3, 0.6, 1.0}, {1.0, 0.7, 0.4, 0.1, 0.0}));
    add("table, concave", table({0.0, 0.5, 0.8, 1.0}, {1.0, 0.9, 0.6, 0.0}));
    add("table with drops", table({0.0, 0.2, 0.2, 0.5, 1.0, 1.0}, {1.0, 0.9, 0.5, 0.5, 0.3, 0.0}));
    add("table, drop at the onset", table({0.0, 0.0, 1.0}, {1.0, 0.6, 0.0}));
    add("griffith", law("griffith", criterion, ratio));
    return out;
}

inline const delam::Criterion criteria[] = {delam::Criterion::valoroso_champaney, delam::Criterion::power,
                                            delam::Criterion::benzeggagh_kenane};

}  // namespace laws
