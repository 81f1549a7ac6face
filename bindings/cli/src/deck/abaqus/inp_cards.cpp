// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/inp_cards.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "deck/abaqus/inp_parameters.hpp"
#include "deck/abaqus/keywords.hpp"
#include "file/input_file.hpp"
#include "mesh/mesh_file.hpp"
#include "text/wording.hpp"

namespace cli {

namespace {

constexpr std::size_t deepest_include = 8;
constexpr std::size_t most_files = 1000;

std::string trimmed(std::string_view text) {
    const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return std::string(text);
}

// Trims in place, so that a line that goes on in many others is not copied for each.
void trim_end(std::string& text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
}

// Each name of "instance"."set" may have quotes of its own.
std::string unquoted(std::string text) {
    std::erase(text, '"');
    return text;
}

// Fields between commas outside quotes; an empty last field is dropped.
std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> out;
    std::string field;
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (c == ',' && !quoted) {
            out.push_back(trimmed(field));
            field.clear();
        } else {
            field += c;
        }
    }
    if (!trimmed(field).empty()) out.push_back(trimmed(field));
    return out;
}

void parse_keyword_line(const std::string& line, InpCard& card) {
    std::vector<std::string> fields = split(line);
    std::string keyword;
    for (const char c : fields.at(0).substr(1))
        if (std::isspace(static_cast<unsigned char>(c)) == 0)
            keyword += c;
        else if (!keyword.empty() && keyword.back() != ' ')
            keyword += ' ';
    card.keyword = upper(trimmed(keyword));
    if (card.keyword.empty()) throw SceneFailure(card.place, "a keyword is expected after *");
    const abaqus::Keyword* keyword_meant = abaqus::keyword_of(card.keyword);
    if (keyword_meant != nullptr) card.keyword = keyword_meant->name;
    std::set<std::string> known;
    for (std::size_t i = 1; i < fields.size(); ++i) {
        if (fields[i].empty()) continue;
        const std::size_t equals = fields[i].find('=');
        std::string name = upper(trimmed(fields[i].substr(0, equals)));
        std::string value = equals == std::string::npos ? "" : unquoted(trimmed(fields[i].substr(equals + 1)));
        const abaqus::Parameter* parameter =
            keyword_meant == nullptr ? nullptr : abaqus::parameter_of(*keyword_meant, name);
        if (parameter != nullptr) {
            name = parameter->name;
            if (!parameter->values.empty()) value = abaqus::value_of(*parameter, upper(value));
        }
        if (equals != std::string::npos && !known.insert(name).second)
            throw SceneFailure(card.place, fmt::format("the parameter {:.40} is given twice", name));
        card.parameters.emplace_back(std::move(name), std::move(value));
    }
}

// Returns a hint where a line has the words of another program.
std::string of_another_program(const std::string& line) {
    const std::string start = upper(line.substr(0, line.find_first_of(" ,/=")));
    const bool ansys = line.front() == '/' || line.front() == '!' || start == "FINISH" || start == "ET" ||
                       start == "NBLOCK" || start == "EBLOCK" || start == "MP";
    const bool nastran =
        start == "SOL" || start == "CEND" || start == "GRID" || start == "BEGIN" || line.front() == '$';
    if (ansys) return "; it seems to be one of ANSYS: convert its mesh, for instance by meshio or Gmsh, to .msh";
    if (nastran) return "; it seems to be one of Nastran: convert its mesh, for instance by meshio or Gmsh, to .msh";
    return "";
}

// Takes out the mark of UTF-8 at the beginning and that of DOS for the end; lines end as on Unix, where a file of old
// Macs has \r alone.
std::string plain_lines(std::string text) {
    constexpr std::string_view utf_8 = "\xEF\xBB\xBF";
    constexpr char end_of_dos = 0x1A;
    if (text.starts_with(utf_8)) text.erase(0, utf_8.size());
    while (text.ends_with(end_of_dos)) text.pop_back();
    if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
    return text;
}

