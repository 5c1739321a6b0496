#include "scenes/packing/mixture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/packing/size_law.hpp"

namespace pulvis {
namespace {

constexpr double rounding_of_sums = 1e-6;  // so that three times 0.333333 is 1

class Mixer {
 public:
  Mixer(const MixtureOrder& order, const std::string& path, const schema::Origins& origins,
        Problems& problems)
      : packing_(order), path_(path), origins_(origins), problems_(problems) {}

  Mixture run() {
    if (!shares_are_told() || !two_are_given()) return {};
    for (std::size_t c = 0; c < packing_.classes.size(); ++c) laws_are_right(c);
    if (wrong_) return {};
    for (const MixtureClass& mixed : packing_.classes) laws_.push_back(law_of(mixed));
    const std::vector<int> numbers = numbers_of_classes();
    Mixture mixture;
    for (std::size_t c = 0; c < laws_.size(); ++c) add(c, numbers[c], mixture);
    return wrong_ ? Mixture{} : mixture;
  }

 private:
  struct Law {
    std::vector<SizeShare> sizes;
    ParticleMeasure own;
    double mean_content = 0;  // per particle
  };

  void refuse(const std::string& key, const std::string& message) {
    std::string at = path_ + key;
    while (!origins_.contains(at) && at.find('.') != std::string::npos) at.erase(at.rfind('.'));
    const auto found = origins_.find(at);
    problems_.add(found == origins_.end() ? document::Origin{{1, 1}, -1} : found->second,
                  path_ + key, message);
    wrong_ = true;
  }
  static std::string class_key(std::size_t c, const char* key) {
    return fmt::format(".class[{}].{}", c, key);
  }

  const char* share_key() const {
    return packing_.dimensions == 3 ? "volume_fraction" : "area_fraction";
  }

