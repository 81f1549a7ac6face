// SPDX-License-Identifier: BSD-3-Clause
#include "file/output_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "file/file.hpp"
#include "file/input_file.hpp"
#include "file/own_files.hpp"
#include "file/state.hpp"
#include "text/error.hpp"
#include "text/reason.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

nlohmann::json result_json(const std::string& folder) {
    const std::string file = folder + "/result.json";
    if (!is_there(file)) return nullptr;
    return nlohmann::json::parse(read_bytes(file, most_result_bytes), nullptr, false);
}

bool is_of_program(const nlohmann::json& result) {
    const auto has_text = [&result](const char* name) { return result.contains(name) && result[name].is_string(); };
    return result.is_object() && result.value("program", nlohmann::json()) == "delam" && has_text("status") &&
           has_text("scene_content_hash");
}

// True if a result has a file of this name. Results of earlier versions do not say which they have.
bool is_of_result(const nlohmann::json& result, const std::string& name) {
    const auto files = result.find("files");
    return name == "result.json" || files == result.end() || files->contains(name);
}

// Throws OutputFailure where a run would replace or remove what is not its own.
void refuse_strange_files(const std::string& folder, const std::string& running) {
    const std::vector<std::string> names = names_in(running);
    for (const std::string& name : names) {
        const std::string file = running + "/" + name;
        if (!is_running_name(name))
            throw OutputFailure(running, "there is " + file + ", which no run has written: move it away");
        require_plain(file);
    }
    const bool marked = is_marked(running) || is_state(running + "/state.bin");
    if (!names.empty() && !marked)
        throw OutputFailure(running, "there is " + running + "/" + names.front() +
                                         ", and neither a marker nor a state says that a run has written it: "
                                         "move it away, or choose another folder");
    for (const std::string& name : result_names()) require_plain(folder + "/" + name);
    const nlohmann::json result = result_json(folder);
    const bool known = is_of_program(result);
    for (const std::string& name : result_names()) {
        const std::string file = folder + "/" + name;
        if (!is_there(file)) continue;
        // The folder has no result.json while a result is moved in, but it has `running`, and that is marked.
        if (!known && !marked)
            throw OutputFailure(folder, "there is " + file +
                                            ", which would be replaced, and no result.json of delam beside it: "
                                            "move it away, or choose another folder");
        if (known && !is_of_result(result, name))
            throw OutputFailure(folder,
                                "there is " + file + ", which does not belong to the result there: move it away");
    }
}

}  // namespace

OutputFolder::OutputFolder(const std::string& path) : path_(path), running_(path + "/running") {
    std::error_code code;
    fs::create_directories(path_, code);
    if (code) throw OutputFailure(path_, code.message());
    lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0) throw OutputFailure(path_, reason_of(errno));
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        const bool busy = errno == EWOULDBLOCK;
        ::close(lock_);
        if (busy) throw OutputFailure(path_, "another run is writing there");
        lock_ = -1;  // the file system has no locks
    }
    try {
        refuse_strange_files(path_, running_);
        fs::create_directory(running_, code);
        if (code) throw OutputFailure(running_, code.message());
        mark(running_);  // fails now, where nothing can be written, rather than after an hour of work
    } catch (...) {
        if (lock_ >= 0) ::close(lock_);
        throw;
    }
}

OutputFolder::~OutputFolder() {
    // Goes with the run that has left nothing in it.
    std::error_code code;
    try {
        const std::vector<std::string> names = names_in(running_);
        if (names.size() == 1 && names.front() == marker_name) remove_file(running_ + "/" + names.front());
    } catch (const Failure&) {
    }
    fs::remove(running_, code);  // only if it is empty
    if (lock_ >= 0) ::close(lock_);
}

void OutputFolder::begin() {
    // The state is removed first: if this is interrupted, no run continues from the rest.
    remove_file(running_ + "/state.bin");
    for (const std::string& name : names_in(running_))
        if (name != marker_name && is_running_name(name)) remove_file(running_ + "/" + name);
}

std::vector<NamedContent> OutputFolder::contents() const {
    std::vector<NamedContent> out;
    for (const std::string& name : result_names())
        if (const std::string file = running_ + "/" + name; name != "result.json" && is_there(file))
            out.push_back({name, content_of_file(file)});
    return out;
}

void OutputFolder::publish() {
    // A run may continue after this, so it keeps its own history and state. The copies are complete before any old file
    // is removed.
    for (const char* name : {"history.csv", "state.bin"}) {
        const std::string from = running_ + "/" + name;
        write_atomic(running_ + "/published_" + name, read_bytes(from));
    }
    remove_file(path_ + "/result.json");
    for (const char* name : {"history.csv", "state.bin"})
        rename_file(running_ + "/published_" + name, path_ + "/" + name);
    // Not every result has them, and those of an earlier result must not stay.
    for (const std::string name : {"/fields.h5", "/fields.xdmf", "/jumps.csv"}) {
        if (is_there(running_ + name))
            rename_file(running_ + name, path_ + name);
        else
            remove_file(path_ + name);
    }
    synchronise(path_);
    rename_file(running_ + "/result.json", path_ + "/result.json");
    synchronise(path_);
}

void OutputFolder::end() { begin(); }

Published published_in(const std::string& folder) {
    Published out;
    const nlohmann::json json = result_json(folder);
    if (!is_of_program(json)) return out;
    try {
        out.status = json.value("status", "");
        out.content_hash = json.value("scene_content_hash", "");
        out.converged = !json.contains("not_converged") || json["not_converged"].empty();
        if (const auto lines = json.find("closing"); lines != json.end()) out.closing = *lines;
        if (const auto files = json.find("files"); files != json.end())
            for (const auto& [name, file] : files->items())
                out.files.push_back({name, {file.at("bytes"), file.at("hash")}});
    } catch (const nlohmann::json::exception&) {
        throw Failure(exit_scene, folder + "/result.json: damaged; run the scene again, without --resume");
    }
    return out;
}

void require_unchanged(const std::string& folder, const Published& published) {
    for (const auto& [name, content] : published.files) {
        const std::string file = folder + "/" + name;
        if (std::find(result_names().begin(), result_names().end(), name) == result_names().end() || !is_there(file) ||
            !has_content(file, content))
            throw Failure(exit_scene,
                          file + ": missing, or not as the run has written it; run the scene again, without --resume");
    }
}

std::vector<std::string> discarded_files(const std::string& folder) {
    const std::string running = folder + "/running";
    refuse_strange_files(folder, running);
    std::vector<std::string> files;
    for (const std::string& name : names_in(folder)) {
        const auto& known = result_names();
        if (name != "running" && name != marker_name && std::find(known.begin(), known.end(), name) == known.end())
            throw OutputFailure(folder, "there is " + folder + "/" + name + ", which no run has written: move it away");
        if (name != "running") files.push_back(folder + "/" + name);
    }
    for (const std::string& name : names_in(running)) files.push_back(running + "/" + name);
    // The markers last: until then they say whose the others are.
    std::stable_partition(files.begin(), files.end(),
                          [](const std::string& file) { return !file.ends_with("/" + std::string(marker_name)); });
    return files;
}

void discard_result(const std::string& folder) {
    for (const std::string& file : discarded_files(folder)) remove_file(file);
    std::error_code code;
    for (const std::string& emptied : {folder + "/running", folder})
        if (!fs::remove(emptied, code) && code) throw OutputFailure(emptied, code.message());
}

}  // namespace cli
