// SPDX-License-Identifier: BSD-3-Clause
#include "host.hpp"

#include <cstdio>
#include <cstring>

namespace faults {

void Transcript::add(const std::string& name, const void* bytes, std::size_t size) {
    entries_.emplace_back(name, size > 0 ? std::string(static_cast<const char*>(bytes), size) : std::string());
}

namespace {

// Returns the first numbers that differ, if both texts are as many doubles.
std::string in_numbers(const std::string& a, const std::string& b) {
    if (a.size() != b.size() || a.size() % sizeof(double) != 0) return "";
    for (std::size_t at = 0; at < a.size(); at += sizeof(double)) {
        double x = 0.0, y = 0.0;
        std::memcpy(&x, a.data() + at, sizeof x);
        std::memcpy(&y, b.data() + at, sizeof y);
        if (std::memcmp(&x, &y, sizeof x) == 0) continue;
        char text[100];
        std::snprintf(text, sizeof text, ": %.17g or %.17g (number %zu)", x, y, at / sizeof x);
        return text;
    }
    return "";
}

}  // namespace

std::string Transcript::difference(const Transcript& other) const {
    for (std::size_t i = 0; i < entries_.size() && i < other.entries_.size(); ++i) {
        if (entries_[i].first != other.entries_[i].first)
            return "entry " + std::to_string(i) + " is " + entries_[i].first + " or " + other.entries_[i].first;
        if (entries_[i].second != other.entries_[i].second)
            return "entry " + std::to_string(i) + ", " + entries_[i].first + ", differs" +
                   in_numbers(entries_[i].second, other.entries_[i].second);
    }
    return entries_.size() == other.entries_.size() ? "" : "other numbers of entries";
}

Transcript state_of(delam_solver* solver, bool words) {
    Transcript state;
    const auto require = [](std::int32_t status, const std::string& what) {
        expect(status == DELAM_OK, "reading " + what + ": " + delam_status_name(status));
    };
    std::int64_t needed = 0;
    require(delam_solver_save(solver, 0, nullptr, &needed), "saved bytes");
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(needed));
    require(delam_solver_save(solver, needed, bytes.data(), &needed), "saved bytes");
    state.add("saved bytes", bytes);
    for (const char* key : {"jump", "traction", "adhesion", "mixity", "contact"}) {
        std::int64_t rows = 0, columns = 0;
        require(delam_solver_field_shape(solver, key, -1, &rows, &columns), key);
        std::vector<double> values(static_cast<std::size_t>(rows * columns));
        require(delam_solver_field(solver, key, -1, rows * columns, values.data()), key);
        state.add(key, values);
    }
    for (const char* key : {"step", "time", "stored_bulk", "stored_interface", "dissipated", "work", "am_iterations"}) {
        double value = 0.0;
        require(delam_solver_value(solver, key, &value), key);
        state.add(key, &value, sizeof value);
    }
    if (words) state.add("searched", std::string(delam_solver_searched(solver)));
    return state;
}

}  // namespace faults
