// The shapes of tables that known tools write, for one recording of any ids, times and places.
#pragma once

namespace kinesphere::program {

/// A row has these fields: id, s and unix (seconds), ms, us, frame (25 a second), date and day_first (without
/// a zone), x, y and vertical zero in the tool's unit of length, lon, lat, alt in metres and alt_ft.
struct PresetShape {
  const char* preset;  ///< of --format
  const char* header;
  const char* row;
  double unit = 1.0;  ///< metres in one unit of x and y
  enum class Heights { none, some } heights = Heights::none;
  const char* options = "";  ///< given with it: a frame rate, or the name of the format
  bool one_body_a_file = false;
  /// A row that the preset leaves out.
  const char* void_row = "";
};

constexpr auto with_heights = PresetShape::Heights::some;
constexpr auto no_heights = PresetShape::Heights::none;

constexpr PresetShape preset_shapes[] = {
    {"ucy", "", "{frame} {id} {x} 0 {y} 0 0 0\n", 1.0, no_heights, "ucy"},
    {"eth", "", "{frame} {id} {x} 0 {y} 0 0 0\n", 1.0, no_heights, "eth"},
    {"pedpy", "# framerate: 25 fps\n# id frame x/m y/m z/m\n", "{id} {frame} {x} {y} 1.8\n"},
    {"hermes", "# id frame x/cm y/cm z/cm\n", "{id} {frame} {x} {y} 180\n", 0.01, no_heights, "25"},
    {"petrack", "# framerate: 25 fps\n# PersID Frame X Y Z\n", "{id} {frame} {x} {y} 180\n"},
    {"vadere", "pedestrianId simTime endTime-PID1 startX-PID1 startY-PID1 endX-PID1 endY-PID1\n",
     "{id} {s} 0 {x} {y} 0 0\n"},
    {"sdd", "", "{id} {x} {y} 9 9 {frame} 0 0 1 \"Biker\"\n", 1.0, no_heights, "25", false,
     "{id} 0 0 9 9 1{frame}1 1 0 1 \"Biker\"\n"},
    {"kitti", "", "{frame} {id} Car 0 0 -1.5 296 161 452 292 2.0 1.8 4.4 {x} 1.8 {y} -1.59\n", 1.0,
     no_heights, "25", false,
     "{frame} -1 DontCare -1 -1 -10 219 188 245 218 -1000 -1000 -1000 -10 -1 -1 -1\n"},
    {"mot", "", "{frame},{id},{x},{y},10,20,1,-1,-1,-1\n", 1.0, no_heights, "25", false,
     "1{frame}1,{id},0,0,10,20,0,-1,-1,-1\n"},
    {"highd", "frame,id,x,y,width,height,xVelocity,yVelocity\n", "{frame},{id},{x},{y},4,2,1,0\n"},
    {"ind", "recordingId,trackId,frame,trackLifetime,xCenter,yCenter,heading,width,length\n",
     "0,{id},{frame},1,{x},{y},0,2,4\n"},
    {"ngsim", "Vehicle_ID,Frame_ID,Global_Time,Local_X,Local_Y,v_Length\n", "{id},{frame},{ms},{x},{y},14\n",
     0.3048},
    {"vissim", "NO;SIMSEC;COORDFRONTX;COORDFRONTY\n", "{id};{s};{x};{y}\n"},
    {"argoverse", "TIMESTAMP,TRACK_ID,OBJECT_TYPE,X,Y,CITY_NAME\n", "{unix},{id},OTHERS,{x},{y},MIA\n"},
    {"interaction", "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy\n",
     "{id},{frame},{ms},car,{x},{y},1,0\n"},
    {"sumo", "timestep_time;vehicle_id;vehicle_x;vehicle_y;vehicle_speed\n", "{s};{id};{x};{y};1\n"},
    {"opensky", "time,icao24,lat,lon,velocity,heading,vertrate,callsign,baroaltitude,geoaltitude\n",
     "{unix},{id},{lat},{lon},200,90,0,T,{alt},99\n", 1.0, with_heights},
    {"traffic", "timestamp,icao24,latitude,longitude,groundspeed,track,vertical_rate,callsign,altitude\n",
     "{date}+00:00,{id},{lat},{lon},450,90,0,T,{alt_ft}\n", 1.0, with_heights},
    {"ais", "MMSI,BaseDateTime,LAT,LON,SOG,COG\n", "{id},{date},{lat},{lon},1,90\n"},
    {"dma", "# Timestamp,Type of mobile,MMSI,Latitude,Longitude,Navigational status,ROT,SOG,COG\n",
     "{day_first},Class A,{id},{lat},{lon},Under way,0,1,90\n"},
    {"px4", "timestamp,timestamp_sample,ref_timestamp,x,y,z,vx,vy,vz\n", "{us},0,0,{x},{y},-10,0,0,0\n", 1.0,
     no_heights, "", true},
    {"ardupilot", "TimeUS,Status,Lat,Lng,Alt,Spd\n", "{us},3,{lat},{lon},{alt},0\n", 1.0, with_heights, "",
     true, "1{us},1,0,0,0,0\n"},
    {"airdata", "time(millisecond),datetime(utc),latitude,longitude,height_above_takeoff(feet)\n",
     "{ms},{date},{lat},{lon},{alt_ft}\n", 1.0, with_heights, "", true},
    {"ros",
     "%time,field.header.seq,field.header.stamp,field.pose.position.x,field.pose.position.y,field.pose."
     "position.z\n",
     "{us}000,1,{us}000,{x},{y},0\n", 1.0, no_heights, "", true},
    {"tum", "", "{unix} {x} {y} 0 0 0 0 1\n", 1.0, no_heights, "", true},
    {"mosquito", "object,oldobject,time,XSplined,YSplined,ZSplined\n", "1,{id},{s},{x},{y},0\n"},
    {"movebank", "event-id,visible,timestamp,location-long,location-lat,individual-local-identifier\n",
     "1,true,{date},{lon},{lat},{id}\n", 1.0, no_heights, "", false, "2,false,{date},0,0,{id}\n"},
    {"trackmate",
     "LABEL,ID,TRACK_ID,POSITION_X,POSITION_Y,POSITION_Z,POSITION_T,FRAME\n"
     "Label,Spot ID,Track ID,X,Y,Z,T,Frame\n,,,(micron),(micron),(micron),(sec),\n",
     "ID1,1,{id},{x},{y},0,{s},{frame}\n", 1e-6, no_heights, "", false, "ID1,1,,0,0,0,{s},{frame}\n"},
    {"imaris", "Position X,Position Y,Position Z,Unit,Category,Collection,Time,TrackID,ID\n",
     "{x},{y},0,um,Spot,Position,{frame},{id},1\n", 1e-6, no_heights, "25", false,
     "0,0,0,um,Spot,Position,{frame},,2\n"},
    {"nfl", "time,x,y,s,event,nflId,displayName,frame.id,gameId,playId\n",
     "{date}Z,{x},{y},0,NA,{id},p,{frame},1,1\n", 0.9144, no_heights, "", false,
     "{date}Z,0,0,0,NA,NA,ball,{frame},1,1\n"},
};

}  // namespace kinesphere::program
