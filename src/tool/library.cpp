// SPDX-License-Identifier: BSD-3-Clause
#include "tool/library.hpp"

namespace pnpbs::tool {

ExitCode exit_code_of(pnpbs_status error) {
  switch (error) {
    case PNPBS_ERROR_ARGUMENT:
    case PNPBS_ERROR_DOMAIN:
    case PNPBS_ERROR_SPACING:
    case PNPBS_ERROR_KEY:
    case PNPBS_ERROR_FILE:
      return ExitCode::bad_input;
    default:
      return ExitCode::failed;
  }
}

pnpbs_status check(pnpbs_status status, pnpbs_context context) {
  if (status >= 0) return status;
  std::string message = pnpbs_last_error(context);
  if (message.empty()) message = pnpbs_status_string(status);
  throw Failure(exit_code_of(status), message);
}

std::vector<LibraryOption> library_options() {
  std::int32_t count = 0;
  check(pnpbs_option_count(&count), nullptr);
  std::vector<LibraryOption> options;
  for (std::int32_t i = 0; i < count; ++i) {
    const char *name, *type, *default_value, *range, *help;
    check(pnpbs_option_info(i, &name, &type, &default_value, &range, &help), nullptr);
    options.push_back({name, type, default_value, range, help});
  }
  return options;
}

std::vector<LibraryStatistic> library_statistics() {
  std::int32_t count = 0;
  check(pnpbs_statistic_count(&count), nullptr);
  std::vector<LibraryStatistic> statistics;
  for (std::int32_t i = 0; i < count; ++i) {
    const char *name, *type, *help;
    check(pnpbs_statistic_info(i, &name, &type, &help), nullptr);
    statistics.push_back({name, type, help});
  }
  return statistics;
}

std::vector<LibraryFormat> library_formats() {
  std::int32_t count = 0;
  check(pnpbs_format_count(&count), nullptr);
  std::vector<LibraryFormat> formats;
  for (std::int32_t i = 0; i < count; ++i) {
    const char *name, *help;
    std::int32_t binary, elements;
    check(pnpbs_format_info(i, &name, &help, &binary, &elements), nullptr);
    formats.push_back({name, help, binary != 0, elements != 0});
  }
  return formats;
}

std::vector<GroupName> group_names(pnpbs_domain domain, pnpbs_context context) {
  std::int32_t count = 0;
  check(pnpbs_domain_tag_name_count(domain, &count), context);
  std::vector<GroupName> names;
  for (std::int32_t i = 0; i < count; ++i) {
    GroupName group{};
    const char* name = nullptr;
    check(pnpbs_domain_get_tag_name(domain, i, &group.dimension, &group.tag, &name), context);
    group.name = name;
    names.push_back(group);
  }
  return names;
}

std::vector<Warning> warnings_of(pnpbs_context context, pnpbs_placement placement) {
  std::int32_t count = 0;
  check(pnpbs_placement_warning_count(placement, &count), context);
  std::vector<Warning> warnings;
  for (std::int32_t i = 0; i < count; ++i) {
    std::int32_t code = PNPBS_WARNING_UNKNOWN;
    check(pnpbs_placement_get_warning_data(placement, i, &code, nullptr, nullptr, nullptr),
          context);
    const char* text = "";
    check(pnpbs_placement_get_warning(placement, i, &text), context);
    warnings.push_back({code, text});
  }
  return warnings;
}

}  // namespace pnpbs::tool
