// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/libusb_bus.hpp"

#include <libusb.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace swiftlet {
namespace {

constexpr std::uint8_t kVendorRequestOut = std::uint8_t{LIBUSB_ENDPOINT_OUT} |
                                           std::uint8_t{LIBUSB_REQUEST_TYPE_VENDOR} |
                                           std::uint8_t{LIBUSB_RECIPIENT_DEVICE};

UsbOutcome outcome_of(int code) {
  switch (code) {
    case LIBUSB_SUCCESS:
      return UsbOutcome::kDone;
    case LIBUSB_ERROR_TIMEOUT:
      return UsbOutcome::kTimeout;
    case LIBUSB_ERROR_PIPE:
      return UsbOutcome::kStall;
    case LIBUSB_ERROR_OVERFLOW:
      return UsbOutcome::kOverflow;
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
      return UsbOutcome::kNoDevice;
    case LIBUSB_ERROR_ACCESS:
      return UsbOutcome::kAccessDenied;
    case LIBUSB_ERROR_BUSY:
      return UsbOutcome::kBusy;
    default:
      return UsbOutcome::kFault;
  }
}

/// libusb takes 0 for "for ever".
unsigned milliseconds_of(Duration timeout) {
  const auto count = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
  return static_cast<unsigned>(std::clamp<long long>(count, 1, std::numeric_limits<int>::max()));
}

struct CloseHandle {
  void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
using Handle = std::unique_ptr<libusb_device_handle, CloseHandle>;

std::variant<Handle, UsbOutcome> open_handle(libusb_device* device) {
  libusb_device_handle* handle = nullptr;
  const int code = libusb_open(device, &handle);
  if (code != LIBUSB_SUCCESS) return outcome_of(code);
  return Handle(handle);
}

class LibusbDevice final : public UsbDevice {
 public:
  LibusbDevice(Handle handle, int interface) : handle_(std::move(handle)), interface_(interface) {}
  ~LibusbDevice() override { libusb_release_interface(handle_.get(), interface_); }

  UsbTransfer control_out(std::uint8_t request, std::uint16_t value, std::uint16_t index,
                          std::span<const std::uint8_t> data, Duration timeout) override {
    const int sent = libusb_control_transfer(
        handle_.get(), kVendorRequestOut, request, value, index, const_cast<std::uint8_t*>(data.data()),
        static_cast<std::uint16_t>(data.size()), milliseconds_of(timeout));
    if (sent < 0) return {outcome_of(sent), 0};
    return {UsbOutcome::kDone, static_cast<std::size_t>(sent)};
  }
  UsbTransfer bulk_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes,
                       Duration timeout) override {
    return bulk(endpoint, const_cast<std::uint8_t*>(bytes.data()), bytes.size(), timeout);
  }
  UsbTransfer bulk_in(std::uint8_t endpoint, std::span<std::uint8_t> buffer, Duration timeout) override {
    return bulk(endpoint, buffer.data(), buffer.size(), timeout);
  }
  UsbOutcome clear_halt(std::uint8_t endpoint) override {
    return outcome_of(libusb_clear_halt(handle_.get(), endpoint));
  }
  UsbOutcome reset() override { return outcome_of(libusb_reset_device(handle_.get())); }

 private:
  /// libusb has one function for both directions: going out, it only reads the bytes.
  UsbTransfer bulk(std::uint8_t endpoint, std::uint8_t* bytes, std::size_t size, Duration timeout) {
    int transferred = 0;
    const int code = libusb_bulk_transfer(handle_.get(), endpoint, bytes, static_cast<int>(size),
                                          &transferred, milliseconds_of(timeout));
    return {outcome_of(code), static_cast<std::size_t>(transferred)};
  }

  Handle handle_;
  int interface_;
};

/// The devices plugged in at present, held during the lifetime of this object.
class DeviceList {
 public:
  explicit DeviceList(libusb_context* context) : count_(libusb_get_device_list(context, &devices_)) {}
  ~DeviceList() {
    if (devices_ != nullptr) libusb_free_device_list(devices_, 1);
  }
  DeviceList(const DeviceList&) = delete;
  DeviceList& operator=(const DeviceList&) = delete;

  [[nodiscard]] std::span<libusb_device* const> devices() const {
    return {devices_, count_ < 0 ? std::size_t{0} : static_cast<std::size_t>(count_)};
  }

