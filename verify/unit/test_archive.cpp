// SPDX-License-Identifier: BSD-3-Clause
// Saved structs, field by field: fields that a later version adds are absent from older bytes and read with their
// defaults; the bytes of a state keep their order.
#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "check.hpp"
#include "evolution/increment/state_fields.hpp"
#include "evolution/step/jump_event_fields.hpp"
#include "refused.hpp"

using namespace delam;

namespace {

struct Part {
    std::int64_t count = 3;
    double late = 0.25;
};
// A struct as it may be after two further versions of the format.
struct Sample {
    double first = 1.0;
    std::vector<double> list{};
    Part part{};
    double added = -7.5;
    bool derived = true;
};
constexpr auto rows =
    std::tuple_cat(saved_since(5, &Sample::first, &Sample::list, member_of(&Sample::part, &Part::count)),
                   saved_since(8, may_be_infinite(member_of(&Sample::part, &Part::late)), &Sample::added),
                   saved_since(unsaved, &Sample::derived));
static_assert(complete<Sample>(rows));
// A missing row is detected.
static_assert(!complete<Sample>(saved_since(5, &Sample::first, &Sample::list)));

Sample changed() { return {2.0, {4.0, 5.0}, {6, 0.5}, 9.0, false}; }

std::vector<std::uint8_t> written(const Sample& sample, std::uint32_t version) {
    Writer writer(version);
    walk(writer, sample, rows);
    return writer.bytes;
}

Sample read(const std::vector<std::uint8_t>& bytes, std::uint32_t version) {
    Reader reader(bytes, version);
    Sample sample;
    walk(reader, sample, rows);
    ck_assert_uint_eq(reader.left(), 0);
    return sample;
}

// Every value of a list as eight bytes.
template <class T>
void append(std::vector<std::uint8_t>& bytes, T value) {
    static_assert(sizeof value == 8);
    const std::size_t at = bytes.size();
    bytes.resize(at + 8);
    std::memcpy(bytes.data() + at, &value, 8);
}

template <class T>
std::vector<std::uint8_t> bytes_of(const T& value) {
    Writer writer(7);
    walk(writer, value);
    return writer.bytes;
}

// Gives every saved number a value of its own, greater than zero.
struct Numbered {
    int last = 0;
    static constexpr std::uint32_t version() { return unsaved - 1; }
    template <class T>
    void item(T& v) {
        v = static_cast<T>(++last);
    }
    template <class T>
    void item(std::vector<T>& /*v*/) {}
};

}  // namespace

template <>
inline constexpr auto delam::saved_fields<Sample> = rows;

// A member of the effort that add() leaves out is lost where the efforts of several solves add up.
TEST(efforts_add_with_every_member) {
    State filled, added, only;
    Numbered numbers;
    walk(numbers, filled);
    only.effort = filled.effort;
    added.effort.add(filled.effort);
    ck_assert(bytes_of(added) == bytes_of(only));
    ck_assert(bytes_of(added) != bytes_of(State{}));
    added.effort.add(filled.effort);
    ck_assert_int_eq(added.effort.am_iterations, 2 * filled.effort.am_iterations);
    ck_assert_int_eq(added.effort.contact_iterations_first, filled.effort.contact_iterations_first);
    ck_assert_int_eq(added.effort.contact_iterations_max, filled.effort.contact_iterations_max);
    ck_assert_double_eq(added.effort.linear_residual, filled.effort.linear_residual);
}

TEST(increments_compare_beyond_rounding) {
    Ledger ledger;
    ledger.stored_bulk = 3.0;
    ledger.load_potential = -8.0;
    ledger.work = -4.0;
    ledger.increment = 2.0;
    ck_assert_double_eq(ledger.scale(), 5.0);
    ck_assert(!ledger.undercut_by(2.0) && !ledger.undercut_by(2.0 - 4.9e-10) && ledger.undercut_by(2.0 - 5.1e-10));
    ledger.work = -50.0;
    ck_assert_double_eq(ledger.scale(), 50.0);
    ck_assert(!ledger.undercut_by(2.0 - 4.9e-9) && ledger.undercut_by(2.0 - 5.1e-9));
}

