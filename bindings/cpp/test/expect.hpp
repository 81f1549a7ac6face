// SPDX-License-Identifier: BSD-3-Clause
// Shared by the tests: counted contracts, and the status of an error.
#ifndef DELAM_CPP_TEST_EXPECT_HPP
#define DELAM_CPP_TEST_EXPECT_HPP

#include <cstdint>
#include <cstdio>
#include <string>

#include "delam/delam.hpp"

inline int checked = 0;
inline int broken = 0;

inline void expect(bool holds, const char* what) {
    ++checked;
    if (holds) return;
    ++broken;
    std::printf("does not hold: %s\n", what);
}

// The status that a call throws; DELAM_OK if it throws nothing.
template <class Call>
std::int32_t status_of(Call&& call, std::string* message = nullptr) {
    try {
        call();
    } catch (const delam::Error& error) {
        if (message != nullptr) *message = error.what();
        return error.status();
    }
    return DELAM_OK;
}

// Exit code of the test.
inline int ended() {
    std::printf("%d checked, %d broken\n", checked, broken);
    return broken == 0 ? 0 : 1;
}

#endif
