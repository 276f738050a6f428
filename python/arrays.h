#pragma once

#include <Eigen/Core>
#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace vcarve::python {

namespace py = pybind11;

/// How an entry of an array of the library lies in memory: numbers of which type, how many a row.
template <typename Entry>
struct Layout {
    using Number = Entry;
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

/// An array of the library as one of NumPy, at the same address; it keeps `owner` alive, which must
/// not change the array's size meanwhile.
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
    // An empty vector may have no address, which NumPy would take for an order to allocate.
    static Number nothing{};
    const void* data = entries.empty() ? static_cast<const void*>(&nothing) : entries.data();
    return py::array(py::dtype::of<Number>(), shape, data, keeper);
}

/// Throws BufferError where NumPy holds arrays of a scene or mesh that are about to change. Takes
/// what a method of the class was called with, of which Python's object and the call hold one share
/// each.
template <typename Owner>
void require_unseen(const std::shared_ptr<Owner>& owner)
{
    constexpr long kShares = 2;
    if (owner.use_count() > kShares) {
        throw py::buffer_error("arrays of it are in use, so it cannot change: delete them before");
    }
}

/// What numbers may be given as: anything that NumPy makes an array of the type of.
template <typename Number>
using Given = py::array_t<Number, py::array::c_style | py::array::forcecast>;

/// Throws UsageError unless the array has rows of so many numbers; 0: unless it is one row.
void require_shape(const py::array& given, const std::string& name, py::ssize_t columns);

/// The rows of an array.
template <typename Entry>
std::vector<Entry> rows_of(const Given<typename Layout<Entry>::Number>& given,
                           const std::string& name)
{
    require_shape(given, name, Layout<Entry>::kColumns);
    const auto* first = reinterpret_cast<const Entry*>(given.data());
    return {first, first + given.shape(0)};
}

} // namespace vcarve::python
