// SPDX-License-Identifier: BSD-3-Clause
#include "base/machine/blas_memory.hpp"
#include "capi/handle/handles.hpp"

int32_t delam_context_create(delam_context** out) {
    if (out == nullptr) return DELAM_ERROR_ARGUMENT;
    *out = nullptr;
    try {
        delam::prepare_blas();
        *out = new delam_context;
        return DELAM_OK;
    } catch (...) {
        return DELAM_ERROR_MEMORY;
    }
}

void delam_context_destroy(delam_context** context) { delam::destroy(context); }

const char* delam_context_message(const delam_context* context) {
    if (!delam::alive(context)) return "the context is NULL, foreign or destroyed";
    return context->context->message.c_str();
}

int32_t delam_context_set_log(delam_context* context, delam_log_callback callback, void* user) {
    return delam::guard(context, [&] {
        context->context->monitor.log_callback = callback;
        context->context->monitor.log_user = user;
    });
}

int32_t delam_context_set_progress(delam_context* context, delam_progress_callback callback, void* user) {
    return delam::guard(context, [&] {
        context->context->monitor.progress_callback = callback;
        context->context->monitor.progress_user = user;
    });
}

// Runs without a guard, because it may run in a signal handler or while another call uses the context.
int32_t delam_context_cancel(delam_context* context) {
    if (!delam::alive(context)) return DELAM_ERROR_HANDLE;
    context->context->monitor.cancel();
    return DELAM_OK;
}