class CardReader {
public:
    std::vector<InpCard> cards;
    std::string bytes;

    void read(const std::string& path, const Place& from, std::size_t depth) {
        std::istringstream lines(text_of(path, from));
        std::string line;
        int number = 0;
        while (std::getline(lines, line)) {
            ++number;
            const Place place{path, "", number};
            if (!has_words(line, place)) continue;
            if (line.front() == '*') {
                std::string next;
                while (line.back() == ',') {
                    if (!std::getline(lines, next)) throw SceneFailure(place, "the keyword line goes on in no line");
                    ++number;
                    line += next;
                    trim_end(line);
                }
                InpCard card;
                card.place = place;
                parse_keyword_line(parameters_.replaced(line, place), card);
                card.place.path = "*" + card.keyword;
                if (card.keyword == "INCLUDE") {
                    include(card, path, depth);
                    continue;
                }
                cards.push_back(std::move(card));
                if (has_data_file(cards.back())) read_data(beside(path, cards.back()), cards.back().place);
                continue;
            }
            if (cards.empty())
                throw SceneFailure(place, "a keyword line (*NAME) is expected first: this is no input file of Abaqus" +
                                              of_another_program(line));
            add_data(line, place);
        }
    }

private:
    std::size_t files_ = 0;
    InpParameters parameters_;

    // Trims the line; false if it is a comment or empty.
    static bool has_words(std::string& line, const Place& place) {
        if (line.find('\0') != std::string::npos)
            throw SceneFailure(place, "not a text file, or one of UTF-16: save it as plain text or UTF-8");
        line = trimmed(line);
        return !line.empty() && line.rfind("**", 0) != 0;
    }

    // A data line of the last card.
    void add_data(std::string& line, const Place& place) {
        const std::string& keyword = cards.back().keyword;
        const Place of_card{place.file, "*" + keyword, place.line};
        if (keyword == "PARAMETER") return parameters_.define(line, of_card);
        if (keyword != "HEADING") line = parameters_.replaced(line, of_card);
        InpLine data{split(line), line.back() == ',', of_card};
        for (std::string& field : data.fields) field = unquoted(std::move(field));
        cards.back().lines.push_back(std::move(data));
    }

    // True if the data lines of a card stand in a file that it names.
    static bool has_data_file(const InpCard& card) {
        const abaqus::Keyword* keyword = abaqus::keyword_of(card.keyword);
        return keyword != nullptr && card.has("INPUT") && abaqus::parameter_of(*keyword, "INPUT") != nullptr;
    }

    static std::string beside(const std::string& path, const InpCard& card) {
        return (std::filesystem::path(path).parent_path() / card.required("INPUT")).string();
    }

    void read_data(const std::string& path, const Place& from) {
        std::istringstream lines(text_of(path, from));
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            const Place place{path, from.path, number};
            if (!has_words(line, place)) continue;
            if (line.front() == '*')
                throw SceneFailure(place, "a data line is expected: a file that INPUT= names has no keywords");
            add_data(line, place);
        }
    }

    // Included files may be included again, so that a small file could stand for more than any machine can read: the
    // number of files and their size are limited.
    std::string text_of(const std::string& path, const Place& from) {
        if (++files_ > most_files)
            throw SceneFailure(from, fmt::format("{}: is file {} of this mesh, and at most {} are read, one that is "
                                                 "included again each time",
                                                 path, files_, most_files));
        try {
            InputFile file(path);
            require_mesh_size(path, static_cast<std::int64_t>(bytes.size()) + file.size(), from);
            std::string text = file.rest();
            bytes += text;
            return plain_lines(std::move(text));
        } catch (const SceneFailure&) {
            throw;
        } catch (const Failure& e) {
            throw SceneFailure(from, e.what());
        }
    }

    // The lines of the included file replace the card; its name is relative to the including file.
    void include(const InpCard& card, const std::string& path, std::size_t depth) {
        card.check();
        if (depth == deepest_include)
            throw SceneFailure(card.place, fmt::format("files include each other more than {} deep", deepest_include));
        read(beside(path, card), card.place, depth + 1);
    }
};

}  // namespace

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

