// SPDX-License-Identifier: BSD-3-Clause
#include "command/reported.hpp"

#include <exception>
#include <new>
#include <string>

#include "text/error.hpp"
#include "text/refusals.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

int failed(const std::string& message, int code) {
    complain("delam: {}\n", message);
    say_event("error", "\"message\": " + json_text(message));
    return code;
}

}  // namespace

int reported(const std::function<int()>& command) {
    try {
        return command();
    } catch (const Refusals& refusals) {
        for (const SceneFailure& each : refusals.all()) (void)failed(each.what(), each.code());
        return refusals.code();
    } catch (const Failure& failure) {
        return failed(failure.what(), failure.code());
    } catch (const std::bad_alloc&) {
        return failed("out of memory", exit_numerical);
    } catch (const std::exception& e) {
        return failed(e.what(), exit_numerical);
    }
}

}  // namespace cli
