#include "io/colmap/sim3_text.h"

#include "io/colmap/text_reader.h"
#include "io/files/mapped_file.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>

namespace vcarve {

namespace {

constexpr std::size_t kSim3 = 8;

std::vector<double> numbers_in(const std::filesystem::path& path)
{
    constexpr std::size_t kMost = 16;
    const MappedFile file(path);
    TextReader reader(file.bytes(), path.string());
    std::vector<double> numbers;
    while (numbers.size() <= kMost && reader.next_record()) {
        while (!reader.at_line_end()) {
            numbers.push_back(reader.read_double("an entry of the transformation"));
        }
    }
    return numbers;
}

Matrix34 matrix_of_sim3(std::span<const double> numbers)
{
    const Eigen::Vector4d wxyz(numbers[1], numbers[2], numbers[3], numbers[4]);
    const Eigen::Vector4d unit = wxyz.stableNormalized();
    const Eigen::Quaterniond rotation(unit[0], unit[1], unit[2], unit[3]);
    Matrix34 matrix;
    const double scale = unit.isZero() ? 0.0 : numbers[0]; // Eigen treats zero as the identity
    matrix << scale * rotation.toRotationMatrix(),
        Eigen::Vector3d(numbers[5], numbers[6], numbers[7]);
    return matrix;
}

} // namespace

Similarity read_sim3(const std::filesystem::path& file)
{
    const std::vector<double> numbers = numbers_in(file);
    const std::size_t count = numbers.size();
    const bool is_square = count == 16;
    if (count != kSim3 && count != 12 && !is_square) {
        throw InputError(fmt::format("{}: found {} numbers, expected 8 as COLMAP writes them "
                                     "(scale, quaternion w x y z, translation) or a matrix of 3 or "
                                     "4 rows of 4",
                                     file.string(),
                                     count > 16 ? "more than 16" : std::to_string(count)));
    }
    if (is_square && Eigen::Map<const Eigen::Vector4d>(&numbers[12]) != Eigen::Vector4d::UnitW()) {
        throw InputError(fmt::format("{}: the last row of the matrix is {}, expected 0 0 0 1",
                                     file.string(),
                                     fmt::join(std::span(numbers).subspan(12), " ")));
    }
    using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
    const Matrix34 matrix =
        count == kSim3 ? matrix_of_sim3(numbers) : Matrix34(Eigen::Map<const Rows>(numbers.data()));
    const std::string fault = fault_of_similarity(matrix);
    if (fault.empty()) return similarity_of(matrix);
    throw InputError(fmt::format("{}: the transformation is {}, expected a rotation with a scale "
                                 "and a translation",
                                 file.string(), fault));
}

std::string sim3_text(const Similarity& similarity)
{
    const Eigen::Quaterniond q(Eigen::Matrix3d(similarity.linear / similarity.scale));
    return fmt::format("{} {} {} {} {} {}", similarity.scale, q.w(), q.x(), q.y(), q.z(),
                       fmt::join(similarity.translation, " "));
}

} // namespace vcarve
