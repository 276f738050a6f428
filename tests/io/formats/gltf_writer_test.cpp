#include "io/formats/mesh_file.h"
#include "support/read_back.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>

namespace vcarve::gltf_writer_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Json = nlohmann::json;

std::uint32_t word_at(const std::string& bytes, std::size_t place)
{
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + place, sizeof(word));
    return word;
}

std::string written(const TriMesh& mesh, const MeshFormat& format = {})
{
    const TemporaryFolder folder;
    write_mesh(folder / "a.glb", mesh, format);
    return bytes_of(folder / "a.glb");
}

TriMesh sheet_far_away()
{
    TriMesh mesh = sample_sheet();
    mesh.offset = {500000.123, 4600000.456, 100.789};
    return mesh;
}

/// The JSON and the binary chunk of a file, split as the specification defines.
struct Chunks {
    Json json;
    std::string numbers;
};

Chunks chunks_of(const std::string& bytes)
{
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word_at(bytes, 4), 2U);
    EXPECT_EQ(word_at(bytes, 8), bytes.size());
    const std::size_t text_bytes = word_at(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(text_bytes % 4, 0U);
    Chunks chunks;
    chunks.json = Json::parse(bytes.substr(20, text_bytes));
    const std::size_t second = 20 + text_bytes;
    if (second == bytes.size()) return chunks;
    EXPECT_EQ(word_at(bytes, second) % 4, 0U);
    EXPECT_EQ(bytes.substr(second + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(second + 8 + word_at(bytes, second), bytes.size());
    chunks.numbers = bytes.substr(second + 8);
    return chunks;
}

/// Returns the numbers of one accessor.
template <typename Number>
std::vector<Number> numbers_of(const Chunks& chunks, std::size_t accessor, std::size_t components)
{
    const Json& about = chunks.json["accessors"][accessor];
    const Json& view = chunks.json["bufferViews"][about["bufferView"].get<std::size_t>()];
    const auto begin = view.value("byteOffset", std::size_t{0});
    std::vector<Number> numbers(about["count"].get<std::size_t>() * components);
    EXPECT_EQ(view["byteLength"], numbers.size() * sizeof(Number));
    EXPECT_EQ(begin % 4, 0U);
    EXPECT_LE(begin + numbers.size() * sizeof(Number), chunks.numbers.size());
    std::memcpy(numbers.data(), chunks.numbers.data() + begin, numbers.size() * sizeof(Number));
    return numbers;
}

/// Expects another program to read the same corners.
void expect_read_back(const TriMesh& mesh, const std::filesystem::path& path)
{
    const std::vector<Corner> expected = corners_of(mesh);
    const std::vector<Corner> back = corners_of(read_by_assimp(path));
    ASSERT_EQ(back.size(), expected.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
        ASSERT_LT((back[i].position - expected[i].position).norm(), 4e-6);
        ASSERT_LT((back[i].normal - expected[i].normal).norm(), 1e-6F);
    }
}

TEST(WriteGlb, DescribesItsContent)
{
    const Json json = chunks_of(written(sample_sheet(), {.comments = {"made here", "x"}})).json;
    EXPECT_EQ(json["asset"], Json::parse(R"({"generator": "made here", "version": "2.0",
                                            "extras": {"comments": ["made here", "x"]}})"));
    EXPECT_EQ(json["scene"], 0);
    EXPECT_EQ(json["scenes"], Json::parse(R"([{"nodes": [0]}])"));
    EXPECT_EQ(json["materials"], Json::parse(R"([{"doubleSided": true,
                               "pbrMetallicRoughness": {"metallicFactor": 0.0}}])"));
    EXPECT_EQ(json["meshes"], Json::parse(R"([{"primitives": [{
        "attributes": {"POSITION": 0, "NORMAL": 1, "COLOR_0": 2},
        "indices": 3, "material": 0, "mode": 4}]}])"));
    EXPECT_EQ(json["nodes"][0]["mesh"], 0);
    EXPECT_FALSE(json["nodes"][0].contains("rotation"));
    const Json& colors = json["accessors"][2];
    EXPECT_EQ(colors, Json::parse(R"({"bufferView": 2, "componentType": 5123, "count": 63,
                                      "normalized": true, "type": "VEC4"})"));
    const Json& indices = json["accessors"][3];
    EXPECT_EQ(indices, Json::parse(R"({"bufferView": 3, "componentType": 5125, "count": 288,
                                       "type": "SCALAR"})"));
}

TEST(WriteGlb, KeepsPositionsFarFromTheOrigin)
{
    const TriMesh mesh = sheet_far_away();
    const Chunks chunks = chunks_of(written(mesh));
    const auto numbers = numbers_of<float>(chunks, 0, 3);
    const auto translation = chunks.json["nodes"][0]["translation"].get<std::vector<double>>();
    constexpr double kSize = 8.0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double back = translation[i] + static_cast<double>(numbers[3 * v + i]);
            const auto axis = static_cast<int>(i);
            EXPECT_NEAR(back, mesh.positions[v][axis] + mesh.offset[axis], 1e-7 * kSize);
        }
    }
}

TEST(WriteGlb, RecordsTheSubtractedOffset)
{
    const TriMesh mesh = sheet_far_away();
    const Json whole = chunks_of(written(mesh)).json;
    const Json rest = chunks_of(written(mesh, {.offset = {5e5, 4.6e6, 0.1}})).json;
    EXPECT_FALSE(whole["asset"].contains("extras"));
    EXPECT_EQ(rest["asset"]["extras"], Json::parse(R"({"offset": [500000.0, 4600000.0, 0.1]})"));
    const auto before = whole["nodes"][0]["translation"].get<std::vector<double>>();
    const auto after = rest["nodes"][0]["translation"].get<std::vector<double>>();
    EXPECT_NEAR(before[0] - after[0], 5e5, 1e-9);
    EXPECT_NEAR(before[1] - after[1], 4.6e6, 1e-9);
    EXPECT_NEAR(before[2] - after[2], 0.1, 1e-9);
}

