// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "command/commands.hpp"
#include "command/interrupt.hpp"
#include "command/progress.hpp"
#include "file/file.hpp"
#include "file/output_folder.hpp"
#include "file/own_files.hpp"
#include "file/row_file.hpp"
#include "file/state.hpp"
#include "model/build.hpp"
#include "model/library/call.hpp"
#include "model/library/named.hpp"
#include "model/notes.hpp"
#include "result/closing/closing.hpp"
#include "result/fields/fields.hpp"
#include "result/history/concept.hpp"
#include "result/history/history.hpp"
#include "result/history/jumps.hpp"
#include "result/history/revision.hpp"
#include "result/result.hpp"
#include "scene/read_scene.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

extern "C" std::int32_t on_progress(const char* stage, std::int64_t done, std::int64_t total, void* user) {
    static_cast<Progress*>(user)->stage(stage, done, total);
    return Interrupt::requested() ? 1 : 0;
}

struct Log {
    Progress& progress;
    const Model& model;
    const Scene& scene;
    std::vector<std::string>* of_scene;  // keeps the warnings before the first step; null: there was one
};

extern "C" void on_log(std::int32_t level, const char* text, void* user) {
    // The program says itself that it was interrupted.
    if (Interrupt::requested() && std::string_view(text).starts_with("cancelled by the host")) return;
    const Log& log = *static_cast<Log*>(user);
    if (level > 1) return;
    try {
        const std::string said = with_elements(said_of_scene(text, log.model), {}, log.scene).message;
        if (level == 1 && log.of_scene != nullptr) log.of_scene->push_back(said);
        log.progress.note(fmt::format("{}: {}", level == 0 ? "error" : "warning", said));
    } catch (const std::exception&) {
        // There is no memory for the words; what ends the run says so.
    }
}

// Reads results, whatever it takes: a request to stop that arrives meanwhile ends the call that reads, and is obeyed
// once the results are written. The second signal ends the program, and there are two kinds.
template <class Work>
auto to_the_end(Work&& work) {
    for (int left = 2;; --left) {
        try {
            return work();
        } catch (const Failure& failure) {
            if (failure.code() != exit_interrupted || left == 0) throw;
        }
    }
}

// One run: the analysis and its files.
class Run {
public:
    Run(const Scene& scene, const Model& model, Solver solver, bool converged, OutputFolder& folder, Bulk* bulk)
        : scene_(scene),
          model_(model),
          solver_(std::move(solver)),
          folder_(folder),
          history_(model, scene, solver_.get()),
          fields_(folder.running(), scene, bulk),
          running_history_(folder.running() + "/history.csv"),
          running_state_(folder.running() + "/state.bin"),
          running_origin_(folder.running() + "/origin.json") {
        state_.content_hash = scene.content_hash;
        state_.problem_hash = hash_of(model);
        origin_.started = now_text();
        if (!converged) state_.not_converged.push_back(0);
    }

    void begin() {
        folder_.begin();
        write_atomic(running_origin_, packed(origin_));
        rows_.emplace(running_history_, history_.header());
        to_the_end([this] { record(); });
        save();
    }

    void resume(const StateFile& file) {
        const State& state = file.state;
        state_ = state;
        saved_step_ = state.step;
        const bool sealed = file.format >= first_sealed_format;
        const auto step = static_cast<std::size_t>(state.step);
        origin_ = file.origin ? *file.origin : read_origin(running_origin_);
        origin_.resumed += 1;
        call(model_.context.get(),
             delam_solver_load(solver_.get(), static_cast<std::int64_t>(state.bytes.size()),
                               reinterpret_cast<const std::uint8_t*>(state.bytes.data())),
             running_state_);
        if (history_.value(solver_.get(), "step") != static_cast<double>(state.step))
            throw Failure(exit_scene,
                          running_state_ + ": it is of another step than it says; run again without --resume");
        fields_.resume(step, sealed ? std::optional(state.companions) : std::nullopt);
        // Rows of steps after the saved state are computed again, and with them the earlier ones that they revise.
        rows_.emplace(running_history_, step + 1, sealed ? std::optional(state.companions.history) : std::nullopt);
        const std::string text = rows_->text();
        history_.go_on_under(text.substr(0, text.find('\n') + 1));
        if (fields_.judges()) last_seen_ = to_the_end([this] { return sight(); });
        write_atomic(running_origin_, packed(origin_));
    }

