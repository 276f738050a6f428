#include "page/pack.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vcarve {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kSteps = (1U << 24) - 1;

void add_three_bytes(Bytes& bytes, std::uint32_t number)
{
    for (const int shift : {0, 8, 16}) {
        bytes.push_back(static_cast<std::uint8_t>(number >> shift));
    }
}

std::uint32_t step_at(double coordinate, double low, double quantum)
{
    if (quantum == 0.0) return 0;
    return static_cast<std::uint32_t>(
        std::clamp(std::round((coordinate - low) / quantum), 0.0, double{kSteps}));
}

} // namespace

std::string base64(std::span<const std::uint8_t> bytes)
{
    constexpr const char* kLetters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8 | (k < count ? bytes[i + k] : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= count ? kLetters[group >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

PackedPositions pack_positions(std::span<const Eigen::Vector3d> positions)
{
    PackedPositions packed;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : positions) {
        box.extend(position);
    }
    if (box.isEmpty()) return packed;
    packed.low = box.min();
    packed.quantum = box.sizes() / kSteps;
    Bytes bytes;
    bytes.reserve(9 * positions.size());
    for (const Eigen::Vector3d& position : positions) {
        for (const int axis : {0, 1, 2}) {
            add_three_bytes(bytes, step_at(position[axis], packed.low[axis], packed.quantum[axis]));
        }
    }
    packed.data = base64(bytes);
    return packed;
}

std::string pack_faces(std::span<const Face> faces)
{
    Bytes bytes;
    bytes.reserve(9 * faces.size());
    for (const Face& face : faces) {
        for (const std::uint32_t corner : face) {
            add_three_bytes(bytes, corner);
        }
    }
    return base64(bytes);
}

std::string pack_colors(std::span<const Color> colors)
{
    Bytes bytes;
    bytes.reserve(3 * colors.size());
    for (const Color& color : colors) {
        bytes.insert(bytes.end(), color.begin(), color.end());
    }
    return base64(bytes);
}

std::string pack_bytes(std::span<const std::int32_t> numbers)
{
    Bytes bytes;
    bytes.reserve(numbers.size());
    for (const std::int32_t number : numbers) {
        bytes.push_back(static_cast<std::uint8_t>(std::clamp(number, 0, 255)));
    }
    return base64(bytes);
}

std::string pack_two_bytes(std::span<const std::uint16_t> numbers)
{
    Bytes bytes;
    bytes.reserve(2 * numbers.size());
    for (const std::uint16_t number : numbers) {
        bytes.push_back(static_cast<std::uint8_t>(number & 255U));
        bytes.push_back(static_cast<std::uint8_t>(number >> 8));
    }
    return base64(bytes);
}

std::string pack_errors(std::span<const double> errors_px)
{
    std::vector<std::uint16_t> numbers;
    numbers.reserve(errors_px.size());
    for (const double error_px : errors_px) {
        const double thousandths = std::min(std::round(1000.0 * error_px), kNoError - 1.0);
        numbers.push_back(error_px < 0.0 ? kNoError : static_cast<std::uint16_t>(thousandths));
    }
    return pack_two_bytes(numbers);
}

} // namespace vcarve
