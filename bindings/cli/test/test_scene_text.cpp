// SPDX-License-Identifier: BSD-3-Clause
// The levels of a text, counted before toml++ reads it, are those of the tree that it makes; a text with too many is
// refused by its place, on a small stack.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include <sys/resource.h>

#include "scene/table/scene_text.hpp"
#include "text/error.hpp"
#include "text/wording.hpp"

namespace {

int failures = 0;

void expect(bool condition, const std::string& what) {
    if (!condition) std::printf("FAIL  %s\n", what.c_str());
    if (!condition) ++failures;
}

// As deepest() counts: every key and every list or table within a list.
int levels_of(const toml::node& node) {
    int most = 0;
    if (const toml::table* table = node.as_table())
        for (const auto& [key, value] : *table) most = std::max(most, 1 + levels_of(value));
    if (const toml::array* list = node.as_array())
        for (const toml::node& value : *list)
            if (value.is_table() || value.is_array()) most = std::max(most, 1 + levels_of(value));
    return most;
}

void counted() {
    const std::pair<const char*, cli::Depth> texts[] = {
        {"", {0, 0}},
        {"a = 1.5.5", {1, 1}},
        {"a.b = 1", {2, 1}},
        {"\n[a]\nb.c.d = 1", {4, 3}},
        {"[[a . b]]\n", {3, 1}},
        {"a = [[1], [[2]]]", {3, 1}},
        {"a = { b.c = { d = 1 }, e.f.g.h.i.j = 2 }", {7, 1}},
        {"a = \"[[[[\" # [[[[\nb.c = '{{{{'", {2, 2}},
        {"a = \"\"\"\n\\\"\"\"[[[[[[\"\"\"\"\"\nb.c = 1", {2, 3}},
        {"a = '''\n''[[[[[['''\nb.c = 1", {2, 3}},
        {"a.\"b.b.b\".'c.c' = 1", {3, 1}},
        {"a = [ # ]\n[1],\n[[2]] ]\n[b]\nc = 1", {3, 3}},
        {"\xEF\xBB\xBF[a.b.c.d]\r\n", {4, 1}},
        {"a = 1979-05-27T07:32:00.999\nb.c.d = 1", {3, 2}},
    };
    for (const auto& [text, wanted] : texts) {
        const cli::Depth got = cli::deepest(text);
        expect(got.levels == wanted.levels && got.line == wanted.line,
               std::string(text) + ": " + std::to_string(got.levels) + " levels, line " + std::to_string(got.line));
    }
}

class Writer {
public:
    explicit Writer(unsigned seed) : random_(seed) {}

    std::string text() {
        std::string out;
        for (std::size_t i = below(4); i > 0; --i) out += assignment(2);
        for (std::size_t i = below(4); i > 0; --i) {
            const bool list = below(2) == 0;
            out += (list ? "[[" : " [ ") + key() + (list ? "]]" : " ] ") + comment();
            for (std::size_t k = below(4); k > 0; --k) out += assignment(2);
        }
        return out;
    }

private:
    std::size_t below(std::size_t count) { return random_() % count; }

    std::string comment() { return below(3) == 0 ? " # [[{{ '\" a.b.c = 1\n" : "\n"; }

    std::string key() {
        std::string out;
        for (std::size_t i = 1 + below(4); i > 0; --i) {
            const std::string fresh = std::to_string(++number_);
            const std::string parts[] = {"k" + fresh, "\"k.\\\"[{" + fresh + "\"", "'k.[#" + fresh + "'"};
            out += parts[below(3)] + (i > 1 ? (below(2) == 0 ? "." : " . ") : "");
        }
        return out;
    }

    std::string value(std::size_t deeper) {
        static const char* const plain[] = {"1.25",
                                            "true",
                                            "\"[[ \\\\\\\" = #\"",
                                            "'[{ \"\\'",
                                            "\"\"\"a\n[[\"\" # {{\n\\\"\"\"\"\"\"",
                                            "'''\n[[''\n'''''",
                                            "1979-05-27T07:32:00.5",
                                            "[]",
                                            "[ 1.5, [ 2.5 ], # ]\n [ [ \"]\" ] ] ]"};
        const std::size_t kind = below(deeper > 0 ? 5 : 3);
        if (kind < 3) return plain[below(std::size(plain))];
        std::string out = kind == 3 ? "[" : "{ ";
        const std::size_t count = below(4);
        for (std::size_t i = 0; i < count; ++i)
            out += (i > 0 ? ", " : "") + (kind == 3 ? value(deeper - 1) : key() + " = " + value(deeper - 1));
        return out + (kind == 3 ? "]" : " }");
    }