    // Returns the exit code of the analysis; outcome.reason is the reason why it stopped early.
    Exit analyse(Progress& progress, Outcome& outcome) {
        const auto total = static_cast<std::int64_t>(scene_.step_count());
        bool first = true;
        while (state_.step < total) {
            if (Interrupt::requested()) return stopped(outcome);
            const double time = scene_.times[static_cast<std::size_t>(state_.step) + 1];
            const std::int32_t status = delam_solver_advance(solver_.get(), time);
            if (status == DELAM_CANCELLED) return stopped(outcome);
            if (status != DELAM_OK && status != DELAM_NOT_CONVERGED) {
                const std::string text = named(delam_context_message(model_.context.get()), scene_, model_);
                outcome.reason = fmt::format("step {}, time {}: {} ({})", state_.step + 1, time,
                                             with_elements(text, {}, scene_).message, delam_status_name(status));
                return status == DELAM_LIMIT ? exit_not_converged : exit_numerical;
            }
            to_the_end([this] { choose(); });
            call(model_.context.get(), delam_solver_commit(solver_.get()), std::string("commit"));
            state_.step += 1;
            if (status == DELAM_NOT_CONVERGED) state_.not_converged.push_back(state_.step);
            const bool revised = to_the_end([this] { return record(); });
            // The first step of each process as well: a run that is ended again and again still gets on.
            if (first || revised || Clock::now() - saved_ > interval_) save();
            first = false;
            to_the_end([&] {
                progress.step(state_.step, time, history_.load(solver_.get()),
                              static_cast<std::int64_t>(history_.value(solver_.get(), "am_iterations")),
                              status == DELAM_OK);
            });
        }
        return state_.not_converged.empty() ? exit_done : exit_not_converged;
    }

    void publish(Outcome& outcome) {
        save();
        outcome.complete = state_.step == static_cast<std::int64_t>(scene_.step_count());
        outcome.steps_done = state_.step;
        outcome.not_converged = state_.not_converged;
        outcome.resumed = origin_.resumed;
        outcome.started = origin_.started;
        outcome.problem_hash = state_.problem_hash;
        BulkFacts bulk = fields_.assemble(model_, scene_, static_cast<std::size_t>(state_.step), state_.problem_hash,
                                          concept_of(solver_.get()));
        // Without fields, the last state is estimated; of many processes, none has all displacements.
        const bool examined = !scene_.output.brief && !fields_.on_many_processes();
        if (!std::isfinite(bulk.mesh_error.away) && examined) bulk.mesh_error = mesh_error_of(model_, solver_.get());
        outcome.closing = closing_of(model_, solver_.get(), scene_, rows_->text(), bulk, outcome.complete && examined);
        outcome.closing_lines = closing_lines(outcome.closing, scene_);
        outcome.has_jumps = writes_jumps(outcome.closing.jumps, solver_.get());
        const std::string jumps_file = folder_.running() + "/jumps.csv";
        if (outcome.has_jumps)
            write_atomic(jumps_file, jumps_text(outcome.closing.jumps, scene_));
        else
            remove_file(jumps_file);  // of an earlier attempt
        outcome.files = folder_.contents();
        write_atomic(folder_.running() + "/result.json", result_text(model_, solver_.get(), scene_, outcome));
        folder_.publish();
        if (outcome.complete) folder_.end();
    }

    // Ends the run.
    Solver release() { return std::move(solver_); }

    [[nodiscard]] const State& state() const { return state_; }
    // The starting point of a later --resume; none: nothing is saved yet.
    [[nodiscard]] std::optional<std::int64_t> saved_step() const { return saved_step_; }

private:
    static Exit stopped(Outcome& outcome) {
        outcome.reason = "interrupted";
        return exit_interrupted;
    }

