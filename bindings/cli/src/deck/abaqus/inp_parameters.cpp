// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/inp_parameters.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "text/wording.hpp"

namespace cli {

namespace {

using Value = InpParameters::Value;
using Values = std::map<std::string, Value, std::less<>>;

// Parentheses, signs and powers that stand in each other; each takes some hundred bytes of the stack.
constexpr int deepest = 100;
// Bytes of the text that replaces a reference, so that no line grows beyond its file.
constexpr std::size_t longest = 256;

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

struct Function {
    std::string_view name;
    double (*of)(double);
};
constexpr Function functions[] = {
    {"acos", [](double x) { return std::acos(x); }}, {"asin", [](double x) { return std::asin(x); }},
    {"atan", [](double x) { return std::atan(x); }}, {"cos", [](double x) { return std::cos(x); }},
    {"exp", [](double x) { return std::exp(x); }},   {"float", [](double x) { return x; }},
    {"log", [](double x) { return std::log(x); }},   {"log10", [](double x) { return std::log10(x); }},
    {"sin", [](double x) { return std::sin(x); }},   {"sqrt", [](double x) { return std::sqrt(x); }},
    {"tan", [](double x) { return std::tan(x); }},
};

// Reads an expression from the left to the right; each method takes what its name says.
class Expression {
public:
    Expression(std::string_view text, const Values& values, const Place& place)
        : text_(text), values_(values), place_(place) {}

    Value value() {
        Value out = sum();
        if (at_end()) return out;
        fail(fmt::format("\"{:.20}\" is not understood", text_.substr(at_)));
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw SceneFailure(place_, fmt::format("{} in \"{:.60}\"", what, text_));
    }
    bool at_end() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
        return at_ == text_.size() || text_[at_] == '#';
    }
    bool take(std::string_view sign) {
        if (at_end() || text_.substr(at_, sign.size()) != sign) return false;
        if (sign == "*" && text_.substr(at_, 2) == "**") return false;
        at_ += sign.size();
        return true;
    }

    [[nodiscard]] double real(const Value& value) const {
        if (std::holds_alternative<std::string>(value)) fail("a text where a number is expected");
        return std::holds_alternative<double>(value) ? std::get<double>(value)
                                                     : static_cast<double>(std::get<std::int64_t>(value));
    }
    [[nodiscard]] Value finite(double value) const {
        if (!std::isfinite(value)) fail("no finite number");
        return value;
    }
    // Whole numbers stay whole, as long as 64 bits hold them.
    template <class Whole>
    [[nodiscard]] Value combined(const Value& a, const Value& b, double result, Whole whole) const {
        std::int64_t out = 0;
        if (std::holds_alternative<std::int64_t>(a) && std::holds_alternative<std::int64_t>(b)) {
            if (whole(std::get<std::int64_t>(a), std::get<std::int64_t>(b), &out))
                fail("a whole number beyond 64 bits");
            return out;
        }
        return finite(result);
    }

    Value sum() {
        Value out = product();
        for (;;) {
            if (take("+")) {
                const Value b = product();
                out = combined(out, b, real(out) + real(b),
                               [](auto x, auto y, auto* z) { return __builtin_add_overflow(x, y, z); });
            } else if (take("-")) {
                const Value b = product();
                out = combined(out, b, real(out) - real(b),
                               [](auto x, auto y, auto* z) { return __builtin_sub_overflow(x, y, z); });
            } else {
                return out;
            }
        }
    }

    Value product() {
        Value out = sign();
        for (;;) {
            if (take("*")) {
                const Value b = sign();
                out = combined(out, b, real(out) * real(b),
                               [](auto x, auto y, auto* z) { return __builtin_mul_overflow(x, y, z); });
            } else if (take("/")) {
                out = quotient(out, sign());
            } else {
                return out;
            }
        }
    }

    Value quotient(const Value& a, const Value& b) const {
        if (real(b) == 0) fail("division by 0");
        const auto *p = std::get_if<std::int64_t>(&a), *q = std::get_if<std::int64_t>(&b);
        if (p == nullptr || q == nullptr) return finite(real(a) / real(b));
        if (*q == -1)
            return combined(std::int64_t{0}, a, 0,
                            [](auto x, auto y, auto* z) { return __builtin_sub_overflow(x, y, z); });
        if (*p % *q != 0)
            fail(
                fmt::format("{}/{} of whole numbers is cut off by some releases of Abaqus and not by others: write "
                            "{}./{}",
                            *p, *q, *p, *q));
        return *p / *q;
    }

    // Powers bind more than the sign before them, and less than the one behind: -2**-1 is -(2**(-1)).
    Value sign() {
        if (++depth_ > deepest) fail(fmt::format("more than {} parentheses and signs in each other", deepest));
        Value out;
        if (take("-")) {
            const Value of = sign();
            out = combined(std::int64_t{0}, of, -real(of),
                           [](auto x, auto y, auto* z) { return __builtin_sub_overflow(x, y, z); });
        } else if (take("+")) {
            out = sign();
            (void)real(out);
        } else {
            out = atom();
            if (take("**")) out = power(out, sign());
        }
        --depth_;
        return out;
    }

    Value power(const Value& base, const Value& exponent) const {
        const double result = std::pow(real(base), real(exponent));
        const auto* whole = std::get_if<std::int64_t>(&exponent);
        if (!std::holds_alternative<std::int64_t>(base) || whole == nullptr || *whole < 0) return finite(result);
        if (!(std::abs(result) < 9e15)) fail("a whole number beyond 9e15");
        return static_cast<std::int64_t>(std::llround(result));
    }

