#include "service/run/run_directory.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fcntl.h>
#include <sys/file.h>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace adstar::run {
namespace {

namespace fs = std::filesystem;

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::string text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Files called PREFIX<number>.bin.
std::vector<Numbered> numbered(const fs::path& directory, std::string_view prefix) {
  std::vector<Numbered> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    Numbered file{entry.path(), 0};
    if (!name.starts_with(prefix)) {
      continue;
    }
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + prefix.size(), end, file.number);
    if (error == std::errc{} && std::string_view(rest, end) == ".bin") {
      found.push_back(std::move(file));
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Numbered& a, const Numbered& b) { return a.number < b.number; });
  return found;
}

RunFacts read_facts(const fs::path& path) {
  const fs::path file = path / "run.json";
  try {
    const auto json = nlohmann::json::parse(text_of(read_bytes(file)));
    RunFacts facts;
    const std::string id = json.at("run");
    if (std::from_chars(id.data(), id.data() + id.size(), facts.run, 16).ec != std::errc{}) {
      throw RunError("no run id");
    }
    facts.scene_file = json.at("scene_file").get<std::string>();
    facts.service = json.at("service");
    facts.duration = json.at("duration");
    facts.standby = json.value("standby", false);
    facts.memory = fs::path(json.at("memory").get<std::string>()).parent_path();
    facts.scene_text = text_of(read_bytes(path / "scene.toml"));
    return facts;
  } catch (const nlohmann::json::exception& error) {
    throw RunError(fmt::format("{}: cannot be understood ({}); restore it, or begin another run",
                               file.string(), error.what()));
  }
}

}  // namespace

fs::path memory_file(const RunFacts& facts) {
  return facts.memory / fmt::format("adstar-{:016x}", facts.run);
}

RunDirectory RunDirectory::create(const fs::path& path, const RunFacts& facts) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) {
    throw RunError(fmt::format("{}: cannot be made: {}; name a directory that you may write to",
                               path.string(), error.message()));
  }
  if (fs::exists(path / "run.json")) {
    throw RunError(fmt::format(
        "{} holds a run already: go on with it (adstard --resume {}), or name another directory",
        path.string(), path.string()));
  }
  RunDirectory directory(path, facts);
  directory.hold();
  replace_file(path / "scene.toml", bytes_of(facts.scene_text));
  directory.write_facts();
  return directory;
}

void RunDirectory::write_facts() const {
  const nlohmann::json json{{"run", fmt::format("{:016x}", facts_.run)},
                            {"scene_file", fs::absolute(facts_.scene_file).string()},
                            {"service", facts_.service},
                            {"duration", facts_.duration},
                            {"standby", facts_.standby},
                            {"memory", memory_file(facts_).string()}};
  replace_file(path_ / "run.json", bytes_of(json.dump(2) + "\n"));
}

RunDirectory RunDirectory::open(const fs::path& path, Use use) {
  if (!fs::exists(path / "run.json")) {
    throw RunError(fmt::format(
        "{} holds no run: it has no run.json; a run is begun with adstard SCENE --run {}",
        path.string(), path.string()));
  }
  RunDirectory directory(path, read_facts(path));
  if (use == Use::fly) {
    directory.hold();
  }
  return directory;
}

void RunDirectory::move_memory_to(const fs::path& memory) {
  if (memory != facts_.memory) {
    facts_.memory = memory;
    write_facts();
  }
}

void RunDirectory::note_good_end() const { replace_file(path_ / "ended", {}); }

bool RunDirectory::ended_well() const { return fs::exists(path_ / "ended"); }

void RunDirectory::forget_good_end() const {
  fs::remove(path_ / "ended");
  File(path_, O_RDONLY | O_DIRECTORY).sync();
}

void RunDirectory::hold() {
  lock_ = File(path_ / "lock", O_RDWR | O_CREAT);
  if (flock(lock_.fd(), LOCK_EX | LOCK_NB) != 0) {
    throw RunError(fmt::format("{} is flown by another adstard just now; stop that one first",
                               path_.string()));
  }
}

std::vector<Numbered> RunDirectory::checkpoints() const {
  std::vector<Numbered> files = numbered(path_, "checkpoint-");
  std::reverse(files.begin(), files.end());
  return files;
}

std::vector<Numbered> RunDirectory::journals() const { return numbered(path_, "journal-"); }

fs::path RunDirectory::checkpoint_path(std::uint64_t count) const {
  return path_ / fmt::format("checkpoint-{:06}.bin", count);
}

fs::path RunDirectory::journal_path(std::uint64_t count) const {
  return path_ / fmt::format("journal-{:06}.bin", count);
}

std::uint64_t scene_fingerprint(const scene::Scene& scene, std::string_view text) {
  Bytes bytes;
  append(bytes, checksum(bytes_of(text)));
  for (const scene::Spacecraft& craft : scene.spacecraft) {
    if (const auto* const ephemeris =
            craft.orbit ? std::get_if<std::shared_ptr<const Ephemeris<double>>>(&*craft.orbit)
                        : nullptr) {
      append(bytes, checksum(std::as_bytes(std::span((*ephemeris)->rows))));
    }
    for (const Torque<double>& torque : craft.torques) {
      if (const auto* const table = std::get_if<Table<double>>(&torque)) {
        append(bytes, checksum(std::as_bytes(std::span(table->time_ns))));
        append(bytes, checksum(std::as_bytes(std::span(table->torque_n_m))));
      }
    }
  }
  return checksum(bytes);
}

}  // namespace adstar::run