    [[nodiscard]] Sight sight() const {
        Sight out{history_.value(solver_.get(), "dissipated"), history_.value(solver_.get(), "jumps"), {}};
        for (const PatternData& pattern : scene_.patterns)
            out.reactions.push_back(std::abs(history_.value(solver_.get(), "reaction:" + pattern.name)));
        return out;
    }

    // Chooses instants by the pending step and those that it replaces, and writes the fields of the step before these
    // if it is chosen now: once the pending step is committed, that one is gone.
    void choose() {
        if (!fields_.judges()) return;
        const std::int64_t pending = state_.step + 1, first = revised_from(model_, solver_.get(), pending);
        const auto seen = [this](std::int64_t step) {
            const SelectedStep selected(model_, solver_.get(), step);
            return sight();
        };
        Sight before = first == pending && last_seen_ ? *last_seen_ : seen(first - 1);
        bool collapses = false;
        for (std::int64_t step = first; step <= pending; ++step) {
            Sight now = step == pending ? sight() : seen(step);
            fields_.judge(static_cast<std::size_t>(step), before, now);
            if (step == first) collapses = now.collapses_from(before);
            before = std::move(now);
        }
        last_seen_ = std::move(before);
        const auto number = static_cast<std::size_t>(first - 1);
        if (!fields_.chosen(number) || fields_.written(number)) return;
        const SelectedStep selected(model_, solver_.get(), first - 1);
        fields_.write_step(model_, solver_.get(), scene_, number, collapses);
    }

    // Writes the fields, then the row: a step with a row is complete. Rewrites steps that this one revised; true if
    // there were any.
    bool record() {
        const std::int64_t first = state_.step > 0 ? revised_from(model_, solver_.get(), state_.step) : state_.step;
        std::vector<std::string> rows;
        for (std::int64_t step = first; step < state_.step; ++step) {
            const SelectedStep selected(model_, solver_.get(), step);
            rows.push_back(step_row(step));
        }
        rows.push_back(step_row(state_.step));
        if (rows.size() == 1)
            rows_->append(rows.front());
        else
            rows_->replace_from(static_cast<std::size_t>(first), rows);
        return rows.size() > 1;
    }

    // Writes the fields and returns the row.
    std::string step_row(std::int64_t step) {
        const auto number = static_cast<std::size_t>(step);
        if (fields_.chosen(number)) fields_.write_step(model_, solver_.get(), scene_, number);
        return history_.row(solver_.get());
    }

    void save() {
        std::int64_t size = 0;
        call(model_.context.get(), delam_solver_save(solver_.get(), 0, nullptr, &size), running_state_);
        const Clock::time_point begun = Clock::now();
        state_.bytes.resize(static_cast<std::size_t>(size));
        call(model_.context.get(),
             delam_solver_save(solver_.get(), size, reinterpret_cast<std::uint8_t*>(state_.bytes.data()), &size),
             running_state_);
        fields_.synchronise_steps();
        rows_->synchronise();
        state_.companions.history = rows_->content();
        fields_.seal(static_cast<std::size_t>(state_.step), state_.companions);
        write_atomic(running_state_, pack(state_));
        rows_->settle();
        fields_.settle();
        saved_step_ = state_.step;
        saved_ = Clock::now();
        // Up to a twentieth of the time goes into saving, but for states so large that they are saved every second.
        interval_ = std::clamp<Clock::duration>(20 * (saved_ - begun), shortest_interval, longest_interval);
    }

    using Clock = std::chrono::steady_clock;
    static constexpr Clock::duration shortest_interval = std::chrono::milliseconds(100);
    static constexpr Clock::duration longest_interval = std::chrono::seconds(1);

    const Scene& scene_;
    const Model& model_;
    Solver solver_;
    OutputFolder& folder_;
    History history_;
    Fields fields_;
    std::string running_history_;
    std::string running_state_;
    std::string running_origin_;
    std::optional<RowFile> rows_;
    State state_;
    std::optional<Sight> last_seen_;  // of the committed step
    Origin origin_;
    std::optional<std::int64_t> saved_step_;
    Clock::time_point saved_;
    Clock::duration interval_ = shortest_interval;
};

