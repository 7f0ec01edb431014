#include "engine/state/world_state.h"

#include <cstring>
#include <string>
#include <string_view>

#include "engine/base/hash.h"
#include "engine/state/archives.h"

namespace tact {

namespace {

constexpr std::string_view kMagic = "tactstat";
constexpr std::uint32_t kVersion = 4;  // of the bytes: another one where any list of fields changes

// What stands before the content.
struct Head {
  std::uint64_t size = 0, checksum = 0;  // of the content
};
constexpr std::size_t kHeadSize = kMagic.size() + sizeof kVersion + sizeof(Head);

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_state, what); }

// The content, once head and checksum are good.
std::span<const std::byte> content_of(std::span<const std::byte> bytes) {
  if (bytes.size() < kHeadSize || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
    refuse("not a saved state: it does not begin with tactstat");
  std::uint32_t version = 0;
  std::memcpy(&version, bytes.data() + kMagic.size(), sizeof version);
  if (version != kVersion)
    refuse("a state of version " + std::to_string(version) + ", not " + std::to_string(kVersion));
  Head head;
  std::memcpy(&head, bytes.data() + kHeadSize - sizeof head, sizeof head);
  const std::span<const std::byte> content = bytes.subspan(kHeadSize);
  if (content.size() != head.size) refuse("the state is not as long as it says");
  if (checksum_of(content) != head.checksum) refuse("the state is damaged: its checksum is another");
  return content;
}

}  // namespace

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  base::Hash hash;
  hash.add(std::uint64_t{bytes.size()});
  hash.add(bytes);
  return hash.value();
}

std::vector<std::byte> saved_world(const Settings& settings, const Bodies& bodies, const Step& step) {
  StateWriter writer;
  std::vector<std::byte>& bytes = writer.bytes();
  bytes.resize(kHeadSize);
  writer(settings);
  StateFields::write(bodies, StateFields::gone_in(step, bodies), writer);
  StateFields::write(step, bodies, writer);
  const std::span<const std::byte> content = std::span(bytes).subspan(kHeadSize);
  const Head head{content.size(), checksum_of(content)};
  std::memcpy(bytes.data(), kMagic.data(), kMagic.size());
  std::memcpy(bytes.data() + kMagic.size(), &kVersion, sizeof kVersion);
  std::memcpy(bytes.data() + kHeadSize - sizeof head, &head, sizeof head);
  return std::move(bytes);
}

RestoredWorld restored_world(std::span<const std::byte> bytes, const Settings& settings, const Bodies& bodies) try {
  StateReader reader(content_of(bytes));
  Settings restored = settings;
  reader(restored);
  Bodies of_world = StateFields::read_bodies(reader, bodies);
  Step::Restored step = StateFields::read_step(reader, of_world);
  reader.check(reader.bytes_left() == 0, "the state goes on after its end");
  return {std::move(restored), std::move(of_world), std::move(step)};
} catch (const Error& error) {
  // What a body or a setting cannot be is the fault of the bytes.
  if (error.code() == ErrorCode::bad_state || error.code() == ErrorCode::out_of_memory) throw;
  if (error.code() == ErrorCode::too_large) throw;
  refuse(error.what());
}

}  // namespace tact
