// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <functional>

#include "base/numbers.hpp"
#include "capi/handle/handles.hpp"

namespace delam {

void require_pointer(const void* pointer, const char* name) {
    if (pointer == nullptr) fail(DELAM_ERROR_ARGUMENT, name, " is NULL");
}

void require_count(std::int64_t count, const char* name, std::int64_t smallest) {
    // A limit far beyond any memory; a few products with small numbers still fit an int64.
    constexpr std::int64_t largest = std::int64_t{1} << 48;
    if (count < smallest || count > largest) {
        fail(DELAM_ERROR_ARGUMENT, name, " = ", count, " is outside ", smallest, " .. ", largest);
    }
}

void require_count_up_to(std::int64_t count, const char* name, std::int64_t smallest, std::int64_t largest) {
    if (count < smallest || count > largest)
        fail(DELAM_ERROR_ARGUMENT, name, " = ", count, " is outside ", smallest, " .. ", largest);
}

void require_array(const void* pointer, std::int64_t count, const char* name) {
    if (pointer == nullptr && count > 0) fail(DELAM_ERROR_ARGUMENT, name, " is NULL, expected ", count, " entries");
}

void require_finite(const double* values, std::int64_t count, const char* name) {
    for (std::int64_t i = 0; i < count; ++i) {
        if (!std::isfinite(values[i])) fail(DELAM_ERROR_ARGUMENT, name, "[", i, "] = ", values[i], " is not finite");
    }
}

void require_apart(const double* a, const char* name_a, std::int64_t count_a, const double* b, const char* name_b,
                   std::int64_t count_b) {
    if (a == nullptr || b == nullptr || count_a == 0 || count_b == 0) return;
    const std::less<const double*> before;
    if (before(a, b + count_b) && before(b, a + count_a))
        fail(DELAM_ERROR_ARGUMENT, "the output arrays ", name_a, " and ", name_b, " overlap");
}

void require_capacity(std::int64_t capacity, std::int64_t needed, const char* name) {
    if (capacity < needed) fail(DELAM_ERROR_ARGUMENT, name, ": capacity ", capacity, " < ", needed, " entries");
}

void require_capacity_if(bool wanted, std::int64_t capacity, std::int64_t needed, const char* name) {
    if (capacity < 0) fail(DELAM_ERROR_ARGUMENT, name, ": capacity = ", capacity, ", must be >= 0");
    if (wanted) require_capacity(capacity, needed, name);
}

void require_base(std::int32_t index_base) {
    if (index_base != 0 && index_base != 1) fail(DELAM_ERROR_ARGUMENT, "index_base = ", index_base, ", must be 0 or 1");
}

void require_box(int dimension, const double* lower, const double* upper) {
    require_pointer(lower, "lower");
    require_pointer(upper, "upper");
    require_finite(lower, dimension, "lower");
    require_finite(upper, dimension, "upper");
    for (int d = 0; d < dimension; ++d) {
        if (lower[d] > upper[d])
            fail(DELAM_ERROR_ARGUMENT, "lower[", d, "] = ", lower[d], " > upper[", d, "] = ", upper[d]);
    }
}

std::int64_t require_index(std::int64_t value, std::int64_t size, std::int32_t index_base, const std::string& what) {
    if (value < index_base || value - index_base >= size) {
        if (size == 0) fail(DELAM_ERROR_ARGUMENT, what, " = ", value, ", but there are none");
        fail(DELAM_ERROR_ARGUMENT, what, " = ", value, " is outside ", index_base, " .. ", size - 1 + index_base);
    }
    return value - index_base;
}

std::vector<std::int64_t> require_indices(const std::int64_t* values, std::int64_t count, std::int64_t size,
                                          std::int32_t index_base, const char* name) {
    require_array(values, count, name);
    std::vector<std::int64_t> list(values, values + count);
    for (std::int64_t i = 0; i < count; ++i) {
        std::int64_t& value = list[index(i)];
        if (value < index_base || value - index_base >= size)
            require_index(value, size, index_base, text(name, "[", i, "]"));
        value -= index_base;
    }
    return list;
}

void require_history(std::int64_t count, const double* times, const double* values) {
    require_count(count, "count", 1);
    require_array(times, count, "times");
    require_array(values, count, "values");
    require_finite(times, count, "times");
    require_finite(values, count, "values");
    for (std::int64_t i = 1; i < count; ++i)
        if (times[i] <= times[i - 1])
            fail(DELAM_ERROR_ARGUMENT, "times[", i, "] = ", times[i], " must be > times[", i - 1, "] = ", times[i - 1]);
}

}  // namespace delam
