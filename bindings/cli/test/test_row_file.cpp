// SPDX-License-Identifier: BSD-3-Clause
// Rows of a history are appended, replaced from any row on, and continued; at any time the file on disk is a complete
// table.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <unistd.h>

#include "file/input_file.hpp"
#include "file/row_file.hpp"
#include "text/error.hpp"

namespace {

int failures = 0;

void expect(bool condition, const char* what) {
    std::printf("%s %s\n", condition ? "ok   " : "FAIL ", what);
    if (!condition) ++failures;
}

bool throws_missing_rows(const std::string& path, std::size_t rows) {
    try {
        const cli::RowFile file(path, rows, std::nullopt);
    } catch (const cli::Failure& failure) {
        return failure.code() == cli::exit_scene &&
               std::string(failure.what()).find("rows are missing") != std::string::npos;
    }
    return false;
}

void growing(const std::string& path) {
    cli::RowFile file(path, "step,a\n");
    expect(file.rows() == 0 && cli::read_bytes(path) == "step,a\n", "a new table has its header alone");
    file.append("0,1\n");
    file.append("1,22\n");
    expect(file.rows() == 2 && cli::read_bytes(path) == "step,a\n0,1\n1,22\n", "rows are on the disk when appended");
}

void replacing(const std::string& path) {
    cli::RowFile file(path, "step,a\n");
    for (const char* row : {"0,1\n", "1,22\n", "2,333\n"}) file.append(row);
    // A step that revises the two before it.
    file.replace_from(1, {"1,7\n", "2,88\n", "3,9\n"});
    expect(file.rows() == 4 && file.text() == "step,a\n0,1\n1,7\n2,88\n3,9\n",
           "revised rows and the new one replace the old ones");
    expect(cli::read_bytes(path) == "step,a\n0,1\n1,22\n2,333\n", "the file is as it was until it is settled");
    file.append("4,5\n");
    file.settle();
    expect(cli::read_bytes(path) == "step,a\n0,1\n1,7\n2,88\n3,9\n4,5\n", "it grows on after that");
    expect(file.content() == cli::content_of(cli::read_bytes(path)), "its hash is that of the file");
    file.replace_from(0, {"0,0\n"});
    expect(file.rows() == 1 && file.text() == "step,a\n0,0\n", "the whole table can be replaced");
    file.replace_from(1, {"1,1\n"});
    expect(file.rows() == 2 && file.text() == "step,a\n0,0\n1,1\n", "nothing to replace: it grows");
    file.settle();
    expect(!std::filesystem::exists(path + ".new") && !std::filesystem::exists(path + ".revised"),
           "nothing is left beside it");
    bool refused = false;
    try {
        file.replace_from(3, {"3,3\n"});
    } catch (const cli::Failure&) {
        refused = true;
    }
    expect(refused && file.rows() == 2, "rows beyond the last one are refused");
}

void going_on(const std::string& path) {
    cli::write_atomic(path, "step,a\n0,1\n1,22\n2,333\n3,44");
    expect(throws_missing_rows(path, 4), "a row without its end is no row");
    const cli::Content saved = cli::content_of("step,a\n0,1\n1,22\n");
    bool refused = false;
    try {
        const cli::RowFile other(path, 2, cli::content_of("step,a\n0,1\n1,23\n"));
    } catch (const cli::Failure&) {
        refused = true;
    }
    expect(refused, "rows that are not as they were saved are refused");
    cli::RowFile file(path, 2, saved);
    expect(file.rows() == 2 && cli::read_bytes(path) == "step,a\n0,1\n1,22\n", "rows beyond a saved state are cut off");
    file.append("2,5\n");
    file.replace_from(1, {"1,6\n", "2,7\n"});
    expect(file.text() == "step,a\n0,1\n1,6\n2,7\n", "rows of before are replaced too");
    expect(throws_missing_rows(path, 4), "missing rows are refused");
}

}  // namespace

int main() {
    std::string folder = std::filesystem::temp_directory_path() / "delam_rows_XXXXXX";
    if (mkdtemp(folder.data()) == nullptr) return 1;
    growing(folder + "/growing.csv");
    replacing(folder + "/replacing.csv");
    going_on(folder + "/going_on.csv");
    std::filesystem::remove_all(folder);
    return failures == 0 ? 0 : 1;
}