TEST(older_bytes_leave_defaults) {
    const auto old = written(changed(), 7), today = written(changed(), 8);
    ck_assert_uint_eq(old.size(), 8 + (8 + 16) + 8);
    ck_assert_uint_eq(today.size(), old.size() + 16);
    const Sample from_old = read(old, 7), from_today = read(today, 8);
    for (const Sample& sample : {from_old, from_today}) {
        ck_assert_double_eq(sample.first, 2.0);
        ck_assert_uint_eq(sample.list.size(), 2);
        ck_assert_double_eq(sample.list[1], 5.0);
        ck_assert_int_eq(sample.part.count, 6);
        ck_assert(sample.derived);  // never saved
    }
    ck_assert_double_eq(from_old.part.late, 0.25);
    ck_assert_double_eq(from_old.added, -7.5);
    ck_assert_double_eq(from_today.part.late, 0.5);
    ck_assert_double_eq(from_today.added, 9.0);
}

TEST(short_bytes_are_refused) {
    const auto whole = written(changed(), 8);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        Reader reader(std::span<const std::uint8_t>(whole).first(size), 8);
        Sample sample;
        ck_assert_refused(DELAM_ERROR_SNAPSHOT, "ends early", walk(reader, sample, rows));
    }
    // A size without its numbers takes no memory.
    std::vector<std::uint8_t> huge;
    append(huge, std::uint64_t{1} << 60);
    Reader reader(huge, 7);
    ck_assert_refused(DELAM_ERROR_SNAPSHOT, "", read_list<JumpEvent>(reader));
}

// Members that bytes of an older version do not have are not checked.
TEST(members_keep_the_rule_of_their_rows) {
    const auto sound = [](const Sample& sample, std::uint32_t version) {
        Sound found(version);
        found.compare(sample, changed());
        return std::pair(found.sizes, found.numbers);
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    ck_assert(sound({2.0, {4.0, 5.0}, {6, infinite}, 9.0, false}, 8) == std::pair(true, true));
    ck_assert(sound({2.0, {4.0, 5.0}, {6, nan}, 9.0, false}, 8) == std::pair(true, false));
    ck_assert(sound({2.0, {4.0, 5.0}, {6, nan}, nan, false}, 7) == std::pair(true, true));
    ck_assert(sound({2.0, {4.0, 5.0}, {6, 0.5}, infinite, false}, 8) == std::pair(true, false));
    ck_assert(sound({2.0, {4.0, nan}, {6, 0.5}, 9.0, false}, 5) == std::pair(true, false));
    ck_assert(sound({2.0, {4.0}, {6, 0.5}, 9.0, false}, 8) == std::pair(false, true));
}

// The formats 5 to 7 hold these numbers in this order, whatever becomes of the structs.
TEST(bytes_keep_their_order) {
    Ledger l;
    double energy = 0.5;
    std::vector<std::uint8_t> expected;
    for (double* v : {&l.stored_bulk, &l.stored_interface, &l.load_potential, &l.stored_interface_linear, &l.dissipated,
                      &l.dissipated_linear, &l.work, &l.lower, &l.increment, &l.upper, &l.increment_lower, &l.initial,
                      &l.initial_linear, &l.mixity_error})
        append(expected, *v = energy += 1.0);
    ck_assert(bytes_of(l) == expected);

    // Effort, outcome and history are the end of a state.
    State state;
    std::int64_t count = 100;
    expected.clear();
    for (std::int64_t* v :
         {&state.effort.am_iterations, &state.effort.displacement_solves, &state.effort.contact_iterations,
          &state.effort.contact_iterations_first, &state.effort.contact_iterations_max, &state.effort.contact_fallbacks,
          &state.effort.linear_iterations, &state.effort.newton_solves, &state.effort.debond_moves,
          &state.outcome.mixity_held, &state.history.backtracks, &state.history.revisions, &state.history.revised_from,
          &state.effort.search_candidates})
        append(expected, *v = ++count);
    for (double* v : {&state.outcome.search_margin, &state.outcome.search_gap}) append(expected, *v = energy += 1.0);
    for (std::int64_t* v : {&state.history.substeps, &state.history.refused_steps, &state.outcome.jumps})
        append(expected, *v = ++count);
    for (double* v : {&state.outcome.released, &state.outcome.damage_change, &state.effort.linear_residual})
        append(expected, *v = energy += 1.0);
    const std::vector<std::uint8_t> bytes = bytes_of(state);
    ck_assert_uint_gt(bytes.size(), expected.size());
    ck_assert(std::equal(expected.begin(), expected.end(), bytes.end() - static_cast<std::ptrdiff_t>(expected.size())));

    JumpEvent j{};
    expected.clear();
    append(expected, j.step = ++count);
    for (double* v : {&j.before, &j.time, &j.stored, &j.dissipated, &j.released, &j.debonded})
        append(expected, *v = energy += 1.0);
    for (std::int64_t* v : {&j.interface, &j.first_pair, &j.last_pair}) append(expected, *v = ++count);
    ck_assert(bytes_of(j) == expected);
}
