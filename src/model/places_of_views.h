#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace vcarve {

/// Where the views stand in rows of them, view by view.
class PlacesOfViews {
  public:
    struct Place {
        std::uint32_t row;
        std::uint32_t number; ///< in the row
    };

    /// Of rows of which the i-th is row_of(i), a span of views. Cost: O(rows + places).
    template <typename RowOf>
    PlacesOfViews(std::size_t num_rows, std::size_t num_views, const RowOf& row_of)
        : begins_(num_views + 1)
    {
        for (std::size_t i = 0; i < num_rows; ++i) {
            for (const std::uint32_t view : row_of(i)) {
                ++begins_[view + 1];
            }
        }
        std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
        places_.resize(begins_.back());
        std::vector<std::size_t> next = begins_;
        for (std::uint32_t i = 0; i < num_rows; ++i) {
            std::uint32_t number = 0;
            for (const std::uint32_t view : row_of(i)) {
                places_[next[view]++] = {i, number++};
            }
        }
    }

    /// Of a view, by ascending rows.
    std::span<const Place> of(std::size_t view) const
    {
        return std::span(places_).subspan(begins_[view], begins_[view + 1] - begins_[view]);
    }

  private:
    std::vector<std::size_t> begins_; ///< a view's are places_[begins_[view]] up to the next one's
    std::vector<Place> places_;
};

} // namespace vcarve
