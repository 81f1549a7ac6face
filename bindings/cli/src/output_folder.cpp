// SPDX-License-Identifier: BSD-3-Clause
#include "output_folder.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "error.hpp"
#include "file.hpp"
#include "input_file.hpp"

namespace cli {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(const std::string& path) : path_(path), running_(path + "/running") {
    std::error_code code;
    fs::create_directories(path_, code);
    if (code) throw OutputFailure(path_, code.message());
    lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0) throw OutputFailure(path_, std::strerror(errno));
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        const bool busy = errno == EWOULDBLOCK;
        ::close(lock_);
        if (busy) throw OutputFailure(path_, "another run is writing there");
        lock_ = -1;  // the file system has no locks
    }
    try {
        fs::create_directories(running_, code);
        if (code) throw OutputFailure(running_, code.message());
        // Fails now rather than after an hour of work.
        Appender(running_ + "/probe.new", 0).append("writable?\n");
        remove_file(running_ + "/probe.new");
    } catch (...) {
        if (lock_ >= 0) ::close(lock_);
        throw;
    }
}

OutputFolder::~OutputFolder() {
    std::error_code code;
    fs::remove(running_, code);  // only if it is empty
    if (lock_ >= 0) ::close(lock_);
}

void OutputFolder::begin() {
    std::error_code code;
    for (const fs::directory_entry& entry : fs::directory_iterator(running_, code)) remove_file(entry.path().string());
    if (code) throw OutputFailure(running_, code.message());
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
    for (const char* name : {"fields.h5", "fields.xdmf"}) rename_file(running_ + "/" + name, path_ + "/" + name);
    // Not every result has one, and that of an earlier result must not stay.
    if (fs::exists(running_ + "/jumps.csv"))
        rename_file(running_ + "/jumps.csv", path_ + "/jumps.csv");
    else
        remove_file(path_ + "/jumps.csv");
    synchronise(path_);
    rename_file(running_ + "/result.json", path_ + "/result.json");
    synchronise(path_);
}

void OutputFolder::end() { begin(); }

Published OutputFolder::published() const {
    Published out;
    const std::string file = path_ + "/result.json";
    if (!fs::exists(file)) return out;
    const auto json = nlohmann::json::parse(read_bytes(file), nullptr, false);
    if (!json.is_object()) return out;
    out.status = json.value("status", "");
    out.content_hash = json.value("scene_content_hash", "");
    out.converged = !json.contains("not_converged") || json["not_converged"].empty();
    if (const auto lines = json.find("closing"); lines != json.end() && lines->is_array())
        for (const auto& line : *lines)
            if (line.is_string()) out.closing.push_back(line);
    return out;
}

}  // namespace cli
