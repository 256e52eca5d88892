#pragma once

#include <string>

#include "analysis/report/report.h"

namespace plenolab::detail {

/// HTML of the blocks of a report. Each throws InputError for content that cannot be shown.
std::string block_html(const Paragraph& paragraph);
std::string block_html(const ReportTable& table);
std::string block_html(const ReportPlot& plot);
std::string block_html(const ImageComparison& comparison);
std::string block_html(const ReportLedger& ledger);
std::string provenance_html(const Provenance& provenance);

/// "data:TYPE;base64,…" of bytes.
std::string data_uri(const std::string& type, const std::string& bytes);

}  // namespace plenolab::detail
