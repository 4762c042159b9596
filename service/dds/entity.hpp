#pragma once
// Owner of one DDS entity handle: move-only, dds_delete at the end. Delete children before parents.

#include <string>
#include <utility>

#include <dds/dds.h>

#include "service/dds/error.hpp"

namespace adstar::dds {

class Entity {
 public:
  Entity() = default;
  /// Takes what a dds_create_* call returned; throws Error when that is an error code.
  Entity(dds_entity_t created, std::string_view call, std::string subject)
      : handle_(check(created, call, subject)), subject_(std::move(subject)) {}

  Entity(Entity&& other) noexcept
      : handle_(std::exchange(other.handle_, 0)), subject_(std::move(other.subject_)) {}
  Entity& operator=(Entity&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(subject_, other.subject_);
    return *this;
  }
  Entity(const Entity&) = delete;
  Entity& operator=(const Entity&) = delete;

  ~Entity() {
    if (handle_ > 0) {
      check_quietly(dds_delete(handle_), "dds_delete", subject_);
    }
  }

  dds_entity_t handle() const noexcept { return handle_; }
  /// What error messages call it, e.g. "'adstar/attitude_state'".
  const std::string& subject() const noexcept { return subject_; }

 private:
  dds_entity_t handle_ = 0;
  std::string subject_;
};

}  // namespace adstar::dds
