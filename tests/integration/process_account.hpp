#pragma once
// What the kernel says of a process: its memory, its UDP ports.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <sys/types.h>

#include <fmt/format.h>

namespace adstar::testing {

/// VmRSS [kB]; 0 when there is no such process.
inline std::uint64_t resident_kb(pid_t process) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) {
      return std::stoull(line.substr(6));
    }
  }
  return 0;
}

/// Ports of its own sockets: /proc/PID/net/udp lists those of everybody in the network namespace.
inline std::set<std::uint16_t> udp_ports_of(pid_t process) {
  std::set<std::string> inodes;
  std::error_code gone;
  for (const auto& entry :
       std::filesystem::directory_iterator(fmt::format("/proc/{}/fd", process), gone)) {
    const std::string target = std::filesystem::read_symlink(entry.path(), gone).string();
    if (target.starts_with("socket:[")) {
      inodes.insert(target.substr(8, target.size() - 9));
    }
  }
  std::set<std::uint16_t> ports;
  std::ifstream table(fmt::format("/proc/{}/net/udp", process));
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream words(line);
    std::string slot, local, word, inode;
    words >> slot >> local;
    for (int i = 0; i < 8 && words >> word; ++i) {
      inode = word;
    }
    if (inodes.contains(inode)) {
      const auto port = std::stoul(local.substr(local.find(':') + 1), nullptr, 16);
      ports.insert(static_cast<std::uint16_t>(port));
    }
  }
  return ports;
}

}  // namespace adstar::testing
