// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "base/archive.hpp"
#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/increment/state_fields.hpp"
#include "evolution/observe/values.hpp"
#include "evolution/step/jump_event_fields.hpp"

namespace delam {

namespace {

constexpr std::uint64_t magic = 0x31305453'4d4c4544;  // "DELMST01" in memory on a little-endian machine
// 5: the first that was ever published. 6: histories of patterns that the host has changed. 7: recorded values. 8:
// released energy in the ledger. 10: another zone of the condensed operator, which begins anew after an older version.
// 11: energies of candidates for the next search. 12: since when bodies are free. 13: how the growth of a step went on.
// 14: what its single pairs released. 15: whether its steps are taken whole. 16: jumps before the last part of a step.
// 17: where the bodies of a step have buckled. 18: shares of the second shear. 19: which
// state was judged last for its rotations. 20: how far displacements relieve them.
constexpr std::uint32_t version = since_rotation_relief, oldest = 5;
constexpr std::int64_t most_steps = std::int64_t{1} << 53;
// Hash and checksum of a larger file are compared piece by piece, before memory is taken for all of it.
constexpr std::uint64_t largest_unchecked = std::uint64_t{1} << 20;

void forget_zones(State& state) {
    state.memory.clear();
    state.search_memory.clear();
}

// Every member must be as its row says, and every number one that an analysis can produce.
void check(const State& state, const Solver& solver, std::uint32_t found_version) {
    Sound sound(found_version);
    sound.compare(state, solver.states().committed());
    const std::size_t last = state.jump_before.size();
    if (!sound.sizes || (last != 0 && last != state.response.jump.size()))
        fail(DELAM_ERROR_SNAPSHOT, "snapshot has arrays of other sizes than this solver");
    for (const auto* fractions : {&state.adhesion, &state.mixity.shear, &state.mixity.second,
                                  &state.mixity_before.shear, &state.mixity_before.second})
        for (const double v : *fractions)
            if (!(v >= 0.0 && v <= 1.0))
                fail(DELAM_ERROR_SNAPSHOT, "snapshot holds an adhesion or mixity of ", v, ", allowed: 0 to 1");
    if (!std::isfinite(state.time)) fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a time of ", state.time);
    if (!sound.numbers)
        fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a number of step ", state.step, " that is not finite");
    if (state.step < 0 || state.step > most_steps)
        fail(DELAM_ERROR_SNAPSHOT, "snapshot holds step ", state.step, ", allowed: 0 to 2^53");
    solver.stepper().op().require_memory(state.memory);
    solver.stepper().op().require_memory(state.search_memory);  // of its twin
}

void check(const JumpEvent& jump, const Solver& solver, std::uint32_t found_version) {
    const auto& interfaces = solver.problem().mesh->interfaces();
    const bool named = jump.interface >= 0 && jump.interface < static_cast<std::int64_t>(interfaces.size());
    const std::int64_t pairs = named ? interfaces[index(jump.interface)].pair_count() : 0;
    const bool sound = named && jump.first_pair >= -1 && jump.first_pair < pairs && jump.last_pair >= -1 &&
                       jump.last_pair < pairs && jump.step >= 0 && jump.before <= jump.time;
    const std::size_t patterns = found_version >= 9 ? solver.problem().patterns.size() : 0;
    if (jump.conjugate_before.size() != patterns || jump.conjugate_after.size() != patterns)
        fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a jump with the reactions of ", jump.conjugate_before.size(),
             " and ", jump.conjugate_after.size(), " patterns, this scene has ", solver.problem().patterns.size());
    Sound finite(version);
    finite.compare(jump, jump);
    if (!sound || !finite.numbers)
        fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a jump at time ", jump.time, " of interface ", jump.interface,
             ", pairs ", jump.first_pair, " to ", jump.last_pair, ", which this scene cannot have");
}

