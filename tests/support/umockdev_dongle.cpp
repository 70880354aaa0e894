// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/umockdev_dongle.hpp"

#include <linux/capability.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <umockdev.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <list>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

constexpr const char* kSysPath = "/sys/devices/usb1/1-1";
// Device, configuration, interface and the two bulk endpoints of a Crazyradio PA.
constexpr std::string_view kDescriptors =
    "12010002FFFFFF40151977775300010203010902200001010080320904000002FFFFFF000705810240000007050102400000";
// The kernel holds a reap back until something is done; a mock-up's file always seems ready, and without this
// pause libusb would ask without end.
constexpr Duration kReapPause = std::chrono::milliseconds(1);

constexpr std::size_t kSetupSize = 8;
constexpr std::uint8_t kVendorOut = 0x40;
constexpr std::uint8_t kStandardIn = 0x80;
constexpr std::uint8_t kGetDescriptor = 0x06;
constexpr std::uint8_t kStringDescriptor = 0x03;

using Bytes = std::vector<std::uint8_t>;
struct DataUnref {
  void operator()(UMockdevIoctlData* data) const { umockdev_ioctl_data_unref(data); }
};
using IoctlData = std::unique_ptr<UMockdevIoctlData, DataUnref>;
struct ObjectUnref {
  void operator()(gpointer object) const { g_object_unref(object); }
};

std::string device_file(std::uint8_t address) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "/dev/bus/usb/001/%03d", int{address});
  return text.data();
}

std::string device_record(std::uint8_t address) {
  const std::string file = device_file(address);
  const std::string number = std::to_string(address);
  return "P: /devices/usb1/1-1\nN: " + file.substr(5) +
         "\nE: SUBSYSTEM=usb\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=" + file.substr(file.size() - 3) +
         "\nE: DEVNAME=" + file + "\nE: DEVTYPE=usb_device\nA: busnum=1\\n\nA: devnum=" + number +
         "\\n\nA: bConfigurationValue=1\\n\nA: speed=12\\n\nH: descriptors=" + std::string(kDescriptors) +
         "\n";
}

int errno_of(UsbOutcome outcome) {
  switch (outcome) {
    case UsbOutcome::kDone:
      return 0;
    case UsbOutcome::kStall:
      return EPIPE;
    case UsbOutcome::kOverflow:
      return EOVERFLOW;
    case UsbOutcome::kNoDevice:
      return ESHUTDOWN;
    default:
      return EIO;
  }
}

/// String descriptors: 0 lists the languages, the others as the device descriptor numbers them.
Bytes string_descriptor(std::uint8_t index) {
  if (index == 0) return {4, kStringDescriptor, 0x09, 0x04};
  constexpr std::array kTexts{EmulatedCrazyradio::kManufacturer, EmulatedCrazyradio::kNameOfPa,
                              EmulatedCrazyradio::kSerial};
  if (index > kTexts.size()) return {};
  Bytes bytes{0, kStringDescriptor};
  for (const char c : std::string_view(kTexts[index - 1U])) {
    bytes.push_back(static_cast<std::uint8_t>(c));
    bytes.push_back(0);
  }
  bytes[0] = static_cast<std::uint8_t>(bytes.size());
  return bytes;
}

/// Takes from the calling thread what lets root open every file, or gives it back.
void set_file_privileges(bool granted) {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> sets{};
  SWIFTLET_CHECK(syscall(SYS_capget, &header, sets.data()) == 0, "capabilities can be read");
  constexpr std::uint32_t kMask = 1U << CAP_DAC_OVERRIDE | 1U << CAP_DAC_READ_SEARCH;
  sets[0].effective = granted ? sets[0].effective | (sets[0].permitted & kMask) : sets[0].effective & ~kMask;
  SWIFTLET_CHECK(syscall(SYS_capset, &header, sets.data()) == 0, "capabilities can be given up");
}

/// A transfer that libusb has handed over and not got back.
struct Urb {
  IoctlData data;
  UMockdevIoctlData* buffer = nullptr;  // belongs to data
  bool finished = false;
  [[nodiscard]] usbdevfs_urb& fields() const { return *reinterpret_cast<usbdevfs_urb*>(data->data); }
  [[nodiscard]] std::span<std::uint8_t> bytes() const {
    return buffer == nullptr ? std::span<std::uint8_t>()
                             : std::span(buffer->data, static_cast<std::size_t>(buffer->data_len));
  }
  void finish(int error, std::size_t size) {
    fields().status = -error;
    fields().actual_length = static_cast<int>(size);
    finished = true;
  }
};

}  // namespace

