// Formats of known tools, as tables of names.
#include "formats/tables/presets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "formats/fields/line_text.hpp"

namespace kinesphere::program {
namespace {

using Film = TableColumns::Film;

constexpr std::string_view ais_columns =
    "id=MMSI,time=BaseDateTime,lon=LON|longitude,lat=LAT|latitude,speed?=SOG:kt,course?=COG";

/// A preset of each tool, by --format, with its columns and the header by which it is known.
constexpr Preset presets[] = {
    // Pedestrians.
    {"ucy",
     "UCY obsmat",
     "id=2,frame=1,x=3:m,y=5:m",
     "",
     {.frame_rate = 25.0, .film = Film::ucy, .least_columns = 8}},
    {"eth",
     "ETH obsmat",
     "id=2,frame=1,x=3:m,y=5:m",
     "",
     {.frame_rate = 25.0, .film = Film::eth, .least_columns = 8}},
    // z is the person's height.
    {"pedpy",
     "PedPy",
     "id=id|1,frame=frame|2,x=x/m|3:m,y=y/m|4:m",
     "id,frame,x/m,y/m",
     {.least_columns = 4, .has_own_heights = true}},
    {"hermes",
     "PeTrack, in cm",
     "id=id|1,frame=frame|2,x=x/cm|3:cm,y=y/cm|4:cm",
     "id,frame,x/cm,y/cm",
     {.least_columns = 4, .has_own_heights = true}},
    {"petrack",
     "PeTrack (lengths as they are)",
     "id=PersID,frame=Frame,x=X,y=Y",
     "PersID,Frame,X,Y",
     {.least_columns = 4, .has_own_heights = true}},
    {"vadere", "Vadere", "id=pedestrianId,time=simTime:s,x=startX*:m,y=startY*:m",
     "pedestrianId,simTime,startX*,startY*"},
    {"sdd",
     "Stanford Drone Dataset (left and top of boxes)",
     "id=1,frame=6,x=2,y=3",
     "",
     {.where = "7 = 0", .least_columns = 10}},
    // Positions are relative to the camera of the car: x to its right, z forward; y is down.
    {"kitti",
     "KITTI tracking (the ground as the camera's car sees it)",
     "id=2,frame=1,x=14:m,y=16:m",
     "",
     {.frame_rate = 10.0, .where = "2 != -1", .least_columns = 17}},
    {"mot",
     "MOT (left and top of boxes)",
     "id=2,frame=1,x=3,y=4",
     "",
     {.where = "7 != 0", .least_columns = 7}},
    // Road traffic. Positions of highD are corners of boxes.
    {"highd",
     "highD (upper left corners)",
     "id=id,frame=frame,x=x:m,y=y:m,vx?=xVelocity:m/s,vy?=yVelocity:m/s,length?=width:m,width?=height:m",
     "frame,id,x,y,width,height,xVelocity,yVelocity",
     {.frame_rate = 25.0, .place = TableColumns::Place::upper_left}},
    {"ind",
     "inD, rounD, exiD",
     "id=trackId,frame=frame,x=xCenter:m,y=yCenter:m,vx?=xVelocity:m/s,vy?=yVelocity:m/"
     "s,length?=length:m,width?=width:m,heading?=heading:deg",
     "recordingId,trackId,frame,xCenter,yCenter",
     {.frame_rate = 25.0}},
    {"ngsim", "NGSIM", "id=Vehicle_ID,time=Global_Time:ms,x=Local_X:ft,y=Local_Y:ft",
     "Vehicle_ID,Global_Time,Local_X,Local_Y"},
    {"vissim", "Vissim",
     "id=NO,time=SIMSEC:s,x=COORDFRONTX|COORDCENTX|COORDREARX,y=COORDFRONTY|COORDCENTY|COORDREARY,z?="
     "COORDFRONTZ|COORDCENTZ|COORDREARZ",
     "NO,SIMSEC,COORD*"},
    {"argoverse", "Argoverse", "id=TRACK_ID,time=TIMESTAMP:s,x=X:m,y=Y:m",
     "TIMESTAMP,TRACK_ID,OBJECT_TYPE,X,Y"},
    {"interaction", "INTERACTION",
     "id=track_id,time=timestamp_ms:ms,x=x:m,y=y:m,vx?=vx:m/s,vy?=vy:m/"
     "s,length?=length:m,width?=width:m,heading?=psi_rad:rad",
     "track_id,frame_id,timestamp_ms,agent_type,x,y"},
    // Its positions may be longitudes and latitudes.
    {"sumo",
     "SUMO FCD",
     "id=vehicle_id,time=timestep_time:s,x=vehicle_x,y=vehicle_y,z?=vehicle_z:m,speed?=vehicle_speed,course?="
     "vehicle_angle,length?=vehicle_length:m,width?=vehicle_width:m,body_height?=vehicle_height:m",
     "timestep_time,vehicle_id,vehicle_x,vehicle_y",
     {.place = TableColumns::Place::front}},
    // Aircraft and vessels.
    {"opensky", "OpenSky state vectors (barometric altitude)",
     "id=icao24,time=time:s,lon=lon,lat=lat,z=baroaltitude:m,speed?=velocity:m/"
     "s,course?=heading,climb?=vertrate:m/s",
     "time,icao24,lat,lon,velocity,heading,vertrate,baroaltitude"},
    {"traffic", "traffic (barometric altitude)",
     "id=icao24,time=timestamp,lon=longitude,lat=latitude,z=altitude:ft,speed?=groundspeed:kt,course?=track,"
     "climb?=vertical_rate:ft/min",
     "timestamp,icao24,latitude,longitude,groundspeed,vertical_rate,altitude"},
    {"ais", "AIS of marinecadastre.gov", ais_columns, "MMSI,BaseDateTime,LAT,LON"},
    {"ais", "AIS of marinecadastre.gov", ais_columns, "MMSI,BaseDateTime,latitude,longitude"},
    {"dma",
     "Danish AIS",
     "id=MMSI,time=Timestamp|# Timestamp,lon=Longitude,lat=Latitude,speed?=SOG:kt,course?=COG",
     "Type of mobile,MMSI,Latitude,Longitude",
     {.dates = DateOrder::day_first}},
    // Drones, robots: one body a file.
    {"px4",
     "PX4 (each from its own origin and start)",
     "id=@file,time=timestamp:us,x=x:m,y=y:m,z=z:m,vx?=vx:m/s,vy?=vy:m/s,vz?=vz:m/s",
     "timestamp,timestamp_sample,x,y,z,vx,vy,vz",
     {.has_own_origin = true}},
    {"px4", "PX4 (positions of GPS)",
     "id=@file,time=time_utc_usec:us,lon=longitude_deg,lat=latitude_deg,z=altitude_msl_m:m",
     "time_utc_usec,latitude_deg,longitude_deg,altitude_msl_m"},
    {"px4", "PX4 (positions of GPS)", "id=@file,time=time_utc_usec:us,lon=lon:degE7,lat=lat:degE7,z=alt:mm",
     "time_utc_usec,lat,lon,alt,alt_ellipsoid"},
    {"px4",
     "PX4 (each from its own start)",
     "id=@file,time=timestamp:us,lon=lon,lat=lat,z=alt:m",
     "timestamp,timestamp_sample,lat,lon,alt",
     {.has_own_origin = true}},
    {"ardupilot",
     "ArduPilot (each from its own start)",
     "id=@file,time=TimeUS:us,lon=Lng,lat=Lat,z=Alt:m",
     "TimeUS,Status,Lat,Lng,Alt",
     {.where = "Status >= 3", .has_own_origin = true}},
    {"ardupilot",
     "ArduPilot (each from its own start)",
     "id=@file,time=TimeUS:us,lon=Lng,lat=Lat,z=Alt:m",
     "TimeUS,Lat,Lng,Alt",
     {.has_own_origin = true}},
    {"airdata", "DJI, by AirData",
     "id=@file,time=datetime(utc),lon=longitude,lat=latitude,z?=altitude_above_seaLevel(meters)|altitude_"
     "above_seaLevel(feet)|height_above_takeoff(meters)|height_above_takeoff(feet)|altitude(feet)|altitude("
     "m)",
     "time(millisecond),datetime(utc),latitude,longitude"},
    {"ros", "ROS (rostopic echo -p)",
     "id=@file,time=field.header.stamp:ns,x=field.pose.position.x:m,y=field.pose.position.y:m,z=field.pose."
     "position.z:m",
     "field.header.stamp,field.pose.position.x"},
    {"ros", "ROS (rostopic echo -p)",
     "id=@file,time=field.header.stamp:ns,x=field.pose.pose.position.x:m,y=field.pose.pose.position.y:m,z="
     "field.pose.pose.position.z:m",
     "field.header.stamp,field.pose.pose.position.x"},
    {"ros", "ROS (rostopic echo -p)",
     "id=@file,time=field.header.stamp:ns,lon=field.longitude,lat=field.latitude,z=field.altitude:m",
     "field.header.stamp,field.latitude,field.longitude,field.altitude"},
    {"tum",
     "TUM",
     "id=@file,time=timestamp|1:s,x=tx|2:m,y=ty|3:m,z=tz|4:m",
     "timestamp,tx,ty,tz,qx,qy,qz,qw",
     {.least_columns = 8}},
    // Animals, cells, players. "object" joins interrupted tracks, with jumps at the joints; "oldobject" does
    // not.
    {"mosquito", "mosquito tracks", "id=oldobject,time=time:s,x=XSplined:m,y=YSplined:m,z?=ZSplined:m",
     "oldobject,time,XSplined,YSplined"},
    {"movebank",
     "Movebank",
     "id=individual-local-identifier,time=timestamp,lon=location-long,lat=location-lat,z?=height-above-msl|"
     "height-above-ellipsoid:m",
     "visible,timestamp,location-long,location-lat,individual-local-identifier",
     {.where = "visible != false"}},
    {"movebank", "Movebank",
     "id=individual-local-identifier,time=timestamp,lon=location-long,lat=location-lat,z?=height-above-msl|"
     "height-above-ellipsoid:m",
     "timestamp,location-long,location-lat,individual-local-identifier"},
    {"trackmate",
     "TrackMate spots",
     "id=TRACK_ID,time=POSITION_T,x=POSITION_X,y=POSITION_Y,z?=POSITION_Z",
     "TRACK_ID,POSITION_X,POSITION_Y,POSITION_T",
     {.where = "TRACK_ID != '' and TRACK_ID != None"}},
    // Times are the numbers of frames, from 1; spots of no track have no TrackID.
    {"imaris",
     "Imaris (positions)",
     "id=TrackID,frame=Time,x=Position X:um,y=Position Y:um,z?=Position Z:um",
     "Position X,Position Y,Unit,Category,Collection,Time,TrackID",
     {.where = "Unit = um and TrackID != ''"}},
    {"nfl",
     "NFL Big Data Bowl (without the ball)",
     "id=nflId,time=time,x=x:yd,y=y:yd",
     "time,x,y,nflId,gameId,playId",
     {.where = "nflId != '' and nflId != NA"}},
};

bool has_header_of(const TableHead& head, const Preset& preset) {
  if (head.names.empty() || preset.header.empty()) return false;
  for (std::string_view rest = preset.header; !rest.empty();)
    if (!preset_column(head, take_part(rest, ','))) return false;
  return true;
}

/// Numbers of a row; nothing if a field is none.
std::optional<std::vector<double>> numbers_in(const std::vector<std::string>& fields) {
  std::vector<double> numbers;
  for (const std::string& field : fields) {
    const auto number = parse_number(field);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

/// frame id left top width height confidence -1 -1 -1; or, as the truth of MOT16 to MOT20, behind the
/// confidence a class from 1 to 13 and a visibility from 0 to 1.
bool is_mot(const std::vector<double>& row) {
  if (row.size() == 9)
    return row[0] >= 1.0 && row[1] >= 1.0 && (row[6] == 0.0 || row[6] == 1.0) && row[7] >= 1.0 &&
           row[7] <= 13.0 && row[8] >= 0.0 && row[8] <= 1.0 &&
           std::ranges::all_of(std::array{row[0], row[1], row[7]},
                               [](double number) { return number == std::floor(number); });
  return row.size() == 10 && row[7] == -1.0 && row[8] == -1.0 && row[9] == -1.0;
}

/// Time, position, quaternion of length 1. Times of a simulation may be small, as frames of an obsmat are,
/// whose second number is an id.
bool is_tum(const std::vector<double>& row) {
  if (row.size() != 8) return false;
  const bool may_be_id = row[1] >= 0.0 && row[1] == std::floor(row[1]);
  if (row[0] < 1e8 && may_be_id) return false;
  return std::abs(std::hypot(std::hypot(row[4], row[5]), std::hypot(row[6], row[7])) - 1.0) < 1e-3;
}

/// id left top right bottom frame lost occluded generated label
bool is_sdd(const std::vector<std::string>& fields) {
  constexpr std::string_view labels[] = {"Biker", "Pedestrian", "Skater", "Skateboarder",
                                         "Cart",  "Car",        "Bus"};
  return fields.size() == 10 &&
         std::find(std::begin(labels), std::end(labels), fields[9]) != std::end(labels) &&
         numbers_in({fields.begin(), fields.end() - 1}).has_value();
}

/// frame id type truncated occluded alpha, box in the image, height width length, x y z, rotation[, score]
bool is_kitti(const std::vector<std::string>& fields) {
  constexpr std::string_view types[] = {"Car",     "Van",  "Truck", "Pedestrian", "Person_sitting",
                                        "Cyclist", "Tram", "Misc",  "DontCare",   "Person"};
  return (fields.size() == 17 || fields.size() == 18) &&
         std::find(std::begin(types), std::end(types), fields[2]) != std::end(types) &&
         numbers_in({fields.begin() + 3, fields.end()}).has_value();
}

const Preset* shown_by_first_row(const TableHead& head) {
  if (is_kitti(head.first)) return preset_named("kitti");
  if (is_sdd(head.first)) return preset_named("sdd");
  const auto numbers = numbers_in(head.first);
  if (!numbers) return nullptr;
  if (is_mot(*numbers)) return preset_named("mot");
  if (is_tum(*numbers)) return preset_named("tum");
  return nullptr;
}

}  // namespace

const Preset* preset_named(std::string_view name) {
  const auto found = std::find_if(std::begin(presets), std::end(presets),
                                  [name](const Preset& each) { return each.name == name; });
  return found == std::end(presets) ? nullptr : found;
}

const Preset* recognised_preset(const TableHead& head) {
  if (head.names.empty()) return shown_by_first_row(head);
  const auto found = std::find_if(std::begin(presets), std::end(presets),
                                  [&](const Preset& each) { return has_header_of(head, each); });
  return found == std::end(presets) ? nullptr : found;
}

std::optional<std::size_t> preset_column(const TableHead& head, std::string_view name) {
  const bool is_prefix = name.ends_with('*');
  if (is_prefix) name.remove_suffix(1);
  const std::string plain = plain_name(name);
  for (std::size_t place = 0; place < head.names.size(); ++place) {
    const std::string each = plain_name(head.names[place]);
    if (is_prefix ? each.starts_with(plain) : each == plain) return place;
  }
  return std::nullopt;
}

std::string preset_names() {
  std::string names;
  std::string_view last;
  for (const Preset& preset : presets)
    if (std::exchange(last, preset.name) != preset.name) names += std::string(preset.name) + "|";
  return names + "table";
}

}  // namespace kinesphere::program
