#pragma once

#include <pybind11/pybind11.h>

namespace vcarve::python {

/// Scene, whose arrays are NumPy's at the same addresses.
void add_scene_class(pybind11::module_& module);

} // namespace vcarve::python
