// SPDX-License-Identifier: BSD-3-Clause
#include "law/softening/softening.hpp"

namespace delam {

namespace {

template <class... Shapes>
bool find(const std::string& name, std::variant<Shapes...>& softening) {
    return ((name == Shapes::kind.name && (softening = Shapes{}, true)) || ...);
}

}  // namespace

bool softening_of(const std::string& name, Softening& softening) { return find(name, softening); }

}  // namespace delam
