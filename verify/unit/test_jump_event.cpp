// SPDX-License-Identifier: BSD-3-Clause
// A step counts as a jump of an interface whose front moves by more than one row of its pairs, whatever the fronts of
// other interfaces do.
#include <vector>

#include "check.hpp"
#include "evolution/step/jump_event.hpp"
#include "law/law.hpp"

using namespace delam;

namespace {

constexpr std::int64_t interfaces = 6, length = 10;  // pairs of an interface

InterfaceGeometry line() {
    InterfaceGeometry g;
    g.body_a = 0;
    g.body_b = 1;
    for (std::int64_t p = 0; p < length; ++p) {
        g.node_a.push_back(p);
        g.node_b.push_back(length + p);
        g.weight.push_back(1.0);
        if (p > 0) g.face.insert(g.face.end(), {p - 1, p});
    }
    return g;
}

// Fronts behind the first three pairs of each interface, which move on by so many pairs.
struct Step {
    std::vector<InterfaceGeometry> geometry{interfaces, line()};
    PairGraph graph{geometry};
    Law law;
    PairLaws pairs;
    State before, after;

    explicit Step(const std::vector<std::int64_t>& advances) {
        pairs.law.assign(interfaces * length, &law);
        pairs.weight.assign(interfaces * length, 1.0);
        for (const std::int64_t advance : advances)
            for (std::int64_t p = 0; p < length; ++p) {
                before.adhesion.push_back(p < 3 ? 0.0 : 1.0);
                after.adhesion.push_back(p < 3 + advance ? 0.0 : 1.0);
            }
        for (State* state : {&before, &after}) {
            state->theta = {1.0};
            state->response.conjugate = {state == &before ? 1.0 : 0.9};
        }
        after.ledger.work = 1.0;
        after.outcome.released = 0.1;
    }
    void within(std::int64_t interface, double advance) {
        after.jump_within.known = 1;
        after.jump_within.drop = 0.1;
        after.jump_within.released = 0.1;
        after.jump_within.interface = interface;
        after.jump_within.debonded = advance;
        after.jump_within.conjugate_before = {1.5};
        after.jump_within.conjugate_after = {1.25};
        after.jump_within.load = 1.0;
    }
    bool jumps() const { return delam::jumps(pairs, graph, before, after); }
};

}  // namespace

TEST(fronts_of_other_interfaces_do_not_hide_a_jump) {
    Step regular({1, 1, 1, 1, 1, 1}), one({1, 1, 1, 1, 1, 4});
    ck_assert(!regular.jumps());
    ck_assert(one.jumps());
    one.within(5, 4.0);
    ck_assert(one.jumps());
    one.within(5, 1.0);
    ck_assert(!one.jumps());
    one.after.jump_within.debonded = 3.0;  // together with other interfaces
    ck_assert(one.jumps());
}

TEST(reactions_are_those_of_the_instant) {
    Step step({0, 0, 0, 0, 0, 4});
    const JumpEvent whole = describe_jump(step.pairs, step.graph, step.before, step.after);
    ck_assert_double_eq(whole.conjugate_before.at(0), 1.0);
    ck_assert_double_eq(whole.conjugate_after.at(0), 0.9);
    step.within(5, 4.0);
    const JumpEvent within = describe_jump(step.pairs, step.graph, step.before, step.after);
    ck_assert_double_eq(within.conjugate_before.at(0), 1.5);
    ck_assert_double_eq(within.conjugate_after.at(0), 1.25);
    ck_assert_int_eq(within.interface, 5);
    ck_assert_int_eq(within.first_pair, 3);
    ck_assert_int_eq(within.last_pair, 6);
}