    std::string assignment(std::size_t deeper) { return key() + " = " + value(deeper) + comment(); }

    std::minstd_rand random_;
    int number_ = 0;
};

void like_the_tree() {
    int deepest = 0;
    int deep = 0;
    for (unsigned seed = 1; seed <= 3000; ++seed) {
        const std::string text = Writer(seed).text();
        try {
            const int levels = levels_of(toml::parse(text));
            expect(cli::deepest(text).levels == levels, "seed " + std::to_string(seed) + ":\n" + text);
            deepest = std::max(deepest, levels);
            deep += levels > 6 ? 1 : 0;
        } catch (const toml::parse_error& e) {
            expect(false,
                   "seed " + std::to_string(seed) + " is not TOML: " + std::string(e.description()) + "\n" + text);
        }
    }
    expect(deepest >= 12 && deep > 300, "the texts are deep: " + std::to_string(deep) + " of them");
}

// A header [a.b] within a list a leads through its last entry, one level that the text does not show.
void files_below(const std::filesystem::path& folder, int most, bool all_are_toml) {
    int read = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file() || (all_are_toml && entry.path().extension() != ".toml")) continue;
        std::ifstream file(entry.path(), std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(file), {}};
        text.resize(std::min(text.size(), text.find("\n== mesh.inp\n")));
        const int levels = cli::deepest(text).levels;
        if (levels > cli::most_levels && !all_are_toml) continue;
        try {
            const int tree = levels_of(toml::parse(text));
            expect(levels <= tree && tree <= 2 * levels, entry.path().string());
            ++read;
        } catch (const toml::parse_error&) {
            expect(!all_are_toml, entry.path().string() + " is not TOML");
        }
        expect(levels <= most, entry.path().string() + ": " + std::to_string(levels) + " levels");
    }
    expect(read > 5, folder.string() + ": " + std::to_string(read) + " files");
}

std::string repeated(const std::string& text, int count) {
    std::string out;
    for (int i = 0; i < count; ++i) out += text;
    return out;
}

void refused_when_deep() {
    for (const int levels : {33, 5000, 60000}) {
        const std::string many = repeated("a.", levels - 1) + "a";
        const std::string texts[] = {"\n[" + many + "]\n",
                                     "\n[[" + repeated("a.", levels - 2) + "a]]\n",
                                     "\n" + many + " = 1\n",
                                     "\n" + repeated("'a'.", levels - 1) + "a = 1\n",
                                     "\na = { " + repeated("a.", levels - 2) + "a = 1 }\n",
                                     "\na = " + repeated("[", levels) + repeated("]", levels) + "\n",
                                     "\na = " + repeated("{ a = ", levels - 1) + "1" + repeated("}", levels - 1),
                                     "\n" + many,
                                     "\xEF\xBB\xBF\n[" + many + "]"};
        for (const std::string& text : texts) {
            std::string said;
            try {
                cli::parsed_text(text, {"scene.toml", "", 0}, "scene.toml");
            } catch (const cli::SceneFailure& failure) {
                said = failure.what();
            }
            expect(said == "scene.toml:2: " + std::to_string(levels) +
                               " levels of tables, keys and lists within each other: at most 32 are allowed",
                   text.substr(0, 20) + ": " + said);
        }
    }
    const std::string many = repeated("a.", 31) + "a";
    for (const std::string& text : {"[" + many + "]\n", many + " = 1\n"})
        expect(levels_of(cli::parsed_text(text, {"scene.toml", "", 0}, "scene.toml")) == 32, "32 levels are read");
}

}  // namespace

int main() {
    const rlimit small{512 << 10, 512 << 10};
    expect(::setrlimit(RLIMIT_STACK, &small) == 0, "a small stack");
    const char* source = std::getenv("DELAM_SOURCE");
    expect(source != nullptr, "DELAM_SOURCE is set");
    counted();
    like_the_tree();
    if (source != nullptr) {
        const std::filesystem::path root(source);
        files_below(root / "examples", 7, true);
        files_below(root / "verify/fuzz/corpus/scene", cli::most_levels, false);
    }
    refused_when_deep();
    std::printf("%s\n", failures == 0 ? "ok" : "failed");
    return failures == 0 ? 0 : 1;
}
