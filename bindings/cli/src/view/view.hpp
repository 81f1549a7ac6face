// SPDX-License-Identifier: BSD-3-Clause
// `delam view`.
#pragma once

#include <cstddef>
#include <string>

namespace cli {

// Requests of a person for the page of `delam view`.
struct ViewWishes {
    std::string page;           // "": view.html in the folder of the result, where an earlier one is replaced
    std::string page_template;  // "": the installed one
    std::size_t every = 0;      // the fields of every n-th written step; 0: as many as a browser can hold
    bool replace = false;       // a page that was named
};
// Writes a result as a page for a browser.
int view(const std::string& folder, const ViewWishes& wishes);

}  // namespace cli
