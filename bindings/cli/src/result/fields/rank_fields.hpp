// SPDX-License-Identifier: BSD-3-Clause
// The fields of nodes and cells on the ranks of delam-mpi. Each rank computes those of its part and writes its rows
// into files that rank 0 has laid out; no rank has all rows of a field. Each writes a range of its own: Debian's HDF5
// for many processes has the symbols of the one that this program has already.
#pragma once

#include <string>
#include <vector>

#include <mpi.h>

#include "delam/petsc.h"
#include "result/fields/bulk_fields.hpp"

namespace cli {

class RankFields final : public Bulk {
public:
    // All ranks construct it; rank 0 calls the functions of Bulk, in the work of delam_petsc_run.
    explicit RankFields(delam_petsc* petsc);
    ~RankFields() override;
    RankFields(const RankFields&) = delete;
    RankFields& operator=(const RankFields&) = delete;

    std::vector<double> recover(const Model& model, delam_solver* solver,
                                const std::vector<std::int64_t>& nodes) override;
    double largest_rotation() override { return largest_rotation_; }
    void write(const std::string& path, const std::vector<Room>& rooms) override;
    void copy(const std::string& path, const std::vector<FileRange>& ranges) override;

private:
    class Told;
    static std::int32_t task(std::int64_t size, const std::uint8_t* bytes, void* user);
    // Tasks of each rank.
    void gather(Told& told);
    void write_rows(Told& told);
    void copy_ranges(Told& told);

    // Rank 0 has all ranks do this.
    void everywhere(const std::vector<std::uint8_t>& bytes, const std::string& path) const;
    Field field(const std::string& key) const;
    // Rows of a field, as a file has them, of the nodes or cells that this rank gives, and their numbers, ascending.
    Field rows_to_write(const BulkField& field, std::vector<std::int64_t>& rows) const;
    // Some rows of a whole field, from `first` on, that this rank writes: as many as others do.
    std::vector<double> block_of_rows(const Room& room, std::int64_t& first) const;
    std::vector<std::int64_t> nodes(std::vector<std::int32_t>& owned) const;
    std::vector<std::int64_t> cells() const;
    void call(std::int32_t status) const;
    // Work of each rank alone. If it fails on one, all throw.
    template <class Work>
    void together(Work&& work) const;

    delam_petsc* petsc_;
    MPI_Comm comm_ = MPI_COMM_NULL;
    int rank_ = 0;
    int size_ = 1;
    std::vector<double> gathered_;  // on rank 0: [nodes asked for][3]
    double largest_rotation_ = 0.0;
};

}  // namespace cli
