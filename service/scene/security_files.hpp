#pragma once
// The six files that DDS Security asks of a participant, and what is wrong with them before DDS
// opens them.

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace adstar::scene {

struct SecurityFiles {
  std::filesystem::path identity_ca;           ///< who vouches for identities
  std::filesystem::path identity_certificate;  ///< this participant's own
  std::filesystem::path private_key;           ///< of that certificate
  std::filesystem::path permissions_ca;        ///< who signs the two documents below
  std::filesystem::path governance;            ///< what is protected, and how
  std::filesystem::path permissions;           ///< what this participant may do
};

/// Key in a scene, name in a directory that deploy/security/make.sh laid, member.
struct SecurityFile {
  std::string_view key;
  std::string_view file_name;
  std::filesystem::path SecurityFiles::*path;
};
inline constexpr std::array<SecurityFile, 6> kSecurityFiles{{
    {"identity_ca", "identity_ca.pem", &SecurityFiles::identity_ca},
    {"identity_certificate", "identity_certificate.pem", &SecurityFiles::identity_certificate},
    {"private_key", "private_key.pem", &SecurityFiles::private_key},
    {"permissions_ca", "permissions_ca.pem", &SecurityFiles::permissions_ca},
    {"governance", "governance.p7s", &SecurityFiles::governance},
    {"permissions", "permissions.p7s", &SecurityFiles::permissions},
}};

/// Those names in `directory`.
SecurityFiles security_files_in(const std::filesystem::path& directory);

/// "private_key: got 'k.pem', which others can read (mode 0644), ...", a line for each that is not
/// a readable file, or is a private key that is not private.
std::vector<std::string> complaints_about(const SecurityFiles& files);

}  // namespace adstar::scene
