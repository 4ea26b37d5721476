#pragma once

#include <string_view>

namespace curvefusion {

/// The text of report.html around its data, put together from apps/report_page/ when this program
/// is built (cmake/WriteReportPage.cmake).
extern const std::string_view kReportPageBeforeData;
extern const std::string_view kReportPageAfterData;

}  // namespace curvefusion