bool InpCard::has(const std::string& name) const {
    return std::any_of(parameters.begin(), parameters.end(), [&](const auto& p) { return p.first == name; });
}

std::string InpCard::parameter(const std::string& name) const {
    for (const auto& [key, value] : parameters)
        if (key == name) return value;
    return "";
}

std::string InpCard::required(const std::string& name) const {
    const std::string value = parameter(name);
    if (value.empty()) throw SceneFailure(place, name + "= is missing");
    return value;
}

std::vector<double> InpLine::numbers(std::size_t first) const {
    std::vector<double> out;
    for (std::size_t i = first; i < fields.size(); ++i)
        out.push_back(fields[i].empty() ? 0.0 : inp_number(fields[i], place));
    return out;
}

const InpLine& InpCard::first_line() const {
    if (lines.empty()) throw SceneFailure(place, "a data line is expected");
    return lines.front();
}

std::vector<double> InpCard::row() const {
    std::vector<double> out;
    for (const InpLine& line : lines) {
        const std::vector<double> more = line.numbers();
        out.insert(out.end(), more.begin(), more.end());
    }
    return out;
}

void InpCard::refuse(const std::string& name, const std::string& value, const std::string& known) const {
    throw SceneFailure(place, fmt::format("{}={} is not imported: {} is", name, value, known));
}

void InpCard::check() const {
    const abaqus::Keyword* known = abaqus::keyword_of(keyword);
    if (known == nullptr) return;
    std::vector<std::string> names;
    for (const abaqus::Parameter& each : known->parameters)
        if (abaqus::instead_of_parameter(keyword, each.name).empty()) names.push_back(each.name);
    for (const auto& [name, value] : parameters) {
        for (const std::string& written : {name, name + "=" + value})
            if (const std::string instead = abaqus::instead_of_parameter(keyword, written); !instead.empty())
                throw SceneFailure(place, instead);
        const auto at = std::find_if(known->parameters.begin(), known->parameters.end(),
                                     [&own = name](const abaqus::Parameter& each) { return each.name == own; });
        if (at == known->parameters.end())
            throw SceneFailure(place, fmt::format("the parameter {} is not read{}; {}", name, suggestion(name, names),
                                                  names.empty() ? "none is" : "these are: " + listing(names)));
        const std::vector<std::string>& values = at->values;
        if (values.empty() || std::find(values.begin(), values.end(), value) != values.end()) continue;
        std::string all = values.front();
        for (std::size_t i = 1; i < values.size(); ++i) all += (i + 1 < values.size() ? ", " : " or ") + values[i];
        refuse(name, value, all);
    }
}

std::vector<InpCard> read_cards(const std::string& path, const Place& place, std::string& bytes) {
    CardReader reader;
    reader.read(path, place, 0);
    bytes = std::move(reader.bytes);
    return std::move(reader.cards);
}

double inp_number(const std::string& field, const Place& place) {
    std::string text = field;
    for (char& c : text)
        if (c == 'd' || c == 'D') c = 'e';
    if (!text.empty() && text.front() == '+') text.erase(0, 1);
    double value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        throw SceneFailure(place, fmt::format("\"{:.40}\": a finite number is expected", field));
    return value;
}

std::optional<std::int64_t> inp_whole(const std::string& field) {
    std::int64_t value = 0;
    const auto [end, code] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (code != std::errc() || end != field.data() + field.size()) return std::nullopt;
    return value;
}

std::int64_t inp_whole(const std::string& field, const Place& place) {
    const auto value = inp_whole(field);
    if (!value) throw SceneFailure(place, fmt::format("\"{:.40}\": a whole number is expected", field));
    return *value;
}

}  // namespace cli
