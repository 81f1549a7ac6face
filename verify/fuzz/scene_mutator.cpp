// SPDX-License-Identifier: BSD-3-Clause
// Changes scenes line by line more often than byte by byte: most byte changes only break the strict format.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    static const char* const values[] = {"0",
                                         "-1",
                                         "1",
                                         "2",
                                         "3",
                                         "9223372036854775807",
                                         "-9223372036854775808",
                                         "1e-300",
                                         "1e300",
                                         "nan",
                                         "inf",
                                         "-inf",
                                         "0.0",
                                         "-0.0",
                                         "0.5",
                                         "1e-9",
                                         "4294967296",
                                         "\"\"",
                                         "\"*\"",
                                         "true",
                                         "false",
                                         "[]",
                                         "[[]]",
                                         "{}",
                                         "[0.0, 1.0]",
                                         "[1.0, 0.0]",
                                         "[0.0, 0.0]",
                                         "[1e300, -1e300]",
                                         "[[0.0, 1.0], [1.0, 0.0]]",
                                         "1979-05-27",
                                         "[0.0, 0.0, 0.0]",
                                         "[\"x\", \"y\"]",
                                         "[\"z\"]",
                                         "0.0625",
                                         "0.25",
                                         "{ lower = [0.0, 0.0], upper = [1.0, 1.0] }"};
    std::minstd_rand random(seed);
    const auto below = [&](std::size_t count) { return count == 0 ? 0 : random() % count; };
    if (below(3) == 0) return LLVMFuzzerMutate(data, size, most);
    std::vector<std::string> lines(1);
    for (std::size_t i = 0; i < size; ++i) {
        lines.back() += static_cast<char>(data[i]);
        if (data[i] == '\n') lines.emplace_back();
    }
    for (std::size_t left = 1 + below(3); left > 0 && !lines.empty(); --left) {
        const auto at = static_cast<std::ptrdiff_t>(below(lines.size()));
        std::string& line = lines[static_cast<std::size_t>(at)];
        switch (below(6)) {
            case 0:
                lines.erase(lines.begin() + at);
                break;
            case 1:
                lines.insert(lines.begin() + at, std::string(line));
                break;
            case 2:
                std::swap(line, lines[below(lines.size())]);
                break;
            case 3:
                lines.insert(lines.begin() + at, std::string(lines[below(lines.size())]));
                break;
            default: {  // another value for the key, or for one number in it
                const std::size_t equals = line.find('=');
                const std::size_t from = equals == std::string::npos ? line.find(',') : equals;
                if (from == std::string::npos) break;
                std::size_t digit = line.find_first_of("0123456789", from + below(line.size() - from));
                if (below(2) == 0 || digit == std::string::npos)
                    line = line.substr(0, from + 1) + " " + values[below(std::size(values))] + "\n";
                else
                    line.replace(digit, line.find_first_not_of("0123456789.e-", digit) - digit, values[below(17)]);
            }
        }
    }
    std::string text;
    for (const std::string& line : lines) text += line;
    const std::size_t length = std::min(text.size(), most);
    std::memcpy(data, text.data(), length);
    return length;
}
