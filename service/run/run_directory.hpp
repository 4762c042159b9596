#pragma once
// A run on disk: the scene it flies, checkpoints, and the journal since.
//
//   run.json  scene.toml                     what is flown
//   checkpoint-000007.bin                    the newest have the highest count
//   journal-000012.bin                       likewise; the records go on from one to the next
//   received.bin                             a standby's: the state of the primary, as it came
//   lock                                     held by the daemon that flies it
//   ended                                    while nobody does, if its last daemon left nothing in memory

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "service/run/files.hpp"
#include "service/scene/scene.hpp"

namespace adstar::run {

struct RunFacts {
  std::uint64_t run = 0;  ///< 64 random bits: whose checkpoints and journals these are
  std::string scene_text;
  std::filesystem::path scene_file;  ///< where it was read: its tables are looked up beside it
  std::string service, duration;     ///< what the command line laid over it; empty: nothing
  bool standby = false;  ///< begun by a standby: it has its first state from its primary
  std::filesystem::path memory = "/dev/shm";  ///< a tmpfs: where the end of its journal is
};

/// The end of its journal: a file of that tmpfs, by the name of the run.
std::filesystem::path memory_file(const RunFacts& facts);

struct Numbered {
  std::filesystem::path path;
  std::uint64_t number = 0;  ///< in its name
};

class RunDirectory {
 public:
  /// Makes it and holds it. Throws RunError when it holds a run already.
  static RunDirectory create(const std::filesystem::path& path, const RunFacts& facts);
  enum class Use { fly, look };
  /// One that is there. Throws RunError when there is no run in it, or a daemon that flies it.
  static RunDirectory open(const std::filesystem::path& path, Use use);

  const RunFacts& facts() const { return facts_; }
  const std::filesystem::path& path() const { return path_; }

  /// From now on the end of its journal is there. Throws RunError.
  void move_memory_to(const std::filesystem::path& memory);

  void note_good_end() const;
  bool ended_well() const;
  void forget_good_end() const;

  std::vector<Numbered> checkpoints() const;  ///< newest first
  std::vector<Numbered> journals() const;     ///< oldest first
  std::filesystem::path checkpoint_path(std::uint64_t count) const;
  std::filesystem::path journal_path(std::uint64_t count) const;
  static std::filesystem::path received_path(const std::filesystem::path& run) {
    return run / "received.bin";
  }

 private:
  RunDirectory(std::filesystem::path path, RunFacts facts)
      : path_(std::move(path)), facts_(std::move(facts)) {}
  void hold();
  void write_facts() const;

  std::filesystem::path path_;
  RunFacts facts_;
  File lock_;
};

/// Of all in the scene that decides about the state, its tables too.
std::uint64_t scene_fingerprint(const scene::Scene& scene, std::string_view text);

}  // namespace adstar::run
