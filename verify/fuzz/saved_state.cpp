// SPDX-License-Identifier: BSD-3-Clause
// Corrupted saved states. An input names a scene, a number of steps, and changes to the bytes that the solver then
// saves, so that it means the same in every version of the format. The checksum may then be corrected, so that the rest
// of the bytes is read. The library must refuse the state by name and change nothing, or accept it and treat it like
// any other. Alternatively an input is a scene of its own, whose analysis is continued from each of its states in
// several solvers.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "contract.hpp"
#include "input.hpp"
#include "small_scene.hpp"

namespace {

using namespace fuzz;
using Bytes = std::vector<std::uint8_t>;

// A scene with the states that its analysis saved, and the results that follow each state.
class Analysis {
public:
    explicit Analysis(const Bytes& recipe) {
        Input in(recipe.data(), recipe.size());
        SmallScene scene = small_scene(host_, in);
        expect(delam_solver_create(scene.problem, 0.0, &solver_) >= 0, "an analysis begins", "delam_solver_create");
        destroy(scene);
        expect(solver_ != nullptr, "an analysis begins", "delam_solver_create");
        for (const char* key : {"time", "front", "energy_release_rate"})
            expect(delam_solver_record(solver_, key) == DELAM_OK, "values are recorded", "delam_solver_record");
        states_.push_back(saved(solver_));
        for (std::size_t step = 1; step <= steps; ++step) {
            host_.polls_left = 40000;
            expect(goes_on(step), "an analysis goes on", "delam_solver_advance");
            delam_solver_commit(solver_);
            states_.push_back(saved(solver_));
        }
        for (const Bytes& bytes : states_)
            expect(with_checksum(bytes) == bytes, "the checksum is the library's", "with_checksum");
    }
    ~Analysis() { delam_solver_destroy(&solver_); }
    Analysis(const Analysis&) = delete;
    Analysis& operator=(const Analysis&) = delete;

    static constexpr std::size_t steps = 4;
    const Bytes& state(std::size_t step) const { return states_[step]; }

    void try_load(const Bytes& bytes, bool put_right) {
        host_.polls_left = 4000;
        const std::string before = print_of(solver_);
        host_.begin();
        const std::int32_t status = delam_solver_load(solver_, static_cast<std::int64_t>(bytes.size()), bytes.data());
        host_.settle("delam_solver_load", status, may::cancelled | may::argument | may::numerical | may::snapshot);
        if (status != DELAM_OK) {
            expect(print_of(solver_) == before, "what is refused changes nothing", "delam_solver_load");
            return;
        }
        const auto own = std::find(states_.begin(), states_.end(), bytes);
        expect(own != states_.end() || put_right, "bytes that were changed are refused", "delam_solver_load");
        // The bytes of an earlier version are saved in the present one.
        const Bytes again = saved(solver_);
        expect(again == bytes || !std::equal(again.begin(), again.begin() + 12, bytes.begin()),
               "a state is saved as it was loaded", "delam_solver_save");
        read_everything();
        const auto found = static_cast<std::size_t>(own - states_.begin());
        if (own == states_.end())
            go_on_from_anywhere();
        else if (found < steps)
            go_on_from(found);
        // Continuing from another state must leave nothing behind that affects the next.
        const std::size_t next = (own == states_.end() ? bytes.size() : found + 1) % steps;
        host_.polls_left = 4000;  // an analysis from other bytes may have been cancelled
        expect(delam_solver_load(solver_, static_cast<std::int64_t>(states_[next].size()), states_[next].data()) ==
                   DELAM_OK,
               "another state can be loaded afterwards", "delam_solver_load");
        go_on_from(next);
    }

private:
    bool goes_on(std::size_t step) {
        const std::int32_t status = delam_solver_advance(solver_, 0.25 * static_cast<double>(step));
        return status == DELAM_OK || status == DELAM_NOT_CONVERGED;
    }
    void go_on_from(std::size_t step) {
        host_.polls_left = 40000;
        expect(goes_on(step + 1), "an analysis goes on", "delam_solver_advance");
        delam_solver_commit(solver_);
        expect(saved(solver_) == states_[step + 1], "the rest is bitwise the same", "delam_solver_load");
    }

