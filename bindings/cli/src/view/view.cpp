// SPDX-License-Identifier: BSD-3-Clause
// `delam view`: a result as one page for a browser, which needs no network and no other file.
#include <algorithm>
#include <cmath>
#include <csignal>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "file/file.hpp"
#include "file/output_folder.hpp"
#include "text/error.hpp"
#include "text/reason.hpp"
#include "text/say.hpp"
#include "view/view.hpp"
#include "view/view_arrays.hpp"
#include "view/view_fields.hpp"
#include "view/view_result.hpp"
#include "view/view_surface.hpp"
#include "view/view_template.hpp"

namespace cli {

namespace {

using nlohmann::json;

// Significant bits: of what moves and is read off, and of what is only coloured.
constexpr int exact_bits = 24, moved_bits = 16, coloured_bits = 12;
// All steps together, before they are packed. A phone still opens such a page.
constexpr double most_bytes = 192.0 * 1024 * 1024;
constexpr std::size_t stress_components = 6;

// Every n-th step, and the last.
std::vector<ViewStep> every_nth(const std::vector<ViewStep>& steps, std::size_t n) {
    std::vector<ViewStep> out;
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (i % n == 0 || i + 1 == steps.size()) out.push_back(steps[i]);
    return out;
}

// Returns the stride of the steps that a page can hold; 1 is each step.
std::size_t affordable(const Seen& seen, std::size_t steps) {
    double values =
        3.0 * static_cast<double>(seen.nodes.size()) + static_cast<double>(stress_components * seen.cells.size());
    for (const SeenInterface& interface : seen.interfaces) values += static_cast<double>(interface.b.size());
    return static_cast<std::size_t>(std::max(1.0, std::ceil(4 * values * static_cast<double>(steps) / most_bytes)));
}

// The rows of some nodes or cells, one component after the other: like numbers are neighbours, and pack better.
std::vector<double> by_component(const std::vector<double>& values, const std::vector<std::int64_t>& rows,
                                 std::size_t columns) {
    std::vector<double> out;
    if (values.empty()) return out;
    out.reserve(rows.size() * columns);
    for (std::size_t c = 0; c < columns; ++c)
        for (const std::int64_t row : rows) out.push_back(values[static_cast<std::size_t>(row) * columns + c]);
    return out;
}

json polygons_json(const Polygons& polygons, ViewArrays& arrays) {
    return {{"offsets", arrays.add(polygons.offsets)}, {"nodes", arrays.add(polygons.nodes)}};
}

class ViewPage {
public:
    ViewPage(const FieldsFile& file, const std::string& path, const ViewAbout& about, const std::vector<double>& times)
        : file_(file), mesh_(file.mesh(about)), asked_(about.fields), times_(times) {
        interfaces_ = file.interfaces(mesh_);
        path_ = path;
        seen_ = seen_of(mesh_, interfaces_, path);
    }

    // n 0: as many steps as are affordable.
    void choose_steps(std::size_t n) {
        const std::vector<ViewStep> all = file_.steps(times_, interfaces_.size());
        every_ = n > 0 ? n : affordable(seen_, all.size());
        steps_ = every_nth(all, every_);
    }
    [[nodiscard]] const std::vector<ViewStep>& steps() const { return steps_; }
    [[nodiscard]] std::size_t stride() const { return every_; }
    [[nodiscard]] std::size_t cells() const { return mesh_.cell_count(); }

    json mesh_json() {
        std::vector<std::int32_t> body;
        for (const std::int64_t cell : seen_.cells) body.push_back(mesh_.body[static_cast<std::size_t>(cell)]);
        json interfaces = json::array();
        for (std::size_t i = 0; i < seen_.interfaces.size(); ++i) {
            const SeenInterface& one = seen_.interfaces[i];
            json item = polygons_json(one.faces, arrays_);
            item["name"] = interfaces_[i].name;
            if (!one.a.empty()) item["a"] = arrays_.add(one.a);
            item["b"] = arrays_.add(one.b);
            interfaces.push_back(std::move(item));
        }
        json out = polygons_json(seen_.faces, arrays_);
        out["dimension"] = mesh_.dimension;
        out["cells"] = mesh_.cell_count();
        out["body"] = arrays_.add(body);
        out["points"] = arrays_.add(by_component(mesh_.points, seen_.nodes, 3), exact_bits);
        out["interfaces"] = std::move(interfaces);
        return out;
    }

