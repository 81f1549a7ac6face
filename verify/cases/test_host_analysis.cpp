// SPDX-License-Identifier: BSD-3-Clause
// Actions of a host between steps: it changes histories, saves states as files, uses more threads.
#include <fcntl.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "small_analysis.hpp"

namespace {

using reference::Scene;
using reference::Solver;

// The bar of two cells, pulled by a given history.
Scene bar(const std::vector<double>& times, const std::vector<double>& values, const char* solution = "local") {
    Scene scene(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 1e12, 0.0);
    scene.law(0, {125e9, 125e9, 100.0, 100.0, 250.0, 250.0});
    const auto bottom = scene.find(0, {0.0, 0.0}, {1.0, 0.0});
    scene.hold(bottom, {1.0, 0.0});
    scene.hold(bottom, {0.0, 1.0});
    const auto top = scene.find(1, {0.0, 2.0}, {1.0, 2.0});
    scene.hold(top, {1.0, 0.0});
    scene.drive(top, {0.0, 1.0}, scene.pattern("pull", times, values), {1.0, 1.0});
    scene.text("solution", solution);
    return scene;
}

void set(const Solver& solver, const std::vector<double>& times, const std::vector<double>& values) {
    REQUIRE(solver.scene(), delam_solver_set_history, solver.get(), 0, static_cast<std::int64_t>(times.size()),
            times.data(), values.data());
}

void to(Solver& solver, double time) {
    solver.step(time);
    solver.commit();
}

// A history given step by step leads to the same analysis as a scene that had it from the start, to the last bit.
LOOP_TEST(told_history, 0, 2) {
    const char* solution = loop == 0 ? "local" : "energetic";
    const std::vector<double> times{0.0, 0.25, 0.5, 0.75, 1.0}, values{0.0, 6e-5, 2e-5, 9e-5, 7e-5};
    const Scene known = bar(times, values, solution), unknown = bar({0.0}, {0.0}, solution);
    Solver planned(known, 0.0), told(unknown, 0.0);
    for (std::size_t k = 1; k < times.size(); ++k) {
        to(planned, times[k]);
        // A wrong guess that is rolled back leaves nothing.
        set(told, {times[k]}, {1e-4});
        told.step(times[k]);
        told.rollback();
        set(told, {times[k]}, {values[k]});
        to(told, times[k]);
        cases::expect_same(told, cases::read_bits(told), cases::read_bits(planned), "step " + std::to_string(k));
    }
    cases::expect(planned.value("dissipated") > 0.0, "nothing was damaged");
    // It is saved with the state, and replaces the scene's own history.
    const auto bytes = told.save();
    set(told, {1.5, 2.0}, {1.2e-4, 0.0});
    const auto longer = told.save();
    Solver again(unknown, 0.0);
    unknown.require(again.load(longer), "delam_solver_load");
    cases::expect(again.save() == longer, "saved again");
    to(told, 1.75);
    to(again, 1.75);
    cases::expect_same(again, cases::read_bits(again), cases::read_bits(told), "after loading");
    cases::expect(std::abs(again.value("load:pull") - 6e-5) < 1e-19, "halfway down");
    // Loading the earlier state restores the earlier history.
    unknown.require(again.load(bytes), "delam_solver_load");
    to(again, 1.75);
    cases::expect(again.value("load:pull") == 7e-5, "constant beyond the last point");
    // The scene is the same for both: a state of the planned analysis is refused, because the histories differ.
    cases::expect(again.load(planned.save()) == DELAM_ERROR_SNAPSHOT, "another scene");
}

TEST(history_refused) {
    const Scene scene = bar({0.0, 1.0}, {0.0, 5e-5});
    Solver solver(scene, 0.0);
    to(solver, 0.5);
    const double ok = 0.75, early = 0.5, value = 1e-5, nan = NAN;
    const double twice[2] = {0.75, 0.75}, values[2] = {0.0, 0.0};
    delam_solver* s = solver.get();
    cases::expect(delam_solver_set_history(s, 0, 1, &early, &value) == DELAM_ERROR_ARGUMENT,
                  "not after the committed time");
    cases::expect(delam_solver_set_history(s, 1, 1, &ok, &value) == DELAM_ERROR_ARGUMENT, "no such pattern");
    cases::expect(delam_solver_set_history(s, 0, 0, &ok, &value) == DELAM_ERROR_ARGUMENT, "no points");
    cases::expect(delam_solver_set_history(s, 0, 1, &ok, &nan) == DELAM_ERROR_ARGUMENT, "not finite");
    cases::expect(delam_solver_set_history(s, 0, 2, twice, values) == DELAM_ERROR_ARGUMENT,
                  "times that do not increase");
    std::int32_t pending = -1;
    REQUIRE(scene, delam_solver_pending, s, &pending);
    cases::expect(pending == 0, "nothing is pending");
    solver.step(0.75);
    REQUIRE(scene, delam_solver_pending, s, &pending);
    cases::expect(pending == 1, "a step is pending");
    cases::expect(delam_solver_set_history(s, 0, 1, &ok, &value) == DELAM_ERROR_STATE, "a step is pending");
    cases::expect(solver.value("load:pull") == 0.75 * 5e-5, "refusals change nothing");
}

struct Folder {
    std::filesystem::path path;
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "delam-XXXXXX").string();
        cases::expect(mkdtemp(name.data()) != nullptr, "no temporary folder");
        path = name;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(path), std::filesystem::directory_iterator()));
    }
};

