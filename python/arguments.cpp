#include "arguments.h"

#include "arrays.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>

namespace vcarve::python {

namespace {

/// In the order of OptionValue's types.
constexpr std::array<const char*, 9> kKinds = {"float", "int",    "bytes", "flag", "word",
                                               "place", "region", "path",  "text"};

std::string text_of_number(const py::handle& value)
{
    if (PyIndex_Check(value.ptr()) != 0)
        return py::str(py::int_(py::reinterpret_borrow<py::object>(value)));
    return py::repr(py::float_(py::reinterpret_borrow<py::object>(value)));
}

/// The text of a value on the command line.
std::string text_of(const py::handle& value)
{
    if (py::isinstance<py::str>(value)) return py::cast<std::string>(value);
    if (py::isinstance<py::bool_>(value)) return py::str(value);
    if (py::hasattr(value, "__fspath__")) return py::str(value.attr("__fspath__")());
    if (!py::isinstance<py::sequence>(value) && !py::isinstance<py::array>(value)) {
        return PyNumber_Check(value.ptr()) != 0 ? text_of_number(value)
                                                : std::string(py::str(value));
    }
    std::string text;
    for (const py::handle number : value) {
        text += (text.empty() ? "" : ",") + text_of(number);
    }
    return text;
}

void set_flag(const Option& option, const py::handle& value)
{
    if (!py::isinstance<py::bool_>(value)) {
        throw UsageError(fmt::format("--{} takes True or False, not {}", option.info.name,
                                     std::string(py::str(value))));
    }
    *std::get<bool*>(option.value) = py::cast<bool>(value);
}

} // namespace

void set_options(const OptionList& options, const py::dict& keywords)
{
    for (const auto& [key, value] : keywords) {
        std::string name = py::cast<std::string>(key);
        std::ranges::replace(name, '_', '-');
        const Option* option = find_option(name, options);
        if (option == nullptr) {
            throw py::type_error("unexpected keyword argument '" + py::cast<std::string>(key) +
                                 "'");
        }
        if (value.is_none()) continue;
        if (is_flag(*option)) {
            set_flag(*option, value);
        } else {
            set_value(*option, text_of(value));
        }
    }
}

py::list describe(const OptionList& options)
{
    py::list all;
    for (const Option& option : options) {
        py::dict said;
        std::string name = option.info.name;
        std::ranges::replace(name, '-', '_');
        said["name"] = name;
        said["heading"] = std::string(option.stage);
        said["kind"] = kKinds.at(option.value.index());
        said["accepted"] = accepted(option);
        said["unit"] = option.info.unit;
        said["words"] = option.info.words;
        said["range"] = range_text(option);
        said["help"] = option.info.help;
        said["default"] = value_text(option);
        said["tuning"] = option.info.level == OptionLevel::library;
        all.append(said);
    }
    return all;
}

} // namespace vcarve::python
