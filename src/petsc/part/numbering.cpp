// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/part/numbering.hpp"

#include <algorithm>

#include "base/numbers.hpp"

namespace delam::petsc {

std::vector<std::vector<std::int64_t>> Numbering::by_keeper(std::span<const std::int64_t> nodes) const {
    std::vector<std::vector<std::int64_t>> asked(index(comm_.size()));
    for (const std::int64_t node : nodes) asked[keeper(node)].push_back(node);
    return asked;
}

Numbering::Numbering(const Communicator& comm, std::span<const std::int64_t> nodes, std::int64_t mesh_nodes)
    : comm_(comm) {
    const std::int64_t last = nodes.empty() ? -1 : *std::max_element(nodes.begin(), nodes.end());
    const std::int64_t total = std::max(comm.largest(last) + 1, mesh_nodes);
    share_ = std::max<std::int64_t>(1, (total + comm.size() - 1) / comm.size());
    const std::int64_t begin = share_ * comm.rank();

    // Who has a node? The keeper of the node tells its owner, and rank 0 which nodes nobody has.
    const auto announced = comm.exchange(by_keeper(nodes));
    std::vector<int> owner;
    std::vector<std::vector<std::int64_t>> yours(announced.size());
    comm.together([&] {
        owner.assign(index(share_), -1);
        for (std::size_t r = 0; r < announced.size(); ++r)
            for (const std::int64_t node : announced[r]) {
                int& o = owner[index(node - begin)];
                if (o < 0) o = static_cast<int>(r);
            }
        for (std::int64_t node = begin; node < begin + share_ && node < total; ++node) {
            const int o = owner[index(node - begin)];
            if (o < 0 && node >= mesh_nodes) continue;
            // An orphan is encoded as -1 - node.
            yours[o < 0 ? 0 : index(o)].push_back(o < 0 ? -1 - node : node);
        }
    });
    std::vector<std::int64_t> mine;
    const auto told = comm.exchange(yours);
    comm.together([&] {
        for (const auto& list : told)
            for (const std::int64_t node : list) {
                mine.push_back(node < 0 ? -1 - node : node);
                if (node < 0) orphans_.push_back(-1 - node);
            }
        std::sort(mine.begin(), mine.end());
    });

    // The numbers, and back to the keepers.
    const auto count = static_cast<std::int64_t>(mine.size());
    std::int64_t before = 0, all = 0;
    MPI_Exscan(&count, &before, 1, MPI_INT64_T, MPI_SUM, comm.get());
    MPI_Allreduce(&count, &all, 1, MPI_INT64_T, MPI_SUM, comm.get());
    if (comm.root()) before = 0;
    comm.together([&] {
        petsc_int(3 * all);
        first_ = petsc_int(before);
        owned_ = petsc_int(count);
    });
    const auto numbered = comm.exchange(by_keeper(mine));
    std::vector<std::vector<PetscInt>> numbers(numbered.size());
    comm.together([&] {
        PetscInt next = first_;
        for (const std::int64_t node : mine) numbers[keeper(node)].push_back(next++);
        number_.assign(index(share_), -1);
    });
    const auto arrived = comm.exchange(numbers);
    for (std::size_t r = 0; r < numbered.size(); ++r)
        for (std::size_t i = 0; i < numbered[r].size(); ++i) number_[index(numbered[r][i] - begin)] = arrived[r][i];
}

std::vector<PetscInt> Numbering::find(std::span<const std::int64_t> nodes) const {
    const auto questions = comm_.exchange(by_keeper(nodes));
    std::vector<std::vector<PetscInt>> answers(questions.size());
    const std::int64_t begin = share_ * comm_.rank();
    comm_.together([&] {
        for (std::size_t r = 0; r < questions.size(); ++r)
            for (const std::int64_t node : questions[r]) answers[r].push_back(number_[index(node - begin)]);
    });
    const auto arrived = comm_.exchange(answers);
    std::vector<std::size_t> next(arrived.size(), 0);
    std::vector<PetscInt> found;
    comm_.together([&] {
        found.reserve(nodes.size());
        for (const std::int64_t node : nodes) found.push_back(arrived[keeper(node)][next[keeper(node)]++]);
        for (std::size_t i = 0; i < found.size(); ++i)
            if (found[i] < 0) fail(DELAM_ERROR_ARGUMENT, "node ", nodes[i], " belongs to no part");
    });
    return found;
}

}  // namespace delam::petsc
