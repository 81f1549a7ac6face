// SPDX-License-Identifier: BSD-3-Clause
#include "scene/table/scene_text.hpp"
#include "text/wording.hpp"

#include <vector>

#include <fmt/format.h>

namespace cli {

namespace {

// Reads strings, comments, keys and brackets of TOML and skips all else.
class LevelCounter {
public:
    explicit LevelCounter(std::string_view text) : text_(text) {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // the byte order mark, which toml++ skips too
    }

    Depth count() {
        while (at_ < text_.size()) take();
        return deepest_;
    }

private:
    // An open list or inline table, and the levels down to itself.
    struct Bracket {
        bool table;
        int levels;
    };

    void take() {
        const char c = text_[at_];
        if (c == '"' || c == '\'') {
            at_table_ = false;
            skip_string();
            return;
        }
        ++at_;
        switch (c) {
            case '\n':
                ++line_;
                if (open_.empty()) begin_key(true);
                break;
            case '#':
                while (at_ < text_.size() && text_[at_] != '\n') ++at_;
                break;
            case ' ':
            case '\t':
            case '\r':
                break;
            case '[':
                if (at_table_)
                    take_header();
                else
                    open(false);
                break;
            case '{':
                open(true);
                break;
            case ']':
            case '}':
                if (!open_.empty()) open_.pop_back();
                in_key_ = false;
                break;
            case ',':
                if (!open_.empty() && open_.back().table) begin_key(false);
                break;
            case '.':
                if (in_key_) note(around() + ++parts_);
                break;
            case '=':
                if (in_key_) note(around() + parts_);
                in_key_ = false;
                break;
            default:
                at_table_ = false;
        }
    }

    // at_table: at the start of a line outside all brackets, where [ begins a table and no list.
    void begin_key(bool at_table) {
        in_key_ = true;
        at_table_ = at_table;
        parts_ = 1;
    }

    // Levels of the table in which a key stands.
    [[nodiscard]] int around() const { return open_.empty() ? header_ : open_.back().levels; }

    // parts_ stays that of the key to which the bracket belongs; behind it a comma or a line begins the next.
    void open(bool table) {
        const bool element = !open_.empty() && !open_.back().table;
        const int levels = element ? open_.back().levels + 1 : around() + parts_;
        note(levels);
        open_.push_back({table, levels});
        in_key_ = false;
        at_table_ = false;
        if (table) begin_key(false);
    }

    // [a.b] or [[a.b]], to its end or that of the line; the first [ is read already.
    void take_header() {
        header_ = 1;
        if (at_ < text_.size() && text_[at_] == '[') {
            ++header_;
            ++at_;
        }
        while (at_ < text_.size() && text_[at_] != ']' && text_[at_] != '\n' && text_[at_] != '#') {
            if (text_[at_] == '"' || text_[at_] == '\'') {
                skip_string();
                continue;
            }
            if (text_[at_++] == '.') ++header_;
        }
        note(header_);
        while (at_ < text_.size() && text_[at_] == ']') ++at_;
        at_table_ = false;
        in_key_ = false;
    }

    // A string to its end; one within a line ends with the line at the latest.
    void skip_string() {
        const char quote = text_[at_];
        const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
        const bool lines = text_.substr(at_, 3) == three;
        at_ += lines ? 3 : 1;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\n') {
                if (!lines) return;
                ++line_;
            }
            if (c == '\\' && quote == '"' && at_ + 1 < text_.size()) {
                if (text_[at_ + 1] == '\n') ++line_;
                at_ += 2;
                continue;
            }
            if (c == quote && (!lines || text_.substr(at_, 3) == three)) break;
            ++at_;
        }
        at_ += lines ? 3 : 1;
        // The string may end with up to two quotes before the closing three.
        for (int i = 0; lines && i < 2 && at_ < text_.size() && text_[at_] == quote; ++i) ++at_;
    }

    void note(int levels) {
        if (levels > deepest_.levels) deepest_ = {levels, line_};
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
    int header_ = 0;  // levels of the table whose header was last
    int parts_ = 1;   // of the key
    bool in_key_ = true;
    bool at_table_ = true;
    std::vector<Bracket> open_;
    Depth deepest_;
};

}  // namespace

Depth deepest(std::string_view text) { return LevelCounter(text).count(); }

toml::table parsed_text(std::string_view text, const Place& place, std::string_view source) {
    const Depth depth = deepest(text);
    if (depth.levels > most_levels)
        throw SceneFailure(place.path.empty() ? Place{place.file, "", depth.line} : place,
                           fmt::format("{} levels of tables, keys and lists within each other: at most {} are allowed",
                                       depth.levels, most_levels));
    return toml::parse(text, source);
}

}  // namespace cli
