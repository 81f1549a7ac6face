// SPDX-License-Identifier: BSD-3-Clause
// Every row of the tables of a saved state, by walking them: an array of another size and a number that is not finite
// are refused, unless the row allows them, and leave the solver as it was.
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "check.hpp"
#include "evolution/analysis/snapshot.hpp"
#include "evolution/increment/state_fields.hpp"
#include "flexure.hpp"

using namespace delam;

namespace {

constexpr std::uint32_t version = 8;
// Magic, version, hash of the scene and the number of changed histories, which is zero.
constexpr std::size_t head = 8 + 4 + 8 + 8;

// Visits the saved members of one kind in their order, and damages one of them.
class Damage {
public:
    explicit Damage(std::size_t target) : target_(target) {}
    const void* hit = nullptr;  // the member

    static constexpr std::uint32_t version() { return ::version; }

protected:
    bool here(const void* member) {
        if (at_++ != target_) return false;
        hit = member;
        return true;
    }

private:
    std::size_t target_, at_ = 0;
};

class OtherNumber : public Damage {
public:
    OtherNumber(std::size_t target, double number) : Damage(target), number_(number) {}
    void item(double& v) {
        if (here(&v)) v = number_;
    }
    void item(std::vector<double>& v) {
        if (!v.empty() && here(&v)) v.back() = number_;
    }
    template <class T>
    void item(T& /*v*/) {}

private:
    double number_;
};

class OtherSize : public Damage {
public:
    OtherSize(std::size_t target, bool longer) : Damage(target), longer_(longer) {}
    template <class T>
    void item(std::vector<T>& v) {
        if (!here(&v)) return;
        if (longer_)
            v.push_back(T{});
        else if (!v.empty())
            v.pop_back();
        else
            hit = nullptr;
    }
    template <class T>
    void item(T& /*v*/) {}

private:
    bool longer_;
};

struct Saved {
    Problem problem;
    Monitor monitor;
    Solver solver;
    std::vector<std::uint8_t> bytes, behind;  // behind: the state, without the checksum
    State state;

    explicit Saved(const char* reduction) : problem(small(reduction)), solver(problem, monitor, 0.0) {
        ck_assert_int_eq(solver.advance(0.1).status, 0);
        solver.commit();
        bytes = save(solver);
        Reader reader(std::span<const std::uint8_t>(bytes).subspan(head), version);
        walk(reader, state);
        const auto left = static_cast<std::ptrdiff_t>(reader.left());
        behind.assign(bytes.end() - left, bytes.end() - 8);
    }
    static Problem small(const char* reduction) {
        unit::Flexure f;
        f.along = 20;
        f.through = 1;
        Problem made = unit::make_flexure(f);
        made.options.reduction = reduction;
        return made;
    }
    // The message of the refusal, "" if there is none; the bytes have a true checksum.
    std::string refusal(const State& changed) {
        Writer writer(version);
        writer.bytes.assign(bytes.begin(), bytes.begin() + head);
        walk(writer, changed);
        writer.bytes.insert(writer.bytes.end(), behind.begin(), behind.end());
        writer.item(checksum(writer.bytes));
        try {
            load(solver, writer.bytes);
        } catch (const Error& error) {
            ck_assert_int_eq(error.status(), DELAM_ERROR_SNAPSHOT);
            ck_assert(save(solver) == bytes);
            return error.what();
        }
        return "";
    }
};

constexpr const char* reductions[] = {"condensed", "feti"};

}  // namespace

LOOP_TEST(numbers_that_are_not_finite, 0, 2) {
    Saved saved(reductions[loop]);
    ck_assert(saved.refusal(saved.state).empty());
    constexpr double inf = std::numeric_limits<double>::infinity();
    for (const double number : {inf, -inf, std::numeric_limits<double>::quiet_NaN()}) {
        std::size_t count = 0;
        while (true) {
            State changed = saved.state;
            OtherNumber damage(count, number);
            walk(damage, changed);
            if (damage.hit == nullptr) break;
            ++count;
            const bool may = damage.hit == &changed.outcome.search_gap && number == number;
            const std::string refusal = saved.refusal(changed);
            ck_assert_msg(refusal.empty() == may, "number %zu is %g: '%s'", count, number, refusal.c_str());
            if (may) ck_assert(saved.refusal(saved.state).empty());
        }
        ck_assert_uint_ge(count, 25);
    }
}

LOOP_TEST(arrays_of_other_sizes, 0, 2) {
    Saved saved(reductions[loop]);
    for (const bool longer : {true, false}) {
        std::size_t count = 0;
        for (std::size_t target = 0; target < 40; ++target) {
            State changed = saved.state;
            OtherSize damage(target, longer);
            walk(damage, changed);
            if (damage.hit == nullptr || damage.hit == &changed.memory || damage.hit == &changed.search_memory)
                continue;
            ++count;
            const std::string refusal = saved.refusal(changed);
            ck_assert_msg(refusal.find("other sizes") != std::string::npos, "array %zu: '%s'", target, refusal.c_str());
        }
        ck_assert_uint_ge(count, 8);
    }
}
