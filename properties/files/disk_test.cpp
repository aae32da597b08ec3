#include "properties/files/disk.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "properties/files/own_folder_test.hpp"
#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct WriteFile : testing::Test {
  long count() const { return std::distance(std::filesystem::directory_iterator(folder), {}); }

  const OwnFolder own;
  const std::filesystem::path& folder = own.path;
};

TEST_F(WriteFile, ReplacesWhatWasThereAndLeavesNothingElse) {
  write_file(folder / "a", "a longer text", "--out");
  write_file(folder / "a", std::string_view("b\n\0c", 4), "--out");
  EXPECT_EQ(read_file(folder / "a", "file"), std::string("b\n\0c", 4));
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
  const InvalidInput error = error_of([&] { write_file(folder / "a", "new", "--html"); });
  EXPECT_EQ(error.field(), "--html");
  EXPECT_THAT(error.what(), HasSubstr((folder / "a").string()));
  EXPECT_EQ(read_file(folder / "a", "file"), "old");
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

TEST_F(WriteFile, AFolderIsOneRunsOrSharedByParts) {
  using enum OutputFolder::Use;
  {
    const OutputFolder one(folder / "out");
    EXPECT_THROW(OutputFolder(folder / "out" / ".." / "out"), InvalidInput);
    EXPECT_THROW(OutputFolder(folder / "out", "--out", shared), InvalidInput);
    EXPECT_NO_THROW(OutputFolder(folder / "out" / "within"));
  }
  const OutputFolder part(folder / "out", "--out", shared), other(folder / "out", "--out", shared);
  EXPECT_THAT(
      [&] { OutputFolder(folder / "out", "--figures"); },
      testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("name another folder by --figures")));
}

TEST_F(WriteFile, RemovesOlderFilesOfThatNameAlone) {
  for (const char* name : {"log-1.json", "log-12.json", "log.json", "other-1.json", "log-1.txt"}) {
    write_file(folder / name, "", "--out");
  }
  std::filesystem::create_directory(folder / "log-2.json");
  remove_older(folder, "log-", ".json");
  EXPECT_EQ(count(), 4);
  EXPECT_FALSE(is_file(folder / "log-1.json"));
  EXPECT_NO_THROW(remove_older(folder / "none", "", ""));
}

}  // namespace
}  // namespace touchstone
