// Columns that may be meant, for messages that ask for --columns.
#pragma once

#include <string>
#include <string_view>

#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// True for what says where and when a body is.
bool is_position(Quantity quantity);
/// True for parts of the messages of robots that have axes, but are no places: pose.orientation,
/// twist.linear.
bool is_of_no_place(std::string_view body);
/// Adds columns that may be meant, for messages: vessel_mmsi, OSD.latitude, field.pose.position.x. Of several
/// that are alike it adds none.
void add_likely_columns(const TableHead& head, TableColumns& columns);
/// Returns the option --columns with these columns and those that are likely, and with id=..., time=... and
/// x=...,y=... for what is none of them.
std::string whole_columns_option(const TableHead& head, TableColumns columns);

}  // namespace kinesphere::program