// The state from which to continue, if there is one; refuses that of another scene.
std::optional<StateFile> find_state(const OutputFolder& folder, const Scene& scene, const Model& model) {
    const std::string path = folder.running() + "/state.bin";
    if (!is_there(path)) return std::nullopt;
    StateFile file = read_state(path);
    const State& state = file.state;
    if (state.content_hash != scene.content_hash || state.problem_hash != hash_of(model))
        throw Failure(exit_scene, fmt::format("{}: the scene, with its --set, is not the one that {} was started with; "
                                              "run again without --resume",
                                              scene.file, folder.path()));
    if (state.step > static_cast<std::int64_t>(scene.step_count()))
        throw Failure(exit_scene,
                      fmt::format("{}: it says that step {} is done, and the scene has {}; run again without "
                                  "--resume",
                                  path, state.step, scene.step_count()));
    if (file.format < first_sealed_format)
        say("{}: of format {}, whose first line, history and fields no checksum covers; they are taken as they are\n",
            path, file.format);
    return file;
}

// A word in shell syntax.
std::string shell_word(const std::string& word) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) != 0 || std::string_view("_-+=.,:/@%").find(static_cast<char>(c)) != std::string::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

// The command that reproduces this result.
std::string command_again(const Caller& caller, const Scene& scene, const std::string& folder_path) {
    std::string out = fmt::format("{} run {} --out {}", caller.name, shell_word(scene.file), shell_word(folder_path));
    for (const std::string& setting : scene.settings) out += " --set " + shell_word(setting);
    return out;
}

// Returns the command to type once files can be written again.
std::string way_on(const Run& work, const OutputFolder& folder, const std::string& again) {
    const std::optional<std::int64_t> saved = work.saved_step();
    if (!saved) return "nothing is saved yet; once there is room, start again with: " + again;
    return fmt::format("{} saved in {}; once there is room, go on with: {} --resume",
                       *saved == 0 ? "the initial state is"
                                   : fmt::format("{} of {} are", *saved, counted(work.state().step, "finished step")),
                       folder.running(), again);
}

void say_lines(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) say("{}\n", line);
}

int already_complete(OutputFolder& folder, const Scene& scene) {
    if (is_there(folder.running() + "/state.bin")) return -1;
    const Published published = published_in(folder.path());
    if (published.status != "complete") return -1;
    if (published.content_hash != scene.content_hash)
        throw Failure(exit_scene, fmt::format("{}: the scene, with its --set, is not the one of the result in {}; "
                                              "run again without --resume",
                                              scene.file, folder.path()));
    require_unchanged(folder.path(), published);
    folder.end();  // an earlier call may have been interrupted
    say("{}: complete already\n", folder.path());
    if (published.files.empty())
        say("result.json names no files, as those of earlier versions: history.csv and the others were not compared\n");
    say_lines(published.closing);
    return published.converged ? exit_done : exit_not_converged;
}

struct Analysis {
    const Scene& scene;
    const Model& model;
    const std::optional<StateFile>& state;
    OutputFolder& folder;
    Progress& progress;
    const std::string& command;  // as typed
    const std::string& again;    // that reproduces the result
    Log& log;
    Bulk* bulk;
    Solver& solver;  // of the analysis before, or null; then of this one
};

