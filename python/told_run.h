#pragma once

#include "vcarve/log.h"

#include <pybind11/pybind11.h>

#include <functional>

namespace vcarve::python {

/// Does `work` on a thread of its own without Python's lock, while the calling thread hands what
/// the work tells of itself to `listener`, as (kind, name, value), and looks for signals: where one
/// is handled by an exception, as KeyboardInterrupt, or the listener throws, the work is stopped
/// and the exception goes on. `work` must touch nothing of Python. Throws what it throws.
void run_told(const pybind11::object& listener, const std::function<void(Log&)>& work);

} // namespace vcarve::python
