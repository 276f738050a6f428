#include "paper/box_solid.h"

#include <algorithm>
#include <cmath>

namespace vcarve::paper {

namespace {

/// A fraction with a positive denominator.
struct Fraction {
    std::int64_t top = 0;
    std::int64_t bottom = 1;

    bool operator<(const Fraction& other) const { return top * other.bottom < other.top * bottom; }
};

bool contains(const Box& box, const Spot& spot)
{
    return (spot.array() >= box.low.array()).all() && (spot.array() <= box.high.array()).all();
}

/// Whether a segment that begins on the closed box leaves it at once.
bool leaves_at_once(const Box& box, const Spot& begin, const Spot& way)
{
    for (int k = 0; k < 3; ++k) {
        const bool down = begin[k] == box.low[k] && way[k] < 0;
        const bool up = begin[k] == box.high[k] && way[k] > 0;
        if (down || up) return true;
    }
    return false;
}

/// Whether a segment meets the closed box: its intervals between the three pairs of planes overlap.
bool hits(const Box& box, const Spot& begin, const Spot& way)
{
    Fraction enter{0, 1};
    Fraction leave{1, 1};
    for (int k = 0; k < 3; ++k) {
        if (way[k] == 0) {
            if (begin[k] < box.low[k] || begin[k] > box.high[k]) return false;
            continue;
        }
        const std::int64_t sign = way[k] > 0 ? 1 : -1;
        const std::int64_t near = way[k] > 0 ? box.low[k] : box.high[k];
        const std::int64_t far = way[k] > 0 ? box.high[k] : box.low[k];
        enter = std::max(enter, Fraction{sign * (near - begin[k]), sign * way[k]});
        leave = std::min(leave, Fraction{sign * (far - begin[k]), sign * way[k]});
    }
    return !(leave < enter);
}

std::array<Spot, 8> corners(const Box& box)
{
    std::array<Spot, 8> result;
    for (int i = 0; i < 8; ++i) {
        result[i] = {(i & 1) != 0 ? box.high[0] : box.low[0],
                     (i & 2) != 0 ? box.high[1] : box.low[1],
                     (i & 4) != 0 ? box.high[2] : box.low[2]};
    }
    return result;
}

/// Candidate separating axes of a tetrahedron and a box: face normals, and cross products of their
/// edges. One separates them if their interiors are disjoint.
std::vector<Spot> separating_axes(const std::array<Spot, 4>& cell)
{
    std::vector<Spot> axes{Spot::UnitX(), Spot::UnitY(), Spot::UnitZ()};
    for (int i = 0; i < 4; ++i) {
        const Spot& a = cell[(i + 1) % 4];
        axes.push_back((cell[(i + 2) % 4] - a).cross(cell[(i + 3) % 4] - a));
        for (int j = i + 1; j < 4; ++j) {
            for (int k = 0; k < 3; ++k) {
                const Spot axis = (cell[j] - cell[i]).cross(Spot::Unit(k));
                if (!axis.isZero()) axes.push_back(axis);
            }
        }
    }
    return axes;
}

template <std::size_t Size>
std::pair<std::int64_t, std::int64_t> extent(const std::array<Spot, Size>& spots, const Spot& axis)
{
    std::array<std::int64_t, Size> heights;
    std::transform(spots.begin(), spots.end(), heights.begin(),
                   [&](const Spot& s) { return axis.dot(s); });
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    return {*low, *high};
}

bool interiors_meet(const std::array<Spot, 4>& cell, const Box& box, const std::vector<Spot>& axes)
{
    return std::none_of(axes.begin(), axes.end(), [&](const Spot& axis) {
        const auto [cell_low, cell_high] = extent(cell, axis);
        const auto [box_low, box_high] = extent(corners(box), axis);
        return cell_high <= box_low || box_high <= cell_low;
    });
}

} // namespace

std::int64_t volume_6(const Spot& a, const Spot& b, const Spot& c, const Spot& d)
{
    return (b - a).cross(c - a).dot(d - a);
}

BoxSolid::BoxSolid(const std::vector<std::array<double, 6>>& bounds)
{
    for (const auto& bound : bounds) {
        Box box;
        for (int k = 0; k < 3; ++k) {
            box.low[k] = std::llround(bound[k] * kSpotsPerUnit);
            box.high[k] = std::llround(bound[k + 3] * kSpotsPerUnit);
            ticks_[k].insert(ticks_[k].end(), {box.low[k], box.high[k]});
        }
        boxes_.push_back(box);
    }
    for (auto& ticks : ticks_) {
        std::sort(ticks.begin(), ticks.end());
        ticks.erase(std::unique(ticks.begin(), ticks.end()), ticks.end());
    }
}

Spot BoxSolid::spot(const Index& index) const
{
    return {ticks_[0][index[0]], ticks_[1][index[1]], ticks_[2][index[2]]};
}

bool BoxSolid::solid_at(const Index& index) const
{
    for (int k = 0; k < 3; ++k) {
        if (index[k] < 0 || index[k] + 1 >= static_cast<int>(ticks_[k].size())) return false;
    }
    const Spot low = spot(index);
    const Spot high = spot(index + Index::Ones());
    return std::any_of(boxes_.begin(), boxes_.end(),
                       [&](const Box& box) { return contains(box, low) && contains(box, high); });
}

template <typename Visit>
static void for_each_index(const Eigen::Vector3i& low, const Eigen::Vector3i& high, Visit visit)
{
    for (int i = low[0]; i < high[0]; ++i) {
        for (int j = low[1]; j < high[1]; ++j) {
            for (int k = low[2]; k < high[2]; ++k) {
                visit(Eigen::Vector3i(i, j, k));
            }
        }
    }
}

std::int64_t BoxSolid::volume() const
{
    std::int64_t sum = 0;
    const Index size(ticks_[0].size() - 1, ticks_[1].size() - 1, ticks_[2].size() - 1);
    for_each_index(Index::Zero(), size, [&](const Index& i) {
        if (solid_at(i)) sum += (spot(i + Index::Ones()) - spot(i)).prod();
    });
    return sum;
}

/// Whether the grid edge from `index` along `axis` is an edge of the solid. It is not if the four
/// cells around it are all equal or form two neighboring pairs.
bool BoxSolid::is_edge(const Index& index, int axis) const
{
    const Index u = Index::Unit((axis + 1) % 3);
    const Index v = Index::Unit((axis + 2) % 3);
    const bool here = solid_at(index);
    const bool left = solid_at(index - u);
    const bool below = solid_at(index - v);
    const bool across = solid_at(index - u - v);
    return !((here == left && below == across) || (here == below && left == across));
}

/// Whether edges of the solid meet here, except for one edge that passes straight through.
bool BoxSolid::is_corner(const Index& index) const
{
    int axes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const bool ahead = is_edge(index, axis);
        const bool behind = is_edge(index - Index::Unit(axis), axis);
        if (ahead != behind) return true;
        axes += ahead ? 1 : 0;
    }
    return axes > 1;
}

