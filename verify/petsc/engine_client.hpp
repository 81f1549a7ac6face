// SPDX-License-Identifier: BSD-3-Clause
// The engine's functions, called as the library's core calls them.
#pragma once

#include <vector>

#include "dense_reference.hpp"

namespace verify {

struct Answered {
    std::int32_t status = 0;
    delam_experimental_answer raw{};
    Values values, balance, correction, correction_balance, products, work, lifted;
};

class EngineClient {
public:
    EngineClient(const delam_experimental_engine& engine, const Variables& variables)
        : engine_(engine), dofs_(variables.dofs), visible_(variables.visible.size()) {
        const delam_experimental_variables view = variables.view();
        patterns_ = at(view.pattern_count);
        diagonal.assign(visible_, 0.0);
        load_sizes.assign(patterns_, 0.0);
        status = engine.prepare(&view, diagonal.data(), load_sizes.data(), engine.user);
    }

    std::int32_t set(const Acting& acting) const {
        const List c(acting.couplings), m(acting.masters);
        const delam_experimental_entries couplings = c.view(), masters = m.view();
        return engine_.set(&couplings, static_cast<std::int64_t>(acting.fixed.size()), acting.fixed.data(),
                           static_cast<std::int64_t>(acting.pivots.size()), acting.pivots.data(), &masters,
                           engine_.user);
    }
    std::int32_t renew(const std::vector<Acting::Entry>& entries, double* cost) const {
        const List list(entries);
        const delam_experimental_entries view = list.view();
        return engine_.renew(&view, cost, engine_.user);
    }
    Answered solve(const Acting& acting, std::int64_t place, const Values& start, double tolerance,
                   std::int32_t (*poll)(void*)) const {
        Answered a;
        for (Values* list : {&a.values, &a.balance, &a.correction, &a.correction_balance}) list->assign(visible_, -1.0);
        for (Values* list : {&a.work, &a.lifted}) list->assign(patterns_, -1.0);
        a.products.assign(at(engine_.kept), -1.0);
        a.raw.values = a.values.data();
        a.raw.balance = a.balance.data();
        a.raw.correction = a.correction.data();
        a.raw.correction_balance = a.correction_balance.data();
        a.raw.products = a.products.data();
        a.raw.work = a.work.data();
        a.raw.lifted = a.lifted.data();
        Values force = acting.force;
        force.resize(visible_, 0.0);
        delam_experimental_request request{};
        request.theta = acting.theta.data();
        request.force = force.data();
        request.right = acting.right.data();
        request.start = start.empty() ? nullptr : start.data();
        request.place = place;
        request.tolerance = tolerance;
        request.limit = 2000;
        request.poll = poll;
        a.status = engine_.solve(&request, &a.raw, engine_.user);
        return a;
    }
    std::int32_t recover(const Values& weights, Values& displacement, Values& force) const {
        displacement.assign(at(dofs_), -1.0);
        force.assign(at(dofs_), -1.0);
        return engine_.recover(weights.data(), displacement.data(), force.data(), engine_.user);
    }
    // The ranks keep the fields, with these displacements added.
    std::int32_t keep(const Values& weights, Values* moved) const {
        return engine_.recover(weights.data(), moved == nullptr ? nullptr : moved->data(), nullptr, engine_.user);
    }
    std::size_t kept() const { return at(engine_.kept); }
    std::size_t visible() const { return visible_; }
    const char* message() const { return engine_.message(engine_.user); }

    Values diagonal, load_sizes;
    std::int32_t status = 0;

private:
    struct List {
        explicit List(const std::vector<Acting::Entry>& entries) {
            for (const auto& e : entries) {
                rows.push_back(e.row);
                columns.push_back(e.column);
                values.push_back(e.value);
            }
        }
        delam_experimental_entries view() const {
            return {static_cast<std::int64_t>(rows.size()), rows.data(), columns.data(), values.data()};
        }
        Indices rows, columns;
        Values values;
    };

    delam_experimental_engine engine_;
    std::int64_t dofs_;
    std::size_t visible_, patterns_ = 0;
};

}  // namespace verify
