#include "service/bridge/status_writer.hpp"

#include "service/dds/convert.hpp"

namespace adstar::bridge {
namespace {

std::string key_text(const adstar_CommandStatus& status) {
  std::string text(dds::text_of(status.spacecraft));
  text += '\0';
  text += dds::text_of(status.actuator);
  text += '\0';
  text.append(reinterpret_cast<const char*>(&status.commander), sizeof status.commander);
  return text;
}

}  // namespace

bool StatusWriter::write(const adstar_CommandStatus& status, Clock::time_point now) {
  std::string text = key_text(status);
  const std::lock_guard lock(mutex_);
  if (const auto found = by_key_.find(text); found != by_key_.end()) {
    found->second->last = now;
    uses_.splice(uses_.end(), uses_, found->second);
  } else {
    if (uses_.size() >= most_) {
      forget_oldest();
    }
    uses_.push_back({status, std::move(text), now});
    by_key_.emplace(uses_.back().text, std::prev(uses_.end()));
  }
  return writer_.write(status);
}

void StatusWriter::forget_silent(std::chrono::seconds silence, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  for (int i = 0; i < 1000 && !uses_.empty() && now - uses_.front().last > silence; ++i) {
    forget_oldest();
  }
}

std::size_t StatusWriter::instances() const {
  const std::lock_guard lock(mutex_);
  return uses_.size();
}

void StatusWriter::forget_oldest() {
  writer_.unregister_instance(uses_.front().key);
  by_key_.erase(uses_.front().text);
  uses_.pop_front();
}

}  // namespace adstar::bridge