// Histories that the host has changed since the solver was made: pattern, times, values.
void write_histories(Writer& w, const Solver& solver) {
    std::vector<std::int64_t> changed;
    for (std::size_t p = 0; p < solver.first_patterns().size(); ++p) {
        const Pattern &first = solver.first_patterns()[p], &now = solver.problem().patterns[p];
        if (now.times != first.times || now.values != first.values) changed.push_back(static_cast<std::int64_t>(p));
    }
    w.item(static_cast<std::uint64_t>(changed.size()));
    for (const std::int64_t p : changed) {
        const Pattern& pattern = solver.problem().patterns[index(p)];
        w.item(p);
        w.item(pattern.times);
        w.item(pattern.values);
    }
}

std::vector<Pattern> read_histories(Reader& r, std::vector<Pattern> patterns) {
    std::uint64_t changed = 0;
    r.item(changed);
    std::int64_t last = -1;
    for (std::uint64_t i = 0; i < changed; ++i) {
        std::int64_t p = 0;
        r.item(p);
        if (p <= last || p >= static_cast<std::int64_t>(patterns.size()))
            fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a history of pattern ", p, ", this scene has ", patterns.size());
        last = p;
        Pattern& pattern = patterns[index(p)];
        r.item(pattern.times);
        r.item(pattern.values);
        bool sound = !pattern.times.empty() && pattern.times.size() == pattern.values.size();
        for (std::size_t k = 0; sound && k < pattern.times.size(); ++k)
            sound = std::isfinite(pattern.times[k]) && std::isfinite(pattern.values[k]) &&
                    (k == 0 || pattern.times[k] > pattern.times[k - 1]);
        if (!sound)
            fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a history of pattern '", pattern.name,
                 "' whose times do not increase");
    }
    return patterns;
}

// Recorded values: first step, then keys with their columns.
void write_record(Writer& w, const Record& record) {
    w.item(static_cast<std::uint64_t>(record.columns().size()));
    w.item(record.first());
    for (const Record::Column& column : record.columns()) {
        w.item(std::vector<char>(column.key.begin(), column.key.end()));
        w.item(column.values);
    }
}

Record read_record(Reader& r, const Solver& solver) {
    std::uint64_t columns = 0;
    std::int64_t first = 0;
    r.item(columns);
    r.item(first);
    Record record;
    const std::vector<std::string> names = value_names(solver.problem());
    for (std::uint64_t i = 0; i < columns; ++i) {
        std::vector<char> letters;
        std::vector<double> values;
        r.item(letters);
        r.item(values);
        const std::string key(letters.begin(), letters.end());
        if (std::find(names.begin(), names.end(), key) == names.end() || why_unrecorded(key) != nullptr ||
            record.find(key) != nullptr)
            fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a record of '", key,
                 "', which is not a value that this solver records, or occurs twice");
        record.add({key, std::move(values)}, first);
    }
    if (columns == 0 && first != 0)
        fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a record from step ", first, " on that has no values");
    return record;
}

// One row for every step from the first to that of the state.
void check(const Record& record, const State& state) {
    for (const Record::Column& column : record.columns())
        if (record.first() < 0 || record.first() > state.step ||
            static_cast<std::int64_t>(column.values.size()) != state.step - record.first() + 1)
            fail(DELAM_ERROR_SNAPSHOT, "snapshot holds ", column.values.size(), " recorded values of '", column.key,
                 "' from step ", record.first(), " on, but its state is of step ", state.step);
}

// Reads the head of bytes that begin as those of this library do, in any version that it reads.
std::uint32_t read_head(Reader& r) {
    std::uint64_t found_magic = 0;
    std::uint32_t found_version = 0;
    r.item(found_magic);
    if (found_magic != magic) fail(DELAM_ERROR_SNAPSHOT, "not a snapshot of a libdelam solver");
    r.item(found_version);
    if (found_version < oldest || found_version > version)
        fail(DELAM_ERROR_SNAPSHOT, "snapshot version ", found_version, ", this library reads ", oldest, " to ",
             version);
    return found_version;
}

