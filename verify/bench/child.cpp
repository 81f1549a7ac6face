// SPDX-License-Identifier: BSD-3-Clause
#include "child.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>

#include "measure.hpp"

namespace bench {

namespace {

void set_environment(int threads) {
    constexpr const char* names[] = {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT"};
    if (threads == 0) {
        for (const char* name : names) unsetenv(name);
        return;
    }
    const std::string count = std::to_string(threads);
    for (const char* name : names) {
        // CHOLMOD 3 requests four OpenMP threads whatever OMP_NUM_THREADS is.
        if (name == names[2] && getenv("DELAM_BENCH_AS_SHIPPED") != nullptr) continue;
        setenv(name, count.c_str(), 1);
    }
}

}  // namespace

Child start_child(const std::vector<std::string>& task, int threads) {
    int pipe_ends[2];
    if (pipe(pipe_ends) != 0) return {};
    const pid_t child = fork();
    if (child == 0) {
        dup2(pipe_ends[1], STDOUT_FILENO);
        close(pipe_ends[0]);
        close(pipe_ends[1]);
        set_environment(threads);
        std::vector<std::string> words{"delam_bench", "--child"};
        words.insert(words.end(), task.begin(), task.end());
        std::vector<char*> arguments;
        for (auto& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        execv("/proc/self/exe", arguments.data());
        _exit(127);
    }
    close(pipe_ends[1]);
    return {child, pipe_ends[0]};
}

Json answer_of(const Child& child) {
    if (child.answer < 0) return {{"error", "pipe failed"}};
    std::string text;
    char buffer[65536];
    for (ssize_t n = 0; (n = read(child.answer, buffer, sizeof buffer)) > 0;)
        text.append(buffer, static_cast<std::size_t>(n));
    close(child.answer);
    if (child.process < 0) return {{"error", "fork failed"}};
    int status = 0;
    waitpid(child.process, &status, 0);
    Json answer = Json::parse(text, nullptr, false);
    if (answer.is_discarded()) return {{"error", "the child ended with status " + std::to_string(status)}};
    return answer;
}

Json ask_child(const std::vector<std::string>& task, int threads) { return answer_of(start_child(task, threads)); }

Json run_child_task(const std::vector<std::string>& task) {
    try {
        const auto word = [&](std::size_t i) { return i < task.size() ? task[i] : std::string(); };
        const auto number = [&](std::size_t i) { return std::strtod(word(i).c_str(), nullptr); };
        if (word(0) == "series") return measure_series(word(1), static_cast<int>(number(2)), number(3));
        if (word(0) == "memory") return measure_memory(word(1), word(2), number(3));
        if (word(0) == "agreement") return measure_agreement(word(1), number(2), number(3));
        if (word(0) == "critical") return measure_critical(word(1), number(2));
        if (word(0) == "concepts") return measure_concepts(word(1), static_cast<int>(number(2)), number(3));
#ifdef DELAM_SCENE_FILES
        if (word(0) == "analysis") return measure_analysis(word(1), {task.begin() + 2, task.end()});
#endif
        return {{"error", "unknown task '" + word(0) + "'"}};
    } catch (const std::exception& e) {
        return {{"error", e.what()}};
    }
}

}  // namespace bench
