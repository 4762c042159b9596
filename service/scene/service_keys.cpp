// [service], [dds] and [log]

#include <array>
#include <unistd.h>

#include "service/scene/nearest.hpp"
#include "service/scene/sections.hpp"

namespace adstar::scene {
namespace {

std::string host_name() {
  std::array<char, 256> buffer{};
  if (gethostname(buffer.data(), buffer.size() - 1) != 0) {
    return "adstard";
  }
  return as_name(buffer.data());
}

/// All six or none: half of it would protect nothing, and look as if it did.
std::optional<SecurityFiles> read_security(const Value& table, const std::filesystem::path& file) {
  if (!table) {
    return std::nullopt;
  }
  Keys keys(table, "[dds.security] on a line of its own");
  SecurityFiles files;
  for (const SecurityFile& each : kSecurityFiles) {
    const std::string example = in_quotes("security/daemon/" + std::string(each.file_name));
    const Want want{"the path of a file", example};
    const Value value = keys.required(each.key, want);
    if (const auto path = read_text(value, want)) {
      files.*each.path = file.parent_path() / *path;
      if (path->empty()) {
        value.refuse(want.expected, want.example);
      }
    }
  }
  keys.refuse_unknown();
  return files;
}

}  // namespace

Service read_service(Keys& root) {
  Keys keys = root.section("service", "[service] on a line of its own");
  Service service;
  const Value name = keys.optional("name");
  service.name = name ? read_name(name, "\"adstard\"").value_or("") : host_name();
  const Want priority{"an integer from 0 (ordinary scheduling) to 99", "80"};
  service.priority = static_cast<int>(
      read_integer(keys.optional("priority"), {0, 99}, priority).value_or(service.priority));
  const auto processors = static_cast<std::int64_t>(sysconf(_SC_NPROCESSORS_CONF));
  const std::string last = std::to_string(processors - 1);
  const std::string range = "a processor of this machine, 0 to " + last;
  if (const auto cpu = read_integer(keys.optional("cpu"), {0, processors - 1}, Want{range, last})) {
    service.cpu = static_cast<int>(*cpu);
  }
  service.run_control =
      read_flag(keys.optional("run_control"), "true").value_or(service.run_control);
  keys.refuse_unknown();
  return service;
}

Dds read_dds(Keys& root, const std::filesystem::path& file) {
  Keys keys = root.section("dds", "[dds] on a line of its own");
  Dds dds;
  const Want domain{"an integer from 0 to 230", "0"};
  dds.domain = static_cast<std::uint32_t>(
      read_integer(keys.optional("domain"), {0, 230}, domain).value_or(dds.domain));
  dds.partition =
      read_text(keys.optional("partition"), {"a string", "\"simulation\""}).value_or("");
  const Value interface = keys.optional("interface");
  const Want network{"the name of a network interface", "\"lo\""};
  if (const auto name = read_text(interface, network)) {
    dds.interface = *name;
    if (name->empty()) {
      interface.refuse(network.expected, network.example);
    }
  }
  dds.security = read_security(keys.optional("security"), file);
  keys.refuse_unknown();
  return dds;
}

Log read_log(Keys& root) {
  constexpr std::array<std::string_view, 5> kLevels{"trace", "debug", "info", "warn", "error"};
  Keys keys = root.section("log", "[log] on a line of its own");
  Log log;
  if (const auto level = read_choice(keys.optional("level"), kLevels)) {
    log.level = kLevels[*level];
  }
  log.file =
      read_text(keys.optional("file"), {"the path of a file", "\"adstar.log\""}).value_or("");
  keys.refuse_unknown();
  return log;
}

}  // namespace adstar::scene