TEST(WriteGlb, RecordsTheBoundingBoxOfPositions)
{
    const Chunks chunks = chunks_of(written(sheet_far_away()));
    const auto numbers = numbers_of<float>(chunks, 0, 3);
    for (std::size_t i = 0; i < 3; ++i) {
        float least = numbers[i];
        float most = numbers[i];
        for (std::size_t n = i; n < numbers.size(); n += 3) {
            least = std::min(least, numbers[n]);
            most = std::max(most, numbers[n]);
        }
        const Json& about = chunks.json["accessors"][0];
        EXPECT_EQ(about["min"][i].get<float>(), least);
        EXPECT_EQ(about["max"][i].get<float>(), most);
        EXPECT_NEAR(least, -most, 1e-6); // positions are relative to the center of their box
    }
}

TEST(WriteGlb, KeepsNormalsAndFaces)
{
    TriMesh mesh = sample_sheet();
    mesh.normals[5] = Vector3f::Zero();
    const Chunks chunks = chunks_of(written(mesh));
    const auto normals = numbers_of<float>(chunks, 1, 3);
    mesh.normals[5] = Vector3f::UnitZ(); // the writer replaces zero normals
    for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
        EXPECT_EQ(Vector3f(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]),
                  mesh.normals[v]);
    }
    const auto indices = numbers_of<std::uint32_t>(chunks, 3, 1);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        EXPECT_EQ((Face{indices[3 * f], indices[3 * f + 1], indices[3 * f + 2]}), mesh.faces[f]);
    }
}

/// Converts a linear value back to an sRGB byte (IEC 61966-2-1).
int srgb(double linear)
{
    const double share =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    return static_cast<int>(std::lround(255.0 * share));
}

TEST(WriteGlb, WritesDistinctLinearColors)
{
    TriMesh mesh;
    for (int i = 0; i < 256; ++i) {
        mesh.positions.emplace_back(i, i % 7, 0);
        mesh.colors.push_back({static_cast<std::uint8_t>(i), 0, 255});
    }
    mesh.faces = {{0, 1, 2}};
    const auto colors = numbers_of<std::uint16_t>(chunks_of(written(mesh)), 1, 4);
    for (std::size_t i = 0; i < 256; ++i) {
        EXPECT_EQ(srgb(colors[4 * i] / 65535.0), static_cast<int>(i));
        EXPECT_EQ(colors[4 * i + 1], 0);
        EXPECT_EQ(colors[4 * i + 2], 65535);
        EXPECT_EQ(colors[4 * i + 3], 65535);
    }
    EXPECT_EQ(colors[4 * 128], 14146); // ((128 / 255 + 0.055) / 1.055) ^ 2.4 = 0.21586
}

TEST(WriteGlb, OmitsMissingAttributes)
{
    TriMesh mesh = sample_sheet();
    mesh.normals.clear();
    mesh.colors.clear();
    const Json json = chunks_of(written(mesh)).json;
    EXPECT_EQ(json["meshes"][0]["primitives"][0]["attributes"], Json::parse(R"({"POSITION": 0})"));
    EXPECT_EQ(json["accessors"].size(), 2U);
}

TEST(WriteGlb, WritesNoBuffersWithoutFaces)
{
    const Json json = chunks_of(written(TriMesh(), {.comments = {"made here"}})).json;
    EXPECT_EQ(json, Json::parse(R"({"asset": {"version": "2.0", "generator": "made here",
                                              "extras": {"comments": ["made here"]}}})"));
}

TEST(WriteGlb, ReplacesInvalidUtf8)
{
    const Json json = chunks_of(written(TriMesh(), {.comments = {"model \xff"}})).json;
    EXPECT_EQ(json["asset"]["generator"], "model \uFFFD");
}

TEST(WriteGlb, RotatesUpToY)
{
    const TemporaryFolder folder;
    TriMesh mesh = sample_sheet();
    mesh.offset = {2.5, -1.0, 8.0};
    const MeshFormat upright = {.offset = {2, 0, 0}, .up = {0, 0, 1}};
    write_mesh(folder / "a.glb", mesh, upright);
    const Json extras = chunks_of(bytes_of(folder / "a.glb")).json["asset"]["extras"];
    EXPECT_EQ(extras, Json::parse(R"({"offset": [2.0, 0.0, 0.0], "up": [0.0, 0.0, 1.0]})"));
    for (Vector3d& position : mesh.positions) {
        position = Vector3d(position.x() + 0.5, position.z() + 8.0, 1.0 - position.y());
    }
    for (Vector3f& normal : mesh.normals) {
        normal = Vector3f(normal.x(), normal.z(), -normal.y());
    }
    mesh.offset = Vector3d::Zero();
    expect_read_back(mesh, folder / "a.glb");
}

TEST(WriteGlb, RefusesMeshesThatExceedItsSizeFields)
{
    EXPECT_NO_THROW(require_glb_room(4294901759));
    EXPECT_EQ(refusal<UsageError>([] { require_glb_room(4294901760); }),
              "the mesh needs 4294901760 bytes, but binary glTF holds at most 4294901759; write "
              "PLY instead");
}

} // namespace
} // namespace vcarve::gltf_writer_test
