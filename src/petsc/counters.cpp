// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/counters.hpp"

#include <cstring>
#include <fstream>
#include <string>

#include <petsclog.h>

namespace delam::petsc {

namespace {

// The most memory that this process has had, in MB (10^6 bytes).
double peak_memory() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kib = 0.0; word == "VmHWM:" && status >> kib) return kib * 1024.0 * 1e-6;
    return 0.0;
}

// Operations that PETSc has counted on this rank, without those inside MUMPS.
double petsc_operations() {
    PetscLogDouble operations = 0.0;
    return PetscGetFlops(&operations) == 0 ? operations : 0.0;
}

double petsc_bytes() { return petsc_isend_len + petsc_send_len; }
double petsc_messages() { return petsc_isend_ct + petsc_send_ct; }

}  // namespace

Counters::Counters(const Communicator& comm)
    : comm_(comm),
      operations_before_(petsc_operations()),
      bytes_before_(petsc_bytes()),
      messages_before_(petsc_messages()) {}

double Counters::value(const char* key, const Engine::Counts& counts, const Preconditioner* preconditioner) const {
    enum class Over { same, sum, largest };
    const struct {
        const char* key;
        double value;
        Over over;
    } table[] = {
        {"solves", counts.solves, Over::same},
        {"iterations", counts.iterations, Over::same},
        {"renewals", counts.renewals, Over::same},
        {"factor_entries", preconditioner == nullptr ? 0.0 : preconditioner->factor_entries(), Over::same},
        {"factor_flops", preconditioner == nullptr ? 0.0 : preconditioner->factor_flops(), Over::same},
        {"memory_mb_max", peak_memory(), Over::largest},
        {"memory_mb_sum", peak_memory(), Over::sum},
        {"operations_max", petsc_operations() - operations_before_, Over::largest},
        {"operations_sum", petsc_operations() - operations_before_, Over::sum},
        {"bytes_sent_max", comm_.bytes_sent() + petsc_bytes() - bytes_before_, Over::largest},
        {"bytes_sent_sum", comm_.bytes_sent() + petsc_bytes() - bytes_before_, Over::sum},
        {"messages_max", comm_.messages_sent() + petsc_messages() - messages_before_, Over::largest},
        {"messages_sum", comm_.messages_sent() + petsc_messages() - messages_before_, Over::sum},
    };
    double found = 0.0;
    Over over = Over::same;
    comm_.together([&] {
        for (const auto& row : table) {
            if (std::strcmp(row.key, key) != 0) continue;
            found = row.value;
            over = row.over;
            return;
        }
        fail(DELAM_ERROR_ARGUMENT, "key = ", key, ": there is no such value");
    });
    if (over == Over::sum) return comm_.sum(found);
    return over == Over::largest ? comm_.largest(found) : found;
}

}  // namespace delam::petsc