  template <class Member>
  std::size_t classes_with(Member member) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        packing_.classes, [&](const MixtureClass& mixed) { return (mixed.*member).has_value(); }));
  }

  bool shares_are_told() {
    const std::size_t all = packing_.classes.size();
    if (all == 0)
      refuse("", "a random packing without particles, allowed: at least one [[packing.class]]");
    const std::size_t numbers = classes_with(&MixtureClass::number);
    const std::size_t by_number = classes_with(&MixtureClass::number_fraction);
    const std::size_t by_share = classes_with(&MixtureClass::content_fraction);
    const bool alone = all == 1 && numbers + by_number + by_share == 0;
    const bool alike = (numbers == all) + (by_number == all) + (by_share == all) == 1 &&
                       numbers + by_number + by_share == all;
    if (all > 0 && !alone && !alike)
      refuse("",
             fmt::format("its classes state their amounts in different ways, allowed: every class "
                         "with a number, or every class with a number_fraction, or with {} {}",
                         packing_.dimensions == 3 ? "a" : "an", share_key()));
    if (by_number == all) add_up(&MixtureClass::number_fraction, "number_fraction");
    if (by_share == all) add_up(&MixtureClass::content_fraction, share_key());
    if (numbers > 0 && packing_.count)
      refuse(
          ".count",
          "has no effect together with the numbers of the classes, allowed: only one of the two");
    return !wrong_;
  }

  void add_up(std::optional<double> MixtureClass::*fraction, const char* key) {
    double sum = 0;
    for (const MixtureClass& mixed : packing_.classes) sum += (mixed.*fraction).value_or(0);
    if (std::abs(sum - 1) > rounding_of_sums && !packing_.classes.empty())
      refuse(class_key(packing_.classes.size() - 1, key),
             fmt::format("the fractions of the classes add up to {:g}, allowed: 1", sum));
  }

  bool two_are_given() {
    const bool counted = packing_.count || classes_with(&MixtureClass::number) > 0;
    const bool dense = packing_.density || packing_.dense;
    const int given = (counted ? 1 : 0) + (dense ? 1 : 0) + (packing_.height ? 1 : 0);
    const char* rule = "allowed: two of count (or the classes' numbers), density and height";
    if (given < 2) refuse("", fmt::format("the size of the packing is not determined, {}", rule));
    if (given > 2) refuse(".height", fmt::format("follows from count and density, {}", rule));
    if (given == 2 && !counted && !packing_.density)
      refuse(".density",
             "this choice does not determine the count, allowed: a number, or a count instead of "
             "the height");
    return !wrong_;
  }

  void laws_are_right(std::size_t c) {
    const SizeLaw& law = packing_.classes[c].size;
    if (law.kind == SizeLaw::Kind::uniform)
      for (const auto& [key, there] : {std::pair("minimum", law.minimum.has_value()),
                                       std::pair("maximum", law.maximum.has_value())})
        if (!there) refuse(class_key(c, key), "required key is missing, allowed: a quantity in m");
    if (law.minimum && law.maximum && *law.minimum >= *law.maximum)
      refuse(class_key(c, "maximum"),
             fmt::format("{:g} m leaves no range of sizes, allowed: > {:g} m", *law.maximum,
                         *law.minimum));
    const bool normal = law.kind == SizeLaw::Kind::normal;
    if (normal && !law.minimum && 3 * law.deviation >= law.mean)
      refuse(class_key(c, "deviation"),
             fmt::format("{:g} m allows sizes down to zero, allowed: < {:g} m, a third of the "
                         "mean, or a minimum size",
                         law.deviation, law.mean / 3));
    if (!normal && law.kind != SizeLaw::Kind::lognormal) return;
    const double far = 6 * law.deviation;
    if ((law.minimum && *law.minimum > law.mean + far) ||
        (law.maximum && *law.maximum < law.mean - far))
      refuse(class_key(c, law.minimum && *law.minimum > law.mean ? "minimum" : "maximum"),
             "cuts off the whole distribution, allowed: within six deviations of the mean");
  }

  Law law_of(const MixtureClass& mixed) const {
    Law law{.sizes = {}, .own = packing_.measure(mixed)};
    if (mixed.size.kind == SizeLaw::Kind::mono) {
      law.sizes = {{law.own.size, 1}};
    } else {
      SieveCurve curve;
      if (mixed.size.kind == SizeLaw::Kind::sieve)
        curve = read_sieve_curve(packing_.folder / mixed.size.file);
      law.sizes = sizes_of(mixed.size, curve, mixed.size.sizes, packing_.dimensions);
    }
    for (const SizeShare& size : law.sizes) law.mean_content += size.share * content(law, size);
    return law;
  }

  static double scale(const Law& law, const SizeShare& size) { return size.size / law.own.size; }
  double content(const Law& law, const SizeShare& size) const {
    const double k = scale(law, size);
    return (packing_.dimensions == 3 ? k * k * k : k * k) * law.own.content;
  }

  // Number fraction of each class.
  std::vector<double> number_shares() const {
    std::vector<double> shares;
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const MixtureClass& mixed = packing_.classes[c];
      shares.push_back(mixed.content_fraction ? *mixed.content_fraction / laws_[c].mean_content
                                              : mixed.number_fraction.value_or(1));
    }
    return shares;
  }

  // From the room in the die, if the count is not given.
  int count(const std::vector<double>& shares) {
    double number = 0, sum = 0;
    for (std::size_t c = 0; c < shares.size(); ++c) {
      number += shares[c];
      sum += shares[c] * laws_[c].mean_content;
    }
    const double wanted = *packing_.density * packing_.base * *packing_.height / (sum / number);
    if (wanted >= 0.5 && wanted <= 1e5) return static_cast<int>(wanted + 0.5);
    refuse(".height",
           fmt::format("{:.3g} particles fill the die, allowed: from 1 to 100000", wanted));
    return 0;
  }

  std::vector<int> numbers_of_classes() {
    std::vector<int> numbers;
    for (const MixtureClass& mixed : packing_.classes)
      if (mixed.number) numbers.push_back(*mixed.number);
    if (!numbers.empty()) return numbers;
    const std::vector<double> shares = number_shares();
    return apportioned(packing_.count ? *packing_.count : count(shares), shares);
  }

  void add(std::size_t c, int number, Mixture& mixture) {
    const Law& law = laws_[c];
    const MixtureClass& mixed = packing_.classes[c];
    if (number == 0 && !wrong_)
      refuse(class_key(c, mixed.content_fraction ? share_key() : "number_fraction"),
             "no whole particle of this class remains, allowed: a larger count or fraction");
    std::vector<double> shares;
    for (const SizeShare& size : law.sizes) shares.push_back(size.share);
    const std::vector<int> numbers = apportioned(number, shares);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i] == 0) continue;  // for a law with more sizes than particles
      mixture.sizes.push_back({mixed.particle, scale(law, law.sizes[i]), numbers[i]});
      mixture.count += numbers[i];
      mixture.content += numbers[i] * content(law, law.sizes[i]);
    }
  }

  const MixtureOrder& packing_;
  const std::string& path_;
  const schema::Origins& origins_;
  Problems& problems_;
  std::vector<Law> laws_;
  bool wrong_ = false;
};

}  // namespace

Mixture mixture_of(const MixtureOrder& order, const std::string& path,
                   const schema::Origins& origins, Problems& problems) {
  return Mixer(order, path, origins, problems).run();
}

}  // namespace pulvis