    json steps_json() {
        json out = json::array();
        for (const ViewStep& step : steps_) {
            json one{{"step", step.step}, {"time", step.time}, {"adhesion", json::array()}};
            const auto displacement = field(step, "displacement", mesh_.nodes(), 3);
            if (!displacement.empty())
                one["displacement"] = arrays_.add(by_component(displacement, seen_.nodes, 3), moved_bits);
            const auto stress = field(step, "stress", mesh_.cell_count(), stress_components);
            if (!stress.empty())
                one["stress"] = arrays_.add(by_component(stress, seen_.cells, stress_components), coloured_bits);
            for (std::size_t i = 0; i < interfaces_.size(); ++i) {
                const auto zeta = field(step, fmt::format("interface_{}/zeta", i), interfaces_[i].nodes_b.size(), 1);
                for (const double value : zeta)
                    if (!(value >= 0 && value <= 1))
                        throw Failure(exit_scene, fmt::format("{}: {}/interface_{}/zeta has {}: adhesions from 0 to 1 "
                                                              "are expected",
                                                              path_, step.group, i, value));
                one["adhesion"].push_back(zeta.empty() ? json() : arrays_.add(zeta, moved_bits));
            }
            out.push_back(std::move(one));
        }
        return out;
    }

    [[nodiscard]] const std::string& elements() const { return arrays_.elements(); }

private:
    const FieldsFile& file_;
    std::string path_;
    // A field that the scene asked for is there in each step, others in none.
    [[nodiscard]] std::vector<double> field(const ViewStep& step, const std::string& name, std::size_t rows,
                                            std::size_t columns) const {
        const std::string own = name.substr(name.rfind('/') + 1);
        const bool asked = std::find(asked_.begin(), asked_.end(), own) != asked_.end();
        return asked ? file_.field(step, name, rows, columns) : std::vector<double>();
    }

    ViewMesh mesh_;
    std::vector<std::string> asked_;
    std::vector<double> times_;
    std::vector<ViewInterface> interfaces_;
    Seen seen_;
    std::vector<ViewStep> steps_;
    std::size_t every_ = 1;
    ViewArrays arrays_;
};

constexpr const char* begin_of_data = "<script type=\"application/json\" id=\"delam-data\">";

// Escapes <, because an element of a page ends at the first text like its closing tag.
std::string json_element(const json& value) {
    std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
        text.replace(at, 1, "\\u003c");
    return begin_of_data + text + "</script>\n";
}

std::string title_text(const json& about) {
    for (const char* key : {"title", "file"})
        if (const json& text = about["scene"][key]; text.is_string() && !text.get<std::string>().empty()) return text;
    return "delam";
}

}  // namespace

int view(const std::string& folder, const ViewWishes& wishes) {
    const std::string to = wishes.page.empty() ? folder + "/view.html" : wishes.page;
    std::signal(SIGXFSZ, SIG_IGN);  // a limit of the size of files gives a reason, like a full disk
    require_replaceable(to, wishes.page.empty() || wishes.replace, "a page of delam view",
                        [](const std::string& bytes) { return bytes.find(begin_of_data) != std::string::npos; });
    const ViewAbout about = view_about(folder);
    json data{{"format", 1}, {"about", about.shown}};
    require_unchanged(folder, published_in(folder));
    std::string page = view_template(wishes.page_template);
    ViewHistory history = view_history(folder, about);
    data["jumps"] = view_jumps(folder, about, history);
    data["history"] = std::move(history.columns);
    const std::string path = folder + "/fields.h5";
    if (about.fields.empty())
        throw Failure(exit_scene, folder +
                                      "/result.json: the scene writes no fields (output.fields = []), and the page "
                                      "shows fields");
    const FieldsFile file(path);
    if (const std::string hash = file.text("scene_hash"); about.scene_hash != hash)
        throw Failure(exit_scene, fmt::format("{}: it belongs to the scene {}, and result.json to {}", path, hash,
                                              about.scene_hash));
    ViewPage content(file, path, about, history.times);
    content.choose_steps(wishes.every);
    if (content.steps().empty()) throw Failure(exit_scene, path + ": it has the fields of no step");
    data["mesh"] = content.mesh_json();
    data["steps"] = content.steps_json();
    data["every"] = content.stride();
    // Where HDF5 cannot read, it may say that there is nothing.
    if (const h5::FileTrouble trouble = h5::take_trouble(); trouble.code != 0)
        throw Failure(exit_scene, fmt::format("{}: cannot be read: {}", trouble.path, reason_of(trouble.code)));
    page = filled_template(std::move(page), title_text(data["about"]), json_element(data) + content.elements());
    write_atomic(to, page);
    say("{}: {}, {} cells, {:.1f} MB\n", to, counted(static_cast<std::int64_t>(content.steps().size()), "step"),
        content.cells(), static_cast<double>(page.size()) / 1e6);
    if (wishes.every == 0 && content.stride() > 1)
        say("the fields of every {}. step are in the page, so that a browser can hold it; --every chooses\n",
            content.stride());
    return exit_done;
}

}  // namespace cli
