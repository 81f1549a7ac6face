// SPDX-License-Identifier: BSD-3-Clause
#include "result/fields/bulk_fields.hpp"

#include <algorithm>

namespace cli {

Field padded(const Field& field, std::size_t columns) {
    Field out{std::vector<double>(field.rows * columns, 0.0), field.rows, columns};
    for (std::size_t i = 0; i < field.rows; ++i)
        std::copy_n(field.values.begin() + static_cast<std::ptrdiff_t>(i * field.columns), field.columns,
                    out.values.begin() + static_cast<std::ptrdiff_t>(i * columns));
    return out;
}

bool wants(const Scene& scene, const std::string& name) {
    return std::find(scene.output.fields.begin(), scene.output.fields.end(), name) != scene.output.fields.end();
}

std::vector<BulkField> bulk_fields(const Scene& scene) {
    std::vector<BulkField> wanted;
    for (const BulkField& field :
         {BulkField{"displacement", true, 3}, BulkField{"stress", false, 6}, BulkField{"rotation", false, 3}})
        if (wants(scene, field.name)) wanted.push_back(field);
    return wanted;
}

Field stored(const BulkField& field, const Field& rows) {
    if (field.name != "rotation" || rows.columns != 1) return padded(rows, field.columns);
    // The rotation in the plane is about z.
    Field about_z{std::vector<double>(rows.rows * 3, 0.0), rows.rows, 3};
    for (std::size_t i = 0; i < rows.rows; ++i) about_z.values[3 * i + 2] = rows.values[i];
    return about_z;
}

}  // namespace cli
