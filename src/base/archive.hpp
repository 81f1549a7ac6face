// SPDX-License-Identifier: BSD-3-Clause
// Values as bytes, field by field. A struct is saved by a table of its members, each with the version of the format
// that introduced it. Writer and reader walk the same table, so that they cannot disagree. A member that is newer than
// the bytes keeps its default.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {

// Numbers as they lie in memory, little-endian, and arrays of them behind their size.
class Writer {
public:
    explicit Writer(std::uint32_t version) : version_(version) {}
    std::vector<std::uint8_t> bytes;

    std::uint32_t version() const { return version_; }
    template <class T>
    void item(const T& v) {
        static_assert(std::is_arithmetic_v<T>);
        put(&v, sizeof(T));
    }
    template <class T>
    void item(const std::vector<T>& v) {
        static_assert(std::is_arithmetic_v<T>);
        item(static_cast<std::uint64_t>(v.size()));
        put(v.data(), v.size() * sizeof(T));
    }

private:
    void put(const void* from, std::size_t n) {
        const std::size_t at = bytes.size();
        bytes.resize(at + n);
        if (n > 0) std::memcpy(bytes.data() + at, from, n);
    }
    std::uint32_t version_;
};

// FNV-1a, 64 bits (Fowler, Noll, Vo): tells contents apart and shows damage, but does not resist an attack.
inline constexpr std::uint64_t checksum_start = 14695981039346656037ULL, checksum_factor = 1099511628211ULL;

// Returns the checksum of bytes; checksum(b, checksum(a)) is that of a with b behind it.
inline std::uint64_t checksum(std::span<const std::uint8_t> bytes, std::uint64_t sum = checksum_start) {
    for (const std::uint8_t b : bytes) sum = (sum ^ b) * checksum_factor;
    return sum;
}
// Returns the same with the 8 bytes of a word behind, its lowest first.
inline std::uint64_t checksum(std::uint64_t word, std::uint64_t sum) {
    for (int i = 0; i < 8; ++i) sum = (sum ^ ((word >> (8 * i)) & 0xffU)) * checksum_factor;
    return sum;
}

// Throws Error(DELAM_ERROR_SNAPSHOT) where the bytes end early. what: of which they are, for the message.
class Reader {
public:
    Reader(std::span<const std::uint8_t> bytes, std::uint32_t version, const char* what = "snapshot")
        : bytes_(bytes), version_(version), what_(what) {}

    std::uint32_t version() const { return version_; }
    std::size_t left() const { return bytes_.size() - at_; }
    template <class T>
    void item(T& v) {
        static_assert(std::is_arithmetic_v<T>);
        std::memcpy(&v, take(sizeof(T)), sizeof(T));
    }
    template <class T>
    void item(std::vector<T>& v) {
        static_assert(std::is_arithmetic_v<T>);
        v.resize(count(sizeof(T)));
        if (!v.empty()) std::memcpy(v.data(), take(v.size() * sizeof(T)), v.size() * sizeof(T));
    }
    // A number of things of at least `size` bytes each, for which there must be room.
    std::size_t count(std::size_t size) {
        std::uint64_t n = 0;
        item(n);
        if (n > left() / size) end_early();
        return n;
    }

private:
    [[noreturn]] void end_early() const { fail(DELAM_ERROR_SNAPSHOT, what_, " ends early at byte ", bytes_.size()); }
    const std::uint8_t* take(std::size_t n) {
        if (n > left()) end_early();
        const std::uint8_t* p = bytes_.data() + at_;
        at_ += n;
        return p;
    }
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    std::uint32_t version_;
    const char* what_;
};

// Exceptions to the rule for a saved member, which is an array of finite numbers of the size that the reader's own has.
struct Allowed {
    bool any_size = false;
    bool infinite = false;
};

// A member, or a member of a member, and the version of the format that it came with.
template <class... Path>
struct Field {
    std::uint32_t since;
    std::tuple<Path...> path;
    Allowed allowed{};

    template <class Object>
    constexpr auto& of(Object& object) const {
        return std::apply(
            [&](auto... members) -> auto& { return (object.*....*members); }, path);
    }
};

