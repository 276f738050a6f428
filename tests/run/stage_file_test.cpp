#include "run/stage_file.h"
#include "support/read_back.h"
#include "support/scene_checks.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace vcarve::stage_file_test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class StageFile : public ::testing::Test {
  protected:
    template <typename T>
    void write(const T& value) const
    {
        StageWriter counter;
        counter.put(value);
        StageWriter writer(path, label, counter.bytes());
        writer.put(value);
        writer.commit();
    }
    template <typename T>
    T read() const
    {
        T value;
        StageReader reader(path, label);
        reader.get(value);
        reader.finish();
        return value;
    }
    template <typename T>
    T through_file(const T& value) const
    {
        write(value);
        return read<T>();
    }
    /// The error for a file with these bytes.
    std::string refusal_of(std::string_view bytes) const
    {
        folder.write("some.stage", bytes);
        return refusal<InputError>([&] { read<Scene>(); });
    }

    TemporaryFolder folder;
    std::filesystem::path path = folder / "some.stage";
    StageLabel label = {"some", digest_of(std::string("job"))};
    Scene scene = bumpy_sphere(50, 1);
};

std::string replaced(std::string bytes, std::size_t at, char mask)
{
    bytes[at] = static_cast<char>(bytes[at] ^ mask);
    return bytes;
}

} // namespace

TEST_F(StageFile, PreservesAScene)
{
    scene.views[0].name = std::string("with \n and \0 in it", 17); // models may have such names
    scene.cameras[0].params = {1.0, 0.1, -2.0};
    scene.cameras[0].measures_range = true;
    scene.normals.assign(scene.num_points(), Eigen::Vector3f(0.5F, 1.0F, -1.0F));
    scene.offset = Eigen::Vector3d(1e6, -2.0, 0.1);
    expect_equal_scenes(through_file(scene), scene);
    EXPECT_TRUE(through_file(scene).cameras[0].measures_range);
    expect_equal_scenes(through_file(Scene()), Scene());
}

TEST_F(StageFile, IsRejectedIfAnyByteIsChanged)
{
    write(scene);
    const std::string bytes = bytes_of(path);
    ASSERT_GT(bytes.size(), 3000U);
    std::mt19937 random(7);
    std::uniform_int_distribution<std::size_t> place(0, bytes.size() - 1);
    for (std::size_t i = 0; i < 400; ++i) {
        // The header, the first counts, the end, and random positions.
        const std::size_t at = i < 200 ? i : i < 220 ? bytes.size() - 220 + i : place(random);
        const char mask = static_cast<char>(1 << (i % 8));
        EXPECT_THAT(refusal_of(replaced(bytes, at, mask)), StartsWith(path.string() + ": it"))
            << at;
    }
    folder.write("some.stage", bytes);
    expect_equal_scenes(read<Scene>(), scene);
}

TEST_F(StageFile, IsRejectedIfItIsTruncatedAnywhere)
{
    write(scene);
    const std::string bytes = bytes_of(path);
    for (std::size_t length = 0; length < bytes.size(); length += length < 300 ? 1 : 97) {
        EXPECT_THAT(
            refusal_of(bytes.substr(0, length)),
            AnyOf(HasSubstr("it is truncated: it has " + std::to_string(length) + " bytes"),
                  HasSubstr("it has " + std::to_string(length) + " bytes, but its header records " +
                            std::to_string(bytes.size()))));
    }
    EXPECT_THAT(refusal_of(bytes + "x"), HasSubstr("but its header records"));
}

TEST_F(StageFile, ExplainsWhyItIsRejected)
{
    EXPECT_EQ(refusal<InputError>([&] { read<Scene>(); }),
              path.string() + ": it cannot be opened: No such file or directory");
    std::filesystem::create_directory(path);
    EXPECT_THAT(refusal<InputError>([&] { read<Scene>(); }), StartsWith(path.string() + ": it"));
    std::filesystem::remove(path);
    EXPECT_EQ(refusal_of(std::string(1000, 'x')), path.string() + ": it is not a stage file");
    write(scene);
    label.name = "other";
    EXPECT_EQ(refusal<InputError>([&] { read<Scene>(); }),
              path.string() + ": it contains stage some, expected other");
    label = {"some", Digest{}};
    EXPECT_EQ(refusal<InputError>([&] { read<Scene>(); }),
              path.string() + ": it was made from other input or options");
}

TEST_F(StageFile, RejectsInvalidBooleans)
{
    write(std::uint8_t{2});
    EXPECT_THAT(refusal<InputError>([&] { read<bool>(); }),
                HasSubstr("a boolean is neither 0 nor 1"));
}

TEST_F(StageFile, IsRejectedIfItHasMoreThanTheReaderExpects)
{
    write(scene);
    EXPECT_THAT(refusal<InputError>([&] { read<std::vector<Camera>>(); }),
                HasSubstr("its content is damaged"));
}

TEST_F(StageFile, DoesNotExistBeforeItIsCommitted)
{
    StageWriter counter;
    counter.put(scene);
    {
        StageWriter writer(path, label, counter.bytes());
        writer.put(scene);
    }
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST_F(StageFile, HasTheCountedSize)
{
    write(scene);
    StageWriter counter;
    counter.put(scene);
    StageReader reader(path, label);
    EXPECT_EQ(reader.bytes(), counter.bytes());
}

} // namespace vcarve::stage_file_test
