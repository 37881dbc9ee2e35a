// SPDX-License-Identifier: BSD-3-Clause
// What the module of WebAssembly has beside the C interface: its progress function is one of JavaScript.
#include <delone/delone.h>

#include <emscripten.h>

// Sees to it that no exception of JavaScript passes through the library: src/calls.js keeps it until the call
// has returned.
EM_JS(int, call_progress, (double fraction), { return Module["progress"](fraction); });

extern "C" EMSCRIPTEN_KEEPALIVE void delone_js_ask_for_progress(int wanted) {
  delone_set_progress(wanted != 0 ? [](double fraction, void*) { return call_progress(fraction); } : nullptr,
                      nullptr);
}
