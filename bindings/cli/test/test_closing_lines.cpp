// SPDX-License-Identifier: BSD-3-Clause
// What an analysis ends with, found in made-up rows of history.csv and jumps, and the lines that tell it.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "result/closing/closing.hpp"
#include "result/closing/estimate.hpp"

namespace {

int failures = 0;

void expect(bool condition, const std::string& what) {
    std::printf("%s %s\n", condition ? "ok   " : "FAIL ", what.c_str());
    if (!condition) ++failures;
}

void expect_line(const std::string& line, const std::string& wanted) {
    expect(line == wanted, line == wanted ? line : "\"" + line + "\"\n      instead of \"" + wanted + "\"");
}

cli::Scene scene_of(int dimension, const std::vector<std::string>& patterns) {
    cli::Scene scene;
    scene.geometry.dimension = dimension;
    scene.units = {{"m", "N"}, "", true};
    for (const std::string& name : patterns) {
        cli::PatternData pattern;
        pattern.name = name;
        scene.patterns.push_back(pattern);
    }
    return scene;
}

// The energy that was there before any work, 1, is no part of the ledger; step 2 releases what it does not dissipate.
// Energies of a run have one unit, that of its work.
void balance() {
    const char* head =
        "step,time,stored_bulk,stored_interface,dissipated,work,released,stored_interface_slides,"
        "dissipated_slides,load_potential\n";
    const std::string start = "0,0,0.5,0,0,0,0,0,0,0.5\n1,0.5,5,1,0,5,0,1,0,0\n";
    const cli::Scene flat = scene_of(2, {"press"}), space = scene_of(3, {"press"});
    const cli::Balance closed = cli::balance_of(cli::rows_of(head + start + "2,1,2,1,3,8,3,2,3,0\n"), false);
    expect(closed.defect == 0 && closed.relative() == 0 && closed.work == 8, "what is released closes the ledger");
    expect(cli::balance_of(cli::rows_of(head + start + "2,1,2,1,3,8,3,2,3,0\n"), true).defect == 1,
           "the ledger of the variational rule has columns of its own");
    const cli::Balance off =
        cli::balance_of(cli::rows_of(head + start + "2,1,2,1,3,8,1,2,3,0\n3,2,2,1,3,7,0,2,3,0\n"), false);
    expect(off.step == 2 && off.time == 1 && off.defect == -2 && off.last_defect == -1 && off.relative() == 0.25,
           "the step in which it is off most");
    expect_line(cli::balance_line(off, flat),
                "warning: energy balance: off by 25 % of the work (stored + dissipated + released - work is -2 J/m in "
                "step 2, time 1; the work is up to 8 J/m)");
    expect(off.open() == 2.0 / 3.0, "over the dissipated energy");
    expect_line(cli::energies_line(off, {}, flat),
                "warning: energy balance: work 7 J/m = stored 2 J/m + dissipated 3 J/m + released 1 J/m + open 1 J/m; "
                "open is 67 % of the dissipated energy at most (2 J/m in step 2, time 1)");
    const cli::Balance nearly = cli::balance_of(cli::rows_of(head + start + "2,1,2,1,3,8,2.996,2,3,0\n"), false);
    expect_line(cli::balance_line(nearly, space),
                "energy balance: off by 0.05 % of the work (stored + dissipated + released - work is -0.004 J in step "
                "2, time 1; the work is up to 8 J)");
    expect_line(cli::energies_line(nearly, {2, 3.0}, space),
                "energy balance: work 8 J = stored 2 J + dissipated 3 J + released in 2 jumps 3 J + open 0.004 J; open "
                "is 0.13 % of the dissipated energy at most (0.004 J in step 2, time 1)");
    expect(
        cli::energies_line(nearly, {1, 1.0}, space).find("+ released 3 J (1 J in 1 jump) + open") != std::string::npos,
        "what pairs released that popped is no jump's");
    expect_line(
        cli::balance_line(cli::balance_of(cli::rows_of(head + std::string("0,0,0,0,0,0,0,0,0,0\n")), false), flat),
        "energy balance: no work was done");
    const cli::Balance lost = cli::balance_of(cli::rows_of(head + start + "2,1,nan,1,3,8,3,2,3,0\n"), false);
    expect(cli::balance_line(lost, flat).starts_with("warning: "), "what is no number is no balance");
}

void pops() {
    const std::string rows = "step,work,pops,popped\n0,0,0,0\n1,5,3,0.02\n2,10,40,0.38\n";
    const cli::Pops pops = cli::pops_of(cli::rows_of(rows), true);
    expect(pops.pairs == 43 && pops.released == 0.4 && pops.work == 10, "pairs that popped in all steps");
    expect_line(cli::pops_line(pops),
                "warning: 43 pairs popped one by one and released 4 % of the work: the mesh does not resolve the "
                "process zone (use smaller cells or less strength, which `delam check` proposes)");
    expect_line(cli::pops_line({43, 0.05, 10, true}), "");
    expect(cli::pops_line(cli::pops_of(cli::rows_of(rows), false)).ends_with("has none: use one with strengths)"),
           "what does not soften has no zone");
}

void mixity() {
    const std::string rows = "step,time,dissipated,mixity_error\n0,0,0,0\n1,0.5,2,0.004\n2,1,2.5,0.12\n3,2,9,0.02\n";
    const cli::Scene flat = scene_of(2, {"press"});
    const cli::MixityError error = cli::mixity_error_of(cli::rows_of(rows));
    expect(error.step == 2 && error.relative == 0.12 && error.dissipated == 0.5,
           "the worst step and what it dissipates");
    expect_line(cli::mixity_error_line(error, flat, 9),
                "warning: mode mixity: an error of up to 12 % of the energy that a step dissipates (step 2, time 1, "
                "which dissipates 0.5 J/m); smaller steps reduce it");
    expect_line(cli::mixity_error_line(cli::mixity_error_of(cli::rows_of(rows.substr(0, rows.find("2,1,")))), flat, 9),
                "");
}

void search() {
    const cli::Scene flat = scene_of(2, {"press"});
    const std::string head = "step,time,stored_bulk,stored_interface,work,search_gap,search_margin\n0,0,0,0,0,0,0\n";
    const std::string quiet = "1,0.5,10,0,9,0.09,-1e-12\n";
    const auto lines = [&](const std::string& rows) {
        return cli::search_lines(cli::search_limits_of(cli::rows_of(head + rows), 0.01), flat, 20);
    };
    expect(lines("1,0.5,10,0,9,1e-6,-1e-12\n").empty(), "rounding is not mentioned");
    expect(lines(quiet).size() == 1, "a gap within search_tolerance is stated as a bound");
    expect_line(lines("1,0.5,10,0,9,0.08,0\n" + quiet + "2,1,10,0,20,0.1,0\n").front(),
                "search: no position of a front, with the other fronts in their places, has less energy than the state "
                "kept by more than 0.09 J/m (0.9 % of the energy; step 1, time 0.5)");
    const std::vector<std::string> told = lines(quiet + "2,1,10,0,20,0.5,-0.2\n3,2,10,0,20,0.3,-0.3\n");
    expect(told.size() == 2, "a gap and a lower state: a line each");
    expect_line(told.front(),
                "warning: search: in 2 steps a state that it left out may have less energy than the one "
                "kept, by up to 0.5 J/m (step 2, time 1; search_tolerance allows 0.2 J/m)");
    expect_line(told.back(),
                "warning: search: in 2 steps a state of lower energy was seen and not kept, lower by up to "
                "0.3 J/m (step 3, time 2)");
    expect_line(lines("1,0.5,10,0,9,inf,0\n2,1,10,0,20,0.5,0\n").front(),
                "warning: search: in 2 steps (the first is step 1) it has no bound on the energy of the states that it "
                "left out (search_gap is infinite)");
}

void drops() {
    cli::Scene one = scene_of(2, {"press"});
    const std::string head = "step,time,load,reaction\n0,0,0,0\n";
    const auto of = [](const std::string& rows, const std::vector<cli::Jump>& jumps, const cli::Scene& scene) {
        return cli::load_drops_of(cli::rows_of(rows), jumps, scene);
    };
    expect(of(head + "1,1,1,-100\n2,2,2,-98.1\n3,3,1,-50\n4,4,1,-40\n", {}, one).steps.empty(),
           "a fall by less, or without more load, is none");
    // The drop of step 4 counts by the peak of step 1; that of step 2 was recorded as a jump.
    const std::string rows = head + "1,1,1,-100\n2,2,2,-60\n3,3,3,-61\n4,4,4,-58\n5,5,5,-40\n6,6,6,-39\n";
    cli::Jump jump;
    jump.step = 2;
    const cli::LoadDrops drops = of(rows, {jump}, one);
    expect(drops.steps == std::vector<std::int64_t>{4, 5} && drops.step == 5, "drops without a jump");
    expect_line(cli::load_drops_line(drops),
                "load drops without a recorded jump: in 2 steps the reaction falls by more "
                "than 2 % of its largest value; most in step 5, time 5, from -58 to -40; smaller steps tell a steady "
                "fall from a "
                "jump");
    expect(of(rows, {}, one).step == 2, "without jumps the largest is that of step 2");
    const cli::LoadDrops second =
        of("step,time,load_cool,reaction_cool,load_open,reaction_open\n0,0,0,0,0,0\n"
           "1,1,-150,5,0,0\n2,2,-150,3,1,8\n3,3,-150,2,2,4\n",
           {}, scene_of(2, {"cool", "open"}));
    expect(second.steps == std::vector<std::int64_t>{3} && second.column == "reaction_open",
           "the pattern at rest does not count, the other one does");
}

void jumps() {
    cli::Scene space = scene_of(3, {"a", "b"});
    std::vector<cli::Jump> all;
    for (int i = 0; i < 12; ++i) {
        cli::Jump jump;
        jump.step = i + 1;
        jump.time = 0.1 * (i + 1);
        jump.loads = {2.0 * i, 0.0};
        jump.reaction_before = {3.0, 1.0};
        jump.reaction_after = {2.5, 0.99};
        jump.released = i % 2 == 0 ? 20.0 + i : 1.0 + i;  // the smallest: 2 and 4
        jump.debonded = 0.5;
        jump.last = 3;
        jump.name = "a \"b\", c";
        all.push_back(jump);
    }
    const std::vector<std::string> lines = cli::jump_lines(all, space, 100);
    expect(lines.size() == 11, fmt::format("ten largest and the rest: {} lines", lines.size()));
    expect_line(lines.front(),
                "jump at time 0.1 (load_a 0, load_b 0): interface \"a \"b\", c\" debonded by 0.5 m², 20 J "
                "released, reaction_a 3 to 2.5 N");
    all.front().reaction_before = {30450.0, 1.0};
    all.front().reaction_after = {25000.0, 0.5};
    cli::Scene plane = scene_of(2, {"a", "b"});
    const std::string large = cli::jump_lines(all, plane, 100).front();
    expect(large.ends_with(", reaction_a 30.45 to 25 kN/m, reaction_b 1 to 0.5 N/m"), "units per width: " + large);
    plane.prescriptions.push_back({{}, {}, {{0, -1.0}}, false, {}});
    plane.prescriptions.push_back({{}, {}, {{1, 2.0}}, false, {}});
    all.front().loads = {0.0016, 0.5};
    expect(cli::jump_lines(all, plane, 100).front().find("(load_a 1.6 mm, load_b 0.5): ") != std::string::npos,
           "a factor that is the displacement has its unit");
    all.front().before = 0.05;
    all.front().loads_before = {0.0015, 0.499};
    expect(cli::jump_lines(all, plane, 100)
               .front()
               .starts_with("jump between time 0.05 and 0.1 (load_a 1.5 mm to 1.6 mm, load_b 0.5): "),
           "a jump that goes on while the load rises");
    all.front().loads_before = {0.001599, 0.5};
    expect(cli::jump_lines(all, plane, 100).front().starts_with("jump at time 0.1 "), "a jump at one load");
    plane.units = {};
    expect(cli::jump_lines(all, plane, 100).front().find("(load_a 0.0016, load_b 0.5): ") != std::string::npos,
           "a scene without units has none for its loads");
    expect(cli::jump_lines(all, plane, 100).front().ends_with(", reaction_a 30450 to 25000, reaction_b 1 to 0.5"),
           "no unit where the scene names none");
    all.front().reaction_before = {3.0, 1.0};
    all.front().reaction_after = {2.5, 0.99};
    expect(lines[1].starts_with("jump at time 0.3 "), "in the order of time, but for the smallest");
    expect_line(lines.back(), "2 smaller jumps debonded by 1 m² and released 6 J in all (jumps.csv)");
    all.resize(10);
    expect(cli::jump_lines(all, space, 100).size() == 10, "ten jumps are all told");
    const std::string table = cli::jumps_text({all[1]}, space);
    expect_line(table,
                "step,before,time,stored,dissipated,released,debonded,interface,first_pair,last_pair,load_a,"
                "load_b,reaction_before_a,reaction_before_b,reaction_after_a,reaction_after_b,name\n"
                "2,0,0.20000000000000001,0,0,2,0.5,0,0,3,2,0,3,1,2.5,0.98999999999999999,\"a \"\"b\"\", c\"\n");
    expect_line(cli::jumps_text({}, scene_of(2, {"press"})),
                "step,before,time,stored,dissipated,released,debonded,"
                "interface,first_pair,last_pair,load,reaction_before,reaction_after,name\n");
    all[0].reaction_before[0] = 3.14159265;
    expect(cli::jump_lines({all[0]}, space, 1e5).front().find("0.02 kJ released, reaction_a 3.142 to 2.5") !=
               std::string::npos,
           "in the unit of the work, with four digits");
    all[0].first = -1;
    expect(cli::jump_lines({all[0]}, space, 100).front().find(": no interface changed, 20 J released") !=
               std::string::npos,
           "a jump of contact alone");
}

// A step whose bounds lie farther apart than its work is named; one that stands still is not.
void estimate() {
    const cli::Rows rows = cli::rows_of(
        "step,stored_bulk,stored_interface,load_potential,work,lower,increment,upper\n0,0,0,0,0,0,0,0\n"
        "1,1,0,0,1,1,1,1\n2,2,0,0,2,-20,1,21\n3,2,0,0,2,0,0,1e-12\n");
    expect(cli::inconclusive_steps(rows) == std::vector<std::int64_t>{2}, "an inconclusive estimate");
    expect_line(
        cli::inconclusive_line({2}),
        "two-sided estimate says nothing in 1 step (the first is step 2): its bounds lie farther apart than the "
        "work of the step");
    expect(cli::inconclusive_line({}).empty() && cli::violated_steps(rows, 1e-3).empty(), "and holds");
}

}  // namespace

int main() {
    balance();
    estimate();
    pops();
    mixity();
    search();
    drops();
    jumps();
    return failures == 0 ? 0 : 1;
}