class UmockdevDongle::Impl {
 public:
  explicit Impl(EmulatedCrazyradio& dongle)
      : dongle_(dongle), testbed_(umockdev_testbed_new()), handler_(umockdev_ioctl_base_new()) {
    g_signal_connect(handler_.get(), "handle-ioctl", G_CALLBACK(&Impl::on_ioctl), this);
    appear();
  }
  ~Impl() {
    set_access(true);
    if (dongle_.is_plugged_in()) disappear();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void with(const std::function<void(EmulatedCrazyradio&)>& action) {
    const std::lock_guard lock(mutex_);
    live_on();
    action(dongle_);
  }
  void unplug() {
    with([](EmulatedCrazyradio& dongle) { dongle.unplug(); });
    disappear();
  }
  void plug_in() {
    with([](EmulatedCrazyradio& dongle) { dongle.plug_in(); });
    appear();
    umockdev_testbed_uevent(testbed_.get(), kSysPath, "add");
  }
  void set_access(bool allowed) {
    const std::unique_ptr<char, decltype(&g_free)> root(umockdev_testbed_get_root_dir(testbed_.get()),
                                                        g_free);
    const int changed = chmod((root.get() + file_).c_str(), allowed ? 0600 : 0);
    SWIFTLET_CHECK(changed == 0 || !dongle_.is_plugged_in(), "the device file's rights can be changed");
    set_file_privileges(allowed);
  }

 private:
  void appear() {
    file_ = device_file(dongle_.bus_address());
    // Before the device: a program that is notified may open it at once.
    bool done = umockdev_testbed_attach_ioctl(testbed_.get(), file_.c_str(), handler_.get(), nullptr) != 0;
    done = done && umockdev_testbed_add_from_string(
                       testbed_.get(), device_record(dongle_.bus_address()).c_str(), nullptr) != 0;
    SWIFTLET_CHECK(done, "the mock-up takes the device");
  }
  void disappear() {
    umockdev_testbed_uevent(testbed_.get(), kSysPath, "remove");
    umockdev_testbed_remove_device(testbed_.get(), kSysPath);
    umockdev_testbed_detach_ioctl(testbed_.get(), file_.c_str(), nullptr);
  }

  static gboolean on_ioctl(UMockdevIoctlBase* /*handler*/, UMockdevIoctlClient* client, Impl* self) {
    const int answer = self->handle(client);
    if (answer == kNotHandled) return FALSE;
    umockdev_ioctl_client_complete(client, answer == 0 ? 0 : -1, answer);
    return TRUE;
  }

  static constexpr int kNotHandled = -1;

  /// The errno for the caller, 0 for success.
  int handle(UMockdevIoctlClient* client) {
    const gulong request = umockdev_ioctl_client_get_request(client);
    UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
    if (request == USBDEVFS_REAPURB || request == USBDEVFS_REAPURBNDELAY) return reap(client, argument);
    const std::lock_guard lock(mutex_);
    live_on();
    if (request == USBDEVFS_DISCARDURB) return discard(argument);
    if (is_stale(client)) return ENODEV;
    switch (request) {
      case USBDEVFS_GET_CAPABILITIES:
        put_u32(argument, USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                              USBDEVFS_CAP_REAP_AFTER_DISCONNECT);
        return 0;
      case USBDEVFS_CLAIMINTERFACE:
        return dongle_.claimed_by_another ? EBUSY : 0;
      case USBDEVFS_GETDRIVER:
        return ENODATA;
      case USBDEVFS_RELEASEINTERFACE:
      case USBDEVFS_SETCONFIGURATION:
        return 0;
      case USBDEVFS_RESET:
        return errno_of(dongle_.reset());
      case USBDEVFS_CLEAR_HALT:
        return errno_of(dongle_.clear_halt(static_cast<std::uint8_t>(get_u32(argument))));
      case USBDEVFS_SUBMITURB:
        return submit(argument);
      default:
        return kNotHandled;
    }
  }

  [[nodiscard]] bool is_stale(UMockdevIoctlClient* client) const {
    return !dongle_.is_plugged_in() || file_ != umockdev_ioctl_client_get_devnode(client);
  }

  static void put_u32(UMockdevIoctlData* argument, std::uint32_t value) {
    const IoctlData data(umockdev_ioctl_data_resolve(argument, 0, sizeof value, nullptr));
    std::memcpy(data->data, &value, sizeof value);
  }
  static std::uint32_t get_u32(UMockdevIoctlData* argument) {
    const IoctlData data(umockdev_ioctl_data_resolve(argument, 0, sizeof(std::uint32_t), nullptr));
    std::uint32_t value = 0;
    std::memcpy(&value, data->data, sizeof value);
    return value;
  }

  int submit(UMockdevIoctlData* argument) {
    Urb urb;
    urb.data.reset(umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr));
    if (urb.data == nullptr) return EFAULT;
    const auto length = static_cast<std::size_t>(urb.fields().buffer_length);
    const IoctlData buffer(
        umockdev_ioctl_data_resolve(urb.data.get(), offsetof(usbdevfs_urb, buffer), length, nullptr));
    urb.buffer = buffer.get();
    urbs_.push_back(std::move(urb));
    try_to_finish(urbs_.back());
    return 0;
  }

