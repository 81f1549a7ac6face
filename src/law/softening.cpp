// SPDX-License-Identifier: BSD-3-Clause
#include "law/softening.hpp"

namespace delam {

bool softening_of(const std::string& name, Softening& softening) {
    const Softening shapes[] = {LinearSoftening{},    ExponentialSoftening{}, TrapezoidalSoftening{},
                                TabulatedSoftening{}, GriffithSoftening{},    HostSoftening{}};
    for (const Softening& shape : shapes)
        if (name == softening_names[shape.index()]) {
            softening = shape;
            return true;
        }
    return false;
}

}  // namespace delam