// For complete bytes that this library has written.
std::uint32_t read_version(std::span<const std::uint8_t> bytes) {
    Reader r(bytes, version);
    std::uint64_t found_sum = 0;
    const std::uint32_t found_version = read_head(r);
    if (r.left() < sizeof(found_sum)) fail(DELAM_ERROR_SNAPSHOT, "snapshot ends early");
    const auto checked = bytes.first(bytes.size() - sizeof(found_sum));
    std::memcpy(&found_sum, bytes.data() + checked.size(), sizeof(found_sum));
    if (found_sum != checksum(checked))
        fail(DELAM_ERROR_SNAPSHOT, "snapshot is damaged: its checksum does not match its ", bytes.size(), " bytes");
    return found_version;
}

// A file of this scene and undamaged, with memory for one piece of it. r: behind magic and version.
void require_whole(const InputFile& file, Reader& r, std::uint64_t hash) {
    std::uint64_t found = 0;
    r.item(found);
    if (found != hash)
        fail(DELAM_ERROR_SNAPSHOT, "snapshot of ", file.size(),
             " bytes belongs to another scene or other options (its hash differs), or is damaged");
    const std::uint64_t checked = file.size() - sizeof(found);
    std::uint64_t sum = checksum_start;
    for (std::uint64_t at = 0; at < checked; at += largest_unchecked) {
        poll_cancel_now("load");
        sum = checksum(file.read(at, std::min(largest_unchecked, checked - at)), sum);
    }
    const std::vector<std::uint8_t> last = file.read(checked, sizeof(found));
    if (last.size() == sizeof(found)) std::memcpy(&found, last.data(), sizeof(found));
    if (last.size() != sizeof(found) || found != sum)
        fail(DELAM_ERROR_SNAPSHOT, "snapshot is damaged: its checksum does not match its ", file.size(), " bytes");
}

// Scenes without stages save none: their states are as they were before there was such a thing.
void write_stage(Writer& w, const Solver& solver) {
    if (solver.stage() == nullptr) return;
    const Stage& stage = solver.stage()->stage;
    w.item(stage.from);
    w.item(stage.offset);
    w.item(stage.force);
    if (may_turn(*solver.stage()->whole)) w.item(std::uint64_t{stage.rotates});
}

// A state with small rotations may go on where they may become large, and the other way round.
std::optional<Stage> read_stage(Reader& r, const Solver& solver) {
    const StageOf* own = solver.stage();
    const Problem& whole = own != nullptr ? *own->whole : solver.problem();
    const bool turns = r.version() >= since_rotation_checks;  // the scene of the state has kinematics = auto
    if (!turns && own == nullptr) return {};
    Stage stage;
    if (!turns && changes_of(whole).empty()) {
        stage = own->stage;
        stage.rotates = false;
        return stage;
    }
    r.item(stage.from);
    r.item(stage.offset);
    r.item(stage.force);
    std::uint64_t rotates = 0;
    if (turns) r.item(rotates);
    stage.rotates = rotates != 0;
    if (stage.rotates && !may_turn(whole))
        fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a state with large rotations (kinematics = auto), this scene has ",
             "kinematics = ", whole.options.kinematics);
    const auto sound = [&](const std::vector<double>& values, auto member) {
        bool all = values.size() == whole.constraints.size();
        for (std::size_t c = 0; all && c < values.size(); ++c) {
            const auto& change = whole.constraints[c].*member;
            all = std::isfinite(values[c]) && (values[c] == 0.0 || (change && change->time <= stage.from));
        }
        return all;
    };
    const std::vector<double> changes = changes_of(whole);
    const bool begins = std::find(changes.begin(), changes.end(), stage.from) != changes.end();
    if (!std::isfinite(stage.from) || !sound(stage.offset, &Constraint::begin) ||
        !sound(stage.force, &Constraint::end) || (max_abs(stage.offset) + max_abs(stage.force) > 0.0 && !begins) ||
        rotates > 1)
        fail(DELAM_ERROR_SNAPSHOT, "snapshot holds supports from time ", stage.from,
             " on, which this scene cannot have");
    return own != nullptr ? std::optional(std::move(stage)) : std::nullopt;
}

