#include "service/scene/security_files.hpp"

#include <cerrno>
#include <cstring>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

namespace adstar::scene {
namespace {

/// Empty when all is well.
std::string complaint_about(const SecurityFile& file, const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0 || access(path.c_str(), R_OK) != 0) {
    return fmt::format(
        "{}: got '{}', which cannot be read ({}), expected a file that can; try the files that "
        "deploy/security/make.sh makes",
        file.key, path, std::strerror(errno));
  }
  if (!S_ISREG(info.st_mode)) {
    return fmt::format("{}: got '{}', which is not a file, expected one; try {}", file.key, path,
                       file.file_name);
  }
  const auto mode = static_cast<unsigned>(info.st_mode & 07777U);
  // Or root's, for an account that has no file of its own: it may have its key by a group.
  const bool handed_by_root = info.st_uid == 0 && geteuid() != 0 && (mode & 037U) == 0;
  if (file.path == &SecurityFiles::private_key && (mode & 077U) != 0 && !handed_by_root) {
    return fmt::format(
        "{}: got '{}', which others can reach (mode {:04o}), expected a key that is its owner's "
        "alone, or root's and a group's to read (0640); try chmod 600, and a new key if somebody "
        "may have read this one",
        file.key, path, mode);
  }
  return {};
}

}  // namespace

SecurityFiles security_files_in(const std::filesystem::path& directory) {
  SecurityFiles files;
  for (const SecurityFile& file : kSecurityFiles) {
    files.*file.path = directory / file.file_name;
  }
  return files;
}

std::vector<std::string> complaints_about(const SecurityFiles& files) {
  std::vector<std::string> complaints;
  for (const SecurityFile& file : kSecurityFiles) {
    if (std::string complaint = complaint_about(file, (files.*file.path).string());
        !complaint.empty()) {
      complaints.push_back(std::move(complaint));
    }
  }
  return complaints;
}

}  // namespace adstar::scene
