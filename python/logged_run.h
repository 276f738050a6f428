#pragma once

#include "vcarve/log.h"

#include <pybind11/pybind11.h>

#include <functional>

namespace vcarve::python {

/// Runs `work` on a separate thread without Python's GIL. The calling thread meanwhile passes log
/// events to `listener` as (kind, name, value), and checks for signals. If a signal handler raises
/// an exception, such as KeyboardInterrupt, or the listener does, the work is stopped and the
/// exception propagates. `work` must not use Python. Rethrows the exceptions of `work`.
void run_told(const pybind11::object& listener, const std::function<void(Log&)>& work);

} // namespace vcarve::python
