#pragma once

#include "options/option.h"

#include <pybind11/pybind11.h>

namespace vcarve::python {

/// Sets options to the values of keywords with the same name, with _ for -. None keeps the value.
/// Numbers, texts, paths and rows of numbers are converted to command-line text, so the same values
/// are accepted, and rejected with the same message (UsageError). Throws TypeError if a keyword is
/// not an option.
void set_options(const OptionList& options, const pybind11::dict& keywords);

/// The declarations of options: a list of dictionaries with name, heading, kind, accepted, unit,
/// words, range, help, default and tuning.
pybind11::list describe(const OptionList& options);

} // namespace vcarve::python