// Reads what stands before the histories in complete bytes of this scene.
void skip_head(Reader& r, const Solver& solver) {
    std::uint64_t found_magic = 0, found_hash = 0;
    std::uint32_t again = 0;
    r.item(found_magic);
    r.item(again);
    r.item(found_hash);
    if (found_hash != solver.scene_hash())
        fail(DELAM_ERROR_SNAPSHOT, "snapshot belongs to another scene or other options (its hash differs)");
}

// Returns the first version that holds all there is to save, so that libraries which know no later one read it.
std::uint32_t version_for(const Solver& solver) {
    if (solver.stage() != nullptr && may_turn(*solver.stage()->whole)) return since_rotation_relief;
    return solver.stepper().pairs().two_shears() ? since_second_shares : since_second_shares - 1;
}

}  // namespace

std::vector<std::uint8_t> save(const Solver& solver) {
    Writer w(version_for(solver));
    w.item(magic);
    w.item(w.version());
    w.item(solver.scene_hash());
    write_stage(w, solver);
    write_histories(w, solver);
    walk(w, solver.states().committed());
    write_list(w, solver.states().past());
    write_list(w, solver.states().committed_jumps());
    write_record(w, solver.recorded());
    w.item(checksum(w.bytes));
    return w.bytes;
}

void load(Solver& solver, std::span<const std::uint8_t> bytes) {
    const std::uint32_t found_version = read_version(bytes);
    Reader r(bytes, found_version);
    skip_head(r, solver);
    (void)read_stage(r, solver);
    std::vector<Pattern> patterns = solver.first_patterns();
    if (found_version >= 6) patterns = read_histories(r, std::move(patterns));
    State state;
    walk(r, state);
    std::vector<State> past = read_list<State>(r);
    std::vector<JumpEvent> jumps = read_list<JumpEvent>(r);
    Record record;
    if (found_version >= 7) record = read_record(r, solver);
    if (found_version < 10 && solver.stepper().design().bulk != nullptr) {
        forget_zones(state);
        for (State& earlier : past) forget_zones(earlier);
    }
    if (r.left() != sizeof(std::uint64_t)) fail(DELAM_ERROR_SNAPSHOT, "snapshot has ", r.left(), " bytes too many");
    check(state, solver, found_version);
    std::int64_t step = state.step - static_cast<std::int64_t>(past.size());
    for (const State& earlier : past) {
        check(earlier, solver, found_version);
        if (earlier.step != step++)
            fail(DELAM_ERROR_SNAPSHOT, "snapshot holds step ", earlier.step, " instead of ", step - 1);
    }
    for (std::size_t i = 0; i < past.size(); ++i)
        if (const double next = i + 1 < past.size() ? past[i + 1].time : state.time; !(past[i].time < next))
            fail(DELAM_ERROR_SNAPSHOT, "snapshot holds step ", past[i].step, " at time ", past[i].time,
                 ", the step after it at ", next);
    for (const JumpEvent& jump : jumps) check(jump, solver, found_version);
    check(record, state);
    solver.restore(std::move(state), std::move(past), std::move(jumps), std::move(patterns), std::move(record));
}

std::vector<std::uint8_t> read_snapshot(const Solver& solver, const std::string& path) {
    const InputFile file(path);
    const std::vector<std::uint8_t> head = file.read(0, 2 * sizeof(std::uint64_t) + sizeof(std::uint32_t));
    Reader r(head, version);
    (void)read_head(r);
    if (file.size() > largest_unchecked) require_whole(file, r, solver.scene_hash());
    return file.read(0, file.size());
}

std::optional<Stage> stage_in(const Solver& solver, std::span<const std::uint8_t> bytes) {
    Reader r(bytes, read_version(bytes));
    skip_head(r, solver);
    return read_stage(r, solver);
}

}  // namespace delam
