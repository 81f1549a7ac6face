// SPDX-License-Identifier: BSD-3-Clause
// Numbers within a page: rounded, their bytes sorted by place, deflated, as base64. The script `data.js` of the page
// does the same backwards.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

namespace cli {

// A number with so many significant bits (2 to 24), as close as that allows: 16 keep 1.5e-5 of it.
float rounded_to(float value, int bits);

class ViewArrays {
public:
    // Each adds an array and returns what the page has to know of it: its element, type and number of values. `bits`:
    // the significant bits that are kept.
    nlohmann::json add(std::span<const double> values, int bits);
    nlohmann::json add(std::span<const std::int32_t> values);

    // The elements of the page that have the arrays.
    [[nodiscard]] const std::string& elements() const { return elements_; }

private:
    nlohmann::json add_bytes(const char* type, std::span<const unsigned char> bytes);

    std::string elements_;
    std::int64_t count_ = 0;
};

}  // namespace cli
