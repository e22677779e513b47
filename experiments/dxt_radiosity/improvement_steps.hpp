#pragma once

namespace radiosity {

/// A variant of the compressed matrix, and what it changes.
struct NamedVariant {
  const char* change;
  const char* spec;
};

constexpr const char* document_variant = "dxt";
constexpr const char* improved_variant = "dxt:range=auto,fill=1,reorder=morton,fit=cluster";
constexpr const char* kernel_variant = "dxt:matrix=kernel,range=6,fill=1,reorder=morton";
constexpr const char* closed_kernel_variant =
    "dxt:matrix=kernel,range=6,fill=1,reorder=morton,closure=symmetric";
constexpr const char* closed_colour_variant = "dxt:range=auto,fill=1,reorder=morton,fit=cluster,closure=rows";

/// From a random order to the kernel that channels share, and what to compare with.
constexpr NamedVariant improvement_variants[] = {
    {"random order, no reordering", "dxt:start=random,reorder=none"},
    {"the document's: rows, then columns", document_variant},
    {"+ codes over what the numbers span", "dxt:range=auto"},
    {"  or over 6 natural logarithms", "dxt:range=6"},
    {"  or over 7", "dxt:range=7"},
    {"+ texels of exact entries free", "dxt:range=auto,fill=1"},
    {"+ order along curves on the faces", "dxt:range=auto,fill=1,reorder=morton"},
    {"  or the shorter path of 2-opt", "dxt:range=auto,fill=1,reorder=2opt"},
    {"+ blocks by cluster fit", improved_variant},
    {"  over 6", "dxt:range=6,fill=1,reorder=morton,fit=cluster"},
    {"  over 7", "dxt:range=7,fill=1,reorder=morton,fit=cluster"},
    {"  over what they span, by 2-opt", "dxt:range=auto,fill=1,reorder=2opt,fit=cluster"},
    {"+ row sums restored", closed_colour_variant},
    {"BC4 for each channel", "dxt:codec=bc4,range=6,fill=1,reorder=morton"},
    {"BC4 once, for the kernel of all channels", kernel_variant},
    {"+ 10 % exact", "dxt:matrix=kernel,range=6,fill=1,reorder=morton,exact=0.1"},
    {"BC4 kernel, row sums restored", closed_kernel_variant},
    {"4 bits in blocks", "quantized"},
    {"the kernel in binary16", "dense:f16"}};

}  // namespace radiosity
