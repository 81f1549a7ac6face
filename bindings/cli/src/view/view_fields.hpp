// SPDX-License-Identifier: BSD-3-Clause
// fields.h5 of a result, as far as `delam view` shows it. Every failure is a Failure(exit_scene) that names the file
// and what is wrong in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "result/fields/h5.hpp"

namespace cli {

struct ViewMesh {
    std::int32_t dimension = 0;
    std::vector<double> points;       // [nodes][3]
    std::vector<std::int64_t> cells;  // [cells][per_cell], -1 behind the last node of a shorter one
    std::size_t per_cell = 0;
    std::vector<std::int32_t> body;  // of each cell

    [[nodiscard]] std::size_t nodes() const { return points.size() / 3; }
    [[nodiscard]] std::size_t cell_count() const { return body.size(); }
};

struct ViewInterface {
    std::string name;
    std::int64_t body_a = 0, body_b = 0;         // -1: a rigid obstacle
    std::vector<std::int64_t> nodes_a, nodes_b;  // of each pair
    std::vector<std::int64_t> faces;             // [faces][per_face] pairs
    std::size_t per_face = 0;
};

struct ViewStep {
    std::string group;  // its name in the file
    std::int64_t step = 0;
    double time = 0;
};

struct ViewAbout;

class FieldsFile {
public:
    explicit FieldsFile(const std::string& path);

    // A text that the file says of itself, "" if it does not.
    [[nodiscard]] std::string text(const std::string& name) const;
    // Returns the mesh with the dimension, the names of the bodies and the shortest edge of result.json.
    [[nodiscard]] ViewMesh mesh(const ViewAbout& about) const;
    [[nodiscard]] std::vector<ViewInterface> interfaces(const ViewMesh& mesh) const;
    // Returns the steps whose fields were written, ascending. times: of the history, by step. interfaces: how many
    // there are.
    [[nodiscard]] std::vector<ViewStep> steps(const std::vector<double>& times, std::size_t interfaces) const;
    // A field of a step, [rows][columns]. name: as in the file, with "interface_I/" before that of an interface.
    [[nodiscard]] std::vector<double> field(const ViewStep& step, const std::string& name, std::size_t rows,
                                            std::size_t columns) const;

private:
    std::string path_;
    h5::File file_;
};

}  // namespace cli
