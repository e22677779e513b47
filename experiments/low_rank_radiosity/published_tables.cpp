// The numbers of Tables 1 to 5 of document 004, Section 5.3 and 5.4, as printed there.

#include "experiments/low_rank_radiosity/published_tables.hpp"

#include <array>

namespace radiosity {

std::span<const PublishedRatios> published_table_1() {
  static constexpr std::array<PublishedRatios, 9> table = {{{{3456, 216}, 15.67, 8.00, 0.60, 9.40},
                                                            {{3456, 864}, 68.33, 9.00, 0.60, 41.00},
                                                            {{13824, 216}, 21.67, 11.36, 0.64, 13.93},
                                                            {{3456, 3456}, 75.75, 18.33, 0.67, 50.50},
                                                            {{13824, 864}, 92.11, 13.21, 0.64, 59.21},
                                                            {{55296, 216}, 17.42, 11.20, 0.64, 11.20},
                                                            {{13824, 3456}, 335.50, 37.47, 0.67, 223.67},
                                                            {{55296, 864}, 94.03, 13.09, 0.65, 61.55},
                                                            {{221184, 216}, 24.01, 10.99, 0.58, 13.84}}};
  return table;
}

std::span<const PublishedRatios> published_table_2() {
  static constexpr std::array<PublishedRatios, 9> table = {{{{3456, 216}, 1.95, 4.50, 4.40, 8.60},
                                                            {{3456, 864}, 1.69, 2.38, 6.48, 10.93},
                                                            {{13824, 216}, 1.91, 5.21, 5.50, 10.53},
                                                            {{3456, 3456}, 1.43, 2.05, 5.70, 8.17},
                                                            {{13824, 864}, 1.88, 3.41, 9.73, 18.32},
                                                            {{55296, 216}, 1.90, 5.04, 5.58, 10.61},
                                                            {{13824, 3456}, 1.74, 3.59, 11.34, 19.67},
                                                            {{55296, 864}, 1.95, 3.62, 10.95, 21.34},
                                                            {{221184, 216}, 2.05, 5.04, 5.08, 10.43}}};
  return table;
}

std::span<const PublishedSpeeds> published_table_3() {
  static constexpr std::array<PublishedSpeeds, 9> table = {{{{3456, 216}, 814, 1591, 1556, 7000},
                                                            {{3456, 864}, 221, 372, 1014, 2414},
                                                            {{13824, 216}, 196, 374, 395, 2059},
                                                            {{3456, 3456}, 70, 100, 278, 569},
                                                            {{13824, 864}, 51, 96, 273, 933},
                                                            {{55296, 216}, 47, 90, 100, 504},
                                                            {{13824, 3456}, 14, 24, 76, 275},
                                                            {{55296, 864}, 12, 23, 70, 252},
                                                            {{221184, 216}, 11, 23, 23, 116}}};
  return table;
}

const PublishedSpeeds& published_average() {
  static constexpr PublishedSpeeds average = {{}, 159, 299, 421, 1569};
  return average;
}

std::span<const PublishedSecondMachine> published_table_4() {
  static constexpr std::array<PublishedSecondMachine, 3> table = {
      {{{13824, 3456}, 74.07, 297.87, 3.06, 1.09},
       {{55296, 864}, 73.61, 301.72, 3.20, 1.20},
       {{221184, 216}, 72.92, 190.74, 3.18, 1.64}}};
  return table;
}

std::span<const PublishedSecondMachine> published_table_5() {
  static constexpr std::array<PublishedSecondMachine, 6> table = {{{{1769472, 216}, 8.15, 24.05, {}, {}},
                                                                   {{221184, 3456}, 4.94, 21.81, {}, {}},
                                                                   {{442368, 1728}, 4.94, 20.59, {}, {}},
                                                                   {{884736, 864}, 4.55, 18.67, {}, {}},
                                                                   {{1769472, 432}, 4.10, 15.45, {}, {}},
                                                                   {{3538944, 216}, 4.00, 11.48, {}, {}}}};
  return table;
}

}  // namespace radiosity
