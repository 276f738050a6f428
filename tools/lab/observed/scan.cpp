#include "observed/scan.h"

#include "geometry/triangle_tree.h"
#include "random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

namespace vcarve::observed {

namespace {

using bench::Random;
using Eigen::Vector3d;

Vector3d direction(double turn_rad, double elevation_rad)
{
    return {std::cos(elevation_rad) * std::cos(turn_rad),
            std::cos(elevation_rad) * std::sin(turn_rad), std::sin(elevation_rad)};
}

/// Measures along beams, one by one.
class Scanner {
  public:
    explicit Scanner(const TriMesh& surface) : tree_(surface) {}

    void measure(const Beam& beam, Scan& scan)
    {
        constexpr double kHalfWidth = 0.0003;
        constexpr double kNoise = 0.003;
        constexpr double kFalse = 1.0 / 400.0;
        constexpr double kShortest = 0.3;
        // Every beam uses the same number of random numbers.
        const Vector3d aside = kHalfWidth * random_.direction();
        const double noise = kNoise * random_.normal();
        const double mix = random_.uniform();
        const double false_share = random_.uniform(kShortest, 1.0);
        const bool is_false = random_.uniform() < kFalse;
        const auto middle = tree_.first_hit(beam.from, beam.from + beam.way);
        const auto edge = tree_.first_hit(beam.from, beam.from + beam.way + aside);
        if (!middle) return;
        double range = middle->along + noise;
        if (edge && is_another(middle->along, edge->along)) {
            range = (1.0 - mix) * middle->along + mix * edge->along;
        }
        if (is_false) range *= false_share;
        scan.positions.push_back(beam.from + range * beam.way);
        scan.scanners.push_back(beam.from);
    }

  private:
    static bool is_another(double a, double b)
    {
        constexpr double kStep = 0.03; // share of the range
        return std::abs(a - b) > kStep * std::max(a, b);
    }

    TriangleTree tree_;
    Random random_{3};
};

} // namespace

std::vector<Beam> tripod_beams(const Vector3d& place, std::size_t count)
{
    constexpr double kLowest = -std::numbers::pi / 3.0;
    constexpr double kHeight = std::numbers::pi / 2.0 - kLowest;
    const double area = 2.0 * std::numbers::pi * (1.0 - std::sin(kLowest));
    const double step = std::sqrt(area / static_cast<double>(count));
    const auto rows = static_cast<int>(std::lround(kHeight / step));
    std::vector<Beam> beams;
    for (int row = 0; row < rows; ++row) {
        const double elevation = kLowest + kHeight * (row + 0.5) / rows;
        const double around = 2.0 * std::numbers::pi * std::cos(elevation);
        const auto columns = static_cast<int>(std::ceil(around / step));
        for (int column = 0; column < columns; ++column) {
            const double turn = 2.0 * std::numbers::pi * column / columns;
            beams.push_back({place, direction(turn, elevation)});
        }
    }
    return beams;
}

Scan scan(const TriMesh& surface, const std::vector<Beam>& beams)
{
    Scanner scanner(surface);
    Scan result;
    for (const Beam& beam : beams) {
        scanner.measure(beam, result);
    }
    return result;
}

void write_scan(const std::filesystem::path& path, const Scan& scan, double step)
{
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << scan.positions.size();
    for (const char* name : {"x", "y", "z", "x_origin", "y_origin", "z_origin"}) {
        file << "\nproperty float " << name;
    }
    file << "\nend_header\n";
    const auto put = [&](double value) {
        const auto number =
            static_cast<float>(step > 0.0 ? step * std::round(value / step) : value);
        file.write(reinterpret_cast<const char*>(&number), sizeof(number));
    };
    for (std::size_t i = 0; i < scan.positions.size(); ++i) {
        std::ranges::for_each(scan.positions[i], put);
        std::ranges::for_each(scan.scanners[i], put);
    }
}

} // namespace vcarve::observed