 private:
  libusb_device** devices_ = nullptr;
  ssize_t count_;
};

std::string text_of(libusb_device_handle* handle, std::uint8_t index) {
  std::array<unsigned char, 256> text{};
  const int size = index == 0 ? 0
                              : libusb_get_string_descriptor_ascii(handle, index, text.data(),
                                                                   static_cast<int>(text.size()));
  return size <= 0 ? std::string() : std::string(text.begin(), text.begin() + size);
}

UsbIdentity identity_of(libusb_device* device, const libusb_device_descriptor& descriptor) {
  UsbIdentity identity;
  identity.vendor = descriptor.idVendor;
  identity.product = descriptor.idProduct;
  identity.release_bcd = descriptor.bcdDevice;
  identity.bus = libusb_get_bus_number(device);
  identity.address = libusb_get_device_address(device);
  return identity;
}

void read_texts(libusb_device* device, const libusb_device_descriptor& descriptor, UsbIdentity& identity) {
  const std::variant<Handle, UsbOutcome> opened = open_handle(device);
  if (const UsbOutcome* failure = std::get_if<UsbOutcome>(&opened)) {
    identity.access = *failure;
    return;
  }
  libusb_device_handle* handle = std::get<Handle>(opened).get();
  identity.manufacturer = text_of(handle, descriptor.iManufacturer);
  identity.name = text_of(handle, descriptor.iProduct);
  identity.serial = text_of(handle, descriptor.iSerialNumber);
}

int LIBUSB_CALL note_change(libusb_context* /*context*/, libusb_device* /*device*/,
                            libusb_hotplug_event /*event*/, void* has_changed) {
  *static_cast<bool*>(has_changed) = true;
  return 0;
}

}  // namespace

Result<std::unique_ptr<UsbBus>> LibusbBus::open() {
  libusb_context* context = nullptr;
  const int code = libusb_init(&context);
  if (code != LIBUSB_SUCCESS)
    return Error{ErrorCode::kNotFound, std::string("USB cannot be used here: libusb reports ") +
                                           libusb_error_name(code) + "; is /dev/bus/usb there?"};
  return std::unique_ptr<UsbBus>(new LibusbBus(context));  // its constructor is private
}

LibusbBus::LibusbBus(libusb_context* context) : context_(context) {
  if (libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG) == 0) return;
  const int events = LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;
  reports_changes_ = libusb_hotplug_register_callback(context_, events, 0, LIBUSB_HOTPLUG_MATCH_ANY,
                                                      LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY,
                                                      note_change, &has_changed_, nullptr) == LIBUSB_SUCCESS;
}

LibusbBus::~LibusbBus() { libusb_exit(context_); }

std::vector<UsbIdentity> LibusbBus::list(std::uint16_t vendor, std::uint16_t product) {
  std::vector<UsbIdentity> found;
  const DeviceList plugged_in(context_);
  for (libusb_device* device : plugged_in.devices()) {
    libusb_device_descriptor descriptor{};
    if (libusb_get_device_descriptor(device, &descriptor) != LIBUSB_SUCCESS) continue;
    if (descriptor.idVendor != vendor || descriptor.idProduct != product) continue;
    found.push_back(identity_of(device, descriptor));
    read_texts(device, descriptor, found.back());
  }
  std::ranges::sort(found, {}, [](const UsbIdentity& id) { return std::tuple(id.bus, id.address); });
  return found;
}

std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> LibusbBus::open(const UsbIdentity& identity,
                                                                     int interface) {
  const DeviceList plugged_in(context_);
  const auto found = std::ranges::find_if(plugged_in.devices(), [&](libusb_device* device) {
    return libusb_get_bus_number(device) == identity.bus &&
           libusb_get_device_address(device) == identity.address;
  });
  if (found == plugged_in.devices().end()) return UsbOutcome::kNoDevice;
  std::variant<Handle, UsbOutcome> opened = open_handle(*found);
  if (const UsbOutcome* failure = std::get_if<UsbOutcome>(&opened)) return *failure;
  Handle handle = std::get<Handle>(std::move(opened));
  const UsbOutcome claimed = outcome_of(libusb_claim_interface(handle.get(), interface));
  if (claimed != UsbOutcome::kDone) return claimed;
  return std::make_unique<LibusbDevice>(std::move(handle), interface);
}

bool LibusbBus::has_changed() {
  if (!reports_changes_) return true;
  timeval at_once{};
  libusb_handle_events_timeout_completed(context_, &at_once, nullptr);
  return std::exchange(has_changed_, false);
}

}  // namespace swiftlet
