// SPDX-License-Identifier: BSD-3-Clause
#include "law/respond.hpp"

#include "law/driving.hpp"

namespace delam {

PointResponse respond(const Law& law, std::span<const double> local_jump, double mixity, double adhesion_old) {
    double driving = 0.0;
    for (std::size_t c = 0; c < local_jump.size(); ++c)
        driving += 0.5 * law.stiffness(c) * local_jump[c] * local_jump[c];
    const Mixity held{mixity, driving_energy(law, local_jump).mixity().second};
    PointResponse at{law.minimiser(law.toughness(held), driving, adhesion_old), {}};
    for (std::size_t c = 0; c < local_jump.size(); ++c) at.traction[c] = at.adhesion * law.stiffness(c) * local_jump[c];
    return at;
}

}  // namespace delam