std::vector<Edge> BoxSolid::edges() const
{
    std::vector<Edge> result;
    const Index size(ticks_[0].size(), ticks_[1].size(), ticks_[2].size());
    for_each_index(Index::Zero(), size, [&](const Index& begin) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!is_corner(begin) || !is_edge(begin, axis)) continue;
            Index end = begin + Index::Unit(axis);
            while (!is_corner(end)) {
                end += Index::Unit(axis);
            }
            result.push_back({spot(begin), spot(end)});
        }
    });
    return result;
}

std::vector<Side> BoxSolid::sides() const
{
    std::set<Side> result;
    const Index size(ticks_[0].size(), ticks_[1].size(), ticks_[2].size());
    for_each_index(Index::Zero(), size, [&](const Index& i) {
        for (int axis = 0; axis < 3; ++axis) {
            const bool above = solid_at(i);
            const bool below = solid_at(i - Index::Unit(axis));
            if (above != below) result.insert({axis, ticks_[axis][i[axis]], below});
        }
    });
    return {result.begin(), result.end()};
}

bool BoxSolid::on_side(const Side& side, const Spot& sum) const
{
    Index cell;
    for (int k = 0; k < 3; ++k) {
        const auto above = std::upper_bound(ticks_[k].begin(), ticks_[k].end(), sum[k],
                                            [](auto value, auto tick) { return value < 3 * tick; });
        cell[k] = static_cast<int>(above - ticks_[k].begin()) - 1;
    }
    const bool above = solid_at(cell);
    const bool below = solid_at(cell - Index::Unit(side.axis));
    return above != below && below == side.outward_up;
}

bool BoxSolid::sees(const Spot& begin, const Spot& end) const
{
    const Spot way = end - begin;
    return std::all_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
        return contains(box, begin) ? leaves_at_once(box, begin, way) : !hits(box, begin, way);
    });
}

BoxSolid::Meets BoxSolid::meets(const std::array<Spot, 4>& cell) const
{
    Meets result;
    const std::vector<Spot> axes = separating_axes(cell);
    const Index size(ticks_[0].size() - 1, ticks_[1].size() - 1, ticks_[2].size() - 1);
    for_each_index(Index::Zero(), size, [&](const Index& i) {
        bool& met = solid_at(i) ? result.solid : result.empty;
        met = met || interiors_meet(cell, {spot(i), spot(i + Index::Ones())}, axes);
    });
    return result;
}

} // namespace vcarve::paper