// Rows of a table: saved_since(version, &Owner::member, ..., member_of(&Owner::part, &Part::member), ...), some of them
// any_size(row) or may_be_infinite(row).
template <class... Members>
constexpr std::tuple<Members...> member_of(Members... members) {
    return {members...};
}
template <class... Members>
constexpr Field<Members...> field(std::uint32_t since, std::tuple<Members...> members) {
    return {since, members};
}
template <class Row>
struct Marked {
    Row row;
    Allowed allowed;
};
template <class Row>
constexpr Marked<Row> any_size(Row row) {
    return {row, {.any_size = true}};
}
template <class Row>
constexpr Marked<Row> may_be_infinite(Row row) {
    return {row, {.infinite = true}};
}
template <class Owner, class T>
constexpr Field<T Owner::*> field(std::uint32_t since, T Owner::*member) {
    return {since, {member}};
}
template <class Row>
constexpr auto field(std::uint32_t since, Marked<Row> marked) {
    auto row = field(since, marked.row);
    row.allowed = marked.allowed;
    return row;
}
template <class... Rows>
constexpr auto saved_since(std::uint32_t version, Rows... rows) {
    return std::make_tuple(field(version, rows)...);
}
// Members that are no part of a saved state.
constexpr std::uint32_t unsaved = std::numeric_limits<std::uint32_t>::max();

// The table of a struct, in the order of the bytes: one specialisation for each that is saved.
template <class T>
inline constexpr std::nullptr_t saved_fields = nullptr;

// Has each member of Owner its row? A member without one makes Owner larger than its rows, unless it fits into the
// padding of the others.
template <class Owner, class Table>
constexpr bool complete(const Table& table) {
    std::size_t size = 0;
    const auto add = [&](const auto& row) {
        size += sizeof(std::remove_reference_t<decltype(row.of(std::declval<Owner&>()))>);
    };
    std::apply([&](const auto&... rows) { (add(rows), ...); }, table);
    return (size + alignof(Owner) - 1) / alignof(Owner) * alignof(Owner) == sizeof(Owner);
}

template <class Walker, class Object, class Table>
void walk(Walker& walker, Object& object, const Table& table);

template <class T>
inline constexpr bool has_table = !std::is_null_pointer_v<std::remove_const_t<decltype(saved_fields<T>)>>;

template <class Walker, class T>
void walk(Walker& walker, T& value) {
    if constexpr (!has_table<std::remove_const_t<T>>)
        walker.item(value);
    else
        walk(walker, value, saved_fields<std::remove_const_t<T>>);
}

template <class Walker, class Object, class Table>
void walk(Walker& walker, Object& object, const Table& table) {
    const auto visit = [&](const auto& row) {
        if (row.since <= walker.version()) walk(walker, row.of(object));
    };
    std::apply([&](const auto&... rows) { (visit(rows), ...); }, table);
}

// Checks that the members of this version of the format keep the rules of their rows. The arrays of the object that is
// compared with have the right sizes.
class Sound {
public:
    explicit Sound(std::uint32_t version) : version_(version) {}
    bool sizes = true, numbers = true;

    template <class T>
    void compare(const T& object, const T& own) {
        const auto visit = [&](const auto& row) {
            if (row.since > version_) return;
            const auto& member = row.of(object);
            if constexpr (has_table<std::remove_cvref_t<decltype(member)>>)
                compare(member, row.of(own));
            else
                item(row.allowed, member, row.of(own));
        };
        std::apply([&](const auto&... rows) { (visit(rows), ...); }, saved_fields<T>);
    }

private:
    template <class T>
    void item(const Allowed& allowed, const T& v, const T& /*own*/) {
        if constexpr (std::is_floating_point_v<T>)
            numbers = numbers && (allowed.infinite ? !std::isnan(v) : std::isfinite(v));
    }
    template <class T>
    void item(const Allowed& allowed, const std::vector<T>& v, const std::vector<T>& own) {
        sizes = sizes && (allowed.any_size || v.size() == own.size());
        for (const T& entry : v) item(allowed, entry, entry);
    }
    std::uint32_t version_;
};

// Bytes of the least value of T, one with empty arrays.
template <class T>
std::size_t least_size(std::uint32_t version) {
    Writer least(version);
    const T empty{};
    walk(least, empty);
    return least.bytes.size();
}
template <class T>
void write_list(Writer& writer, const std::vector<T>& list) {
    writer.item(static_cast<std::uint64_t>(list.size()));
    for (const T& entry : list) walk(writer, entry);
}
template <class T>
std::vector<T> read_list(Reader& reader) {
    std::vector<T> list(reader.count(least_size<T>(reader.version())));
    for (T& entry : list) walk(reader, entry);
    return list;
}

}  // namespace delam
