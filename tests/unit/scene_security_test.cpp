#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/unit/scene_text.hpp"

namespace adstar::scene {
namespace {

constexpr const char* kAllSix =
    "identity_ca = \"s/i.pem\"\nidentity_certificate = \"s/c.pem\"\nprivate_key = \"s/k.pem\"\n"
    "permissions_ca = \"s/p.pem\"\ngovernance = \"/etc/g.p7s\"\npermissions = \"s/p.p7s\"";

TEST(SceneSecurity, is_none_unless_it_is_named) {
  EXPECT_FALSE(parse(in_section("dds", "domain = 3"), "scene.toml").dds.security.has_value());
}

TEST(SceneSecurity, finds_its_files_beside_the_scene) {
  const Scene scene = parse(in_section("dds.security", kAllSix), "there/scene.toml");
  ASSERT_TRUE(scene.dds.security.has_value());
  EXPECT_EQ(scene.dds.security->private_key, "there/s/k.pem");
  EXPECT_EQ(scene.dds.security->governance, "/etc/g.p7s");
}

TEST(SceneSecurity, is_refused_when_one_of_the_six_is_missing) {
  for (const SecurityFile& file : kSecurityFiles) {
    std::string lines = kAllSix;
    const std::size_t begin = lines.find(std::string(file.key) + " =");
    lines.erase(begin, lines.find('\n', begin) - begin);
    const std::string said = refusal(in_section("dds.security", lines));
    EXPECT_NE(said.find("dds.security." + std::string(file.key) + ": "), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST(SceneSecurity, refuses_what_it_does_not_know_and_what_is_no_path) {
  EXPECT_NE(refusal(in_section("dds.security", std::string(kAllSix) + "\npassword = \"x\""))
                .find("dds.security.password"),
            std::string::npos);
  EXPECT_NE(refusal(in_section("dds", "security = \"s\"")).find("dds.security"), std::string::npos);
  std::string lines = kAllSix;
  lines.replace(lines.find("\"s/k.pem\""), 9, "\"\"");
  EXPECT_NE(refusal(in_section("dds.security", lines)).find("dds.security.private_key"),
            std::string::npos);
}

/// Six files in a directory of this test's own.
class SecurityFilesOnDisk : public ::testing::Test {
 protected:
  SecurityFilesOnDisk() {
    std::string pattern = (std::filesystem::temp_directory_path() / "adstar.XXXXXX").string();
    directory_ = mkdtemp(pattern.data());
    files_ = security_files_in(directory_);
    for (const SecurityFile& file : kSecurityFiles) {
      std::ofstream(files_.*file.path) << "x";
    }
    chmod(files_.private_key.c_str(), 0600);
  }
  ~SecurityFilesOnDisk() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path directory_;
  SecurityFiles files_;
};

TEST_F(SecurityFilesOnDisk, are_good_when_all_can_be_read_and_the_key_is_private) {
  EXPECT_TRUE(complaints_about(files_).empty());
}

TEST_F(SecurityFilesOnDisk, are_refused_one_by_one_when_they_are_not_there_or_no_files) {
  std::filesystem::remove(files_.governance);
  files_.permissions = directory_;
  const auto complaints = complaints_about(files_);
  ASSERT_EQ(complaints.size(), 2U);
  EXPECT_EQ(complaints[0].find("governance: got '" + files_.governance.string()), 0U);
  EXPECT_NE(complaints[0].find("No such file"), std::string::npos);
  EXPECT_EQ(complaints[1].find("permissions: got '"), 0U);
}

TEST_F(SecurityFilesOnDisk, are_refused_when_anybody_else_can_reach_the_key) {
  for (const mode_t mode : {0604U, 0640U, 0660U, 0610U}) {
    chmod(files_.private_key.c_str(), mode);
    const auto complaints = complaints_about(files_);
    ASSERT_EQ(complaints.size(), 1U) << std::oct << mode;
    EXPECT_NE(complaints[0].find("chmod 600"), std::string::npos) << complaints[0];
  }
  chmod(files_.private_key.c_str(), 0400);
  EXPECT_TRUE(complaints_about(files_).empty());
}

/// Of an account that is there only while a unit runs nothing can be its own.
TEST_F(SecurityFilesOnDisk, are_good_when_the_key_is_roots_and_read_by_a_group) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "only root hands out root's keys";
  }
  constexpr uid_t kSomebody = 61184;
  const auto complaints_of_somebody = [&](mode_t mode, uid_t owner) {
    EXPECT_EQ(chown(files_.private_key.c_str(), owner, kSomebody), 0);
    EXPECT_EQ(chmod(files_.private_key.c_str(), mode), 0);
    EXPECT_EQ(setegid(kSomebody), 0);
    EXPECT_EQ(seteuid(kSomebody), 0);
    const std::size_t complaints = complaints_about(files_).size();
    EXPECT_EQ(seteuid(0), 0);
    EXPECT_EQ(setegid(0), 0);
    return complaints;
  };
  std::filesystem::permissions(directory_, std::filesystem::perms(0755));
  EXPECT_EQ(complaints_of_somebody(0640, 0), 0U);
  EXPECT_EQ(complaints_of_somebody(0644, 0), 1U) << "everybody reads it";
  EXPECT_EQ(complaints_of_somebody(0660, 0), 1U) << "its group writes it";
  EXPECT_EQ(complaints_of_somebody(0640, kSomebody), 1U) << "it is not root who says so";
}

}  // namespace
}  // namespace adstar::scene
