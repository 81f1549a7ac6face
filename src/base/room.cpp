// SPDX-License-Identifier: BSD-3-Clause
#include "base/room.hpp"

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace delam {

void require_room(std::size_t bytes) { ::operator delete(::operator new(bytes)); }

void require_room(std::size_t bytes, std::size_t part) {
    std::vector<std::unique_ptr<std::byte[]>> parts(bytes / part + 1);
    for (auto& p : parts) p = std::make_unique_for_overwrite<std::byte[]>(part);
}

}  // namespace delam
