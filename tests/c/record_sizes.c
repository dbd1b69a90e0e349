// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
// clang-format off
// Sizes of the records, on machines with 64-bit pointers. A change of this file breaks programs that have been
// compiled, so it needs another KS_ABI_VERSION; only records that begin with struct_size may grow, and the
// library then takes both sizes.
#include <kinesphere.h>

#define HAS_SIZE(record, size) _Static_assert(sizeof(void*) != 8 || sizeof(record) == (size), #record)

HAS_SIZE(ks_body_id, 12);
HAS_SIZE(ks_vec3, 24);
HAS_SIZE(ks_state, 48);
HAS_SIZE(ks_box, 48);
HAS_SIZE(ks_shape, 88);
HAS_SIZE(ks_mesh, 8);
HAS_SIZE(ks_world, 8);
HAS_SIZE(ks_filter, 24);
HAS_SIZE(ks_world_definition, 152);
HAS_SIZE(ks_body_definition, 160);
HAS_SIZE(ks_static_definition, 136);
HAS_SIZE(ks_quaternion, 32);
HAS_SIZE(ks_rotation, 56);
HAS_SIZE(ks_rigid_part, 56);
HAS_SIZE(ks_rigid_hull, 24);
HAS_SIZE(ks_rigid_definition, 136);
HAS_SIZE(ks_motion_limits, 48);
HAS_SIZE(ks_body_view, 264);
HAS_SIZE(ks_sensor_overlap, 24);
HAS_SIZE(ks_timings, 24);
HAS_SIZE(ks_busy_body, 88);
HAS_SIZE(ks_event, 400);
HAS_SIZE(ks_response, 144);
HAS_SIZE(ks_roughness, 40);
HAS_SIZE(ks_step_potential, 8);
HAS_SIZE(ks_step_potential_definition, 48);
HAS_SIZE(ks_event_hash, 16);
HAS_SIZE(ks_run_definition, 56);
HAS_SIZE(ks_game_definition, 64);
HAS_SIZE(ks_event_list, 16);
HAS_SIZE(ks_body_list, 32);
HAS_SIZE(ks_motion_definition, 104);
HAS_SIZE(ks_prediction, 32);
HAS_SIZE(ks_hit, 32);
HAS_SIZE(ks_sphere, 32);
HAS_SIZE(ks_ray, 64);
HAS_SIZE(ks_replay, 8);
HAS_SIZE(ks_monitor, 8);
HAS_SIZE(ks_error_bound, 24);
HAS_SIZE(ks_track_class, 72);
HAS_SIZE(ks_separation, 40);
HAS_SIZE(ks_separation_rule, 32);
HAS_SIZE(ks_monitor_definition, 152);
HAS_SIZE(ks_track_report, 184);
HAS_SIZE(ks_monitor_event, 96);
HAS_SIZE(ks_pair_answer, 128);
HAS_SIZE(ks_open_pair, 32);
HAS_SIZE(ks_predicted_pair, 56);
HAS_SIZE(ks_report_request, 24);
HAS_SIZE(ks_track_place, 72);
