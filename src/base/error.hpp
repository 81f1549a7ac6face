// SPDX-License-Identifier: BSD-3-Clause
// The library's only exception type. The C façade catches it and turns it into a status and a message.
#pragma once

#include <cstdint>
#include <exception>
#include <locale>
#include <sstream>
#include <string>
#include <utility>

namespace delam {

class Error : public std::exception {
public:
    // status: one of DELAM_ERROR_* or a positive outcome of delam.h.
    Error(std::int32_t status, std::string text) : status_(status), text_(std::move(text)) {}
    [[nodiscard]] std::int32_t status() const noexcept { return status_; }
    [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

private:
    std::int32_t status_;
    std::string text_;
};

// Joins its arguments into one message: text("node ", 17, " >= ", 12). Numbers have 6 significant digits in C format,
// independent of the host's global locale. Throws when memory runs out, where a stream by default would truncate the
// text.
template <class... Parts>
std::string text(const Parts&... parts) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.exceptions(std::ios::badbit);
    (out << ... << parts);
    return out.str();
}

template <class... Parts>
[[noreturn]] void fail(std::int32_t status, const Parts&... parts) {
    throw Error(status, text(parts...));
}

}  // namespace delam