  void try_to_finish(Urb& urb) {
    if (urb.finished) return;
    const std::span<std::uint8_t> bytes = urb.bytes();
    if (urb.fields().type == USBDEVFS_URB_TYPE_CONTROL) return finish_control(urb);
    if (urb.fields().endpoint == EmulatedCrazyradio::kOut) {
      const UsbOutcome outcome = dongle_.bulk_out(bytes);
      if (outcome == UsbOutcome::kTimeout) return;
      return urb.finish(errno_of(outcome), outcome == UsbOutcome::kDone ? bytes.size() : 0);
    }
    const UsbTransfer transfer = dongle_.bulk_in(bytes);
    if (transfer.outcome != UsbOutcome::kTimeout) urb.finish(errno_of(transfer.outcome), transfer.size);
  }

  void finish_control(Urb& urb) {
    const std::span<std::uint8_t> bytes = urb.bytes();
    if (bytes.data() == nullptr || bytes.size() < kSetupSize) return urb.finish(EINVAL, 0);
    const std::span<std::uint8_t> data = bytes.subspan(kSetupSize);
    const auto u16_at = [&](std::size_t at) {
      return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
    };
    if (bytes[0] == kVendorOut) {
      const UsbOutcome outcome =
          dongle_.control_out({bytes[1], u16_at(2), u16_at(4), {data.begin(), data.end()}});
      return urb.finish(errno_of(outcome), data.size());
    }
    Bytes answer;
    if (bytes[0] == kStandardIn && bytes[1] == kGetDescriptor && bytes[3] == kStringDescriptor)
      answer = string_descriptor(bytes[2]);
    if (answer.empty()) return urb.finish(EPIPE, 0);
    const std::size_t size = std::min(answer.size(), data.size());
    std::copy_n(answer.begin(), size, data.begin());
    urb.finish(0, size);
  }

  int reap(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
    if (hand_back_finished(argument)) return 0;
    Duration pause = kReapPause;
    {
      const std::lock_guard lock(mutex_);
      if (is_stale(client) && urbs_.empty()) return ENODEV;
      if (const std::optional<Duration> ready_in = dongle_.answer_in()) pause = std::min(pause, *ready_in);
    }
    std::this_thread::sleep_for(pause);
    return hand_back_finished(argument) ? 0 : EAGAIN;
  }

  bool hand_back_finished(UMockdevIoctlData* argument) {
    const std::lock_guard lock(mutex_);
    live_on();
    for (Urb& urb : urbs_) try_to_finish(urb);
    const auto urb = std::ranges::find_if(urbs_, &Urb::finished);
    if (urb == urbs_.end()) return false;
    const IoctlData pointer(umockdev_ioctl_data_resolve(argument, 0, sizeof(gpointer), nullptr));
    umockdev_ioctl_data_set_ptr(pointer.get(), 0, urb->data.get());
    urbs_.erase(urb);
    return true;
  }

  int discard(UMockdevIoctlData* argument) {
    gulong address = 0;
    std::memcpy(&address, argument->data, sizeof address);
    const auto urb =
        std::ranges::find_if(urbs_, [&](const Urb& other) { return other.data->client_addr == address; });
    if (urb == urbs_.end() || urb->finished) return EINVAL;
    urb->finish(ENOENT, 0);
    return 0;
  }

  /// Real time since the last look passes for the dongle too.
  void live_on() {
    const auto now = std::chrono::steady_clock::now();
    dongle_.advance(now - lived_until_);
    lived_until_ = now;
  }

  std::mutex mutex_;
  EmulatedCrazyradio& dongle_;
  std::chrono::steady_clock::time_point lived_until_ = std::chrono::steady_clock::now();
  std::list<Urb> urbs_;
  std::string file_;
  std::unique_ptr<UMockdevTestbed, ObjectUnref> testbed_;
  std::unique_ptr<UMockdevIoctlBase, ObjectUnref> handler_;
};

bool UmockdevDongle::is_possible() {
  const char* const preloaded = std::getenv("LD_PRELOAD");
  return preloaded != nullptr &&
         std::string_view(preloaded).find("libumockdev-preload") != std::string_view::npos;
}

UmockdevDongle::UmockdevDongle(EmulatedCrazyradio& dongle) : impl_(std::make_unique<Impl>(dongle)) {}
UmockdevDongle::~UmockdevDongle() = default;

void UmockdevDongle::with(const std::function<void(EmulatedCrazyradio&)>& action) { impl_->with(action); }
void UmockdevDongle::unplug() { impl_->unplug(); }
void UmockdevDongle::plug_in() { impl_->plug_in(); }
void UmockdevDongle::set_access(bool allowed) { impl_->set_access(allowed); }

}  // namespace swiftlet