    // No analysis may ever reach the values and fields of such a state; reading them must do no harm.
    void read_everything() {
        std::int64_t values = 0, jumps = 0, fronts = 0, points = 0;
        double value = 0.0;
        delam_solver_value_count(solver_, &values);
        for (std::int64_t i = 0; i < values; ++i) {
            host_.begin();
            const std::string key = delam_solver_value_name(solver_, i);
            host_.settle(key.c_str(), delam_solver_value(solver_, key.c_str(), &value), may::problem);
        }
        for (const char* key :
             {"displacement", "stress", "rotation", "jump", "traction", "adhesion", "mixity", "contact", "reaction"}) {
            std::int64_t rows = 0, columns = 0;
            delam_solver_field_shape(solver_, key, -1, &rows, &columns);
            std::vector<double> field(static_cast<std::size_t>(rows * columns));
            host_.begin();
            host_.settle(key, delam_solver_field(solver_, key, -1, rows * columns, field.data()), may::argument);
        }
        std::int64_t first = 0, steps_recorded = 0;
        delam_solver_recorded_size(solver_, &first, &steps_recorded);
        std::vector<double> recorded(static_cast<std::size_t>(steps_recorded));
        for (const char* key : {"time", "front", "energy_release_rate"}) {
            host_.begin();
            host_.settle(key, delam_solver_recorded(solver_, key, steps_recorded, recorded.data()), may::argument);
        }
        delam_solver_jump_count(solver_, &jumps);
        for (std::int64_t i = 0; i < jumps; ++i)
            expect(delam_solver_jump(solver_, i, nullptr, nullptr, &value, nullptr, nullptr, nullptr, nullptr, nullptr,
                                     nullptr, nullptr) == DELAM_OK,
                   "jumps can be read", "delam_solver_jump");
        host_.begin();
        host_.settle("delam_solver_front_count", delam_solver_front_count(solver_, 0, &fronts, &points),
                     may::argument | may::problem);
        for (std::int64_t step = -1; step < static_cast<std::int64_t>(Analysis::steps); ++step) {
            host_.begin();
            host_.settle("delam_solver_look", delam_solver_look(solver_, step), may::argument);
        }
        expect(delam_solver_look(solver_, -1) == DELAM_OK, "back to the present", "delam_solver_look");
    }

    void go_on_from_anywhere() {
        double time = 0.0;
        delam_solver_value(solver_, "time", &time);
        for (const double next : {time + 0.25, 1.0}) {
            host_.begin();
            const std::int32_t status = delam_solver_advance(solver_, next);
            host_.settle("delam_solver_advance", status,
                         may::not_converged | may::cancelled | may::limit | may::argument | may::problem | may::state |
                             may::numerical);
            if (status == DELAM_OK || status == DELAM_NOT_CONVERGED) {
                expect(delam_solver_rollback(solver_) == DELAM_OK, "what is pending can be thrown away",
                       "delam_solver_rollback");
            }
        }
    }

    Host host_;
    delam_solver* solver_ = nullptr;
    std::vector<Bytes> states_;
};

// Bytes of small_scene: a bilinear peel; brittle, with jumps and kept steps; FETI; a gradient; a search in space.
Analysis& analyse(std::size_t which) {
    static const Bytes recipes[] = {
        {0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0},           {0, 0, 0, 4, 4, 0, 0, 0, 0, 1, 1, 0, 0, 3, 1, 14, 16},
        {0, 0, 1, 3, 1, 1, 1, 0, 0, 1, 0, 1, 0, 0, 2, 3, 18}, {0, 2, 0, 4, 0, 0, 0, 15, 0, 0, 1, 0, 0, 1, 14},
        {7, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 0},
    };
    static std::unique_ptr<Analysis> analyses[std::size(recipes)];
    std::unique_ptr<Analysis>& found = analyses[which % std::size(recipes)];
    if (found == nullptr) found = std::make_unique<Analysis>(recipes[which % std::size(recipes)]);
    return *found;
}

// A solver of any small scene.
class Walker {
public:
    Walker(const Bytes& recipe, bool energetic) {
        Input in(recipe.data(), recipe.size());
        SmallScene scene = small_scene(host_, in);
        if (energetic) delam_problem_set_text(scene.problem, "solution", "energetic");
        delam_solver_create(scene.problem, 0.0, &solver_);
        destroy(scene);
    }
    ~Walker() { delam_solver_destroy(&solver_); }
    Walker(const Walker&) = delete;
    Walker& operator=(const Walker&) = delete;

