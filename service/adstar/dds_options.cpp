#include "service/adstar/dds_options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "service/adstar/usage.hpp"

namespace adstar::cli {

void add_dds_options(CLI::App& verb, dds::ParticipantOptions& options) {
  constexpr std::uint64_t kLastDomain = 230;
  verb.add_option("--domain", options.domain, "DDS domain, as the scene's [dds] says")
      ->type_name("N")
      ->check(whole_number(0, kLastDomain))
      ->capture_default_str();
  verb.add_option("--interface", options.interface, "Network interface to speak on")
      ->type_name("IF")
      ->capture_default_str();
  verb.add_option("--partition", options.partition, "DDS partition (default: the default one)")
      ->type_name("NAME");
  verb.add_option_function<std::string>(
          "--security",
          [&options](const std::string& directory) {
            options.security = scene::security_files_in(directory);
          },
          "Directory with this client's keys and permissions, as deploy/security/make.sh makes it")
      ->type_name("DIR")
      ->envname("ADSTAR_SECURITY");
}

std::string place_of(const dds::ParticipantOptions& options) {
  return fmt::format(
      "domain {}, interface {}, {}{}", options.domain, options.interface,
      options.partition.empty() ? "default partition" : "partition '" + options.partition + "'",
      options.security ? ", secured" : "");
}

void log_to_stderr(const std::string& verb) {
  const auto logger =
      std::make_shared<spdlog::logger>("adstar", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("adstar " + verb + ": %l: %v");
  logger->set_level(spdlog::level::warn);
  spdlog::set_default_logger(logger);
}

}  // namespace adstar::cli
