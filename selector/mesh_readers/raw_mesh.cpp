#include "selector/mesh_readers/raw_mesh.h"

#include <cstring>

#include "runtime/error.h"

namespace elastogen::selector {
namespace {

// First bytes of a record: its form, and with it the order of bytes.
constexpr std::uint64_t signature = 0x656c6173746f0002;

class Packer {
 public:
  template <class Value>
  void add(const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class Values>
  void add_all(const Values& values) {
    add(static_cast<std::uint64_t>(values.size()));
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
  }

  std::string bytes;
};

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

  template <class Value>
  void take(Value& value) {
    copy(&value, sizeof value);
  }
  template <class Values>
  void take_all(Values& values) {
    values.resize(take_size(sizeof values[0]));
    copy(values.data(), values.size() * sizeof values[0]);
  }
  /// A number of things that take so many bytes each, or more.
  std::size_t take_size(std::size_t bytes_each) {
    std::uint64_t size = 0;
    take(size);
    if (size > bytes_.size() / bytes_each) fail();
    return static_cast<std::size_t>(size);
  }
  void expect_end() const {
    if (!bytes_.empty()) fail();
  }
  [[noreturn]] static void fail() {
    throw InternalError("the mesh that a reader handed over is damaged");
  }

 private:
  void copy(void* to, std::size_t size) {
    if (size > bytes_.size()) fail();
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }

  std::string_view bytes_;
};

}  // namespace

std::string pack(const RawMesh& mesh) {
  Packer packer;
  packer.add(signature);
  packer.add_all(mesh.node_numbers);
  packer.add_all(mesh.coordinates);
  packer.add(static_cast<std::uint64_t>(mesh.groups.size()));
  for (const RawGroup& group : mesh.groups) {
    packer.add(group.dim);
    packer.add(group.number);
    packer.add_all(group.name);
  }
  packer.add(static_cast<std::uint64_t>(mesh.elements.size()));
  for (const RawElements& elements : mesh.elements) {
    packer.add(elements.dim);
    packer.add_all(elements.element);
    packer.add_all(elements.type_name);
    packer.add(elements.nodes_per_element);
    packer.add_all(elements.numbers);
    packer.add_all(elements.nodes);
    packer.add_all(elements.groups);
  }
  packer.add(static_cast<std::uint64_t>(mesh.notes.size()));
  for (const std::string& note : mesh.notes) packer.add_all(note);
  return packer.bytes;
}

RawMesh unpack(std::string_view bytes) {
  Unpacker unpacker(bytes);
  std::uint64_t found = 0;
  unpacker.take(found);
  if (found != signature) Unpacker::fail();
  RawMesh mesh;
  unpacker.take_all(mesh.node_numbers);
  unpacker.take_all(mesh.coordinates);
  mesh.groups.resize(unpacker.take_size(1));
  for (RawGroup& group : mesh.groups) {
    unpacker.take(group.dim);
    unpacker.take(group.number);
    unpacker.take_all(group.name);
  }
  mesh.elements.resize(unpacker.take_size(1));
  for (RawElements& elements : mesh.elements) {
    unpacker.take(elements.dim);
    unpacker.take_all(elements.element);
    unpacker.take_all(elements.type_name);
    unpacker.take(elements.nodes_per_element);
    unpacker.take_all(elements.numbers);
    unpacker.take_all(elements.nodes);
    unpacker.take_all(elements.groups);
  }
  mesh.notes.resize(unpacker.take_size(1));
  for (std::string& note : mesh.notes) unpacker.take_all(note);
  unpacker.expect_end();
  return mesh;
}

}  // namespace elastogen::selector
