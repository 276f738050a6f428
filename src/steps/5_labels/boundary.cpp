#include "steps/5_labels/boundary.h"

#include "base/index_limit.h"
#include "base/parallel.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace vcarve {

namespace {

/// What facets are ordered by.
std::pair<Index, int> key(const CellFacet& facet)
{
    return {facet.cell, facet.slot};
}

} // namespace

Face face_of(const TetMesh& cells, const CellFacet& facet)
{
    const auto& corners = cells.cells[facet.cell].vertices;
    const auto& [a, b, c] = kFacetCorners[facet.slot]; // counter-clockwise from inside
    return {corners[a], corners[c], corners[b]};
}

std::vector<CellFacet> boundary_facets(const TetMesh& cells, const Labels& labels)
{
    return parallel_collect<CellFacet>(cells.cells.size(), [&](std::size_t cell, auto& facets) {
        if (labels[cell] == Label::outside) {
            return;
        }
        for (int slot = cells.cells[cell].first_bounded_slot(); slot < 4; ++slot) {
            if (labels[cells.cells[cell].neighbors[slot]] == Label::outside) {
                facets.push_back({static_cast<Index>(cell), slot});
            }
        }
    });
}

std::size_t place_of(const CellFacet& facet, const std::vector<CellFacet>& facets)
{
    const auto found = std::ranges::lower_bound(facets, key(facet), {}, key);
    return static_cast<std::size_t>(found - facets.begin());
}

std::vector<Face> boundary_faces(const TetMesh& cells, const std::vector<CellFacet>& facets)
{
    require_indexable(facets.size(), kMostFaces, "faces");
    std::vector<Face> faces;
    faces.reserve(facets.size() + facets.size() / 32); // room for what an update adds
    faces.resize(facets.size());
    parallel_for(faces.size(), [&](std::size_t i) { faces[i] = face_of(cells, facets[i]); });
    return faces;
}

Boundary::Boundary(const TetMesh& cells, const Labels& labels)
    : cells_(cells),
      facets_(boundary_facets(cells, labels)),
      faces_(boundary_faces(cells, facets_)),
      num_first_(facets_.size()),
      edges_(cells.positions, faces_),
      normals_(cells.positions, faces_, edges_)
{
}

/// The number of a facet that is there or was.
std::optional<std::uint32_t> Boundary::find(const CellFacet& facet) const
{
    const auto first = std::span(facets_).first(num_first_);
    const auto found = std::ranges::lower_bound(first, key(facet), {}, key);
    if (found != first.end() && key(*found) == key(facet))
        return static_cast<std::uint32_t>(found - first.begin());
    const auto added = added_.find(key(facet));
    return added == added_.end() ? std::nullopt : std::optional(added->second);
}

std::uint32_t Boundary::find_or_add(const CellFacet& facet)
{
    if (const auto found = find(facet)) return *found;
    const auto number = static_cast<std::uint32_t>(facets_.size());
    require_indexable(number + std::uint64_t{1}, kMostFaces, "faces");
    facets_.push_back(facet);
    faces_.push_back(face_of(cells_, facet));
    added_[key(facet)] = number;
    return number;
}

/// Whether one face stands before another in the order of the cells.
bool Boundary::is_before(std::uint32_t a, std::uint32_t b) const
{
    return key(facets_[a]) < key(facets_[b]);
}

void Boundary::update(const Labels& labels, std::span<const Index> changed_cells)
{
    std::map<Index, std::vector<std::uint32_t>> rows; // at vertices of these cells, faces of theirs
    const auto look_at = [&](const CellFacet& facet) {
        if (facet.slot < cells_.cells[facet.cell].first_bounded_slot()) return;
        if (labels[facet.cell] == Label::inside &&
            labels[cells_.other_side(facet).cell] == Label::outside) {
            const std::uint32_t face = find_or_add(facet);
            gone_.erase(face);
            for (const std::uint32_t corner : faces_[face]) {
                rows[corner].push_back(face);
            }
        } else if (const auto face = find(facet)) {
            gone_.insert(*face);
        }
    };
    for (const Index cell : changed_cells) {
        for (int slot = 0; slot < 4; ++slot) {
            if (cells_.cells[cell].vertices[slot] != kInfinite)
                rows.try_emplace(cells_.cells[cell].vertices[slot]);
            look_at({cell, slot});
            look_at(cells_.other_side({cell, slot}));
        }
    }
    for (auto& [vertex, row] : rows) {
        std::ranges::copy(edges_.faces_at()[vertex], std::back_inserter(row));
        std::erase_if(row, [&](std::uint32_t face) { return !is_there(face); });
        std::ranges::sort(row, [&](auto a, auto b) { return is_before(a, b); });
        row.erase(std::unique(row.begin(), row.end()), row.end());
        edges_.replace_faces_at(vertex, std::move(row));
    }
}

std::vector<CellFacet> Boundary::facets_in_order() const
{
    std::vector<CellFacet> facets;
    facets.reserve(facets_.size());
    const auto add = [&](std::size_t begin, std::size_t end) {
        const auto first = facets_.begin();
        facets.insert(facets.end(), first + static_cast<std::ptrdiff_t>(begin),
                      first + static_cast<std::ptrdiff_t>(end));
    };
    std::size_t begin = 0;
    for (const std::uint32_t gone : gone_) {
        if (gone >= num_first_) break;
        add(begin, gone);
        begin = gone + std::size_t{1};
    }
    add(begin, num_first_);
    const auto num_left = static_cast<std::ptrdiff_t>(facets.size());
    for (const auto& [facet, face] : added_) {
        if (is_there(face)) add(face, face + std::size_t{1});
    }
    std::ranges::inplace_merge(facets, facets.begin() + num_left, {}, key);
    return facets;
}

} // namespace vcarve
