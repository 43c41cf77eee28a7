#pragma once
/// @file Reading the keys of one table of a TOML file.

#include <toml++/toml.h>

#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/geometry/polygon.h"
#include "core/structure/block_limits.h"

namespace voussoir {

inline constexpr double kMostOfAnySetting = 1e15;
inline constexpr double kSmallestLength = 1e-3;  ///< [m] of any part: joints are found within 1e-6 m

/// Reads the keys of one table; remembers which were asked for, so that the others can be refused. A key that
/// is not there leaves its target as it was. All members throw InputError "file:line: message".
class TomlSection {
 public:
  /// `title` is for messages: " in [wall]". `table` may be null: no key is there.
  TomlSection(const std::string& file, const toml::table* table, std::string title)
      : file_(file), table_(table), title_(std::move(title)) {}

  void number(const char* key, double& target, double least, double most, bool may_be_least = true);
  void positive(const char* key, double& target, double most = kMostOfAnySetting) {
    number(key, target, 0.0, most, false);
  }
  void length(const char* key, double& target) { number(key, target, kSmallestLength, kLargestLength); }
  /// "friction_angle_deg", into radians of at least `least`; what is there, to the bit, if the key is not.
  void friction_angle(double& radians, double least);
  void not_negative(const char* key, double& target) { number(key, target, 0.0, kMostOfAnySetting); }
  void count(const char* key, int& target, int least, int most);
  void flag(const char* key, bool& target);
  void text(const char* key, std::string& target);
  /// ["a", "b"]; empty if the key is not there.
  std::vector<std::string> texts(const char* key);
  /// [[x, y], ..] in metres; empty if the key is not there.
  std::vector<Point> points(const char* key, std::size_t fewest, std::size_t most);

  template <typename Choice>
  void choice(const char* key, Choice& target,
              const std::vector<std::pair<const char*, std::type_identity_t<Choice>>>& choices) {
    const toml::node* node = take(key);
    if (node == nullptr) return;
    std::string names;
    for (const auto& [name, value] : choices) {
      if (node->is_string() && node->as_string()->get() == name) {
        target = value;
        return;
      }
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
    }
    refuse(key, "expected one of " + names);
  }

  /// A sub-table, or nothing; not-a-table is an error.
  const toml::table* table(const char* key);
  /// The tables of an array of tables, or nothing. `how` tells how one is written: "[[spans]]".
  const toml::array* tables(const char* key, const char* how);

  /// Names a key that is right here but is not always read.
  void know(const char* key) { known_.insert(key); }
  bool has(const char* key) const { return table_ != nullptr && table_->contains(key); }
  void require(const char* key) const;
  void refuse_unknown_keys() const;
  /// "file:line: key in [table]: expected", the line being the key's or, if it is missing, the table's.
  [[noreturn]] void refuse(const char* key, const std::string& expected) const;

  const std::string& file() const { return file_; }
  long line_of(const char* key) const;

 private:
  const toml::node* take(const char* key);

  const std::string& file_;
  const toml::table* table_;
  std::string title_;
  std::set<std::string> known_;
};

}  // namespace voussoir
