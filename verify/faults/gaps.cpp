// SPDX-License-Identifier: BSD-3-Clause
// fault_gaps, for people: the longest times of the calling thread between two polls of the cancel flag, or between the
// last poll and the end of the call: how long a cancel from another thread has to wait. For the end-notched flexure
// test at 0.1 mm and a scene in space.
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "enf.hpp"
#include "scenes.hpp"

namespace {

double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Watch {
    std::string stage = "begin";
    double last = now();
    std::map<std::string, double> longest;

    void poll(const std::string& next) {
        const double time = now();
        double& gap = longest[stage + " -> " + next];
        gap = std::max(gap, time - last);
        stage = next;
        last = time;
    }
    static std::int32_t poll(const char* stage, std::int64_t, std::int64_t, void* user) {
        static_cast<Watch*>(user)->poll(stage);
        return 0;
    }
    template <class Call>
    void during(const char* name, const Call& call) {
        stage = "begin";
        last = now();
        longest.clear();
        call();
        poll("end");
        std::vector<std::pair<double, std::string>> gaps;
        for (const auto& [where, gap] : longest) gaps.emplace_back(-gap, where);
        std::sort(gaps.begin(), gaps.end());
        std::printf("  %s:", name);
        for (std::size_t i = 0; i < std::min<std::size_t>(gaps.size(), 5); ++i)
            std::printf("%s %s %.1f ms", i > 0 ? "," : "", gaps[i].second.c_str(), -1e3 * gaps[i].first);
        std::printf("\n");
        std::fflush(stdout);
    }
};

void watched(const reference::Scene& scene, const std::vector<double>& times) {
    Watch watch;
    REQUIRE(scene, delam_context_set_progress, scene.context(), Watch::poll, &watch);
    std::unique_ptr<reference::Solver> solver;
    watch.during("create", [&] { solver = std::make_unique<reference::Solver>(scene, 0.0); });
    watch.during("analysis", [&] {
        for (const double time : times) {
            solver->step(time);
            solver->commit();
        }
    });
    watch.during("kkt_equilibrium", [&] { solver->value("kkt_equilibrium"); });
    watch.during("stress", [&] { solver->field("stress"); });
    std::vector<double> matrix(1);
    watch.during("tangent", [&] { REQUIRE(scene, delam_solver_tangent, solver->get(), 1, matrix.data()); });
    const std::vector<std::uint8_t> bytes = solver->save();
    watch.during("load", [&] { scene.require(solver->load(bytes), "delam_solver_load"); });
    REQUIRE(scene, delam_context_set_progress, scene.context(), nullptr, nullptr);
}

reference::Scene plane(double h, const std::string& reduction, bool brittle, const char* solution) {
    cases::Enf e;
    e.h = h;
    e.subdomains = reduction == "feti" ? 8 : 0;
    if (brittle) e.law = {125e15, 125e15, 0.01, 0.01, 25.0, 25.0};
    reference::Scene scene = cases::make_enf(e);
    scene.text("reduction", reduction.c_str());
    scene.text("solution", solution);
    return scene;
}

reference::Scene space(std::int64_t along, const char* reduction) {
    reference::Scene scene(3, {0.07, 0.01}, {along, along / 7}, {3e-3, 3e-3}, {3, 3}, DELAM_HEX8);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 75e9, 0.3);
    scene.law(0, {125e9, 125e9, 100.0, 100.0, 250.0, 250.0});
    const reference::Pairs pairs = scene.pairs(0);
    std::vector<std::int64_t> notch;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) < 0.03 - 1e-6) notch.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    const auto bottom = scene.find(0, {0.0, 0.0, 0.0}, {0.07, 0.01, 0.0});
    for (const std::vector<double>& axis : {std::vector<double>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
        scene.hold(bottom, axis);
    const auto edge = scene.find(1, {0.0, 0.0, 6e-3}, {0.0, 0.01, 6e-3});
    scene.drive(edge, {0.0, 0.0, 1.0}, scene.pattern("peel", {0.0, 2.0}, {0.0, 2e-3}),
                std::vector<double>(edge.size(), 1.0));
    scene.text("reduction", reduction);
    return scene;
}

}  // namespace

int main(int argc, char** argv) {
    const double h = argc > 1 ? std::atof(argv[1]) : 1e-4;
    const std::int64_t along = argc > 2 ? std::atol(argv[2]) : 70;
    std::vector<double> times;
    for (int k = 1; k <= 8; ++k) times.push_back(0.2 * k);
    std::printf("plane, h = %g mm, condensed\n", 1e3 * h);
    watched(plane(h, "condensed", false, "local"), times);
    std::printf("plane, h = %g mm, condensed, brittle\n", 1e3 * h);
    watched(plane(h, "condensed", true, "local"), times);
    std::printf("plane, h = %g mm, FETI\n", 1e3 * h);
    watched(plane(h, "feti", false, "local"), {0.2, 0.4});
    std::printf("space, %lld cells along, condensed\n", static_cast<long long>(along));
    watched(space(along, "condensed"), {0.5, 1.0, 1.5, 2.0});
    std::printf("space, %lld cells along, FETI\n", static_cast<long long>(along));
    watched(space(along, "feti"), {0.5});
    return EXIT_SUCCESS;
}
