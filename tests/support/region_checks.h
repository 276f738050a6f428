#pragma once

#include "region/region.h"

#include <gtest/gtest.h>

#include <random>

namespace vcarve {

/// A box-shaped region.
inline std::unique_ptr<Region> box_region(const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
    return make_region({.kind = RegionChoice::Kind::box, .low = low, .high = high}, Scene());
}

/// Expects two regions to agree on 2000 positions and segments in a box around the origin with this
/// half side. They are on a grid, so that many touch borders.
inline void expect_same_region(const Region& region, const Region& other, int half_side)
{
    std::mt19937 random(7);
    std::uniform_int_distribution<int> halves(-2 * half_side, 2 * half_side);
    const auto number = [&] { return 0.5 * halves(random); };
    const auto place = [&] { return Eigen::Vector3d{number(), number(), number()}; };
    int inside = 0;
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
        const Eigen::Vector3d from = place();
        const Eigen::Vector3d to = place();
        ASSERT_EQ(region.contains(from), other.contains(from)) << from.transpose();
        ASSERT_EQ(region.meets(from, to), other.meets(from, to))
            << from.transpose() << " to " << to.transpose();
        inside += region.contains(from) ? 1 : 0;
        met += region.meets(from, to) ? 1 : 0;
    }
    EXPECT_GT(inside, 50);
    EXPECT_LT(met, 1950);
}

/// The union of two regions.
class EitherRegion final : public Region {
  public:
    EitherRegion(std::unique_ptr<Region> a, std::unique_ptr<Region> b)
        : a_(std::move(a)), b_(std::move(b))
    {
    }

    bool contains(const Eigen::Vector3d& place) const override
    {
        return a_->contains(place) || b_->contains(place);
    }
    bool meets(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const override
    {
        return a_->meets(from, to) || b_->meets(from, to);
    }
    Eigen::AlignedBox3d bounds() const override { return a_->bounds().merged(b_->bounds()); }

  private:
    std::unique_ptr<Region> a_;
    std::unique_ptr<Region> b_;
};

} // namespace vcarve
