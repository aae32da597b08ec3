#include "properties/files/disk.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <sys/stat.h>

#include "properties/files/error_text.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

struct WriteFile : testing::Test {
  WriteFile() { std::filesystem::create_directories(folder); }
  ~WriteFile() override { std::filesystem::remove_all(folder); }

  static std::string read(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  long count() const { return std::distance(std::filesystem::directory_iterator(folder), {}); }

  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "touchstone_write_file_test";
};

TEST_F(WriteFile, ReplacesWhatWasThereAndLeavesNothingElse) {
  write_file(folder / "a", "a longer text", "--out");
  write_file(folder / "a", std::string_view("b\n\0c", 4), "--out");
  EXPECT_EQ(read(folder / "a"), std::string("b\n\0c", 4));
  EXPECT_EQ(count(), 1);
}

TEST_F(WriteFile, WhatIsNoOrdinaryFileIsWrittenAsItIs) {
  write_file("/dev/null", "text", "--out");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(WriteFile, APipeIsAFileAndAFolderIsNot) {
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(is_file(folder / "pipe"));
  EXPECT_TRUE(is_file("/dev/null"));
  EXPECT_FALSE(is_file(folder));
  EXPECT_FALSE(is_file(folder / "none"));
}

TEST_F(WriteFile, AFullDiskLeavesTheOldFileAndNamesTheOption) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  // The partial file is as full as a disk can be.
  write_file(folder / "a", "old", "--out");
  std::filesystem::create_symlink("/dev/full", folder / "a.partial");
  try {
    write_file(folder / "a", "new", "--html");
    FAIL() << "nothing was thrown";
  } catch (const InvalidInput& e) {
    EXPECT_EQ(e.field(), "--html");
    EXPECT_THAT(e.what(), testing::HasSubstr((folder / "a").string()));
  }
  EXPECT_EQ(read(folder / "a"), "old");
  EXPECT_EQ(count(), 1);
}

TEST_F(WriteFile, AFolderThatDoesNotExistIsBadInput) {
  EXPECT_THAT(
      [&] { write_file(folder / "none" / "a", "text", "--out"); },
      testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("No such file or directory")));
}

TEST_F(WriteFile, AFolderIsMadeOrRefused) {
  check_writable(folder / "x" / "y");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "x" / "y"));
  write_file(folder / "file", "", "--out");
  EXPECT_THROW(check_writable(folder / "file"), InvalidInput);
}

TEST(Printable, KeepsWhatIsShortAndHarmless) {
  EXPECT_EQ(printable("µ is 3", 20), "µ is 3");
  EXPECT_EQ(printable(std::string(20, 'x'), 20), std::string(20, 'x'));
}

TEST(Printable, CutsWhatIsLongBetweenCharacters) {
  EXPECT_EQ(printable(std::string(10000, 'x'), 10), "xxxxxxx...");
  EXPECT_EQ(printable("abcdefµµµµ", 10), "abcdef...");  // byte 7 is the middle of a character
}

TEST(Printable, WritesControlCharactersAsDigits) {
  EXPECT_EQ(printable(std::string_view("a\0\x1b[2J\n\x7f", 8), 40), "a\\x00\\x1b[2J\\x0a\\x7f");
}

TEST(ErrorText, CutsEachPart) {
  const std::string text(100000, 'x');
  EXPECT_LT(error_text({text, text, "must be short"}).size(), 400U);
  EXPECT_EQ(error_text({"radius", "-1", "must be positive"}), "radius is -1: must be positive");
}

}  // namespace
}  // namespace touchstone
