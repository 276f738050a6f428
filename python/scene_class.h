#pragma once

#include <pybind11/pybind11.h>

namespace vcarve::python {

/// Adds the class Scene. Its NumPy arrays refer to the library's memory.
void add_scene_class(pybind11::module_& module);

} // namespace vcarve::python
