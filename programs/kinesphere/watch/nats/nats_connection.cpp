// A connection to a NATS server that reconnects whenever it breaks.
#include "watch/nats/nats_connection.hpp"

#include <fmt/format.h>
#include <simdjson.h>

#include <algorithm>
#include <cstdint>

#include "base/escaped_text.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"

namespace kinesphere::program {

namespace {

bool holds_all_of(std::string_view held, std::string_view subject) {
  const auto next_token = [](std::string_view& text) {
    const std::string_view token = text.substr(0, text.find('.'));
    text.remove_prefix(std::min(token.size() + 1, text.size()));
    return token;
  };
  while (!held.empty() && !subject.empty()) {
    const std::string_view holds = next_token(held), token = next_token(subject);
    if (holds == ">") return true;
    if (token == ">" || (holds != "*" && holds != token)) return false;
  }
  return held.empty() && subject.empty();
}

}  // namespace

bool holds_all_of(const std::vector<std::string>& held, std::string_view subject) {
  return std::any_of(held.begin(), held.end(),
                     [&](const std::string& each) { return holds_all_of(std::string_view(each), subject); });
}

NatsConnection::NatsConnection(const NatsAddress& address, bool is_quiet)
    : address_(address), is_quiet_(is_quiet) {
  natsOptions* created = nullptr;
  natsStatus status = natsOptions_Create(&created);
  const std::unique_ptr<natsOptions, NatsDelete<natsOptions_Destroy>> options(created);
  const auto next = [&status](natsStatus done) { status = status == NATS_OK ? done : status; };
  if (status == NATS_OK) {
    next(natsOptions_SetURL(options.get(), address.server.c_str()));
    next(natsOptions_SetName(options.get(), "kinesphere watch"));
    next(natsOptions_SetTimeout(options.get(), 5000));
    // Reconnects without a limit, with a fixed wait in between.
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
  const std::string question = fmt::format(R"({{"subject": {}}})", json_text(subject));
  natsMsg* reply = nullptr;
  const natsStatus status =
      natsConnection_RequestString(&reply, get(), "$JS.API.STREAM.NAMES", question.c_str(), 5000);
  const NatsMessage message(reply);
  if (status == NATS_NO_RESPONDERS) return std::nullopt;
  if (status != NATS_OK) fail(status, "cannot ask for streams");
  const std::string_view text(natsMsg_GetData(reply), static_cast<std::size_t>(natsMsg_GetDataLength(reply)));
  simdjson::dom::parser parser;
  simdjson::dom::object answer;
  if (parser.parse(text).get(answer))
    throw ProgramError(
        fmt::format("{}: expected an answer about streams, but got '{}'", address_.name, text));
  if (simdjson::dom::object error; !answer["error"].get(error)) {
    // JetStream is disabled for this account, or entirely.
    constexpr std::int64_t not_for_account = 10039, not_at_all = 10076;
    std::int64_t code = 0;
    std::string_view why;
    if (!error["err_code"].get(code) && (code == not_for_account || code == not_at_all)) return std::nullopt;
    if (error["description"].get(why)) why = "the server does not say why";
    throw ProgramError(fmt::format("{}: cannot ask for streams: {}", address_.name, why));
  }
  simdjson::dom::array streams;
  if (answer["streams"].get(streams) || streams.size() == 0) return std::nullopt;
  std::string_view name;
  if (streams.size() > 1 || streams.at(0).get(name))
    throw ProgramError(fmt::format("{}: expected one stream of JetStream that holds '{}', but there are {}",
                                   address_.name, subject, streams.size()));
  const std::string stream(name);
  natsStatus got{};
  const NatsStreamInfo info = stream_info(stream, got);
  if (!info) fail(got, "cannot ask for its stream");
  const char* const* const subjects = info->Config->Subjects;
  const std::vector<std::string> held(subjects, subjects + info->Config->SubjectsLen);
  if (!holds_all_of(held, subject))
    throw ProgramError(
        fmt::format("{}: expected a stream of JetStream that holds all of '{}', but {} holds '{}'",
                    address_.name, subject, stream, fmt::join(held, "', '")));
  return stream;
}

NatsStreamInfo NatsConnection::stream_info(const std::string& stream, natsStatus& status) const {
  jsStreamInfo* info = nullptr;
  status = js_GetStreamInfo(&info, jetstream(), stream.c_str(), nullptr, nullptr);
  return NatsStreamInfo(status == NATS_OK ? info : nullptr);
}

void NatsConnection::warn(const std::string& what) const {
  if (!is_quiet_) print_message("kinesphere: warning: {}: {}\n", address_.name, what);
}

void NatsConnection::check_open() const {
  if (natsConnection_Status(get()) != NATS_CONN_STATUS_CLOSED) return;
  const char* reason = nullptr;
  natsConnection_GetLastError(get(), &reason);
  throw ProgramError(fmt::format("{}: the server has closed the connection: {}", address_.name,
                                 reason != nullptr && *reason != '\0' ? reason : "it does not say why"));
}

void NatsConnection::fail(natsStatus status, const char* what) const {
  throw ProgramError(fmt::format("{}: {}: {}", address_.name, what, natsStatus_GetText(status)));
}

}  // namespace kinesphere::program
