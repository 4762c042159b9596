#include "service/dds/security.hpp"

#include <array>
#include <dlfcn.h>
#include <filesystem>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "service/dds/error.hpp"

namespace adstar::dds {
namespace {

struct Plugin {
  std::string_view property;  ///< dds.sec.<property>
  std::string_view library;
  std::string_view functions;  ///< init_<functions>, finalize_<functions>
};
constexpr std::array<Plugin, 3> kPlugins{{
    {"auth", "libdds_security_auth.so", "authentication"},
    {"access", "libdds_security_ac.so", "access_control"},
    {"crypto", "libdds_security_crypto.so", "crypto"},
}};

/// The directory of the Cyclone library that this process runs.
std::filesystem::path library_directory() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&dds_create_participant), &info) == 0 ||
      info.dli_fname == nullptr) {
    throw ConfigurationError("DDS Security: the library of Cyclone DDS cannot be located");
  }
  return std::filesystem::canonical(info.dli_fname).parent_path();
}

/// By full path: a bare name would be looked for wherever LD_LIBRARY_PATH points. Debian keeps
/// plugins in a directory of their own.
std::string plugin_path(const Plugin& plugin) {
  const std::filesystem::path base = library_directory();
  for (const std::filesystem::path& directory : {base / "libddsc0debian", base}) {
    std::error_code ignored;
    if (std::filesystem::exists(directory / plugin.library, ignored)) {
      return (directory / plugin.library).string();
    }
  }
  throw ConfigurationError(
      fmt::format("DDS Security: {} is neither in {}/libddsc0debian nor in {}; install Cyclone DDS "
                  "with its security plugins (Debian: libddsc0debian), or leave security out",
                  plugin.library, base.string(), base.string()));
}

void set_property(dds_qos_t* qos, std::string_view name, const std::string& value) {
  dds_qset_prop(qos, fmt::format("dds.sec.{}", name).c_str(), value.c_str());
}

void require_usable(const scene::SecurityFiles& files) {
  std::string text;
  for (const std::string& complaint : scene::complaints_about(files)) {
    text += fmt::format("{}DDS Security: {}", text.empty() ? "" : "\n", complaint);
  }
  if (!text.empty()) {
    throw ConfigurationError(text);
  }
}

}  // namespace

QosHandle make_security_qos(const scene::SecurityFiles& files) {
  require_usable(files);
  QosHandle qos = make_partition_qos(nullptr);
  for (const Plugin& plugin : kPlugins) {
    const std::string library = fmt::format("{}.library.", plugin.property);
    set_property(qos.get(), library + "path", plugin_path(plugin));
    set_property(qos.get(), library + "init", fmt::format("init_{}", plugin.functions));
    set_property(qos.get(), library + "finalize", fmt::format("finalize_{}", plugin.functions));
  }
  const auto set_file = [&](std::string_view name, const std::filesystem::path& file) {
    set_property(qos.get(), name, "file:" + std::filesystem::absolute(file).string());
  };
  set_file("auth.identity_ca", files.identity_ca);
  set_file("auth.identity_certificate", files.identity_certificate);
  set_file("auth.private_key", files.private_key);
  set_file("access.permissions_ca", files.permissions_ca);
  set_file("access.governance", files.governance);
  set_file("access.permissions", files.permissions);
  return qos;
}

}  // namespace adstar::dds