    delam_solver* solver() const { return solver_; }
    bool goes_on(std::size_t step) {
        const std::int32_t status = delam_solver_advance(solver_, 0.25 * static_cast<double>(step));
        if (status != DELAM_OK && status != DELAM_NOT_CONVERGED) return false;
        delam_solver_commit(solver_);
        return true;
    }
    bool out_of_polls() const { return host_.polls_left <= 0; }

private:
    Host host_;  // its limit of polls holds for all that this solver does
    delam_solver* solver_ = nullptr;
};

// Continues from each state of an analysis with a new solver and with the one that reached the state.
void any_analysis(Input& in) {
    const bool energetic = in.flag();
    const Bytes recipe = in.rest();
    Walker first(recipe, energetic);
    if (first.solver() == nullptr) return;
    std::vector<Bytes> states{saved(first.solver())};
    while (states.size() <= Analysis::steps && first.goes_on(states.size())) states.push_back(saved(first.solver()));
    for (std::size_t from = 0; from + 1 < states.size(); ++from) {
        Walker anew(recipe, energetic);
        for (Walker* walker : {&anew, &first}) {
            const Bytes& bytes = states[from];
            if (delam_solver_load(walker->solver(), static_cast<std::int64_t>(bytes.size()), bytes.data()) !=
                    DELAM_OK ||
                !walker->goes_on(from + 1)) {
                expect(walker->out_of_polls(), "a state is read and gone on from", "delam_solver_load");
                continue;
            }
            expect(saved(walker->solver()) == states[from + 1], "the rest is bitwise the same", "delam_solver_load");
        }
    }
}

void put(Bytes& bytes, std::size_t at, const void* value, std::size_t size) {
    if (at + size <= bytes.size()) std::memcpy(bytes.data() + at, value, size);
}

void tamper(Bytes& bytes, Input& in) {
    while (!in.empty()) {
        const std::uint8_t how = in.byte();
        const std::size_t at = bytes.empty() ? 0 : in.raw<std::uint16_t>() % bytes.size();
        switch (how % 8) {
            case 0:
                put(bytes, at, &how, 1);
                break;
            case 1:
                if (!bytes.empty()) bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1u << in.below(8)));
                break;
            case 2: {
                const double value = in.hostile_real();
                put(bytes, at & ~std::size_t{3}, &value, sizeof value);
                break;
            }
            case 3: {
                const std::int64_t value = in.hostile_whole();
                put(bytes, at & ~std::size_t{3}, &value, sizeof value);
                break;
            }
            case 4:
                bytes.resize(at);
                break;
            case 5: {
                const std::size_t count = in.byte() % 33u;
                bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, in.byte());
                break;
            }
            case 6: {
                const std::size_t count = std::min<std::size_t>(in.byte(), bytes.size() - at);
                bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                            bytes.begin() + static_cast<std::ptrdiff_t>(at + count));
                break;
            }
            case 7: {
                const double value = in.signed_real();
                put(bytes, at & ~std::size_t{3}, &value, sizeof value);
                break;
            }
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Input in(data, size);
    const std::uint8_t which = in.byte();
    if (which >= 250) {
        any_analysis(in);
        return 0;
    }
    Analysis& mine = analyse(which);
    const std::uint8_t how = in.byte();
    Bytes bytes = mine.state(how % (Analysis::steps + 1));
    bool put_right = false;
    switch (in.byte() % 8) {
        case 0:
            bytes = in.rest();
            break;  // unchanged
        case 1:
            bytes = analyse(in.byte()).state(how % (Analysis::steps + 1));
            break;  // from another scene
        case 2:
        case 3:
            tamper(bytes, in);
            break;
        default:
            tamper(bytes, in);
            bytes = with_checksum(std::move(bytes));
            put_right = true;
    }
    mine.try_load(bytes, put_right);
    return 0;
}
