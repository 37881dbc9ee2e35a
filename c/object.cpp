// SPDX-License-Identifier: BSD-3-Clause
#include "object.hpp"

#include "messages/in_quotes.hpp"

#include <string_view>

void delone_object::refuse(const char* what) const {
  throw delone::Error(delone::Errc::unsupported,
                      "an object of the kind " + std::string(kind()) + " cannot be " + what);
}

std::unique_ptr<delone_object> delone_object::clone() const { refuse("cloned"); }

void delone_object::insert(const double*, std::size_t, const double*) { refuse("inserted into"); }

delone::CheckReport delone_object::check(const delone::CheckOptions&, const delone::Execution&) const {
  refuse("checked");
}

void delone_object::write(const std::string&, const std::string&) const { refuse("written"); }

namespace delone::c {
namespace {

constexpr const char* name_of_type(int type) {
  return type == DELONE_ARRAY     ? "array"
         : type == DELONE_INTEGER ? "integer"
         : type == DELONE_REAL    ? "real"
                                  : "text";
}

/// The member of that name and type. Throws invalid_argument, naming those that there are.
template <class T>
T get(const delone_object* object, const char* name, int type) {
  const delone_object& of = required(object, "the object");
  const std::string_view wanted = &required(name, "the name of the member");
  std::string all;
  for (const Member& one : of.members()) {
    if (one.type != type) continue;
    if (one.name == wanted) return std::get<T>(one.get(of));
    all += (all.empty() ? "" : ", ") + std::string(one.name);
  }
  throw Error(Errc::invalid_argument, "an object of the kind " + std::string(of.kind()) + " has no " +
                                          name_of_type(type) + " " + messages::in_quotes(wanted) +
                                          (all.empty() ? "" : "; it has " + all));
}

template <class T>
int get(const delone_object* object, const char* name, int type, T* value) {
  return run([&] { required(value, "the place for the value") = get<T>(object, name, type); });
}

}  // namespace
}  // namespace delone::c

using namespace delone::c;

void delone_free(delone_object* object) { delete object; }

int delone_clone(const delone_object* object, delone_object** copy) {
  return make(copy, [&] { return required(object, "the object").clone(); });
}

const char* delone_kind(const delone_object* object) { return object == nullptr ? "" : object->kind(); }

const char* delone_member(const delone_object* object, std::size_t i, int* type) {
  const char* name = nullptr;
  run([&] {
    if (object == nullptr || i >= object->members().size()) return;
    const Member& found = object->members()[i];
    name = found.name;
    if (type != nullptr) *type = found.type;
  });
  return name;
}

int delone_get_array(const delone_object* object, const char* name, delone_array* array) {
  return get(object, name, DELONE_ARRAY, array);
}
int delone_get_integer(const delone_object* object, const char* name, std::int64_t* value) {
  return get(object, name, DELONE_INTEGER, value);
}
int delone_get_real(const delone_object* object, const char* name, double* value) {
  return get(object, name, DELONE_REAL, value);
}
int delone_get_text(const delone_object* object, const char* name, const char** text) {
  return get(object, name, DELONE_TEXT, text);
}

int delone_insert(delone_object* object, const double* rows, std::size_t num_rows, const double* weights) {
  return run([&] { required(object, "the object").insert(rows, num_rows, weights); });
}

int delone_write(const delone_object* object, const char* path, const char* format) {
  return run([&] {
    required(object, "the object").write(&required(path, "the path"), format == nullptr ? "" : format);
  });
}
