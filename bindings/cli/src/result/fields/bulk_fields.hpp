// SPDX-License-Identifier: BSD-3-Clause
// The fields of nodes and cells as a step file has them, whoever computes and writes them: `delam` alone, or the ranks
// of `delam-mpi`, each its own rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "model/library/model.hpp"

namespace cli {

struct Field {
    std::vector<double> values;
    std::size_t rows = 0;
    std::size_t columns = 0;
};

// ParaView knows vectors of 3 and symmetric tensors of 6 (xx, yy, zz, xy, yz, zx); in 2D the remaining components are
// zero.
Field padded(const Field& field, std::size_t columns);

// Its name is that of the library's field, of [output] and of the dataset.
struct BulkField {
    std::string name;
    bool of_nodes = true;     // false: of cells
    std::size_t columns = 3;  // in a file
};
bool wants(const Scene& scene, const std::string& name);
// Returns the fields that the scene wants, in the order of a file.
std::vector<BulkField> bulk_fields(const Scene& scene);
// Rows of the library in the columns of a file.
Field stored(const BulkField& field, const Field& rows);

// The values of one field in a file: a dataset without chunks, whose bytes lie one behind the other.
struct Room {
    BulkField field;
    std::int64_t rows = 0;    // of nodes or cells
    std::int64_t offset = 0;  // of its first byte
};
struct FileRange {
    std::string from;  // a file
    std::int64_t offset = 0;
    std::int64_t bytes = 0;
    std::int64_t to = 0;  // offset
};

// Fields that are on many processes, none of which has all of them. Failures are those of the program.
class Bulk {
public:
    virtual ~Bulk() = default;
    // The processes recover the displacements of the solver's state, which the calls below are about. Returns those at
    // some nodes, ascending, [nodes][3].
    virtual std::vector<double> recover(const Model& model, delam_solver* solver,
                                        const std::vector<std::int64_t>& nodes) = 0;
    virtual double largest_rotation() = 0;  // of a cell
    // Fill the rooms of a file, and what is between them is left as it is. On return the bytes are on the disk.
    virtual void write(const std::string& path, const std::vector<Room>& rooms) = 0;
    virtual void copy(const std::string& path, const std::vector<FileRange>& ranges) = 0;
};

}  // namespace cli