// Everything after the words of the beginning.
int analyse(const Analysis& of) {
    const auto& [scene, model, state, folder, progress, command, again, log, bulk, solver] = of;
    bool converged = true;
    Solver own = new_solver(model, scene, std::move(solver), converged);
    std::vector<std::string>& warnings = *log.of_scene;
    log.of_scene = nullptr;
    if (!converged) say("warning: the displacement of the initial state did not converge\n");
    Outcome outcome;
    outcome.command = command;
    outcome.warnings = std::move(warnings);
    Run work(scene, model, std::move(own), converged, folder, bulk);
    Exit code = exit_done;
    try {
        if (state)
            work.resume(*state);
        else
            work.begin();
        code = work.analyse(progress, outcome);
        progress.finish();
        to_the_end([&] { work.publish(outcome); });
        solver = work.release();
    } catch (const OutputFailure& failure) {
        progress.finish();
        throw Failure(exit_output, fmt::format("{}\n{}", failure.what(), way_on(work, folder, again)));
    }
    const auto total = static_cast<std::int64_t>(scene.step_count());
    say_lines(outcome.closing_lines);
    if (code == exit_interrupted || !outcome.reason.empty()) {
        const std::int64_t done = work.state().step;
        const char* how = code == exit_interrupted ? "interrupted" : "stopped";
        if (done > 0)
            complain("delam: {} after step {} of {}; the finished steps are in {}, marked incomplete\n", how, done,
                     total, folder.path());
        else
            complain("delam: {} before any of {} was finished; {} holds the initial state, marked incomplete\n", how,
                     counted(total, "step"), folder.path());
        if (code == exit_interrupted)
            complain("delam: {} with: {}{}\n", done > 0 ? "go on" : "start again", again, done > 0 ? " --resume" : "");
        else
            complain("delam: {}\n", outcome.reason);
        if (code != exit_interrupted && scene.imported && option_text(solver.get(), "kinematics") == "corotational")
            complain(
                "delam: with large rotations, NLGEOM=YES of the deck, an analysis may stop where small ones go on: "
                "--set solver.kinematics=linear\n");
        return code;
    }
    if (code == exit_not_converged)
        complain("delam: {} did not converge (of {}), the first is step {}\n",
                 counted(static_cast<std::int64_t>(outcome.not_converged.size()), "step"), total,
                 outcome.not_converged.front());
    say("wrote {}: history.csv, {}{}result.json, state.bin\n", folder.path(), outcome.has_jumps ? "jumps.csv, " : "",
        scene.output.fields.empty() ? "" : "fields.h5, fields.xdmf, ");
    return code;
}

}  // namespace

int run(const std::string& scene_file, const std::vector<std::string>& settings, const std::string& folder_path,
        bool resume, const std::string& command, const Caller& caller) {
    if (folder_path.empty()) throw Failure(exit_scene, "--out: the name of the folder is empty");
    const Scene scene = read_scene(scene_file, settings);
    if (scene.imported) say_lines(import_lines(*scene.imported));
    const std::string again = command_again(caller, scene, folder_path);
    Former former = caller.former != nullptr ? std::exchange(*caller.former, {}) : Former{};
    Context context = former.context != nullptr ? std::move(former.context) : new_context();
    const Interrupt interrupt(context.get());
    Progress progress(static_cast<std::int64_t>(scene.step_count()));
    delam_context_set_progress(context.get(), on_progress, &progress);
    Model model = build(std::move(context), scene);
    progress.clear();
    OutputFolder folder(folder_path);
    if (resume)
        if (const int code = already_complete(folder, scene); code >= 0) return code;
    const std::optional<StateFile> state = resume ? find_state(folder, scene, model) : std::nullopt;
    if (state && !scene.output.sensitivities.empty())
        throw Failure(exit_scene,
                      fmt::format("{}: output.sensitivities are followed from the initial state on: run again "
                                  "without --resume",
                                  scene.file));
    const std::int64_t first = state ? state->state.step : 0;
    progress.begin_after(first);
    std::vector<std::string> warnings = warnings_of(model, scene);
    Log log{progress, model, scene, &warnings};
    delam_context_set_log(model.context.get(), on_log, &log);
    say("delam {} ({}): {}{}\n", delam_version(), delam_commit(), scene_file,
        scene.title.empty() ? "" : ", " + scene.title);
    if (resume) say("{}\n", state ? fmt::format("resumed after step {}", first) : "nothing to resume: started anew");
    for (const std::string& text : warnings) say("warning: {}\n", text);
    std::fflush(stdout);

    const Analysis analysis{scene, model, state, folder, progress, command, again, log, caller.bulk, former.solver};
    const auto rest = [&] { return analyse(analysis); };
    const int code = caller.around ? caller.around(model, rest) : rest();
    if (caller.former == nullptr) return code;
    delam_context_set_log(model.context.get(), nullptr, nullptr);
    delam_context_set_progress(model.context.get(), nullptr, nullptr);
    *caller.former = {std::move(model.context), std::move(former.solver)};
    return code;
}

}  // namespace cli
