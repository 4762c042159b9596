#pragma once
// What the models of a vehicle remember from step to step, and the target it was given, as plain words: for snapshots,
// checkpoints and the way back to a scene's start. Bodies and wheels are told apart from it (fleet_snapshot.hpp).

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "service/runtime/fleet.hpp"

namespace adstar::runtime {

/// Calls `each` with everything that is remembered, in an order that the scene alone decides.
template <class AnyVehicle, class Each>
void for_each_memory(AnyVehicle& vehicle, const Each& each) noexcept {
  for (auto& torque : vehicle.torques) {
    if (auto* const coils = std::get_if<Magnetorquer<double>>(&torque)) {
      each(coils->settled);
    }
  }
  if constexpr (requires { vehicle.reference; }) {
    if (vehicle.reference != nullptr && vehicle.reference->target) {
      each(vehicle.reference->target->attitude);
    }
  } else if (vehicle.target) {
    each(vehicle.target->attitude);
  }
  if (vehicle.linked != nullptr) {
    if constexpr (requires { vehicle.linked->state; }) {
      for (auto& body : vehicle.linked->state.bodies) {
        each(body);
      }
      for (auto& coordinates : vehicle.linked->state.coordinates) {
        each(coordinates);
      }
    } else {  // of a scene, which has no state yet: as many words
      for (std::size_t i = 0; i < vehicle.linked->bodies.size(); ++i) {
        each(multibody::BodyState<double>{});
      }
      for (std::size_t i = 0; i < vehicle.linked->joints.size(); ++i) {
        each(std::array<double, 3>{});
      }
    }
  }
}

template <class Record>
using WordsOf = std::array<std::uint64_t, sizeof(Record) / 8>;

/// Of a Vehicle, or of the scene::Spacecraft that it flies.
std::size_t memory_words(const auto& vehicle) noexcept {
  std::size_t words = 0;
  for_each_memory(vehicle, [&](const auto& record) { words += sizeof record / 8; });
  return words;
}

/// Copies it to `words`; returns where the next vehicle's goes.
inline std::uint64_t* save_memory(const Vehicle& vehicle, std::uint64_t* words) noexcept {
  for_each_memory(vehicle, [&](const auto& record) {
    using Record = std::decay_t<decltype(record)>;
    for (const std::uint64_t word : std::bit_cast<WordsOf<Record>>(record)) {
      *words++ = word;
    }
  });
  return words;
}

/// And back.
inline const std::uint64_t* load_memory(Vehicle& vehicle, const std::uint64_t* words) noexcept {
  for_each_memory(vehicle, [&](auto& record) {
    using Record = std::decay_t<decltype(record)>;
    WordsOf<Record> all;
    for (std::uint64_t& word : all) {
      word = *words++;
    }
    record = std::bit_cast<Record>(all);
  });
  return words;
}

}  // namespace adstar::runtime
