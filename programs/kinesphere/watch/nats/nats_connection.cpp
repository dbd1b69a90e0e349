// A connection to a NATS server that is made again whenever it breaks.
#include "watch/nats/nats_connection.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "program_error.hpp"

namespace kinesphere::program {

NatsConnection::NatsConnection(const NatsAddress& address) : address_(address) {
  natsOptions* created = nullptr;
  natsStatus status = natsOptions_Create(&created);
  const std::unique_ptr<natsOptions, NatsDelete<natsOptions_Destroy>> options(created);
  const auto next = [&status](natsStatus done) { status = status == NATS_OK ? done : status; };
  if (status == NATS_OK) {
    next(natsOptions_SetURL(options.get(), address.server.c_str()));
    next(natsOptions_SetName(options.get(), "kinesphere watch"));
    next(natsOptions_SetTimeout(options.get(), 5000));
    // For as long as it takes, with so many milliseconds between.
    next(natsOptions_SetMaxReconnect(options.get(), -1));
    next(natsOptions_SetReconnectWait(options.get(), 250));
  }
  natsConnection* connection = nullptr;
  if (status == NATS_OK) next(natsConnection_Connect(&connection, options.get()));
  connection_.reset(connection);
  jsCtx* jetstream = nullptr;
  if (status == NATS_OK) next(natsConnection_JetStream(&jetstream, connection, nullptr));
  jetstream_.reset(jetstream);
  if (status != NATS_OK) fail(status, "cannot connect");
}

std::optional<std::string> NatsConnection::stream_of(const std::string& subject) const {
  const std::string question = nlohmann::json{{"subject", subject}}.dump();
  natsMsg* reply = nullptr;
  const natsStatus status =
      natsConnection_RequestString(&reply, get(), "$JS.API.STREAM.NAMES", question.c_str(), 5000);
  const NatsMessage message(reply);
  if (status == NATS_NO_RESPONDERS) return std::nullopt;
  if (status != NATS_OK) fail(status, "cannot ask for streams");
  const std::string_view text(natsMsg_GetData(reply), static_cast<std::size_t>(natsMsg_GetDataLength(reply)));
  const auto answer = nlohmann::json::parse(text, nullptr, false);
  const auto streams = answer.find("streams");
  if (streams == answer.end() || !streams->is_array() || streams->empty()) return std::nullopt;
  if (streams->size() > 1)
    throw ProgramError(fmt::format("{}: expected one stream of JetStream that holds '{}', but there are {}",
                                   address_.name, subject, streams->size()));
  return streams->front().get<std::string>();
}

NatsStreamInfo NatsConnection::stream_info(const std::string& stream) const {
  jsStreamInfo* info = nullptr;
  if (js_GetStreamInfo(&info, jetstream(), stream.c_str(), nullptr, nullptr) != NATS_OK) return nullptr;
  return NatsStreamInfo(info);
}

void NatsConnection::fail(natsStatus status, const char* what) const {
  throw ProgramError(fmt::format("{}: {}: {}", address_.name, what, natsStatus_GetText(status)));
}

}  // namespace kinesphere::program
