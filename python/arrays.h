#pragma once

#include <Eigen/Core>
#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace vcarve::python {

namespace py = pybind11;

/// The memory layout of an array entry of the library: type and count of its numbers.
template <typename Entry>
struct Layout {
    using Number = typename std::conditional_t<std::is_enum_v<Entry>, std::underlying_type<Entry>,
                                               std::type_identity<Entry>>::type;
    static constexpr py::ssize_t kColumns = 0; ///< no second dimension
};
template <typename Number_, int kRows>
struct Layout<Eigen::Matrix<Number_, kRows, 1>> {
    using Number = Number_;
    static constexpr py::ssize_t kColumns = kRows;
};
template <typename Number_, std::size_t kSize>
struct Layout<std::array<Number_, kSize>> {
    using Number = Number_;
    static constexpr py::ssize_t kColumns = kSize;
};

/// A NumPy array at the address of an array of the library. It keeps `owner` alive, which must not
/// change the array's size meanwhile.
template <typename Entry, typename Owner>
py::array view_of(std::vector<Entry>& entries, const std::shared_ptr<Owner>& owner)
{
    using Number = typename Layout<Entry>::Number;
    static_assert(sizeof(Entry) ==
                  sizeof(Number) * std::max<py::ssize_t>(1, Layout<Entry>::kColumns));
    const py::capsule keeper(new std::shared_ptr<Owner>(owner),
                             [](void* kept) { delete static_cast<std::shared_ptr<Owner>*>(kept); });
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(entries.size())};
    if (Layout<Entry>::kColumns > 0) shape.push_back(Layout<Entry>::kColumns);
    // The address of an empty vector may be null, in which case NumPy would allocate memory.
    static Number nothing{};
    const void* data = entries.empty() ? static_cast<const void*>(&nothing) : entries.data();
    return py::array(py::dtype::of<Number>(), shape, data, keeper);
}

/// Throws BufferError if NumPy arrays of a scene or mesh exist. Call it before arrays change.
/// `owner` is the argument of a method: Python's object and the call hold one share each.
template <typename Owner>
void require_unseen(const std::shared_ptr<Owner>& owner)
{
    constexpr long kShares = 2;
    if (owner.use_count() > kShares) {
        throw py::buffer_error("its NumPy arrays are in use, so it cannot change; delete them");
    }
}

/// Throws UsageError unless the array has rows of `columns` numbers; 0 requires one dimension.
void require_shape(const py::array& given, const std::string& name, py::ssize_t columns);

/// The rows of an array, without checking its numbers.
template <typename Entry>
std::vector<Entry> unchecked_rows_of(const py::object& given, const std::string& name)
{
    using Number = typename Layout<Entry>::Number;
    const auto array = py::cast<py::array_t<Number, py::array::c_style>>(given);
    require_shape(array, name, Layout<Entry>::kColumns);
    const auto* first = reinterpret_cast<const Entry*>(array.data());
    return {first, first + array.shape(0)};
}

/// The rows of a user's array. Throws UsageError with the index of the first number that does not
/// fit the entries, as numbers() of vcarve/_arrays.py defines it.
template <typename Entry>
std::vector<Entry> rows_of(const py::object& given, const std::string& name)
{
    const auto numbers = py::module_::import("vcarve._arrays").attr("numbers");
    const auto dtype = py::dtype::of<typename Layout<Entry>::Number>();
    return unchecked_rows_of<Entry>(numbers(name, given, dtype), name);
}

/// Arrays of `owner` as a tuple of NumPy arrays, for pickle. Nothing is copied.
template <typename Owner, typename... Entries>
py::tuple tuple_of_arrays(const std::tuple<std::vector<Entries>&...>& arrays,
                          const std::shared_ptr<Owner>& owner)
{
    return std::apply([&](auto&... array) { return py::make_tuple(view_of(array, owner)...); },
                      arrays);
}

/// The reverse of tuple_of_arrays(); copies.
template <typename... Entries>
void set_arrays(const std::tuple<std::vector<Entries>&...>& arrays, const py::tuple& state)
{
    std::size_t i = 0;
    std::apply(
        [&](auto&... array) {
            ((array = unchecked_rows_of<Entries>(state[i++], "a pickled array")), ...);
        },
        arrays);
}

} // namespace vcarve::python
