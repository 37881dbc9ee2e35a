// SPDX-License-Identifier: BSD-3-Clause
// Members of JSON objects that are missing, of another kind or out of range are errors that name them.
#include "tiles/json_members.hpp"

#include "../io/io_support.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <string>

namespace delone_test {
namespace {

using namespace delone;
using tiles::JsonMembers;

class JsonMembersTest : public TemporaryDirectory {
 protected:
  template <class Ask>
  static void expect_refused(const std::string& members, const std::vector<std::string>& parts, Ask ask,
                             Errc code = Errc::bad_format) {
    const nlohmann::json object = nlohmann::json::parse(members);
    expect_error(code, parts, [&] { ask(JsonMembers(object, "f")); });
  }
};

TEST_F(JsonMembersTest, AreReadAsWhatTheyAre) {
  const nlohmann::json object = nlohmann::json::parse(
      R"({"n": -3, "x": 1.5, "i": 2, "b": true, "t": "é", "a": [1, {}],
          "w": "0123456789abcdefffffffffffffffff", "u": 18446744073709551615})");
  const JsonMembers members(object, "f");
  EXPECT_EQ(members.number("n", -3, -3), -3);
  EXPECT_EQ(members.real("x"), 1.5);
  EXPECT_EQ(members.real("i"), 2) << "an integer is a real number";
  EXPECT_TRUE(members.flag("b"));
  EXPECT_EQ(members.text("t"), "é");
  EXPECT_EQ(members.array("a").size(), 2u);
  EXPECT_THAT(members.words<2>("w"), testing::ElementsAre(0x0123456789abcdefu, ~std::uint64_t{0}));
  EXPECT_EQ(tiles::hex_text(members.words<2>("w")), members.text("w"));
  EXPECT_EQ(members.name(), "f");
  constexpr auto largest = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t least : {std::int64_t{0}, std::int64_t{-1}, -largest})
    expect_error(Errc::bad_format, {"u: expected a number"}, [&] { members.number("u", least, largest); });
}

TEST_F(JsonMembersTest, OfAnotherKindAreNamed) {
  const auto number = [](const JsonMembers& of) { of.number("m", 1, 9); };
  const auto words = [](const JsonMembers& of) { of.words<1>("m"); };
  for (const char* const wrong : {"0", "10", "1.0", "\"1\"", "null", "[1]"})
    expect_refused(std::string("{\"m\": ") + wrong + "}",
                   {"f: m: expected a number from 1 to 9, found ", wrong[0] == '"' ? "1" : wrong}, number);
  expect_refused("{\"x\": 1}", {"f: there is no member 'm'"}, number);
  expect_refused("[1]", {"f: expected a JSON object"}, number);
  expect_refused("{\"m\": true}", {"m: expected a number, found"},
                 [](const JsonMembers& of) { of.real("m"); });
  expect_refused("{\"m\": 1}", {"m: expected true or false"}, [](const JsonMembers& of) { of.flag("m"); });
  expect_refused("{\"m\": 1}", {"m: expected a text"}, [](const JsonMembers& of) { of.text("m"); });
  expect_refused("{\"m\": {}}", {"m: expected an array"}, [](const JsonMembers& of) { of.array("m"); });
  for (const char* const wrong : {"0123456789abcde", "0123456789abcdefa", "0123456789abcdeF",
                                  "0x23456789abcdef", "-123456789abcdef", "0123456789abcde "})
    expect_refused(std::string("{\"m\": \"") + wrong + "\"}", {"m: expected 16 hexadecimal digits"}, words);
}

TEST_F(JsonMembersTest, FormatsAndVersionsAreKnown) {
  const auto ask = [](const JsonMembers& of) { of.require_format("delone-x", 2, "an index of tiles"); };
  const nlohmann::json right = nlohmann::json::parse(R"({"format": "delone-x", "version": 2})");
  ask(JsonMembers(right, "f"));
  expect_refused(R"({"format": "other\n", "version": 2})", {"f: not an index of tiles: its format is 'other"},
                 ask);
  expect_refused(R"({"format": "delone-x", "version": 3})",
                 {"version 3 of tiles; this program knows version 2"}, ask, Errc::unsupported);
  expect_refused(R"({"format": "delone-x", "version": 0})", {"version: expected a number from 1"}, ask);
  expect_refused(R"({"version": 2})", {"'format'"}, ask);
}

TEST_F(JsonMembersTest, FilesComeBackOrAreRefused) {
  nlohmann::ordered_json json;
  json["z"] = 1;
  json["a"] = {1.5, "x"};
  for (const bool durably : {false, true}) {
    tiles::write_json(path("f.json"), json, durably);
    EXPECT_EQ(content("f.json").substr(0, 9), "{\n \"z\": 1") << "in the given order";
    EXPECT_EQ(tiles::read_json(path("f.json"))["a"][0], 1.5);
  }
  expect_error(Errc::cannot_open, {"none.json"}, [&] { tiles::read_json(path("none.json")); });
  for (const char* const wrong : {"", "{", "{\"a\": 1} x", "{\"a\": nan}", "\xff\xfe"})
    expect_error(Errc::bad_format, {"g.json"}, [&] { tiles::read_json(file("g.json", wrong)); });
  expect_error(Errc::cannot_write, {"none"}, [&] { tiles::write_json(path("none/f.json"), json, false); });
}

}  // namespace
}  // namespace delone_test