    Value atom() {
        if (at_end()) fail("a number or name is missing at the end");
        const char c = text_[at_];
        if (take("(")) {
            Value out = sum();
            if (!take(")")) fail("\")\" is missing");
            return out;
        }
        if (c == '\'' || c == '"') return quoted(c);
        if (begins_name(c)) return named();
        return number();
    }

    Value quoted(char mark) {
        const std::size_t end = text_.find(mark, at_ + 1);
        if (end == std::string_view::npos) fail("a text without its second quote");
        Value out = std::string(text_.substr(at_ + 1, end - at_ - 1));
        at_ = end + 1;
        return out;
    }

    Value number() {
        std::size_t end = at_;
        const auto digits = [&] {
            while (end < text_.size() && std::isdigit(static_cast<unsigned char>(text_[end])) != 0) ++end;
        };
        digits();
        bool whole = true;
        if (end < text_.size() && text_[end] == '.') {
            whole = false;
            ++end;
            digits();
        }
        if (end < text_.size() && std::string_view("eEdD").find(text_[end]) != std::string_view::npos) {
            std::size_t after = end + 1;
            if (after < text_.size() && (text_[after] == '+' || text_[after] == '-')) ++after;
            if (after < text_.size() && std::isdigit(static_cast<unsigned char>(text_[after])) != 0) {
                whole = false;
                end = after;
                digits();
            }
        }
        std::string digits_of(text_.substr(at_, end - at_));
        std::replace_if(
            digits_of.begin(), digits_of.end(), [](char d) { return d == 'd' || d == 'D'; }, 'e');
        const char *first = digits_of.data(), *last = first + digits_of.size();
        std::int64_t integer = 0;
        double value = 0;
        const auto [rest, code] = whole ? std::from_chars(first, last, integer) : std::from_chars(first, last, value);
        if (digits_of.empty() || rest != last || code != std::errc())
            fail(fmt::format("\"{:.20}\": a number or name is expected", text_.substr(at_)));
        at_ = end;
        return whole ? Value(integer) : finite(value);
    }

    Value named() {
        std::size_t end = at_;
        while (end < text_.size() && in_name(text_[end])) ++end;
        const std::string name(text_.substr(at_, end - at_));
        at_ = end;
        if (take("(")) return function(name);
        const auto found = values_.find(name);
        if (found == values_.end()) fail(fmt::format("there is no parameter \"{:.40}\"", name));
        return found->second;
    }

    Value function(const std::string& name) {
        const Value x = sum();
        const bool two = name == "pow";
        if (two && !take(",")) fail("pow takes two numbers");
        const Value y = two ? sum() : Value();
        if (!take(")")) fail("\")\" is missing");
        if (two) return power(x, y);
        if (name == "abs")
            return real(x) < 0 ? combined(std::int64_t{0}, x, -real(x),
                                          [](auto a, auto b, auto* z) { return __builtin_sub_overflow(a, b, z); })
                               : x;
        if (name == "int") {
            if (!(std::abs(real(x)) < 9e15)) fail("a whole number beyond 9e15");
            return static_cast<std::int64_t>(real(x));
        }
        std::vector<std::string> known{"abs", "int", "pow"};
        for (const Function& each : functions) {
            if (each.name == name) return finite(each.of(real(x)));
            known.emplace_back(each.name);
        }
        fail(fmt::format("\"{:.40}\" is no function that is evaluated; these are: {}", name, listing(known)));
    }

    std::string_view text_;
    const Values& values_;
    const Place& place_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

std::string text_of(const Value& value) {
    return std::visit([](const auto& x) { return fmt::format("{}", x); }, value);
}

}  // namespace

void InpParameters::define(std::string_view line, const Place& place) {
    const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    std::size_t begin = 0;
    while (begin < line.size() && blank(line[begin])) ++begin;
    if (begin == line.size() || line[begin] == '#') return;
    std::size_t end = begin;
    while (end < line.size() && in_name(line[end])) ++end;
    std::size_t equals = end;
    while (equals < line.size() && blank(line[equals])) ++equals;
    if (end == begin || !begins_name(line[begin]) || equals == line.size() || line[equals] != '=')
        throw SceneFailure(place, fmt::format("\"{:.60}\": NAME = EXPRESSION is expected", line));
    Value value = Expression(line.substr(equals + 1), values_, place).value();
    if (text_of(value).size() > longest)
        throw SceneFailure(place,
                           fmt::format("a text of {} bytes: at most {} are allowed", text_of(value).size(), longest));
    values_.insert_or_assign(std::string(line.substr(begin, end - begin)), std::move(value));
}

std::string InpParameters::replaced(const std::string& line, const Place& place) const {
    std::string out;
    std::size_t at = 0;
    for (std::size_t open = line.find('<'); open != std::string::npos; open = line.find('<', at)) {
        const std::size_t close = line.find('>', open);
        if (close == std::string::npos)
            throw SceneFailure(place, fmt::format("\"{:.40}\": a reference <NAME> is not ended", line.substr(open)));
        const std::string name = line.substr(open + 1, close - open - 1);
        const auto found = values_.find(name);
        if (found == values_.end()) {
            std::vector<std::string> known;
            for (const auto& [each, value] : values_) known.push_back(each);
            throw SceneFailure(place, fmt::format("<{:.40}>: there is no *PARAMETER of this name before{}", name,
                                                  suggestion(name, known)));
        }
        out.append(line, at, open - at);
        out += text_of(found->second);
        at = close + 1;
    }
    return out.append(line, at);
}

}  // namespace cli
