// SPDX-License-Identifier: BSD-3-Clause
// The page without a result: one file with all scripts and styles, which the build makes of bindings/cli/view.
#pragma once

#include <string>
#include <string_view>

namespace cli {

// named: a file; "": the one that is installed with the program, or that of its build folder. Throws
// Failure(exit_scene) if the file is missing or is no template.
std::string view_template(const std::string& named);
// The template with a result: `data` in the place that is kept for it, `title` in that of the title.
std::string filled_template(std::string page, std::string_view title, std::string_view data);

}  // namespace cli
