#include "foundation/error.hpp"
#include "foundation/spec.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

/// The sentence of the UsageError that `action` throws.
template <typename Action>
std::string usage_error(const Action& action) {
  try {
    action();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Spec, ReadsANameAloneAndWithKeys) {
  Spec plain = Spec::parse("dense");
  EXPECT_EQ(plain.name(), "dense");
  EXPECT_EQ(plain.text(), "dense");
  EXPECT_NO_THROW(plain.finish());

  Spec spec = Spec::parse("dxt:exact=0.04,reorder=both,bounces=3,fast,slow=0");
  EXPECT_EQ(spec.name(), "dxt");
  EXPECT_EQ(spec.number("exact", 0, 0, 1), 0.04);
  EXPECT_EQ(spec.text("reorder", "rows"), "both");
  EXPECT_EQ(spec.integer("bounces", 1, 1, 10), 3);
  EXPECT_TRUE(spec.flag("fast"));
  EXPECT_FALSE(spec.flag("slow", true));
  EXPECT_TRUE(spec.flag("absent", true));
  EXPECT_EQ(spec.number("absent number", 2.5, 0, 9), 2.5);
  EXPECT_NO_THROW(spec.finish());
}

TEST(Spec, RefusesBrokenText) {
  EXPECT_EQ(usage_error([] { Spec::parse(""); }), "'' names nothing: write name or name:key=value,flag");
  EXPECT_EQ(usage_error([] { Spec::parse(":k=1"); }),
            "':k=1' names nothing: write name or name:key=value,flag");
  for (const char* text : {"svd:", "svd:,k=1", "svd:k=1,", "svd:=3"})
    EXPECT_EQ(usage_error([&] { Spec::parse(text); }),
              std::string("'") + text + "': a key is empty; write name:key=value,flag");
  EXPECT_EQ(usage_error([] { Spec::parse("svd:k="); }), "'svd:k=': key 'k' has no value");
  EXPECT_EQ(usage_error([] { Spec::parse("svd:k=1,k=2"); }), "'svd:k=1,k=2': key 'k' is given twice");
}

TEST(Spec, RefusesNumbersThatAreNoneOrOutOfRange) {
  const auto integer = [](const std::string& text) {
    return usage_error([&] { Spec::parse(text).integer("k", 1, 1, 100); });
  };
  EXPECT_EQ(integer("svd:k=0"), "'svd:k=0': k=0 is not a whole number in [1, 100]");
  EXPECT_EQ(integer("svd:k=7x"), "'svd:k=7x': k=7x is not a whole number in [1, 100]");
  EXPECT_EQ(integer("svd:k=1.5"), "'svd:k=1.5': k=1.5 is not a whole number in [1, 100]");
  EXPECT_EQ(integer("svd:k=99999999999999999999"),
            "'svd:k=99999999999999999999': k=99999999999999999999 is not a whole number in [1, 100]");
  EXPECT_EQ(integer("svd:k"), "'svd:k': k= is not a whole number in [1, 100]");
  const auto number = [](const std::string& text) {
    return usage_error([&] { Spec::parse(text).number("t", 1, 0, 0.5); });
  };
  EXPECT_EQ(number("h:t=nan"), "'h:t=nan': t=nan is not a number in [0, 0.5]");
  EXPECT_EQ(number("h:t=0.6"), "'h:t=0.6': t=0.6 is not a number in [0, 0.5]");
  EXPECT_EQ(number("h:t=inf"), "'h:t=inf': t=inf is not a number in [0, 0.5]");
  EXPECT_EQ(usage_error([] { Spec::parse("h:fast=2").flag("fast"); }),
            "'h:fast=2': fast=2 is neither 0 nor 1");
  EXPECT_EQ(usage_error([] { Spec::parse("h:name").text("name", ""); }),
            "'h:name': key 'name' needs a value: name=...");
}

TEST(Spec, ChoicesAreFlagsOrValues) {
  const std::vector<std::string> choices = {"f64", "f32"};
  const auto choose = [&](const std::string& text) {
    return Spec::parse(text).choice("storage", "f64", choices);
  };
  EXPECT_EQ(choose("dense"), "f64");
  EXPECT_EQ(choose("dense:f32"), "f32");
  EXPECT_EQ(choose("dense:storage=f32"), "f32");
  EXPECT_EQ(usage_error([&] { choose("dense:storage=f8"); }),
            "'dense:storage=f8': storage=f8 is not one of f64, f32");
  EXPECT_EQ(usage_error([&] { choose("dense:f32,f64"); }),
            "'dense:f32,f64': storage is given more than once (f32, f64); choose one");
  EXPECT_EQ(usage_error([&] { choose("dense:f32,storage=f32"); }),
            "'dense:f32,storage=f32': storage is given more than once (f32, f32); choose one");
}

TEST(Spec, UnknownKeysAreErrorsThatListTheKnownOnes) {
  const auto finish = [](const std::string& text) {
    return usage_error([&] {
      Spec spec = Spec::parse(text);
      spec.integer("k", 1, 1, 100);
      spec.flag("fast");
      spec.finish();
    });
  };
  EXPECT_EQ(finish("svd:rank=3"), "'svd:rank=3': key 'rank' is not known; 'svd' knows k, fast");
  EXPECT_EQ(finish("svd:k=3,quick"), "'svd:k=3,quick': key 'quick' is not known; 'svd' knows k, fast");
  EXPECT_EQ(usage_error([] { Spec::parse("lu:k=3").finish(); }),
            "'lu:k=3': 'lu' takes no keys, but 'k' is given");
}

TEST(Spec, TakesFurtherKeys) {
  EXPECT_EQ(with_keys("csr", "closure=rows"), "csr:closure=rows");
  EXPECT_EQ(with_keys("dense:f16", "closure=rows"), "dense:f16,closure=rows");
}

}  // namespace
}  // namespace radiosity
