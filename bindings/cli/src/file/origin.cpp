// SPDX-License-Identifier: BSD-3-Clause
#include "file/origin.hpp"

#include <nlohmann/json.hpp>

#include "file/input_file.hpp"
#include "text/error.hpp"

namespace cli {

std::string packed(const Origin& origin) {
    const nlohmann::ordered_json out{{"started", origin.started}, {"resumed", origin.resumed}};
    return out.dump(2) + "\n";
}

Origin read_origin(const std::string& path) {
    constexpr std::int64_t most_bytes = 4096;
    try {
        const auto json = nlohmann::json::parse(read_bytes(path, most_bytes));
        return {json.at("started"), json.at("resumed")};
    } catch (const Failure&) {
        return {};
    } catch (const nlohmann::json::exception&) {
        return {};
    }
}

}  // namespace cli
