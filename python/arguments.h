#pragma once

#include "options/option.h"

#include <pybind11/pybind11.h>

namespace vcarve::python {

/// Sets options to the values of the keywords that are called like them, with _ for -; None leaves
/// an option as it is. A number, a text, a path or a row of numbers stands for what would be typed
/// on the command line, so the same is accepted, and refused with the same sentence (UsageError).
/// Throws TypeError for a keyword that is no option.
void set_options(const OptionList& options, const pybind11::dict& keywords);

/// What is declared of options: a list of dictionaries with name, heading, kind, accepted, unit,
/// words, range, help, default and tuning.
pybind11::list describe(const OptionList& options);

} // namespace vcarve::python
