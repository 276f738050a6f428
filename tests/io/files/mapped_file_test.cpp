#include "io/files/mapped_file.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <string_view>
#include <utility>

namespace vcarve::mapped_file_test {
namespace {

std::string_view text_of(const MappedFile& file)
{
    return {file.bytes().data(), file.bytes().size()};
}

TEST(MappedFile, HoldsTheBytesOfTheFile)
{
    using namespace std::string_view_literals;
    const TemporaryFolder folder;
    MappedFile file(folder.write("a file", "one\0two\r\n"sv));
    EXPECT_EQ(text_of(file), "one\0two\r\n"sv);
    const MappedFile moved(std::move(file));
    EXPECT_EQ(text_of(moved), "one\0two\r\n"sv);
}

TEST(MappedFile, RereadsReleasedBytes)
{
    const TemporaryFolder folder;
    const std::string bytes(100'000, 'a');
    const MappedFile file(folder.write("long", bytes + "b"));
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{70'000}, file.bytes().size()}) {
        file.release(count);
        EXPECT_EQ(text_of(file), bytes + "b");
    }
}

TEST(MappedFile, AcceptsAnEmptyFile)
{
    const TemporaryFolder folder;
    const MappedFile file(folder.write("empty", ""));
    EXPECT_EQ(file.bytes().size(), 0U);
}

TEST(MappedFile, RefusesPathsThatAreNotFiles)
{
    const TemporaryFolder folder;
    const std::string path = folder.path().string();
    EXPECT_EQ(refusal<InputError>([&] { MappedFile{folder.path() / "no.bin"}; }),
              path + "/no.bin: the file does not exist");
    EXPECT_EQ(refusal<InputError>([&] { MappedFile{folder.path()}; }),
              path + ": found something that is not a file");
    ::mkfifo((path + "/pipe").c_str(), 0600);
    EXPECT_EQ(refusal<InputError>([&] { MappedFile{folder.path() / "pipe"}; }),
              path + "/pipe: found something that is not a file");
    std::filesystem::create_symlink("loop", folder / "loop");
    EXPECT_EQ(refusal<InputError>([&] { MappedFile{folder.path() / "loop"}; }),
              path + "/loop: the file cannot be read (Too many levels of symbolic links)");
}

} // namespace
} // namespace vcarve::mapped_file_test
