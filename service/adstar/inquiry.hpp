#pragma once
// A request to the clock of one service: repeated under its sequence number until that service answers.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "service/adstar/failure.hpp"
#include "service/adstar/random_id.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/dds/convert.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"
#include "service/dds/writer.hpp"

namespace adstar::cli {

inline adstar_CommanderId& asker_of(adstar_StepRequest& request) { return request.requester; }
inline adstar_CommanderId& asker_of(adstar_RunControl& request) { return request.commander; }
inline const adstar_CommanderId& asker_of(const adstar_StepReply& reply) { return reply.requester; }
inline const adstar_CommanderId& asker_of(const adstar_RunControlStatus& status) {
  return status.commander;
}

template <class Request, class Reply>
class Inquiry {
 public:
  using Clock = std::chrono::steady_clock;

  Inquiry(const dds::Participant& participant, std::string service)
      : service_(std::move(service)),
        id_(random_id()),
        writer_(participant),
        reader_(participant),
        wait_set_(participant) {
    wait_set_.attach(reader_);
  }

  /// The first answer for which `is_final(answer)`; nothing after a silence of `timeout`. Throws Failure
  /// when the user interrupts.
  template <class IsFinal>
  std::optional<Reply> ask(Request request, std::chrono::nanoseconds timeout, IsFinal&& is_final) {
    dds::set_text(request.service, service_);
    asker_of(request) = {id_.high, id_.low};
    request.sequence_number = ++sequence_;
    auto heard = Clock::now(), next_send = heard;
    std::optional<Reply> answer;
    while (Clock::now() - heard < timeout) {
      if (stop_requested()) {
        throw Failure(kFailed, "interrupted; what was asked for may still be done");
      }
      if (Clock::now() >= next_send) {
        const bool listened_to = heard_by_anyone();
        if (listened_to) {
          writer_.write(request);  // a full send window is what the next repetition is for
        }
        next_send = Clock::now() + (listened_to ? kRepeat : kUntilSomebodyListens);
      }
      reader_.take([&](const Reply& reply, const dds_sample_info_t&) {
        const runtime::CommanderId asker{asker_of(reply).high, asker_of(reply).low};
        if (asker == id_ && reply.sequence_number == sequence_ &&
            dds::text_of(reply.service) == service_ && !answer) {
          heard = Clock::now();
          if (is_final(reply)) {
            answer = reply;
          }
        }
      });
      if (answer) {
        return answer;
      }
      wait_set_.wait(next_send - Clock::now() > kAtOnce ? next_send - Clock::now() : kAtOnce);
    }
    return std::nullopt;
  }

  /// Some service listens to requests.
  bool heard_by_anyone() const { return writer_.matched() > 0; }

 private:
  static constexpr Clock::duration kAtOnce{0};
  static constexpr std::chrono::milliseconds kRepeat{50}, kUntilSomebodyListens{5};

  std::string service_;
  runtime::CommanderId id_;
  std::uint64_t sequence_ = 0;
  dds::Writer<Request> writer_;
  dds::Reader<Reply> reader_;
  dds::WaitSet wait_set_;
};

using StepInquiry = Inquiry<adstar_StepRequest, adstar_StepReply>;
using ControlInquiry = Inquiry<adstar_RunControl, adstar_RunControlStatus>;

}  // namespace adstar::cli