TEST(states_as_files) {
    const Folder folder;
    const std::string path = (folder.path / "état 1.state").string();
    const Scene scene = bar({0.0, 1.0}, {0.0, 9e-5});
    Solver solver(scene, 0.0);
    to(solver, 0.5);
    REQUIRE(scene, delam_solver_save_file, solver.get(), path.c_str());
    const auto bits = cases::read_bits(solver);
    to(solver, 1.0);
    const auto end = cases::read_bits(solver);
    Solver again(scene, 0.0);
    REQUIRE(scene, delam_solver_load_file, again.get(), path.c_str());
    cases::expect_same(again, cases::read_bits(again), bits, "loaded");
    to(again, 1.0);
    cases::expect_same(again, cases::read_bits(again), end, "gone on");
    // Over an older file.
    REQUIRE(scene, delam_solver_save_file, again.get(), path.c_str());
    cases::expect(folder.files() == 1, "something was left beside it");
    std::ifstream file(path, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    cases::expect(bytes == again.save(), "a file holds other bytes");

    const auto refused = [&](std::int32_t status, std::int32_t expected, const char* words) {
        const std::string message = delam_context_message(scene.context());
        cases::expect(status == expected && message.find(words) != std::string::npos,
                      std::string(words) + ": " + message);
    };
    refused(delam_solver_save_file(again.get(), (folder.path / "none" / "a").c_str()), DELAM_ERROR_FILE,
            "No such file");
    refused(delam_solver_save_file(again.get(), folder.path.c_str()), DELAM_ERROR_FILE, "directory");
    refused(delam_solver_save_file(again.get(), nullptr), DELAM_ERROR_ARGUMENT, "path");
    refused(delam_solver_save_file(again.get(), ""), DELAM_ERROR_FILE, "the path is empty");
    // Only regular files are replaced: a host that runs as root could destroy devices.
    const std::string pipe = (folder.path / "pipe").string();
    cases::expect(mkfifo(pipe.c_str(), 0600) == 0, "mkfifo");
    refused(delam_solver_save_file(again.get(), pipe.c_str()), DELAM_ERROR_FILE,
            "a pipe; only regular files are replaced");
    const std::string link = (folder.path / "link").string();
    std::filesystem::create_symlink(pipe, link);
    refused(delam_solver_save_file(again.get(), link.c_str()), DELAM_ERROR_FILE,
            "a pipe; only regular files are replaced");
    cases::expect(std::filesystem::is_symlink(link) && std::filesystem::remove(link), "the link is gone");
    cases::expect(std::filesystem::is_fifo(pipe) && std::filesystem::remove(pipe) && folder.files() == 1,
                  "the pipe is gone, or something was left beside it");
    refused(delam_solver_load_file(again.get(), (folder.path / "none").c_str()), DELAM_ERROR_FILE, "No such file");
    refused(delam_solver_load_file(again.get(), folder.path.c_str()), DELAM_ERROR_FILE, "directory");
    const std::string empty = (folder.path / "empty").string();
    std::ofstream(empty).flush();
    refused(delam_solver_load_file(again.get(), empty.c_str()), DELAM_ERROR_SNAPSHOT, "ends early");
    std::ofstream(empty) << "<?xml version=\"1.0\"?><VTKFile/>";
    refused(delam_solver_load_file(again.get(), empty.c_str()), DELAM_ERROR_SNAPSHOT, "not a snapshot");
    cases::expect_same(again, cases::read_bits(again), end, "after refusals");
}

// Addresses for as many more bytes while it lives; the memory of a sanitizer would meet the limit.
class Room {
public:
    explicit Room(std::uint64_t more) {
        getrlimit(RLIMIT_AS, &before_);
        std::ifstream statm("/proc/self/statm");
        std::uint64_t pages = 0;
        statm >> pages;
        const rlimit less{pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + more, before_.rlim_max};
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
        cases::expect(pages > 0 && setrlimit(RLIMIT_AS, &less) == 0, "setrlimit");
#endif
    }
    ~Room() { setrlimit(RLIMIT_AS, &before_); }
    Room(const Room&) = delete;
    Room& operator=(const Room&) = delete;

private:
    rlimit before_{};
};

// Bytes that are no state are refused without a wait, and without memory for all of them.
TEST(not_a_state) {
    const Folder folder;
    const Scene scene = bar({0.0, 1.0}, {0.0, 9e-5});
    Solver solver(scene, 0.0);
    to(solver, 0.5);
    const auto bits = cases::read_bits(solver);
    alarm(60);
    const Room room(std::uint64_t{8} << 20);
    const auto refused = [&](const std::string& path, std::int32_t expected, const char* words) {
        const std::int32_t status = delam_solver_load_file(solver.get(), path.c_str());
        const std::string message = delam_context_message(scene.context());
        cases::expect(status == expected && message.find(words) != std::string::npos,
                      path + ": " + delam_status_name(status) + ": " + message);
    };
    const std::string pipe = (folder.path / "pipe").string(), link = (folder.path / "link").string();
    cases::expect(mkfifo(pipe.c_str(), 0600) == 0, "mkfifo");
    std::filesystem::create_symlink(pipe, link);
    for (const std::string& path : {pipe, link}) refused(path, DELAM_ERROR_FILE, "a pipe; only regular files are read");
    refused("/dev/zero", DELAM_ERROR_FILE, "a device; only regular files are read");
    refused(folder.path.string(), DELAM_ERROR_FILE, "a directory; only regular files are read");
    refused("", DELAM_ERROR_FILE, "the path is empty");
    const std::string large = (folder.path / "large").string();
    const auto grow = [&](std::uint64_t size, std::size_t bytes, std::size_t damaged) {
        std::vector<std::uint8_t> saved = solver.save();
        saved.resize(bytes);
        if (damaged < bytes) saved[damaged] ^= 0x80;
        std::ofstream(large, std::ios::binary)
            .write(reinterpret_cast<const char*>(saved.data()), static_cast<std::streamsize>(bytes));
        std::filesystem::resize_file(large, size);
    };
    const std::size_t all = solver.save().size();
    const std::uint64_t four_giga = std::uint64_t{4} << 30, little = std::uint64_t{32} << 20;
    grow(four_giga, 0, 0);
    refused(large, DELAM_ERROR_SNAPSHOT, "not a snapshot");
    grow(four_giga, all, 0);
    refused(large, DELAM_ERROR_SNAPSHOT, "not a snapshot");
    grow(four_giga, all, 8);
    refused(large, DELAM_ERROR_SNAPSHOT, "snapshot version");
    grow(four_giga, all, 12);
    refused(large, DELAM_ERROR_SNAPSHOT, "another scene");
    grow(little, all, all);
    refused(large, DELAM_ERROR_SNAPSHOT, "checksum");
    cases::expect_same(solver, cases::read_bits(solver), bits, "after refusals");
    grow(all, all, all);
    scene.require(delam_solver_load_file(solver.get(), large.c_str()), "the state itself");
    cases::expect_same(solver, cases::read_bits(solver), bits, "loaded");
}

// A disk that fills up: the existing file stays, and nothing else is left.
TEST(full_disk) {
    const Folder folder;
    const std::string path = (folder.path / "state").string();
    const Scene scene = bar({0.0, 1.0}, {0.0, 9e-5});
    Solver solver(scene, 0.0);
    to(solver, 0.5);
    REQUIRE(scene, delam_solver_save_file, solver.get(), path.c_str());
    to(solver, 1.0);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit little{100, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &little);
    const std::int32_t status = delam_solver_save_file(solver.get(), path.c_str());
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    cases::expect(status == DELAM_ERROR_FILE &&
                      std::string(delam_context_message(scene.context())).find("too large") != std::string::npos,
                  delam_context_message(scene.context()));
    cases::expect(folder.files() == 1, "a part of the file was left");
    Solver again(scene, 0.0);
    scene.require(delam_solver_load_file(again.get(), path.c_str()), "the older state");
    cases::expect(again.value("time") == 0.5, "the older state is there");
}

// Two contexts save to one path at the same time: the file is one of the two, complete.
TEST(two_writers) {
    const Folder folder;
    const std::string path = (folder.path / "state").string();
    std::atomic<int> failures{0};
    const auto island = [&](double end) {
        try {
            const Scene scene = bar({0.0, 1.0}, {0.0, 9e-5});
            Solver solver(scene, 0.0);
            to(solver, end);
            for (int i = 0; i < 60; ++i) {
                if (delam_solver_save_file(solver.get(), path.c_str()) != DELAM_OK) ++failures;
                Solver other(scene, 0.0);
                if (delam_solver_load_file(other.get(), path.c_str()) != DELAM_OK) ++failures;
            }
        } catch (const std::exception&) {
            ++failures;
        }
    };
    std::thread a(island, 0.5), b(island, 1.0);
    a.join();
    b.join();
    cases::expect(failures == 0, std::to_string(failures.load()) + " failures");
    cases::expect(folder.files() == 1, "parts are left");
}

// A step that is not converged says what did not come to its end, and only that.
TEST(names_what_did_not_converge) {
    const auto message_of = [](const char* key, const char* rule, const char* reduction) {
        Scene scene = cases::small_enf();
        scene.text("reduction", reduction);
        scene.text("mixity_rule", rule);
        scene.number(key, 1.0);
        Solver solver(scene, 0.0);
        std::int32_t status = DELAM_OK;
        for (int step = 1; step <= cases::small_steps && status == DELAM_OK; ++step) {
            status = solver.advance(cases::small_time(step));
            if (status == DELAM_OK) solver.commit();
        }
        const std::string message = delam_context_message(scene.context());
        cases::expect(status == DELAM_NOT_CONVERGED, std::string(key) + " = 1 is no obstacle: " + message);
        return message;
    };
    const auto has = [](const std::string& message, const char* words) {
        return message.find(words) != std::string::npos;
    };
    // The iterated operator stops where rounding ends, above the default of linear_tolerance: that is no obstacle.
    const char* const of[][2] = {{"frozen", "condensed"}, {"variational", "condensed"}, {"frozen", "iterated"}};
    for (const auto& [rule, reduction] : of) {
        const std::string contact = message_of("contact_limit", rule, reduction);
        cases::expect(has(contact, "not converged: a displacement step at fixed adhesion did not converge") &&
                          has(contact, "the contact set still changes after 1 active-set steps (contact_limit = 1)") &&
                          has(contact, "the adhesion is at rest") && !has(contact, "linear") &&
                          !has(contact, "variational"),
                      contact);
        const std::string damage = message_of("minimisation_limit", rule, reduction);
        cases::expect(has(damage, "the adhesion still changes after 1 alternate minimisation iteration (") &&
                          has(damage, "minimisation_limit = 1)") && !has(damage, "displacement"),
                      damage);
    }
}

// No digit depends on the library's own threads.
TEST(threads_change_no_digit) {
    cases::expect(delam_blas_threads() >= 0, "BLAS threads");
    std::vector<cases::Bits> ends;
    for (const double threads : {1.0, 2.0, 5.0}) {
        Scene scene = cases::small_enf(6);
        scene.number("threads", threads);
        Solver solver(scene, 0.0);
        cases::walk(solver, 1, cases::small_steps);
        ends.push_back(cases::read_bits(solver));
        cases::expect_same(solver, ends.back(), ends.front(), std::to_string(static_cast<int>(threads)) + " threads");
        const std::string plan = delam_solver_plan(solver.get());
        cases::expect(plan.find("threads: ") != std::string::npos, plan);
    }
    // More than there are processors are not started, which the plan and a warning say.
    Scene crowded = cases::small_enf(6);
    crowded.number("threads", 1024.0);
    std::vector<std::string> said;
    const auto keep = [](std::int32_t level, const char* line, void* user) {
        if (level == 1) static_cast<std::vector<std::string>*>(user)->emplace_back(line);
    };
    crowded.require(delam_context_set_log(crowded.context(), keep, &said), "log");
    Solver bounded(crowded, 0.0);
    cases::walk(bounded, 1, cases::small_steps);
    cases::expect_same(bounded, cases::read_bits(bounded), ends.front(), "1024 threads");
    cpu_set_t set;
    CPU_ZERO(&set);
    cases::expect(sched_getaffinity(0, sizeof set, &set) == 0, "affinity");
    const std::string processors = std::to_string(CPU_COUNT(&set));
    cases::expect(std::count_if(said.begin(), said.end(),
                                [&](const std::string& line) {
                                    return line == "option threads = 1024: " + processors +
                                                       " are used, the number of processors of this process";
                                }) == 1,
                  "one warning");
    const std::string plan = delam_solver_plan(bounded.get());
    cases::expect(plan.find(processors + " of the library (option threads = 1024") != std::string::npos, plan);
    // They are not part of the scene: a state saved with one number continues with another.
    char one[17], two[17];
    Scene scene = cases::small_enf(6);
    scene.require(delam_problem_hash(scene.problem(), one), "hash");
    scene.number("threads", 2.0);
    scene.require(delam_problem_hash(scene.problem(), two), "hash");
    cases::expect(std::string(one) == two, "the hash knows the threads");
}

// Cancelled while other threads of the team work: the state before, and the same end.
TEST(cancelled_with_threads) {
    Scene scene = cases::small_enf(6);
    scene.number("threads", 3.0);
    Solver solver(scene, 0.0), straight(scene, 0.0);
    static std::int64_t polls;
    static std::int64_t last;
    const auto count = [](const char*, std::int64_t, std::int64_t, void*) -> std::int32_t {
        return ++polls == last ? 1 : 0;
    };
    straight.step(cases::small_time(1));
    scene.require(delam_context_set_progress(scene.context(), count, nullptr), "progress");
    for (last = 1; last < 400; last = last * 2 + 1) {
        polls = 0;
        cases::expect(solver.advance(cases::small_time(1)) == DELAM_CANCELLED, "cancelled at " + std::to_string(last));
    }
    delam_solver* made = nullptr;
    for (last = 1; last <= 4; ++last) {
        polls = 0;
        cases::expect(delam_solver_create(scene.problem(), 0.0, &made) == DELAM_CANCELLED && made == nullptr,
                      "cancelled while it is made");
    }
    scene.require(delam_context_set_progress(scene.context(), nullptr, nullptr), "progress");
    solver.step(cases::small_time(1));
    cases::expect_same(solver, cases::read_bits(solver), cases::read_bits(straight), "after cancellations");
}

}  // namespace
